/* Finds what the pixels of a drawn tile show, with SIMD. */
#ifndef BURNISH_RASTER_FRAGMENTS_SIMD_H
#define BURNISH_RASTER_FRAGMENTS_SIMD_H

#include "raster/discs.h"
#include "raster/fragments.h"
#include "raster/samples_simd.h"

/* ---- Block rows ---- */

/* The pixels of a block: bits where a sample shows a triangle. */
BURNISH_INLINE unsigned classify_block(const burnish_tile *tile, int block, int32_t *simple) {
    const int samples = tile->options.samples, size = samples * BURNISH_BLOCK_PIXELS;
    const vf farthest = vf_set(BURNISH_FARTHEST);
    unsigned covered = 0;
    for (int i = 0; i < BURNISH_BLOCK_PIXELS; i += LANES) {
        if (samples == 1) {
            vm mask = vf_greater(vf_load(tile->buffer.depths + block * size + i), farthest);
            vi_store(simple + i, vi_blend(mask, vi_set(0), vi_set(-1)));
            covered |= vm_bits(mask) << i;
            continue;
        }
        const int32_t *ids = tile->buffer.ids + block * size + i;
        vi first = vi_load(ids), all = first;
        vm same = vi_equal(first, first);
        for (int s = 1; s < samples; ++s) {
            vi id = vi_load(ids + s * BURNISH_BLOCK_PIXELS);
            all = vi_and(all, id); /* -1, none, only where all are */
            same = vm_and(same, vi_equal(id, first));
        }
        vi_store(simple + i, vi_blend(same, first, vi_set(-1)));
        covered |= vm_bits(vi_not_negative(all)) << i;
    }
    return covered;
}

static void classify_block_row(const burnish_tile *tile, int row, burnish_block_row *pixels) {
    for (int x = 0; x < BURNISH_TILE_BLOCKS; ++x) {
        int32_t *simple = pixels->simple + x * BURNISH_BLOCK_PIXELS;
        if (tile->buffer.dirty_blocks[row] >> x & 1) {
            pixels->covered[x] =
                (uint16_t)classify_block(tile, row * BURNISH_TILE_BLOCKS + x, simple);
        } else {
            memset(simple, 0xff, BURNISH_BLOCK_PIXELS * sizeof *simple);
            pixels->covered[x] = 0;
        }
    }
}

/* ---- Fragments of complex pixels ---- */

/* Fragments before their weights are computed. */
typedef struct sample_groups {
    int count;
    uint8_t pixel[BURNISH_FRAGMENT_BATCH];    /* in the block */
    uint16_t samples[BURNISH_FRAGMENT_BATCH]; /* bits of the samples that show the triangle */
    int32_t id[BURNISH_FRAGMENT_BATCH];
} sample_groups;

typedef struct sample_points {
    int32_t id[BURNISH_FRAGMENT_BATCH];
    /* 1/256 pixel from the tile's corner */
    int32_t x[BURNISH_FRAGMENT_BATCH], y[BURNISH_FRAGMENT_BATCH];
} sample_points;

/* Groups the samples of LANES pixels of a block, from pixel `first` on, by triangle. Bit t of
 * group[s] is set where sample t shows the same triangle as sample s; the first sample of a group
 * represents it. */
BURNISH_INLINE void group_vector(const burnish_tile *tile, int samples, int block, int first,
                                 sample_groups *groups) {
    const int32_t *ids = tile->buffer.ids + block * samples * BURNISH_BLOCK_PIXELS + first;
    const vi none = vi_set(0);
    vi id[BURNISH_MAX_SAMPLES], group[BURNISH_MAX_SAMPLES], different = none;
    for (int s = 0; s < samples; ++s) {
        id[s] = vi_load(ids + s * BURNISH_BLOCK_PIXELS);
        group[s] = vi_set(1 << s);
        different = vi_or(different, vi_xor(id[s], id[0]));
    }
    const vm complex_pixels = vi_not_zero(different);
    if (!vm_any(complex_pixels)) {
        return;
    }
    for (int s = 0; s < samples; ++s) {
        for (int t = s + 1; t < samples; ++t) {
            const vm same = vi_equal(id[s], id[t]);
            group[s] = vi_or(group[s], vi_blend(same, vi_set(1 << t), none));
            group[t] = vi_or(group[t], vi_blend(same, vi_set(1 << s), none));
        }
    }
    for (int s = 0; s < samples; ++s) {
        int32_t bits[LANES];
        const vm is_first = vi_equal(vi_and(group[s], vi_set((1 << s) - 1)), none);
        const vm is_shown = vi_not_negative(id[s]);
        vi_store(bits, group[s]);
        for (unsigned rest = vm_bits(vm_and(vm_and(is_first, complex_pixels), is_shown)); rest;
             rest &= rest - 1) {
            const int lane = __builtin_ctz(rest), i = groups->count++;
            groups->pixel[i] = (uint8_t)(first + lane);
            groups->samples[i] = (uint16_t)bits[lane];
            groups->id[i] = ids[s * BURNISH_BLOCK_PIXELS + lane];
        }
    }
}

/* Groups the samples of a block's complex pixels, pixel after pixel. */
static void group_samples(const burnish_tile *tile, int block, sample_groups *groups) {
    groups->count = 0;
    for (int first = 0; first < BURNISH_BLOCK_PIXELS; first += LANES) {
        if (tile->options.samples == 4) {
            group_vector(tile, 4, block, first, groups);
        } else {
            group_vector(tile, tile->options.samples, block, first, groups);
        }
    }
}

/* The weights of a fragment whose triangle needs 64 bits. */
static void compute_64_bit_weights(const burnish_tile_primitives *primitives, size_t id, int64_t x,
                                   int64_t y, float *weight1, float *weight2) {
    const burnish_primitive_edges *edges = &primitives->edges[id];
    const burnish_primitive_weights *weights = &primitives->weights[id];
    const int64_t *constants = primitives->constants[id];
    const int64_t edge1 = edges->dx[0] * y - weights->dy[0] * x + constants[0];
    const int64_t edge2 = edges->dx[1] * y - weights->dy[1] * x + constants[1];
    *weight1 = (float)edge1 * weights->inverse_area;
    *weight2 = (float)edge2 * weights->inverse_area;
}

/* Barycentric weights (and, if requested, screen positions) of LANES fragments from `first` on. */
BURNISH_INLINE void weigh_vector(const burnish_tile *tile, const burnish_raster_view *view,
                                 const sample_points *points, int first,
                                 burnish_fragments *fragments) {
    const burnish_tile_primitives *primitives = &tile->primitives;
    const void *edges[LANES], *weights[LANES], *depths[LANES];
    vf edge[4], weight[4], depth[4];
    for (int lane = 0; lane < LANES; ++lane) {
        const int at = first + lane < fragments->count ? first + lane : first;
        const int32_t id = points->id[at];
        edges[lane] = &primitives->edges[id];
        weights[lane] = &primitives->weights[id];
        depths[lane] = &primitives->depths[id];
    }
    vf_load_aos4(edges, edge);
    vf_load_aos4(weights, weight);
    vf_load_aos4(depths, depth);
    const vi x = vi_load(points->x + first), y = vi_load(points->y + first);
    float *to[2] = {fragments->weight1 + first, fragments->weight2 + first};
    for (int i = 0; i < 2; ++i) {
        vi e = vi_sub(vi_mul(vf_bits(edge[2 + i]), y), vi_mul(vf_bits(weight[i]), x));
        e = vi_add(e, vf_bits(edge[i]));
        vf_store(to[i], vf_mul(vf_from_int(e), weight[2]));
    }
    for (unsigned rest = vm_bits(vi_not_zero(vf_bits(weight[3]))); rest; rest &= rest - 1) {
        const int at = first + __builtin_ctz(rest);
        if (at < fragments->count) {
            compute_64_bit_weights(primitives, (size_t)points->id[at], points->x[at], points->y[at],
                                   &fragments->weight1[at], &fragments->weight2[at]);
        }
    }
    if (tile->options.needs_position) {
        const vf step = vf_set(1.0f / BURNISH_SUBPIXELS);
        const vi left = vi_set(tile->x * BURNISH_SUBPIXELS - view->width * HALF_PIXEL);
        const vi below = vi_set(view->height * HALF_PIXEL - tile->y * BURNISH_SUBPIXELS);
        vf_store(fragments->x + first, vf_mul(vf_from_int(vi_add(x, left)), step));
        vf_store(fragments->y + first, vf_mul(vf_from_int(vi_sub(below, y)), step));
        vf_store(fragments->depth + first, depth_from(depth, vf_load(to[0]), vf_load(to[1])));
    }
}

/* The same for points: positions in their discs. */
static void weigh_points(const burnish_tile *tile, const burnish_raster_view *view,
                         const sample_points *points, burnish_fragments *fragments) {
    const float step = 1.0f / BURNISH_SUBPIXELS;
    const int left = tile->x * BURNISH_SUBPIXELS - view->width * HALF_PIXEL;
    const int below = view->height * HALF_PIXEL - tile->y * BURNISH_SUBPIXELS;
    for (int i = 0; i < fragments->count; ++i) {
        const size_t id = (size_t)points->id[i];
        const burnish_primitive_edges *disc = &tile->primitives.edges[id];
        const float *depth = tile->primitives.depths[id].depth;
        const burnish_disc_position at = burnish_disc_position_of(
            points->x[i] - disc->constant[0], points->y[i] - disc->constant[1], disc->dx[0]);
        fragments->weight1[i] = at.x;
        fragments->weight2[i] = at.y;
        fragments->x[i] = (float)(points->x[i] + left) * step;
        fragments->y[i] = (float)(below - points->y[i]) * step;
        fragments->depth[i] = depth[0] + depth[1] * at.toward;
    }
}

/* Appends the fragments of a block. */
static void append_groups(const burnish_tile *tile, int block, const sample_groups *groups,
                          sample_points *points, burnish_fragments *fragments) {
    const int samples = tile->options.samples;
    for (int i = 0; i < groups->count; ++i) {
        const int pixel = block * BURNISH_BLOCK_PIXELS + groups->pixel[i], at = fragments->count++;
        const unsigned bits = groups->samples[i];
        const burnish_sample_mean mean =
            samples <= 8 ? tile->means[bits] : burnish_mean_of_samples(samples, bits);
        points->id[at] = groups->id[i];
        points->x[at] = burnish_pixel_x(pixel) * BURNISH_SUBPIXELS + HALF_PIXEL + mean.x;
        points->y[at] = burnish_pixel_y(pixel) * BURNISH_SUBPIXELS + HALF_PIXEL + mean.y;
        fragments->pixels[at] = (uint16_t)pixel;
        fragments->weight[at] = (uint8_t)mean.count;
        fragments->samples[at] = (uint16_t)bits;
        fragments->primitives[at] = tile->primitives.primitives[groups->id[i]];
    }
}

static int next_fragments(const burnish_tile *tile, const burnish_raster_view *view,
                          int *next_block, burnish_fragments *fragments) {
    enum { BLOCKS = BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS };
    sample_groups groups;
    sample_points points;
    int block = tile->options.samples > 1 ? *next_block : BLOCKS;
    fragments->count = 0;
    for (; block < BLOCKS; ++block) {
        const unsigned row = tile->buffer.dirty_blocks[block / BURNISH_TILE_BLOCKS];
        if (!(row >> block % BURNISH_TILE_BLOCKS & 1)) {
            continue;
        }
        group_samples(tile, block, &groups);
        if (fragments->count + groups.count > BURNISH_FRAGMENT_BATCH) {
            break;
        }
        append_groups(tile, block, &groups, &points, fragments);
    }
    for (int first = 0; !tile->are_points && first < fragments->count; first += LANES) {
        weigh_vector(tile, view, &points, first, fragments);
    }
    if (tile->are_points) {
        weigh_points(tile, view, &points, fragments);
    }
    *next_block = block;
    return fragments->count > 0;
}

/* ---- Counts ---- */

/* Neighbours mostly show the same triangle: only where the id changes there is something to do.
 * Samples that show nothing may have ids of an earlier tile, so a sample never equals them. */
static void mark_block(const burnish_tile *tile, int first, uint8_t *drawn) {
    const int count = tile->options.samples * BURNISH_BLOCK_PIXELS;
    const float *depths = tile->buffer.depths + first;
    int32_t ids[1 + BURNISH_MAX_SAMPLES * BURNISH_BLOCK_PIXELS];
    unsigned before = 0; /* whether the sample before shows a triangle */
    ids[0] = -1;
    memcpy(ids + 1, tile->buffer.ids + first, (size_t)count * sizeof *ids);
    for (int i = 0; i < count; i += LANES) {
        const unsigned shown = vm_bits(vf_greater(vf_load(depths + i), vf_set(BURNISH_FARTHEST)));
        const unsigned same = vm_bits(vi_equal(vi_load(ids + 1 + i), vi_load(ids + i)));
        for (unsigned rest = shown & ~(same & (shown << 1 | before)); rest; rest &= rest - 1) {
            const int32_t id = ids[1 + i + __builtin_ctz(rest)];
            const uint32_t id_and_facing = tile->options.samples == 1
                                               ? (uint32_t)id
                                               : tile->primitives.primitives[id].id_and_facing;
            __atomic_store_n(&drawn[id_and_facing >> 1], 1, __ATOMIC_RELAXED);
        }
        before = shown >> (LANES - 1);
    }
}

static void mark_drawn(const burnish_tile *tile, uint8_t *drawn) {
    const int size = tile->options.samples * BURNISH_BLOCK_PIXELS;
    for (int row = 0; row < BURNISH_TILE_BLOCKS; ++row) {
        for (unsigned rest = tile->buffer.dirty_blocks[row]; rest; rest &= rest - 1) {
            const int block = row * BURNISH_TILE_BLOCKS + __builtin_ctz(rest);
            mark_block(tile, block * size, drawn);
        }
    }
}

#endif
