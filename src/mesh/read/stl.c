/* STL, ASCII and binary (3D Systems, "StereoLithography Interface Specification", 1989).
 *
 * One in seven binary files on sharing sites starts with "solid", so the size decides first. Facet
 * normals and attribute bytes are passed over: normals are redundant and often wrong. */
#include <stdatomic.h>
#include <string.h>

#include "mesh/read/append.h"
#include "mesh/read/stl_text.h"

enum { HEADER_SIZE = 84, FACET_SIZE = 50, NORMAL_SIZE = 12, LOOKED_AT = 512 };

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
            size_t at = offset + NORMAL_SIZE + 12 * i + 4 * k;
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

/* ---- binary by ranges ---- */

enum { SHARE = 1 << 14 /* facets that a thread takes at once */ };

typedef struct facet_context {
    const uint8_t *bytes; /* the first facet */
    float *positions;
    uint32_t *corners;
    atomic_int bad; /* 1: a coordinate is not finite */
} facet_context;

static void convert_facets(void *of, size_t first, size_t end) {
    facet_context *context = of;
    uint32_t bad = 0;
    for (size_t i = first; i < end; ++i) {
        const uint8_t *from = context->bytes + i * FACET_SIZE + NORMAL_SIZE;
        float *to = context->positions + 9 * i;
        uint32_t bits[9];
        for (size_t k = 0; k < 9; ++k) {
            bits[k] = read_u32(from + 4 * k);
            bad |= (bits[k] & 0x7F800000u) == 0x7F800000u;
        }
        memcpy(to, bits, sizeof bits);
        for (size_t k = 0; k < 3; ++k) {
            context->corners[3 * i + k] = (uint32_t)(3 * i + k);
        }
    }
    if (bad) {
        atomic_store(&context->bad, 1);
    }
}

/* All facets at once, for whose triangles there is room; *done: whether that was possible. What is
 * wrong otherwise, reading facet by facet will tell. */
static burnish_status read_facets(const burnish_reader_input *input, size_t count,
                                  burnish_source *source, int *done, burnish_error *error) {
    *done = 0;
    if (source->position_count > 0 || source->triangle_count > 0 ||
        count > BURNISH_POSITION_LIMIT / 3) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_legacy_reserve_discard((void **)&source->positions, &source->position_capacity,
                                       3 * count, 3 * sizeof(float), "positions", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    facet_context context = {.bytes = input->bytes + HEADER_SIZE,
                             .positions = source->positions,
                             .corners = source->corner_positions};
    burnish_tasks_ranges(source->pool, count, SHARE, convert_facets, &context);
    if (!atomic_load(&context.bad)) {
        source->position_count = 3 * count;
        source->triangle_count = count;
        *done = 1;
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_binary(const burnish_reader_input *input, burnish_source *source,
                                  burnish_error *error) {
    uint32_t count = read_u32(input->bytes + 80);
    burnish_place place = burnish_place_byte(input->name, 80);
    int done = 0;
    burnish_status status = check_binary_size(input, count, source, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_reserve_triangles(source, input->options, place, count, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = read_facets(input, count, source, &done, error);
    }
    for (size_t i = 0; i < count && !done && status == BURNISH_STATUS_OK; ++i) {
        status = read_facet(input, HEADER_SIZE + i * FACET_SIZE, source, error);
    }
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
        status = burnish_read_stl_text(input, source, error);
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
