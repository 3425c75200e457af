/* A scene drawn by the fast renderer and by the reference: the same vertices, triangles and lists,
 * the same id and depth of every sample, the same visible points, the same colours, bit for bit.
 * Included by tests. */
#ifndef BURNISH_TEST_COMPARE_SCENE_H
#define BURNISH_TEST_COMPARE_SCENE_H

#include <stdint.h>

#include "raster/fragments.h"
#include "raster/raster_ops.h"
#include "reference_geometry.h"
#include "reference_tile.h"
#include "render/frame/surface.h"
#include "support.h"

enum { MOST_VERTICES = 1200, MOST_TRIANGLES = 400 };

typedef struct random_scene {
    float positions[3 * MOST_VERTICES], normals[3 * MOST_VERTICES];
    uint8_t colors[4 * MOST_VERTICES];
    uint32_t indices[3 * MOST_TRIANGLES];
    uint16_t materials[MOST_TRIANGLES];
    size_t vertex_count, triangle_count;
} random_scene;

static void add_vertex(random_scene *scene, const float p[3], uint64_t *state) {
    size_t i = scene->vertex_count++;
    for (int k = 0; k < 3; ++k) {
        scene->positions[3 * i + (size_t)k] = p[k];
        scene->normals[3 * i + (size_t)k] = test_uniform_float(state, -1, 1);
    }
    for (int k = 0; k < 4; ++k) {
        scene->colors[4 * i + (size_t)k] = (uint8_t)test_random32(state);
    }
}

/* One that this processor has. */
static burnish_isa pick_isa(uint64_t *state) {
    uint32_t isa;
    do {
        isa = test_random32(state) % BURNISH_ISA_COUNT;
    } while (!(burnish_isa_available() >> isa & 1));
    return (burnish_isa)isa;
}

/* The batches' triangle `index` against the plain one: 1 where they differ. */
static int differs(const burnish_raster_view *view, const burnish_geometry *geometry, size_t index,
                   const uint32_t *indices, size_t *visible) {
    const burnish_triangle_batch *batch = &geometry->batches[index / BURNISH_BATCH_SIZE];
    const size_t lane = index % BURNISH_BATCH_SIZE;
    burnish_screen_vertex v[3];
    reference_bounds made;
    int side = -1;
    for (size_t k = 0; k < 3; ++k) {
        v[k] = geometry->vertices.items[indices[k]];
    }
    if ((v[0].outcode | v[1].outcode | v[2].outcode) & BURNISH_OUT_CLIP ||
        !reference_cull(view, v, &made, &side)) {
        return reference_side(geometry, index) != -1;
    }
    *visible += 1;
    return side != reference_side(geometry, index) || made.nearest != batch->nearest[lane] ||
           made.first != batch->first[lane] || made.last != batch->last[lane];
}

/* Compares vertices and bounds with the reference, including vertices made by clipping; pictures
 * test the rest of clipping. */
static void check_geometry(const random_scene *scene, const burnish_raster_view *view,
                           const burnish_geometry *geometry, int number) {
    int wrong = 0;
    size_t visible = 0;
    for (size_t i = 0; i < scene->vertex_count; ++i) {
        float inverse_w;
        burnish_screen_vertex v = reference_vertex(view, scene->positions + 3 * i, &inverse_w);
        wrong += memcmp(&v, &geometry->vertices.items[i], sizeof v) != 0;
        wrong += inverse_w != geometry->vertices.inverse_w[i];
    }
    CHECK(wrong == 0, "scene %d: %d vertices differ", number, wrong);
    for (size_t i = 0; i < scene->triangle_count; ++i) {
        wrong += differs(view, geometry, i, scene->indices + 3 * i, &visible);
    }
    for (size_t i = 0; i < geometry->clipped_count; ++i) {
        wrong += differs(view, geometry, geometry->mesh_batches * BURNISH_BATCH_SIZE + i,
                         geometry->clipped_indices + 3 * i, &visible);
    }
    wrong += visible != geometry->triangle_count;
    CHECK(wrong == 0, "scene %d: %d triangles differ", number, wrong);
}

static int same_corners(const burnish_primitive *a, const burnish_primitive *b) {
    return memcmp(a, b, sizeof *a) == 0;
}

/* The id of a sample in the fast tile: its corners' source, and with several samples its
 * corners; 0 when it is not the expected triangle. */
static int same_owner(const burnish_tile *fast, const burnish_geometry *geometry, int place, int s,
                      uint32_t triangle) {
    const int samples = fast->options.samples, at = burnish_sample_index(samples, place, s);
    const int is_none = fast->buffer.depths[at] == -1e30f;
    if (triangle == REFERENCE_NO_TRIANGLE || is_none) {
        return triangle == REFERENCE_NO_TRIANGLE && is_none &&
               (samples == 1 || fast->buffer.ids[at] == -1);
    }
    const burnish_primitive corners = reference_corners(geometry, triangle);
    return samples == 1
               ? (uint32_t)fast->buffer.ids[at] == corners.id_and_facing
               : same_corners(&fast->primitives.primitives[fast->buffer.ids[at]], &corners);
}

/* Samples of the tile whose ids or depths differ. */
static int compare_owners(const reference_tile *tile, const burnish_tile *fast,
                          const burnish_geometry *geometry) {
    int wrong = 0;
    for (int y = 0; y < tile->height; ++y) {
        for (int x = 0; x < tile->width; ++x) {
            const int pixel = y * BURNISH_TILE_SIZE + x, place = burnish_pixel_index(x, y);
            for (int s = 0; s < tile->samples; ++s) {
                const int entry = pixel * tile->samples + s;
                wrong += !same_owner(fast, geometry, place, s, tile->triangles[entry]);
                wrong += tile->depths[entry] !=
                         fast->buffer.depths[burnish_sample_index(tile->samples, place, s)];
            }
        }
    }
    return wrong;
}

/* A visible point by the reference, with its colour. */
typedef struct point {
    int place, weight, number;
    burnish_primitive corners;
    float x, y, depth, weights[2], color[3];
} point;

static point take_point(const burnish_fragments *fragments, const float *const rgb[3], int i) {
    point made;
    memset(&made, 0, sizeof made);
    made.place = fragments->pixels[i];
    made.weight = fragments->weight[i];
    made.corners = fragments->primitives[i];
    made.x = fragments->x[i];
    made.y = fragments->y[i];
    made.depth = fragments->depth[i];
    made.weights[0] = fragments->weight1[i];
    made.weights[1] = fragments->weight2[i];
    for (int k = 0; k < 3; ++k) {
        made.color[k] = rgb[k][i];
    }
    return made;
}

static int compare_places(const void *a, const void *b) {
    const point *first = a, *second = b;
    return first->place != second->place ? first->place - second->place
                                         : first->number - second->number;
}

/* Depth and attributes of a simple pixel by the fast renderer. */
static int same_whole(const burnish_tile *fast, const burnish_row_light *row,
                      const point *expected) {
    const int i = expected->place % BURNISH_BLOCK_ROW_PIXELS;
    if (row->pixels.simple[i] < 0) {
        return 0;
    }
    const float got[4] = {fast->buffer.center_depths[expected->place], row->rgb[0][i],
                          row->rgb[1][i], row->rgb[2][i]};
    const float want[4] = {expected->depth, expected->color[0], expected->color[1],
                           expected->color[2]};
    return memcmp(got, want, sizeof got) == 0 &&
           burnish_tile_id_and_facing(fast, expected->place / BURNISH_BLOCK_ROW_PIXELS, i,
                                      row->pixels.simple[i]) == expected->corners.id_and_facing;
}

/* What a corner of the reference's fragment carries: attributes of its vertex or, in a pixel that
 * a large triangle has alone, what its planes are at the pixel's centre: then it returns 1. */
static int take_corners(const reference_tile *tile, const burnish_geometry *geometry,
                        const burnish_attributes *from, const burnish_fragments *fragments, int i,
                        burnish_float4 normals[3], burnish_float4 colors[3]) {
    const burnish_primitive *corners = &fragments->primitives[i];
    const int x = burnish_pixel_x(fragments->pixels[i]), y = burnish_pixel_y(fragments->pixels[i]);
    triangle_edges edges;
    load_corners(geometry, corners, &edges);
    for (int corner = 0; corner < 3; ++corner) {
        normals[corner] = from->normals[corners->vertices[corner]];
        colors[corner] = from->has_colors ? from->colors[corners->vertices[corner]] : normals[0];
    }
    if (!edges.is_large || fragments->weight[i] < tile->samples) {
        return 0;
    }
    for (int k = 0; k < 8; ++k) {
        burnish_float4 *values = k < 4 ? normals : colors;
        const double value = values[0][k % 4];
        const reference_plane plane = reference_make_plane(
            &edges, tile, value, values[1][k % 4] - value, values[2][k % 4] - value);
        for (int corner = 0; corner < 3; ++corner) {
            values[corner][k % 4] = reference_attribute_at(&plane, x, y);
        }
    }
    return 1;
}

/* Shades the reference's fragments, each with corners of its own. */
static void shade_reference(const reference_tile *tile, const burnish_geometry *geometry,
                            const burnish_surface *surface, const burnish_fragments *fragments,
                            burnish_fragment_scratch *scratch, float *const rgb[3]) {
    static burnish_fragments own;
    static burnish_float4 normals[3 * BURNISH_FRAGMENT_BATCH], colors[3 * BURNISH_FRAGMENT_BATCH];
    const burnish_attributes attributes = {
        .normals = normals, .colors = colors, .has_colors = surface->attributes->has_colors};
    burnish_surface with_own = *surface;
    with_own.attributes = &attributes;
    own = *fragments;
    for (int i = 0; i < own.count; ++i) {
        const uint32_t first = 3 * (uint32_t)i;
        const int is_plane = take_corners(tile, geometry, surface->attributes, fragments, i,
                                          normals + first, colors + first);
        for (uint32_t k = 0; k < 3; ++k) {
            own.primitives[i].vertices[k] = first + k;
        }
        if (is_plane) { /* values do not change */
            own.weight1[i] = own.weight2[i] = 0;
        }
    }
    burnish_shade_fragments(&with_own, NULL, &own, scratch, rgb);
}

/* All points of a tile by both paths; *points counts them. */
static int compare_points(reference_tile *tile, burnish_tile *fast, const burnish_raster_ops *ops,
                          const burnish_raster_view *view, const burnish_geometry *geometry,
                          const burnish_surface *surface, int *points) {
    static point expected[BURNISH_TILE_PIXELS * BURNISH_MAX_SAMPLES];
    static burnish_fragments fragments;
    static burnish_fragment_scratch scratch;
    static burnish_row_light light;
    static float colors[3][BURNISH_SHADE_BATCH];
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    int count = 0, wrong = 0, at = 0, known = -1;
    while (reference_next_fragments(tile, view, geometry, &fragments)) {
        shade_reference(tile, geometry, surface, &fragments, &scratch, rgb);
        for (int i = 0; i < fragments.count; ++i) {
            expected[count++] = take_point(&fragments, (const float *const *)rgb, i);
        }
    }
    *points += count;
    for (int i = 0; i < count; ++i) { /* whole pixels, a strip after another */
        const int number = expected[i].place / BURNISH_BLOCK_ROW_PIXELS;
        if (number != known) {
            ops->classify_block_row(fast, number, &light.pixels);
            burnish_shade_block_row(surface, fast, number, &scratch, &light);
            known = number;
        }
        wrong += expected[i].weight == tile->samples && !same_whole(fast, &light, &expected[i]);
    }
    static point got[BURNISH_TILE_PIXELS * BURNISH_MAX_SAMPLES];
    int got_count = 0;
    int next_block = 0;
    while (ops->next_fragments(fast, view, &next_block, &fragments)) {
        burnish_shade_fragments(surface, fast, &fragments, &scratch, rgb);
        for (int i = 0; i < fragments.count; ++i) {
            got[got_count] = take_point(&fragments, (const float *const *)rgb, i);
            got[got_count].number = got_count;
            ++got_count;
        }
    }
    /* the order of a pixel's fragments matters, the order of pixels does not */
    qsort(got, (size_t)got_count, sizeof *got, compare_places);
    for (int i = 0; i < got_count; ++i, ++at) {
        while (at < count && expected[at].weight == tile->samples) {
            ++at;
        }
        got[i].number = 0;
        wrong += at >= count || memcmp(&got[i], &expected[at], sizeof *got) != 0;
    }
    while (at < count && expected[at].weight == tile->samples) {
        ++at;
    }
    return wrong + (at != count);
}

/* Shaders and lights of a scene; kept between scenes, as in a renderer. */
typedef struct scene_shading {
    burnish_attributes attributes;
    burnish_kernels_shader shaders[3];
    burnish_light_constants lights[3];
    burnish_shading shading;
    burnish_surface surface;
} scene_shading;

static void make_shading(scene_shading *made, const random_scene *scene,
                         const burnish_raster_view *view, const burnish_geometry *geometry,
                         uint64_t *state) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    lighting.local_viewer = (int)(test_random32(state) & 1);
    lighting.viewer[2] = lighting.local_viewer ? 0 : 1;
    lighting.lobe.kind = test_random32(state) % 4 == 0 ? BURNISH_LOBE_LYON : BURNISH_LOBE_FAMILY;
    for (int i = 0; i < 3; ++i) {
        burnish_material material = {.exponent = 32};
        material.diffuse[i] = 0.75f;
        material.specular[2 - i] = 0.5f;
        CHECK1(burnish_shader_fold(&lighting, &material, &lighting.lobe, &made->lights[i],
                                   &made->shaders[i], NULL) == BURNISH_STATUS_OK);
    }
    made->shading =
        (burnish_shading){.kernels = burnish_kernels_best(),
                          .ops = burnish_render_ops_for(burnish_kernels_get_isa(NULL)),
                          .shaders = made->shaders,
                          .rays = {.ray = {0, 0, -1},
                                   .ray_x = {0.01f, 0, 0},
                                   .ray_y = {0, 0.01f, 0},
                                   .q_per_depth = 0x1p14f},
                          .needs_position = 1, /* the reference always gives positions */
                          .is_lyon = lighting.lobe.kind == BURNISH_LOBE_LYON};
    made->surface.view = view;
    made->surface.shading = &made->shading;
    made->surface.attributes = &made->attributes;
    made->surface.triangle_count = scene->triangle_count;
    made->surface.triangle_materials = test_random32(state) & 1 ? scene->materials : NULL;
    const burnish_mesh_view mesh = {
        .normals = scene->normals, .colors = scene->colors, .indices = scene->indices};
    CHECK1(burnish_attributes_update(&made->attributes, geometry, &mesh,
                                     (int)(test_random32(state) & 1), NULL,
                                     &memory) == BURNISH_STATUS_OK);
}

/* Draws a scene both ways with a random instruction set. wanted: which tiles are compared, one item
 * per tile, row after row; NULL for all of them. *points counts what is seen. */
static inline void compare_scene(const random_scene *scene, const burnish_raster_view *view,
                                 int number, const uint8_t *wanted, uint64_t *state, int *points) {
    const int samples = view->samples;
    static burnish_geometry geometry; /* kept, as a renderer keeps them */
    static scene_shading shading;
    static burnish_bins bins;
    reference_tile tile;
    burnish_tile fast;
    const burnish_raster_ops *ops = burnish_raster_ops_for(pick_isa(state));
    const burnish_triangles triangles = {
        scene->positions, scene->vertex_count, scene->indices, scene->triangle_count, NULL, 0};
    burnish_geometry_update(&geometry, ops, view, &triangles, NULL, NULL);
    check_geometry(scene, view, &geometry, number);
    make_shading(&shading, scene, view, &geometry, state);
    reference_tile_create(&tile, samples, NULL);
    const burnish_tile_options options = {.samples = samples,
                                          .planes = burnish_surface_planes(&shading.surface),
                                          .keep_ids = 1,
                                          .needs_position = 1};
    burnish_tile_create(&fast, &options, NULL, NULL);
    fast.attributes[0] = shading.attributes.normals;
    fast.attributes[1] = shading.attributes.colors;
    if (samples > 1 && test_random32(state) % 4 == 0) { /* forget triangles often */
        size_t least = 2 * (size_t)BURNISH_TILE_PIXELS * (size_t)samples; /* own at most half */
        fast.primitives.capacity =
            least < fast.primitives.capacity ? least : fast.primitives.capacity;
    }
    static const size_t budgets[] = {1, 200, (size_t)1 << 25}; /* lists of few rows, or of all */
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, 1 + (int)(test_random32(state) % 3));
    burnish_bins_begin(&bins, NULL);
    bins.entry_budget = budgets[test_random32(state) % 3];
    do {
        CHECK1(burnish_bin_tiles(&bins, ops, &geometry, view, &tasks, NULL) == BURNISH_STATUS_OK);
        for (int row = bins.first_row; row < bins.end_row; ++row) {
            for (int column = 0; column < bins.columns; ++column) {
                if (wanted && !wanted[row * bins.columns + column]) {
                    continue;
                }
                int drawn = reference_draw_tile(&tile, view, &geometry, &bins, column, row);
                const int missing = reference_draw_missing(&tile, &geometry, &bins, column, row);
                CHECK(missing == 0, "scene %d, %d samples, tile %d,%d: %d triangles are not listed",
                      number, samples, column, row, missing);
                int wrong =
                    burnish_tile_draw(&fast, ops, view, &geometry, &bins, column, row) != drawn;
                if (drawn && !wrong) {
                    wrong = compare_owners(&tile, &fast, &geometry);
                    CHECK(wrong == 0, "scene %d, %d samples, tile %d,%d: %d ids differ", number,
                          samples, column, row, wrong);
                    wrong = compare_points(&tile, &fast, ops, view, &geometry, &shading.surface,
                                           points);
                }
                CHECK(wrong == 0, "scene %d, %d samples, tile %d,%d: points or colours differ",
                      number, samples, column, row);
            }
        }
    } while (bins.end_row < bins.rows);
    burnish_tile_destroy(&fast);
    reference_tile_destroy(&tile);
}

#endif
