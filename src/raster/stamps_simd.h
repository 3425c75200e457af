/* Drawing small triangles stamp by stamp. */
#ifndef BURNISH_RASTER_STAMPS_SIMD_H
#define BURNISH_RASTER_STAMPS_SIMD_H

#include "raster/samples_simd.h"

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
    nearer = keep_chosen(tile, kind.keep, nearer, pixel);
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
