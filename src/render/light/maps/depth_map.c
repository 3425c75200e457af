#include "render/light/maps/depth_map.h"

#include <stdatomic.h>
#include <string.h>

#include "core/vec3.h"
#include "raster/maps.h"
#include "raster/raster_ops.h"
#include "render/space.h"

/* Distance from which maps are drawn: the range extends as far beyond the unit sphere as in front
 * of it.
 */
#define DISTANCE (BURNISH_MAP_RANGE / 2)

/* ---- Views ---- */

burnish_map_view burnish_map_view_make(burnish_vec3 toward, burnish_vec3 right, int size) {
    return (burnish_map_view){.toward = toward,
                              .right = right,
                              .up = burnish_vec3_cross(toward, right),
                              .size = size,
                              .texels = (size - 4) * 0.5};
}

static void store_row(burnish_vec3 axis, double factor, double constant, float row[4]) {
    burnish_space_store(burnish_vec3_scale(axis, factor), row);
    row[3] = (float)constant;
}

/* The same for points that count from the eye. */
static void move_row(float row[4], const double eye[3]) {
    row[3] = (float)((double)row[3] + (double)row[0] * eye[0] + (double)row[1] * eye[1] +
                     (double)row[2] * eye[2]);
}

burnish_map_rows burnish_map_rows_make(const burnish_map_view *view, const double eye[3]) {
    const double middle = view->size * 0.5 - 0.5;
    burnish_map_rows rows;
    store_row(view->right, view->texels, middle, rows.column);
    store_row(view->up, -view->texels, middle, rows.row);
    store_row(view->toward, BURNISH_MAP_CODES / BURNISH_MAP_RANGE,
              BURNISH_MAP_CODES * (1 - DISTANCE / BURNISH_MAP_RANGE), rows.depth);
    move_row(rows.column, eye);
    move_row(rows.row, eye);
    move_row(rows.depth, eye);
    return rows;
}

static burnish_raster_view raster_view(const burnish_map_view *view,
                                       const burnish_mesh_view *mesh) {
    const double scale = burnish_space_scale(mesh);
    burnish_raster_view raster = {.width = view->size, .height = view->size, .samples = 1};
    burnish_space_store(burnish_space_center(mesh), raster.origin);
    store_row(view->right, view->texels * scale, 0, raster.rows[0]);
    store_row(view->up, view->texels * scale, 0, raster.rows[1]);
    store_row(view->toward, scale / BURNISH_MAP_RANGE, 1 - DISTANCE / BURNISH_MAP_RANGE,
              raster.rows[2]);
    raster.rows[3][3] = 1;
    return raster;
}

/* ---- Tiles ---- */

/* What the tasks of a map share. */
typedef struct map_context {
    burnish_map_drawer *drawer;
    const burnish_raster_view *view;
    uint16_t *depths;
} map_context;

/* Depths are below 0 where nothing is. They are compared by their bits, which have the same order
 * from 0 on: whole numbers let compilers use vectors. */
static uint16_t code_of_depth(float depth) {
    int32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    bits = bits > 0 ? bits : 0;
    memcpy(&depth, &bits, sizeof depth);
    return (uint16_t)(int32_t)(depth * (float)BURNISH_MAP_CODES + 0.5f);
}

static void store_tile(const burnish_tile *tile, uint16_t *depths, size_t size) {
    uint16_t codes[BURNISH_TILE_PIXELS];
    for (int i = 0; i < BURNISH_TILE_PIXELS; ++i) {
        codes[i] = code_of_depth(tile->buffer.depths[i]);
    }
    for (int y = 0; y < tile->height; ++y) {
        uint16_t *to = depths + (size_t)(tile->y + y) * size + tile->x;
        for (int x = 0; x < tile->width; x += BURNISH_BLOCK_SIZE) {
            memcpy(to + x, codes + burnish_pixel_index(x, y), BURNISH_BLOCK_SIZE * sizeof *to);
        }
    }
}

static void clear_tile(const burnish_tile *tile, uint16_t *depths, size_t size) {
    for (int y = 0; y < tile->height; ++y) {
        memset(depths + (size_t)(tile->y + y) * size + tile->x, 0,
               (size_t)tile->width * sizeof *depths);
    }
}

static void draw_tile(void *context, int column, int row, int thread) {
    const map_context *map = context;
    const burnish_map_drawer *drawer = map->drawer;
    const size_t size = (size_t)map->view->width;
    burnish_tile *tile = &drawer->tiles[thread];
    if (burnish_tile_draw(tile, drawer->ops, map->view, &drawer->geometry, &drawer->bins, column,
                          row)) {
        store_tile(tile, map->depths, size);
    } else {
        clear_tile(tile, map->depths, size);
    }
}

static void destroy_tiles(burnish_map_drawer *drawer, const burnish_context *context) {
    for (int i = 0; i < drawer->tile_count; ++i) {
        burnish_tile_destroy(&drawer->tiles[i]);
    }
    burnish_release(context, drawer->tiles);
    drawer->tiles = NULL;
    drawer->tile_count = 0;
}

static burnish_status prepare_tiles(burnish_map_drawer *drawer, int threads,
                                    burnish_memory *memory) {
    static const burnish_tile_options depth_only = {.samples = 1};
    if (drawer->tile_count == threads) {
        return BURNISH_STATUS_OK;
    }
    destroy_tiles(drawer, memory->context);
    drawer->tiles =
        burnish_allocate_zeroed(memory, (size_t)threads, sizeof *drawer->tiles, "tiles");
    drawer->tile_count = drawer->tiles ? threads : 0;
    burnish_status status = memory->status;
    for (int i = 0; i < drawer->tile_count && status == BURNISH_STATUS_OK; ++i) {
        status =
            burnish_tile_create(&drawer->tiles[i], &depth_only, memory->context, memory->error);
    }
    if (status != BURNISH_STATUS_OK) {
        destroy_tiles(drawer, memory->context); /* no later map takes a half-made one */
    }
    return status;
}

/* ---- Maps ---- */

/* Maps have few texels and hold nothing but depth, so they may be covered more often, small ones as
 * many times more: bundles of tubes, whose hidden long triangles HiZ rejects, reach 1500 in maps of
 * 256 x 256 texels, 3000 in smaller ones, and take 0.1 s. */
static double overdraw_limit(const burnish_map_drawer *drawer, const burnish_raster_view *view) {
    enum { FACTOR = 2, LEAST_AREA = 256 * 256 };
    return burnish_overdraw_limit(view, FACTOR * drawer->max_overdraw, LEAST_AREA);
}

static burnish_status check_overdraw(const burnish_map_drawer *drawer,
                                     const burnish_raster_view *view, uint64_t cells,
                                     burnish_memory *memory) {
    return burnish_check_overdraw(burnish_overdraw(cells, view), overdraw_limit(drawer, view),
                                  "a depth map (ambient occlusion, ground, shadow)", memory->error);
}

burnish_status burnish_map_draw(burnish_map_drawer *drawer, const burnish_mesh_view *mesh,
                                const burnish_map_view *view, uint16_t *depths,
                                burnish_tasks *tasks, burnish_memory *memory) {
    const burnish_triangles triangles = {
        mesh->positions,   mesh->vertex_count, mesh->indices, burnish_drawn_count(mesh), NULL,
        mesh->point_radius};
    const burnish_raster_view raster = raster_view(view, mesh);
    map_context map = {drawer, &raster, depths};
    burnish_status status = prepare_tiles(drawer, burnish_tasks_threads(tasks), memory);
    for (int i = 0; i < drawer->tile_count; ++i) {
        drawer->tiles[i].transparent = drawer->transparent;
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_geometry_update(&drawer->geometry, drawer->ops, &raster, &triangles, tasks,
                                         memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_overdraw(drawer, &raster, drawer->geometry.cells, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_bands bands = {&drawer->bins, drawer->ops,        &drawer->geometry, &raster,
                                     tasks,         drawer->tile_count, memory->context};
        status = burnish_bands_draw(&bands, draw_tile, &map, memory->error);
    }
    return status;
}

/* ---- Point clouds ---- */

/* Radius of a disc, in texels, from which on every point is drawn: 11 of smaller ones, which are as
 * dense as points.c makes them, are in each texel, so all but 1 in 60,000 texels get one. At least
 * so many points per texel of the map are drawn, for other sizes. */
#define LEAST_RADIUS 0.5
enum { LEAST_POINTS = 16 };

static inline void raise_code(uint16_t *to, uint16_t from) {
    *to = from > *to ? from : *to;
}

/* One in so many points is drawn. */
static size_t choose_step(size_t count, int size, float radius) {
    const double share = LEAST_RADIUS / (double)radius,
                 most = (double)count / (LEAST_POINTS * (double)size * (double)size);
    const double step = share * share < most ? share * share : most;
    return step < 2 ? 1 : (size_t)step;
}

/* One texel of both maps per point. */
static void draw_middles(const burnish_mesh_view *mesh, const burnish_raster_view *view, int size,
                         float radius, uint16_t *const depths[2]) {
    const float middle = (float)size * 0.5f, most = (float)(size / 2 - 1) - radius;
    const size_t step = choose_step(mesh->vertex_count, size, radius);
    for (size_t point = 0; point < mesh->vertex_count; point += step) {
        const float *p = mesh->positions + 3 * point;
        const float d[3] = {p[0] - view->origin[0], p[1] - view->origin[1], p[2] - view->origin[2]};
        float at[3];
        for (int k = 0; k < 3; ++k) {
            const float *r = view->rows[k];
            at[k] = ((r[0] * d[0] + r[1] * d[1]) + r[2] * d[2]) + r[3];
        }
        if (at[0] > -most && at[0] < most && at[1] > -most && at[1] < most && at[2] > 0 &&
            at[2] < 1) {
            const int texel = (int)(middle - at[1]) * size + (int)(middle + at[0]);
            const int code = (int)(at[2] * (float)BURNISH_MAP_CODES + 0.5f);
            raise_code(&depths[0][texel], (uint16_t)code);
            raise_code(&depths[1][texel], (uint16_t)((int)BURNISH_MAP_CODES - code));
        }
    }
}

/* The maximum of each texel and the `reach` next ones and those before, along columns. Twice as many
 * are joined by each step. */
static void widen_columns(uint16_t *depths, size_t size, size_t reach) {
    for (size_t done = 0, step; done < reach; done += step) {
        step = done + 1 < reach - done ? done + 1 : reach - done;
        for (size_t i = 0; i < (size - step) * size; ++i) {
            raise_code(&depths[i], depths[i + step * size]);
        }
    }
    for (size_t done = 0, step; done < reach; done += step) {
        step = done + 1 < reach - done ? done + 1 : reach - done;
        for (size_t y = size - 1; y >= step; --y) {
            for (size_t x = 0; x < size; ++x) {
                raise_code(&depths[y * size + x], depths[(y - step) * size + x]);
            }
        }
    }
}

static void widen_rows(uint16_t *depths, size_t size, size_t reach) {
    for (size_t y = 0; y < size; ++y, depths += size) {
        for (size_t done = 0, step; done < reach; done += step) {
            step = done + 1 < reach - done ? done + 1 : reach - done;
            for (size_t x = 0; x + step < size; ++x) {
                raise_code(&depths[x], depths[x + step]);
            }
        }
        for (size_t done = 0, step; done < reach; done += step) {
            step = done + 1 < reach - done ? done + 1 : reach - done;
            for (size_t x = size - 1; x >= step; --x) {
                raise_code(&depths[x], depths[x - step]);
            }
        }
    }
}

/* Draws a cloud into a pair of square maps, along and against a direction: each point as a square
 * about as wide as its disc. Points outside, or so near the edge that they would be cut, are left
 * out. Of points much smaller than a texel, only as many are drawn as fill the map.
 *   view    orthographic, from the middle of the maps
 *   depths  size x size each, all 0 */
static void draw_cloud(const burnish_mesh_view *mesh, const burnish_raster_view *view, int size,
                       uint16_t *const depths[2]) {
    const burnish_vec3 row = burnish_vec3_loadf(view->rows[0]);
    const double length = burnish_vec3_length(row), radius = length * (double)mesh->point_radius;
    const float used = radius < (double)(size / 2) ? (float)radius : (float)(size / 2);
    const size_t reach = (size_t)((double)used + 0.5);
    draw_middles(mesh, view, size, used, depths);
    for (int side = 0; side < 2 && reach > 0; ++side) {
        widen_columns(depths[side], (size_t)size, reach);
        widen_rows(depths[side], (size_t)size, reach);
    }
}

/* ---- Pairs of maps ---- */

/* Limit in bytes for the vertices of all threads; one thread's are always allowed. */
#define VERTEX_BUDGET ((size_t)64 << 20)

/* What the tasks of many pairs share. */
typedef struct maps_context {
    const burnish_map_drawer *drawer;
    const burnish_mesh_view *mesh;
    const burnish_map_pairs *pairs;
    uint64_t cells[BURNISH_MAP_PAIRS]; /* that each pair's triangles touch */
    atomic_int refused;                /* the first pair that is covered too often so far */
} maps_context;

/* The first of all pairs that is covered too often ends the call, so those after it may be left
 * out, and none before it. */
static void refuse_from(maps_context *all, int pair) {
    int first = atomic_load(&all->refused);
    while (pair < first && !atomic_compare_exchange_weak(&all->refused, &first, pair)) {
    }
}

/* Draws BURNISH_MAPS pairs. */
static void draw_pairs(void *context, size_t index, int thread) {
    maps_context *all = context;
    const burnish_mesh_view *mesh = all->mesh;
    const burnish_map_pairs *pairs = all->pairs;
    const int first = (int)index * BURNISH_MAPS, rest = pairs->count - first;
    burnish_raster_view views[BURNISH_MAPS];
    if (first > atomic_load(&all->refused)) {
        return;
    }
    burnish_maps maps = {.count = rest < BURNISH_MAPS ? rest : BURNISH_MAPS,
                         .size = pairs->views->size,
                         .vertices =
                             mesh->point_radius > 0
                                 ? NULL
                                 : all->drawer->vertices + (size_t)thread * mesh->vertex_count,
                         .indices = mesh->indices,
                         .triangle_count = mesh->triangle_count};
    for (int i = 0; i < maps.count; ++i) {
        views[i] = raster_view(&pairs->views[first + i], mesh);
        for (int side = 0; side < 2; ++side) {
            maps.depths[i][side] = pairs->depths + (size_t)(2 * (first + i) + side) * pairs->stride;
            memset(maps.depths[i][side], 0,
                   (size_t)maps.size * (size_t)maps.size * sizeof **maps.depths[i]);
        }
    }
    if (mesh->point_radius > 0) {
        for (int i = 0; i < maps.count; ++i) {
            draw_cloud(mesh, &views[i], maps.size, maps.depths[i]);
        }
    } else {
        all->drawer->ops->project_to_maps(views, mesh->positions, mesh->vertex_count, &maps);
        all->drawer->ops->draw_maps(&maps);
    }
    for (int i = 0; i < maps.count; ++i) {
        all->cells[first + i] = maps.cells[i];
        if (burnish_overdraw(maps.cells[i], &views[i]) > overdraw_limit(all->drawer, &views[i])) {
            refuse_from(all, first + i);
        }
        for (int side = 0; side < 2 && pairs->finish; ++side) {
            pairs->finish(maps.depths[i][side], (size_t)maps.size);
        }
    }
}

burnish_status burnish_map_pairs_draw(burnish_map_drawer *drawer, const burnish_mesh_view *mesh,
                                      const burnish_map_pairs *pairs, burnish_tasks *tasks,
                                      burnish_memory *memory) {
    const size_t vertices = mesh->point_radius > 0 ? 0 : mesh->vertex_count;
    const size_t fit = VERTEX_BUDGET / sizeof *drawer->vertices / (vertices + 1) + 1;
    const size_t all = (size_t)burnish_tasks_threads(tasks), threads = all < fit ? all : fit;
    maps_context context = {drawer, mesh, pairs, {0}, pairs->count};
    drawer->vertices = burnish_reserve_discard(memory, drawer->vertices, &drawer->vertex_capacity,
                                               threads * vertices, sizeof *drawer->vertices,
                                               "vertices of depth maps");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    burnish_tasks_run(tasks, ((size_t)pairs->count + BURNISH_MAPS - 1) / BURNISH_MAPS, 1,
                      (int)threads, draw_pairs, &context);
    burnish_status status = burnish_tasks_check(tasks, memory->error);
    for (int i = 0; i < pairs->count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_raster_view raster = raster_view(&pairs->views[i], mesh);
        status = check_overdraw(drawer, &raster, context.cells[i], memory);
    }
    return status;
}

void burnish_map_drawer_destroy(burnish_map_drawer *drawer, const burnish_context *context) {
    destroy_tiles(drawer, context);
    burnish_release(context, drawer->vertices);
    drawer->vertices = NULL;
    drawer->vertex_capacity = 0;
    burnish_bins_destroy(&drawer->bins);
    burnish_geometry_destroy(&drawer->geometry);
}
