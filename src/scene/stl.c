/* STL, ASCII and binary (3D Systems, "StereoLithography Interface Specification", 1989).
 *
 * One in seven binary files on sharing sites starts with "solid", so the size decides first. Facet
 * normals and attribute bytes are passed over: normals are redundant and often wrong. */
#include <string.h>

#include "scene/append.h"
#include "scene/scene.h"

enum { HEADER_SIZE = 84, FACET_SIZE = 50, LOOKED_AT = 512 };

static uint32_t read_u32(const uint8_t *p) {
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* ---- binary ---- */

static burnish_status check_binary_size(const burnish_reader_input *input, uint32_t count,
                                        burnish_source *source, burnish_error *error) {
    size_t room = (input->size - HEADER_SIZE) / FACET_SIZE;
    if (count > room) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_byte(input->name, 80),
                               "%u triangles are announced, but the file ends after %zu; it is "
                               "truncated or not STL, fetch it again",
                               (unsigned)count, room);
    }
    size_t used = HEADER_SIZE + (size_t)count * FACET_SIZE;
    if (used < input->size) {
        burnish_warn_at(source, burnish_place_byte(input->name, used),
                        "%zu bytes behind the last triangle were ignored", input->size - used);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_facet(const burnish_reader_input *input, size_t offset,
                                 burnish_source *source, burnish_error *error) {
    uint32_t corners[3];
    for (size_t i = 0; i < 3; ++i) {
        float position[3];
        for (size_t k = 0; k < 3; ++k) {
            size_t at = offset + 12 + 12 * i + 4 * k;
            uint32_t bits = read_u32(input->bytes + at);
            if ((bits & 0x7F800000u) == 0x7F800000u) {
                return burnish_fail_at(error, BURNISH_STATUS_FORMAT,
                                       burnish_place_byte(input->name, at),
                                       "coordinate is not finite; repair the mesh");
            }
            memcpy(&position[k], &bits, sizeof bits);
        }
        corners[i] = (uint32_t)source->position_count;
        burnish_status status = burnish_append_position(
            source, burnish_place_byte(input->name, offset), position, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return burnish_append_polygon(source, input->options, burnish_place_byte(input->name, offset),
                                  corners, NULL, 3, error);
}

static burnish_status read_binary(const burnish_reader_input *input, burnish_source *source,
                                  burnish_error *error) {
    uint32_t count = read_u32(input->bytes + 80);
    burnish_place place = burnish_place_byte(input->name, 80);
    burnish_status status = check_binary_size(input, count, source, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_reserve_triangles(source, input->options, place, count, error);
    }
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = read_facet(input, HEADER_SIZE + i * FACET_SIZE, source, error);
    }
    return status;
}

/* ---- ASCII ---- */

typedef struct stl_text {
    const burnish_reader_input *input;
    burnish_source *source;
    burnish_error *error;
    burnish_text text;
    burnish_number_reader numbers;
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

/* The three numbers of a normal: passed over, whatever they are, as long as they are numbers. */
static burnish_status skip_normal(stl_text *stl) {
    for (int i = 0; i < 3; ++i) {
        burnish_token word;
        double value;
        burnish_status status = next_word(stl, "normal x y z", &word);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        burnish_number_status number =
            burnish_parse_double(&stl->numbers, word.bytes, word.size, &value);
        if (number == BURNISH_NUMBER_GARBAGE || number == BURNISH_NUMBER_MEMORY) {
            return burnish_fail_number(stl->error, here(stl), "normal", word, number);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_vertex(stl_text *stl, uint32_t *corner) {
    float position[3];
    burnish_status status = expect(stl, "vertex");
    for (int i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        burnish_token word;
        status = next_word(stl, "vertex x y z", &word);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        burnish_number_status number =
            burnish_parse_float(&stl->numbers, word.bytes, word.size, &position[i]);
        if (number != BURNISH_NUMBER_OK) {
            status = burnish_fail_number(stl->error, here(stl), "coordinate", word, number);
        }
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *corner = (uint32_t)stl->source->position_count;
    return burnish_append_position(stl->source, here(stl), position, stl->error);
}

/* What follows "facet". */
static burnish_status read_text_facet(stl_text *stl) {
    static const char *const before[] = {"outer", "loop"}, *const after[] = {"endloop", "endfacet"};
    uint32_t corners[3];
    burnish_status status = expect(stl, "normal");
    if (status == BURNISH_STATUS_OK) {
        status = skip_normal(stl);
    }
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        status = expect(stl, before[i]);
    }
    for (int i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        status = read_vertex(stl, &corners[i]);
    }
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        status = expect(stl, after[i]);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    return burnish_append_polygon(stl->source, stl->input->options, here(stl), corners, NULL, 3,
                                  stl->error);
}

/* What follows "solid", to the end of "endsolid NAME". */
static burnish_status read_solid(stl_text *stl) {
    burnish_text_rest(&stl->text);
    for (;;) {
        burnish_token word;
        burnish_status status = next_word(stl, "endsolid", &word);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        if (burnish_token_is_caseless(word, "endsolid")) {
            burnish_text_rest(&stl->text);
            return BURNISH_STATUS_OK;
        }
        status = burnish_token_is_caseless(word, "facet")
                     ? read_text_facet(stl)
                     : fail_expected(stl, "facet or endsolid", word);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
}

static burnish_status read_text(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error) {
    stl_text stl = {.input = input,
                    .source = source,
                    .error = error,
                    .text = burnish_text_open(input->bytes, input->size, 0)};
    burnish_token word;
    burnish_status status = BURNISH_STATUS_OK;
    while (status == BURNISH_STATUS_OK && burnish_text_word(&stl.text, &word)) {
        status = burnish_token_is_caseless(word, "solid") ? read_solid(&stl)
                                                          : fail_expected(&stl, "solid", word);
    }
    burnish_number_reader_close(&stl.numbers);
    return status;
}

/* ---- which ---- */

/* Text starts with "solid", and shows no control characters; a binary file has zeros in the upper
 * bytes of its count at the latest. */
static int is_text(const burnish_reader_input *input) {
    burnish_text text = burnish_text_open(input->bytes, input->size, 0);
    burnish_token word;
    if (!burnish_text_word(&text, &word) || !burnish_token_is_caseless(word, "solid")) {
        return 0;
    }
    for (size_t i = 0; i < input->size && i < LOOKED_AT; ++i) {
        uint8_t c = input->bytes[i];
        if ((c < 32 && !(c >= '\t' && c <= '\r')) || c == 127) {
            return 0;
        }
    }
    return 1;
}

burnish_status burnish_read_stl(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error) {
    burnish_status status;
    if (input->size == 0) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_byte(input->name, 0),
                               "the file is empty; fetch it again");
    }
    int exact = input->size >= HEADER_SIZE && (input->size - HEADER_SIZE) % FACET_SIZE == 0 &&
                (input->size - HEADER_SIZE) / FACET_SIZE == read_u32(input->bytes + 80);
    if (!exact && is_text(input)) {
        status = read_text(input, source, error);
    } else if (input->size < HEADER_SIZE) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT,
                               burnish_place_byte(input->name, input->size),
                               "the file ends within the %d bytes of a binary STL header and is "
                               "no ASCII STL; fetch it again",
                               HEADER_SIZE);
    } else {
        status = read_binary(input, source, error);
    }
    if (status == BURNISH_STATUS_OK && source->triangle_count == 0) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_file(input->name),
                               "no triangles; export the mesh again");
    }
    return status;
}
