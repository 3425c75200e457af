/* STL, ASCII and binary (3D Systems, "StereoLithography Interface Specification", 1989).
 *
 * One in seven binary files on sharing sites starts with "solid", so the size decides first. It
 * also overrides the header's count: programs that stream facets never go back to fill in the
 * count. Facet normals are ignored: they are redundant and often wrong. */
#include "mesh/read/stl.h"

#include <stdio.h>

#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/parts.h"
#include "mesh/read/io/parallel_text.h"
#include "mesh/read/io/streaming.h"

enum { LOOKED_AT = 512 };

/* Events, in the order of the file. */
enum { NORMAL, EXTRA, END, AFTER, BEFORE, WITHIN, SPLIT, CORNERS, START, NOTES, SOLID = NOTES };

typedef struct stl_state {
    burnish_reader *reader;
    burnish_warning_group groups[NOTES];
    burnish_part_list parts; /* the solids */
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

/* "end facet" for "endfacet": whether the word is "end" and the rest follows, which is skipped. */
static int joins_end(stl_parser *stl, const char *expected, burnish_token word) {
    burnish_lexer line = stl->lexer;
    burnish_token rest;
    if (strncmp(expected, "end", 3) != 0 || !burnish_token_is_caseless(word, "end") ||
        !burnish_lexer_token(&line, &rest) || !burnish_token_is_caseless(rest, expected + 3)) {
        return 0;
    }
    stl->lexer = line;
    burnish_chunk_note(stl->chunk, SPLIT, word.bytes);
    return 1;
}

/* Reads one keyword, in any case, or fails with what is there instead. */
static int expect_slowly(stl_parser *stl, const char *expected) {
    burnish_token word;
    char quoted[16];
    const int found = burnish_lexer_word(&stl->lexer, &word);
    if (found && (burnish_token_is_caseless(word, expected) || joins_end(stl, expected, word))) {
        return 1;
    }
    snprintf(quoted, sizeof quoted, "\"%s\"", expected);
    return found ? fail_expected(stl, quoted, word) : fail_end(stl, quoted);
}

/* The same, faster for the usual spelling. */
static inline __attribute__((always_inline)) int expect(stl_parser *stl, const char *expected) {
    return burnish_lexer_skip_word(&stl->lexer, expected) || expect_slowly(stl, expected);
}

static int is_keyword(burnish_token word) {
    static const char *const keywords[] = {"vertex",   "endloop", "endfacet", "facet",
                                           "endsolid", "solid",   "end"};
    size_t i = 0;
    while (i < sizeof keywords / sizeof *keywords &&
           !burnish_token_is_caseless(word, keywords[i])) {
        ++i;
    }
    return i < sizeof keywords / sizeof *keywords;
}

/* Skips words after "endloop" and "endfacet", which some programs write. */
static void skip_extra(stl_parser *stl) {
    const uint8_t *at = stl->lexer.next;
    while (at < stl->lexer.end && burnish_is_blank(*at)) {
        ++at;
    }
    burnish_lexer line = stl->lexer;
    burnish_token word;
    if (at < line.end && !burnish_is_line_end(*at) && burnish_lexer_token(&line, &word) &&
        !is_keyword(word)) {
        burnish_chunk_note(stl->chunk, EXTRA, word.bytes);
        burnish_lexer_rest(&stl->lexer);
    }
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

/* Three numbers after "vertex"; *is_bad: 1 if one of them is not finite, or is a word. */
static inline __attribute__((always_inline)) int read_vertex(stl_parser *stl, float position[3],
                                                             int *is_bad) {
    for (int i = 0; i < 3; ++i) {
        burnish_token word;
        double value = 0;
        burnish_number_status number;
        if (!burnish_lexer_word_double(&stl->lexer, &word, &value, &number)) {
            return fail_end(stl, "\"vertex x y z\"");
        }
        if (burnish_chunk_takes(stl->chunk, word, &number)) {
            if (burnish_place(value, stl->origin[i], &position[i])) {
                continue;
            }
            number = BURNISH_NUMBER_RANGE;
        }
        if (number == BURNISH_NUMBER_GARBAGE && is_keyword(word)) {
            burnish_chunk_fail(stl->chunk, BURNISH_STATUS_FORMAT, word.bytes, "%s",
                               burnish_describe_number("coordinate", word, number).text);
            return 0;
        }
        if (!*is_bad && !burnish_chunk_pardon_number(stl->chunk, word, number)) {
            return 0;
        }
        *is_bad = 1;
    }
    return 1;
}

/* Appends a triangle of a facet that begins at `facet`. Returns 0 after an error. */
static int append_triangle(burnish_chunk *chunk, const float positions[9], burnish_token facet) {
    if (chunk->exact && chunk->triangles_before + chunk->data.triangle_count >=
                            chunk->exact->input->options->max_triangles) {
        chunk->status = burnish_fail_triangles(chunk->exact, facet.bytes);
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        float *to = burnish_chunk_append(chunk, BURNISH_POSITION);
        if (!to) {
            return 0;
        }
        memcpy(to, positions + 3 * i, 3 * sizeof *to);
    }
    ++chunk->data.triangle_count;
    return 1;
}

/* Reads the vertices after the third, if any. Returns 0 after an error. */
static int read_fan(stl_parser *stl, float positions[9], int *is_bad, burnish_token facet) {
    for (int count = 0; burnish_lexer_skip_word(&stl->lexer, "vertex"); ++count) {
        if (count == 0) {
            burnish_chunk_note(stl->chunk, CORNERS, facet.bytes);
        }
        memcpy(positions + 3, positions + 6, 3 * sizeof *positions);
        if (!read_vertex(stl, positions + 6, is_bad) ||
            !(*is_bad || append_triangle(stl->chunk, positions, facet))) {
            return 0;
        }
    }
    return 1;
}

/* Reads the rest of a facet after "facet". One with a bad coordinate is left out; more than three
 * vertices make a fan. */
static void read_facet(stl_parser *stl, burnish_token facet) {
    burnish_chunk *chunk = stl->chunk;
    const size_t before = chunk->data.triangle_count;
    float positions[9];
    int is_bad = 0, good = read_to_outer(stl) && expect(stl, "loop");
    for (int i = 0; i < 3 && good; ++i) {
        good = expect(stl, "vertex") && read_vertex(stl, positions + 3 * i, &is_bad);
    }
    good = good && (is_bad || append_triangle(chunk, positions, facet));
    if (good && !burnish_lexer_skip_word(&stl->lexer, "endloop")) {
        good = read_fan(stl, positions, &is_bad, facet) && expect(stl, "endloop");
    }
    if (!good) {
        return;
    }
    if (is_bad) {
        chunk->data.triangle_count = before;
        chunk->data.streams[BURNISH_POSITION].count = 3 * before;
    }
    skip_extra(stl);
    if (expect(stl, "endfacet")) {
        skip_extra(stl);
    }
}

static int is_comment(burnish_token word) {
    return memchr("#;%!/*", *word.bytes, 6) != NULL;
}

/* Every chunk except the first begins at a "facet", within a solid, and ends before one. "facet" at
 * the start of a line is always within a solid, so a chunk may begin at any of them. */
static void stl_parse(const void *state, burnish_chunk *chunk) {
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
        if (burnish_token_is_caseless(word, "facet")) {
            if (!seen) {
                burnish_chunk_note(chunk, START, word.bytes);
            }
            in_solid = seen = 1;
            if (word.bytes >= chunk->end) {
                chunk->end = chunk->bounded ? chunk->end : word.bytes;
                return;
            }
            read_facet(&stl, word);
            continue;
        }
        const int begins = burnish_token_is_caseless(word, "solid");
        if (begins || (in_solid && (burnish_token_is_caseless(word, "endsolid") ||
                                    joins_end(&stl, "endsolid", word)))) {
            if (begins && in_solid) {
                burnish_chunk_note(chunk, END, word.bytes);
            }
            if (begins) {
                burnish_chunk_note(chunk, SOLID, stl.lexer.next);
            }
            in_solid = begins;
            seen = 1;
        } else if ((in_solid || !seen) && is_comment(word)) {
            burnish_chunk_note(chunk, seen ? WITHIN : BEFORE, word.bytes);
        } else if (in_solid && burnish_token_is_caseless(word, "end")) {
            burnish_chunk_note(chunk, END, word.bytes);
            in_solid = 0;
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
static const uint8_t *stl_find_facet(const uint8_t *from, const uint8_t *end) {
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

static void begin_solid(stl_state *stl, const burnish_chunk *chunk,
                        const burnish_chunk_event *event) {
    burnish_lexer lexer = {event->at, chunk->text_end, 0};
    const burnish_token name = burnish_lexer_rest(&lexer);
    const burnish_part part = burnish_part_of((const char *)name.bytes, name.size);
    burnish_parts_begin(&stl->parts, &part, chunk->triangles_before + event->triangle);
}

static burnish_status stl_accept(void *state, const burnish_chunk *chunk) {
    static const char *const warnings[] = {[NORMAL] = "a normal is not 3 numbers; it was ignored",
                                           [EXTRA] = "text in a facet's line was ignored",
                                           [END] = "\"endsolid\" is missing",
                                           [AFTER] = "text after \"endsolid\" was ignored",
                                           [BEFORE] = "text before \"solid\" was ignored",
                                           [WITHIN] = "a comment was ignored",
                                           [SPLIT] = "\"end\" was joined with the next word",
                                           [CORNERS] = "a facet has more than 3 vertices",
                                           [START] = "\"solid\" is missing"};
    stl_state *stl = state;
    for (size_t i = 0; i < chunk->event_count; ++i) {
        const burnish_chunk_event *event = &chunk->events[i];
        if (event->kind == SOLID) {
            begin_solid(stl, chunk, event);
        } else {
            burnish_reader_note(stl->reader, &stl->groups[event->kind], event->at, "%s",
                                warnings[event->kind]);
        }
    }
    return stl->parts.memory->status;
}

static burnish_status stl_read_text(burnish_reader *reader) {
    static const burnish_grammar grammar = {.find_start = stl_find_facet,
                                            .parse = stl_parse,
                                            .accept = stl_accept,
                                            .indexed = 1u << BURNISH_POSITION};
    const uint8_t *at =
        burnish_lexer_open(reader->input->bytes, burnish_reader_head(reader), 0).next;
    stl_state stl = {.reader = reader,
                     .parts = {.memory = &reader->mesh->memory, .next = burnish_part_of("", 0)}};
    reader->is_wide = 1;
    burnish_status status = burnish_chunks_read(&grammar, &stl, reader, &at, NULL);
    for (size_t i = 0; i < sizeof stl.groups / sizeof *stl.groups; ++i) {
        burnish_reader_warn_group(reader, &stl.groups[i]);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_parts_finish(&stl.parts, reader->mesh, 2);
    }
    burnish_parts_release(&stl.parts);
    return status;
}

/* ---- Both kinds ---- */

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
    while (burnish_lexer_word(&lexer, &word)) {
        if (!is_comment(word)) {
            burnish_token next = {0};
            return burnish_token_is_caseless(word, "solid") ||
                   (burnish_token_is_caseless(word, "facet") &&
                    burnish_lexer_token(&lexer, &next) &&
                    burnish_token_is_caseless(next, "normal"));
        }
        burnish_lexer_rest(&lexer);
    }
    return 0;
}

/* A size that matches the count is not an accident, whatever the file is called. */
static int stl_recognise(const uint8_t *bytes, size_t size) {
    return burnish_is_binary_stl(bytes, size) ? 1 + (size > BURNISH_STL_HEADER_SIZE)
                                              : starts_as_text(bytes, size);
}

static burnish_status stl_read(burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    burnish_status status;
    const size_t head = burnish_reader_head(reader);
    const int is_text = !burnish_is_binary_stl(input->bytes, input->size) &&
                        burnish_are_text(input->bytes, head < LOOKED_AT ? head : LOOKED_AT);
    if (is_text && starts_as_text(input->bytes, head)) {
        status = stl_read_text(reader);
    } else if (is_text && input->size >= BURNISH_STL_HEADER_SIZE) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, input->bytes,
            "text that does not begin with \"solid\" is not an STL file; export the mesh again");
    } else if (input->size < BURNISH_STL_HEADER_SIZE) {
        reader->is_binary = 1;
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, input->bytes + input->size,
                                   "the file ends within the %d bytes of a binary STL header and "
                                   "is not ASCII STL; the file is truncated or not STL",
                                   BURNISH_STL_HEADER_SIZE);
    } else {
        status = burnish_stl_read_binary(reader);
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
    .recognise = stl_recognise, .read = stl_read, .can_stream = 1};
