#include "raster/layers.h"

#include <string.h>

enum { HALF_PIXEL = BURNISH_SUBPIXELS / 2, BLOCKS = BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS };

static void find_deepest(const burnish_tile *tile, burnish_layer_cursor *cursor) {
    const int size = BURNISH_BLOCK_PIXELS * tile->options.samples;
    for (int block = 0; block < BLOCKS; ++block) {
        const uint8_t *counts = tile->layers->counts + block * size;
        uint8_t most = 0;
        for (int i = 0; i < size; ++i) {
            most = counts[i] > most ? counts[i] : most;
        }
        cursor->deepest[block] = most;
    }
    cursor->is_begun = 1;
}

/* A vertex, 1/256 pixel from the tile's corner. */
typedef struct corner {
    int64_t x, y;
} corner;

static corner corner_at(const burnish_tile *tile, const burnish_screen_vertex *vertex) {
    return (corner){(int64_t)vertex->x - (int64_t)tile->x * BURNISH_SUBPIXELS,
                    (int64_t)vertex->y - (int64_t)tile->y * BURNISH_SUBPIXELS};
}

/* Twice the area of the triangle of an edge and a point. */
static int64_t edge_at(corner a, corner b, int64_t x, int64_t y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/* Appends the samples `bits` of a pixel, which show one primitive. */
static void append_fragment(const burnish_tile *tile, const burnish_raster_view *view,
                            const burnish_geometry *geometry, int pixel, unsigned bits,
                            uint32_t index_and_facing, burnish_fragments *fragments) {
    const burnish_primitive primitive =
        burnish_geometry_primitive(geometry, index_and_facing >> 1, index_and_facing & 1);
    const burnish_screen_vertex *items = geometry->vertices.items;
    const uint32_t *v = primitive.vertices;
    const int samples = tile->options.samples, i = fragments->count++;
    const burnish_sample_mean mean =
        samples == 4 || samples == 8 ? tile->means[bits] : burnish_mean_of_samples(samples, bits);
    const int x = burnish_pixel_x(pixel) * BURNISH_SUBPIXELS + HALF_PIXEL + mean.x;
    const int y = burnish_pixel_y(pixel) * BURNISH_SUBPIXELS + HALF_PIXEL + mean.y;
    const corner c[3] = {corner_at(tile, &items[v[0]]), corner_at(tile, &items[v[1]]),
                         corner_at(tile, &items[v[2]])};
    const float inverse_area = 1.0f / (float)edge_at(c[0], c[1], c[2].x, c[2].y);
    const float weight1 = (float)edge_at(c[2], c[0], x, y) * inverse_area;
    const float weight2 = (float)edge_at(c[0], c[1], x, y) * inverse_area;
    const float depth0 = items[v[0]].depth;
    fragments->pixels[i] = (uint16_t)pixel;
    fragments->samples[i] = (uint16_t)bits;
    fragments->weight[i] = (uint8_t)mean.count;
    fragments->primitives[i] = primitive;
    fragments->x[i] = (float)(x + tile->x * BURNISH_SUBPIXELS - view->width * HALF_PIXEL) *
                      (1.0f / BURNISH_SUBPIXELS);
    fragments->y[i] = (float)(view->height * HALF_PIXEL - tile->y * BURNISH_SUBPIXELS - y) *
                      (1.0f / BURNISH_SUBPIXELS);
    fragments->depth[i] =
        (depth0 + weight1 * (items[v[1]].depth - depth0)) + weight2 * (items[v[2]].depth - depth0);
    fragments->weight1[i] = weight1;
    fragments->weight2[i] = weight2;
}

/* Groups the samples of a pixel by the triangle that they show in a layer. */
static void append_pixel(const burnish_tile *tile, const burnish_raster_view *view,
                         const burnish_geometry *geometry, int layer, int pixel,
                         burnish_fragments *fragments) {
    const burnish_tile_layers *layers = tile->layers;
    const int samples = tile->options.samples;
    const int first = burnish_sample_index(samples, pixel, 0);
    uint32_t shown[BURNISH_MAX_SAMPLES];
    unsigned left = 0;
    for (int s = 0, at = first; s < samples; ++s, at += BURNISH_BLOCK_PIXELS) {
        if (layers->counts[at] > layer) {
            const size_t nearest = burnish_layer_index(layers, at);
            shown[s] = layers->indices[nearest + (size_t)(layer * layers->block_samples)];
            left |= 1u << s;
        }
    }
    while (left) {
        const uint32_t triangle = shown[__builtin_ctz(left)];
        unsigned bits = 0;
        for (unsigned rest = left; rest; rest &= rest - 1) {
            const int s = __builtin_ctz(rest);
            bits |= (unsigned)(shown[s] == triangle) << s;
        }
        append_fragment(tile, view, geometry, pixel, bits, triangle, fragments);
        left &= ~bits;
    }
}

int burnish_layers_next(const burnish_tile *tile, const burnish_raster_view *view,
                        const burnish_geometry *geometry, burnish_layer_cursor *cursor,
                        burnish_fragments *fragments) {
    const int samples = tile->options.samples;
    fragments->count = 0;
    if (!cursor->is_begun) {
        find_deepest(tile, cursor);
    }
    for (; cursor->layer < BURNISH_LAYERS_MAX; ++cursor->layer, cursor->pixel = 0) {
        int is_last = 1;
        for (int block = 0; block < BLOCKS; ++block) {
            is_last &= cursor->deepest[block] <= cursor->layer;
        }
        if (is_last) {
            break;
        }
        while (cursor->pixel < BURNISH_TILE_PIXELS) {
            if (cursor->deepest[cursor->pixel / BURNISH_BLOCK_PIXELS] <= cursor->layer) {
                cursor->pixel += BURNISH_BLOCK_PIXELS;
                continue;
            }
            if (fragments->count + samples > BURNISH_FRAGMENT_BATCH) {
                return 1;
            }
            append_pixel(tile, view, geometry, cursor->layer, cursor->pixel++, fragments);
        }
    }
    return fragments->count > 0;
}

int burnish_layers_deeper(burnish_tile *tile, const float *through, size_t channel, float least,
                          int passes) {
    burnish_tile_layers *layers = tile->layers;
    const size_t last = (size_t)(BURNISH_LAYERS_MAX - 1) * (size_t)layers->block_samples;
    const int count = BLOCKS * layers->block_samples;
    int is_any = 0;
    if (layers->dropped == layers->dropped_before) {
        return 0;
    }
    for (int i = 0; i < count; ++i) {
        const float *shares = through + i;
        const int passes_some =
            shares[0] > least || shares[channel] > least || shares[2 * channel] > least;
        const int is_open = layers->counts[i] == BURNISH_LAYERS_MAX && passes_some;
        layers->fronts[i] =
            is_open ? layers->depths[burnish_layer_index(layers, i) + last] : 2 * BURNISH_FARTHEST;
        layers->counts[i] = 0;
        is_any |= is_open;
    }
    if (is_any && layers->pass + 1 >= passes) {
        return 0;
    }
    layers->dropped = layers->dropped_before; /* what nobody would have seen does not count */
    layers->pass += is_any;
    return is_any;
}
