/* PLY (G. Turk, "The PLY Polygon File Format", 1994): the body, element by element.
 *
 * Rows are read one after the other, in chunks, by one decoder that is compiled for each of the
 * three encodings. Binary rows that all have one size need no decoding to be found: those of
 * vertices are converted column by column, those of triangles at once, by all threads.
 *
 * Rows of an ASCII file are values, wherever lines end. But where lines do not hold what the header
 * says, values are left over, and there are as many lines as rows, rows are lines: what is missing
 * at their ends is made up, what is too much ignored. */
#include "mesh/read/ply.h"
#include "mesh/read/chunks.h"
#include "mesh/read/points.h"
#include "mesh/read/textures.h"

enum { FEW_CORNERS, FIELDS }; /* the events of a chunk */

typedef struct ply_state {
    burnish_reader *reader;
    burnish_ply_header header;
    const burnish_ply_element *element; /* being read */
    size_t first_row;                   /* rows of it that were read by other means */
    size_t vertex_count;
    burnish_ply_type types[BURNISH_PLY_ROLE_COUNT];      /* of a vertex; NONE: not there */
    burnish_ply_type face_types[BURNISH_PLY_ROLE_COUNT]; /* of a face's colours */
    int takes_face_colors; /* 1: each triangle appends its face's colour */
    burnish_warning_group few_corners, fields;
    int by_lines;       /* rows are lines of an ASCII file, whatever they hold */
    atomic_int *is_odd; /* becomes 1 where a line does not hold a row */
} ply_state;

static int has_roles(const ply_state *ply, int first, int last) {
    for (int role = first; role <= last; ++role) {
        if (ply->types[role] == BURNISH_PLY_NONE) {
            return 0;
        }
    }
    return 1;
}

/* ---- Rows of any kind ---- */

typedef struct ply_parser {
    const ply_state *ply;
    burnish_chunk *chunk;
    burnish_lexer lexer;
    const uint8_t *value_at; /* of a binary value, for messages */
    int is_short;            /* the line at hand has fewer values than the row */
} ply_parser;

/* Where a message points to: a binary value's first byte, the end of a word. */
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

/* The row at hand, counted from 1. */
static unsigned long long row_number(const ply_parser *p) {
    return p->ply->first_row + p->chunk->rows_before + p->chunk->rows + 1;
}

static int fail_truncated(ply_parser *p) {
    FAIL(p, "the %s ends in element %s, row %llu of %llu; the file is truncated",
         p->ply->by_lines ? "line" : "file", burnish_token_quote(p->ply->element->name).text,
         row_number(p), (unsigned long long)p->ply->element->count);
    return 0;
}

/* An ASCII value. What is not finite is NaN: whether that matters is the property's to say. */
static int read_word(ply_parser *p, double *value) {
    burnish_token word;
    burnish_number_status number;
    if (!burnish_lexer_word_double(&p->lexer, &word, value, &number)) {
        return fail_truncated(p);
    }
    if (number == BURNISH_NUMBER_NOT_FINITE || number == BURNISH_NUMBER_RANGE) {
        *value = __builtin_nan("");
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
        FAIL(p, "element %s, row %llu: list length %g is no count; repair the file",
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

/* Into the chunk's scratch array; a strip may hold -1, which starts a new one. */
static inline int read_corners(ply_parser *p, burnish_ply_encoding encoding,
                               const burnish_ply_property *property, size_t count) {
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
            FAIL(p,
                 "element %s, row %llu: vertex index %.10g is out of range; there are %zu "
                 "vertices, counted from 0",
                 burnish_token_quote(p->ply->element->name).text, row_number(p), value,
                 p->ply->vertex_count);
            return 0;
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

/* Appends a vertex; values by role. */
static void append_vertex(ply_parser *p, const double values[BURNISH_PLY_ROLE_COUNT]) {
    burnish_chunk *chunk = p->chunk;
    const ply_state *ply = p->ply;
    float *to = burnish_chunk_append(chunk, BURNISH_POSITION);
    for (int i = 0; i < 3 && to; ++i) {
        burnish_double_to_float(values[BURNISH_PLY_X + i], &to[i]);
    }
    if (has_roles(ply, BURNISH_PLY_NX, BURNISH_PLY_NZ)) {
        to = burnish_chunk_append(chunk, BURNISH_NORMAL);
        for (int i = 0; i < 3 && to; ++i) { /* build makes a normal that is 0 */
            to[i] = 0;
            burnish_double_to_float(values[BURNISH_PLY_NX + i], &to[i]);
        }
    }
    if (has_roles(ply, BURNISH_PLY_S, BURNISH_PLY_T)) {
        to = burnish_chunk_append(chunk, BURNISH_TEXCOORD);
        for (int i = 0; i < 2 && to; ++i) {
            to[i] = 0;
            burnish_double_to_float(values[BURNISH_PLY_S + i], &to[i]);
        }
    }
    if (has_roles(ply, BURNISH_PLY_RED, BURNISH_PLY_BLUE)) {
        uint8_t *rgba = burnish_chunk_append(chunk, BURNISH_COLOR);
        if (rgba) {
            write_color(ply->types, values, rgba);
        }
    }
}

/* Triangles between three corners in a row, every second one the other way round; those that only
 * turn the strip (two corners the same) are left out. */
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

/* What a value is that its line does not have: colours are white, the rest 0. */
static double missing_value(const burnish_ply_property *property) {
    return property->role < BURNISH_PLY_RED || property->role > BURNISH_PLY_ALPHA ? 0
           : property->type >= BURNISH_PLY_FLOAT32                                ? 1
                                                                                  : 65535;
}

/* One row, whatever its element; returns 0 after an error. */
static inline int read_row(ply_parser *p, burnish_ply_encoding encoding) {
    const burnish_ply_element *element = p->ply->element;
    const burnish_ply_property *property = p->ply->header.properties + element->first_property;
    const burnish_ply_property *end = property + element->property_count;
    double values[BURNISH_PLY_ROLE_COUNT];
    size_t corner_count = 0;
    for (; property < end; ++property) {
        uint64_t count = 1;
        if (p->ply->by_lines && property->role > BURNISH_PLY_Z &&
            property->role != BURNISH_PLY_CORNERS && at_line_end(p)) {
            if (property->role < BURNISH_PLY_ROLE_COUNT) {
                values[property->role] = missing_value(property);
            }
            p->is_short = 1;
            continue;
        }
        if (property->role < BURNISH_PLY_ROLE_COUNT) {
            float unused;
            if (!read_value(p, encoding, property->type, &values[property->role])) {
                return 0;
            }
            if (property->role <= BURNISH_PLY_Z &&
                !burnish_double_to_float(values[property->role], &unused)) {
                FAIL(p,
                     "vertex %llu: coordinate %c is not finite or beyond 3.4e38; repair the mesh",
                     row_number(p) - 1, 'x' + (int)property->role);
                return 0;
            }
            continue;
        }
        if (property->count_type != BURNISH_PLY_NONE &&
            !read_length(p, encoding, property, &count)) {
            return 0;
        }
        if (property->role == BURNISH_PLY_CORNERS) {
            corner_count = (size_t)count;
            if (!read_corners(p, encoding, property, corner_count)) {
                return 0;
            }
        } else if (!skip_values(p, property->type, count)) {
            return 0;
        }
    }
    if (element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
        append_vertex(p, values);
    } else if (element->kind != BURNISH_PLY_ELEMENT_OTHER) {
        append_corners(p, HERE(p), corner_count);
        if (p->ply->takes_face_colors && element->kind == BURNISH_PLY_ELEMENT_FACE) {
            append_face_color(p, values, corner_count);
        }
    }
    return p->chunk->status == BURNISH_STATUS_OK;
}

static const uint8_t *find_line_end(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = memchr(from, '\n', (size_t)(end - from));
    const uint8_t *last = newline ? newline : end;
    const uint8_t *other = memchr(from, '\r', (size_t)(last - from));
    return other ? other : last;
}

/* A row of an ASCII file that is a line. */
static int read_line_row(ply_parser *p) {
    const uint8_t *first = p->lexer.next, *text_end = p->lexer.end;
    p->lexer.end = find_line_end(first, text_end);
    p->is_short = 0;
    const int good = read_row(p, BURNISH_PLY_ASCII);
    if (good && (p->is_short || !at_line_end(p))) {
        burnish_chunk_note(p->chunk, FIELDS, first);
    }
    p->lexer.next = good ? p->lexer.end : p->lexer.next;
    p->lexer.end = text_end;
    return good && p->chunk->status == BURNISH_STATUS_OK;
}

/* Rows that begin before the chunk's end. In ASCII one that reaches beyond a start that was found
 * shows that rows are no lines there. */
static inline void parse_rows(ply_parser *p, burnish_ply_encoding encoding) {
    burnish_chunk *chunk = p->chunk;
    while (chunk->rows < chunk->rows_left) {
        if (encoding == BURNISH_PLY_ASCII) {
            burnish_lexer_skip_blank_lines(&p->lexer);
        }
        if (p->lexer.next >= chunk->end ||
            !(encoding == BURNISH_PLY_ASCII && p->ply->by_lines ? read_line_row(p)
                                                                : read_row(p, encoding))) {
            break;
        }
        if (encoding == BURNISH_PLY_ASCII && !at_line_end(p)) {
            atomic_store_explicit(p->ply->is_odd, 1, memory_order_relaxed);
        }
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

static void parse(const void *state, burnish_chunk *chunk) {
    const ply_state *ply = state;
    ply_parser p = {ply, chunk, {chunk->first, chunk->text_end, 0}, chunk->first, 0};
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

static const uint8_t *find_line(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = memchr(from, '\n', (size_t)(end - from));
    return newline ? newline + 1 : end;
}

static burnish_status accept(void *state, const burnish_chunk *chunk) {
    ply_state *ply = state;
    for (size_t i = 0; i < chunk->event_count; ++i) {
        if (chunk->events[i].kind == FIELDS) {
            burnish_reader_note(ply->reader, &ply->fields, chunk->events[i].at,
                                "the line has more or fewer values than the header says");
            continue;
        }
        burnish_reader_note(ply->reader, &ply->few_corners, chunk->events[i].at,
                            "a face with fewer than 3 corners was ignored");
    }
    return BURNISH_STATUS_OK;
}

/* Rows of the element at hand from *at on, which moves past them. */
static burnish_status read_rows(ply_state *ply, const uint8_t **at, size_t rows) {
    const burnish_grammar grammar = {
        ply->header.encoding == BURNISH_PLY_ASCII ? find_line : NULL, parse, accept,
        1u << BURNISH_POSITION | (unsigned)ply->takes_face_colors << BURNISH_COLOR, 0};
    size_t missing = rows;
    burnish_status status = burnish_chunks_read(&grammar, ply, ply->reader, at, &missing);
    if (status == BURNISH_STATUS_OK && missing > 0) {
        status = burnish_reader_fail(
            ply->reader, BURNISH_STATUS_FORMAT, *at,
            "the file ends in element %s, row %llu of %llu; the file is truncated",
            burnish_token_quote(ply->element->name).text,
            (unsigned long long)(ply->element->count - missing + 1),
            (unsigned long long)ply->element->count);
    }
    return status;
}

/* ---- Binary rows of one size ---- */

enum { GRAIN = 1 << 13 /* rows that a thread takes at once */ };

/* All values of the vertices, whose rows are all there. What is odd is left for read_rows(). */
static burnish_status read_vertices(ply_state *ply, burnish_ply_rows *rows, const uint8_t **at) {
    static const int last_roles[BURNISH_ATTRIBUTE_COUNT] = {BURNISH_PLY_Z, BURNISH_PLY_NZ,
                                                            BURNISH_PLY_BLUE, BURNISH_PLY_T};
    static const int first_roles[BURNISH_ATTRIBUTE_COUNT] = {BURNISH_PLY_X, BURNISH_PLY_NX,
                                                             BURNISH_PLY_RED, BURNISH_PLY_S};
    burnish_mesh_data *mesh = ply->reader->mesh;
    const size_t count = (size_t)ply->element->count;
    for (int i = 0; i <= BURNISH_TEXCOORD; ++i) {
        if (has_roles(ply, first_roles[i], last_roles[i])) {
            if (burnish_mesh_data_reserve(mesh, (burnish_attribute)i, count) != BURNISH_STATUS_OK) {
                return mesh->memory.status;
            }
            mesh->streams[i].count = count;
        }
    }
    burnish_tasks_ranges(mesh->tasks, count, GRAIN, burnish_ply_convert_vertices, rows);
    const size_t odd = atomic_load(&rows->odd);
    if (odd < count) { /* which has something to say */
        *at += odd * rows->row_size;
        ply->first_row = odd;
        return read_rows(ply, at, count - odd);
    }
    *at += count * rows->row_size;
    return burnish_tasks_check(mesh->tasks, ply->reader->error);
}

static burnish_status convert_face_colors(ply_state *ply, burnish_ply_rows *rows, size_t count) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    burnish_stream *colors = &mesh->streams[BURNISH_COLOR];
    colors->items = burnish_reserve(&mesh->memory, colors->items, &colors->capacity,
                                    rows->first_triangle + count, 4, "colours of faces");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(mesh->tasks, count, GRAIN, burnish_ply_convert_face_colors, rows);
        colors->count = rows->first_triangle + count;
    }
    return mesh->memory.status;
}

/* The triangles that the element begins with; read_rows() goes on from the first row that is
 * something else, where there is one. */
static burnish_status read_triangles(ply_state *ply, burnish_ply_rows *rows, const uint8_t **at) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    const size_t limit = ply->reader->input->options->max_triangles;
    const size_t left = (size_t)(ply->reader->input->bytes + ply->reader->input->size - *at);
    size_t count = (size_t)ply->element->count;
    count = count < left / rows->row_size ? count : left / rows->row_size;
    count = count < limit - mesh->triangle_count ? count : limit - mesh->triangle_count;
    if (count > 0 && burnish_ply_load_count(*at + rows->length.offset, rows->length.type,
                                            rows->big_endian) == 3) {
        positions->corners = burnish_reserve(
            &mesh->memory, positions->corners, &positions->corner_capacity,
            mesh->triangle_count + count, 3 * sizeof *positions->corners, "triangles");
        if (mesh->memory.status != BURNISH_STATUS_OK) {
            return mesh->memory.status;
        }
        atomic_store(&rows->odd, count);
        rows->first_triangle = mesh->triangle_count;
        burnish_tasks_ranges(mesh->tasks, count, GRAIN, burnish_ply_convert_triangles, rows);
        ply->first_row = atomic_load(&rows->odd);
        if (ply->takes_face_colors &&
            convert_face_colors(ply, rows, ply->first_row) != BURNISH_STATUS_OK) {
            return mesh->memory.status;
        }
        mesh->triangle_count += ply->first_row;
        *at += ply->first_row * rows->row_size;
    }
    burnish_status status = burnish_tasks_check(mesh->tasks, ply->reader->error);
    return status == BURNISH_STATUS_OK && ply->first_row < ply->element->count
               ? read_rows(ply, at, (size_t)ply->element->count - ply->first_row)
               : status;
}

/* ---- Elements ---- */

/* What a row consists of: its least size, where its columns stand if all lists have 3 items, and
 * how many lists there are. */
static size_t describe_rows(const ply_state *ply, burnish_ply_rows *rows, size_t *least) {
    const burnish_ply_element *element = ply->element;
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII;
    size_t lists = 0;
    *least = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        const burnish_ply_property *property = &ply->header.properties[element->first_property + i];
        const size_t size = burnish_ply_type_size(property->type);
        const int is_list = property->count_type != BURNISH_PLY_NONE;
        const size_t length = burnish_ply_type_size(property->count_type);
        *least += is_ascii ? 1 : is_list ? length : size;
        if (is_list) {
            rows->length = (burnish_ply_column){rows->row_size, property->count_type};
            rows->corners = (burnish_ply_column){rows->row_size + length, property->type};
            ++lists;
        } else if (property->role < BURNISH_PLY_ROLE_COUNT) {
            rows->columns[property->role] = (burnish_ply_column){rows->row_size, property->type};
        }
        rows->row_size += is_list ? length + 3 * size : size;
    }
    return lists;
}

/* Holds the announced count against the bytes left. */
static burnish_status check_count(const ply_state *ply, size_t left, size_t least) {
    burnish_reader *reader = ply->reader;
    const burnish_ply_element *element = ply->element;
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII, was_binary = reader->is_binary;
    const uint64_t room = least == 0 || ply->by_lines ? UINT64_MAX
                          : is_ascii                  ? (left / 2 + left % 2) / least
                                                      : left / least;
    burnish_status status = BURNISH_STATUS_OK;
    reader->is_binary = 0;
    if (element->count > room) {
        status = burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, element->at,
            "element %s announces %llu rows, but the rest of the file has room for %llu at most; "
            "the file is truncated or damaged",
            burnish_token_quote(element->name).text, (unsigned long long)element->count,
            (unsigned long long)room);
    } else if (element->kind == BURNISH_PLY_ELEMENT_VERTEX &&
               element->count > BURNISH_VALUE_LIMIT) {
        status = burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, element->at,
                                     "%llu vertices are more than %zu; split or simplify the mesh",
                                     (unsigned long long)element->count, BURNISH_VALUE_LIMIT);
    }
    reader->is_binary = was_binary;
    return status;
}

/* Reads or skips one element from *at on. */
static burnish_status read_element(ply_state *ply, const uint8_t **at) {
    const burnish_ply_element *element = ply->element;
    const size_t left = (size_t)(ply->reader->input->bytes + ply->reader->input->size - *at);
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII;
    burnish_ply_rows rows = {.bytes = *at,
                             .big_endian = ply->header.encoding == BURNISH_PLY_BIG_ENDIAN,
                             .vertex_count = ply->vertex_count,
                             .mesh = ply->reader->mesh};
    size_t least;
    const size_t lists = describe_rows(ply, &rows, &least);
    burnish_status status = check_count(ply, left, least);
    if (status != BURNISH_STATUS_OK || least == 0 || element->count == 0) {
        return status;
    }
    atomic_init(&rows.odd, SIZE_MAX);
    ply->first_row = 0;
    if (element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
        for (int i = 0; i < BURNISH_PLY_ROLE_COUNT; ++i) {
            ply->types[i] = rows.columns[i].type;
        }
        if (!burnish_reader_keeps_coordinates(ply->reader, ply->header.texture.size > 0)) {
            ply->types[BURNISH_PLY_S] = BURNISH_PLY_NONE;
        }
    }
    ply->takes_face_colors =
        element->kind == BURNISH_PLY_ELEMENT_FACE && ply->header.has_face_colors &&
        !ply->header.has_vertex_colors &&
        ply->reader->mesh->streams[BURNISH_COLOR].count == ply->reader->mesh->triangle_count;
    for (int i = 0; i < BURNISH_PLY_ROLE_COUNT && ply->takes_face_colors; ++i) {
        ply->face_types[i] = rows.columns[i].type;
    }
    if (!is_ascii && lists == 0 && element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
        return read_vertices(ply, &rows, at);
    }
    if (!is_ascii && lists == 0) { /* no face has none */
        *at += element->count * rows.row_size;
        return BURNISH_STATUS_OK;
    }
    if (!is_ascii && lists == 1 && element->kind == BURNISH_PLY_ELEMENT_FACE &&
        rows.length.type < BURNISH_PLY_FLOAT32 && rows.corners.type < BURNISH_PLY_FLOAT32) {
        return read_triangles(ply, &rows, at);
    }
    return read_rows(ply, at, (size_t)element->count);
}

/* Whether the first line of an element's rows holds one: the rows' ends are looked at as they are
 * read, but rows with fewer values than the header says may end where lines do. */
static int first_line_is_row(const ply_state *ply, const uint8_t *at) {
    const burnish_ply_element *element = ply->element;
    burnish_lexer line = {at, ply->reader->input->bytes + ply->reader->input->size, 0};
    burnish_token token;
    burnish_lexer_skip_blank_lines(&line);
    for (size_t i = 0; i < element->property_count; ++i) {
        int64_t count = 1;
        if (ply->header.properties[element->first_property + i].count_type != BURNISH_PLY_NONE &&
            (!burnish_lexer_token(&line, &token) ||
             burnish_parse_integer(token, &count) != BURNISH_NUMBER_OK)) {
            return 0;
        }
        for (; count > 0; --count) {
            if (!burnish_lexer_token(&line, &token)) {
                return 0;
            }
        }
    }
    return !burnish_lexer_token(&line, &token);
}

/* *left: bytes of an ASCII file after the last row and blanks. */
static burnish_status read_elements(ply_state *ply, size_t *left) {
    const uint8_t *at = ply->header.body,
                  *end = ply->reader->input->bytes + ply->reader->input->size;
    burnish_status status = BURNISH_STATUS_OK;
    ply->few_corners = ply->fields = (burnish_warning_group){0};
    for (size_t i = 0; i < ply->header.element_count && status == BURNISH_STATUS_OK; ++i) {
        ply->element = &ply->header.elements[i];
        if (ply->header.encoding == BURNISH_PLY_ASCII && ply->element->count > 0 &&
            ply->element->property_count > 0 && !first_line_is_row(ply, at)) {
            atomic_store(ply->is_odd, 1);
        }
        status = read_element(ply, &at);
    }
    while (at < end && (burnish_is_blank(*at) || burnish_is_line_end(*at))) {
        ++at;
    }
    *left = (size_t)(end - at);
    return status;
}

/* Whether an ASCII body has as many lines, but for blank ones, as rows. */
static int rows_are_lines(const ply_state *ply) {
    const uint8_t *end = ply->reader->input->bytes + ply->reader->input->size;
    burnish_lexer lexer = {ply->header.body, end, 0};
    uint64_t lines = 0, rows = 0;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        const burnish_ply_element *element = &ply->header.elements[i];
        const uint64_t count = element->property_count > 0 ? element->count : 0;
        rows = rows + count < rows ? UINT64_MAX : rows + count;
    }
    burnish_lexer_skip_blank_lines(&lexer);
    while (lexer.next < end) {
        ++lines;
        lexer.next = find_line_end(lexer.next, end);
        burnish_lexer_skip_blank_lines(&lexer);
    }
    return lines == rows;
}

/* Reads the body once more, from the beginning. */
static burnish_status read_again(ply_state *ply, int by_lines) {
    burnish_reader *reader = ply->reader;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_mesh_data_drop(reader->mesh, (burnish_attribute)i);
    }
    reader->mesh->triangle_count = reader->polygon_count = 0;
    if (reader->error) {
        *reader->error = (burnish_error){0};
    }
    ply->by_lines = by_lines;
    size_t unused;
    return read_elements(ply, &unused);
}

/* Alpha 0 everywhere comes from programs that do not fill it. */
static void check_alpha(const ply_state *ply) {
    const burnish_mesh_data *mesh = ply->reader->mesh;
    const size_t count = mesh->streams[BURNISH_COLOR].count;
    uint8_t *rgba = burnish_colors(mesh);
    const burnish_ply_type *types = ply->takes_face_colors ? ply->face_types : ply->types;
    unsigned any = types[BURNISH_PLY_ALPHA] == BURNISH_PLY_NONE;
    for (size_t i = 0; i < count && !any; ++i) {
        any = rgba[4 * i + 3];
    }
    if (any || count == 0) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        rgba[4 * i + 3] = 255;
    }
    burnish_reader_warn(ply->reader, NULL, "alpha is 0 everywhere: drawn opaque");
}

static burnish_status read_body(ply_state *ply) {
    atomic_int is_odd;
    int has_faces = 0;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        const burnish_ply_element *element = &ply->header.elements[i];
        has_faces |= element->count > 0 && element->kind > BURNISH_PLY_ELEMENT_VERTEX;
        if (element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
            ply->vertex_count = (size_t)element->count;
        }
    }
    ply->reader->is_binary = ply->header.encoding != BURNISH_PLY_ASCII;
    atomic_init(&is_odd, 0);
    ply->is_odd = &is_odd;
    size_t left;
    burnish_status status = read_elements(ply, &left);
    if (!ply->reader->is_binary &&
        (status == BURNISH_STATUS_FORMAT ||
         (status == BURNISH_STATUS_OK && atomic_load(&is_odd) && left > 0)) &&
        rows_are_lines(ply)) {
        const burnish_status first = status;
        status = read_again(ply, 1);
        if (status == BURNISH_STATUS_FORMAT && first == BURNISH_STATUS_OK) {
            status = read_again(ply, 0);
        }
    }
    if (status == BURNISH_STATUS_OK && ply->reader->mesh->triangle_count == 0 && !has_faces &&
        ply->vertex_count > 0) {
        check_alpha(ply);
        status = burnish_make_points(ply->reader, NULL, 0);
    } else if (status == BURNISH_STATUS_OK && ply->reader->mesh->triangle_count == 0) {
        status =
            burnish_reader_fail(ply->reader, BURNISH_STATUS_FORMAT, NULL,
                                has_faces ? "no face has 3 different corners; export the mesh again"
                                          : "no vertices and no faces; export the mesh again");
    }
    return status;
}

/* comment TextureFile NAME: the colour of all. */
static burnish_status load_texture(const ply_state *ply) {
    const burnish_token file = ply->header.texture;
    burnish_mesh_data *mesh = ply->reader->mesh;
    char name[1024];
    if (file.size == 0 || file.size >= sizeof name ||
        ply->reader->input->options->ignore_textures) {
        return BURNISH_STATUS_OK;
    }
    if (mesh->streams[BURNISH_TEXCOORD].count == 0) {
        burnish_reader_warn(ply->reader, file.bytes,
                            "texture \"%s\" is left out: vertices have no s and t",
                            burnish_token_quote(file).text);
        return BURNISH_STATUS_OK;
    }
    memcpy(name, file.bytes, file.size);
    name[file.size] = 0;
    const int number = burnish_reader_load_texture(ply->reader, file.bytes, name, 1);
    if (number > 0) {
        mesh->materials = burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity,
                                          1, sizeof *mesh->materials, "materials");
    }
    if (mesh->memory.status == BURNISH_STATUS_OK && number > 0) {
        burnish_material *material = &mesh->materials[0];
        *material = burnish_material_default();
        material->has_diffuse = 1;
        for (int k = 0; k < 3; ++k) {
            material->ambient[k] = material->diffuse[k] = 1;
        }
        material->textures[BURNISH_TEXTURE_COLOR].texture = number;
        mesh->material_count = 1;
    }
    return mesh->memory.status;
}

/* Says what of the file is not drawn or kept. */
static void warn_undrawn(const ply_state *ply) {
    burnish_reader_warn_group(ply->reader, &ply->few_corners);
    burnish_reader_warn_group(ply->reader, &ply->fields);
    if (ply->header.has_face_colors && !ply->takes_face_colors) {
        burnish_reader_warn(ply->reader, NULL, "colours of faces are not drawn%s",
                            ply->header.has_vertex_colors ? ", those of vertices are" : "");
    }
    if (ply->header.has_face_coordinates && ply->reader->input->options->keep_texture_coordinates) {
        burnish_reader_warn(ply->reader, NULL,
                            "texture coordinates of faces (texcoord) are not read");
    }
}

/* Gives each triangle the colour that was read for it, where all have one. */
static burnish_status settle_face_colors(ply_state *ply) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    burnish_stream *colors = &mesh->streams[BURNISH_COLOR];
    ply->takes_face_colors = 0;
    if (ply->header.has_vertex_colors || colors->count == 0) {
        return BURNISH_STATUS_OK;
    }
    if (colors->count != mesh->triangle_count) {
        burnish_mesh_data_drop(mesh, BURNISH_COLOR);
        return BURNISH_STATUS_OK;
    }
    ply->takes_face_colors = 1;
    burnish_status status =
        burnish_mesh_data_reserve_corners(mesh, BURNISH_COLOR, mesh->triangle_count);
    for (size_t i = 0; i < 3 * mesh->triangle_count && status == BURNISH_STATUS_OK; ++i) {
        colors->corners[i] = (uint32_t)(i / 3);
    }
    return status;
}

burnish_status burnish_read_ply(burnish_reader *reader) {
    ply_state ply = {.reader = reader};
    burnish_status status = burnish_ply_read_header(reader, &ply.header);
    if (status == BURNISH_STATUS_OK) {
        status = read_body(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        status = settle_face_colors(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        check_alpha(&ply);
        warn_undrawn(&ply);
        status = load_texture(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_cut_polygons(reader);
    }
    burnish_ply_destroy_header(reader->mesh->memory.context, &ply.header);
    return status;
}

/* Sure by its first line. */
int burnish_recognise_ply(const uint8_t *bytes, size_t size) {
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r') ? 2
                                                                                               : 0;
}
