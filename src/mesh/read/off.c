/* OFF (Geomview, "OFF Files"): vertices and faces, each on a line of its own; normals, colours and
 * texture coordinates of vertices, colours of faces.
 *
 * The first word says what a vertex has: [ST][C][N]OFF. Many files say plain OFF but have colours,
 * as MeshLab writes them, or normals, which settle_values recognises from the rows. Colours count
 * to 255 if written without a decimal point, to 1 with one. A binary file is read as PLY. */
#include "base/bytes.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/points.h"
#include "mesh/read/common/textures.h"
#include "mesh/read/common/triangulate.h"
#include "mesh/read/io/parallel_text.h"
#include "mesh/read/ply/ply_header.h"

enum { COUNT_MOST = 3, VALUES_MOST = 12, SAMPLE_ROWS = 4096 };

/* Events, in the order of the file. */
enum { FEW_CORNERS, BAD_COLOR };

typedef struct off_state {
    burnish_reader *reader;
    int has_normals, has_colors, has_texcoords; /* of vertices */
    int counts_to_1; /* colours of vertices do, even in a row without a decimal point */
    int keeps_texcoords;
    int in_faces, is_binary;
    size_t vertex_count, face_count;
    burnish_warning_group few_corners, bad_colors;
} off_state;

typedef struct off_parser {
    const off_state *off;
    burnish_chunk *chunk;
    burnish_lexer lexer;
} off_parser;

/* ---- The beginning ---- */

/* Moves to the next line that is not blank or a comment; 0 at the end of the text. */
static int skip_empty_lines(burnish_lexer *lexer) {
    for (;;) {
        burnish_lexer_skip_blank_lines(lexer);
        if (lexer->next == lexer->end) {
            return 0;
        }
        if (*lexer->next != '#') {
            return 1;
        }
        burnish_lexer_next_line(lexer);
    }
}

/* Removes a prefix, given in small letters, from a word in any case. */
static int cut_prefix(burnish_token *word, const char *prefix) {
    const size_t size = strlen(prefix);
    if (word->size <= size ||
        !burnish_bytes_are_caseless(word->bytes, (const uint8_t *)prefix, size)) {
        return 0;
    }
    word->bytes += size;
    word->size -= size;
    return 1;
}

/* [ST][C][N][4][n]OFF, also with the first count right after it. Returns its size, 0 for any other
 * word. Small letters are accepted, except that n is not N. */
static size_t read_keyword(off_state *off, burnish_token word, int *has_dimensions) {
    const uint8_t *first = word.bytes;
    off->has_texcoords = cut_prefix(&word, "st");
    off->has_colors = cut_prefix(&word, "c");
    off->has_normals = word.size > 0 && *word.bytes == 'N' && cut_prefix(&word, "n");
    *has_dimensions = cut_prefix(&word, "4");
    *has_dimensions |= cut_prefix(&word, "n");
    const int is_it = burnish_token_is_caseless(word, "off") ||
                      (cut_prefix(&word, "off") && *word.bytes >= '0' && *word.bytes <= '9');
    return !is_it ? 0 : (size_t)(word.bytes - first) + ((*word.bytes | 0x20) == 'o' ? 3 : 0);
}

static burnish_status off_fail(const off_state *off, const burnish_lexer *lexer, const char *text) {
    return burnish_reader_fail(off->reader, BURNISH_STATUS_FORMAT, lexer->next, "%s", text);
}

/* The keyword, which may be missing, and the counts of vertices, faces and edges. The count of
 * edges is ignored and may be missing. */
static burnish_status read_head(off_state *off, burnish_lexer *lexer) {
    burnish_token word = {0};
    int has_dimensions = 0;
    int64_t counts[2] = {-1, -1};
    skip_empty_lines(lexer);
    burnish_lexer before = *lexer;
    burnish_lexer_token(lexer, &word);
    const size_t keyword = read_keyword(off, word, &has_dimensions);
    lexer->next = keyword > 0 ? word.bytes + keyword : before.next;
    if (keyword > 0 && has_dimensions) {
        return off_fail(off, lexer, "only vertices of 3 dimensions are supported; export OFF");
    }
    if (keyword > 0 && before.next[keyword - 1] == 'f') {
        burnish_reader_warn(off->reader, before.next, "the keyword is in small letters");
    }
    for (int i = 0; i < 2; ++i) {
        if (!skip_empty_lines(lexer) || !burnish_lexer_token(lexer, &word)) {
            return off_fail(off, lexer, "the file ends before its counts; the file is truncated");
        }
        off->is_binary = i == 0 && burnish_token_is(word, "BINARY");
        if (off->is_binary) {
            return BURNISH_STATUS_OK;
        }
        if (burnish_parse_integer(word, &counts[i]) != BURNISH_NUMBER_OK || counts[i] < 0) {
            return burnish_reader_fail(
                off->reader, BURNISH_STATUS_FORMAT, word.bytes,
                "\"%s\" is not a count; write OFF, then the counts of vertices, faces and edges",
                burnish_token_quote(word).text);
        }
    }
    burnish_lexer_rest(lexer);
    before = *lexer; /* the third count on a line of its own: a vertex has more numbers */
    if (!skip_empty_lines(&before) || !burnish_lexer_token(&before, &word) ||
        burnish_lexer_token(&before, &word)) {
        before = *lexer;
    }
    *lexer = before;
    if ((uint64_t)counts[0] > BURNISH_VALUE_LIMIT) {
        return burnish_reader_fail(off->reader, BURNISH_STATUS_LIMIT, word.bytes,
                                   "%lld vertices are more than %zu; split or simplify the mesh",
                                   (long long)counts[0], BURNISH_VALUE_LIMIT);
    }
    off->vertex_count = (size_t)counts[0];
    off->face_count = (uint64_t)counts[1] < SIZE_MAX ? (size_t)counts[1] : SIZE_MAX - 1;
    return BURNISH_STATUS_OK;
}

/* ---- Rows ---- */

/* Numbers of the line, at most `most`; a comment ends them. Returns how many. is_whole[i]: 1 where
 * the number is written without a point. */
static int read_values(off_parser *p, double *values, uint8_t *is_whole, int most) {
    burnish_token token;
    burnish_number_status number;
    int count = 0;
    while (count < most && burnish_lexer_double(&p->lexer, &token, &values[count], &number) &&
           *token.bytes != '#') {
        is_whole[count] = number != BURNISH_NUMBER_ODD && !memchr(token.bytes, '.', token.size);
        if (number == BURNISH_NUMBER_GARBAGE) {
            break;
        }
        if (!burnish_chunk_takes(p->chunk, token, &number)) {
            values[count] = __builtin_nan("");
        }
        ++count;
    }
    return count;
}

/* `count` numbers, 3 or 4: sRGB and alpha. If all are written as whole numbers, they count to 255.
 */
static void write_color(const double *values, const uint8_t *is_whole, int count, int counts_to_1,
                        uint8_t *rgba) {
    int to_255 = !counts_to_1;
    for (int i = 0; i < count; ++i) {
        to_255 &= is_whole[i];
    }
    rgba[3] = 255;
    for (int i = 0; i < count; ++i) {
        const double c = to_255 ? values[i] : values[i] * 255;
        rgba[i] = (uint8_t)(c > 0 ? c < 255 ? c + 0.5 : 255 : 0);
    }
}

/* ---- What the rows of vertices hold ---- */

/* Statistics of the numbers after the coordinates, in the first rows. */
typedef struct off_sample {
    size_t rows, of_unit_length, on_axes; /* their first three */
    int count;                            /* of a row; -1: they differ */
    int any_negative, any_above_1, any_above_255, any_point;
} off_sample;

static void add_row(off_sample *sample, const double *values, const uint8_t *is_whole, int count) {
    double length = 0;
    int zeros = 0;
    for (int i = 0; i < count; ++i) {
        sample->any_negative |= !(values[i] >= 0); /* or not finite */
        sample->any_above_1 |= values[i] > 1;
        sample->any_above_255 |= values[i] > 255;
        sample->any_point |= !is_whole[i];
        length += i < 3 ? values[i] * values[i] : 0;
        zeros += i < 3 && values[i] == 0;
    }
    sample->count = sample->rows == 0 || sample->count == count ? count : -1;
    sample->of_unit_length += length > 0.99 && length < 1.01;
    sample->on_axes += zeros == 2;
    ++sample->rows;
}

static off_sample take_sample(const off_state *off, const uint8_t *at) {
    const burnish_reader_input *input = off->reader->input;
    off_parser p = {off, NULL, {at, input->bytes + input->size, 0}};
    off_sample sample = {.count = -1};
    double values[VALUES_MOST];
    uint8_t is_whole[VALUES_MOST];
    const int others = (off->has_normals ? 3 : 0), last = off->has_texcoords ? 2 : 0;
    while (sample.rows < SAMPLE_ROWS && sample.rows < off->vertex_count &&
           skip_empty_lines(&p.lexer)) {
        const int first = 3 + others, count = read_values(&p, values, is_whole, VALUES_MOST);
        if (count < first + last) {
            break;
        }
        add_row(&sample, values + first, is_whole + first, count - first - last);
        burnish_lexer_rest(&p.lexer);
    }
    return sample;
}

/* Whether rows without a prefix have normals: nearly all rows have three numbers of length 1, and
 * either a number below 0, which colours lack, or only such lengths without all being pure red,
 * green or blue. */
static int are_normals(const off_sample *sample) {
    return sample->count == 3 && 10 * sample->of_unit_length >= 9 * sample->rows &&
           (sample->any_negative ||
            (sample->of_unit_length == sample->rows && sample->on_axes < sample->rows));
}

/* Decides what the first word leaves open. In plain OFF, three or four numbers after the
 * coordinates are normals or colours. Any other numbers are ignored. */
static void settle_values(off_state *off, const uint8_t *at) {
    const int is_plain = !off->has_normals && !off->has_colors;
    const off_sample sample =
        is_plain || off->has_colors ? take_sample(off, at) : (off_sample){.count = -1};
    if (is_plain && (sample.count == 3 || sample.count == 4)) {
        off->has_normals = are_normals(&sample);
        off->has_colors = !off->has_normals && !sample.any_negative &&
                          !(sample.any_point ? sample.any_above_1 : sample.any_above_255);
    }
    off->counts_to_1 = sample.rows > 0 && off->has_colors && !sample.any_above_1;
}

/* ---- Rows, as values of the mesh ---- */

/* is_bad: not finite, which is left out. */
static void append_position(off_parser *p, const double values[3], int is_bad) {
    const double *origin = p->off->reader->mesh->origin;
    float *to = burnish_chunk_append(p->chunk, BURNISH_POSITION);
    for (int i = 0; i < 3 && to; ++i) {
        to[i] = __builtin_nanf("");
        if (!is_bad) {
            burnish_place(values[i], origin[i], &to[i]);
        }
    }
}

static void append_floats(off_parser *p, burnish_attribute attribute, const double *values,
                          int count) {
    float *to = burnish_chunk_append(p->chunk, attribute);
    for (int i = 0; i < count && to; ++i) {
        to[i] = 0; /* what is not finite: a normal that is 0 is generated */
        burnish_double_to_float(values[i], &to[i]);
    }
}

static void read_vertex(off_parser *p) {
    const off_state *off = p->off;
    burnish_token token;
    burnish_number_status number;
    double position[3], values[VALUES_MOST];
    int is_bad = 0;
    uint8_t is_whole[VALUES_MOST];
    for (int i = 0; i < 3; ++i) {
        float unused;
        if (!burnish_lexer_double(&p->lexer, &token, &position[i], &number)) {
            is_bad = 1;
            if (!burnish_chunk_pardon(p->chunk, 0, p->lexer.next,
                                      "vertex has %d number%s, not 3; repair the file", i,
                                      i == 1 ? "" : "s")) {
                return;
            }
            break;
        }
        if (burnish_chunk_takes(p->chunk, token, &number) &&
            !burnish_double_to_float(position[i], &unused)) {
            number = BURNISH_NUMBER_RANGE;
        }
        if (number != BURNISH_NUMBER_OK && !is_bad &&
            !burnish_chunk_pardon_number(p->chunk, token, number)) {
            return;
        }
        is_bad |= number != BURNISH_NUMBER_OK;
    }
    append_position(p, position, is_bad);
    if (!off->has_normals && !off->has_colors && !off->has_texcoords) {
        return;
    }
    const int count = read_values(p, values, is_whole, VALUES_MOST);
    for (int i = count; i < VALUES_MOST; ++i) {
        values[i] = 0;
        is_whole[i] = 1;
    }
    int at = 0;
    if (off->has_normals) {
        append_floats(p, BURNISH_NORMAL, values, 3);
        at += 3;
    }
    if (off->has_colors) {
        const int left = count - at - (off->has_texcoords ? 2 : 0), size = left >= 4 ? 4 : 3;
        uint8_t *rgba = burnish_chunk_append(p->chunk, BURNISH_COLOR);
        if (rgba && left >= 3) {
            write_color(values + at, is_whole + at, size, off->counts_to_1, rgba);
        } else if (rgba) {
            memset(rgba, 255, 4);
            burnish_chunk_note(p->chunk, BAD_COLOR, token.bytes);
        }
        at += size;
    }
    if (off->has_texcoords && off->keeps_texcoords) {
        append_floats(p, BURNISH_TEXCOORD, values + at, 2);
    }
}

/* A face's colour for each of its triangles; alpha 0 means no colour. A single number is an index
 * into a colour table, which the file lacks. */
static void append_face_colors(off_parser *p, size_t triangles) {
    double values[4];
    uint8_t is_whole[4], rgba[4] = {255, 255, 255, 0};
    const int count = read_values(p, values, is_whole, 4);
    if (count >= 3) {
        write_color(values, is_whole, count, 0, rgba);
        rgba[3] = rgba[3] > 0 ? rgba[3] : 1;
    }
    for (size_t i = 0; i < triangles && p->chunk->status == BURNISH_STATUS_OK; ++i) {
        uint8_t *to = burnish_chunk_append(p->chunk, BURNISH_COLOR);
        if (to) {
            memcpy(to, rgba, sizeof rgba);
        }
    }
}

/* Reads corners into the chunk's scratch array; they may continue in the next line. *is_bad: 1 if
 * one has no vertex. */
static int read_corners(off_parser *p, size_t count, int *is_bad) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t *corners = burnish_chunk_scratch(p->chunk, i + 1);
        burnish_lexer before = p->lexer;
        uint64_t index;
        if (!corners) {
            return 0;
        }
        if (!burnish_lexer_count(&p->lexer, &index)) {
            burnish_token token;
            int64_t written = -1;
            if (!skip_empty_lines(&p->lexer) || !burnish_lexer_token(&p->lexer, &token)) {
                burnish_chunk_fail(p->chunk, BURNISH_STATUS_FORMAT, p->lexer.next,
                                   "the file ends after %zu of %zu corners; the file is truncated",
                                   i, count);
                return 0;
            }
            before.next = token.bytes;
            const burnish_number_status number = burnish_chunk_index(p->chunk, token, &written);
            index = number == BURNISH_NUMBER_OK && written >= 0 ? (uint64_t)written : UINT64_MAX;
        }
        if (index >= p->off->vertex_count) {
            burnish_token token = {0};
            burnish_lexer_token(&before, &token);
            if (!*is_bad &&
                !burnish_chunk_pardon(p->chunk, 1, token.bytes,
                                      "vertex \"%s\" is out of range; there are %zu "
                                      "vertices, counted from 0",
                                      burnish_token_quote(token).text, p->off->vertex_count)) {
                return 0;
            }
            *is_bad = 1;
        }
        corners[i] = (uint32_t)index;
    }
    return 1;
}

static void read_face(off_parser *p) {
    const uint8_t *at = p->lexer.next;
    burnish_token token;
    int64_t count = -1;
    int is_bad = 0;
    if (!burnish_lexer_token(&p->lexer, &token) ||
        burnish_parse_integer(token, &count) != BURNISH_NUMBER_OK || count < 0) {
        burnish_chunk_fail(p->chunk, BURNISH_STATUS_FORMAT, token.bytes,
                           "\"%s\" is not a count of corners; repair the file",
                           burnish_token_quote(token).text);
        return;
    }
    if (!read_corners(p, (size_t)count, &is_bad) || is_bad) {
        return;
    }
    if (count < 3) {
        burnish_chunk_note(p->chunk, FEW_CORNERS, at);
    } else if (burnish_chunk_append_face(p->chunk, at, p->chunk->scratch, 1, (size_t)count,
                                         1u << BURNISH_POSITION) == BURNISH_STATUS_OK &&
               !p->off->has_colors) {
        append_face_colors(p, (size_t)count - 2);
    }
}

static void off_parse(const void *state, burnish_chunk *chunk) {
    off_parser p = {state, chunk, {chunk->first, chunk->text_end, 0}};
    while (chunk->rows < chunk->rows_left && chunk->status == BURNISH_STATUS_OK) {
        if (!skip_empty_lines(&p.lexer) || p.lexer.next >= chunk->end) {
            break;
        }
        p.off->in_faces ? read_face(&p) : read_vertex(&p);
        burnish_lexer_rest(&p.lexer);
        if (chunk->bounded && p.lexer.next > chunk->end) {
            chunk->status = BURNISH_STATUS_FORMAT; /* a row that continues in the next chunk */
            return;
        }
        chunk->rows += chunk->status == BURNISH_STATUS_OK;
        chunk->rows_end = p.lexer.next;
    }
    if (!chunk->bounded) {
        chunk->end = p.lexer.next;
    }
}

static burnish_status off_accept(void *state, const burnish_chunk *chunk) {
    off_state *off = state;
    for (size_t i = 0; i < chunk->event_count; ++i) {
        const burnish_chunk_event *event = &chunk->events[i];
        if (event->kind == FEW_CORNERS) {
            burnish_reader_note(off->reader, &off->few_corners, event->at,
                                "a face with fewer than 3 corners was ignored");
        } else {
            burnish_reader_note(off->reader, &off->bad_colors, event->at,
                                "a vertex has no colour; it is white");
        }
    }
    return BURNISH_STATUS_OK;
}

/* ---- All ---- */

/* Vertices or faces from *at on. */
static burnish_status read_rows(off_state *off, const uint8_t **at, size_t rows) {
    const unsigned has_own = off->in_faces && !off->has_colors;
    const burnish_grammar grammar = {.find_start = burnish_chunk_find_line,
                                     .parse = off_parse,
                                     .accept = off_accept,
                                     .indexed = 1u << BURNISH_POSITION | has_own << BURNISH_COLOR};
    size_t missing = rows;
    burnish_status status = rows > 0 ? burnish_chunks_read(&grammar, off, off->reader, at, &missing)
                                     : BURNISH_STATUS_OK;
    if (status == BURNISH_STATUS_OK && missing > 0 && rows > 0) {
        status = burnish_reader_fail(off->reader, BURNISH_STATUS_FORMAT, *at,
                                     "the file ends after %zu of %zu %s; the file is truncated",
                                     rows - missing, rows, off->in_faces ? "faces" : "vertices");
    }
    return status;
}

/* Gives each triangle the colour of its face; drops them if no face has one. */
static burnish_status settle_face_colors(off_state *off) {
    burnish_mesh_data *mesh = off->reader->mesh;
    burnish_stream *colors = &mesh->streams[BURNISH_COLOR];
    uint8_t *rgba = burnish_colors(mesh);
    int any = 0;
    for (size_t i = 0; i < colors->count; ++i) {
        any |= rgba[4 * i + 3];
        rgba[4 * i + 3] = rgba[4 * i + 3] > 0 ? rgba[4 * i + 3] : 255;
    }
    if (!any) {
        burnish_mesh_data_drop(mesh, BURNISH_COLOR);
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_mesh_data_reserve_corners(mesh, BURNISH_COLOR, mesh->triangle_count);
    for (size_t i = 0; i < 3 * mesh->triangle_count && status == BURNISH_STATUS_OK; ++i) {
        colors->corners[i] = (uint32_t)(i / 3);
    }
    return status;
}

/* After OFF BINARY all numbers have 32 bits, the highest byte first: three counts, floats of vertices,
 * and for each face its corners and its colour, each after how many there are. */
static burnish_status read_binary(const off_state *off, burnish_lexer lexer) {
    enum { COUNTS = 3 * 4 };
    burnish_reader *reader = off->reader;
    const burnish_memory *memory = &reader->mesh->memory;
    burnish_ply_header header = {.encoding = BURNISH_PLY_BIG_ENDIAN};
    burnish_ply_property property = {.type = BURNISH_PLY_FLOAT32, .name = {lexer.next, 0}};
    burnish_ply_element element = {.kind = BURNISH_PLY_ELEMENT_VERTEX,
                                   .name = {(const uint8_t *)"vertex", 6}};
    reader->is_binary = 1;
    if (!burnish_lexer_next_line(&lexer) || lexer.end - lexer.next < COUNTS) {
        return off_fail(off, &lexer, "the file ends before its counts; the file is truncated");
    }
    header.body = element.at = lexer.next + COUNTS;
    element.count = __builtin_bswap32(burnish_load32(lexer.next));
    burnish_ply_add_element(reader, &header, element);
    for (int role = BURNISH_PLY_X; role <= BURNISH_PLY_T && !memory->status; ++role) {
        if (role < BURNISH_PLY_NX || (role < BURNISH_PLY_RED ? off->has_normals
                                      : role < BURNISH_PLY_S ? off->has_colors
                                                             : off->has_texcoords)) {
            property.role = (burnish_ply_role)role;
            burnish_ply_add_property(reader, &header, property);
        }
    }
    element.kind = BURNISH_PLY_ELEMENT_FACE;
    element.name = (burnish_token){(const uint8_t *)"face", 4};
    element.count = __builtin_bswap32(burnish_load32(lexer.next + 4));
    property.type = property.count_type = BURNISH_PLY_UINT32;
    for (int list = 0; list < 2 && !memory->status; ++list) {
        property.role = list == 0 ? BURNISH_PLY_CORNERS : BURNISH_PLY_OTHER;
        if (list > 0 || burnish_ply_add_element(reader, &header, element) == BURNISH_STATUS_OK) {
            burnish_ply_add_property(reader, &header, property);
        }
    }
    return burnish_ply_read_described(reader, &header, memory->status);
}

static burnish_status off_read(burnish_reader *reader) {
    off_state off = {.reader = reader};
    burnish_lexer lexer = burnish_lexer_open(reader->input->bytes, reader->input->size, 0);
    burnish_status status = read_head(&off, &lexer);
    const uint8_t *at = lexer.next;
    if (status == BURNISH_STATUS_OK && off.is_binary) {
        return read_binary(&off, lexer);
    }
    reader->is_wide = 1;
    off.keeps_texcoords = burnish_reader_keeps_coordinates(reader, 0);
    if (status == BURNISH_STATUS_OK) {
        settle_values(&off, at);
        status = read_rows(&off, &at, off.vertex_count);
    }
    off.in_faces = 1;
    if (status == BURNISH_STATUS_OK) {
        status = read_rows(&off, &at, off.face_count);
    }
    burnish_reader_warn_group(reader, &off.few_corners);
    burnish_reader_warn_group(reader, &off.bad_colors);
    if (status == BURNISH_STATUS_OK && reader->mesh->triangle_count == 0 && off.vertex_count > 0 &&
        !reader->has_bad_faces) {
        return burnish_make_points(reader, NULL, 0);
    }
    if (status == BURNISH_STATUS_OK && reader->mesh->triangle_count == 0) {
        status = burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                     "no faces among %zu vertices; export the mesh with its faces",
                                     off.vertex_count);
    }
    if (status == BURNISH_STATUS_OK && !off.has_colors) {
        status = settle_face_colors(&off);
    }
    return status == BURNISH_STATUS_OK ? burnish_cut_polygons(reader) : status;
}

/* Recognised by its first word that is not a comment. */
static int off_recognise(const uint8_t *bytes, size_t size) {
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 0);
    burnish_token word;
    off_state unused;
    int dimensions;
    return skip_empty_lines(&lexer) && burnish_lexer_token(&lexer, &word) &&
           read_keyword(&unused, word, &dimensions) > 0;
}

const burnish_format_reader burnish_reader_off = {
    .recognise = off_recognise, .read = off_read, .averages_normals = 1};
