/* PLY: rows of any kind, read one after the other, in chunks, by one decoder that is compiled for
 * each of the three encodings.
 *
 * Rows of an ASCII file are values, wherever lines end. But if lines do not match the header,
 * values are left over, and there are as many lines as rows, then each line is a row. Missing
 * values at the end of a line get defaults, and extra values are ignored. */
#include "mesh/read/ply/ply_rows.h"
#include "mesh/read/common/splats.h"

#include <float.h>

#include "mesh/read/common/local_origin.h"
#include "mesh/read/io/parallel_text.h"
#include "mesh/read/ply/ply_binary.h"
#include "mesh/read/ply/ply_header.h"

/* The events of a chunk; TEXTURE + n: faces from here on show texture n. */
enum { FEW_CORNERS, FIELDS, TEXTURE };

typedef struct ply_parser {
    const burnish_ply_state *ply;
    burnish_chunk *chunk;
    burnish_lexer lexer;
    const uint8_t *value_at; /* of a binary value, for messages */
    int is_short;            /* the current line has fewer values than the row */
    int texture;             /* of the last face; -1: not known yet */
    int has_normals, has_coordinates, has_colors, has_splats; /* of vertices */
    unsigned long long bad_row;                               /* the last with a bad value */
} ply_parser;

/* The part of a face's row that is used after all of it has been read. */
typedef struct face_row {
    size_t corner_count;
    const uint8_t *coordinates; /* the values of texcoord */
    burnish_ply_type coordinate_type;
    uint64_t coordinate_count; /* of values, 2 per corner */
    int texture, is_bad;
} face_row;

/* The location of a message: a binary value's first byte, or the end of a word. */
#define HERE(p) ((p)->ply->header.encoding == BURNISH_PLY_ASCII ? (p)->lexer.next : (p)->value_at)

#define FAIL(p, ...) burnish_chunk_fail((p)->chunk, BURNISH_STATUS_FORMAT, HERE(p), __VA_ARGS__)

static inline size_t bytes_left(const ply_parser *p) {
    return (size_t)(p->lexer.end - p->lexer.next);
}

/* How many values of a type may still follow: in ASCII each takes a character and a blank. */
static uint64_t values_left(const ply_parser *p, burnish_ply_type type) {
    const uint64_t left = bytes_left(p);
    return p->ply->header.encoding == BURNISH_PLY_ASCII ? left / 2 + left % 2
                                                        : left / burnish_ply_type_size(type);
}

/* The current row, counted from 1. */
static unsigned long long row_number(const ply_parser *p) {
    return p->ply->first_row + p->chunk->rows_before + p->chunk->rows + 1;
}

static int fail_truncated(ply_parser *p) {
    FAIL(p, "the %s ends in element %s, row %llu of %llu; the file is truncated",
         p->ply->by_lines ? "line" : "file", burnish_token_quote(p->ply->element->name).text,
         row_number(p), (unsigned long long)p->ply->element->count);
    return 0;
}

/* An ASCII value. A value that is not finite becomes NaN; the property decides whether that is an
 * error. */
static int read_word(ply_parser *p, double *value) {
    burnish_token word;
    burnish_number_status number;
    if (!burnish_lexer_word_double(&p->lexer, &word, value, &number)) {
        const int is_new = p->bad_row != row_number(p);
        if (!p->ply->header.is_open) {
            return fail_truncated(p);
        }
        *value = __builtin_nan("");
        p->bad_row = row_number(p);
        return !is_new || burnish_chunk_pardon(p->chunk, 0, p->lexer.next,
                                               "the line has fewer than 3 numbers");
    }
    if (number == BURNISH_NUMBER_NOT_FINITE || number == BURNISH_NUMBER_RANGE) {
        *value = __builtin_nan("");
    } else if (!burnish_chunk_takes(p->chunk, word, &number) && p->ply->by_lines) {
        *value = __builtin_nan(""); /* the row is known to end with its line */
        p->bad_row = row_number(p);
        return burnish_chunk_pardon(p->chunk, 0, word.bytes, "%s",
                                    burnish_describe_number("value", word, number).text);
    } else if (number != BURNISH_NUMBER_OK) {
        FAIL(p, "%s", burnish_describe_number("value", word, number).text);
        return 0;
    }
    return 1;
}

static inline int read_value(ply_parser *p, burnish_ply_encoding encoding, burnish_ply_type type,
                             double *value) {
    if (encoding == BURNISH_PLY_ASCII) {
        return read_word(p, value);
    }
    const size_t size = burnish_ply_type_size(type);
    p->value_at = p->lexer.next;
    if (bytes_left(p) < size) {
        return fail_truncated(p);
    }
    *value = burnish_ply_load(p->lexer.next, type, encoding == BURNISH_PLY_BIG_ENDIAN);
    p->lexer.next += size;
    return 1;
}

/* The same for what should be a count or an index. */
static inline int read_count(ply_parser *p, burnish_ply_encoding encoding, burnish_ply_type type,
                             double *value) {
    uint64_t count;
    if (encoding != BURNISH_PLY_ASCII || !burnish_lexer_count(&p->lexer, &count)) {
        return read_value(p, encoding, type, value);
    }
    *value = (double)count;
    return 1;
}

static int skip_values(ply_parser *p, burnish_ply_type type, uint64_t count) {
    p->value_at = p->lexer.next;
    if (count > values_left(p, type)) {
        return fail_truncated(p);
    }
    if (p->ply->header.encoding != BURNISH_PLY_ASCII) {
        p->lexer.next += count * burnish_ply_type_size(type);
        return 1;
    }
    for (; count > 0; --count) {
        burnish_token word;
        if (!burnish_lexer_word(&p->lexer, &word)) {
            return fail_truncated(p);
        }
    }
    return 1;
}

static inline int read_length(ply_parser *p, burnish_ply_encoding encoding,
                              const burnish_ply_property *property, uint64_t *count) {
    double value;
    if (!read_count(p, encoding, property->count_type, &value)) {
        return 0;
    }
    *count = value >= 0 && value <= UINT32_MAX ? (uint64_t)value : UINT64_MAX;
    if ((double)*count != value) {
        FAIL(p, "element %s, row %llu: list length %g is not a count; repair the file",
             burnish_token_quote(p->ply->element->name).text, row_number(p), value);
        return 0;
    }
    if (*count > values_left(p, property->type)) {
        FAIL(p,
             "element %s, row %llu: a list of %llu values does not fit %s; the file is truncated "
             "or damaged",
             burnish_token_quote(p->ply->element->name).text, row_number(p),
             (unsigned long long)*count, p->ply->by_lines ? "its line" : "the rest of the file");
        return 0;
    }
    return 1;
}

static int pardon_corner(ply_parser *p, double index) {
    return p->bad_row == row_number(p) ||
           burnish_chunk_pardon(p->chunk, 1, HERE(p),
                                "element %s, row %llu: vertex index %.10g is out of range; there "
                                "are %zu vertices, counted "
                                "from 0",
                                burnish_token_quote(p->ply->element->name).text, row_number(p),
                                index, p->ply->vertex_count);
}

/* Reads corners into the chunk's scratch array. -1 in a strip starts a new one, and so does a corner
 * without a vertex; *is_bad: 1 if there is one. */
static inline int read_corners(ply_parser *p, burnish_ply_encoding encoding,
                               const burnish_ply_property *property, size_t count, int *is_bad) {
    const double vertex_count = (double)p->ply->vertex_count;
    uint32_t *corners = burnish_chunk_scratch(p->chunk, count);
    for (size_t i = 0; i < count; ++i) {
        double value;
        if (!corners || !read_count(p, encoding, property->type, &value)) {
            return 0;
        }
        const int inside = value >= 0 && value < vertex_count;
        const uint32_t index = inside ? (uint32_t)value : BURNISH_NONE;
        const int restart = value == -1 && p->ply->element->kind == BURNISH_PLY_ELEMENT_STRIPS;
        if (!restart && (!inside || (double)index != value)) {
            if (!*is_bad && !pardon_corner(p, value)) {
                return 0;
            }
            *is_bad = 1;
            corners[i] = BURNISH_NONE;
            continue;
        }
        corners[i] = index;
    }
    return corners || count == 0;
}

static void write_color(const burnish_ply_type types[BURNISH_PLY_ROLE_COUNT],
                        const double values[BURNISH_PLY_ROLE_COUNT], uint8_t *rgba) {
    for (int i = 0; i < 4; ++i) {
        const burnish_ply_type type = types[BURNISH_PLY_RED + i];
        rgba[i] = type == BURNISH_PLY_NONE
                      ? 255
                      : burnish_ply_to_color(values[BURNISH_PLY_RED + i], type);
    }
}

/* The colour in one number: its low 24 bits, or the bits of a float. */
static void unpack_color(const ply_parser *p, double values[BURNISH_PLY_ROLE_COUNT]) {
    const double packed = values[BURNISH_PLY_PACKED];
    const int is_float = p->ply->types[BURNISH_PLY_PACKED] == BURNISH_PLY_FLOAT32 &&
                         packed > -FLT_MAX && packed < 1; /* others are written as whole numbers */
    uint32_t bits = packed >= 0 && packed <= UINT32_MAX ? (uint32_t)packed : 0xFFFFFF;
    const float single = is_float ? (float)packed : 0;
    if (is_float) {
        memcpy(&bits, &single, sizeof bits);
    }
    for (int i = 0; i < 3; ++i) {
        values[BURNISH_PLY_RED + i] = bits >> 8 * (2 - i) & 255;
    }
}

/* Appends a vertex; values by role. */
static void append_vertex(ply_parser *p, const double values[BURNISH_PLY_ROLE_COUNT]) {
    burnish_chunk *chunk = p->chunk;
    const burnish_ply_state *ply = p->ply;
    float *to = burnish_chunk_append(chunk, BURNISH_POSITION);
    for (int i = 0; i < 3 && to; ++i) {
        to[i] = __builtin_nanf("");
        burnish_place(values[BURNISH_PLY_X + i], ply->reader->mesh->origin[i], &to[i]);
    }
    if (p->has_normals) {
        to = burnish_chunk_append(chunk, BURNISH_NORMAL);
        for (int i = 0; i < 3 && to; ++i) { /* build generates a normal of 0 */
            to[i] = 0;
            burnish_double_to_float(values[BURNISH_PLY_NX + i], &to[i]);
        }
    }
    if (p->has_coordinates) {
        to = burnish_chunk_append(chunk, BURNISH_TEXCOORD);
        for (int i = 0; i < 2 && to; ++i) {
            to[i] = 0;
            burnish_double_to_float(values[BURNISH_PLY_S + i], &to[i]);
        }
    }
    if (p->has_splats) {
        to = burnish_chunk_append(chunk, BURNISH_SPLAT);
        for (int i = BURNISH_PLY_SCALE; i <= BURNISH_PLY_OPACITY && to; ++i, ++to) {
            if (!burnish_double_to_float(values[i], to)) {
                *to = burnish_splat_odd(values[i], i == BURNISH_PLY_OPACITY);
            }
        }
    }
    if (p->has_colors) {
        uint8_t *rgba = burnish_chunk_append(chunk, BURNISH_COLOR);
        if (rgba) {
            write_color(ply->types, values, rgba);
        }
    }
}

/* Triangles of three successive corners, every second one reversed. Triangles that only turn the
 * strip (two equal corners) are skipped. */
static void append_strips(ply_parser *p, const uint8_t *at, const uint32_t *corners, size_t count) {
    size_t start = 0;
    for (size_t i = 0; i < count && p->chunk->status == BURNISH_STATUS_OK; ++i) {
        if (corners[i] == BURNISH_NONE) {
            start = i + 1;
            continue;
        }
        if (i < start + 2) {
            continue;
        }
        const size_t odd = (i - start) & 1;
        const uint32_t triangle[3] = {corners[i - 2 + odd], corners[i - 1 - odd], corners[i]};
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] &&
            triangle[2] != triangle[0]) {
            burnish_chunk_append_face(p->chunk, at, triangle, 1, 3, 1u << BURNISH_POSITION);
        }
    }
}

/* One colour per triangle of a face of `count` corners. */
static void append_face_color(ply_parser *p, const double values[BURNISH_PLY_ROLE_COUNT],
                              size_t count) {
    for (size_t i = 2; i < count && p->chunk->status == BURNISH_STATUS_OK; ++i) {
        uint8_t *rgba = burnish_chunk_append(p->chunk, BURNISH_COLOR);
        if (rgba) {
            write_color(p->ply->face_types, values, rgba);
        }
    }
}

/* A number of the list texcoord; 0 if it is invalid. */
static float read_coordinate(ply_parser *p, burnish_ply_encoding encoding, burnish_ply_type type) {
    burnish_token word;
    burnish_number_status number = BURNISH_NUMBER_OK;
    double value = 0;
    float coordinate = 0;
    if (encoding == BURNISH_PLY_ASCII) {
        burnish_lexer_word_double(&p->lexer, &word, &value, &number);
    } else {
        value = burnish_ply_load(p->lexer.next, type, encoding == BURNISH_PLY_BIG_ENDIAN);
        p->lexer.next += burnish_ply_type_size(type);
    }
    if (number == BURNISH_NUMBER_OK) {
        burnish_double_to_float(value, &coordinate);
    }
    return coordinate;
}

/* Texture coordinates of each triangle of a face's fan; 0, 0 if the row has another number of
 * them. */
static void append_coordinates(ply_parser *p, burnish_ply_encoding encoding, const face_row *face) {
    const uint8_t *after = p->lexer.next;
    const int are_there = face->coordinate_count == 2 * (uint64_t)face->corner_count;
    float uv[3][2] = {{0, 0}, {0, 0}, {0, 0}}; /* of the first corner, the last and this one */
    p->lexer.next = are_there ? face->coordinates : after;
    for (size_t i = 0; i < face->corner_count && p->chunk->status == BURNISH_STATUS_OK; ++i) {
        memcpy(uv[1], uv[2], sizeof uv[1]);
        for (int k = 0; k < 2 && are_there; ++k) {
            uv[2][k] = read_coordinate(p, encoding, face->coordinate_type);
        }
        if (i == 0) {
            memcpy(uv[0], uv[2], sizeof uv[0]);
        }
        for (int corner = 0; corner < 3 && i >= 2; ++corner) {
            float *to = burnish_chunk_append(p->chunk, BURNISH_TEXCOORD);
            if (to) {
                memcpy(to, uv[corner], sizeof uv[corner]);
            }
        }
    }
    p->lexer.next = after;
}

static void append_corners(ply_parser *p, const uint8_t *at, size_t count) {
    const uint32_t *corners = p->chunk->scratch;
    if (p->ply->element->kind == BURNISH_PLY_ELEMENT_STRIPS) {
        append_strips(p, at, corners, count);
    } else if (count < 3) {
        burnish_chunk_note(p->chunk, FEW_CORNERS, at);
    } else {
        burnish_chunk_append_face(p->chunk, at, corners, 1, count, 1u << BURNISH_POSITION);
    }
}

static int at_line_end(ply_parser *p) {
    while (p->lexer.next < p->lexer.end && burnish_is_blank(*p->lexer.next)) {
        ++p->lexer.next;
    }
    return p->lexer.next == p->lexer.end || burnish_is_line_end(*p->lexer.next);
}

/* The default of a missing value: white for colours, 0 for the rest. */
static double missing_value(const burnish_ply_property *property) {
    return property->role < BURNISH_PLY_RED || property->role > BURNISH_PLY_ALPHA ? 0
           : property->type >= BURNISH_PLY_FLOAT32                                ? 1
                                                                                  : 65535;
}

/* Appends a face's triangles and their attributes. */
static inline void append_face(ply_parser *p, burnish_ply_encoding encoding,
                               const double values[BURNISH_PLY_ROLE_COUNT], const face_row *face) {
    const int is_face = p->ply->element->kind == BURNISH_PLY_ELEMENT_FACE;
    if (is_face && face->is_bad) {
        return;
    }
    if (is_face && face->corner_count >= 3 && p->ply->takes_textures &&
        face->texture != p->texture) {
        burnish_chunk_note(p->chunk, TEXTURE + face->texture, p->lexer.next);
        p->texture = face->texture;
    }
    append_corners(p, HERE(p), face->corner_count);
    if (is_face && p->ply->takes_face_colors) {
        append_face_color(p, values, face->corner_count);
    }
    if (is_face && p->ply->takes_face_coordinates) {
        append_coordinates(p, encoding, face);
    }
}

/* texnumber: which of the header's textures the face shows. */
static inline int read_texture(ply_parser *p, burnish_ply_encoding encoding,
                               const burnish_ply_property *property, int *texture) {
    double value;
    if (!read_value(p, encoding, property->type, &value)) {
        return 0;
    }
    *texture =
        value >= 0 && value < BURNISH_PLY_TEXTURES_MAX ? (int)value : BURNISH_PLY_TEXTURES_MAX;
    return 1;
}

/* A face of three corners, and nothing else, in one line of text, as most are. Returns 0, and moves
 * nothing, for any other row. */
static int read_triangle(ply_parser *p) {
    const burnish_ply_element *element = p->ply->element;
    burnish_lexer lexer = p->lexer;
    uint64_t count, index;
    uint32_t corners[3];
    if (element->kind != BURNISH_PLY_ELEMENT_FACE || element->property_count != 1 ||
        p->ply->by_lines || !burnish_lexer_count(&lexer, &count) || count != 3) {
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        if (!burnish_lexer_count(&lexer, &index) || index >= p->ply->vertex_count) {
            return 0;
        }
        corners[i] = (uint32_t)index;
    }
    p->lexer = lexer;
    burnish_chunk_append_face(p->chunk, HERE(p), corners, 1, 3, 1u << BURNISH_POSITION);
    return 1;
}

/* A property that is a column of the row. Returns 0 after an error. */
static inline int read_column(ply_parser *p, burnish_ply_encoding encoding,
                              const burnish_ply_property *property, double *value) {
    float unused;
    if (!read_value(p, encoding, property->type, value)) {
        return 0;
    }
    if (property->role <= BURNISH_PLY_Z && !burnish_double_to_float(*value, &unused)) {
        *value = __builtin_nan("");
        const int is_new = p->bad_row != row_number(p);
        p->bad_row = row_number(p);
        return !is_new || p->ply->header.may_lack ||
               burnish_chunk_pardon(
                   p->chunk, 0, HERE(p),
                   "vertex %llu: coordinate %c is not finite or beyond 3.4e38; repair the mesh",
                   row_number(p) - 1, 'x' + (int)property->role);
    }
    return 1;
}

/* Any other property. */
static inline int read_other(ply_parser *p, burnish_ply_encoding encoding,
                             const burnish_ply_property *property, face_row *face) {
    uint64_t count = 1;
    if (property->count_type != BURNISH_PLY_NONE && !read_length(p, encoding, property, &count)) {
        return 0;
    }
    if (property->role == BURNISH_PLY_CORNERS) {
        face->corner_count = (size_t)count;
        return read_corners(p, encoding, property, face->corner_count, &face->is_bad);
    }
    if (property->role == BURNISH_PLY_TEXNUMBER) {
        return read_texture(p, encoding, property, &face->texture);
    }
    if (property->role == BURNISH_PLY_TEXCOORDS) {
        face->coordinates = p->lexer.next;
        face->coordinate_type = property->type;
        face->coordinate_count = count;
    }
    return skip_values(p, property->type, count);
}

/* Whether a line has ended before a property that it may lack. */
static inline int is_missing(ply_parser *p, const burnish_ply_property *property) {
    return p->ply->by_lines && property->role > BURNISH_PLY_Z &&
           property->role != BURNISH_PLY_CORNERS && at_line_end(p);
}

/* One row, whatever its element; returns 0 after an error. */
static inline int read_row(ply_parser *p, burnish_ply_encoding encoding) {
    const burnish_ply_element *element = p->ply->element;
    const burnish_ply_property *property = p->ply->header.properties + element->first_property;
    const burnish_ply_property *end = property + element->property_count;
    double values[BURNISH_PLY_ROLE_COUNT];
    face_row face = {.corner_count = 0};
    values[BURNISH_PLY_T] = 0; /* a quantity to colour by is S alone */
    if (encoding == BURNISH_PLY_ASCII && read_triangle(p)) {
        return p->chunk->status == BURNISH_STATUS_OK;
    }
    for (; property < end; ++property) {
        const int is_column = property->role < BURNISH_PLY_ROLE_COUNT;
        if (is_missing(p, property)) {
            if (is_column) {
                values[property->role] = missing_value(property);
            }
            p->is_short = 1;
        } else if (!(is_column ? read_column(p, encoding, property, &values[property->role])
                               : read_other(p, encoding, property, &face))) {
            return 0;
        }
    }
    if (element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
        if (p->ply->types[BURNISH_PLY_PACKED] != BURNISH_PLY_NONE) {
            unpack_color(p, values);
        }
        append_vertex(p, values);
    } else if (element->kind != BURNISH_PLY_ELEMENT_OTHER) {
        append_face(p, encoding, values, &face);
    }
    return p->chunk->status == BURNISH_STATUS_OK;
}

/* A row of an ASCII file that is a line. */
static int read_line_row(ply_parser *p) {
    const uint8_t *first = p->lexer.next, *text_end = p->lexer.end;
    p->lexer.end = burnish_ply_line_end(first, text_end);
    p->is_short = 0;
    const int good = read_row(p, BURNISH_PLY_ASCII);
    if (good && p->bad_row != row_number(p) && (p->is_short || !at_line_end(p))) {
        burnish_chunk_note(p->chunk, FIELDS, first);
    }
    p->lexer.next = good ? p->lexer.end : p->lexer.next;
    p->lexer.end = text_end;
    return good && p->chunk->status == BURNISH_STATUS_OK;
}

/* Rows that begin before the chunk's end. In ASCII, a row that reaches beyond the start that was
 * found shows that rows are not lines there. */
static inline void parse_rows(ply_parser *p, burnish_ply_encoding encoding) {
    burnish_chunk *chunk = p->chunk;
    while (chunk->rows < chunk->rows_left) {
        if (encoding == BURNISH_PLY_ASCII) {
            burnish_lexer_skip_blank_lines(&p->lexer);
        }
        if (p->ply->header.is_open && p->lexer.next < chunk->end &&
            (*p->lexer.next == '#' || *p->lexer.next == '/')) {
            burnish_lexer_rest(&p->lexer); /* a comment */
            continue;
        }
        if (p->lexer.next >= chunk->end ||
            !(encoding == BURNISH_PLY_ASCII && p->ply->by_lines ? read_line_row(p)
                                                                : read_row(p, encoding))) {
            break;
        }
        chunk->is_odd |= encoding == BURNISH_PLY_ASCII && !at_line_end(p);
        if (chunk->bounded && p->lexer.next > chunk->end) {
            chunk->status = BURNISH_STATUS_FORMAT;
            return;
        }
        ++chunk->rows;
        chunk->rows_end = p->lexer.next;
    }
    if (!chunk->bounded) {
        chunk->end = p->lexer.next;
    }
}

static void ply_parse_rows(const void *state, burnish_chunk *chunk) {
    const burnish_ply_state *ply = state;
    ply_parser p = {.ply = ply,
                    .chunk = chunk,
                    .lexer = {chunk->first, chunk->text_end, 0},
                    .value_at = chunk->first,
                    .texture = -1,
                    .has_normals = burnish_ply_has_roles(ply, BURNISH_PLY_NX, BURNISH_PLY_NZ),
                    .has_coordinates = burnish_ply_has_roles(ply, BURNISH_PLY_S, BURNISH_PLY_T),
                    .has_colors = burnish_ply_has_roles(ply, BURNISH_PLY_RED, BURNISH_PLY_BLUE),
                    .has_splats =
                        burnish_ply_has_roles(ply, BURNISH_PLY_SCALE, BURNISH_PLY_OPACITY)};
    switch (ply->header.encoding) {
    case BURNISH_PLY_ASCII:
        parse_rows(&p, BURNISH_PLY_ASCII);
        break;
    case BURNISH_PLY_LITTLE_ENDIAN:
        parse_rows(&p, BURNISH_PLY_LITTLE_ENDIAN);
        break;
    case BURNISH_PLY_BIG_ENDIAN:
        parse_rows(&p, BURNISH_PLY_BIG_ENDIAN);
        break;
    }
}

static burnish_status ply_accept_rows(void *state, const burnish_chunk *chunk) {
    burnish_ply_state *ply = state;
    burnish_status status = BURNISH_STATUS_OK;
    ply->is_odd |= chunk->is_odd;
    for (size_t i = 0; i < chunk->event_count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_chunk_event *event = &chunk->events[i];
        if (event->kind == FIELDS) {
            burnish_reader_note(ply->reader, &ply->fields, event->at,
                                "the line has more or fewer values than %s",
                                ply->header.is_open ? "the first one" : "the header says");
        } else if (event->kind == FEW_CORNERS) {
            burnish_reader_note(ply->reader, &ply->few_corners, event->at,
                                "a face with fewer than 3 corners was ignored");
        } else {
            status = burnish_ply_use_texture(ply, chunk->triangles_before + event->triangle,
                                             event->kind - TEXTURE);
        }
    }
    return status;
}

burnish_status burnish_ply_read_rows(burnish_ply_state *ply, const uint8_t **at, size_t rows) {
    const burnish_grammar grammar = {
        .find_start = ply->header.encoding == BURNISH_PLY_ASCII ? burnish_chunk_find_line : NULL,
        .parse = ply_parse_rows,
        .accept = ply_accept_rows,
        .indexed = 1u << BURNISH_POSITION | ply->per_triangle};
    size_t missing = rows;
    burnish_status status = burnish_chunks_read(&grammar, ply, ply->reader, at, &missing);
    if (status == BURNISH_STATUS_OK && missing > 0 && !ply->header.is_open) {
        status = burnish_reader_fail(
            ply->reader, BURNISH_STATUS_FORMAT, *at,
            "the file ends in element %s, row %llu of %llu; the file is truncated",
            burnish_token_quote(ply->element->name).text,
            (unsigned long long)(ply->element->count - missing + 1),
            (unsigned long long)ply->element->count);
    }
    return status;
}
