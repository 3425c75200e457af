/* What a triangle puts into the samples that it covers: depth, id or layer, and attributes. */
#ifndef BURNISH_RASTER_SAMPLES_SIMD_H
#define BURNISH_RASTER_SAMPLES_SIMD_H

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
    KEEP_CODE = -1, /* depth and a face's code */
    KEEP_DEPTH,
    KEEP_ID,    /* and depth */
    KEEP_LAYER, /* one more of its layers: depths and ids stay */
    KEEP_CHOSEN /* depth and id, where layers->chosen has layers->current */
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

/* Of the samples `lanes` from `sample` on, those that the triangle may be stored in. */
BURNISH_INLINE vm keep_chosen(const burnish_tile *tile, int keep, vm lanes, int sample) {
    const burnish_tile_layers *layers = tile->layers;
    return keep == KEEP_CHOSEN
               ? vm_and(lanes, vi_equal(vi_load((const int32_t *)layers->chosen + sample),
                                        vi_set((int32_t)layers->current)))
               : lanes;
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
        nearer = keep_chosen(tile, kind.keep, nearer, sample);
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

#endif
