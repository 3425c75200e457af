/* Drawing tiny triangles: the pixels, or the samples, of as many as a vector has lanes at once; then
 * what they cover goes into the tile, one triangle after another. */
#ifndef BURNISH_RASTER_TINY_SIMD_H
#define BURNISH_RASTER_TINY_SIMD_H

#include "raster/samples_simd.h"

/* ---- One sample per pixel ---- */

/* The four pixels that triangles of at most 2 x 2 may cover. */
typedef struct tiny_pixels {
    unsigned covered[4];
    float depth[4][LANES];
    float planes[4][BURNISH_PLANE_COUNT][LANES];
} tiny_pixels;

/* Coverage, depth and attributes of the pixels of all tiny triangles; of others, anything. */
BURNISH_INLINE void compute_tiny(const triangle_setup *setup, int planes, tiny_pixels *pixels) {
    const vi wide = vi_sub(vi_load(setup->x1), vi_load(setup->x0));
    const vi high = vi_sub(vi_load(setup->y1), vi_load(setup->y0));
    const vf inverse_area = vf_load(setup->inverse_area);
    vi start[3], right[3], down[3];
    for (int i = 0; i < 3; ++i) {
        start[i] = vi_load(setup->start[i]);
        right[i] = vi_sub(vi_set(0), vi_shl(vi_load(setup->dy[i]), BURNISH_SUBPIXEL_BITS));
        down[i] = vi_shl(vi_load(setup->dx[i]), BURNISH_SUBPIXEL_BITS);
    }
    for (int c = 0; c < 4; ++c) {
        vi e[3], inside = vi_set(0);
        for (int i = 0; i < 3; ++i) {
            e[i] = c & 1 ? vi_add(start[i], right[i]) : start[i];
            e[i] = c & 2 ? vi_add(e[i], down[i]) : e[i];
            inside = vi_or(inside, e[i]);
        }
        inside = c & 1 ? vi_or(inside, vi_sub(wide, vi_set(1))) : inside;
        inside = c & 2 ? vi_or(inside, vi_sub(high, vi_set(1))) : inside;
        pixels->covered[c] = vm_bits(vi_not_negative(inside)) & setup->tiny;
        if (!pixels->covered[c]) {
            continue;
        }
        const vf depth[3] = {vf_load(setup->depth[0]), vf_load(setup->depth[1]),
                             vf_load(setup->depth[2])};
        vf weight1 = vf_mul(vf_from_int(vi_sub(e[1], vi_load(setup->bias[1]))), inverse_area);
        vf weight2 = vf_mul(vf_from_int(vi_sub(e[2], vi_load(setup->bias[2]))), inverse_area);
        vf weight0 = vf_sub(vf_sub(vf_set(1.0f), weight1), weight2);
        vf_store(pixels->depth[c], depth_from(depth, weight1, weight2));
        for (int k = 0; k < planes; ++k) {
            vf sum = vf_add(vf_mul(vf_load(setup->attributes[0][k]), weight0),
                            vf_mul(vf_load(setup->attributes[1][k]), weight1));
            sum = vf_add(sum, vf_mul(vf_load(setup->attributes[2][k]), weight2));
            vf_store(pixels->planes[c][k], sum);
        }
    }
}

/* Bit i to bit 4 i. */
BURNISH_INLINE uint64_t spread_bits_by_4(unsigned bits) {
    uint64_t x = bits;
    x = (x | x << 24) & 0x000000ff000000ffull;
    x = (x | x << 12) & 0x000f000f000f000full;
    x = (x | x << 6) & 0x0303030303030303ull;
    return (x | x << 3) & 0x1111111111111111ull;
}

/* Draws covered pixels: bit 4 lane + c of `hits`. */
BURNISH_INLINE void draw_tiny(burnish_tile *tile, const triangle_setup *setup,
                              const tiny_pixels *pixels, uint64_t hits, int planes, int ids) {
    for (; hits; hits &= hits - 1) {
        const int hit = __builtin_ctzll(hits), lane = hit >> 2, c = hit & 3;
        const int x = setup->x0[lane] + (c & 1), y = setup->y0[lane] + (c >> 1);
        const int pixel = burnish_pixel_index(x, y);
        if (!(pixels->depth[c][lane] > tile->buffer.depths[pixel])) {
            continue;
        }
        tile->buffer.depths[pixel] = pixels->depth[c][lane];
        for (int k = 0; k < planes; ++k) {
            tile->buffer.planes[k][pixel] = pixels->planes[c][k][lane];
        }
        if (ids) {
            tile->buffer.ids[pixel] = (int32_t)setup->primitives.id_and_facing[lane];
        }
        mark_dirty(tile, pixel, 1);
    }
}

/* ---- Four samples per pixel ---- */

enum {
    TINY_SIDE = 3,
    TINY_PIXELS = TINY_SIDE * TINY_SIDE,
    TINY_SAMPLE_BITS = 2,
    TINY_SAMPLES = 1 << TINY_SAMPLE_BITS
};

/* The samples of the pixels that triangles of at most 3 x 3 may cover. Pixels count row after row
 * from (x0, y0); sample s of pixel p has number p * TINY_SAMPLES + s. */
typedef struct tiny_samples {
    uint32_t covered[TINY_SIDE][LANES]; /* of each row of pixels: bits */
    float depth[TINY_PIXELS * TINY_SAMPLES][LANES];
    int32_t index[TINY_PIXELS][LANES]; /* burnish_sample_index of sample 0 */
} tiny_samples;

/* Coverage and depth of the samples of pixel p. e are the edge functions at its centre; `there` is
 * negative where a triangle's bounds have no such pixel. Returns bits of its row. */
BURNISH_INLINE vi cover_tiny(const triangle_setup *setup, const sample_steps *steps, const vi e[3],
                             vi there, int p, tiny_samples *found) {
    const vf depth[3] = {vf_load(setup->depth[0]), vf_load(setup->depth[1]),
                         vf_load(setup->depth[2])};
    vi covered = vi_set(0);
    for (int s = 0; s < TINY_SAMPLES; ++s) {
        vi at[3], inside = there;
        for (int i = 0; i < 3; ++i) {
            at[i] = vi_add(e[i], vi_load(steps->step[i][s]));
            inside = vi_or(inside, at[i]);
        }
        const vm is_covered = vi_not_negative(inside);
        if (!(vm_bits(is_covered) & setup->live)) {
            continue;
        }
        const vf inverse_area = vf_load(setup->inverse_area);
        const vi e1 = vi_sub(at[1], vi_load(setup->bias[1]));
        const vi e2 = vi_sub(at[2], vi_load(setup->bias[2]));
        const vf weight1 = vf_mul(vf_from_int(e1), inverse_area);
        const vf weight2 = vf_mul(vf_from_int(e2), inverse_area);
        vf_store(found->depth[p * TINY_SAMPLES + s], depth_from(depth, weight1, weight2));
        const vi bit = vi_set(1 << (p % TINY_SIDE * TINY_SAMPLES + s));
        covered = vi_or(covered, vi_blend(is_covered, bit, vi_set(0)));
    }
    return covered;
}

/* burnish_sample_index of the pixels' samples 0. */
BURNISH_INLINE vi sample_indices(vi x, vi y) {
    const vi within = vi_set(BLOCK_MASK), blocks = vi_set(~BLOCK_MASK);
    const vi block =
        vi_or(vi_shl(vi_and(y, blocks), TILE_BITS), vi_shl(vi_and(x, blocks), BURNISH_BLOCK_BITS));
    const vi rest = vi_or(vi_shl(vi_and(y, within), BURNISH_BLOCK_BITS), vi_and(x, within));
    return vi_add(vi_shl(block, TINY_SAMPLE_BITS), rest);
}

/* The same of all pixels; the triangles that touch one touch at most 3 x 3. */
static void compute_tiny_samples(const triangle_setup *setup, const sample_steps *steps,
                                 tiny_samples *found) {
    const vi x0 = vi_load(setup->x0), y0 = vi_load(setup->y0);
    const vi wide = vi_sub(vi_load(setup->x1), x0), high = vi_sub(vi_load(setup->y1), y0);
    vi row[3];
    for (int i = 0; i < 3; ++i) {
        row[i] = vi_load(setup->start[i]);
    }
    for (int y = 0; y < TINY_SIDE; ++y) {
        const vi at_y = vi_add(y0, vi_set(y)), below = vi_sub(high, vi_set(y));
        vi e[3] = {row[0], row[1], row[2]}, covered = vi_set(0);
        for (int x = 0; x < TINY_SIDE; ++x) {
            const int p = y * TINY_SIDE + x;
            const vi there = vi_or(below, vi_sub(wide, vi_set(x)));
            if (vm_bits(vi_not_negative(there)) & setup->live) {
                vi_store(found->index[p], sample_indices(vi_add(x0, vi_set(x)), at_y));
                covered = vi_or(covered, cover_tiny(setup, steps, e, there, p, found));
            }
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_sub(e[i], vi_shl(vi_load(setup->dy[i]), BURNISH_SUBPIXEL_BITS));
            }
        }
        vi_store((int32_t *)found->covered[y], covered);
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], vi_shl(vi_load(setup->dx[i]), BURNISH_SUBPIXEL_BITS));
        }
    }
}

/* Stores the centre of pixel p, all of whose samples show the triangle. */
BURNISH_INLINE void draw_center(const burnish_tile *tile, const triangle_setup *setup, size_t lane,
                                int p, int planes) {
    const int x = p % TINY_SIDE, y = p / TINY_SIDE;
    const int pixel = burnish_pixel_index(setup->x0[lane] + x, setup->y0[lane] + y);
    float weight[3];
    for (int i = 1; i < 3; ++i) {
        const int32_t step = y * setup->dx[i][lane] - x * setup->dy[i][lane];
        const int32_t e = setup->start[i][lane] - setup->bias[i][lane] + step * BURNISH_SUBPIXELS;
        weight[i] = (float)e * setup->inverse_area[lane];
    }
    weight[0] = (1.0f - weight[1]) - weight[2];
    if (tile->options.needs_position) {
        tile->buffer.center_depths[pixel] =
            (setup->depth[0][lane] + weight[1] * setup->depth[1][lane]) +
            weight[2] * setup->depth[2][lane];
    }
    for (int k = 0; k < planes; ++k) {
        const float sum =
            setup->attributes[0][k][lane] * weight[0] + setup->attributes[1][k][lane] * weight[1];
        tile->buffer.planes[k][pixel] = sum + setup->attributes[2][k][lane] * weight[2];
    }
}

/* Draws the samples `covered` of a triangle; returns bits of the nearer ones. These are
 * unpredictable, so this code has no branch. */
BURNISH_INLINE uint64_t draw_covered(burnish_tile *tile, const tiny_samples *found, size_t lane,
                                     uint64_t covered, int32_t id) {
    float *depths = tile->buffer.depths;
    int32_t *ids = tile->buffer.ids;
    uint64_t drawn = 0;
    for (; covered; covered &= covered - 1) {
        const unsigned number = (unsigned)__builtin_ctzll(covered);
        const int at = found->index[number / TINY_SAMPLES][lane] +
                       (int)(number % TINY_SAMPLES) * BURNISH_BLOCK_PIXELS;
        const float depth = found->depth[number][lane], before = depths[at];
        const int is_nearer = depth > before;
        depths[at] = depth > before ? depth : before;
        ids[at] ^= (ids[at] ^ id) & -is_nearer;
        drawn |= (uint64_t)is_nearer << number;
        mark_dirty(tile, at / TINY_SAMPLES, is_nearer); /* a pixel of the same block */
    }
    return drawn;
}

/* Draws a group whose triangles are all tiny. */
static void draw_tiny_samples(burnish_tile *tile, const triangle_setup *setup,
                              const tiny_samples *found, int planes, const int32_t *ids) {
    enum { ROW = TINY_SIDE * TINY_SAMPLES };
    for (unsigned rest = setup->live; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        const uint64_t covered = found->covered[0][lane] |
                                 (uint64_t)found->covered[1][lane] << ROW |
                                 (uint64_t)found->covered[2][lane] << 2 * ROW;
        const uint64_t drawn = draw_covered(tile, found, lane, covered, ids[lane]);
        const uint64_t pairs = drawn & drawn >> 1;
        uint64_t whole = pairs & pairs >> 2 & 0x111111111ull; /* pixels all of whose samples are */
        for (; whole; whole &= whole - 1) {
            draw_center(tile, setup, lane, __builtin_ctzll(whole) / TINY_SAMPLES, planes);
        }
    }
}

#endif
