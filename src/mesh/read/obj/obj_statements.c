/* OBJ: the statements of a chunk, read as if it were the start of the file. */
#include "mesh/read/obj/obj_materials.h"

#include "mesh/read/common/local_origin.h"

/* The indices of a corner, by attribute. Corners have no colour index, so the column of colours
 * records which other indices are relative, as bits 1 << attribute. */
enum { COLUMNS = BURNISH_TEXCOORD + 1, RELATIVE = BURNISH_COLOR };

typedef struct obj_parser {
    burnish_chunk *chunk;
    burnish_lexer lexer;
    int with_texcoords;
    const double *origin;
} obj_parser;

/* ---- Values ---- */

/* A vertex: up to `most` numbers of the line; returns how many, -1 after an error, and -2 after an
 * error behind the three coordinates. *is_bad: 1 for a coordinate that is no finite number; the rest
 * of the line is not read then. */
static int read_floats(obj_parser *obj, float *values, int most, int *is_bad) {
    burnish_token token;
    burnish_number_status number;
    int count = 0;
    double value;
    while (count < most && burnish_lexer_double(&obj->lexer, &token, &value, &number)) {
        const double origin = count < 3 ? obj->origin[count] : 0;
        if (burnish_chunk_takes(obj->chunk, token, &number) &&
            !burnish_place(value, origin, &values[count])) {
            number = BURNISH_NUMBER_RANGE;
        }
        if (number != BURNISH_NUMBER_OK && count >= 3) {
            return -2;
        }
        if (number != BURNISH_NUMBER_OK) {
            *is_bad = 1;
            return burnish_chunk_pardon_number(obj->chunk, token, number) ? 3 : -1;
        }
        ++count;
    }
    return count;
}

/* No colour that counts to 1 is brighter, and one of 2 out of 255 is black. */
static const float BRIGHTEST = 2;

static void store_color(const float color[3], uint8_t *rgba) {
    const int is_large = color[0] > BRIGHTEST || color[1] > BRIGHTEST || color[2] > BRIGHTEST;
    for (int i = 0; i < 3; ++i) {
        const float c = is_large ? color[i] / 255 : color[i];
        rgba[i] = (uint8_t)(c <= 0 ? 0 : c >= 1 ? 255 : c * 255 + 0.5f);
    }
    rgba[3] = is_large ? BURNISH_OBJ_COUNTS_TO_255 : BURNISH_OBJ_COUNTS_TO_1;
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
    int is_bad = 0, count = read_floats(obj, values, MOST, &is_bad);
    if (count == -1) {
        return;
    }
    if (count == -2 || count == 5) {
        burnish_chunk_note(obj->chunk, BURNISH_OBJ_COLOR, at);
        count = 3;
    }
    if (count < 3) {
        is_bad = 1;
        if (!burnish_chunk_pardon(obj->chunk, 0, obj->lexer.next,
                                  "vertex has %d number%s; write v x y z or v x y z r g b", count,
                                  count == 1 ? "" : "s")) {
            return;
        }
    }
    float *position = burnish_chunk_append(obj->chunk, BURNISH_POSITION);
    for (int i = count == 2 ? 2 : 0; i < 3 && is_bad; ++i) { /* x and y may be all: obj.c */
        values[i] = __builtin_nanf("");
    }
    if (position) {
        memcpy(position, values, 3 * sizeof *position);
        if (count >= 6 || obj->chunk->data.streams[BURNISH_COLOR].count > 0) {
            append_color(obj, count >= 6 ? values + 3 : NULL);
        }
    }
}

/* Numbers that are not finite become 0: exporters write nan for faces without area. An unreadable
 * normal becomes 0, 0, 0 and is generated. */
static void read_normal(obj_parser *obj, const uint8_t *at) {
    burnish_token token;
    burnish_number_status number;
    float *normal = burnish_chunk_append(obj->chunk, BURNISH_NORMAL);
    for (int i = 0; i < 3 && normal; ++i) {
        if (!burnish_lexer_float(&obj->lexer, &token, &normal[i], &number) ||
            number == BURNISH_NUMBER_GARBAGE) {
            normal[0] = normal[1] = normal[2] = 0;
            burnish_chunk_note(obj->chunk, BURNISH_OBJ_NORMAL, at);
            return;
        }
        normal[i] = burnish_chunk_takes(obj->chunk, token, &number) ? normal[i] : 0;
    }
}

/* vt u [v [w]]; unreadable numbers become 0, which only misplaces the texture. */
static void read_texcoord(obj_parser *obj) {
    burnish_token token;
    burnish_number_status number = BURNISH_NUMBER_OK;
    float *texcoord = burnish_chunk_append(obj->chunk, BURNISH_TEXCOORD);
    for (int i = 0; i < 2 && texcoord; ++i) {
        if (!burnish_lexer_float(&obj->lexer, &token, &texcoord[i], &number) ||
            !burnish_chunk_takes(obj->chunk, token, &number)) {
            texcoord[i] = 0;
        }
    }
}

/* ---- Faces ---- */

/* Returns 0. The face is left out. */
static int fail_corner(obj_parser *obj, burnish_token corner) {
    burnish_chunk_pardon(obj->chunk, 1, corner.bytes,
                         "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                         burnish_token_quote(corner).text);
    return 0;
}

/* Puts an index, counted from 1 or backwards from -1, into the corner's column, clamped to 32 bits.
 * Returns whether the index can be valid. */
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

/* A normal or texture coordinate, which might be missing (finish() handles those). */
static inline void take_index(burnish_chunk *chunk, int64_t written, burnish_attribute attribute,
                              uint32_t *corner) {
    if (written != 0 && written > INT32_MIN && written <= (int64_t)BURNISH_VALUE_LIMIT) {
        take_number(chunk, written, attribute, corner);
    } else {
        corner[attribute] = (uint32_t)BURNISH_VALUE_LIMIT; /* what no file has */
        chunk->highest[attribute] = SIZE_MAX;
    }
}

/* A vertex, which must exist. Returns 0 if it certainly does not. */
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
        burnish_chunk_pardon(obj->chunk, 1, token.bytes,
                             "face refers to vertex 0; indices start at 1");
    } else if (written > 0) {
        burnish_chunk_pardon(obj->chunk, 1, token.bytes,
                             "face refers to vertex %s, but the file has %zu; correct the index",
                             burnish_token_quote(token).text, chunk->total[BURNISH_POSITION]);
    } else {
        burnish_chunk_pardon(obj->chunk, 1, token.bytes,
                             "face refers to vertex %s, but only %zu precede it; correct the index",
                             burnish_token_quote(token).text,
                             chunk->before[BURNISH_POSITION] + count);
    }
    return 0;
}

/* What is no index of any file, either way. */
#define BEYOND ((int64_t)BURNISH_VALUE_LIMIT + 1)

/* One index of a corner; returns 0 after an error. */
static int parse_index(obj_parser *obj, burnish_token corner, burnish_token token,
                       int64_t *written) {
    const burnish_number_status number = burnish_chunk_index(obj->chunk, token, written);
    if (number == BURNISH_NUMBER_GARBAGE) {
        return fail_corner(obj, corner);
    }
    if (number == BURNISH_NUMBER_RANGE) {
        *written = *token.bytes == '-' ? -BEYOND : BEYOND;
    }
    *written = *written > BEYOND ? BEYOND : *written < -BEYOND ? -BEYOND : *written;
    return 1;
}

burnish_token burnish_obj_cut_part(burnish_token *token) {
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
    burnish_token left = corner, part = burnish_obj_cut_part(&left);
    unsigned used = 1u << BURNISH_POSITION;
    int64_t written = 0;
    if (!parse_index(obj, corner, part, &written)) {
        return 0;
    }
    if (!take_vertex(obj->chunk, written, numbers)) {
        return (unsigned)fail_vertex(obj, part, written);
    }
    part = burnish_obj_cut_part(&left);
    if (part.size > 0) {
        if (!parse_index(obj, corner, part, &written)) {
            return 0;
        }
        take_index(obj->chunk, written, BURNISH_TEXCOORD, numbers);
        used |= (unsigned)obj->with_texcoords << BURNISH_TEXCOORD;
    }
    if (left.size > 0) {
        part = burnish_obj_cut_part(&left);
        if (left.size > 0) {
            return (unsigned)fail_corner(obj, corner);
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
    if (digits == 0 || digits > 9) { /* of 32 bits */
        return NULL;
    }
    *written = negative ? -(int64_t)value : (int64_t)value;
    return p;
}

/* The next corner if it is valid and of plain form; otherwise returns 0 and moves nothing. */
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

#ifdef __SSE2__
/* The same as scan_corner for indices of at most 8 digits; the separators of a corner are found at
 * once, so no number waits for the one before. Needs 7 characters in front. */
static inline unsigned scan_short_corner(obj_parser *obj, uint32_t *numbers) {
    const uint8_t *p = obj->lexer.next;
    unsigned used = 1u << BURNISH_POSITION;
    while (p < obj->lexer.end && *p == ' ') {
        ++p;
    }
    if (obj->lexer.end - p <= BURNISH_DECIMAL_ROOM) {
        return 0;
    }
    uint32_t others = burnish_find_others(p);
    size_t end = others ? (size_t)__builtin_ctz(others) : 0;
    if (end - 1 > 7 ||
        !take_vertex(obj->chunk, (int64_t)burnish_join_before(p + end, end), numbers)) {
        return 0;
    }
    for (int i = 0; i < 2 && p[end] == '/'; ++i) {
        const burnish_attribute attribute = i == 0 ? BURNISH_TEXCOORD : BURNISH_NORMAL;
        const size_t start = end + 1;
        others &= others - 1;
        end = others ? (size_t)__builtin_ctz(others) : 0;
        if (i == 0 && end == start && p[end] == '/') {
            continue;
        }
        if (end - start - 1 > 7) {
            return 0;
        }
        take_index(obj->chunk, (int64_t)burnish_join_before(p + end, end - start), attribute,
                   numbers);
        used |= (i == 0 ? (unsigned)obj->with_texcoords : 1u) << attribute;
    }
    if (!burnish_is_blank(p[end]) && !burnish_is_line_end(p[end])) {
        return 0;
    }
    obj->lexer.next = p + end;
    return used;
}
#else
static inline unsigned scan_short_corner(obj_parser *obj, uint32_t *numbers) {
    (void)obj, (void)numbers;
    return 0;
}
#endif

/* Records which corners of the face's triangles are relative to the chunk's first value; relative:
 * the attributes with relative indices. */
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
                return; /* the face is left out */
            }
        }
        used |= found;
        relative |= numbers[RELATIVE];
    }
    if (count < 3) {
        burnish_chunk_note(chunk, BURNISH_OBJ_FEW_CORNERS, at);
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
/* They produce no triangles, or belong to statements that do. */
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

/* v, vn, vt and f are also read in capitals, and f by its old name, fo. Returns what makes the letters
 * small. */
static uint8_t take_capitals(obj_parser *obj, burnish_token keyword) {
    static const char *const words[] = {"v", "f", "vn", "vt"};
    for (size_t i = 0; i < sizeof words / sizeof *words && keyword.bytes[0] < 'a'; ++i) {
        if (burnish_token_is_caseless(keyword, words[i])) {
            burnish_chunk_note_odd(obj->chunk, keyword);
            return 0x20;
        }
    }
    return 0;
}

static void read_statement(obj_parser *obj) {
    static const char paint[] = "#MRGB ";
    const size_t size = sizeof paint - 1;
    const uint8_t *start = obj->lexer.next;
    burnish_token keyword;
    if (!burnish_lexer_token(&obj->lexer, &keyword)) { /* blank, or a comment */
        if ((size_t)(obj->lexer.end - start) > size && memcmp(start, paint, size) == 0) {
            burnish_chunk_note(obj->chunk, BURNISH_OBJ_PAINT, start + size);
        }
        return;
    }
    const uint8_t small = take_capitals(obj, keyword), first = keyword.bytes[0] | small,
                  second = keyword.size > 1 ? keyword.bytes[1] | small : 0;
    if (keyword.size == 1) {
        if (first == 'v') {
            read_vertex(obj, keyword.bytes);
        } else if (first == 'f') {
            read_face(obj, keyword.bytes);
        } else if (first == 'l' || first == 'p') {
            burnish_chunk_note(obj->chunk, BURNISH_OBJ_ELEMENT, keyword.bytes);
        } else if (first == 'o' || first == 'g') {
            burnish_chunk_note(obj->chunk, first == 'o' ? BURNISH_OBJ_OBJECT : BURNISH_OBJ_GROUP,
                               obj->lexer.next);
        } else if (first != 's') {
            burnish_chunk_note(obj->chunk, BURNISH_OBJ_OTHER, keyword.bytes);
        }
    } else if (burnish_token_is(keyword, "fo")) { /* a face of old files, without an outline */
        burnish_chunk_note_odd(obj->chunk, keyword);
        read_face(obj, keyword.bytes);
    } else if (keyword.size == 2 && first == 'v') {
        if (second == 'n') {
            read_normal(obj, keyword.bytes);
        } else if (second == 't' && obj->with_texcoords) {
            read_texcoord(obj);
        }
    } else if (burnish_token_is(keyword, "usemtl")) {
        burnish_chunk_note(obj->chunk, BURNISH_OBJ_MATERIAL, obj->lexer.next);
    } else if (burnish_token_is(keyword, "mtllib")) {
        burnish_chunk_note(obj->chunk, BURNISH_OBJ_LIBRARY, obj->lexer.next);
    } else if (is_one_of(keyword, free_form_words)) {
        burnish_chunk_note(obj->chunk, BURNISH_OBJ_FREE_FORM, keyword.bytes);
    } else if (!is_one_of(keyword, silent_words)) {
        burnish_chunk_note(obj->chunk, BURNISH_OBJ_OTHER, keyword.bytes);
    }
}

/* ---- Plain lines ---- */

/* Past the end of a line; NULL if anything but spaces precedes it. */
static inline const uint8_t *end_plain_line(const obj_parser *obj, const uint8_t *p) {
    while (obj->lexer.end - p > 2 && *p == ' ') {
        ++p;
    }
    p += *p == '\r' && obj->lexer.end - p > 2;
    return *p == '\n' && obj->lexer.end - p > 1 ? p + 1 : NULL;
}

/* Reads `count` numbers and the end of the line; NULL if they have another form. */
static inline const uint8_t *scan_plain_numbers(const obj_parser *obj, const uint8_t *p,
                                                double *values, int count) {
    const int has_room = p - obj->chunk->first >= 8;
    for (int i = 0; i < count; ++i) {
        while (p < obj->lexer.end && *p == ' ') {
            ++p;
        }
        if (obj->lexer.end - p <= BURNISH_DECIMAL_ROOM) {
            return NULL;
        }
        size_t size = has_room ? burnish_scan_short_decimal(p, &values[i]) : 0;
        size = size ? size : burnish_scan_decimal(p, &values[i]);
        p += size;
        if (size == 0 || (i + 1 < count && *p != ' ')) {
            return NULL;
        }
    }
    return end_plain_line(obj, p);
}

/* Values of an attribute: those of positions are moved to the origin. */
static inline const uint8_t *read_plain_values(obj_parser *obj, const uint8_t *p,
                                               burnish_attribute attribute, int count) {
    double values[3];
    float rounded[3];
    p = scan_plain_numbers(obj, p, values, count);
    for (int k = 0; k < count && p; ++k) {
        const double origin = attribute == BURNISH_POSITION ? obj->origin[k] : 0;
        p = burnish_place(values[k], origin, &rounded[k]) ? p : NULL;
    }
    float *to = p ? burnish_chunk_append(obj->chunk, attribute) : NULL;
    if (!to) {
        return NULL;
    }
    memcpy(to, rounded, (size_t)count * sizeof *to);
    return p;
}

/* A face of few corners with absolute indices. */
static const uint8_t *read_plain_face(obj_parser *obj, const uint8_t *at) {
    enum { MOST = 4 };
    burnish_chunk *chunk = obj->chunk;
    uint32_t corners[MOST * COLUMNS];
    const uint8_t *after = NULL;
    const int has_room = at - chunk->first >= 8;
    unsigned used = 0;
    size_t count = 0;
    obj->lexer.next = at + 1;
    while (count < MOST && !after) {
        uint32_t *numbers = corners + count++ * COLUMNS;
        numbers[BURNISH_NORMAL] = numbers[BURNISH_TEXCOORD] = BURNISH_NONE;
        numbers[RELATIVE] = 0;
        unsigned found = has_room ? scan_short_corner(obj, numbers) : 0;
        found = found ? found : scan_corner(obj, numbers);
        if (found == 0 || numbers[RELATIVE]) {
            return NULL;
        }
        used |= found;
        after = count < 3 ? NULL : end_plain_line(obj, obj->lexer.next);
    }
    return after && burnish_chunk_append_face(chunk, at, corners, COLUMNS, count, used) ==
                        BURNISH_STATUS_OK
               ? after
               : NULL;
}

/* Reads a line of the most common forms, and moves to the next. Otherwise returns 0 and stays. */
static inline int read_plain_line(obj_parser *obj) {
    const uint8_t *at = obj->lexer.next, *after = NULL;
    if (obj->lexer.end - at <= BURNISH_DECIMAL_ROOM) {
        return 0;
    }
    if (at[0] == 'f' && at[1] == ' ') {
        after = read_plain_face(obj, at);
    } else if (at[0] == 'v' && at[1] == ' ' && obj->chunk->data.streams[BURNISH_COLOR].count == 0) {
        after = read_plain_values(obj, at + 1, BURNISH_POSITION, 3);
    } else if (at[0] == 'v' && at[1] == 'n' && at[2] == ' ') {
        after = read_plain_values(obj, at + 2, BURNISH_NORMAL, 3);
    } else if (at[0] == 'v' && at[1] == 't' && at[2] == ' ' && obj->with_texcoords) {
        after = read_plain_values(obj, at + 2, BURNISH_TEXCOORD, 2);
    }
    obj->lexer.next = after ? after : at;
    return after != NULL;
}

void burnish_obj_parse(burnish_chunk *chunk, int with_texcoords, const double origin[3]) {
    obj_parser obj = {chunk, {chunk->first, chunk->text_end, 1}, with_texcoords, origin};
    int more = 1;
    while (more && chunk->status == BURNISH_STATUS_OK) {
        if (!read_plain_line(&obj) && chunk->status == BURNISH_STATUS_OK) {
            read_statement(&obj);
            more = chunk->status == BURNISH_STATUS_OK && burnish_lexer_next_line(&obj.lexer);
        }
        more = more && obj.lexer.next < chunk->end;
    }
    if (!chunk->bounded) {
        chunk->end = obj.lexer.next;
    }
}
