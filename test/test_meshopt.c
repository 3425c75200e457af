/* The decoders of EXT_meshopt_compression against meshoptimizer's encoders and decoders. */
#include "mesh/read/meshopt.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

#include "support.h"

enum { ELEMENTS = 700, BYTES = ELEMENTS * 256, ROOM = 4 * BYTES };

static uint8_t data[BYTES], decoded[BYTES], expected[BYTES];
static unsigned char packed[ROOM];
static uint32_t indices[3 * ELEMENTS];

/* Decodes from a block of exactly the size, so that sanitizers see what is read beyond. */
static int decode(burnish_meshopt_mode mode, size_t size, size_t count, size_t stride) {
    uint8_t *copy = malloc(size + !size);
    memcpy(copy, packed, size);
    memset(decoded, 0xAA, sizeof decoded);
    const int good = burnish_meshopt_decode(mode, copy, size, count, stride, decoded);
    free(copy);
    return good;
}

/* Whatever is cut off or turned over, it ends; what is cut off is noticed. Where meshoptimizer
 * takes damaged bytes, too, the result is the same. */
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

/* The encoder may turn a triangle's corners around: meshoptimizer's decoder says how. */
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
    return test_end("meshopt");
}
