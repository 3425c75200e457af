/* The depth maps of ambient occlusion: their directions, and when they are drawn. */
#include "render/light/maps/occlusion.h"

#include <string.h>

#include "render/space.h"

/* Edge of the cells in which vertices become one, in texels. Against ray casting, the error grows by
 * 0.6 %, by 2.2 % with cells of a texel. */
#define CLUSTER 0.75

/* How far points are moved off the surface, in texels: less makes a curved surface hide itself,
 * more opens creases. */
#define OFFSET 0.75

/* The filter's radius in cones of a direction, which are circles of as large a part of the sky; its
 * limits, in texels and in the raster's space. */
#define CONE 0.65
#define LEAST_RADIUS 0.75f
#define MOST_RADIUS 0.15

/* Neighbouring points share look-ups within so many texels. */
#define REACH 1.5
#define SQRT2 1.4142135623730951

/* Pixels along the picture's shorter edge: smaller maps suffice below, more directions are needed
 * from there on. */
enum { SMALL_SIDE = 384, LARGE_SIDE = 600 };

/* No direction's weight is less than this share of the mean: a point that faces none of the light is
 * neither dark nor lit. */
#define LEAST_WEIGHT 0.03125

/* The upper half of a spherical Fibonacci set, each point with the one across. A point of the mesh
 * faces one of the two, so that both need one look-up, and both maps are drawn at once; the error
 * of integrals over a hemisphere is that of a whole Fibonacci set of 8/9 as many. */
burnish_map_view burnish_occlusion_view(int i, int count, int size) {
    const double golden_angle = 2.39996322972865332;
    const int pair = i / 2;
    const double z = 1 - (2.0 * pair + 1) / count, radius = burnish_sqrt(1 - z * z);
    double sine, cosine;
    burnish_sincos(golden_angle * pair, &sine, &cosine);
    const burnish_map_view view =
        burnish_map_view_make((burnish_vec3){radius * cosine, radius * sine, z},
                              (burnish_vec3){-sine, cosine, 0}, /* no point is a pole */
                              size);
    return i % 2 ? burnish_map_view_back(view) : view;
}

/* As many directions as do not show as silhouettes on large flat faces, which meshes of few
 * triangles have, and as few as do not take too long where a mesh is large: those are rough. Deep
 * places of large pictures need more. In small pictures silhouettes are not wider than the maps'
 * filters, and 48 directions have the error of 54 or, on average, of 72. */
static int choose_count(const burnish_mesh_view *mesh, int side) {
    static const struct {
        size_t triangles;
        int counts[3]; /* of small, medium, and large pictures */
    } steps[] = {{8192, {48, 72, 72}},
                 {65536, {48, 54, 54}},
                 {262144, {36, 36, 54}},
                 {1048576, {28, 28, 36}},
                 {SIZE_MAX, {18, 18, 18}}};
    int i = 0;
    while (burnish_drawn_count(mesh) > steps[i].triangles) {
        ++i;
    }
    const int count = steps[i].counts[(side >= SMALL_SIDE) + (side >= LARGE_SIDE)];
    return mesh->point_radius > 0 && count < 36 ? 36 : count; /* points are rough, too */
}

/* Numbers of a map and its blockers. */
static size_t map_texels(int size) {
    const size_t edge = (size_t)size, cells = edge / BURNISH_OCCLUSION_CELL;
    return edge * edge + 2 * cells * cells;
}

/* Writes after a map's depths the largest of each cell, then of each 2 x 2 cells; the last row and
 * column are 0. */
static void find_blockers(uint16_t *depths, size_t size) {
    const size_t cells = size / BURNISH_OCCLUSION_CELL;
    uint16_t *blockers = depths + size * size, *quads = blockers + cells * cells;
    for (size_t y = 0; y < cells; ++y) {
        uint16_t columns[BURNISH_OCCLUSION_LARGE] = {0};
        for (int i = 0; i < BURNISH_OCCLUSION_CELL; ++i, depths += size) {
            for (size_t x = 0; x < size; ++x) {
                columns[x] = depths[x] > columns[x] ? depths[x] : columns[x];
            }
        }
        for (size_t cell = 0; cell < cells; ++cell) {
            const uint16_t *from = columns + cell * BURNISH_OCCLUSION_CELL;
            uint16_t largest = 0;
            for (int x = 0; x < BURNISH_OCCLUSION_CELL; ++x) {
                largest = from[x] > largest ? from[x] : largest;
            }
            blockers[y * cells + cell] = largest;
        }
    }
    memset(quads, 0, cells * cells * sizeof *quads);
    for (size_t y = 0; y + 1 < cells; ++y) {
        for (size_t x = 0; x + 1 < cells; ++x) {
            const uint16_t *at = blockers + y * cells + x;
            const uint16_t upper = at[0] > at[1] ? at[0] : at[1];
            const uint16_t lower = at[cells] > at[cells + 1] ? at[cells] : at[cells + 1];
            quads[y * cells + x] = upper > lower ? upper : lower;
        }
    }
}

const uint16_t *burnish_occlusion_depths(const burnish_occlusion *occlusion, int i) {
    return occlusion->depths + (size_t)i * map_texels(occlusion->size);
}

static burnish_status draw_maps(burnish_occlusion *occlusion, const burnish_mesh_view *mesh,
                                int count, int size, burnish_tasks *tasks, burnish_memory *memory) {
    const size_t texels = map_texels(size);
    burnish_mesh_view coarse = *mesh;
    occlusion->mesh = 0;
    occlusion->depths =
        burnish_reserve_discard(memory, occlusion->depths, &occlusion->capacity,
                                (size_t)count * texels, sizeof *occlusion->depths, "depth maps");
    burnish_map_view views[BURNISH_MAP_PAIRS];
    burnish_status status = memory->status;
    for (int i = 0; i < count / 2; ++i) {
        views[i] = burnish_occlusion_view(2 * i, count, size);
    }
    if (status == BURNISH_STATUS_OK && mesh->point_radius == 0) {
        status = burnish_clusters_make(&occlusion->clusters, mesh, CLUSTER / views->texels,
                                       occlusion->drawer.transparent, memory, &coarse);
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_map_pairs pairs = {views, count / 2, occlusion->depths, texels,
                                         find_blockers};
        status = burnish_map_pairs_draw(&occlusion->drawer, &coarse, &pairs, tasks, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        occlusion->mesh = mesh->serial;
        occlusion->max_overdraw = occlusion->drawer.max_overdraw;
        occlusion->count = count;
        occlusion->size = size;
    }
    return status;
}

burnish_status burnish_occlusion_update(burnish_occlusion *occlusion, const burnish_mesh_view *mesh,
                                        const burnish_occlusion_options *options,
                                        burnish_tasks *tasks, burnish_memory *memory,
                                        burnish_occlusion_lookup *lookup) {
    const int count = options->count == BURNISH_OCCLUSION_AUTO
                          ? choose_count(mesh, options->side)
                          : options->count + options->count % 2;
    const int size = options->side < SMALL_SIDE ? BURNISH_OCCLUSION_SMALL : BURNISH_OCCLUSION_LARGE;
    double texels = 1, plane = 0;
    if (occlusion->mesh != mesh->serial || occlusion->count != count || occlusion->size != size ||
        occlusion->max_overdraw > occlusion->drawer.max_overdraw) {
        burnish_status status = draw_maps(occlusion, mesh, count, size, tasks, memory);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    for (int i = 0; i < count / 2; ++i) {
        const burnish_map_view view = burnish_occlusion_view(2 * i, count, size);
        burnish_occlusion_pair *pair = &occlusion->pairs[i];
        texels = view.texels;
        plane = burnish_map_plane(&view);
        pair->map = burnish_map_rows_make(&view, options->eye);
        burnish_space_store(view.toward, pair->toward);
        pair->weight[0] = pair->weight[1] = 1;
        pair->depths = burnish_occlusion_depths(occlusion, 2 * i);
        pair->blockers = pair->depths + (size_t)size * (size_t)size;
    }
    lookup->count = count / 2;
    lookup->size = size;
    lookup->pairs = occlusion->pairs;
    lookup->back = (int32_t)map_texels(size);
    lookup->offset = (float)(OFFSET / texels);
    lookup->slope = (float)(BURNISH_MAP_RANGE * texels / BURNISH_MAP_CODES);
    lookup->plane = (float)plane;
    lookup->cone =
        (float)(CONE * burnish_sqrt(4.0 / count) * texels * BURNISH_MAP_RANGE / BURNISH_MAP_CODES);
    lookup->least_radius = LEAST_RADIUS;
    lookup->most_radius = (float)(MOST_RADIUS * texels);
    lookup->reach = (float)(REACH / texels);
    lookup->share =
        mesh->point_radius == 0 && options->pixel > 0 && 4 * SQRT2 * options->pixel * texels < REACH
            ? 4
            : 2;
    return BURNISH_STATUS_OK;
}

void burnish_occlusion_weigh(burnish_occlusion *occlusion, const float *light) {
    double sum = 0;
    for (int i = 0; i < occlusion->count; ++i) {
        sum += (double)light[i];
    }
    for (int i = 0; i < occlusion->count && sum > 0; ++i) {
        const double weight = (double)light[i] * occlusion->count / sum;
        occlusion->pairs[i / 2].weight[i % 2] =
            (float)(weight > LEAST_WEIGHT ? weight : LEAST_WEIGHT);
    }
}

void burnish_occlusion_destroy(burnish_occlusion *occlusion, const burnish_context *context) {
    burnish_map_drawer_destroy(&occlusion->drawer, context);
    burnish_clusters_destroy(&occlusion->clusters, context);
    burnish_release(context, occlusion->depths);
    memset(occlusion, 0, sizeof *occlusion);
}
