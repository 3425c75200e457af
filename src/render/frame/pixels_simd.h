/* Pixels before and after shading: positions from depths, batches of several materials, codes. */
#ifndef BURNISH_RENDER_FRAME_PIXELS_SIMD_H
#define BURNISH_RENDER_FRAME_PIXELS_SIMD_H

#include "core/srgb.h"
#include "raster/geometry.h"
#include "render/render_ops.h"
#include "simd/vector.h"

static void position_from_depth(const burnish_rays *rays, const burnish_screen_points *points,
                                size_t count, float *const position[3], float *w) {
    for (size_t i = 0; i < count; i += LANES) {
        const vf x = vf_add(vf_set(points->x), vf_load(points->x_offset + i));
        const vf y = vf_add(vf_set(points->y), vf_load(points->y_offset + i));
        const vf depth = vf_load(points->depth + i), beyond = vf_sub(vf_set(1.0f), depth);
        for (int k = 0; k < 3; ++k) {
            vf sum = vf_add(vf_set(rays->ray[k]), vf_mul(x, vf_set(rays->ray_x[k])));
            sum = vf_add(sum, vf_mul(y, vf_set(rays->ray_y[k])));
            vf_store(position[k] + i, vf_add(sum, vf_mul(beyond, vf_set(rays->ray_depth[k]))));
        }
        vf_store(w + i, vf_add(vf_mul(depth, vf_set(rays->q_per_depth)), vf_set(rays->q_constant)));
    }
}

/* ---- One material after another, by whole vectors: a vector that shows several materials is
 * shaded once for each, which costs less than sorting its items ---- */

/* Of a table of 16-bit numbers, the last of which no pair starts at. */
BURNISH_INLINE vi gather_16_bits(const uint16_t *table, size_t count, vi index) {
    const vi last = vi_set((int32_t)count - 2);
    const vi pair = vi_gather_pair(table, vi_min(index, last));
    return vi_blend(vi_greater(index, last), vi_shr(pair, 16), vi_and(pair, vi_set(0xffff)));
}

static int find_materials(const uint16_t *of_triangles, size_t triangle_count, const int32_t *ids,
                          const struct burnish_primitive *primitives, const int32_t *shown,
                          size_t count, int32_t *materials) {
    const int32_t *words = (const int32_t *)(const void *)primitives;
    int32_t last = -1, before = -1; /* -1: no pixel has been shown yet */
    int is_one = 1;
    for (size_t i = 0; i < count; i += LANES) {
        const vi simple = vi_load(shown + i), zero = vi_set(0);
        const vm here = vi_not_negative(simple);
        const unsigned bits = vm_bits(here);
        vi id = words ? vi_gather(words + 3, vi_blend(here, vi_shl(simple, 2), zero))
                      : vi_load(ids + i);
        id = vi_blend(here, id, zero); /* no primitive need be there */
        vi material = gather_16_bits(of_triangles, triangle_count, vi_shr(id, 1));
        vi_store(materials + i, material);
        last = bits ? materials[i + (size_t)__builtin_ctz(bits)] : last < 0 ? 0 : last;
        material = vi_blend(here, material, vi_set(last));
        vi_store(materials + i, material);
        before = before < 0 ? last : before;
        is_one &= !vm_any(vm_not(vi_equal(material, vi_set(before))));
    }
    return is_one;
}

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

/* ---- Linear light to sRGB codes, equal to burnish_linear_to_srgb ---- */

/* The code is in the third byte of a lane; the lower ones hold anything. */
BURNISH_INLINE vi encode_vector(const burnish_srgb_encoder *encoder, vf linear) {
    _Static_assert((int)LANES <= (int)BURNISH_SRGB_AROUND, "vi_gather_near reads so far");
    enum { BUCKET = (BURNISH_SRGB_FIRST_BITS >> 16) - BURNISH_SRGB_AROUND };
    /* indices count from float 0 */
    const int32_t *entries =
        (const int32_t *)((uintptr_t)encoder->entries - BUCKET * sizeof *encoder->entries);
    /* the order of the first clamp's operands sends NaN to the lowest bucket */
    vf x = vf_max(linear, vf_from_bits(vi_set(BURNISH_SRGB_FIRST_BITS)));
    x = vf_min(x, vf_from_bits(vi_set(BURNISH_SRGB_LAST_BITS)));
    return vi_add(vi_gather_near(entries, vi_shr(vf_bits(x), 16)), vf_bits(x));
}

/* What encode_vector gives for red, green and blue as pixels. */
BURNISH_INLINE vi join_channels(vi red, vi green, vi blue) {
    return vi_or(vi_or(vi_shr(red, 16), vi_and(vi_shr(green, 8), vi_set(0xff00))),
                 vi_and(blue, vi_set(0xff0000)));
}
BURNISH_INLINE vi join_grey(vi grey) {
#if defined(VECTOR_HAS_PERMUTE)
    const vi of_16_bytes = vi_and(vi_ramp(0x04040404), vi_set(0x0c0c0c0c));
    return vi_shuffle_bytes(grey, vi_or(vi_set((int32_t)0xff020202u), of_16_bytes));
#else
    return join_channels(grey, grey, grey);
#endif
}

/* Whether three vectors have the bits of three others. */
BURNISH_INLINE int is_same(const vf a[3], const vf b[3]) {
    vm same = vi_equal(vf_bits(a[0]), vf_bits(b[0]));
    for (int k = 1; k < 3; ++k) {
        same = vm_and(same, vi_equal(vf_bits(a[k]), vf_bits(b[k])));
    }
    return !vm_any(vm_not(same));
}

/* The codes of three vectors: one conversion where grey materials in white light make them equal. */
BURNISH_INLINE vi encode_light(const burnish_srgb_encoder *encoder, const vf light[3]) {
    const vf grey[3] = {light[0], light[0], light[0]};
    const vi red = encode_vector(encoder, light[0]);
    if (is_same(light, grey)) {
        return join_grey(red);
    }
    return join_channels(red, encode_vector(encoder, light[1]), encode_vector(encoder, light[2]));
}

static void encode_pixels(const burnish_srgb_encoder *encoder, size_t count,
                          const float *const rgb[3], const int32_t *shown, uint32_t alpha,
                          uint32_t background, uint32_t *pixels) {
    vf before[3] = {vf_set(0.0f), vf_set(0.0f),
                    vf_set(0.0f)}; /* on flat faces a vector of pixels is often like the last */
    vi code = vi_set(0);
    for (size_t i = 0; i < count; i += LANES) {
        const vf light[3] = {vf_load(rgb[0] + i), vf_load(rgb[1] + i), vf_load(rgb[2] + i)};
        if (i == 0 || !is_same(light, before)) {
            code = encode_light(encoder, light);
        }
        vi pixel = code;
        if (shown) {
            vm mask = vi_not_negative(vi_load(shown + i));
            pixel =
                vi_blend(mask, vi_or(pixel, vi_set((int32_t)alpha)), vi_set((int32_t)background));
        }
        vi_store((int32_t *)pixels + i, pixel);
        for (int k = 0; k < 3; ++k) {
            before[k] = light[k];
        }
    }
}

static void pack_groups(size_t count, const uint32_t *pixels, size_t stride, uint8_t *to) {
    uint8_t last[16]; /* bytes after the others are written again by the next group */
    for (size_t i = 0; i + 1 < count; ++i) {
        pack_pixels(to + 12 * i, pixels + stride * i);
    }
    if (count > 0) {
        pack_pixels(last, pixels + stride * (count - 1));
        memcpy(to + 12 * (count - 1), last, 12);
    }
}

#endif
