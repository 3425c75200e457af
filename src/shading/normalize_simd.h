/* Vectors to unit length, over arrays. */
#ifndef BURNISH_SHADING_NORMALIZE_SIMD_H
#define BURNISH_SHADING_NORMALIZE_SIMD_H

#include <string.h>

#include "simd/vector_math.h"

BURNISH_INLINE void normalize_vectors(const float *const in[3], size_t from, float *const out[3],
                                      size_t to) {
    vf x = vf_load(in[0] + from), y = vf_load(in[1] + from), z = vf_load(in[2] + from);
    vf squared = vf_add(vf_add(vf_mul(x, x), vf_mul(y, y)), vf_mul(z, z));
    vf scale = vector_inverse_sqrt(squared);
    vf_store(out[0] + to, vf_mul(x, scale));
    vf_store(out[1] + to, vf_mul(y, scale));
    vf_store(out[2] + to, vf_mul(z, scale));
}

static void normalize_array(size_t count, const float *const in[3], float *const out[3]) {
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        normalize_vectors(in, i, out, i);
    }
    if (i < count) {
        float block[3][LANES];
        float *const blocks[3] = {block[0], block[1], block[2]};
        const float *const sources[3] = {block[0], block[1], block[2]};
        memset(block, 0, sizeof block);
        for (int axis = 0; axis < 3; ++axis) {
            memcpy(block[axis], in[axis] + i, (count - i) * sizeof(float));
        }
        normalize_vectors(sources, 0, blocks, 0);
        for (int axis = 0; axis < 3; ++axis) {
            memcpy(out[axis] + i, block[axis], (count - i) * sizeof(float));
        }
    }
}

#endif
