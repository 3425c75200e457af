/* STL, ASCII and binary (3D Systems, "StereoLithography Interface Specification", 1989).
 *
 * One in seven binary files on sharing sites starts with "solid", so the size decides first. Facet
 * normals and attribute bytes are passed over: normals are redundant and often wrong. */
#include <string.h>

#include "oracle/append.h"
#include "oracle/stl_text.h"

enum { HEADER_SIZE = 84, FACET_SIZE = 50, NORMAL_SIZE = 12, LOOKED_AT = 512 };

static uint32_t read_u32(const uint8_t *p) {
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* ---- binary ---- */

static burnish_status check_binary_size(const oracle_reader_input *input, uint32_t count,
                                        oracle_source *source, burnish_error *error) {
    size_t room = (input->size - HEADER_SIZE) / FACET_SIZE;
    if (count > room) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_byte(input->name, 80),
                              "%u triangles are announced, but the file ends after %zu; it is "
                              "truncated or not STL, fetch it again",
                              (unsigned)count, room);
    }
    size_t used = HEADER_SIZE + (size_t)count * FACET_SIZE;
    if (used < input->size) {
        oracle_warn_at(source, oracle_place_byte(input->name, used),
                       "%zu bytes behind the last triangle were ignored", input->size - used);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_facet(const oracle_reader_input *input, size_t offset,
                                 oracle_source *source, burnish_error *error) {
    uint32_t corners[3];
    for (size_t i = 0; i < 3; ++i) {
        float position[3];
        for (size_t k = 0; k < 3; ++k) {
            size_t at = offset + NORMAL_SIZE + 12 * i + 4 * k;
            uint32_t bits = read_u32(input->bytes + at);
            if ((bits & 0x7F800000u) == 0x7F800000u) {
                return oracle_fail_at(error, BURNISH_STATUS_FORMAT,
                                      oracle_place_byte(input->name, at),
                                      "coordinate is not finite; repair the mesh");
            }
            memcpy(&position[k], &bits, sizeof bits);
        }
        corners[i] = (uint32_t)source->position_count;
        burnish_status status =
            oracle_append_position(source, oracle_place_byte(input->name, offset), position, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return oracle_append_polygon(source, input->options, oracle_place_byte(input->name, offset),
                                 corners, NULL, 3, error);
}

static burnish_status read_binary(const oracle_reader_input *input, oracle_source *source,
                                  burnish_error *error) {
    uint32_t count = read_u32(input->bytes + 80);
    oracle_place place = oracle_place_byte(input->name, 80);
    burnish_status status = check_binary_size(input, count, source, error);
    if (status == BURNISH_STATUS_OK) {
        status = oracle_reserve_triangles(source, input->options, place, count, error);
    }
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = read_facet(input, HEADER_SIZE + i * FACET_SIZE, source, error);
    }
    return status;
}

/* ---- which ---- */

/* Text starts with "solid", and shows no control characters; a binary file has zeros in the upper
 * bytes of its count at the latest. */
static int is_text(const oracle_reader_input *input) {
    oracle_text text = oracle_text_open(input->bytes, input->size, 0);
    oracle_token word;
    if (!oracle_text_word(&text, &word) || !oracle_token_is_caseless(word, "solid")) {
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

burnish_status oracle_read_stl(const oracle_reader_input *input, oracle_source *source,
                               burnish_error *error) {
    burnish_status status;
    if (input->size == 0) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_byte(input->name, 0),
                              "the file is empty; fetch it again");
    }
    int exact = input->size >= HEADER_SIZE && (input->size - HEADER_SIZE) % FACET_SIZE == 0 &&
                (input->size - HEADER_SIZE) / FACET_SIZE == read_u32(input->bytes + 80);
    if (!exact && is_text(input)) {
        status = oracle_read_stl_text(input, source, error);
    } else if (input->size < HEADER_SIZE) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT,
                              oracle_place_byte(input->name, input->size),
                              "the file ends within the %d bytes of a binary STL header and is "
                              "no ASCII STL; fetch it again",
                              HEADER_SIZE);
    } else {
        status = read_binary(input, source, error);
    }
    if (status == BURNISH_STATUS_OK && source->triangle_count == 0) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_file(input->name),
                              "no triangles; export the mesh again");
    }
    return status;
}
