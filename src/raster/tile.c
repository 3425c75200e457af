/* A tile from its lists of triangles to whole pixels and blocks of visible points; the drawing
 * itself is in tile_simd.h. */
#include "raster/tile.h"

#include <string.h>

#include "core/memory.h"
#include "simd/isa_ops.h"

static burnish_status allocate_floats(float **array, size_t count, burnish_error *error) {
    burnish_status status =
        burnish_legacy_allocate((void **)array, count, sizeof **array, "a tile", error);
    if (status == BURNISH_STATUS_OK) {
        memset(*array, 0, count * sizeof **array); /* what no triangle covers may be shaded too */
    }
    return status;
}

/* The samples of a pixel that bits stand for. A mean is rounded towards 0. */
static burnish_sample_mean find_mean(int samples, unsigned bits) {
    const int8_t(*offsets)[2] = burnish_sample_offsets(samples);
    const int step = BURNISH_SUBPIXELS / 16;
    int x = 0, y = 0, count = 0;
    for (int s = 0; s < samples; ++s) {
        const int is_in = bits >> s & 1;
        x += is_in * offsets[s][0];
        y += is_in * offsets[s][1];
        count += is_in;
    }
    const int divisor = count > 0 ? count : 1;
    return (burnish_sample_mean){(int16_t)(x * step / divisor), (int16_t)(y * step / divisor),
                                 count};
}

static burnish_status create_triangles(burnish_tile_primitives *triangles, size_t capacity,
                                       burnish_error *error) {
    const size_t count = capacity + BURNISH_TILE_PRIMITIVES_EXTRA;
    const char *what = "a tile's triangles";
    burnish_status status = burnish_legacy_allocate((void **)&triangles->edges, count,
                                                    sizeof *triangles->edges, what, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&triangles->weights, count,
                                         sizeof *triangles->weights, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&triangles->depths, count,
                                         sizeof *triangles->depths, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&triangles->primitives, count,
                                         sizeof *triangles->primitives, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&triangles->constants, count,
                                         sizeof *triangles->constants, what, error);
    }
    triangles->capacity = capacity;
    return status;
}

burnish_status burnish_tile_create(burnish_tile *tile, const burnish_tile_options *options,
                                   burnish_error *error) {
    const int samples = options->samples;
    const size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)samples;
    memset(tile, 0, sizeof *tile);
    tile->options = *options;
    burnish_status status = allocate_floats(&tile->depths, count, error);
    for (int k = 0; k < options->planes && status == BURNISH_STATUS_OK; ++k) {
        status = allocate_floats(&tile->planes[k], BURNISH_TILE_PIXELS, error);
    }
    if (samples == 1) {
        tile->center_depths = tile->depths;
    } else if (status == BURNISH_STATUS_OK) {
        status = allocate_floats(&tile->center_depths, BURNISH_TILE_PIXELS, error);
    }
    if (status == BURNISH_STATUS_OK && (samples > 1 || options->keep_ids)) {
        status =
            burnish_legacy_allocate((void **)&tile->ids, count, sizeof *tile->ids, "a tile", error);
    }
    if (status == BURNISH_STATUS_OK && samples > 1) {
        const size_t capacity = (size_t)BURNISH_TILE_PRIMITIVES * (size_t)samples;
        for (unsigned bits = 0; bits < 256; ++bits) {
            tile->means[bits] = find_mean(samples, bits);
        }
        status = create_triangles(&tile->primitives, capacity, error);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_legacy_allocate((void **)&tile->places, capacity, sizeof *tile->places,
                                             "a tile's triangles", error);
        }
    }
    return status;
}

void burnish_tile_destroy(burnish_tile *tile) {
    if (tile->center_depths != tile->depths) {
        free(tile->center_depths);
    }
    free(tile->depths);
    for (int k = 0; k < BURNISH_PLANE_COUNT; ++k) {
        free(tile->planes[k]);
    }
    free(tile->ids);
    free(tile->primitives.edges);
    free(tile->primitives.weights);
    free(tile->primitives.depths);
    free(tile->primitives.primitives);
    free(tile->primitives.constants);
    free(tile->places);
    memset(tile, 0, sizeof *tile);
}

/* Samples own at most half of the triangles that the tile can remember, so that half are free
 * afterwards. Triangles keep their order. */
static void evict_hidden(burnish_tile *tile) {
    const size_t samples = (size_t)BURNISH_TILE_PIXELS * (size_t)tile->options.samples;
    burnish_tile_primitives *triangles = &tile->primitives;
    int32_t *places = tile->places, kept = 0;
    memset(places, 0, triangles->count * sizeof *places);
    for (size_t i = 0; i < samples; ++i) {
        if (tile->ids[i] >= 0) {
            places[tile->ids[i]] = 1;
        }
    }
    for (size_t i = 0; i < triangles->count; ++i) {
        if (places[i]) {
            triangles->edges[kept] = triangles->edges[i];
            triangles->weights[kept] = triangles->weights[i];
            triangles->depths[kept] = triangles->depths[i];
            triangles->primitives[kept] = triangles->primitives[i];
            memmove(triangles->constants[kept], triangles->constants[i],
                    sizeof *triangles->constants);
            places[i] = kept++;
        }
    }
    for (size_t i = 0; i < samples; ++i) {
        if (tile->ids[i] >= 0) {
            tile->ids[i] = places[tile->ids[i]];
        }
    }
    triangles->count = (size_t)kept;
}

enum {
    LIST_PART = 128, /* entries read at once */
    /* triangles drawn before the coarse depth is found again: as much work as a few of them */
    COARSE_AGE = 2048
};

/* The slots of some entries; returns how many. */
static size_t find_slots(const burnish_bin_entry *entries, size_t count, uint32_t *slots) {
    size_t found = 0;
    for (size_t i = 0; i < count; ++i) {
        for (unsigned rest = entries[i].mask; rest; rest &= rest - 1) {
            slots[found++] = entries[i].batch * BURNISH_BATCH_SIZE + (uint32_t)__builtin_ctz(rest);
        }
    }
    return found;
}

/* Draws a list. Those triangles that the coarse depth hides are left out; before any is drawn, if
 * `is_behind` others. */
static void draw_list(burnish_tile *tile, const burnish_isa_ops *ops,
                      const burnish_geometry *geometry, burnish_list_reader reader, unsigned back,
                      int is_behind) {
    burnish_bin_entry part[LIST_PART];
    uint32_t slots[LIST_PART * BURNISH_BATCH_SIZE];
    size_t age = is_behind ? COARSE_AGE : 0, count;
    int is_coarse = 0;
    while ((count = burnish_list_read(&reader, part, LIST_PART)) > 0) {
        if (age >= COARSE_AGE) {
            ops->hiz_build(tile);
            is_coarse = 1;
            age = 0;
        }
        if (is_coarse) {
            count = ops->hiz_cull(tile, geometry, part, count);
        }
        count = find_slots(part, count, slots);
        if (tile->options.samples > 1 &&
            tile->primitives.count + count + BURNISH_TILE_PRIMITIVES_EXTRA >
                tile->primitives.capacity) {
            evict_hidden(tile);
        }
        ops->draw_primitives(tile, geometry, slots, count, back);
        age += count;
    }
}

/* Vectors may have drawn beyond the image's right and lower edge. */
static void clear_outside(burnish_tile *tile) {
    const int samples = tile->options.samples;
    for (int place = 0; place < BURNISH_TILE_PIXELS; ++place) {
        if (burnish_pixel_x(place) < tile->width && burnish_pixel_y(place) < tile->height) {
            continue;
        }
        for (int s = 0; s < samples; ++s) {
            const int sample = burnish_sample_index(samples, place, s);
            tile->depths[sample] = BURNISH_FARTHEST;
            if (samples > 1) {
                tile->ids[sample] = -1;
            }
        }
    }
}

int burnish_tile_draw(burnish_tile *tile, const burnish_isa_ops *ops,
                      const burnish_raster_view *view, const burnish_geometry *geometry,
                      const burnish_bins *bins, int column, int row) {
    const burnish_list_reader fronts = burnish_list_begin(bins, column, row, 0);
    const burnish_list_reader backs = burnish_list_begin(bins, column, row, 1);
    tile->x = column * BURNISH_TILE_SIZE;
    tile->y = row * BURNISH_TILE_SIZE;
    int right = view->width - tile->x, below = view->height - tile->y;
    tile->width = right < BURNISH_TILE_SIZE ? right : BURNISH_TILE_SIZE;
    tile->height = below < BURNISH_TILE_SIZE ? below : BURNISH_TILE_SIZE;
    tile->next_block = 0;
    tile->ops = ops;
    tile->primitives.count = 0;
    if (burnish_list_is_empty(fronts) && burnish_list_is_empty(backs)) {
        return 0;
    }
    const size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)tile->options.samples;
    for (size_t i = 0; i < count; ++i) {
        tile->depths[i] = BURNISH_FARTHEST;
    }
    if (tile->options.samples > 1) {
        memset(tile->ids, 0xff, count * sizeof *tile->ids);
    }
    memset(tile->dirty_blocks, 0, sizeof tile->dirty_blocks);
    draw_list(tile, ops, geometry, fronts, 0, 0);
    draw_list(tile, ops, geometry, backs, 1, !burnish_list_is_empty(fronts));
    if (tile->width % BURNISH_BLOCK_SIZE || tile->height % BURNISH_BLOCK_SIZE) {
        clear_outside(tile);
    }
    return 1;
}

/* 1/256 pixel from the tile's edge to a pixel's centre. */
static int center_of(int pixel) {
    return pixel * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2;
}

/* The points of a block's shared pixels. */
static void append_points(const burnish_tile *tile, int block, const burnish_complex_pixels *shared,
                          burnish_sample_points *points, burnish_fragments *fragments) {
    const int samples = tile->options.samples;
    for (int i = 0; i < shared->count; ++i) {
        const int place = block * BURNISH_BLOCK_PIXELS + shared->pixel[i], at = points->count++;
        const unsigned bits = shared->samples[i];
        const burnish_sample_mean mean =
            samples <= 8 ? tile->means[bits] : find_mean(samples, bits);
        points->id[at] = shared->id[i];
        points->x[at] = center_of(burnish_pixel_x(place)) + mean.x;
        points->y[at] = center_of(burnish_pixel_y(place)) + mean.y;
        fragments->pixels[at] = (uint16_t)place;
        fragments->weight[at] = (uint8_t)mean.count;
        fragments->primitives[at] = tile->primitives.primitives[shared->id[i]];
    }
}

int burnish_tile_next_fragments(burnish_tile *tile, const burnish_raster_view *view,
                                burnish_fragments *fragments) {
    burnish_complex_pixels shared;
    burnish_sample_points points;
    int block = tile->next_block;
    points.count = 0;
    for (; tile->options.samples > 1 && block < BURNISH_TILE_PIXELS / BURNISH_BLOCK_PIXELS;
         ++block) {
        if (!(tile->dirty_blocks[block / BURNISH_TILE_BLOCKS] >> block % BURNISH_TILE_BLOCKS & 1)) {
            continue;
        }
        tile->ops->group_samples(tile, block, &shared);
        if (points.count + shared.count > BURNISH_FRAGMENT_BATCH) {
            break;
        }
        append_points(tile, block, &shared, &points, fragments);
    }
    fragments->count = points.count;
    if (points.count > 0) {
        tile->ops->compute_fragments(tile, view, &points, fragments);
    }
    tile->next_block = block;
    return fragments->count > 0;
}
