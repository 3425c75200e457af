/* Statements of an OBJ file: from text to values. */
#include "oracle/obj_line.h"

#include <stdlib.h>

#include "oracle/decimal.h"

void oracle_obj_line_close(oracle_obj_line *line) {
    oracle_number_reader_close(&line->numbers);
    free(line->corner_normals);
    free(line->corners);
    *line = (oracle_obj_line){0};
}

oracle_obj_keyword oracle_obj_read_keyword(oracle_obj_line *line) {
    oracle_token token;
    if (!oracle_text_token(&line->text, &token)) {
        return ORACLE_OBJ_NOTHING;
    }
    if (token.size == 1) {
        switch (*token.bytes) {
        case 'v':
            return ORACLE_OBJ_VERTEX;
        case 'f':
            return ORACLE_OBJ_FACE;
        case 'l':
        case 'p':
            return ORACLE_OBJ_ELEMENT;
        default:
            return ORACLE_OBJ_OTHER;
        }
    }
    return oracle_token_is(token, "vn")       ? ORACLE_OBJ_NORMAL
           : oracle_token_is(token, "usemtl") ? ORACLE_OBJ_MATERIAL
           : oracle_token_is(token, "mtllib") ? ORACLE_OBJ_LIBRARY
                                              : ORACLE_OBJ_OTHER;
}

/* ---- vertices ---- */

burnish_status oracle_obj_read_vertex(oracle_obj_line *line, float values[ORACLE_OBJ_VERTEX_MOST],
                                      int *count) {
    int read = 0;
    oracle_token token;
    oracle_number_status number;
    while (read < ORACLE_OBJ_VERTEX_MOST &&
           oracle_text_float(&line->text, &line->numbers, &token, &values[read], &number)) {
        if (number != ORACLE_NUMBER_OK) {
            return oracle_fail_number(line->error, oracle_obj_here(line),
                                      read < 3 ? "coordinate" : "colour", token, number);
        }
        ++read;
    }
    if (read < 3 || read == 5) {
        return oracle_fail_at(line->error, BURNISH_STATUS_FORMAT, oracle_obj_here(line),
                              "vertex has %d number%s; write v x y z or v x y z r g b", read,
                              read == 1 ? "" : "s");
    }
    *count = read;
    return BURNISH_STATUS_OK;
}

void oracle_obj_color(const float values[ORACLE_OBJ_VERTEX_MOST], uint8_t rgba[4]) {
    rgba[3] = 255;
    for (int i = 0; i < 3; ++i) {
        float c = values[3 + i];
        rgba[i] = (uint8_t)(c <= 0 ? 0 : c >= 1 ? 255 : c * 255 + 0.5f);
    }
}

burnish_status oracle_obj_read_normal(oracle_obj_line *line, float normal[3]) {
    oracle_token token;
    oracle_number_status number;
    for (int i = 0; i < 3; ++i) {
        if (!oracle_text_float(&line->text, &line->numbers, &token, &normal[i], &number)) {
            return oracle_fail_at(line->error, BURNISH_STATUS_FORMAT, oracle_obj_here(line),
                                  "normal has %d number%s; write vn x y z", i, i == 1 ? "" : "s");
        }
        if (number == ORACLE_NUMBER_NOT_FINITE || number == ORACLE_NUMBER_RANGE) {
            normal[i] = 0; /* exporters write nan for faces without area; such a normal is remade */
        } else if (number != ORACLE_NUMBER_OK) {
            return oracle_fail_number(line->error, oracle_obj_here(line), "normal", token, number);
        }
    }
    return BURNISH_STATUS_OK;
}

/* ---- faces ---- */

/* An index as written, counted from 1 or backwards from -1, becomes one counted from 0; returns 0
 * when nothing has it. */
static inline int resolve_index(int64_t written, size_t count, uint32_t *index) {
    int64_t resolved = written < 0 ? written + (int64_t)count : written - 1;
    *index = (uint32_t)resolved;
    return resolved >= 0 && resolved < (int64_t)count;
}

static burnish_status parse_index(oracle_obj_line *line, oracle_token token, const char *what,
                                  size_t count, uint32_t *index) {
    int64_t written = 0;
    oracle_number_status number = oracle_parse_integer(token.bytes, token.size, &written);
    if (number == ORACLE_NUMBER_GARBAGE) {
        return oracle_fail_at(line->error, BURNISH_STATUS_FORMAT, oracle_obj_here(line),
                              "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                              oracle_token_quote(token).text);
    }
    if (number == ORACLE_NUMBER_OK && written == 0) {
        return oracle_fail_at(line->error, BURNISH_STATUS_FORMAT, oracle_obj_here(line),
                              "face refers to %s 0; indices start at 1", what);
    }
    if (number != ORACLE_NUMBER_OK || !resolve_index(written, count, index)) {
        return oracle_fail_at(line->error, BURNISH_STATUS_FORMAT, oracle_obj_here(line),
                              "face refers to %s %s, but %zu stand%s before it; correct the index",
                              what, oracle_token_quote(token).text, count, count == 1 ? "s" : "");
    }
    return BURNISH_STATUS_OK;
}

/* Cuts the part before the next '/' off token. */
static oracle_token cut_part(oracle_token *token) {
    size_t size = 0;
    while (size < token->size && token->bytes[size] != '/') {
        ++size;
    }
    oracle_token part = {token->bytes, size};
    size_t used = size < token->size ? size + 1 : size;
    token->bytes += used;
    token->size -= used;
    return part;
}

/* v, v/t, v//n or v/t/n. */
static burnish_status parse_corner(oracle_obj_line *line, oracle_token token, size_t positions,
                                   size_t normals, uint32_t *position, uint32_t *normal) {
    oracle_token left = token, part = cut_part(&left);
    burnish_status status = parse_index(line, part, "vertex", positions, position);
    *normal = ORACLE_SOURCE_NONE;
    if (status != BURNISH_STATUS_OK || left.size == 0) {
        return status;
    }
    part = cut_part(&left);
    int64_t texture;
    int wrong = part.size > 0 &&
                oracle_parse_integer(part.bytes, part.size, &texture) == ORACLE_NUMBER_GARBAGE;
    if (left.size > 0) {
        part = cut_part(&left);
        wrong |= left.size > 0;
        if (!wrong) {
            return parse_index(line, part, "normal", normals, normal);
        }
    }
    if (wrong) {
        return oracle_fail_at(line->error, BURNISH_STATUS_FORMAT, oracle_obj_here(line),
                              "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                              oracle_token_quote(token).text);
    }
    return BURNISH_STATUS_OK;
}

/* Digits, possibly behind a '-'; NULL for anything else. */
static inline const uint8_t *scan_index(const uint8_t *p, int64_t *written) {
    uint64_t value = 0;
    int negative = *p == '-';
    p += negative;
    unsigned digits = oracle_scan_digits(&p, &value);
    if (digits == 0 || digits > 18) {
        return NULL;
    }
    *written = negative ? -(int64_t)value : (int64_t)value;
    return p;
}

/* The next corner where it is right and of plain form; returns 0, and moves nothing, for any other.
 */
static inline int scan_corner(oracle_text *text, size_t positions, size_t normals,
                              uint32_t *position, uint32_t *normal) {
    const uint8_t *p = text->next;
    int64_t written;
    while (p < text->end && *p == ' ') {
        ++p;
    }
    if (text->end - p <= ORACLE_DECIMAL_ROOM || !(p = scan_index(p, &written)) ||
        !resolve_index(written, positions, position)) {
        return 0;
    }
    *normal = ORACLE_SOURCE_NONE;
    if (*p == '/') {
        ++p;
        if (*p != '/' && !(p = scan_index(p, &written))) {
            return 0;
        }
        if (*p == '/' &&
            (!(p = scan_index(p + 1, &written)) || !resolve_index(written, normals, normal))) {
            return 0;
        }
    }
    if (!oracle_text_blank(*p) && !oracle_text_line_end(*p)) {
        return 0;
    }
    text->next = p;
    return 1;
}

static burnish_status reserve_corner(oracle_obj_line *line) {
    const size_t needed = line->corner_count + 1;
    burnish_status status =
        oracle_legacy_reserve((void **)&line->corners, &line->corner_capacity, needed,
                              sizeof *line->corners, "corners", line->error);
    return status != BURNISH_STATUS_OK
               ? status
               : oracle_legacy_reserve((void **)&line->corner_normals,
                                       &line->corner_normal_capacity, needed,
                                       sizeof *line->corner_normals, "corners", line->error);
}

burnish_status oracle_obj_read_face(oracle_obj_line *line, size_t positions, size_t normals) {
    line->corner_count = 0;
    line->has_normals = 0;
    for (;;) {
        uint32_t position, normal;
        burnish_status status = BURNISH_STATUS_OK;
        if (!scan_corner(&line->text, positions, normals, &position, &normal)) {
            oracle_token token;
            if (!oracle_text_token(&line->text, &token)) {
                return BURNISH_STATUS_OK;
            }
            status = parse_corner(line, token, positions, normals, &position, &normal);
        }
        if (status == BURNISH_STATUS_OK && (line->corner_count == line->corner_capacity ||
                                            line->corner_count == line->corner_normal_capacity)) {
            status = reserve_corner(line);
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        line->corners[line->corner_count] = position;
        line->corner_normals[line->corner_count++] = normal;
        line->has_normals |= normal != ORACLE_SOURCE_NONE;
    }
}
