/* STL, ASCII and binary (3D Systems, "StereoLithography Interface Specification", 1989).
 *
 * One in seven binary files on sharing sites starts with "solid", so the size decides first. It
 * also overrides the header's count: programs that stream facets never go back to fill in the
 * count. Facet normals are ignored: they are redundant and often wrong.
 *
 * Colours of a binary file's facets are 5 bits each in its two attribute bytes, in one of two ways.
 * VisCAM and SolidView: blue lowest, valid if bit 15 is set. Magics, recognised by "COLOR=" and 4
 * bytes RGBA in the header: red lowest, valid if bit 15 is not set; other facets have the header's
 * colour. */
#include <stdatomic.h>
#include <stdio.h>

#include "base/numbers.h"
#include "core/srgb.h"
#include "mesh/read/common/origin.h"
#include "mesh/read/common/points.h"
#include "mesh/read/common/preview.h"
#include "mesh/read/io/binary_stl.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/chunks.h"
#include "mesh/read/io/pieces.h"
#include "mesh/read/io/thinning.h"

enum {
    TITLE_SIZE = BURNISH_STL_TITLE_SIZE,
    HEADER_SIZE = BURNISH_STL_HEADER_SIZE,
    FACET_SIZE = BURNISH_STL_FACET_SIZE,
    NORMAL_SIZE = 12,
    ATTRIBUTES_AT = 48, /* a facet's two attribute bytes */
    LOOKED_AT = 512
};

enum { HAS_COLOR = 0x8000, BITS_OF_COLOR = 0x7FFF };

/* ---- Binary ---- */

typedef struct facet_context {
    float *positions;
    atomic_size_t bad;        /* the first facet with a coordinate that is not finite */
    atomic_uint any, all;     /* the attribute bytes of all facets, joined by or and by and */
    const uint8_t *announced; /* RGBA after "COLOR=" in the header; NULL: there is none */
    uint8_t *colors;          /* 4 bytes per corner */
} facet_context;

static void convert_facets(void *user_data, const uint8_t *facets, size_t first, size_t end) {
    facet_context *context = user_data;
    size_t bad = SIZE_MAX;
    unsigned any = 0, all = UINT16_MAX;
    for (size_t i = first; i < end; ++i, facets += FACET_SIZE) {
        const uint8_t *from = facets + NORMAL_SIZE;
        uint32_t bits[9], finite = 1;
        for (size_t k = 0; k < 9; ++k) {
            bits[k] = burnish_load32(from + 4 * k);
            finite &= (uint32_t)burnish_is_finite_bits(bits[k]);
        }
        memcpy(context->positions + 9 * i, bits, sizeof bits);
        bad = finite || i > bad ? bad : i;
        const unsigned found = burnish_load16(facets + ATTRIBUTES_AT);
        any |= found;
        all &= found;
    }
    burnish_lower_to(&context->bad, bad);
    atomic_fetch_or(&context->any, any);
    atomic_fetch_and(&context->all, all);
}

static burnish_status fail_coordinate(burnish_reader *reader, const uint8_t *facet) {
    const uint8_t *at = facet + NORMAL_SIZE;
    while (burnish_is_finite_bits(burnish_load32(at))) {
        at += 4;
    }
    return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, at,
                               "coordinate is not finite; repair the mesh");
}

/* Coordinates that no unit of length produces, but that the bytes of other files do: below 2^-100
 * but not 0, or 2^101 and above. */
static int is_odd_coordinate(uint32_t bits) {
    enum { LEAST = 27, MOST = 227, EXPONENT_AT = 23 };
    const uint32_t exponent = bits >> EXPONENT_AT & 0xFF;
    return (bits & 0x7FFFFFFFu) != 0 && (exponent < LEAST || exponent > MOST);
}

/* If the count does not match the size, the facets decide whether these bytes are STL: the file is
 * rejected if more than a quarter of the first facets that are not all 0 have such coordinates. */
static burnish_status check_facets(burnish_reader *reader, size_t count) {
    enum { FACETS_LOOKED_AT = 4096 };
    const size_t looked = count < FACETS_LOOKED_AT ? count : FACETS_LOOKED_AT;
    size_t odd = 0, filled = 0;
    for (size_t i = 0; i < looked; ++i) {
        const uint8_t *at = reader->input->bytes + HEADER_SIZE + i * FACET_SIZE + NORMAL_SIZE;
        int is_odd = 0;
        uint32_t any = 0;
        for (int k = 0; k < 9; ++k, at += 4) {
            is_odd |= is_odd_coordinate(burnish_load32(at));
            any |= burnish_load32(at);
        }
        odd += is_odd != 0;
        filled += any != 0;
    }
    return odd <= filled / 4
               ? BURNISH_STATUS_OK
               : burnish_reader_fail(reader, BURNISH_STATUS_FORMAT,
                                     reader->input->bytes + TITLE_SIZE,
                                     "not STL: the count does not fit the file's size, and %zu of "
                                     "the first %zu triangles have coordinates below 1e-30 or "
                                     "above 1e30",
                                     odd, looked);
}

/* *count: what the header announces; receives how many facets there are. */
static burnish_status check_count(burnish_reader *reader, size_t *count) {
    const burnish_reader_input *input = reader->input;
    const size_t room = (input->size - HEADER_SIZE) / FACET_SIZE;
    const int fits = burnish_is_binary_stl(input->bytes, input->size);
    if (!fits && !input->pieces) { /* for an input in pieces, the warning causes a full reading */
        const burnish_status status = check_facets(reader, *count < room ? *count : room);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    if (*count != room && room > 0 && (input->size - HEADER_SIZE) % FACET_SIZE == 0) {
        if (*count > 0 || input->pieces) { /* programs that write to a pipe announce 0 */
            burnish_reader_warn(
                reader, input->bytes + TITLE_SIZE,
                "%zu triangles are announced, but the file has %zu, which are drawn", *count, room);
        }
        *count = room;
    }
    if (*count > room) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, input->bytes + TITLE_SIZE,
            "%zu triangles are announced, but the file ends after %zu; it is truncated or not STL",
            *count, room);
    }
    if (*count > input->options->max_triangles) {
        return burnish_fail_triangles(reader, input->bytes + TITLE_SIZE);
    }
    const burnish_status status = burnish_budget_check(reader, 3 * (uint64_t)*count, *count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t used = HEADER_SIZE + *count * FACET_SIZE;
    if (used < input->size) {
        /* for a file in pieces, only the head is in memory, and the warning causes a full reading
         */
        burnish_reader_warn(reader, input->bytes + (input->pieces ? 0 : used),
                            "%zu bytes after the last triangle were ignored", input->size - used);
    }
    return BURNISH_STATUS_OK;
}

/* The bytes after "COLOR=" in the header; NULL without it. */
static const uint8_t *find_announced_color(const uint8_t *bytes) {
    static const char announcement[] = "COLOR=";
    const size_t length = sizeof announcement - 1;
    for (const uint8_t *at = bytes, *end = at + TITLE_SIZE - 4 - length; at <= end; ++at) {
        if (memcmp(at, announcement, length) == 0) {
            return at + length;
        }
    }
    return NULL;
}

/* 5 bits to 8. */
static uint8_t widen(unsigned bits) {
    bits &= 31;
    return (uint8_t)(bits << 3 | bits >> 2);
}

/* A facet's colour by its attributes; white for none. */
static void write_color(const facet_context *context, unsigned bits, uint8_t rgba[4]) {
    const int has_own = !(bits & HAS_COLOR) == (context->announced != NULL);
    memset(rgba, 255, 4);
    if (has_own) {
        rgba[0] = widen(context->announced ? bits : bits >> 10);
        rgba[1] = widen(bits >> 5);
        rgba[2] = widen(context->announced ? bits >> 10 : bits);
    } else if (context->announced) {
        memcpy(rgba, context->announced, 3);
    }
}

static void convert_colors(void *user_data, const uint8_t *facets, size_t first, size_t end) {
    const facet_context *context = user_data;
    for (size_t i = first; i < end; ++i, facets += FACET_SIZE) {
        uint8_t *rgba = context->colors + 12 * i;
        write_color(context, burnish_load16(facets + ATTRIBUTES_AT), rgba);
        memcpy(rgba + 4, rgba, 4);
        memcpy(rgba + 8, rgba, 4);
    }
}

/* One colour for all facets becomes the material's. */
static burnish_status set_material(burnish_mesh_data *mesh, const uint8_t rgba[4]) {
    mesh->materials = burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity, 1,
                                      sizeof *mesh->materials, "materials");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        burnish_material *material = &mesh->materials[mesh->material_count++];
        *material = burnish_material_default();
        for (int i = 0; i < 3; ++i) {
            material->diffuse[i] = material->ambient[i] =
                burnish_srgb_value_to_linear((float)rgba[i] / 255);
        }
        material->has_diffuse = 1;
    }
    return mesh->memory.status;
}

/* Colours, if the file has any. Attribute bytes that are all 0 or all 1 are not colours. If they
 * are 0 in all facets and the header announces a colour, that colour applies: programs that write
 * such headers more often leave them unset than mean black. */
static burnish_status read_colors(burnish_reader *reader, facet_context *context, size_t count) {
    burnish_mesh_data *mesh = reader->mesh;
    const unsigned any = atomic_load(&context->any), all = atomic_load(&context->all);
    context->announced = find_announced_color(reader->input->bytes);
    if (!context->announced &&
        (!(any & HAS_COLOR) || !(any & BITS_OF_COLOR) || all == UINT16_MAX)) {
        return BURNISH_STATUS_OK;
    }
    if (any == all) {
        uint8_t rgba[4];
        write_color(context, any > 0 ? all : HAS_COLOR, rgba);
        return set_material(mesh, rgba);
    }
    if (burnish_mesh_data_reserve(mesh, BURNISH_COLOR, 3 * count) == BURNISH_STATUS_OK) {
        mesh->streams[BURNISH_COLOR].count = 3 * count;
        context->colors = burnish_colors(mesh);
        return burnish_reader_rows(reader, HEADER_SIZE, FACET_SIZE, count, convert_colors, context);
    }
    return mesh->memory.status;
}

static burnish_status read_binary(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    size_t count = burnish_load32(reader->input->bytes + TITLE_SIZE), step = 1;
    reader->is_binary = 1;
    burnish_status status = check_count(reader, &count);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_thinning_step(reader, count, count, &step);
    }
    if (status == BURNISH_STATUS_OK && step > 1) {
        return burnish_preview_facets(reader, HEADER_SIZE, count, step);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_mesh_data_reserve(mesh, BURNISH_POSITION, 3 * count);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    facet_context context = {.positions = burnish_positions(mesh)};
    atomic_init(&context.bad, SIZE_MAX);
    atomic_init(&context.all, UINT16_MAX);
    status = burnish_reader_rows(reader, HEADER_SIZE, FACET_SIZE, count, convert_facets, &context);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t bad = atomic_load(&context.bad);
    if (bad < count) {
        return reader->input->pieces
                   ? burnish_pieces_give_up(reader)
                   : fail_coordinate(reader, reader->input->bytes + HEADER_SIZE + bad * FACET_SIZE);
    }
    mesh->streams[BURNISH_POSITION].count = 3 * count;
    mesh->triangle_count = count;
    burnish_move_positions(mesh);
    return read_colors(reader, &context, count);
}

/* ---- ASCII ---- */

/* Events, in the order of the file. */
enum { NORMAL, EXTRA, END, AFTER, NOTE_COUNT };

typedef struct stl_state {
    burnish_reader *reader;
    burnish_warning_group groups[NOTE_COUNT];
} stl_state;

typedef struct stl_parser {
    burnish_chunk *chunk;
    burnish_lexer lexer;
    const double *origin;
} stl_parser;

/* Fails because the file ends too early. Returns 0. */
static int fail_end(stl_parser *stl, const char *expected) {
    burnish_chunk_fail(stl->chunk, BURNISH_STATUS_FORMAT, stl->lexer.next,
                       "expected %s, found the end of the file; the file is truncated", expected);
    return 0;
}

static int fail_expected(stl_parser *stl, const char *expected, burnish_token word) {
    if (word.bytes + word.size == stl->chunk->text_end) { /* a partial token here is not an error */
        return fail_end(stl, expected);
    }
    burnish_chunk_fail(stl->chunk, BURNISH_STATUS_FORMAT, word.bytes,
                       "expected %s, found \"%s\"; repair the file", expected,
                       burnish_token_quote(word).text);
    return 0;
}

/* Reads one keyword, in any case, or fails with what is there instead. */
static int expect_slowly(stl_parser *stl, const char *expected) {
    burnish_token word;
    char quoted[16];
    const int found = burnish_lexer_word(&stl->lexer, &word);
    if (found && burnish_token_is_caseless(word, expected)) {
        return 1;
    }
    snprintf(quoted, sizeof quoted, "\"%s\"", expected);
    return found ? fail_expected(stl, quoted, word) : fail_end(stl, quoted);
}

/* The same, faster for the usual spelling. */
static inline __attribute__((always_inline)) int expect(stl_parser *stl, const char *expected) {
    return burnish_lexer_skip_word(&stl->lexer, expected) || expect_slowly(stl, expected);
}

static int fail_number(stl_parser *stl, const char *what, burnish_token word,
                       burnish_number_status number) {
    burnish_chunk_fail(stl->chunk, BURNISH_STATUS_FORMAT, word.bytes, "%s",
                       burnish_describe_number(what, word, number).text);
    return 0;
}

/* Skips words after "endloop" and "endfacet", which some programs write. */
static void skip_extra(stl_parser *stl) {
    static const char *const keywords[] = {"endfacet", "facet", "endsolid", "solid"};
    const uint8_t *at = stl->lexer.next;
    while (at < stl->lexer.end && burnish_is_blank(*at)) {
        ++at;
    }
    burnish_lexer line = stl->lexer;
    burnish_token word;
    if (at == line.end || burnish_is_line_end(*at) || !burnish_lexer_token(&line, &word)) {
        return;
    }
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; ++i) {
        if (burnish_token_is_caseless(word, keywords[i])) {
            return;
        }
    }
    burnish_chunk_note(stl->chunk, EXTRA, word.bytes);
    burnish_lexer_rest(&stl->lexer);
}

/* Skips the three numbers of a normal, whatever they are, and "outer" after them. */
static int skip_normal(stl_parser *stl) {
    enum { MOST_WORDS = 16 };
    burnish_token word;
    double value;
    burnish_number_status number = BURNISH_NUMBER_OK;
    int count = 0;
    while (count < 3 && number != BURNISH_NUMBER_GARBAGE) {
        if (!burnish_lexer_word_double(&stl->lexer, &word, &value, &number)) {
            return fail_end(stl, "\"normal x y z\"");
        }
        ++count;
    }
    if (number != BURNISH_NUMBER_GARBAGE) {
        return expect(stl, "outer");
    }
    burnish_chunk_note(stl->chunk, NORMAL, word.bytes);
    /* no further than the facet: the next one may be another chunk's */
    while (count++ < MOST_WORDS && !burnish_token_is_caseless(word, "outer") &&
           !burnish_token_is_caseless(word, "endfacet") &&
           !burnish_token_is_caseless(word, "facet")) {
        if (!burnish_lexer_word(&stl->lexer, &word)) {
            return fail_end(stl, "\"outer\"");
        }
    }
    return burnish_token_is_caseless(word, "outer") || fail_expected(stl, "\"outer\"", word);
}

/* "normal x y z outer": some programs omit the normal. */
static int read_to_outer(stl_parser *stl) {
    burnish_token word;
    if (burnish_lexer_skip_word(&stl->lexer, "normal")) {
        return skip_normal(stl);
    }
    if (!burnish_lexer_word(&stl->lexer, &word)) {
        return fail_end(stl, "\"normal\"");
    }
    if (burnish_token_is_caseless(word, "outer")) {
        burnish_chunk_note(stl->chunk, NORMAL, word.bytes);
        return 1;
    }
    return burnish_token_is_caseless(word, "normal") ? skip_normal(stl)
                                                     : fail_expected(stl, "\"normal\"", word);
}

static int read_vertex(stl_parser *stl, float position[3]) {
    if (!expect(stl, "vertex")) {
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        burnish_token word;
        double value = 0;
        burnish_number_status number;
        if (!burnish_lexer_word_double(&stl->lexer, &word, &value, &number)) {
            return fail_end(stl, "\"vertex x y z\"");
        }
        if (number == BURNISH_NUMBER_OK && !burnish_place(value, stl->origin[i], &position[i])) {
            number = BURNISH_NUMBER_RANGE;
        }
        if (number != BURNISH_NUMBER_OK) {
            return fail_number(stl, "coordinate", word, number);
        }
    }
    return 1;
}

/* Reads the rest of a facet after "facet". */
static void read_facet(stl_parser *stl, burnish_token facet) {
    burnish_chunk *chunk = stl->chunk;
    float positions[9];
    int good = read_to_outer(stl) && expect(stl, "loop");
    for (int i = 0; i < 3 && good; ++i) {
        good = read_vertex(stl, positions + 3 * i);
    }
    if (!good || !expect(stl, "endloop")) {
        return;
    }
    skip_extra(stl);
    if (!expect(stl, "endfacet")) {
        return;
    }
    skip_extra(stl);
    if (chunk->exact && chunk->triangles_before + chunk->data.triangle_count >=
                            chunk->exact->input->options->max_triangles) {
        chunk->status = burnish_fail_triangles(chunk->exact, facet.bytes);
        return;
    }
    for (int i = 0; i < 3; ++i) {
        float *to = burnish_chunk_append(chunk, BURNISH_POSITION);
        if (!to) {
            return;
        }
        memcpy(to, positions + 3 * i, 3 * sizeof *to);
    }
    ++chunk->data.triangle_count;
}

/* Every chunk except the first begins at a "facet", within a solid, and ends before one. "facet" at
 * the start of a line is always within a solid, so a chunk may begin at any of them. */
static void parse(const void *state, burnish_chunk *chunk) {
    const stl_state *file = state;
    stl_parser stl = {chunk, {chunk->first, chunk->text_end, 0}, file->reader->mesh->origin};
    int in_solid = !chunk->is_first, seen = in_solid;
    while (chunk->status == BURNISH_STATUS_OK) {
        burnish_token word;
        if (!burnish_lexer_word(&stl.lexer, &word)) {
            if (in_solid) {
                burnish_chunk_note(chunk, END, chunk->text_end);
            }
            chunk->end = chunk->text_end;
            return;
        }
        if (seen && burnish_token_is_caseless(word, "facet")) {
            in_solid = 1;
            if (word.bytes >= chunk->end) {
                chunk->end = chunk->bounded ? chunk->end : word.bytes;
                return;
            }
            read_facet(&stl, word);
            continue;
        }
        const int begins = burnish_token_is_caseless(word, "solid");
        if (begins || (in_solid && burnish_token_is_caseless(word, "endsolid"))) {
            if (begins && in_solid) {
                burnish_chunk_note(chunk, END, word.bytes);
            }
            in_solid = begins;
            seen = 1;
        } else if (in_solid || !seen) {
            fail_expected(&stl, in_solid ? "\"facet\" or \"endsolid\"" : "\"solid\"", word);
        } else {
            burnish_chunk_note(chunk, AFTER, word.bytes);
        }
        burnish_lexer_rest(&stl.lexer); /* of a solid a name, which may be anything */
    }
    chunk->end = chunk->bounded || chunk->end > stl.lexer.next ? chunk->end : stl.lexer.next;
}

/* The first line after `from` whose first word is "facet". */
static const uint8_t *find_start(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = from;
    while ((newline = memchr(newline, '\n', (size_t)(end - newline)))) {
        burnish_lexer line = {++newline, end, 0};
        burnish_token word;
        if (burnish_lexer_token(&line, &word) && burnish_token_is_caseless(word, "facet")) {
            return newline;
        }
    }
    return end;
}

static burnish_status accept(void *state, const burnish_chunk *chunk) {
    static const char *const warnings[] = {[NORMAL] = "a normal is not 3 numbers; it was ignored",
                                           [EXTRA] = "text in a facet's line was ignored",
                                           [END] = "\"endsolid\" is missing",
                                           [AFTER] = "text after \"endsolid\" was ignored"};
    stl_state *stl = state;
    for (size_t i = 0; i < chunk->event_count; ++i) {
        const burnish_chunk_event *event = &chunk->events[i];
        burnish_reader_note(stl->reader, &stl->groups[event->kind], event->at, "%s",
                            warnings[event->kind]);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_text(burnish_reader *reader) {
    static const burnish_grammar grammar = {.find_start = find_start,
                                            .parse = parse,
                                            .accept = accept,
                                            .indexed = 1u << BURNISH_POSITION,
                                            .are_facets = 1};
    const uint8_t *at =
        burnish_lexer_open(reader->input->bytes, burnish_reader_head(reader), 0).next;
    stl_state stl = {.reader = reader};
    reader->is_wide = 1;
    burnish_status status = burnish_chunks_read(&grammar, &stl, reader, &at, NULL);
    for (size_t i = 0; i < sizeof stl.groups / sizeof *stl.groups; ++i) {
        burnish_reader_warn_group(reader, &stl.groups[i]);
    }
    return status == BURNISH_STATUS_OK && reader->mesh->thinning > 1
               ? burnish_make_points(reader, NULL, 0)
               : status;
}

/* ---- Both ---- */

static void number_range(void *user_data, size_t first, size_t end) {
    uint32_t *corners = user_data;
    for (size_t i = first; i < end; ++i) {
        corners[i] = (uint32_t)i;
    }
}

/* No facet shares a corner: corner i has position i. */
static burnish_status number_corners(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    burnish_status status =
        burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, mesh->triangle_count);
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(mesh->tasks, 3 * mesh->triangle_count, 1 << 16, number_range,
                             mesh->streams[BURNISH_POSITION].corners);
    }
    return status;
}

static int starts_as_text(const uint8_t *bytes, size_t size) {
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 0);
    burnish_token word;
    return burnish_lexer_word(&lexer, &word) && burnish_token_is_caseless(word, "solid");
}

/* A size that matches the count is not an accident, whatever the file is called. */
static int recognise(const uint8_t *bytes, size_t size) {
    return burnish_is_binary_stl(bytes, size) ? 1 + (size > HEADER_SIZE)
                                              : starts_as_text(bytes, size);
}

static burnish_status read_input(burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    burnish_status status;
    const size_t head = burnish_reader_head(reader);
    const int is_text = !burnish_is_binary_stl(input->bytes, input->size) &&
                        burnish_are_text(input->bytes, head < LOOKED_AT ? head : LOOKED_AT);
    if (is_text && starts_as_text(input->bytes, head)) {
        status = read_text(reader);
    } else if (is_text && input->size >= HEADER_SIZE) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, input->bytes,
            "text that does not begin with \"solid\" is not an STL file; export the "
            "mesh again");
    } else if (input->size < HEADER_SIZE) {
        reader->is_binary = 1;
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, input->bytes + input->size,
                                   "the file ends within the %d bytes of a binary STL header and "
                                   "is not ASCII STL; the file is truncated or not STL",
                                   HEADER_SIZE);
    } else {
        status = read_binary(reader);
    }
    if (status == BURNISH_STATUS_OK && reader->mesh->triangle_count == 0 &&
        reader->mesh->point_count == 0) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                   "no triangles; export the mesh again");
    }
    return status == BURNISH_STATUS_OK && reader->mesh->triangle_count > 0 ? number_corners(reader)
                                                                           : status;
}

const burnish_format_reader burnish_reader_stl = {
    .recognise = recognise, .read = read_input, .in_pieces = 1};
