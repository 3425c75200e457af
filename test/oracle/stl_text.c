/* ASCII STL, with one thread or by parts of the text.
 *
 * A part begins at a line whose first word is "facet", so that it begins inside a solid; every one
 * but the last must end so too. Then each was read from the state in which a reader of the whole
 * would have come to it. */
#include "oracle/stl_text.h"

#include <string.h>

#include "oracle/append.h"

typedef struct stl_text {
    const oracle_reader_input *input;
    oracle_source *source;
    burnish_error *error;
    oracle_text text;
    oracle_number_reader numbers;
    int ends_in_solid; /* the text is a part that others follow */
} stl_text;

static oracle_place here(const stl_text *stl) {
    return oracle_place_line(stl->input->name, stl->text.line);
}

static burnish_status next_word(stl_text *stl, const char *expected, oracle_token *word) {
    if (oracle_text_word(&stl->text, word)) {
        return BURNISH_STATUS_OK;
    }
    return oracle_fail_at(stl->error, BURNISH_STATUS_FORMAT, here(stl),
                          "the file ends where \"%s\" should follow; it is truncated, fetch it "
                          "again",
                          expected);
}

static burnish_status fail_expected(stl_text *stl, const char *expected, oracle_token word) {
    return oracle_fail_at(stl->error, BURNISH_STATUS_FORMAT, here(stl),
                          "\"%s\" stands where \"%s\" should; repair the file",
                          oracle_token_quote(word).text, expected);
}

/* Reads one keyword, in any case. */
static burnish_status expect(stl_text *stl, const char *expected) {
    oracle_token word;
    burnish_status status = next_word(stl, expected, &word);
    if (status == BURNISH_STATUS_OK && !oracle_token_is_caseless(word, expected)) {
        status = fail_expected(stl, expected, word);
    }
    return status;
}

/* The next word as a number, whatever it is as long as it is one. */
static burnish_status next_number(stl_text *stl, const char *expected, oracle_token *word,
                                  double *value, oracle_number_status *number) {
    if (oracle_text_word_double(&stl->text, &stl->numbers, word, value, number)) {
        return BURNISH_STATUS_OK;
    }
    return next_word(stl, expected, word);
}

/* The three numbers of a normal: passed over, whatever they are, as long as they are numbers. */
static burnish_status skip_normal(stl_text *stl) {
    for (int i = 0; i < 3; ++i) {
        oracle_token word;
        double value;
        oracle_number_status number = ORACLE_NUMBER_OK;
        burnish_status status = next_number(stl, "normal x y z", &word, &value, &number);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        if (number == ORACLE_NUMBER_GARBAGE || number == ORACLE_NUMBER_MEMORY) {
            return oracle_fail_number(stl->error, here(stl), "normal", word, number);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_vertex(stl_text *stl, float position[3]) {
    burnish_status status = expect(stl, "vertex");
    for (int i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        oracle_token word;
        double value = 0;
        oracle_number_status number = ORACLE_NUMBER_OK;
        status = next_number(stl, "vertex x y z", &word, &value, &number);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        if (number == ORACLE_NUMBER_OK && !oracle_double_to_float(value, &position[i])) {
            number = ORACLE_NUMBER_RANGE;
        }
        if (number != ORACLE_NUMBER_OK) {
            status = oracle_fail_number(stl->error, here(stl), "coordinate", word, number);
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
        status = oracle_append_position(stl->source, here(stl), positions + 3 * i, stl->error);
    }
    return status != BURNISH_STATUS_OK
               ? status
               : oracle_append_polygon(stl->source, stl->input->options, here(stl), corners, NULL,
                                       3, stl->error);
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
    return append_facet(stl, positions);
}

/* Solids to the end of the text, or of a part of it that begins within one. */
static burnish_status read_solids(stl_text *stl, int in_solid) {
    burnish_status status = BURNISH_STATUS_OK;
    while (status == BURNISH_STATUS_OK) {
        oracle_token word;
        if (!oracle_text_word(&stl->text, &word)) {
            return in_solid == stl->ends_in_solid ? BURNISH_STATUS_OK
                                                  : next_word(stl, "endsolid", &word);
        }
        if (in_solid && oracle_token_is_caseless(word, "facet")) {
            status = read_facet(stl);
        } else if (oracle_token_is_caseless(word, in_solid ? "endsolid" : "solid")) {
            oracle_text_rest(&stl->text); /* a name, which may be anything */
            in_solid = !in_solid;
        } else {
            status = fail_expected(stl, in_solid ? "facet or endsolid" : "solid", word);
        }
    }
    return status;
}

burnish_status oracle_read_stl_text(const oracle_reader_input *input, oracle_source *source,
                                    burnish_error *error) {
    stl_text stl = {.input = input,
                    .source = source,
                    .error = error,
                    .text = oracle_text_open(input->bytes, input->size, 0)};
    burnish_status status = read_solids(&stl, 0);
    oracle_number_reader_close(&stl.numbers);
    return status;
}
