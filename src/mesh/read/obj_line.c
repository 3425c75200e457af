/* Statements of an OBJ file: from text to values. */
#include "mesh/read/obj_line.h"

#include <stdlib.h>

#include "mesh/read/decimal.h"

void burnish_obj_line_close(burnish_obj_line *line) {
    burnish_number_reader_close(&line->numbers);
    free(line->corner_normals);
    free(line->corners);
    *line = (burnish_obj_line){0};
}

burnish_obj_keyword burnish_obj_read_keyword(burnish_obj_line *line) {
    burnish_token token;
    if (!burnish_text_token(&line->text, &token)) {
        return BURNISH_OBJ_NOTHING;
    }
    if (token.size == 1) {
        switch (*token.bytes) {
        case 'v':
            return BURNISH_OBJ_VERTEX;
        case 'f':
            return BURNISH_OBJ_FACE;
        case 'l':
        case 'p':
            return BURNISH_OBJ_ELEMENT;
        default:
            return BURNISH_OBJ_OTHER;
        }
    }
    return burnish_token_is(token, "vn")       ? BURNISH_OBJ_NORMAL
           : burnish_token_is(token, "usemtl") ? BURNISH_OBJ_MATERIAL
           : burnish_token_is(token, "mtllib") ? BURNISH_OBJ_LIBRARY
                                               : BURNISH_OBJ_OTHER;
}

/* ---- vertices ---- */

burnish_status burnish_obj_read_vertex(burnish_obj_line *line,
                                       float values[BURNISH_OBJ_VERTEX_MOST], int *count) {
    int read = 0;
    burnish_token token;
    burnish_number_status number;
    while (read < BURNISH_OBJ_VERTEX_MOST &&
           burnish_text_float(&line->text, &line->numbers, &token, &values[read], &number)) {
        if (number != BURNISH_NUMBER_OK) {
            return burnish_fail_number(line->error, burnish_obj_here(line),
                                       read < 3 ? "coordinate" : "colour", token, number);
        }
        ++read;
    }
    if (read < 3 || read == 5) {
        return burnish_fail_at(line->error, BURNISH_STATUS_FORMAT, burnish_obj_here(line),
                               "vertex has %d number%s; write v x y z or v x y z r g b", read,
                               read == 1 ? "" : "s");
    }
    *count = read;
    return BURNISH_STATUS_OK;
}

void burnish_obj_color(const float values[BURNISH_OBJ_VERTEX_MOST], uint8_t rgba[4]) {
    rgba[3] = 255;
    for (int i = 0; i < 3; ++i) {
        float c = values[3 + i];
        rgba[i] = (uint8_t)(c <= 0 ? 0 : c >= 1 ? 255 : c * 255 + 0.5f);
    }
}

burnish_status burnish_obj_read_normal(burnish_obj_line *line, float normal[3]) {
    burnish_token token;
    burnish_number_status number;
    for (int i = 0; i < 3; ++i) {
        if (!burnish_text_float(&line->text, &line->numbers, &token, &normal[i], &number)) {
            return burnish_fail_at(line->error, BURNISH_STATUS_FORMAT, burnish_obj_here(line),
                                   "normal has %d number%s; write vn x y z", i, i == 1 ? "" : "s");
        }
        if (number == BURNISH_NUMBER_NOT_FINITE || number == BURNISH_NUMBER_RANGE) {
            normal[i] = 0; /* exporters write nan for faces without area; such a normal is remade */
        } else if (number != BURNISH_NUMBER_OK) {
            return burnish_fail_number(line->error, burnish_obj_here(line), "normal", token,
                                       number);
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

static burnish_status parse_index(burnish_obj_line *line, burnish_token token, const char *what,
                                  size_t count, uint32_t *index) {
    int64_t written = 0;
    burnish_number_status number = burnish_parse_integer(token.bytes, token.size, &written);
    if (number == BURNISH_NUMBER_GARBAGE) {
        return burnish_fail_at(line->error, BURNISH_STATUS_FORMAT, burnish_obj_here(line),
                               "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                               burnish_token_quote(token).text);
    }
    if (number == BURNISH_NUMBER_OK && written == 0) {
        return burnish_fail_at(line->error, BURNISH_STATUS_FORMAT, burnish_obj_here(line),
                               "face refers to %s 0; indices start at 1", what);
    }
    if (number != BURNISH_NUMBER_OK || !resolve_index(written, count, index)) {
        return burnish_fail_at(line->error, BURNISH_STATUS_FORMAT, burnish_obj_here(line),
                               "face refers to %s %s, but %zu stand%s before it; correct the index",
                               what, burnish_token_quote(token).text, count, count == 1 ? "s" : "");
    }
    return BURNISH_STATUS_OK;
}

/* Cuts the part before the next '/' off token. */
static burnish_token cut_part(burnish_token *token) {
    size_t size = 0;
    while (size < token->size && token->bytes[size] != '/') {
        ++size;
    }
    burnish_token part = {token->bytes, size};
    size_t used = size < token->size ? size + 1 : size;
    token->bytes += used;
    token->size -= used;
    return part;
}

/* v, v/t, v//n or v/t/n. */
static burnish_status parse_corner(burnish_obj_line *line, burnish_token token, size_t positions,
                                   size_t normals, uint32_t *position, uint32_t *normal) {
    burnish_token left = token, part = cut_part(&left);
    burnish_status status = parse_index(line, part, "vertex", positions, position);
    *normal = BURNISH_SOURCE_NONE;
    if (status != BURNISH_STATUS_OK || left.size == 0) {
        return status;
    }
    part = cut_part(&left);
    int64_t texture;
    int wrong = part.size > 0 &&
                burnish_parse_integer(part.bytes, part.size, &texture) == BURNISH_NUMBER_GARBAGE;
    if (left.size > 0) {
        part = cut_part(&left);
        wrong |= left.size > 0;
        if (!wrong) {
            return parse_index(line, part, "normal", normals, normal);
        }
    }
    if (wrong) {
        return burnish_fail_at(line->error, BURNISH_STATUS_FORMAT, burnish_obj_here(line),
                               "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                               burnish_token_quote(token).text);
    }
    return BURNISH_STATUS_OK;
}

/* Digits, possibly behind a '-'; NULL for anything else. */
static inline const uint8_t *scan_index(const uint8_t *p, int64_t *written) {
    uint64_t value = 0;
    int negative = *p == '-';
    p += negative;
    unsigned digits = burnish_scan_digits(&p, &value);
    if (digits == 0 || digits > 18) {
        return NULL;
    }
    *written = negative ? -(int64_t)value : (int64_t)value;
    return p;
}

/* The next corner where it is right and of plain form; returns 0, and moves nothing, for any other.
 */
static inline int scan_corner(burnish_text *text, size_t positions, size_t normals,
                              uint32_t *position, uint32_t *normal) {
    const uint8_t *p = text->next;
    int64_t written;
    while (p < text->end && *p == ' ') {
        ++p;
    }
    if (text->end - p <= BURNISH_DECIMAL_ROOM || !(p = scan_index(p, &written)) ||
        !resolve_index(written, positions, position)) {
        return 0;
    }
    *normal = BURNISH_SOURCE_NONE;
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
    if (!burnish_text_blank(*p) && !burnish_text_line_end(*p)) {
        return 0;
    }
    text->next = p;
    return 1;
}

static burnish_status reserve_corner(burnish_obj_line *line) {
    const size_t needed = line->corner_count + 1;
    burnish_status status =
        burnish_legacy_reserve((void **)&line->corners, &line->corner_capacity, needed,
                               sizeof *line->corners, "corners", line->error);
    return status != BURNISH_STATUS_OK
               ? status
               : burnish_legacy_reserve((void **)&line->corner_normals,
                                        &line->corner_normal_capacity, needed,
                                        sizeof *line->corner_normals, "corners", line->error);
}

burnish_status burnish_obj_read_face(burnish_obj_line *line, size_t positions, size_t normals) {
    line->corner_count = 0;
    line->has_normals = 0;
    for (;;) {
        uint32_t position, normal;
        burnish_status status = BURNISH_STATUS_OK;
        if (!scan_corner(&line->text, positions, normals, &position, &normal)) {
            burnish_token token;
            if (!burnish_text_token(&line->text, &token)) {
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
        line->has_normals |= normal != BURNISH_SOURCE_NONE;
    }
}
