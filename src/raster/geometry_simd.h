/* Vertices to the screen, and triangles to bounds, by vectors. */
#ifndef BURNISH_RASTER_GEOMETRY_SIMD_H
#define BURNISH_RASTER_GEOMETRY_SIMD_H

#include <string.h>

#include "raster/raster.h"
#include "simd/vector.h"

enum { ALL_LANES = (int)((1ull << LANES) - 1) };

/* x below or above any of the view's sides, as burnish_outcode has it. */
BURNISH_INLINE vi find_outcodes(const burnish_raster_view *view, const vf clip[4]) {
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

/* burnish_to_fixed: the sum's lowest bits are the number. */
BURNISH_INLINE vi to_fixed(vf pixels) {
    const vf rounder = vf_set(12582912.0f); /* 1.5 * 2^23 */
    vf sum = vf_add(vf_mul(pixels, vf_set((float)BURNISH_SUBPIXELS)), rounder);
    return vi_sub(vf_bits(sum), vf_bits(rounder));
}

/* LANES vertices: their places as four vectors for vf_store_aos4, and 1 / w. */
BURNISH_INLINE vf place_vertices(const burnish_raster_view *view, const vf position[3], vf to[4]) {
    vf p[3], clip[4];
    for (int k = 0; k < 3; ++k) {
        p[k] = vf_sub(position[k], vf_set(view->origin[k]));
    }
    for (int i = 0; i < 4; ++i) {
        const float *row = view->rows[i];
        vf sum = vf_add(vf_mul(vf_set(row[0]), p[0]), vf_mul(vf_set(row[1]), p[1]));
        clip[i] = vf_add(vf_add(sum, vf_mul(vf_set(row[2]), p[2])), vf_set(row[3]));
    }
    vi code = find_outcodes(view, clip);
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
    const vi apart = vi_ramp(3);
    vf p[3], to[4];
    size_t i = first;
    for (; i + LANES <= end; i += LANES) {
        for (int k = 0; k < 3; ++k) {
            p[k] = vf_gather(positions + 3 * i + k, apart);
        }
        vf_store(vertices->inverse_w + i, place_vertices(view, p, to));
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
        vf_store(inverse_w, place_vertices(view, p, to));
        vf_store_aos4(items, to[0], to[1], to[2], to[3]);
        memcpy(vertices->inverse_w + i, inverse_w, (end - i) * sizeof *inverse_w);
        memcpy(&vertices->items[i], items, (end - i) * sizeof *items);
    }
}

BURNISH_INLINE vi magnitude(vi x) {
    return vi_max(x, vi_sub(vi_set(0), x));
}

BURNISH_INLINE vm is_nonzero(vi x) {
    return vm_not(vi_equal(x, vi_set(0)));
}

/* First and last pixel along one axis whose samples can lie between the least and the greatest of
 * three numbers in 1/256 pixel; with one sample those whose centre does. */
BURNISH_INLINE void find_pixels(int samples, const vi at[3], int size, vi *first, vi *last) {
    const int to_first = samples == 1 ? BURNISH_SUBPIXELS / 2 - 1 : 0;
    const int to_last = samples == 1 ? BURNISH_SUBPIXELS / 2 : 0;
    vi low = vi_min(vi_min(at[0], at[1]), at[2]), high = vi_max(vi_max(at[0], at[1]), at[2]);
    low = vi_sar(vi_add(low, vi_set(to_first)), 8);
    high = vi_sar(vi_sub(high, vi_set(to_last)), 8);
    *first = vi_max(low, vi_set(0));
    *last = vi_min(high, vi_set(size - 1));
}

/* Triangles of a block: bits. */
typedef struct setup_bits {
    unsigned kept, back; /* may be seen, and are set up; are seen from their back */
    unsigned others;     /* as in burnish_set_up_function */
} setup_bits;

/* Set-up of LANES triangles, whose items in the block begin at `at`; vertices[i] are pointers to
 * corner i. */
BURNISH_INLINE setup_bits set_up_vector(const burnish_raster_view *view,
                                        const void *vertices[3][LANES],
                                        burnish_triangle_batch *block, size_t at) {
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
    setup_bits bits = {0, 0, 0};
    vi dx1 = vi_sub(x[1], x[0]), dy1 = vi_sub(y[1], y[0]);
    vi dx2 = vi_sub(x[2], x[0]), dy2 = vi_sub(y[2], y[0]);
    longest =
        vi_max(vi_max(magnitude(dx1), magnitude(dy1)), vi_max(magnitude(dx2), magnitude(dy2)));
    longest = vi_max(longest, vi_max(magnitude(vi_sub(x[2], x[1])), magnitude(vi_sub(y[2], y[1]))));
    vi area = vi_sub(vi_mul(dx1, dy2), vi_mul(dx2, dy1));
    vi x0, y0, x1, y1;
    vm out = is_nonzero(vi_and(all, vi_set(BURNISH_OUT_REJECT)));
    vm cut = is_nonzero(vi_and(any, vi_set(BURNISH_OUT_CLIP)));
    vm other = vm_or(cut, vi_greater(longest, vi_set(BURNISH_SMALL_EDGE)));
    vm back = vi_greater(area, vi_set(0));
    vm kept = vm_and_not(vm_and_not(is_nonzero(area), out), other);
    kept = view->cull_back_faces ? vm_and_not(kept, back) : kept;
    bits.others = vm_bits(vm_and_not(other, out));
    bits.back = vm_bits(back);
    if (!vm_any(kept)) { /* neighbours are often seen from one side */
        return bits;
    }
    find_pixels(view->samples, x, view->width, &x0, &x1);
    find_pixels(view->samples, y, view->height, &y0, &y1);
    vm outside = vm_or(vi_greater(x0, x1), vi_greater(y0, y1));
    vf_store(block->nearest + at, vf_max(vf_max(depth[0], depth[1]), depth[2]));
    vi_store((int32_t *)block->first + at, vi_or(vi_shr(x0, 3), vi_shl(vi_shr(y0, 3), 16)));
    vi_store((int32_t *)block->last + at, vi_or(vi_shr(x1, 3), vi_shl(vi_shr(y1, 3), 16)));
    bits.kept = vm_bits(vm_and_not(kept, outside));
    return bits;
}

/* Triangles of a batch whose bounds touch more than one tile. */
BURNISH_INLINE unsigned spans_tiles(const burnish_triangle_batch *block) {
    unsigned apart = 0;
    for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
        vi first = vi_load((const int32_t *)block->first + at);
        vi last = vi_load((const int32_t *)block->last + at);
        vi difference = vi_and(vi_xor(first, last), vi_set((int32_t)BURNISH_HIZ_TILE_MASK));
        apart |= vm_bits(is_nonzero(difference)) << at;
    }
    return apart;
}

/* Triangles of a batch whose bounds begin in another tile. */
BURNISH_INLINE unsigned begins_elsewhere(const burnish_triangle_batch *block, uint32_t tile) {
    const vi wanted = vi_set((int32_t)tile), bits = vi_set((int32_t)BURNISH_HIZ_TILE_MASK);
    unsigned elsewhere = 0;
    for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
        vi first = vi_load((const int32_t *)block->first + at);
        elsewhere |= vm_bits(vm_not(vi_equal(vi_and(first, bits), wanted))) << at;
    }
    return elsewhere;
}

static int cull_and_bound(const burnish_screen_vertices *vertices, const burnish_raster_view *view,
                          const uint32_t *indices, size_t first, size_t count,
                          burnish_triangle_batch *block, burnish_batch_header *header,
                          unsigned *others) {
    const void *corners[3][LANES];
    unsigned kept = 0, back = 0, more = 0;
    for (size_t at = 0; at < BURNISH_BATCH_SIZE; at += LANES) {
        for (size_t lane = 0; lane < LANES; ++lane) {
            const size_t place = at + lane < count ? at + lane : 0;
            for (size_t i = 0; i < 3; ++i) {
                corners[i][lane] = &vertices->items[indices[3 * (first + place) + i]];
            }
        }
        const setup_bits bits = set_up_vector(view, corners, block, at);
        kept |= bits.kept << at;
        back |= bits.back << at;
        more |= bits.others << at;
    }
    const unsigned real = (1u << count) - 1;
    kept &= real;
    *others = more & real;
    header->visible[0] = (uint16_t)(kept & ~back);
    header->visible[1] = (uint16_t)(kept & back);
    const uint32_t tile = kept ? block->first[__builtin_ctz(kept)] & BURNISH_HIZ_TILE_MASK : 0;
    const unsigned apart = spans_tiles(block) | begins_elsewhere(block, tile);
    header->tile = apart & kept ? BURNISH_NO_TILE : tile / BURNISH_HIZ_SIZE;
    return __builtin_popcount(kept);
}

#endif
