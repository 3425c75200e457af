/* Drawing small triangles stamp by stamp. */
#ifndef BURNISH_RASTER_STAMPS_SIMD_H
#define BURNISH_RASTER_STAMPS_SIMD_H

#include "raster/setup_simd.h"

/* One triangle in the form that its stamps are drawn from. */
typedef struct stamp_constants {
    vf inverse_area, depth[3];
    vi bias[3], id;
    vf attributes[3][BURNISH_PLANE_COUNT];
} stamp_constants;

BURNISH_INLINE void load_constants(const triangle_setup *setup, size_t lane, int planes, int32_t id,
                                   stamp_constants *constants) {
    constants->inverse_area = vf_set(setup->inverse_area[lane]);
    constants->id = vi_set(id);
    for (int i = 0; i < 3; ++i) {
        constants->depth[i] = vf_set(setup->depth[i][lane]);
        constants->bias[i] = vi_set(setup->bias[i][lane]);
        for (int k = 0; k < planes; ++k) {
            constants->attributes[i][k] = vf_set(setup->attributes[i][k][lane]);
        }
    }
}

BURNISH_INLINE vf depth_from(const vf depth[3], vf weight1, vf weight2) {
    return vf_add(vf_add(depth[0], vf_mul(weight1, depth[1])), vf_mul(weight2, depth[2]));
}

/* Barycentric weight of vertex i from the edge functions. */
BURNISH_INLINE vf weight_from(const stamp_constants *constants, const vi e[3], int i) {
    return vf_mul(vf_from_int(vi_sub(e[i], constants->bias[i])), constants->inverse_area);
}

/* Attributes of the pixels of a stamp from `pixel` on that `mask` holds. */
BURNISH_INLINE void interpolate_stamp(const burnish_tile *tile, const stamp_constants *constants,
                                      int planes, vm mask, vf weight1, vf weight2, int pixel) {
    vf weight0 = vf_sub(vf_sub(vf_set(1.0f), weight1), weight2);
    for (int k = 0; k < planes; ++k) {
        vf sum = vf_add(vf_mul(constants->attributes[0][k], weight0),
                        vf_mul(constants->attributes[1][k], weight1));
        sum = vf_add(sum, vf_mul(constants->attributes[2][k], weight2));
        vf_store_where(mask, tile->buffer.planes[k] + pixel, sum);
    }
}

/* Steps of small triangles' edge functions from a pixel's centre to its samples. */
typedef struct sample_steps {
    int32_t step[3][BURNISH_MAX_SAMPLES][LANES];
    int32_t max[3][LANES]; /* of these steps */
} sample_steps;

BURNISH_INLINE void compute_steps(const triangle_setup *setup, int samples, sample_steps *steps) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    for (int i = 0; i < 3; ++i) {
        const vi slope = vi_load(setup->slope[i]);
        vi max = vi_set(INT32_MIN);
        for (int s = 0; s < samples; ++s) {
            const vi offset =
                vi_set((offsets[s][0] & 0xffff) | offsets[s][1] * 0x10000) /* packed, signed */;
            const vi step = vi_shl(vi_dot16(slope, offset), BURNISH_SAMPLE_STEP_BITS);
            max = vi_max(max, step);
            vi_store(steps->step[i][s], step);
        }
        vi_store(steps->max[i], max);
    }
}

/* What is stored of a sample that is nearer than the stored one. */
enum {
    KEEP_DEPTH,
    KEEP_ID,   /* and depth */
    KEEP_LAYER /* one more of its layers: depths and ids stay */
};

/* How triangles are drawn: constants where it is compiled, for most tiles. */
typedef struct draw_kind {
    int samples, planes, keep; /* per pixel; of attributes; KEEP_... */
} draw_kind;

/* No layer is that far away: the depth of lanes without a layer, and of lanes that add none. */
#define NO_LAYER (2 * BURNISH_FARTHEST)
#define NOTHING_TO_ADD (4 * BURNISH_FARTHEST)

/* Inserts layers of `id` at the samples `lanes` from `sample` on, each after the layers that are as
 * near or nearer. If there are too many, the farthest one is dropped. A layer of neighbouring
 * samples is one vector, so the time does not depend on the order in which layers come. */
BURNISH_INLINE void keep_layers(const burnish_tile *tile, vm lanes, vf depth, vi id, int sample) {
    burnish_tile_layers *layers = tile->layers;
    if (layers->pass > 0) {
        lanes = vm_and(lanes, vf_greater(vf_load(layers->fronts + sample), depth));
    }
    const unsigned bits = vm_bits(lanes);
    const size_t first = burnish_layer_index(layers, sample), step = (size_t)layers->block_samples;
    int32_t counts[LANES], most = 0, least = BURNISH_LAYERS_MAX;
    if (!bits) {
        return;
    }
    for (int lane = 0; lane < LANES; ++lane) {
        const int count = layers->counts[sample + lane];
        const int is_added = (int)(bits >> lane & 1), is_full = count == BURNISH_LAYERS_MAX;
        counts[lane] = count;
        most = is_added && count > most ? count : most;
        least = is_added && count < least ? count : least;
        layers->counts[sample + lane] = (uint8_t)(count + (is_added & !is_full));
        layers->dropped += (size_t)(is_added & is_full);
    }
    most = most < BURNISH_LAYERS_MAX ? most : BURNISH_LAYERS_MAX - 1;
    depth = vf_blend(lanes, depth, vf_set(NOTHING_TO_ADD));
    const vf farthest = vf_load(layers->depths + first + (size_t)most * step);
    if (least == BURNISH_LAYERS_MAX && !vm_any(vm_and(lanes, vf_greater(depth, farthest)))) {
        return;
    }
    vm moved = vm_and_not(lanes, lanes); /* layers after the new one move on */
    for (int layer = 0; layer <= most; ++layer) {
        float *depths = layers->depths + first + (size_t)layer * step;
        int32_t *ids = (int32_t *)layers->indices + first + (size_t)layer * step;
        const vf old_depth = vf_load(depths);
        const vi old_id = vi_load(ids);
        const vm is_there = vi_greater(vi_load(counts), vi_set(layer));
        moved = vm_or(moved, vf_greater(depth, vf_blend(is_there, old_depth, vf_set(NO_LAYER))));
        vf_store(depths, vf_blend(moved, depth, old_depth));
        vi_store(ids, vi_blend(moved, id, old_id));
        depth = vf_blend(moved, old_depth, depth);
        id = vi_blend(moved, old_id, id);
    }
}

/* Draws a stamp with several samples per pixel; e are the edge functions at the pixels' centres.
 * Depths alone are never kept. Returns whether a sample was nearer. */
BURNISH_INLINE int draw_samples(const burnish_tile *tile, const stamp_constants *constants,
                                draw_kind kind, const vi e[3], const sample_steps *steps,
                                size_t lane, int pixel) {
    vm simple = vi_not_negative(vi_set(0));
    unsigned drawn = 0;
    int sample = burnish_sample_index(kind.samples, pixel, 0);
    for (int s = 0; s < kind.samples; ++s, sample += BURNISH_BLOCK_PIXELS) {
        vi at[3];
        for (int i = 0; i < 3; ++i) {
            at[i] = vi_add(e[i], vi_set(steps->step[i][s][lane]));
        }
        vm covered = vi_not_negative(vi_or(vi_or(at[0], at[1]), at[2]));
        vf depth = depth_from(constants->depth, weight_from(constants, at, 1),
                              weight_from(constants, at, 2));
        vm nearer = vm_and(covered, vf_greater(depth, vf_load(tile->buffer.depths + sample)));
        drawn |= vm_bits(nearer);
        if (kind.keep == KEEP_LAYER) {
            keep_layers(tile, nearer, depth, constants->id, sample);
            continue;
        }
        simple = vm_and(simple, nearer);
        vf_store_where(nearer, tile->buffer.depths + sample, depth);
        vi_store_where(nearer, tile->buffer.ids + sample, constants->id);
    }
    if (kind.keep != KEEP_LAYER && vm_any(simple)) {
        vf weight1 = weight_from(constants, e, 1), weight2 = weight_from(constants, e, 2);
        if (tile->options.needs_position) {
            vf_store_where(simple, tile->buffer.center_depths + pixel,
                           depth_from(constants->depth, weight1, weight2));
        }
        interpolate_stamp(tile, constants, kind.planes, simple, weight1, weight2, pixel);
    }
    return drawn != 0;
}

/* The pixels of a stamp from its first one: packed x and y. */
#define AT(x, y) ((x) | (y) << 16)
static const int32_t STAMP_PIXELS[16] = {AT(0, 0), AT(1, 0), AT(2, 0), AT(3, 0), AT(0, 1), AT(1, 1),
                                         AT(2, 1), AT(3, 1), AT(0, 2), AT(1, 2), AT(2, 2), AT(3, 2),
                                         AT(0, 3), AT(1, 3), AT(2, 3), AT(3, 3)};
#undef AT

/* Edge function i of a triangle over the first stamp, and its steps to the next ones. Slopes fit 16
 * bits. */
BURNISH_INLINE vi edge_of_stamp(const triangle_setup *setup, size_t lane, int i, vi *across,
                                vi *down) {
    *across = vi_set(setup->dy[i][lane] * (-BURNISH_SUBPIXELS * STAMP_WIDTH));
    *down = vi_set(setup->dx[i][lane] * (BURNISH_SUBPIXELS * STAMP_HEIGHT));
    vi along = vi_dot16(vi_set(setup->slope[i][lane]), vi_load(STAMP_PIXELS));
    return vi_add(vi_set(setup->stamp[i][lane]), vi_shl(along, BURNISH_SUBPIXEL_BITS));
}

/* Draws a stamp, one sample per pixel, where `covered` holds. It is unpredictable whether it is
 * nearer, so this code has no branch. */
BURNISH_INLINE void draw_stamp(burnish_tile *tile, const stamp_constants *constants, draw_kind kind,
                               vm covered, const vi e[3], int pixel) {
    vf weight1 = weight_from(constants, e, 1), weight2 = weight_from(constants, e, 2);
    vf depth = depth_from(constants->depth, weight1, weight2);
    vf before = vf_load(tile->buffer.depths + pixel);
    vm nearer = vm_and(covered, vf_greater(depth, before));
    if (kind.keep == KEEP_LAYER) {
        keep_layers(tile, nearer, depth, constants->id, pixel);
        mark_dirty(tile, pixel, vm_any(nearer));
        return;
    }
    vf_store(tile->buffer.depths + pixel, vf_blend(nearer, depth, before));
    if (kind.keep) {
        vi_store_where(nearer, tile->buffer.ids + pixel, constants->id);
    }
    interpolate_stamp(tile, constants, kind.planes, nearer, weight1, weight2, pixel);
    if (kind.planes > 0 || kind.keep) { /* nobody asks for a depth map's blocks */
        mark_dirty(tile, pixel, vm_any(nearer));
    }
}

/* The stamps that some triangles may cover, triangle after triangle: with many triangles of a few
 * stamps each, the ends of loops over one triangle's stamps are unpredictable. */
enum { MAX_STAMPS = STAMP_SIDE * STAMP_SIDE, QUEUE_SIZE = LANES * MAX_STAMPS };
typedef struct stamp_queue {
    int32_t along[3][LANES][LANES]; /* per lane: slope . (u, v) of each pixel of a stamp */
    int32_t start[3][QUEUE_SIZE + MAX_STAMPS]; /* per stamp: E at its first pixel */
    int32_t
        pixel[QUEUE_SIZE + MAX_STAMPS]; /* per stamp: lane * BURNISH_TILE_PIXELS + pixel index */
    int32_t selected[QUEUE_SIZE];       /* stamps that cover a pixel */
    vm covered[QUEUE_SIZE];             /* per selected stamp: its pixels */
} stamp_queue;

/* First pixels of the stamps of boxes 1 to STAMP_SIDE stamps wide, row after row: packed x and y.
 */
#define AT(x, y) ((x)*STAMP_WIDTH | (y)*STAMP_HEIGHT << 16)
#define ROW1(y) AT(0, y)
#define ROW2(y) AT(0, y), AT(1, y)
#define ROW3(y) AT(0, y), AT(1, y), AT(2, y)
#define ROW4(y) AT(0, y), AT(1, y), AT(2, y), AT(3, y)
static const int32_t BOX_STAMPS[STAMP_SIDE][MAX_STAMPS] = {
    {ROW1(0), ROW1(1), ROW1(2), ROW1(3)},
    {ROW2(0), ROW2(1), ROW2(2), ROW2(3)},
    {ROW3(0), ROW3(1), ROW3(2), ROW3(3)},
    {ROW4(0), ROW4(1), ROW4(2), ROW4(3)},
};
#undef ROW4
#undef ROW3
#undef ROW2
#undef ROW1
#undef AT

enum { TILE_BITS = 6, BLOCK_MASK = BURNISH_BLOCK_SIZE - 1 };
_Static_assert(1 << TILE_BITS == BURNISH_TILE_SIZE, "a tile's edge");

/* burnish_pixel_index of first pixels of stamps of four columns, packed x and y. */
BURNISH_INLINE vi pixel_indices(vi packed) {
    const vi x = vi_and(packed, vi_set(0xffff)), y = vi_shr(packed, 16);
    const vi block_row = vi_shl(vi_and(y, vi_set(~BLOCK_MASK)), TILE_BITS);
    const vi row = vi_shl(vi_and(y, vi_set(BLOCK_MASK)), BURNISH_BLOCK_BITS);
    const vi block = vi_shl(x, BURNISH_BLOCK_BITS);
    return vi_or(vi_or(block_row, row), block);
}

/* Queues the stamps of the triangles `lanes`; returns how many. */
BURNISH_INLINE int queue_stamps(const triangle_setup *setup, unsigned lanes, stamp_queue *queue) {
    int count = 0;
    for (; lanes; lanes &= lanes - 1) {
        const size_t lane = (size_t)__builtin_ctz(lanes);
        const int x0 = setup->x0[lane] & ~(STAMP_WIDTH - 1);
        const int y0 = setup->y0[lane] & ~(STAMP_HEIGHT - 1);
        const int wide = (setup->x1[lane] - x0) / STAMP_WIDTH + 1;
        const int high = (setup->y1[lane] - y0) / STAMP_HEIGHT + 1;
        const int32_t *box = BOX_STAMPS[wide - 1];
        vi slope[3];
        for (int i = 0; i < 3; ++i) {
            slope[i] = vi_set(setup->slope[i][lane]);
            vi along = vi_dot16(slope[i], vi_load(STAMP_PIXELS));
            vi_store(queue->along[i][lane], vi_shl(along, BURNISH_SUBPIXEL_BITS));
        }
        for (int k = 0; k < MAX_STAMPS; k += LANES) { /* there is room past the last one */
            const vi stamp = vi_load(box + k);
            for (int i = 0; i < 3; ++i) {
                vi start = vi_add(vi_set(setup->stamp[i][lane]),
                                  vi_shl(vi_dot16(slope[i], stamp), BURNISH_SUBPIXEL_BITS));
                vi_store(queue->start[i] + count + k, start);
            }
            const vi pixel = pixel_indices(vi_add(stamp, vi_set(x0 | y0 << 16)));
            vi_store(queue->pixel + count + k,
                     vi_or(pixel, vi_set((int32_t)lane * BURNISH_TILE_PIXELS)));
        }
        count += wide * high;
    }
    return count;
}

/* Edge function i of a queued stamp. */
BURNISH_INLINE vi edge_of_queued(const stamp_queue *queue, size_t lane, int stamp, int i) {
    return vi_add(vi_load(queue->along[i][lane]), vi_set(queue->start[i][stamp]));
}

/* Whether a triangle may cover a sample of a stamp. */
BURNISH_INLINE int may_cover(const sample_steps *steps, size_t lane, const vi e[3]) {
    vi inside = vi_set(0);
    for (int i = 0; i < 3; ++i) {
        inside = vi_or(inside, vi_add(e[i], vi_set(steps->max[i][lane])));
    }
    return vm_any(vi_not_negative(inside));
}

/* Draws a small triangle. steps: with several samples. */
BURNISH_INLINE void draw_small(burnish_tile *tile, const triangle_setup *setup,
                               const sample_steps *steps, size_t lane, draw_kind kind, int32_t id) {
    const int x0 = setup->x0[lane] & ~(STAMP_WIDTH - 1), x1 = setup->x1[lane];
    const int y0 = setup->y0[lane] & ~(STAMP_HEIGHT - 1), y1 = setup->y1[lane];
    stamp_constants constants;
    vi row[3], across[3], down[3];
    load_constants(setup, lane, kind.planes, id, &constants);
    for (int i = 0; i < 3; ++i) {
        row[i] = edge_of_stamp(setup, lane, i, &across[i], &down[i]);
    }
    for (int y = y0; y <= y1; y += STAMP_HEIGHT) {
        vi e[3] = {row[0], row[1], row[2]};
        for (int x = x0; x <= x1; x += STAMP_WIDTH) {
            const int pixel = burnish_pixel_index(x, y);
            if (kind.samples == 1) {
                const vm covered = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
                if (vm_any(covered)) {
                    draw_stamp(tile, &constants, kind, covered, e, pixel);
                }
            } else if (may_cover(steps, lane, e)) {
                mark_dirty(tile, pixel,
                           draw_samples(tile, &constants, kind, e, steps, lane, pixel));
            }
            for (int i = 0; i < 3; ++i) {
                e[i] = vi_add(e[i], across[i]);
            }
        }
        for (int i = 0; i < 3; ++i) {
            row[i] = vi_add(row[i], down[i]);
        }
    }
}

/* Selects the queued stamps that their triangle covers, or with several samples may cover; returns
 * how many. */
BURNISH_INLINE int select_covered(const sample_steps *steps, int samples, int count,
                                  stamp_queue *queue) {
    int selected = 0;
    for (int stamp = 0; stamp < count; ++stamp) {
        const size_t lane = (size_t)queue->pixel[stamp] / BURNISH_TILE_PIXELS;
        vi e[3];
        for (int i = 0; i < 3; ++i) {
            e[i] = edge_of_queued(queue, lane, stamp, i);
        }
        queue->selected[selected] = stamp;
        if (samples == 1) {
            queue->covered[selected] = vi_not_negative(vi_or(vi_or(e[0], e[1]), e[2]));
            selected += vm_any(queue->covered[selected]);
        } else {
            selected += may_cover(steps, lane, e);
        }
    }
    return selected;
}

/* Draws the triangles `lanes`: none has more than STAMP_SIDE stamps across or down. ids: per lane,
 * read if they are kept; steps: with several samples. */
BURNISH_INLINE void draw_queued(burnish_tile *tile, const triangle_setup *setup,
                                const sample_steps *steps, unsigned lanes, draw_kind kind,
                                const int32_t *ids, stamp_queue *queue) {
    const int queued = queue_stamps(setup, lanes, queue);
    const int selected = select_covered(steps, kind.samples, queued, queue);
    for (int i = 0; i < selected; ++i) {
        const int stamp = queue->selected[i], pixel = queue->pixel[stamp] % BURNISH_TILE_PIXELS;
        const size_t lane = (size_t)queue->pixel[stamp] / BURNISH_TILE_PIXELS;
        stamp_constants constants;
        vi e[3];
        load_constants(setup, lane, kind.planes, kind.keep ? ids[lane] : 0, &constants);
        for (int k = 0; k < 3; ++k) {
            e[k] = edge_of_queued(queue, lane, stamp, k);
        }
        if (kind.samples == 1) {
            draw_stamp(tile, &constants, kind, queue->covered[i], e, pixel);
        } else {
            mark_dirty(tile, pixel, draw_samples(tile, &constants, kind, e, steps, lane, pixel));
        }
    }
}

#endif
