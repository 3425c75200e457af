/* Bringing the points of one material together, by whole vectors: a vector that shows several
 * materials is shaded once for each, which costs less than sorting its points. */
#ifndef BURNISH_RENDER_TEXTURE_MATERIALS_SIMD_H
#define BURNISH_RENDER_TEXTURE_MATERIALS_SIMD_H

#include <string.h>

#include "render/render_ops.h"
#include "simd/vector.h"

static int collect_material(int32_t material, int first, int count, int32_t *left,
                            const burnish_batch_streams *streams, uint8_t *starts) {
    const vi wanted = vi_set(material), done = vi_set(-1);
    int size = 0;
    for (int i = first / (int)LANES * (int)LANES; i < count; i += LANES) {
        const vi before = vi_load(left + i);
        const vm here = vi_equal(before, wanted);
        if (!vm_any(here)) {
            continue;
        }
        vi_store(left + i, vi_blend(here, done, before));
        for (int k = 0; k < streams->count; ++k) {
            vf_store(streams->to[k] + size, vf_load(streams->from[k] + i));
        }
        starts[size / (int)LANES] = (uint8_t)i;
        size += LANES;
    }
    return size;
}

static void scatter_material(int32_t material, const int32_t *materials, int size,
                             const uint8_t *starts, const float *const from[3],
                             float *const to[3]) {
    for (int i = 0; i < size; i += LANES) {
        const int start = starts[i / (int)LANES];
        const vm here = vi_equal(vi_load(materials + start), vi_set(material));
        for (int k = 0; k < 3; ++k) {
            vf_store(to[k] + start, vf_blend(here, vf_load(from[k] + i), vf_load(to[k] + start)));
        }
    }
}

#endif
