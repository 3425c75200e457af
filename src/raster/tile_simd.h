/* A tile's triangles from its lists to the buffer. hiz_simd.h leaves out hidden ones, setup_simd.h
 * prepares as many as a vector has lanes; tiny_simd.h, stamps_simd.h or, cell by cell, large_simd.h
 * find out which pixels each covers, by its size; samples_simd.h stores what these show.
 * discs_simd.h draws points. */
#ifndef BURNISH_RASTER_TILE_SIMD_H
#define BURNISH_RASTER_TILE_SIMD_H

#include "raster/discs_simd.h"
#include "raster/hiz_simd.h"
#include "raster/large_simd.h"
#include "raster/stamps_simd.h"
#include "raster/tiny_simd.h"

/* ---- Primitives, with several samples ---- */

/* Appends what fragments will need of some triangles, one per lane. */
BURNISH_INLINE void append_primitives(burnish_tile_primitives *primitives,
                                      const triangle_setup *setup) {
    const size_t at = primitives->count;
    const primitive_group *group = &setup->primitives;
    const vi beyond = vi_blend(vi_greater(vi_load(setup->longest), vi_set(BURNISH_EDGE_32_BITS)),
                               vi_set(1), vi_set(0));
    vi constant[2], dx[2], dy[2];
    for (int i = 0; i < 2; ++i) {
        const int a = i == 1 ? 0 : 2;
        dx[i] = vi_load(setup->dx[i + 1]);
        dy[i] = vi_load(setup->dy[i + 1]);
        constant[i] =
            vi_sub(vi_mul(dy[i], vi_load(setup->x[a])), vi_mul(dx[i], vi_load(setup->y[a])));
    }
    vf_store_aos4(&primitives->edges[at], vf_from_bits(constant[0]), vf_from_bits(constant[1]),
                  vf_from_bits(dx[0]), vf_from_bits(dx[1]));
    vf_store_aos4(&primitives->weights[at], vf_from_bits(dy[0]), vf_from_bits(dy[1]),
                  vf_load(setup->inverse_area), vf_from_bits(beyond));
    vf_store_aos4(&primitives->depths[at], vf_load(setup->depth[0]), vf_load(setup->depth[1]),
                  vf_load(setup->depth[2]), vf_set(0.0f));
    vf_store_aos4(&primitives->primitives[at],
                  vf_from_bits(vi_load((const int32_t *)group->vertices[0])),
                  vf_from_bits(vi_load((const int32_t *)group->vertices[1])),
                  vf_from_bits(vi_load((const int32_t *)group->vertices[2])),
                  vf_from_bits(vi_load((const int32_t *)group->id_and_facing)));
    primitives->count = at + LANES;
}

/* The part of a primitive that needs 64 bits. */
static void append_64_bits(burnish_tile_primitives *primitives, size_t at,
                           const triangle_setup *setup, size_t lane) {
    const int64_t area = (int64_t)setup->dx[2][lane] * setup->dy[0][lane] -
                         (int64_t)setup->dy[2][lane] * setup->dx[0][lane];
    primitives->weights[at].inverse_area = 1.0f / (float)area;
    for (int i = 0; i < 2; ++i) {
        const int a = i == 1 ? 0 : 2;
        primitives->constants[at][i] = (int64_t)setup->dy[i + 1][lane] * setup->x[a][lane] -
                                       (int64_t)setup->dx[i + 1][lane] * setup->y[a][lane];
    }
}

/* Removes the primitives that no sample shows, at least half of them; the others keep their
 * order. */
static void evict_hidden(burnish_tile *tile) {
    const size_t samples = (size_t)BURNISH_TILE_PIXELS * (size_t)tile->options.samples;
    burnish_tile_primitives *primitives = &tile->primitives;
    int32_t *ids = tile->buffer.ids, *moved = primitives->moved, kept = 0;
    memset(moved, 0, primitives->count * sizeof *moved);
    for (size_t i = 0; i < samples; ++i) {
        if (ids[i] >= 0) {
            moved[ids[i]] = 1;
        }
    }
    for (size_t i = 0; i < primitives->count; ++i) {
        if (moved[i]) {
            primitives->edges[kept] = primitives->edges[i];
            primitives->weights[kept] = primitives->weights[i];
            primitives->depths[kept] = primitives->depths[i];
            primitives->primitives[kept] = primitives->primitives[i];
            memmove(primitives->constants[kept], primitives->constants[i],
                    sizeof *primitives->constants);
            moved[i] = kept++;
        }
    }
    for (size_t i = 0; i < samples; ++i) {
        if (ids[i] >= 0) {
            ids[i] = moved[ids[i]];
        }
    }
    primitives->count = (size_t)kept;
}

/* ---- Triangles ---- */

/* Draws one triangle. */
BURNISH_INLINE void draw_alone(burnish_tile *tile, const triangle_setup *setup,
                               const sample_steps *steps, size_t lane, draw_kind kind, int32_t id) {
    if (setup->small >> lane & 1) {
        draw_small(tile, setup, steps, lane, kind, id);
    } else {
        draw_large(tile, setup, lane, kind, id);
    }
}

/* Draws a group by queued stamps, but for its wide triangles, in order. */
BURNISH_INLINE void draw_runs(burnish_tile *tile, const triangle_setup *setup,
                              const sample_steps *steps, draw_kind kind, const int32_t *ids,
                              stamp_queue *queue) {
    unsigned rest = setup->live;
    while (rest) {
        const unsigned wide = rest & setup->wide;
        const unsigned first_wide = wide & (0u - wide), run = rest & (first_wide - 1);
        if (run) {
            draw_queued(tile, setup, steps, run, kind, ids, queue);
        }
        if (wide) {
            const size_t lane = (size_t)__builtin_ctz(wide);
            draw_alone(tile, setup, steps, lane, kind, ids[lane]);
        }
        rest &= ~(run | first_wide);
    }
}

/* Queued stamps do not pay with vectors of fewer lanes. */
enum { HAS_QUEUE = LANES >= 8 };

/* Draws a group of triangles, one sample per pixel. ids: 1 where they are requested. */
BURNISH_INLINE void draw_single_sampled(burnish_tile *tile, const triangle_setup *setup, int planes,
                                        int ids, tiny_pixels *pixels, stamp_queue *queue) {
    const int32_t *id = (const int32_t *)setup->primitives.id_and_facing;
    const int tiny = __builtin_popcount(setup->tiny);
    unsigned others = setup->live;
    uint64_t hits = 0;
    if (HAS_QUEUE && 2 * tiny < LANES) {
        draw_runs(tile, setup, NULL, (draw_kind){1, planes, ids}, id, queue);
        return;
    }
    if (tiny > 1) { /* the pixels of all tiny ones at once */
        compute_tiny(setup, planes, pixels);
        others &= ~setup->tiny;
        hits = spread_bits_by_4(pixels->covered[0]) | spread_bits_by_4(pixels->covered[1]) << 1 |
               spread_bits_by_4(pixels->covered[2]) << 2 |
               spread_bits_by_4(pixels->covered[3]) << 3;
    }
    for (; others; others &= others - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(others);
        const uint64_t before = hits & ((1ull << 4 * lane) - 1);
        draw_tiny(tile, setup, pixels, before, planes, ids);
        hits ^= before;
        draw_alone(tile, setup, NULL, lane, (draw_kind){1, planes, ids}, id[lane]);
    }
    draw_tiny(tile, setup, pixels, hits, planes, ids);
}

/* The same with several samples per pixel. */
BURNISH_INLINE void draw_multisampled(burnish_tile *tile, const triangle_setup *setup, int samples,
                                      int planes, tiny_samples *found, stamp_queue *queue) {
    const size_t first = tile->primitives.count;
    const draw_kind kind = {samples, planes, KEEP_ID};
    sample_steps steps;
    int32_t ids[LANES];
    append_primitives(&tile->primitives, setup);
    for (unsigned rest = setup->live & setup->beyond; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        append_64_bits(&tile->primitives, first + lane, setup, lane);
    }
    vi_store(ids, vi_add(vi_set((int32_t)first), vi_ramp(1)));
    compute_steps(setup, samples, &steps);
    if (LANES > 1 && samples == TINY_SAMPLES && setup->tiny_3x3 == setup->live) {
        compute_tiny_samples(setup, &steps, found);
        draw_tiny_samples(tile, setup, found, planes, ids);
        return;
    }
    if (HAS_QUEUE) {
        draw_runs(tile, setup, &steps, kind, ids, queue);
        return;
    }
    for (unsigned rest = setup->live; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        draw_alone(tile, setup, &steps, lane, kind, ids[lane]);
    }
}

/* Adds a group of triangles to the layers. indices: of their primitives. */
BURNISH_INLINE void draw_layers(burnish_tile *tile, const triangle_setup *setup,
                                const uint32_t *indices, unsigned back) {
    const int samples = tile->options.samples;
    sample_steps steps;
    if (samples > 1) {
        compute_steps(setup, samples, &steps);
    }
    for (unsigned rest = setup->live; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        const int32_t id = (int32_t)(indices[lane] * 2 + back);
        draw_alone(tile, setup, &steps, lane, (draw_kind){samples, 0, KEEP_LAYER}, id);
    }
}

/* Draws a group of triangles where they were chosen of the layers. */
BURNISH_INLINE void draw_chosen_group(burnish_tile *tile, const triangle_setup *setup,
                                      const uint32_t *indices, unsigned back) {
    const draw_kind kind = {tile->options.samples, tile->options.planes, KEEP_CHOSEN};
    const int32_t first = (int32_t)tile->primitives.count;
    sample_steps steps;
    if (kind.samples > 1) {
        append_primitives(&tile->primitives, setup);
        compute_steps(setup, kind.samples, &steps);
    }
    for (unsigned rest = setup->live; rest; rest &= rest - 1) {
        const size_t lane = (size_t)__builtin_ctz(rest);
        if (kind.samples > 1 && setup->beyond >> lane & 1) {
            append_64_bits(&tile->primitives, (size_t)first + lane, setup, lane);
        }
        tile->layers->current = indices[lane] * 2 + back;
        draw_alone(tile, setup, &steps, lane, kind,
                   kind.samples > 1 ? first + (int32_t)lane
                                    : (int32_t)setup->primitives.id_and_facing[lane]);
    }
}

/* Draws primitives in their order; all are front- or all back-facing. keep: KEEP_ID for whatever
 * the tile's options say. */
static void draw_primitives(burnish_tile *tile, const burnish_geometry *geometry,
                            const uint32_t *indices, size_t count, unsigned back, int keep) {
    const burnish_tile_options *options = &tile->options;
    triangle_setup setup;
    tiny_pixels pixels = {0};
    tiny_samples found;
    stamp_queue queue;
    large_group group;
    primitive_group next;
    fetch_group(tile, geometry, indices, count < LANES ? count : LANES, back, &next);
    for (size_t first = 0; first < count; first += LANES) {
        const size_t lanes = count - first < LANES ? count - first : LANES;
        const size_t after = first + lanes, ahead = count - after < LANES ? count - after : LANES;
        vi x[3], y[3];
        vf depth[3];
        setup.primitives = next;
        fetch_group(tile, geometry, indices + after, ahead, back, &next);
        load_group(tile, geometry, &setup, x, y, depth);
        compute_setup(tile, lanes, x, y, depth, &setup);
        if (setup.live & ~setup.small) {
            prepare_large(options->samples, keep == KEEP_LAYER ? 0 : options->planes, &setup,
                          &group);
        }
        if (keep == KEEP_LAYER) {
            draw_layers(tile, &setup, indices + first, back);
        } else if (keep == KEEP_CHOSEN) {
            draw_chosen_group(tile, &setup, indices + first, back);
        } else if (options->samples == 4 && options->planes == 3) {
            draw_multisampled(tile, &setup, 4, 3, &found, &queue);
        } else if (options->samples > 1) {
            draw_multisampled(tile, &setup, options->samples, options->planes, &found, &queue);
        } else if (options->planes == 3 && !options->keep_ids) {
            draw_single_sampled(tile, &setup, 3, 0, &pixels, &queue);
        } else if (options->planes == 3) {
            draw_single_sampled(tile, &setup, 3, 1, &pixels, &queue);
        } else if (options->planes == 0 && !options->keep_ids) {
            draw_single_sampled(tile, &setup, 0, 0, &pixels, &queue);
        } else if (options->planes == BURNISH_PLANE_COUNT && !options->keep_ids) {
            draw_single_sampled(tile, &setup, BURNISH_PLANE_COUNT, 0, &pixels, &queue);
        } else {
            draw_single_sampled(tile, &setup, options->planes, options->keep_ids, &pixels, &queue);
        }
    }
}

/* ---- Lists ---- */

enum {
    LIST_PART = BURNISH_TILE_LIST_PART, /* entries read at once */
    /* triangles drawn before HiZ is built again: as much work as a few of them */
    HIZ_AGE = 2048
};

/* The primitives of some entries; returns how many. */
static size_t expand_entries(const burnish_bin_entry *entries, size_t count, uint32_t *indices) {
    size_t found = 0;
    for (size_t i = 0; i < count; ++i) {
        for (unsigned rest = entries[i].mask; rest; rest &= rest - 1) {
            indices[found++] =
                entries[i].batch * BURNISH_BATCH_SIZE + (uint32_t)__builtin_ctz(rest);
        }
    }
    return found;
}

/* Removes transparent triangles or, for layers, opaque ones. Returns how many entries are left. */
static size_t select_opaque(burnish_tile *tile, int are_layers, burnish_bin_entry *entries,
                            size_t count) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        const burnish_bin_entry entry = entries[i];
        const uint32_t transparent = entry.mask & tile->transparent[entry.batch];
        const uint32_t mask = are_layers ? transparent : entry.mask ^ transparent;
        if (tile->layers) {
            tile->layers->has_some |= transparent != 0;
        }
        entries[kept] = (burnish_bin_entry){entry.batch, mask};
        kept += mask != 0;
    }
    return kept;
}

/* Draws a list. Triangles that HiZ hides are left out: it is built every HIZ_AGE triangles, and at
 * once where others have been drawn before. */
static void draw_list(burnish_tile *tile, const burnish_geometry *geometry,
                      burnish_list_reader reader, unsigned back, int is_second, int keep) {
    const int are_layers = keep != KEEP_ID;
    burnish_bin_entry part[LIST_PART];
    uint32_t indices[LIST_PART * BURNISH_BATCH_SIZE];
    burnish_tile_primitives *primitives = &tile->primitives;
    size_t age = is_second ? HIZ_AGE : 0, count;
    int has_hiz = 0;
    while ((count = burnish_list_read(&reader, part, LIST_PART)) > 0) {
        if (tile->transparent) {
            count = select_opaque(tile, are_layers, part, count);
        }
        if (age >= HIZ_AGE) {
            hiz_build(tile);
            has_hiz = 1;
            age = 0;
        }
        if (tile->is_overdrawn && !are_layers) {
            has_hiz |= hiz_fill(tile, geometry, back, part, count);
        }
        if (has_hiz) {
            count = hiz_cull(tile, geometry, part, count);
        }
        count = expand_entries(part, count, indices);
        if (tile->options.samples > 1 && keep != KEEP_LAYER &&
            primitives->count + count + BURNISH_TILE_PRIMITIVES_EXTRA > primitives->capacity) {
            evict_hidden(tile);
        }
        if (geometry->indices) {
            draw_primitives(tile, geometry, indices, count, back, keep);
        } else {
            const int32_t largest = draw_points(tile, geometry, indices, count);
            tile->largest_disc = largest > tile->largest_disc ? largest : tile->largest_disc;
        }
        age += are_layers ? 0 : count;
    }
}

/* Draws points, and blends those that are seen. */
static void draw_cloud(burnish_tile *tile, const burnish_geometry *geometry,
                       burnish_list_reader list) {
    burnish_bin_entry part[LIST_PART];
    uint32_t indices[LIST_PART * BURNISH_BATCH_SIZE];
    point_blend blend;
    size_t count;
    tile->largest_disc = 0;
    draw_list(tile, geometry, list, 0, 0, KEEP_ID);
    if (tile->options.planes == 0 || tile->largest_disc < BLEND_RADIUS) {
        return;
    }
    hiz_build(tile);
    begin_blend(tile, &blend);
    while ((count = burnish_list_read(&list, part, LIST_PART)) > 0) {
        count = expand_entries(part, hiz_cull(tile, geometry, part, count), indices);
        blend_points(tile, geometry, indices, count, &blend);
    }
    end_blend(tile, &blend);
}

static void draw_tile(burnish_tile *tile, const burnish_geometry *geometry,
                      const burnish_bins *bins, int column, int row) {
    const burnish_list_reader front = burnish_list_begin(bins, column, row, 0);
    const burnish_list_reader back = burnish_list_begin(bins, column, row, 1);
    if (!geometry->indices) {
        draw_cloud(tile, geometry, front);
        return;
    }
    draw_list(tile, geometry, front, 0, 0, KEEP_ID);
    draw_list(tile, geometry, back, 1, !burnish_list_is_empty(front), KEEP_ID);
    if (tile->layers && tile->layers->has_some && !tile->layers->chosen) {
        draw_list(tile, geometry, front, 0, 1, KEEP_LAYER);
        draw_list(tile, geometry, back, 1, 1, KEEP_LAYER);
    }
}

static void draw_deeper_layers(burnish_tile *tile, const burnish_geometry *geometry,
                               const burnish_bins *bins, int column, int row) {
    draw_list(tile, geometry, burnish_list_begin(bins, column, row, 0), 0, 1, KEEP_LAYER);
    draw_list(tile, geometry, burnish_list_begin(bins, column, row, 1), 1, 1, KEEP_LAYER);
}

static void draw_chosen(burnish_tile *tile, const burnish_geometry *geometry,
                        const burnish_bins *bins, int column, int row) {
    draw_list(tile, geometry, burnish_list_begin(bins, column, row, 0), 0, 1, KEEP_CHOSEN);
    draw_list(tile, geometry, burnish_list_begin(bins, column, row, 1), 1, 1, KEEP_CHOSEN);
}

#endif
