/* A tile's memory, and its beginning and end; what is between is in tile_simd.h. */
#include "raster/tile.h"

#include <string.h>

#include "base/memory.h"
#include "raster/raster_ops.h"

static void create_primitives(burnish_tile_primitives *primitives, size_t capacity,
                              burnish_memory *memory) {
    const size_t count = capacity + BURNISH_TILE_PRIMITIVES_EXTRA;
    const char *what = "a tile's primitives";
    primitives->edges = burnish_allocate(memory, count, sizeof *primitives->edges, what);
    primitives->weights = burnish_allocate(memory, count, sizeof *primitives->weights, what);
    primitives->depths = burnish_allocate(memory, count, sizeof *primitives->depths, what);
    primitives->primitives = burnish_allocate(memory, count, sizeof *primitives->primitives, what);
    primitives->constants = burnish_allocate(memory, count, sizeof *primitives->constants, what);
    primitives->moved = burnish_allocate(memory, capacity, sizeof *primitives->moved, what);
    primitives->capacity = capacity;
}

static burnish_tile_layers *create_layers(size_t samples, int has_chosen, burnish_memory *memory) {
    burnish_tile_layers *layers = burnish_allocate_zeroed(memory, 1, sizeof *layers, "layers");
    if (layers) {
        layers->block_samples =
            (int)(samples / (BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS)); /* a power of two */
        const size_t count = samples * BURNISH_LAYERS_MAX;
        layers->depths = burnish_allocate(memory, count, sizeof *layers->depths, "layers");
        layers->indices = burnish_allocate(memory, count, sizeof *layers->indices, "layers");
        layers->counts = burnish_allocate(memory, samples, sizeof *layers->counts, "layers");
        layers->fronts = burnish_allocate(memory, samples, sizeof *layers->fronts, "layers");
        if (has_chosen) {
            layers->chosen = burnish_allocate(memory, samples, sizeof *layers->chosen, "layers");
        }
    }
    return layers;
}

static void destroy_layers(burnish_tile_layers *layers, const burnish_context *context) {
    if (layers) {
        burnish_release(context, layers->depths);
        burnish_release(context, layers->indices);
        burnish_release(context, layers->counts);
        burnish_release(context, layers->fronts);
        burnish_release(context, layers->chosen);
        burnish_release(context, layers);
    }
}

int burnish_tile_primitives_of(const burnish_geometry *geometry) {
    enum { MOST = 1 << 20 }; /* more than any tile holds */
    const size_t needed =
        geometry->batch_count * BURNISH_BATCH_SIZE + BURNISH_TILE_PRIMITIVES_AT_ONCE;
    int room = 1;
    while ((size_t)room < needed && room < MOST) {
        room *= 2;
    }
    return room;
}

burnish_status burnish_tile_create(burnish_tile *tile, const burnish_tile_options *options,
                                   const burnish_context *context, burnish_error *error) {
    const int samples = options->samples;
    const size_t pixels = BURNISH_TILE_PIXELS, count = pixels * (size_t)samples;
    burnish_memory memory = burnish_memory_of(context, error);
    burnish_tile_buffer *buffer = &tile->buffer;
    memset(tile, 0, sizeof *tile);
    tile->options = *options;
    tile->context = context;
    /* pixels that no triangle covers may be shaded too: all numbers are finite from the start */
    buffer->depths = burnish_allocate_zeroed(&memory, count, sizeof *buffer->depths, "a tile");
    for (int k = 0; k < options->planes; ++k) {
        buffer->planes[k] = burnish_allocate_zeroed(&memory, pixels, sizeof(float), "a tile");
    }
    buffer->center_depths = samples == 1
                                ? buffer->depths
                                : burnish_allocate_zeroed(&memory, pixels, sizeof(float), "a tile");
    if (samples > 1 || options->keep_ids) {
        buffer->ids = burnish_allocate(&memory, count, sizeof *buffer->ids, "a tile");
    }
    if (samples > 1) {
        for (unsigned bits = 0; bits < sizeof tile->means / sizeof *tile->means; ++bits) {
            tile->means[bits] = burnish_mean_of_samples(samples, bits);
        }
        const size_t most = (size_t)BURNISH_TILE_PRIMITIVES * (size_t)samples;
        const size_t needed = options->primitives > 0 ? (size_t)options->primitives : most;
        create_primitives(&tile->primitives, needed < most ? needed : most, &memory);
    }
    if (options->has_layers) {
        tile->layers = create_layers(count, options->has_layers > 1, &memory);
    }
    return memory.status;
}

void burnish_tile_destroy(burnish_tile *tile) {
    const burnish_context *context = tile->context;
    burnish_tile_buffer *buffer = &tile->buffer;
    if (buffer->center_depths != buffer->depths) {
        burnish_release(context, buffer->center_depths);
    }
    burnish_release(context, buffer->depths);
    for (int k = 0; k < BURNISH_PLANE_COUNT; ++k) {
        burnish_release(context, buffer->planes[k]);
    }
    burnish_release(context, buffer->ids);
    burnish_release(context, tile->primitives.edges);
    burnish_release(context, tile->primitives.weights);
    burnish_release(context, tile->primitives.depths);
    burnish_release(context, tile->primitives.primitives);
    burnish_release(context, tile->primitives.constants);
    burnish_release(context, tile->primitives.moved);
    destroy_layers(tile->layers, context);
    memset(tile, 0, sizeof *tile);
}

/* Sets the depths of the pixels beyond the image's right and lower edge. */
static void fill_outside(burnish_tile *tile, float depth) {
    const int size = BURNISH_BLOCK_PIXELS * tile->options.samples;
    if (tile->width == BURNISH_TILE_SIZE && tile->height == BURNISH_TILE_SIZE) {
        return;
    }
    for (int block = 0; block < BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS; ++block) {
        const int width = tile->width - burnish_pixel_x(block * BURNISH_BLOCK_PIXELS);
        const int height = tile->height - burnish_pixel_y(block * BURNISH_BLOCK_PIXELS);
        float *depths = tile->buffer.depths + block * size;
        if (width >= BURNISH_BLOCK_SIZE && height >= BURNISH_BLOCK_SIZE) {
            continue;
        }
        for (int i = 0; i < size; ++i) {
            const int outside = i % BURNISH_BLOCK_SIZE >= width ||
                                i % BURNISH_BLOCK_PIXELS / BURNISH_BLOCK_SIZE >= height;
            depths[i] = outside ? depth : depths[i];
        }
    }
}

int burnish_tile_draw(burnish_tile *tile, const burnish_raster_ops *ops,
                      const burnish_raster_view *view, const burnish_geometry *geometry,
                      const burnish_bins *bins, int column, int row) {
    tile->x = column * BURNISH_TILE_SIZE;
    tile->y = row * BURNISH_TILE_SIZE;
    const int right = view->width - tile->x, below = view->height - tile->y;
    tile->width = right < BURNISH_TILE_SIZE ? right : BURNISH_TILE_SIZE;
    tile->height = below < BURNISH_TILE_SIZE ? below : BURNISH_TILE_SIZE;
    if (tile->layers) {
        tile->layers->has_some = tile->layers->pass = 0;
        tile->layers->dropped_before = tile->layers->dropped;
    }
    if (burnish_list_is_empty(burnish_list_begin(bins, column, row, 0)) &&
        burnish_list_is_empty(burnish_list_begin(bins, column, row, 1))) {
        return 0;
    }
    const size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)tile->options.samples;
    for (size_t i = 0; i < count; ++i) {
        tile->buffer.depths[i] = BURNISH_FARTHEST;
    }
    if (tile->layers && tile->transparent) {
        memset(tile->layers->counts, 0, count * sizeof *tile->layers->counts);
    }
    if (tile->options.samples > 1) {
        memset(tile->buffer.ids, 0xff, count * sizeof *tile->buffer.ids);
    }
    for (int i = 0; i < BURNISH_HIZ_SIZE * BURNISH_HIZ_SIZE; ++i) {
        tile->hiz.cells[i] = BURNISH_FARTHEST;
    }
    tile->is_overdrawn =
        geometry->indices && burnish_overdraw(geometry->cells, view) >= BURNISH_TILE_OVERDRAWN;
    memset(tile->buffer.dirty_blocks, 0, sizeof tile->buffer.dirty_blocks);
    tile->primitives.count = 0;
    tile->are_points = !geometry->indices;
    fill_outside(tile, BURNISH_NEAREST); /* nothing is drawn there, and HiZ does not wait for it */
    ops->draw_tile(tile, geometry, bins, column, row);
    fill_outside(tile, BURNISH_FARTHEST);
    return 1;
}

/* The tables of kernels. */
#define OPS burnish_raster_ops
#include "simd/isa_table.h"
