/* The reference renderer of a tile, kept plain: what src/raster/tile*.c do fast must come out
 * as it comes out here, bit for bit. Included by tests.
 *
 * The rules. A sample belongs to the triangle that is nearest there; of two at the same depth to
 * the one seen from its front, then to the first. All samples of a pixel that show one triangle are
 * one point, at the pixel's centre when that is the whole pixel, else at the mean of the samples.
 */
#ifndef BURNISH_TEST_REFERENCE_TILE_H
#define BURNISH_TEST_REFERENCE_TILE_H

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "raster/fragments.h"
#include "raster/raster_ops.h"
#include "raster/raster_view.h"
#include "support.h"

/* A sample that no triangle covers. */
#define REFERENCE_NO_TRIANGLE UINT32_MAX

/* Indices of primitives, visible or not, are below it. */
static inline size_t reference_primitive_count(const burnish_geometry *geometry) {
    return geometry->batch_count * BURNISH_BATCH_SIZE;
}

/* The side from which a primitive is seen: 0 front, 1 back, -1 none. */
static inline int reference_side(const burnish_geometry *geometry, size_t index) {
    const burnish_batch_header *header = &geometry->headers[index / BURNISH_BATCH_SIZE];
    const unsigned lane = index % BURNISH_BATCH_SIZE;
    return header->visible[0] >> lane & 1 ? 0 : header->visible[1] >> lane & 1 ? 1 : -1;
}

static inline burnish_primitive reference_corners(const burnish_geometry *geometry, size_t index) {
    return burnish_geometry_primitive(geometry, index, reference_side(geometry, index) == 1);
}

/* A unit is a pixel, the image's middle at the origin, depth 1/2 + z / 500. */
static inline burnish_raster_view parallel_view(int width, int height, int samples) {
    return (burnish_raster_view){
        .width = width,
        .height = height,
        .samples = samples,
        .rows = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0.002f, 0.5f}, {0, 0, 0, 1}}};
}

/* In perspective, `distance` from the origin: the eye may be in the midst of a scene. */
static inline burnish_raster_view perspective_view(int width, int height, int samples,
                                                   float pixels_per_tangent, float distance) {
    return (burnish_raster_view){.width = width,
                                 .height = height,
                                 .samples = samples,
                                 .rows = {{pixels_per_tangent, 0, 0, 0},
                                          {0, pixels_per_tangent, 0, 0},
                                          {0, 0, 0, 0x1p-14f},
                                          {0, 0, -1, distance}}};
}

/* Vertices, batches and lists of a mesh whose lists need one pass. */
static inline void list_triangles(const burnish_raster_ops *ops, const burnish_raster_view *view,
                                  const burnish_triangles *triangles, burnish_geometry *geometry,
                                  burnish_bins *bins) {
    CHECK1(burnish_geometry_update(geometry, ops, view, triangles, NULL, NULL) ==
           BURNISH_STATUS_OK);
    burnish_bins_begin(bins, NULL);
    CHECK1(burnish_bin_tiles(bins, ops, geometry, view, NULL, NULL) == BURNISH_STATUS_OK);
}

/* Visibility of one tile: sample s of the tile's pixel p is entry p * samples + s. */
typedef struct reference_tile {
    int x, y, width, height; /* pixels; narrower at the image's right and lower edge */
    int samples;
    uint32_t *triangles; /* index of the nearest triangle or REFERENCE_NO_TRIANGLE */
    float *depths;
    int next_place; /* where reference_next_fragments goes on: in the order of burnish_pixel_index
                     */
} reference_tile;

/* Steps of 1/256 pixel in 1/16 pixel, the unit of sample positions. */
enum { SAMPLE_STEP = BURNISH_SUBPIXELS / 16 };

/* Edge functions and depth of one triangle. Edge i lies opposite vertex i; its function is
 * (b - a) x (p - a) in units of 1/65536 pixel^2, positive inside, and divided by the sum of all
 * three it is the screen-space barycentric weight of vertex i. */
typedef struct triangle_edges {
    int64_t dx[3], dy[3]; /* of each edge */
    int64_t x[3], y[3];   /* where each edge starts */
    int64_t bias[3];      /* -1 where the top-left rule leaves the edge out */
    float inverse_area;
    float depth0, depth1, depth2; /* of vertex 0; of 1 and 2 minus that */
    int is_large;                 /* longer than BURNISH_SMALL_EDGE: interpolated by planes */
} triangle_edges;

static void load_corners(const burnish_geometry *geometry, const burnish_primitive *corners,
                         triangle_edges *edges) {
    const burnish_screen_vertex *items = geometry->vertices.items;
    const uint32_t *v = corners->vertices;
    edges->is_large = 0;
    for (int i = 0; i < 3; ++i) {
        const burnish_screen_vertex *a = &items[v[i == 2 ? 0 : i + 1]];
        const burnish_screen_vertex *b = &items[v[i == 0 ? 2 : i - 1]];
        edges->x[i] = a->x;
        edges->y[i] = a->y;
        edges->dx[i] = (int64_t)b->x - a->x;
        edges->dy[i] = (int64_t)b->y - a->y;
        int top_or_left = edges->dy[i] < 0 || (edges->dy[i] == 0 && edges->dx[i] > 0);
        edges->bias[i] = top_or_left ? 0 : -1;
        edges->is_large |=
            llabs(edges->dx[i]) > BURNISH_SMALL_EDGE || llabs(edges->dy[i]) > BURNISH_SMALL_EDGE;
    }
    int64_t area = edges->dx[2] * edges->dy[0] - edges->dy[2] * edges->dx[0];
    edges->inverse_area = 1.0f / (float)area;
    edges->depth0 = items[v[0]].depth;
    edges->depth1 = items[v[1]].depth - edges->depth0;
    edges->depth2 = items[v[2]].depth - edges->depth0;
}

static void load_edges(const burnish_geometry *geometry, uint32_t triangle, triangle_edges *edges) {
    const burnish_primitive corners = reference_corners(geometry, triangle);
    load_corners(geometry, &corners, edges);
}

static int64_t edge_at(const triangle_edges *edges, int i, int64_t x, int64_t y) {
    return edges->dx[i] * (y - edges->y[i]) - edges->dy[i] * (x - edges->x[i]);
}

static float depth_at(const triangle_edges *edges, float weight1, float weight2) {
    return (edges->depth0 + weight1 * edges->depth1) + weight2 * edges->depth2;
}

/* A number that changes linearly over a large triangle: counted from the tile's first pixel. */
typedef struct reference_plane {
    double base, across, down;
    float low, high; /* of the vertices */
    int is_needle;   /* narrower than 1/16 pixel: numbers are kept between these */
} reference_plane;

/* The plane of a number: value0 at vertex 0, step1 and step2 more at vertices 1 and 2. */
static reference_plane reference_make_plane(const triangle_edges *edges, const reference_tile *tile,
                                            double value0, double step1, double step2) {
    const int64_t x = (int64_t)tile->x * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2;
    const int64_t y = (int64_t)tile->y * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2;
    const int64_t area = edges->dx[2] * edges->dy[0] - edges->dy[2] * edges->dx[0];
    const double inverse = 1.0 / (double)area;
    const double weight1 = (double)edge_at(edges, 1, x, y) * inverse;
    const double weight2 = (double)edge_at(edges, 2, x, y) * inverse;
    const double across1 = (double)(-256 * edges->dy[1]) * inverse;
    const double across2 = (double)(-256 * edges->dy[2]) * inverse;
    const double down1 = (double)(256 * edges->dx[1]) * inverse;
    const double down2 = (double)(256 * edges->dx[2]) * inverse;
    const float values[3] = {(float)value0, (float)(value0 + step1), (float)(value0 + step2)};
    const double steep[4] = {across1, across2, down1, down2};
    reference_plane plane = {value0 + (step1 * weight1 + step2 * weight2),
                             step1 * across1 + step2 * across2,
                             step1 * down1 + step2 * down2,
                             values[0],
                             values[0],
                             0};
    for (int i = 1; i < 3; ++i) {
        plane.low = values[i] < plane.low ? values[i] : plane.low;
        plane.high = values[i] > plane.high ? values[i] : plane.high;
    }
    for (int i = 0; i < 4; ++i) {
        plane.is_needle |= steep[i] > 16 || steep[i] < -16;
    }
    return plane;
}

/* At the centre of the tile's pixel (x, y). */
static float reference_plane_at(const reference_plane *plane, int x, int y) {
    const int u = x % 8, v = y % 8;
    const float cell = (float)((plane->base + plane->down * (y - v)) + plane->across * (x - u));
    return cell + ((float)plane->across * (float)u + (float)plane->down * (float)v);
}

static float reference_clamp(const reference_plane *plane, float value) {
    return value < plane->low ? plane->low : value > plane->high ? plane->high : value;
}

/* An attribute there. */
static inline float reference_attribute_at(const reference_plane *plane, int x, int y) {
    const float value = reference_plane_at(plane, x, y);
    return plane->is_needle ? reference_clamp(plane, value) : value;
}

static reference_plane depth_plane(const triangle_edges *edges, const reference_tile *tile) {
    return reference_make_plane(edges, tile, edges->depth0, edges->depth1, edges->depth2);
}

/* Pixels of the tile that the triangle's bounds touch; end is exclusive. */
static void pixel_bounds(const triangle_edges *edges, const reference_tile *tile, int *x0, int *y0,
                         int *x1, int *y1) {
    int64_t low_x = edges->x[0], high_x = low_x, low_y = edges->y[0], high_y = low_y;
    for (int i = 1; i < 3; ++i) {
        low_x = edges->x[i] < low_x ? edges->x[i] : low_x;
        high_x = edges->x[i] > high_x ? edges->x[i] : high_x;
        low_y = edges->y[i] < low_y ? edges->y[i] : low_y;
        high_y = edges->y[i] > high_y ? edges->y[i] : high_y;
    }
    low_x = (low_x >> 8) - tile->x;
    low_y = (low_y >> 8) - tile->y;
    high_x = (high_x >> 8) - tile->x + 1;
    high_y = (high_y >> 8) - tile->y + 1;
    *x0 = low_x < 0 ? 0 : (int)low_x;
    *y0 = low_y < 0 ? 0 : (int)low_y;
    *x1 = high_x > tile->width ? tile->width : (int)high_x;
    *y1 = high_y > tile->height ? tile->height : (int)high_y;
}

/* Returns how many samples the triangle covers, seen or not. */
static int draw_triangle(reference_tile *tile, const burnish_geometry *geometry,
                         uint32_t triangle) {
    int covered = 0;
    triangle_edges edges;
    load_edges(geometry, triangle, &edges);
    int x0, y0, x1, y1;
    pixel_bounds(&edges, tile, &x0, &y0, &x1, &y1);
    const int8_t(*offsets)[2] = burnish_sample_offsets(tile->samples);
    int64_t sample_step[3][BURNISH_MAX_SAMPLES];
    for (int i = 0; i < 3; ++i) {
        for (int s = 0; s < tile->samples; ++s) {
            sample_step[i][s] =
                SAMPLE_STEP * (edges.dx[i] * offsets[s][1] - edges.dy[i] * offsets[s][0]);
        }
    }
    const reference_plane plane = depth_plane(&edges, tile);
    float sample_depth[BURNISH_MAX_SAMPLES];
    for (int s = 0; s < tile->samples; ++s) {
        sample_depth[s] = (float)((plane.across * offsets[s][0] + plane.down * offsets[s][1]) / 16);
    }
    const int64_t half = BURNISH_SUBPIXELS / 2;
    for (int y = y0; y < y1; ++y) {
        int64_t at[3];
        for (int i = 0; i < 3; ++i) {
            at[i] = edge_at(&edges, i, (int64_t)(tile->x + x0) * BURNISH_SUBPIXELS + half,
                            (int64_t)(tile->y + y) * BURNISH_SUBPIXELS + half);
        }
        size_t entry = (size_t)(y * BURNISH_TILE_SIZE + x0) * (size_t)tile->samples;
        for (int x = x0; x < x1; ++x) {
            for (int s = 0; s < tile->samples; ++s, ++entry) {
                int64_t e0 = at[0] + sample_step[0][s];
                int64_t e1 = at[1] + sample_step[1][s];
                int64_t e2 = at[2] + sample_step[2][s];
                if (((e0 + edges.bias[0]) | (e1 + edges.bias[1]) | (e2 + edges.bias[2])) < 0) {
                    continue;
                }
                ++covered;
                float depth = depth_at(&edges, (float)e1 * edges.inverse_area,
                                       (float)e2 * edges.inverse_area);
                if (edges.is_large) {
                    depth = reference_plane_at(&plane, x, y);
                    depth = reference_clamp(&plane,
                                            tile->samples == 1 ? depth : depth + sample_depth[s]);
                }
                if (depth > tile->depths[entry]) {
                    tile->depths[entry] = depth;
                    tile->triangles[entry] = triangle;
                }
            }
            for (int i = 0; i < 3; ++i) {
                at[i] -= edges.dy[i] * BURNISH_SUBPIXELS;
            }
        }
    }
    return covered;
}

static void reference_tile_destroy(reference_tile *tile) {
    free(tile->triangles);
    free(tile->depths);
    memset(tile, 0, sizeof *tile);
}

static burnish_status reference_tile_create(reference_tile *tile, int samples,
                                            burnish_error *error) {
    memset(tile, 0, sizeof *tile);
    tile->samples = samples;
    size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)samples;
    burnish_memory memory = burnish_memory_of(NULL, error);
    tile->triangles = burnish_allocate(&memory, count, sizeof *tile->triangles, "a tile");
    tile->depths = burnish_allocate(&memory, count, sizeof *tile->depths, "a tile");
    const burnish_status status = memory.status;
    if (status != BURNISH_STATUS_OK) {
        reference_tile_destroy(tile);
    }
    return status;
}

/* Makes the tile (column, row) current and draws the triangles of some indices; 0 when there are
 * none. */
static int reference_draw_indices(reference_tile *tile, const burnish_raster_view *view,
                                  const burnish_geometry *geometry, int column, int row,
                                  const uint32_t *indices, size_t primitive_count) {
    tile->x = column * BURNISH_TILE_SIZE;
    tile->y = row * BURNISH_TILE_SIZE;
    int right = view->width - tile->x, below = view->height - tile->y;
    tile->width = right < BURNISH_TILE_SIZE ? right : BURNISH_TILE_SIZE;
    tile->height = below < BURNISH_TILE_SIZE ? below : BURNISH_TILE_SIZE;
    tile->next_place = 0;
    if (primitive_count == 0) {
        return 0;
    }
    size_t count = (size_t)BURNISH_TILE_PIXELS * (size_t)tile->samples;
    for (size_t i = 0; i < count; ++i) {
        tile->triangles[i] = REFERENCE_NO_TRIANGLE;
        tile->depths[i] = -1e30f;
    }
    for (size_t i = 0; i < primitive_count; ++i) {
        draw_triangle(tile, geometry, indices[i]);
    }
    return 1;
}

/* The indices in a tile's lists, which have room; returns how many. */
static size_t reference_read_lists(const burnish_bins *bins, int column, int row,
                                   uint32_t *indices) {
    size_t count = 0, more;
    for (int back = 0; back < 2; ++back) {
        burnish_list_reader reader = burnish_list_begin(bins, column, row, back);
        burnish_bin_entry part[BURNISH_CHUNK_ENTRIES];
        while ((more = burnish_list_read(&reader, part, BURNISH_CHUNK_ENTRIES)) > 0) {
            for (size_t i = 0; i < more * BURNISH_BATCH_SIZE; ++i) {
                const burnish_bin_entry entry = part[i / BURNISH_BATCH_SIZE];
                const uint32_t lane = i % BURNISH_BATCH_SIZE;
                if (entry.mask >> lane & 1) {
                    indices[count++] = entry.batch * BURNISH_BATCH_SIZE + lane;
                }
            }
        }
    }
    return count;
}

/* The same with the triangles of the tile's lists. */
static inline int reference_draw_tile(reference_tile *tile, const burnish_raster_view *view,
                                      const burnish_geometry *geometry, const burnish_bins *bins,
                                      int column, int row) {
    uint32_t *indices = malloc((reference_primitive_count(geometry) + 1) * sizeof *indices);
    const size_t count = reference_read_lists(bins, column, row, indices);
    const int drawn = reference_draw_indices(tile, view, geometry, column, row, indices, count);
    free(indices);
    return drawn;
}

/* Triangles that cover a sample of the current tile, (column, row), be it hidden, and are not in
 * its lists. Draws them into the tile. */
static inline int reference_draw_missing(reference_tile *tile, const burnish_geometry *geometry,
                                         const burnish_bins *bins, int column, int row) {
    const size_t primitives = reference_primitive_count(geometry);
    uint32_t *indices = malloc((primitives + 1) * sizeof *indices);
    uint8_t *is_listed = calloc(primitives + 1, 1);
    const size_t count = reference_read_lists(bins, column, row, indices);
    int missing = 0;
    for (size_t i = 0; i < count; ++i) {
        is_listed[indices[i]] = 1;
    }
    for (uint32_t i = 0; i < primitives; ++i) {
        if (!is_listed[i] && reference_side(geometry, i) >= 0) {
            missing += draw_triangle(tile, geometry, i) > 0;
        }
    }
    free(is_listed);
    free(indices);
    return missing;
}

/* The samples of a pixel that show a triangle: how many, and the sums of their offsets in 1/16
 * pixel. */
typedef struct sample_group {
    uint32_t triangle;
    int weight, sum_x, sum_y;
} sample_group;

static void append_fragment(const reference_tile *tile, const burnish_raster_view *view,
                            const burnish_geometry *geometry, int pixel, sample_group group,
                            burnish_fragments *fragments) {
    const uint32_t triangle = group.triangle;
    const int weight = group.weight;
    int dx = 0, dy = 0;
    if (weight < tile->samples) {
        dx = group.sum_x * SAMPLE_STEP / weight;
        dy = group.sum_y * SAMPLE_STEP / weight;
    }
    int pixel_x = tile->x + pixel % BURNISH_TILE_SIZE,
        pixel_y = tile->y + pixel / BURNISH_TILE_SIZE;
    int x = pixel_x * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2 + dx;
    int y = pixel_y * BURNISH_SUBPIXELS + BURNISH_SUBPIXELS / 2 + dy;
    triangle_edges edges;
    load_edges(geometry, triangle, &edges);
    float weight1 = (float)edge_at(&edges, 1, x, y) * edges.inverse_area;
    float weight2 = (float)edge_at(&edges, 2, x, y) * edges.inverse_area;
    int i = fragments->count++;
    fragments->pixels[i] =
        (uint16_t)burnish_pixel_index(pixel % BURNISH_TILE_SIZE, pixel / BURNISH_TILE_SIZE);
    fragments->weight[i] = (uint8_t)weight;
    fragments->primitives[i] = reference_corners(geometry, triangle);
    fragments->x[i] = (float)(x - view->width * (BURNISH_SUBPIXELS / 2)) / BURNISH_SUBPIXELS;
    fragments->y[i] = (float)(view->height * (BURNISH_SUBPIXELS / 2) - y) / BURNISH_SUBPIXELS;
    fragments->depth[i] = depth_at(&edges, weight1, weight2);
    if (weight == tile->samples && edges.is_large) {
        const reference_plane plane = depth_plane(&edges, tile);
        fragments->depth[i] =
            reference_clamp(&plane, reference_plane_at(&plane, pixel % BURNISH_TILE_SIZE,
                                                       pixel / BURNISH_TILE_SIZE));
    }
    fragments->weight1[i] = weight1;
    fragments->weight2[i] = weight2;
}

/* Groups a pixel's samples by triangle, in the order of each triangle's first sample. */
static void append_pixel(const reference_tile *tile, const burnish_raster_view *view,
                         const burnish_geometry *geometry, int pixel,
                         burnish_fragments *fragments) {
    const uint32_t *triangles = tile->triangles + (size_t)pixel * (size_t)tile->samples;
    const int8_t(*offsets)[2] = burnish_sample_offsets(tile->samples);
    unsigned taken = 0;
    for (int s = 0; s < tile->samples; ++s) {
        if ((taken >> s & 1) || triangles[s] == REFERENCE_NO_TRIANGLE) {
            continue;
        }
        sample_group group = {.triangle = triangles[s]};
        for (int other = s; other < tile->samples; ++other) {
            if (triangles[other] == triangles[s]) {
                taken |= 1u << other;
                group.weight += 1;
                group.sum_x += offsets[other][0];
                group.sum_y += offsets[other][1];
            }
        }
        append_fragment(tile, view, geometry, pixel, group, fragments);
    }
}

static inline int reference_next_fragments(reference_tile *tile, const burnish_raster_view *view,
                                           const burnish_geometry *geometry,
                                           burnish_fragments *fragments) {
    fragments->count = 0;
    while (tile->next_place < BURNISH_TILE_PIXELS &&
           fragments->count + tile->samples <= BURNISH_FRAGMENT_BATCH) {
        const int place = tile->next_place++;
        append_pixel(tile, view, geometry,
                     burnish_pixel_y(place) * BURNISH_TILE_SIZE + burnish_pixel_x(place),
                     fragments);
    }
    return fragments->count > 0;
}

#endif
