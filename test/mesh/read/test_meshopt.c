/* The decoders of EXT_ and KHR_meshopt_compression against meshoptimizer's encoders and decoders.
 */
#include "mesh/read/gltf/meshopt.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

#include "support.h"

enum { ELEMENTS = 700, BYTES = ELEMENTS * 256, ROOM = 4 * BYTES };

static uint8_t data[BYTES], decoded[BYTES], expected[BYTES];
static unsigned char packed[ROOM];
static uint32_t indices[3 * ELEMENTS];

/* Decodes from a block of the exact size, to let sanitizers detect reads beyond it. */
static int decode(burnish_meshopt_mode mode, size_t size, size_t count, size_t stride) {
    uint8_t *copy = malloc(size + !size);
    memcpy(copy, packed, size);
    memset(decoded, 0xAA, sizeof decoded);
    const int good = burnish_meshopt_decode(mode, copy, size, count, stride, decoded);
    free(copy);
    return good;
}

/* Any truncation or changed bit ends safely, and truncation is detected. If meshoptimizer also
 * accepts damaged bytes, the result is the same. */
static void damage(burnish_meshopt_mode mode, size_t size, size_t count, size_t stride,
                   uint64_t *state) {
    for (size_t cut = 0; cut < size; cut += 1 + size / 100) {
        CHECK1(!decode(mode, cut, count, stride));
    }
    for (int i = 0; i < 100; ++i) {
        const size_t at = test_random32(state) % size;
        const unsigned char kept = packed[at];
        packed[at] ^= (unsigned char)(1u << test_random32(state) % 8);
        const int good = decode(mode, size, count, stride);
        if (packed[0] == 0xA1) { /* the version that the library does not have */
            packed[at] = kept;
            continue;
        }
        const int wanted =
            (mode == BURNISH_MESHOPT_ATTRIBUTES
                 ? meshopt_decodeVertexBuffer(expected, count, stride, packed, size)
             : mode == BURNISH_MESHOPT_TRIANGLES
                 ? meshopt_decodeIndexBuffer(expected, count, stride, packed, size)
                 : meshopt_decodeIndexSequence(expected, count, stride, packed, size)) == 0;
        CHECK(good == wanted || mode != BURNISH_MESHOPT_ATTRIBUTES, "mode %d byte %zu of %zu", mode,
              at, size);
        if (good && wanted) {
            CHECK1(memcmp(decoded, expected, count * stride) == 0);
        }
        packed[at] = kept;
    }
}

/* Smooth, noisy and constant bytes use all kinds of groups. */
static void test_attributes(void) {
    static const size_t strides[] = {4, 8, 12, 16, 36, 64, 252, 256};
    uint64_t state = 7;
    for (size_t s = 0; s < sizeof strides / sizeof *strides; ++s) {
        for (size_t count = 1; count <= ELEMENTS; count += 1 + count * 2 / 3) {
            const size_t stride = strides[s];
            for (size_t i = 0; i < count * stride; ++i) {
                const unsigned kind = (unsigned)(i % stride + i / stride / 16) % 4;
                const uint32_t r = test_random32(&state);
                data[i] = (uint8_t)(kind == 0 ? 5 : kind == 1 ? r % 2 : kind == 2 ? r % 7 : r);
            }
            const size_t size = meshopt_encodeVertexBuffer(packed, ROOM, data, count, stride);
            CHECK1(decode(BURNISH_MESHOPT_ATTRIBUTES, size, count, stride));
            CHECK(memcmp(decoded, data, count * stride) == 0, "%zu of %zu", count, stride);
            if (count < 200) {
                damage(BURNISH_MESHOPT_ATTRIBUTES, size, count, stride, &state);
            }
        }
    }
}

/* ---- Version 1, which Debian's meshoptimizer does not have: by an encoder of the test's own ----
 */

static uint32_t bytes_at(const uint8_t *p, size_t size) {
    uint32_t value = 0;
    memcpy(&value, p, size); /* little-endian */
    return value;
}

/* The encoding of an element's bytes, by its channels. */
static void find_differences(const uint8_t *now, const uint8_t *before, size_t stride,
                             const uint8_t *channels, uint8_t *to) {
    for (size_t k = 0; k < stride;) {
        const unsigned mode = channels[k / 4] & 15, turn = channels[k / 4] >> 4;
        const size_t size = mode == 0 ? 1 : mode == 1 ? 2 : 4;
        const uint32_t a = bytes_at(now + k, size), b = bytes_at(before + k, size);
        uint32_t d;
        if (mode == 2) {
            const uint32_t x = a ^ b;
            d = x << turn | x >> ((32 - turn) & 31);
        } else {
            const uint32_t top = 1u << (8 * size - 1), all = 2 * top - 1,
                           difference = (a - b) & all;
            d = difference & top ? ~(difference << 1) & all : difference << 1;
        }
        memcpy(to + k, &d, size);
        k += size;
    }
}

/* Groups of 16 differences in the fewest bits of four choices, or, for one in 8, in any. */
static unsigned char *put_groups(unsigned char *to, const uint8_t *differences, size_t count,
                                 const uint8_t bits[4], uint64_t *state) {
    const size_t groups = (count + 15) / 16;
    unsigned char *kinds = to;
    memset(to, 0, (groups + 3) / 4);
    to += (groups + 3) / 4;
    for (size_t g = 0; g < groups; ++g) {
        uint8_t group[16] = {0};
        memcpy(group, differences + 16 * g, count - 16 * g < 16 ? count - 16 * g : 16);
        int is_zero = 1;
        for (int i = 0; i < 16; ++i) {
            is_zero &= group[i] == 0;
        }
        unsigned kind = is_zero ? 0 : 1 + test_random32(state) % 3;
        kinds[g / 4] |= (unsigned char)(kind << g % 4 * 2);
        const unsigned width = bits[kind], most = (1u << width) - 1;
        memset(to, 0, 2 * width);
        unsigned char *more = to + 2 * width;
        for (unsigned i = 0; i < 16 && width == 8; ++i) {
            to[i] = group[i];
        }
        for (unsigned i = 0; i < 16 && width > 0 && width < 8; ++i) {
            const unsigned value = group[i] < most ? group[i] : most, at = i * width;
            to[at / 8] |= (unsigned char)(value << (width == 1 ? at % 8 : 8 - width - at % 8));
            if (value == most) {
                *more++ = group[i];
            }
        }
        to = more;
    }
    return to;
}

static size_t encode_version_1(size_t count, size_t stride, const uint8_t *channels,
                               uint64_t *state) {
    static const uint8_t bits[2][4] = {{0, 1, 2, 4}, {1, 2, 4, 8}};
    static uint8_t differences[256 * 256];
    const size_t fitting = 8192 / stride / 16 * 16, block = fitting < 256 ? fitting : 256;
    uint8_t before[256];
    unsigned char *to = packed;
    for (size_t k = 0; k < stride; ++k) {
        before[k] = (uint8_t)test_random32(state);
    }
    uint8_t first[256];
    memcpy(first, before, stride);
    *to++ = 0xA1;
    for (size_t start = 0; start < count; start += block) {
        const size_t some = count - start < block ? count - start : block;
        unsigned char *controls = to;
        memset(to, 0, stride / 4);
        to += stride / 4;
        for (size_t i = 0; i < some; ++i) {
            find_differences(data + (start + i) * stride, before, stride, channels,
                             differences + i * stride);
            memcpy(before, data + (start + i) * stride, stride);
        }
        for (size_t k = 0; k < stride; ++k) {
            uint8_t column[256];
            int is_zero = 1;
            for (size_t i = 0; i < some; ++i) {
                column[i] = differences[i * stride + k];
                is_zero &= column[i] == 0;
            }
            unsigned control = is_zero ? 2 : test_random32(state) % 3;
            control += control == 2 && !is_zero; /* 3: unpacked */
            controls[k / 4] |= (unsigned char)(control << k % 4 * 2);
            if (control == 3) {
                memcpy(to, column, some);
                to += some;
            } else if (control < 2) {
                to = put_groups(to, column, some, bits[control], state);
            }
        }
    }
    const size_t used = stride + stride / 4, padding = used < 24 ? 24 - used : 0;
    memset(to, 0, padding);
    memcpy(to + padding, first, stride);
    memcpy(to + padding + stride, channels, stride / 4);
    return (size_t)(to - packed) + padding + used;
}

static void test_version_1(void) {
    static const size_t strides[] = {4, 8, 16, 36, 252, 256};
    uint64_t state = 11;
    for (size_t s = 0; s < sizeof strides / sizeof *strides; ++s) {
        for (size_t count = 1; count <= ELEMENTS; count += 1 + count * 2 / 3) {
            const size_t stride = strides[s];
            uint8_t channels[64];
            for (size_t k = 0; k < stride / 4; ++k) {
                const unsigned mode = test_random32(&state) % 3;
                channels[k] = (uint8_t)(mode == 2 ? 2 | test_random32(&state) % 16 << 4 : mode);
            }
            for (size_t i = 0; i < count * stride; ++i) {
                const uint32_t r = test_random32(&state);
                data[i] = (uint8_t)(i % stride % 4 == 3 ? 5
                                    : i % 4 == 2        ? r % 2
                                                        : i / stride + r % 3);
            }
            const size_t size = encode_version_1(count, stride, channels, &state);
            CHECK1(decode(BURNISH_MESHOPT_ATTRIBUTES, size, count, stride));
            CHECK(memcmp(decoded, data, count * stride) == 0, "%zu of %zu", count, stride);
            for (size_t cut = 0; cut < size; cut += 1 + size / 50) {
                CHECK1(!decode(BURNISH_MESHOPT_ATTRIBUTES, cut, count, stride));
            }
            for (int i = 0; i < 50; ++i) { /* any changed bit ends safely */
                const size_t at = test_random32(&state) % size;
                const unsigned char kept = packed[at];
                packed[at] ^= (unsigned char)(1u << test_random32(&state) % 8);
                decode(BURNISH_MESHOPT_ATTRIBUTES, size, count, stride);
                packed[at] = kept;
            }
            for (unsigned bad = 3; bad < 256; ++bad) {
                packed[size - 1] = (unsigned char)bad;
                const int good = decode(BURNISH_MESHOPT_ATTRIBUTES, size, count, stride);
                CHECK((bad & 15) == 2 || !good, "channel %u", bad);
            }
        }
    }
}

/* Luma, differences and alpha of K bits, with the expected values computed by hand. */
static void test_colors(void) {
    static const struct {
        int16_t in[4];
        uint16_t out[4];
        size_t stride;
    } cases[] = {
        {{128, 0, 0, 0xFF}, {128, 128, 128, 255}, 4},   /* K = 8 */
        {{100, 20, -10, 0x80}, {130, 90, 90, 0}, 4},    /* alpha 0 */
        {{3, 0, 0, 3}, {255, 255, 255, 255}, 4},        /* K = 2 */
        {{1, 0, 1, 2}, {0, 170, 0, 0}, 4},              /* of 3 */
        {{100, 100, 100, 0xC0}, {100, 200, 0, 128}, 4}, /* b = -100 is 0 */
        {{1023, 0, 0, 0x3FF}, {65535, 65535, 65535, 65535}, 8},
        {{512, -100, 50, 0x200}, {23190, 36003, 36003, 0}, 8},
        {{0x7FFF, 0, 0, (int16_t)0xFFFF}, {32767, 32767, 32767, 65535}, 8},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        uint8_t bytes[8];
        for (size_t k = 0; k < 4; ++k) {
            memcpy(bytes + cases[i].stride / 4 * k, &cases[i].in[k], cases[i].stride / 4);
        }
        burnish_meshopt_unfilter(BURNISH_MESHOPT_COLOR, 1, cases[i].stride, bytes);
        for (size_t k = 0; k < 4; ++k) {
            const uint32_t found = bytes_at(bytes + cases[i].stride / 4 * k, cases[i].stride / 4);
            CHECK(found == cases[i].out[k], "case %zu, %zu: %u", i, k, found);
        }
    }
}

/* The encoder may rotate a triangle's corners; meshoptimizer's decoder shows how. */
static void test_indices(void) {
    uint64_t state = 8;
    for (size_t i = 0; i < 60; ++i) {
        const size_t count = 3 * (1 + test_random32(&state) % ELEMENTS), stride = 2 + 2 * (i % 2);
        const uint32_t most = i % 3 == 0 ? 5 : i % 3 == 1 ? 300 : 60000;
        for (size_t k = 0; k < count; ++k) { /* a grid's, with gaps */
            const uint32_t quad = (uint32_t)k / 6, step[6] = {0, 1, 20, 20, 1, 21};
            indices[k] =
                test_random32(&state) % 16 == 0 ? test_random32(&state) % most : quad + step[k % 6];
        }
        meshopt_encodeIndexVersion((int)(i / 2 % 2));
        size_t size = meshopt_encodeIndexBuffer(packed, ROOM, indices, count);
        CHECK1(meshopt_decodeIndexBuffer(expected, count, stride, packed, size) == 0);
        CHECK1(decode(BURNISH_MESHOPT_TRIANGLES, size, count, stride));
        CHECK(memcmp(decoded, expected, count * stride) == 0, "%zu", i);
        damage(BURNISH_MESHOPT_TRIANGLES, size, count, stride, &state);
        size = meshopt_encodeIndexSequence(packed, ROOM, indices, count);
        CHECK1(meshopt_decodeIndexSequence(expected, count, stride, packed, size) == 0);
        CHECK1(decode(BURNISH_MESHOPT_INDICES, size, count, stride));
        CHECK(memcmp(decoded, expected, count * stride) == 0, "%zu", i);
        damage(BURNISH_MESHOPT_INDICES, size, count, stride, &state);
    }
}

/* Within a step of meshoptimizer's single precision; exponents exactly. */
static void test_filters(void) {
    static float values[4 * ELEMENTS];
    uint64_t state = 9;
    for (size_t i = 0; i < ELEMENTS; ++i) {
        double square = 0;
        for (size_t k = 0; k < 4; ++k) {
            values[4 * i + k] = test_uniform_float(&state, -1, 1);
            square += (double)values[4 * i + k] * (double)values[4 * i + k];
        }
        for (size_t k = 0; k < 4; ++k) {
            values[4 * i + k] /= (float)sqrt(square);
        }
    }
    for (size_t stride = 4; stride <= 8; stride += 4) {
        meshopt_encodeFilterOct(data, ELEMENTS, stride, stride == 4 ? 8 : 12, values);
        memcpy(expected, data, sizeof data);
        meshopt_decodeFilterOct(expected, ELEMENTS, stride);
        burnish_meshopt_unfilter(BURNISH_MESHOPT_OCTAHEDRAL, ELEMENTS, stride, data);
        for (size_t i = 0; i < 4 * ELEMENTS; ++i) {
            const int a = stride == 4 ? (int8_t)data[i] : ((int16_t *)(void *)data)[i];
            const int b = stride == 4 ? (int8_t)expected[i] : ((int16_t *)(void *)expected)[i];
            CHECK(abs(a - b) <= 1, "%zu: %d %d", i, a, b);
        }
    }
    meshopt_encodeFilterQuat(data, ELEMENTS, 8, 12, values);
    memcpy(expected, data, sizeof data);
    meshopt_decodeFilterQuat(expected, ELEMENTS, 8);
    burnish_meshopt_unfilter(BURNISH_MESHOPT_QUATERNION, ELEMENTS, 8, data);
    for (size_t i = 0; i < 4 * ELEMENTS; ++i) {
        CHECK1(abs(((int16_t *)(void *)data)[i] - ((int16_t *)(void *)expected)[i]) <= 1);
    }
    meshopt_encodeFilterExp(data, ELEMENTS, 12, 15, values);
    memcpy(expected, data, sizeof data);
    meshopt_decodeFilterExp(expected, ELEMENTS, 12);
    burnish_meshopt_unfilter(BURNISH_MESHOPT_EXPONENTIAL, ELEMENTS, 12, data);
    CHECK1(memcmp(data, expected, (size_t)12 * ELEMENTS) == 0);
}

int main(void) {
    RUN(test_attributes());
    RUN(test_indices());
    RUN(test_filters());
    RUN(test_version_1());
    RUN(test_colors());
    return test_end("meshopt");
}
