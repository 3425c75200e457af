/* Transforms vertices, and culls and bounds triangles, with SIMD. */
#ifndef BURNISH_RASTER_GEOMETRY_SIMD_H
#define BURNISH_RASTER_GEOMETRY_SIMD_H

#include <string.h>

#include "raster/geometry.h"
#include "raster/tile_layout.h"
#include "simd/vector.h"

enum { ALL_LANES = (int)((1ull << LANES) - 1) };

/* The planes that a vertex lies beyond: BURNISH_OUT_... */
BURNISH_INLINE vi compute_outcodes(const burnish_raster_view *view, const vf clip[4]) {
    const vi none = vi_set(0);
    const vf zero = vf_set(0.0f);
    vf half_width = vf_mul(vf_set((float)view->width * 0.5f), clip[3]);
    vf half_height = vf_mul(vf_set((float)view->height * 0.5f), clip[3]);
    vf guard = vf_mul(vf_set(BURNISH_GUARD_BAND), clip[3]);
    vf low_guard = vf_sub(zero, guard);
    vi code =
        vi_blend(vf_greater(vf_sub(zero, half_width), clip[0]), vi_set(BURNISH_OUT_LEFT), none);
    code = vi_or(code, vi_blend(vf_greater(clip[0], half_width), vi_set(BURNISH_OUT_RIGHT), none));
    code = vi_or(code, vi_blend(vf_greater(vf_sub(zero, half_height), clip[1]),
                                vi_set(BURNISH_OUT_BOTTOM), none));
    code = vi_or(code, vi_blend(vf_greater(clip[1], half_height), vi_set(BURNISH_OUT_TOP), none));
    code = vi_or(code, vi_blend(vf_greater(clip[2], clip[3]), vi_set(BURNISH_OUT_NEAR), none));
    const vi beyond = vi_set(BURNISH_OUT_GUARD);
    for (int k = 0; k < 2; ++k) {
        code = vi_or(code, vi_blend(vf_greater(low_guard, clip[k]), beyond, none));
        code = vi_or(code, vi_blend(vf_greater(clip[k], guard), beyond, none));
    }
    return code;
}

/* burnish_to_fixed. */
BURNISH_INLINE vi to_fixed(vf pixels) {
    const vf rounder = vf_set(BURNISH_ROUNDER);
    vf sum = vf_add(vf_mul(pixels, vf_set((float)BURNISH_SUBPIXELS)), rounder);
    return vi_sub(vf_bits(sum), vf_bits(rounder));
}

/* LANES vertices: what vf_store_aos4 makes screen vertices of, and 1 / w. */
BURNISH_INLINE vf transform_vector(const burnish_raster_view *view, const vf position[3],
                                   vf to[4]) {
    vf p[3], clip[4];
    for (int k = 0; k < 3; ++k) {
        p[k] = vf_sub(position[k], vf_set(view->origin[k]));
    }
    for (int i = 0; i < 4; ++i) {
        const float *row = view->rows[i];
        vf sum = vf_add(vf_mul(vf_set(row[0]), p[0]), vf_mul(vf_set(row[1]), p[1]));
        clip[i] = vf_add(vf_add(sum, vf_mul(vf_set(row[2]), p[2])), vf_set(row[3]));
    }
    vi code = compute_outcodes(view, clip);
    /* nothing but the code of a vertex that only clipped triangles use */
    vm whole = vi_equal(vi_and(code, vi_set(BURNISH_OUT_CLIP)), vi_set(0));
    vf inverse_w = vf_div(vf_set(1.0f), clip[3]);
    vi center_x = vi_set(view->width * (BURNISH_SUBPIXELS / 2));
    vi center_y = vi_set(view->height * (BURNISH_SUBPIXELS / 2));
    vi x = vi_add(to_fixed(vf_mul(clip[0], inverse_w)), center_x);
    vi y = vi_sub(center_y, to_fixed(vf_mul(clip[1], inverse_w)));
    to[0] = vf_and_mask(whole, vf_from_bits(x));
    to[1] = vf_and_mask(whole, vf_from_bits(y));
    to[2] = vf_and_mask(whole, vf_mul(clip[2], inverse_w));
    to[3] = vf_from_bits(code);
    return vf_and_mask(whole, inverse_w);
}

static void transform_vertices(burnish_screen_vertices *vertices, const burnish_raster_view *view,
                               const float *positions, size_t first, size_t end) {
    const vi stride = vi_ramp(3);
    vf p[3], to[4];
    size_t i = first;
    for (; i + LANES <= end; i += LANES) {
        for (int k = 0; k < 3; ++k) {
            p[k] = vf_gather(positions + 3 * i + k, stride);
        }
        vf_store(vertices->inverse_w + i, transform_vector(view, p, to));
        vf_store_aos4(&vertices->items[i], to[0], to[1], to[2], to[3]);
    }
    if (i < end) { /* fewer than a vector has */
        float rest[3][LANES], inverse_w[LANES];
        burnish_screen_vertex items[LANES];
        memset(rest, 0, sizeof rest);
        for (size_t lane = 0; lane < end - i; ++lane) {
            for (size_t k = 0; k < 3; ++k) {
                rest[k][lane] = positions[3 * (i + lane) + k];
            }
        }
        for (int k = 0; k < 3; ++k) {
            p[k] = vf_load(rest[k]);
        }
        vf_store(inverse_w, transform_vector(view, p, to));
        vf_store_aos4(items, to[0], to[1], to[2], to[3]);
        memcpy(vertices->inverse_w + i, inverse_w, (end - i) * sizeof *inverse_w);
        memcpy(&vertices->items[i], items, (end - i) * sizeof *items);
    }
}

/* First and last pixel along one axis whose samples can lie between the minimum and the maximum of
 * three coordinates in 1/256 pixel; with one sample, pixels whose centre does. */
BURNISH_INLINE void bound_pixels(int samples, const vi at[3], int size, vi *first, vi *last) {
    const int to_first = samples == 1 ? BURNISH_SUBPIXELS / 2 - 1 : 0;
    const int to_last = samples == 1 ? BURNISH_SUBPIXELS / 2 : 0;
    vi low = vi_min(vi_min(at[0], at[1]), at[2]), high = vi_max(vi_max(at[0], at[1]), at[2]);
    low = vi_sar(vi_add(low, vi_set(to_first)), BURNISH_SUBPIXEL_BITS);
    high = vi_sar(vi_sub(high, vi_set(to_last)), BURNISH_SUBPIXEL_BITS);
    *first = vi_max(low, vi_set(0));
    *last = vi_min(high, vi_set(size - 1));
}

/* The HiZ cells of pixels. */
BURNISH_INLINE vi pack_cells(vi x, vi y) {
    return vi_or(vi_shr(x, BURNISH_HIZ_BITS), vi_shl(vi_shr(y, BURNISH_HIZ_BITS), 16));
}

/* Triangles of a batch: bits. */
typedef struct cull_bits {
    unsigned visible, back; /* are bounded; are back-facing */
    unsigned clipped;       /* must be clipped */
} cull_bits;

/* The 64-bit areas of triangles that need them, lane by lane: lanes where they are positive, and
 * not 0. */
BURNISH_INLINE void measure_64_bits(unsigned lanes, const vi dx[2], const vi dy[2], unsigned *back,
                                    unsigned *has_area) {
    int32_t d[4][LANES];
    for (int i = 0; i < 2; ++i) {
        vi_store(d[i], dx[i]);
        vi_store(d[2 + i], dy[i]);
    }
    for (; lanes; lanes &= lanes - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(lanes), bit = 1u << lane;
        const int64_t area = (int64_t)d[0][lane] * d[3][lane] - (int64_t)d[1][lane] * d[2][lane];
        *back = area > 0 ? *back | bit : *back & ~bit;
        *has_area = area != 0 ? *has_area | bit : *has_area & ~bit;
    }
}

/* Culls LANES triangles, whose items in the batch begin at `at`; vertices[i] are pointers to their
 * corners i. */
BURNISH_INLINE cull_bits cull_vector(const burnish_raster_view *view,
                                     const void *vertices[3][LANES], burnish_triangle_batch *batch,
                                     size_t at) {
    vi x[3], y[3], all = vi_set(-1), any = vi_set(0), longest = vi_set(0);
    vf depth[3];
    for (int i = 0; i < 3; ++i) {
        vf vertex[4];
        vf_load_aos4(vertices[i], vertex);
        x[i] = vf_bits(vertex[0]);
        y[i] = vf_bits(vertex[1]);
        depth[i] = vertex[2];
        all = vi_and(all, vf_bits(vertex[3]));
        any = vi_or(any, vf_bits(vertex[3]));
    }
    const vi dx[2] = {vi_sub(x[1], x[0]), vi_sub(x[2], x[0])};
    const vi dy[2] = {vi_sub(y[1], y[0]), vi_sub(y[2], y[0])};
    for (int i = 0; i < 2; ++i) {
        longest = vi_max(longest, vi_max(vi_magnitude(dx[i]), vi_magnitude(dy[i])));
    }
    longest =
        vi_max(longest, vi_max(vi_magnitude(vi_sub(x[2], x[1])), vi_magnitude(vi_sub(y[2], y[1]))));
    vi area = vi_sub(vi_mul(dx[0], dy[1]), vi_mul(dx[1], dy[0]));
    vm out = vi_not_zero(vi_and(all, vi_set(BURNISH_OUT_REJECT)));
    vm clipped = vm_and_not(vi_not_zero(vi_and(any, vi_set(BURNISH_OUT_CLIP))), out);
    const unsigned in = vm_bits(vm_not(vm_or(out, clipped)));
    unsigned has_area = vm_bits(vi_not_zero(area));
    cull_bits bits = {0, vm_bits(vi_greater(area, vi_set(0))), vm_bits(clipped)};
    const unsigned beyond = in & vm_bits(vi_greater(longest, vi_set(BURNISH_EDGE_32_BITS)));
    if (beyond) { /* rare */
        measure_64_bits(beyond, dx, dy, &bits.back, &has_area);
    }
    const unsigned kept = in & has_area & (view->cull_back_faces ? ~bits.back : ~0u);
    if (!kept) { /* neighbours often face the same side */
        return bits;
    }
    vi x0, y0, x1, y1;
    bound_pixels(view->samples, x, view->width, &x0, &x1);
    bound_pixels(view->samples, y, view->height, &y0, &y1);
    vm outside = vm_or(vi_greater(x0, x1), vi_greater(y0, y1));
    vf_store(batch->nearest + at, vf_max(vf_max(depth[0], depth[1]), depth[2]));
    vi_store((int32_t *)batch->first + at, pack_cells(x0, y0));
    vi_store((int32_t *)batch->last + at, pack_cells(x1, y1));
    bits.visible = kept & ~vm_bits(outside);
    return bits;
}

/* Triangles of a batch whose bounds touch more than one tile. */
BURNISH_INLINE unsigned spans_tiles(const burnish_triangle_batch *batch) {
    unsigned spanning = 0;
    for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
        vi first = vi_load((const int32_t *)batch->first + at);
        vi last = vi_load((const int32_t *)batch->last + at);
        vi difference = vi_and(vi_xor(first, last), vi_set((int32_t)BURNISH_HIZ_TILE_MASK));
        spanning |= vm_bits(vi_not_zero(difference)) << at;
    }
    return spanning;
}

/* Triangles of a batch whose bounds begin in another tile. */
BURNISH_INLINE unsigned begins_elsewhere(const burnish_triangle_batch *batch, uint32_t tile) {
    const vi wanted = vi_set((int32_t)tile), bits = vi_set((int32_t)BURNISH_HIZ_TILE_MASK);
    unsigned elsewhere = 0;
    for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
        vi first = vi_load((const int32_t *)batch->first + at);
        elsewhere |= vm_bits(vm_not(vi_equal(vi_and(first, bits), wanted))) << at;
    }
    return elsewhere;
}

static int cull_and_bound(const burnish_screen_vertices *vertices, const burnish_raster_view *view,
                          const uint32_t *indices, size_t count, burnish_triangle_batch *batch,
                          burnish_batch_header *header, unsigned *clipped) {
    const void *corners[3][LANES];
    unsigned visible = 0, back = 0, cut = 0;
    for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t triangle = at + lane < count ? at + lane : 0;
            for (size_t i = 0; i < 3; ++i) {
                corners[i][lane] = &vertices->items[indices[3 * triangle + i]];
            }
        }
        const cull_bits bits = cull_vector(view, corners, batch, at);
        visible |= bits.visible << at;
        back |= bits.back << at;
        cut |= bits.clipped << at;
    }
    const unsigned real = (1u << count) - 1;
    visible &= real;
    *clipped = cut & real;
    header->visible[0] = (uint16_t)(visible & ~back);
    header->visible[1] = (uint16_t)(visible & back);
    const uint32_t tile =
        visible ? batch->first[__builtin_ctz(visible)] & BURNISH_HIZ_TILE_MASK : 0;
    const unsigned elsewhere = spans_tiles(batch) | begins_elsewhere(batch, tile);
    header->tile = elsewhere & visible ? BURNISH_NO_TILE : tile / BURNISH_HIZ_SIZE;
    return __builtin_popcount(visible);
}

#endif
