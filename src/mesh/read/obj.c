/* OBJ (Wavefront, "Object Files", 1992): v, vn, vt, f, usemtl, mtllib; polygons; indices from
 * either end, of values that stand anywhere in the file.
 *
 * l and p, curves and surfaces and statements of other programs are passed over, with a warning
 * each; o, g, s and others that make nothing without one. Vertex colours
 * follow the coordinates (v x y z r g b). */
#include "mesh/read/chunks.h"
#include "mesh/read/obj_materials.h"
#include "mesh/read/points.h"
#include "mesh/read/textures.h"

/* What is done in the order of the file. */
enum { MATERIAL, LIBRARY, ELEMENT, FEW_CORNERS, COLOR, NORMAL, OTHER };

/* Numbers of a corner: those of its attributes, by attribute. No corner has a colour of its own, so
 * that in its column stands which of the others are relative, as bits 1 << attribute. */
enum { COLUMNS = BURNISH_TEXCOORD + 1, RELATIVE = BURNISH_COLOR };

typedef struct obj_state {
    burnish_reader *reader;
    int with_texcoords;
    burnish_obj_materials materials;
    size_t triangle;           /* those before it have their run of one material */
    burnish_segment *segments; /* of lines, while no face has been seen */
    size_t segment_count, segment_capacity;
    burnish_warning_group elements, few_corners, colors, normals, free_form, unknown;
    size_t highest[BURNISH_ATTRIBUTE_COUNT]; /* index + 1 that a face refers to; SIZE_MAX: to one
                                                before the first */
} obj_state;

typedef struct obj_parser {
    burnish_chunk *chunk;
    burnish_lexer lexer;
    int with_texcoords;
} obj_parser;

/* ---- Values ---- */

static void fail_number(obj_parser *obj, const char *what, burnish_token token,
                        burnish_number_status number) {
    burnish_chunk_fail(obj->chunk, BURNISH_STATUS_FORMAT, token.bytes, "%s",
                       burnish_describe_number(what, token, number).text);
}

/* Up to `most` numbers of the line; returns how many, -1 after an error in one of the first three,
 * and -2 after one in what follows them. */
static int read_floats(obj_parser *obj, float *values, int most) {
    burnish_token token;
    burnish_number_status number;
    int count = 0;
    while (count < most && burnish_lexer_float(&obj->lexer, &token, &values[count], &number)) {
        if (number != BURNISH_NUMBER_OK && count >= 3) {
            return -2;
        }
        if (number != BURNISH_NUMBER_OK) {
            fail_number(obj, "coordinate", token, number);
            return -1;
        }
        ++count;
    }
    return count;
}

/* While the file is read, alpha says what a colour's numbers counted to, as the file's largest
 * tells only at its end: a vertex without a colour has 255. */
enum { COUNTS_TO_1 = 1, COUNTS_TO_255 = 2 };

/* No colour that counts to 1 is brighter, and one of 2 out of 255 is black. */
static const float BRIGHTEST = 2;

static void store_color(const float color[3], uint8_t *rgba) {
    const int is_large = color[0] > BRIGHTEST || color[1] > BRIGHTEST || color[2] > BRIGHTEST;
    for (int i = 0; i < 3; ++i) {
        const float c = is_large ? color[i] / 255 : color[i];
        rgba[i] = (uint8_t)(c <= 0 ? 0 : c >= 1 ? 255 : c * 255 + 0.5f);
    }
    rgba[3] = is_large ? COUNTS_TO_255 : COUNTS_TO_1;
}

static void append_color(obj_parser *obj, const float color[3]) {
    burnish_chunk *chunk = obj->chunk;
    const size_t positions = chunk->data.streams[BURNISH_POSITION].count;
    do { /* those before it are white */
        uint8_t *rgba = burnish_chunk_append(chunk, BURNISH_COLOR);
        if (!rgba) {
            return;
        }
        memset(rgba, 0xFF, 4);
        if (chunk->data.streams[BURNISH_COLOR].count == positions && color) {
            store_color(color, rgba);
        }
    } while (chunk->data.streams[BURNISH_COLOR].count < positions);
}

static void read_vertex(obj_parser *obj, const uint8_t *at) {
    enum { MOST = 7 }; /* x y z [w], or x y z r g b [a] */
    float values[MOST];
    int count = read_floats(obj, values, MOST);
    if (count == -1) {
        return;
    }
    if (count == -2 || count == 5) {
        burnish_chunk_note(obj->chunk, COLOR, at);
        count = 3;
    }
    if (count < 3) {
        burnish_chunk_fail(obj->chunk, BURNISH_STATUS_FORMAT, obj->lexer.next,
                           "vertex has %d number%s; write v x y z or v x y z r g b", count,
                           count == 1 ? "" : "s");
        return;
    }
    float *position = burnish_chunk_append(obj->chunk, BURNISH_POSITION);
    if (position) {
        memcpy(position, values, 3 * sizeof *position);
        if (count >= 6 || obj->chunk->data.streams[BURNISH_COLOR].count > 0) {
            append_color(obj, count >= 6 ? values + 3 : NULL);
        }
    }
}

/* Numbers that are not finite become 0: exporters write nan for faces without area. What is no
 * normal at all is 0, 0, 0, which is generated again. */
static void read_normal(obj_parser *obj, const uint8_t *at) {
    burnish_token token;
    burnish_number_status number;
    float *normal = burnish_chunk_append(obj->chunk, BURNISH_NORMAL);
    for (int i = 0; i < 3 && normal; ++i) {
        if (!burnish_lexer_float(&obj->lexer, &token, &normal[i], &number) ||
            number == BURNISH_NUMBER_GARBAGE) {
            normal[0] = normal[1] = normal[2] = 0;
            burnish_chunk_note(obj->chunk, NORMAL, at);
            return;
        }
        normal[i] = number == BURNISH_NUMBER_OK ? normal[i] : 0;
    }
}

/* vt u [v [w]]; what can't be read is 0, since nothing is lost but the texture's place. */
static void read_texcoord(obj_parser *obj) {
    burnish_token token;
    burnish_number_status number = BURNISH_NUMBER_OK;
    float *texcoord = burnish_chunk_append(obj->chunk, BURNISH_TEXCOORD);
    for (int i = 0; i < 2 && texcoord; ++i) {
        if (!burnish_lexer_float(&obj->lexer, &token, &texcoord[i], &number) ||
            number != BURNISH_NUMBER_OK) {
            texcoord[i] = 0;
        }
    }
}

/* ---- Faces ---- */

static void fail_corner(obj_parser *obj, burnish_token corner) {
    burnish_chunk_fail(obj->chunk, BURNISH_STATUS_FORMAT, corner.bytes,
                       "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                       burnish_token_quote(corner).text);
}

/* Puts an index, counted from 1 or backwards from -1, into the corner's column: whatever it is, no
 * further forward or back than 32 bits tell. Returns whether something may have it. */
static inline int take_number(burnish_chunk *chunk, int64_t written, burnish_attribute attribute,
                              uint32_t *corner) {
    if (written > 0) {
        corner[attribute] = (uint32_t)written - 1;
        /* Branches on which of two indices is larger would be unpredictable. */
        const size_t highest = chunk->highest[attribute];
        chunk->highest[attribute] = (size_t)written > highest ? (size_t)written : highest;
        return 1;
    }
    const size_t count = chunk->data.streams[attribute].count;
    const uint64_t back = (uint64_t)-written;
    corner[attribute] = (uint32_t)(count - (size_t)back);
    corner[RELATIVE] |= 1u << attribute;
    if (back > count && back - count > chunk->back[attribute]) {
        chunk->back[attribute] = (size_t)(back - count);
    }
    return back > 0;
}

/* A normal or texture coordinate: it need not be there (finish() looks for those). */
static inline void take_index(burnish_chunk *chunk, int64_t written, burnish_attribute attribute,
                              uint32_t *corner) {
    if (written != 0 && written > INT32_MIN && written <= (int64_t)BURNISH_VALUE_LIMIT) {
        take_number(chunk, written, attribute, corner);
    } else {
        corner[attribute] = (uint32_t)BURNISH_VALUE_LIMIT; /* what no file has */
        chunk->highest[attribute] = SIZE_MAX;
    }
}

/* A vertex, which must. Returns 0 for one that is known not to. */
static inline int take_vertex(burnish_chunk *chunk, int64_t written, uint32_t *corner) {
    const size_t count = chunk->data.streams[BURNISH_POSITION].count;
    return take_number(chunk, written, BURNISH_POSITION, corner) &&
           (written > 0
                ? (uint64_t)written <= chunk->total[BURNISH_POSITION]
                : !chunk->exact || (uint64_t)-written <= chunk->before[BURNISH_POSITION] + count);
}

static int fail_vertex(obj_parser *obj, burnish_token token, int64_t written) {
    const burnish_chunk *chunk = obj->chunk;
    const size_t count = chunk->data.streams[BURNISH_POSITION].count;
    if (written == 0) {
        burnish_chunk_fail(obj->chunk, BURNISH_STATUS_FORMAT, token.bytes,
                           "face refers to vertex 0; indices start at 1");
    } else if (written > 0) {
        burnish_chunk_fail(obj->chunk, BURNISH_STATUS_FORMAT, token.bytes,
                           "face refers to vertex %s, but the file has %zu; correct the index",
                           burnish_token_quote(token).text, chunk->total[BURNISH_POSITION]);
    } else {
        burnish_chunk_fail(obj->chunk, BURNISH_STATUS_FORMAT, token.bytes,
                           "face refers to vertex %s, but the file has %zu before it; correct the "
                           "index",
                           burnish_token_quote(token).text,
                           chunk->before[BURNISH_POSITION] + count);
    }
    return 0;
}

/* One index of a corner; returns 0 after an error. */
static int parse_index(obj_parser *obj, burnish_token corner, burnish_token token,
                       int64_t *written) {
    const burnish_number_status number = burnish_parse_integer(token, written);
    if (number == BURNISH_NUMBER_GARBAGE) {
        fail_corner(obj, corner);
        return 0;
    }
    if (number == BURNISH_NUMBER_RANGE) { /* beyond any count */
        *written = *token.bytes == '-' ? -INT64_MAX : INT64_MAX;
    }
    return 1;
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

/* v, v/t, v//n or v/t/n of any form; returns the attributes that it has, 0 after an error. */
static unsigned parse_corner(obj_parser *obj, burnish_token corner, uint32_t *numbers) {
    burnish_token left = corner, part = cut_part(&left);
    unsigned used = 1u << BURNISH_POSITION;
    int64_t written = 0;
    if (!parse_index(obj, corner, part, &written)) {
        return 0;
    }
    if (!take_vertex(obj->chunk, written, numbers)) {
        return (unsigned)fail_vertex(obj, part, written);
    }
    part = cut_part(&left);
    if (part.size > 0) {
        if (!parse_index(obj, corner, part, &written)) {
            return 0;
        }
        take_index(obj->chunk, written, BURNISH_TEXCOORD, numbers);
        used |= (unsigned)obj->with_texcoords << BURNISH_TEXCOORD;
    }
    if (left.size > 0) {
        part = cut_part(&left);
        if (left.size > 0) {
            fail_corner(obj, corner);
            return 0;
        }
        if (!parse_index(obj, corner, part, &written)) {
            return 0;
        }
        take_index(obj->chunk, written, BURNISH_NORMAL, numbers);
        used |= 1u << BURNISH_NORMAL;
    }
    return used;
}

/* Digits, possibly after a '-'; NULL for anything else. */
static inline const uint8_t *scan_index(const uint8_t *p, int64_t *written) {
    uint64_t value = 0;
    const int negative = *p == '-';
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
static inline unsigned scan_corner(obj_parser *obj, uint32_t *numbers) {
    const uint8_t *p = obj->lexer.next;
    unsigned used = 1u << BURNISH_POSITION;
    int64_t written;
    while (p < obj->lexer.end && *p == ' ') {
        ++p;
    }
    if (obj->lexer.end - p <= BURNISH_DECIMAL_ROOM || !(p = scan_index(p, &written)) ||
        !take_vertex(obj->chunk, written, numbers)) {
        return 0;
    }
    if (*p == '/') {
        ++p;
        if (*p != '/') {
            if (!(p = scan_index(p, &written))) {
                return 0;
            }
            take_index(obj->chunk, written, BURNISH_TEXCOORD, numbers);
            used |= (unsigned)obj->with_texcoords << BURNISH_TEXCOORD;
        }
        if (*p == '/') {
            if (!(p = scan_index(p + 1, &written))) {
                return 0;
            }
            take_index(obj->chunk, written, BURNISH_NORMAL, numbers);
            used |= 1u << BURNISH_NORMAL;
        }
    }
    if (!burnish_is_blank(*p) && !burnish_is_line_end(*p)) {
        return 0;
    }
    obj->lexer.next = p;
    return used;
}

/* Notes which corners of the face's triangles count from the chunk's first value; relative: for
 * which attributes there are some. */
static void note_relative(burnish_chunk *chunk, const uint32_t *corners, size_t count,
                          size_t first_triangle, uint32_t relative) {
    for (unsigned i = 0; relative >> i; ++i) {
        burnish_chunk_slots *slots = &chunk->relative[i];
        const size_t needed = slots->count + 3 * (count - 2);
        if (!(relative >> i & 1)) {
            continue;
        }
        if (needed > slots->capacity) {
            slots->items = burnish_reserve(&chunk->data.memory, slots->items, &slots->capacity,
                                           needed, sizeof *slots->items, "corners");
            if (chunk->data.memory.status != BURNISH_STATUS_OK) {
                chunk->status = chunk->data.memory.status;
                return;
            }
        }
        for (size_t k = 0; k < count - 2; ++k) {
            const size_t triangle[3] = {0, k + 1, k + 2};
            for (size_t c = 0; c < 3; ++c) {
                slots->items[slots->count] = (uint32_t)(3 * (first_triangle + k) + c);
                slots->count += corners[triangle[c] * COLUMNS + RELATIVE] >> i & 1;
            }
        }
    }
}

static void read_face(obj_parser *obj, const uint8_t *at) {
    burnish_chunk *chunk = obj->chunk;
    const size_t first_triangle = chunk->data.triangle_count;
    size_t count = 0;
    uint32_t relative = 0, *corners = chunk->scratch;
    unsigned used = 0;
    for (;; ++count) {
        burnish_token token;
        if ((count + 1) * COLUMNS > chunk->scratch_capacity &&
            !(corners = burnish_chunk_scratch(chunk, (count + 1) * COLUMNS))) {
            return;
        }
        uint32_t *numbers = corners + count * COLUMNS;
        numbers[BURNISH_NORMAL] = numbers[BURNISH_TEXCOORD] = BURNISH_NONE;
        numbers[RELATIVE] = 0;
        unsigned found = scan_corner(obj, numbers);
        if (found == 0) {
            if (!burnish_lexer_token(&obj->lexer, &token)) {
                break;
            }
            numbers[BURNISH_NORMAL] = numbers[BURNISH_TEXCOORD] = BURNISH_NONE;
            numbers[RELATIVE] = 0;
            if ((found = parse_corner(obj, token, numbers)) == 0) {
                return;
            }
        }
        used |= found;
        relative |= numbers[RELATIVE];
    }
    if (count < 3) {
        burnish_chunk_note(chunk, FEW_CORNERS, at);
        return;
    }
    if (burnish_chunk_append_face(chunk, at, corners, COLUMNS, count, used) == BURNISH_STATUS_OK &&
        relative) {
        note_relative(chunk, corners, count, first_triangle, relative);
    }
}

/* ---- Statements ---- */

/* They make geometry that is not drawn. */
static const char *const free_form_words[] = {"curv", "curv2", "surf", "bzp",
                                              "bsp",  "cdc",   "cdp",  NULL};
/* They make none of their own, or belong to those that do. */
static const char *const silent_words[] = {
    "mg",     "usemap", "maplib", "bevel", "lod",  "c_interp",   "d_interp",  "call", "csh",
    "cstype", "deg",    "bmat",   "step",  "parm", "trim",       "hole",      "scrv", "sp",
    "end",    "con",    "ctech",  "stech", "res",  "shadow_obj", "trace_obj", NULL};

static int is_one_of(burnish_token keyword, const char *const *words) {
    while (*words && !burnish_token_is(keyword, *words)) {
        ++words;
    }
    return *words != NULL;
}

static void read_statement(obj_parser *obj) {
    burnish_token keyword;
    if (!burnish_lexer_token(&obj->lexer, &keyword)) {
        return;
    }
    const uint8_t first = keyword.bytes[0], second = keyword.size > 1 ? keyword.bytes[1] : 0;
    if (keyword.size == 1) {
        if (first == 'v') {
            read_vertex(obj, keyword.bytes);
        } else if (first == 'f') {
            read_face(obj, keyword.bytes);
        } else if (first == 'l' || first == 'p') {
            burnish_chunk_note(obj->chunk, ELEMENT, keyword.bytes);
        } else if (first != 'o' && first != 'g' && first != 's') {
            burnish_chunk_note(obj->chunk, OTHER, keyword.bytes);
        }
    } else if (keyword.size == 2 && first == 'v') {
        if (second == 'n') {
            read_normal(obj, keyword.bytes);
        } else if (second == 't' && obj->with_texcoords) {
            read_texcoord(obj);
        }
    } else if (burnish_token_is(keyword, "usemtl")) {
        burnish_chunk_note(obj->chunk, MATERIAL, obj->lexer.next);
    } else if (burnish_token_is(keyword, "mtllib")) {
        burnish_chunk_note(obj->chunk, LIBRARY, obj->lexer.next);
    } else if (!is_one_of(keyword, silent_words)) {
        burnish_chunk_note(obj->chunk, OTHER, keyword.bytes);
    }
}

static void parse(const void *state, burnish_chunk *chunk) {
    obj_parser obj = {
        chunk, {chunk->first, chunk->text_end, 1}, ((const obj_state *)state)->with_texcoords};
    do {
        read_statement(&obj);
    } while (chunk->status == BURNISH_STATUS_OK && burnish_lexer_next_line(&obj.lexer) &&
             obj.lexer.next < chunk->end);
    if (!chunk->bounded) {
        chunk->end = obj.lexer.next;
    }
}

/* The first line from `from` on that no '\' joins to the one before it. */
static const uint8_t *find_start(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = from;
    while ((newline = memchr(newline, '\n', (size_t)(end - newline)))) {
        const uint8_t *last = newline - (newline[-1] == '\r') - 1;
        ++newline;
        if (*last != '\\') {
            return newline;
        }
    }
    return end;
}

/* A statement that is not read. */
static void note_other(obj_state *obj, const uint8_t *at, burnish_lexer *lexer) {
    burnish_token keyword;
    burnish_lexer_token(lexer, &keyword);
    if (is_one_of(keyword, free_form_words)) {
        burnish_reader_note(obj->reader, &obj->free_form, at,
                            "curves and surfaces (\"%s\") are not drawn; export them as faces",
                            burnish_token_quote(keyword).text);
    } else {
        burnish_reader_note(obj->reader, &obj->unknown, at,
                            "\"%s\" is not a statement of OBJ and was ignored",
                            burnish_token_quote(keyword).text);
    }
}

/* l v v ...: lexer at the keyword, `before` positions stand before it. A number that is no vertex's
 * becomes BURNISH_NONE. */
static burnish_status read_line(obj_state *obj, burnish_lexer *lexer, size_t before) {
    burnish_memory *memory = &obj->reader->mesh->memory;
    burnish_token token;
    uint32_t last = BURNISH_NONE;
    burnish_lexer_token(lexer, &token);
    for (int i = 0; burnish_lexer_token(lexer, &token); ++i) {
        int64_t written = 0;
        burnish_parse_integer(cut_part(&token), &written);
        const int64_t index = written < 0 ? (int64_t)before + written : written - 1;
        const uint32_t number = index >= 0 && index < BURNISH_NONE ? (uint32_t)index : BURNISH_NONE;
        if (i > 0) {
            obj->segments = burnish_reserve(memory, obj->segments, &obj->segment_capacity,
                                            obj->segment_count + 1, sizeof *obj->segments, "lines");
            if (memory->status != BURNISH_STATUS_OK) {
                return memory->status;
            }
            obj->segments[obj->segment_count++] = (burnish_segment){last, number};
        }
        last = number;
    }
    return BURNISH_STATUS_OK;
}

static burnish_status accept(void *state, const burnish_chunk *chunk) {
    obj_state *obj = state;
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        const size_t highest = chunk->back[i] > chunk->before[i] ? SIZE_MAX : chunk->highest[i];
        obj->highest[i] = highest > obj->highest[i] ? highest : obj->highest[i];
    }
    for (size_t i = 0; i < chunk->event_count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_chunk_event *event = &chunk->events[i];
        const size_t triangle = chunk->triangles_before + event->triangle;
        burnish_lexer lexer = {event->at, chunk->text_end, 1};
        if (event->kind == ELEMENT) {
            burnish_reader_note(obj->reader, &obj->elements, event->at,
                                "lines and points are not drawn beside faces");
            if (triangle == 0 && *event->at == 'l') {
                status = read_line(obj, &lexer, chunk->before[BURNISH_POSITION] + event->position);
            }
            continue;
        }
        if (event->kind == FEW_CORNERS) {
            burnish_reader_note(obj->reader, &obj->few_corners, event->at,
                                "a face with fewer than 3 corners was ignored");
            continue;
        }
        if (event->kind == COLOR) {
            burnish_reader_note(obj->reader, &obj->colors, event->at,
                                "what follows a vertex's coordinates is no colour; it is white");
            continue;
        }
        if (event->kind == NORMAL) {
            burnish_reader_note(obj->reader, &obj->normals, event->at,
                                "a normal is not 3 numbers; it was generated");
            continue;
        }
        if (event->kind == OTHER) {
            note_other(obj, event->at, &lexer);
            continue;
        }
        if (triangle > obj->triangle) {
            status = burnish_obj_begin_run(&obj->materials, obj->triangle);
            obj->triangle = triangle;
        }
        if (status == BURNISH_STATUS_OK && event->kind == LIBRARY) {
            status = burnish_obj_read_libraries(&obj->materials, &lexer);
        } else if (status == BURNISH_STATUS_OK) {
            burnish_obj_use_material(&obj->materials, burnish_lexer_rest(&lexer));
        }
    }
    return status;
}

static void drop_missing(void *user_data, size_t first, size_t end) {
    const burnish_stream *stream = user_data;
    for (size_t i = first; i < end; ++i) {
        stream->corners[i] = stream->corners[i] < stream->count ? stream->corners[i] : BURNISH_NONE;
    }
}

/* Corners may refer to normals and texture coordinates that are not there: exporters cut a file in
 * pieces and leave the indices, or write indices without any values. */
static void settle_corners(obj_state *obj, burnish_attribute attribute, const char *what) {
    burnish_mesh_data *mesh = obj->reader->mesh;
    burnish_stream *stream = &mesh->streams[attribute];
    if (!stream->corners) { /* no face refers to one */
        burnish_mesh_data_drop(mesh, attribute);
    }
    if (stream->corners && obj->highest[attribute] > stream->count) {
        burnish_tasks_ranges(mesh->tasks, 3 * mesh->triangle_count, 1 << 16, drop_missing, stream);
        burnish_reader_warn(obj->reader, NULL, "faces refer to %s that the file does not have",
                            what);
    }
    if (stream->count == 0) {
        burnish_mesh_data_drop(mesh, attribute);
    }
}

/* Colours that count to 255, where one is brighter than any that counts to 1. */
static void settle_colors(obj_state *obj) {
    const burnish_stream *colors = &obj->reader->mesh->streams[BURNISH_COLOR];
    uint8_t *rgba = burnish_colors(obj->reader->mesh);
    int count_to_255 = 0;
    for (size_t i = 0; i < colors->count && !count_to_255; ++i) {
        count_to_255 = rgba[4 * i + 3] == COUNTS_TO_255;
    }
    for (size_t i = 0; i < colors->count; ++i, rgba += 4) {
        for (int k = 0; k < 3 && count_to_255 && rgba[3] == COUNTS_TO_1; ++k) {
            rgba[k] = rgba[k] >= 128;
        }
        rgba[3] = 255;
    }
    if (count_to_255) {
        burnish_reader_warn(obj->reader, NULL,
                            "colours of vertices are beyond 1 and were taken to count to 255");
    }
}

/* Of a file without faces: its lines, or its vertices as points. */
static burnish_status make_points(obj_state *obj) {
    const size_t positions = obj->reader->mesh->streams[BURNISH_POSITION].count;
    size_t count = 0;
    for (size_t i = 0; i < obj->segment_count; ++i) {
        const burnish_segment segment = obj->segments[i];
        if (segment.from < positions && segment.to < positions) {
            obj->segments[count++] = segment;
        }
    }
    if (count < obj->segment_count) {
        burnish_reader_warn(obj->reader, NULL,
                            "%zu of %zu lines refer to vertices that the file does not have",
                            obj->segment_count - count, obj->segment_count);
    }
    settle_colors(obj);
    return burnish_make_points(obj->reader, obj->segments, count);
}

static burnish_status finish(obj_state *obj) {
    burnish_mesh_data *mesh = obj->reader->mesh;
    const burnish_warning_group *groups[] = {&obj->elements, &obj->few_corners, &obj->colors,
                                             &obj->normals,  &obj->free_form,   &obj->unknown};
    /* without faces, lines and points are what is drawn */
    for (size_t i = mesh->triangle_count == 0; i < sizeof groups / sizeof *groups; ++i) {
        burnish_reader_warn_group(obj->reader, groups[i]);
    }
    if (mesh->triangle_count == 0 && mesh->streams[BURNISH_POSITION].count > 0) {
        return make_points(obj);
    }
    if (mesh->triangle_count == 0) {
        return burnish_reader_fail(obj->reader, BURNISH_STATUS_FORMAT, NULL,
                                   "no faces among %zu vertices; export the mesh with its faces",
                                   mesh->streams[BURNISH_POSITION].count);
    }
    settle_corners(obj, BURNISH_NORMAL, "normals");
    settle_corners(obj, BURNISH_TEXCOORD, "texture coordinates");
    settle_colors(obj);
    burnish_status status = burnish_cut_polygons(obj->reader);
    if (status == BURNISH_STATUS_OK && obj->triangle < mesh->triangle_count) {
        status = burnish_obj_begin_run(&obj->materials, obj->triangle);
    }
    return status == BURNISH_STATUS_OK ? burnish_obj_resolve_materials(&obj->materials) : status;
}

/* Whether the file may have textures: a library is named at its head, if at all. */
static int names_library(const uint8_t *bytes, size_t size) {
    enum { HEAD = 1 << 20 };
    static const char word[] = "mtllib";
    const size_t length = sizeof word - 1, end = size < HEAD ? size : HEAD;
    for (size_t i = 0; i + length <= end; ++i) {
        const uint8_t *at = memchr(bytes + i, 'm', end - i - length + 1);
        if (!at || memcmp(at, word, length) == 0) {
            return at != NULL;
        }
        i = (size_t)(at - bytes);
    }
    return 0;
}

burnish_status burnish_read_obj(burnish_reader *reader) {
    static const burnish_grammar grammar = {find_start, parse, accept,
                                            1u << BURNISH_POSITION | 1u << BURNISH_NORMAL |
                                                1u << BURNISH_TEXCOORD,
                                            1u << BURNISH_NORMAL | 1u << BURNISH_TEXCOORD};
    obj_state obj = {.reader = reader,
                     .with_texcoords = burnish_reader_keeps_coordinates(
                         reader, names_library(reader->input->bytes, reader->input->size)),
                     .materials = {.reader = reader, .changed = 1}};
    const uint8_t *at = burnish_lexer_open(reader->input->bytes, reader->input->size, 1).next;
    burnish_status status = burnish_chunks_read(&grammar, &obj, reader, &at, NULL);
    if (status == BURNISH_STATUS_OK) {
        status = finish(&obj);
    }
    burnish_obj_materials_close(&obj.materials);
    burnish_release(reader->mesh->memory.context, obj.segments);
    return status;
}

/* The first word of the first line that is no comment is one of the format's. */
int burnish_recognise_obj(const uint8_t *bytes, size_t size) {
    static const char *const words[] = {"v", "vn", "vt", "f",      "o",      "g",
                                        "s", "l",  "p",  "mtllib", "usemtl", "vp"};
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 1);
    burnish_token token;
    if (!burnish_lexer_word(&lexer, &token)) {
        return 0;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        if (burnish_token_is(token, words[i])) {
            return 1;
        }
    }
    return 0;
}
