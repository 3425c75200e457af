/* ASCII STL, with one thread or by parts of the text.
 *
 * A part begins at a line whose first word is "facet", so that it begins inside a solid; every one
 * but the last must end so too. Then each was read from the state in which a reader of the whole
 * would have come to it. */
#include "mesh/read/stl_text.h"

#include <stdatomic.h>
#include <string.h>

#include "mesh/mesh.h"
#include "mesh/read/append.h"
#include "mesh/read/parts.h"

typedef struct stl_text {
    const burnish_reader_input *input;
    burnish_source *source;
    burnish_error *error;
    burnish_text text;
    burnish_number_reader numbers;
    int ends_in_solid; /* the text is a part that others follow */
    /* Where the next facet goes, and how many more there is room for; NULL: at the source's end. */
    float *positions;
    size_t room;
} stl_text;

static burnish_place here(const stl_text *stl) {
    return burnish_place_line(stl->input->name, stl->text.line);
}

static burnish_status next_word(stl_text *stl, const char *expected, burnish_token *word) {
    if (burnish_text_word(&stl->text, word)) {
        return BURNISH_STATUS_OK;
    }
    return burnish_fail_at(stl->error, BURNISH_STATUS_FORMAT, here(stl),
                           "the file ends where \"%s\" should follow; it is truncated, fetch it "
                           "again",
                           expected);
}

static burnish_status fail_expected(stl_text *stl, const char *expected, burnish_token word) {
    return burnish_fail_at(stl->error, BURNISH_STATUS_FORMAT, here(stl),
                           "\"%s\" stands where \"%s\" should; repair the file",
                           burnish_token_quote(word).text, expected);
}

/* Reads one keyword, in any case. */
static burnish_status expect(stl_text *stl, const char *expected) {
    burnish_token word;
    burnish_status status = next_word(stl, expected, &word);
    if (status == BURNISH_STATUS_OK && !burnish_token_is_caseless(word, expected)) {
        status = fail_expected(stl, expected, word);
    }
    return status;
}

/* The next word as a number, whatever it is as long as it is one. */
static burnish_status next_number(stl_text *stl, const char *expected, burnish_token *word,
                                  double *value, burnish_number_status *number) {
    if (burnish_text_word_double(&stl->text, &stl->numbers, word, value, number)) {
        return BURNISH_STATUS_OK;
    }
    return next_word(stl, expected, word);
}

/* The three numbers of a normal: passed over, whatever they are, as long as they are numbers. */
static burnish_status skip_normal(stl_text *stl) {
    for (int i = 0; i < 3; ++i) {
        burnish_token word;
        double value;
        burnish_number_status number = BURNISH_NUMBER_OK;
        burnish_status status = next_number(stl, "normal x y z", &word, &value, &number);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        if (number == BURNISH_NUMBER_GARBAGE || number == BURNISH_NUMBER_MEMORY) {
            return burnish_fail_number(stl->error, here(stl), "normal", word, number);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_vertex(stl_text *stl, float position[3]) {
    burnish_status status = expect(stl, "vertex");
    for (int i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        burnish_token word;
        double value = 0;
        burnish_number_status number = BURNISH_NUMBER_OK;
        status = next_number(stl, "vertex x y z", &word, &value, &number);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        if (number == BURNISH_NUMBER_OK && !burnish_double_to_float(value, &position[i])) {
            number = BURNISH_NUMBER_RANGE;
        }
        if (number != BURNISH_NUMBER_OK) {
            status = burnish_fail_number(stl->error, here(stl), "coordinate", word, number);
        }
    }
    return status;
}

/* ---- facets ---- */

static burnish_status append_facet(stl_text *stl, const float positions[9]) {
    uint32_t corners[3];
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        corners[i] = (uint32_t)stl->source->position_count;
        status = burnish_append_position(stl->source, here(stl), positions + 3 * i, stl->error);
    }
    return status != BURNISH_STATUS_OK
               ? status
               : burnish_append_polygon(stl->source, stl->input->options, here(stl), corners, NULL,
                                        3, stl->error);
}

/* Into the room of a part, which was counted. */
static burnish_status place_facet(stl_text *stl, const float positions[9]) {
    if (stl->room == 0) {
        return BURNISH_STATUS_FORMAT;
    }
    memcpy(stl->positions, positions, 9 * sizeof(float));
    stl->positions += 9;
    --stl->room;
    return BURNISH_STATUS_OK;
}

/* What follows "facet". */
static burnish_status read_facet(stl_text *stl) {
    static const char *const before[] = {"outer", "loop"}, *const after[] = {"endloop", "endfacet"};
    float positions[9];
    burnish_status status = expect(stl, "normal");
    if (status == BURNISH_STATUS_OK) {
        status = skip_normal(stl);
    }
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        status = expect(stl, before[i]);
    }
    for (int i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        status = read_vertex(stl, positions + 3 * i);
    }
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        status = expect(stl, after[i]);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    return stl->positions ? place_facet(stl, positions) : append_facet(stl, positions);
}

/* Solids to the end of the text, or of a part of it that begins within one. */
static burnish_status read_solids(stl_text *stl, int in_solid) {
    burnish_status status = BURNISH_STATUS_OK;
    while (status == BURNISH_STATUS_OK) {
        burnish_token word;
        if (!burnish_text_word(&stl->text, &word)) {
            return in_solid == stl->ends_in_solid ? BURNISH_STATUS_OK
                                                  : next_word(stl, "endsolid", &word);
        }
        if (in_solid && burnish_token_is_caseless(word, "facet")) {
            status = read_facet(stl);
        } else if (burnish_token_is_caseless(word, in_solid ? "endsolid" : "solid")) {
            burnish_text_rest(&stl->text); /* a name, which may be anything */
            in_solid = !in_solid;
        } else {
            status = fail_expected(stl, in_solid ? "facet or endsolid" : "solid", word);
        }
    }
    return status;
}

/* ---- parts ---- */

enum { FACET_LEAST = 64 /* bytes; words and numbers of a facet are 85 at least */ };

typedef struct part {
    const uint8_t *first, *end;
    size_t facets_before, facets;
} part;

typedef struct stl_parts {
    const burnish_reader_input *input;
    burnish_source *source;
    part *parts;
    size_t count, facets;
    atomic_int give_up;
} stl_parts;

/* The next line from `line` on whose first word is "facet", or end. */
static const uint8_t *find_facet(const uint8_t *line, const uint8_t *end) {
    while (line < end) {
        const uint8_t *newline = burnish_find_newline(line, end);
        burnish_text text = {line, newline, 1, 0};
        burnish_token word;
        if (burnish_text_token(&text, &word) && burnish_token_is_caseless(word, "facet")) {
            return line;
        }
        line = newline < end ? newline + 1 : end;
    }
    return end;
}

static int cut_parts(stl_parts *stl) {
    const burnish_text text = burnish_text_open(stl->input->bytes, stl->input->size, 0);
    stl->parts = calloc(burnish_parts_most(stl->input->size), sizeof *stl->parts);
    if (!stl->parts) {
        return 0;
    }
    for (const uint8_t *first = text.next; first < text.end; ++stl->count) {
        part *p = &stl->parts[stl->count];
        p->first = first;
        p->end = first = find_facet(burnish_part_end(first, text.end, 0), text.end);
    }
    return 1;
}

/* Counts "endfacet", of which four letters will do: reading finds where they are something else. */
static void count_facets(void *of, size_t index, int thread) {
    stl_parts *stl = of;
    part *p = &stl->parts[index];
    const uint8_t *at = p->first;
    size_t facets = 0;
    (void)thread;
    while (p->end - at > 3) {
        /* Sums of bytes, so that the compiler compares as many as a vector holds. */
        const size_t rest = (size_t)(p->end - at) - 3, size = rest < 255 ? rest : 255;
        uint8_t found = 0;
        for (size_t i = 0; i < size; ++i) {
            found = (uint8_t)(found + (((at[i] | 0x20) == 'n') & ((at[i + 1] | 0x20) == 'd') &
                                       ((at[i + 2] | 0x20) == 'f') & ((at[i + 3] | 0x20) == 'a')));
        }
        facets += found;
        at += size;
    }
    p->facets = facets;
}

static void read_part(void *of, size_t index, int thread) {
    stl_parts *parts = of;
    part *p = &parts->parts[index];
    stl_text stl = {.input = parts->input,
                    .text = {p->first, p->end, 1, 0},
                    .ends_in_solid = index + 1 < parts->count,
                    .positions = parts->source->positions + 9 * p->facets_before,
                    .room = p->facets};
    (void)thread;
    if (atomic_load(&parts->give_up)) {
        return;
    }
    if (read_solids(&stl, index > 0) != BURNISH_STATUS_OK || stl.room > 0) {
        atomic_store(&parts->give_up, 1);
    }
    burnish_number_reader_close(&stl.numbers);
    uint32_t *corners = parts->source->corner_positions;
    for (size_t i = 3 * p->facets_before; i < 3 * (p->facets_before + p->facets); ++i) {
        corners[i] = (uint32_t)i;
    }
}

/* Sums up what stands before each part, and makes room. Returns 0 when there is too much. */
static int reserve_facets(stl_parts *stl) {
    burnish_source *source = stl->source;
    size_t facets = 0;
    for (size_t i = 0; i < stl->count; ++i) {
        stl->parts[i].facets_before = facets;
        facets += stl->parts[i].facets;
    }
    stl->facets = facets;
    return facets > 0 && facets <= stl->input->size / FACET_LEAST &&
           facets <= BURNISH_POSITION_LIMIT / 3 && facets <= BURNISH_TRIANGLES_MAX &&
           facets <= stl->input->options->max_triangles &&
           burnish_legacy_reserve_discard((void **)&source->positions, &source->position_capacity,
                                          3 * facets, 3 * sizeof(float), "positions",
                                          NULL) == BURNISH_STATUS_OK &&
           burnish_legacy_reserve_discard((void **)&source->corner_positions,
                                          &source->corner_capacity, facets, 3 * sizeof(uint32_t),
                                          "triangles", NULL) == BURNISH_STATUS_OK;
}

/* Returns 0 when nothing was read: the sequential reader will find out why. */
static int read_parts(const burnish_reader_input *input, burnish_source *source) {
    stl_parts stl = {.input = input, .source = source};
    int done = 0;
    if (cut_parts(&stl)) {
        burnish_tasks_run(source->pool, stl.count, 1, 0, count_facets, &stl);
        if (reserve_facets(&stl)) {
            burnish_tasks_run(source->pool, stl.count, 1, 0, read_part, &stl);
            done = !atomic_load(&stl.give_up);
        }
    }
    if (done) {
        source->position_count = 3 * stl.facets;
        source->triangle_count = stl.facets;
    } else {
        burnish_parts_drop((void **)&source->positions, &source->position_capacity);
        burnish_parts_drop((void **)&source->corner_positions, &source->corner_capacity);
    }
    free(stl.parts);
    return done;
}

burnish_status burnish_read_stl_text(const burnish_reader_input *input, burnish_source *source,
                                     burnish_error *error) {
    if (burnish_parts_pay(source->pool, input->size) && read_parts(input, source)) {
        return BURNISH_STATUS_OK;
    }
    stl_text stl = {.input = input,
                    .source = source,
                    .error = error,
                    .text = burnish_text_open(input->bytes, input->size, 0)};
    burnish_status status = read_solids(&stl, 0);
    burnish_number_reader_close(&stl.numbers);
    return status;
}
