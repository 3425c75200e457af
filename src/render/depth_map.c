#include "render/depth_map.h"

#include <string.h>

#include "render/bands.h"
#include "render/space.h"
#include "simd/isa_ops.h"

/* Maps are drawn from this far: behind the unit sphere there is as much of the range as before it.
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
    const burnish_isa_ops *ops;
    const burnish_raster_view *view;
    uint16_t *depths;
    int is_begun;   /* 1: nearer depths that are there stay */
    uint64_t cells; /* that other triangles than geometry's have touched */
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

static void store_tile(const burnish_tile *tile, int is_begun, uint16_t *depths, size_t size) {
    uint16_t codes[BURNISH_TILE_PIXELS];
    for (int i = 0; i < BURNISH_TILE_PIXELS; ++i) {
        codes[i] = code_of_depth(tile->buffer.depths[i]);
    }
    for (int y = 0; y < tile->height; ++y) {
        uint16_t *to = depths + (size_t)(tile->y + y) * size + tile->x;
        for (int x = 0; x < tile->width; x += BURNISH_BLOCK_SIZE) {
            uint16_t *from = codes + burnish_pixel_index(x, y);
            for (int i = 0; i < BURNISH_BLOCK_SIZE && is_begun; ++i) {
                from[i] = from[i] > to[x + i] ? from[i] : to[x + i];
            }
            memcpy(to + x, from, BURNISH_BLOCK_SIZE * sizeof *to);
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
    if (burnish_tile_draw(tile, map->ops, map->view, &drawer->geometry, &drawer->bins, column,
                          row)) {
        store_tile(tile, map->is_begun, map->depths, size);
    } else if (!map->is_begun) {
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

static burnish_status check_overdraw(const burnish_map_drawer *drawer,
                                     const burnish_raster_view *view, burnish_memory *memory) {
    return burnish_geometry_check_overdraw(&drawer->geometry, view, drawer->max_overdraw,
                                           "a depth map (ambient occlusion, ground, shadow)",
                                           memory->error);
}

/* Draws triangles by tiles. */
static burnish_status draw_triangles(map_context *map, const burnish_triangles *triangles,
                                     const uint16_t *transparent, burnish_tasks *tasks,
                                     burnish_memory *memory) {
    burnish_map_drawer *drawer = map->drawer;
    burnish_status status = prepare_tiles(drawer, burnish_tasks_threads(tasks), memory);
    for (int i = 0; i < drawer->tile_count; ++i) {
        drawer->tiles[i].transparent = transparent;
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_geometry_update(&drawer->geometry, map->ops, map->view, triangles, tasks,
                                         memory->error);
        drawer->geometry.cells += map->cells;
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_overdraw(drawer, map->view, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_bands bands = {&drawer->bins,  map->ops, &drawer->geometry,
                                     map->view,      tasks,    drawer->tile_count,
                                     memory->context};
        status = burnish_bands_draw(&bands, draw_tile, map, memory->error);
    }
    return status;
}

burnish_status burnish_map_draw(burnish_map_drawer *drawer, const burnish_isa_ops *ops,
                                const burnish_mesh_view *mesh, const burnish_map_view *view,
                                uint16_t *depths, burnish_tasks *tasks, burnish_memory *memory) {
    const burnish_triangles triangles = {mesh->positions, mesh->vertex_count, mesh->indices,
                                         mesh->triangle_count, NULL};
    const burnish_raster_view raster = raster_view(view, mesh);
    map_context map = {drawer, ops, &raster, depths, 0, 0};
    return draw_triangles(&map, &triangles, drawer->transparent, tasks, memory);
}

/* ---- Many maps ---- */

/* Vertices of all threads take at most so many bytes, or those of one. */
#define VERTEX_BUDGET ((size_t)64 << 20)

enum { MAPS_AT_ONCE = 32 }; /* so that what is kept of their triangles is 4 bytes of each */

/* What the tasks of many maps share. */
typedef struct maps_context {
    const burnish_map_drawer *drawer;
    const burnish_isa_ops *ops;
    const burnish_mesh_view *mesh;
    const burnish_map_view *views;
    int count;
    uint16_t *depths;
    size_t stride;
    uint8_t is_begun[MAPS_AT_ONCE]; /* small triangles have been drawn */
    uint64_t cells[MAPS_AT_ONCE];   /* that these have touched */
} maps_context;

static size_t batches_of(const burnish_mesh_view *mesh) {
    return (mesh->triangle_count + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
}

/* Draws the small triangles of a pair of maps. */
static void draw_pair(void *context, size_t index, int thread) {
    maps_context *all = context;
    const burnish_mesh_view *mesh = all->mesh;
    const int first = (int)index * BURNISH_MAPS, rest = all->count - first;
    burnish_raster_view views[BURNISH_MAPS];
    burnish_maps maps = {.count = rest < BURNISH_MAPS ? rest : BURNISH_MAPS,
                         .size = all->views->size,
                         .vertices = all->drawer->vertices + (size_t)thread * mesh->vertex_count,
                         .indices = mesh->indices,
                         .triangle_count = mesh->triangle_count,
                         .transparent = all->drawer->transparent};
    for (int i = 0; i < maps.count; ++i) {
        views[i] = raster_view(&all->views[first + i], mesh);
        maps.depths[i] = all->depths + (size_t)(first + i) * all->stride;
        maps.large[i] = all->drawer->large + (size_t)(first + i) * batches_of(mesh);
    }
    const int is_inside =
        all->ops->project_to_maps(views, mesh->positions, mesh->vertex_count, &maps);
    for (int i = 0; i < maps.count; ++i) {
        memset(maps.depths[i], 0, (size_t)maps.size * (size_t)maps.size * sizeof *maps.depths[i]);
        all->is_begun[first + i] = (uint8_t)is_inside;
    }
    if (is_inside) {
        all->ops->draw_maps(&maps);
    }
    for (int i = 0; i < maps.count; ++i) {
        all->cells[first + i] = maps.cells[i];
    }
}

/* The triangles of a map that are not small; their number, or 0 where memory is out. */
static size_t collect_large(burnish_map_drawer *drawer, const burnish_mesh_view *mesh,
                            const uint16_t *large, burnish_memory *memory) {
    const size_t batches = batches_of(mesh);
    size_t count = 0, found = 0;
    for (size_t i = 0; i < batches; ++i) {
        count += large[i] ? (size_t)__builtin_popcount(large[i]) : 0;
    }
    if (count == 0) {
        return 0;
    }
    drawer->indices = burnish_reserve_discard(memory, drawer->indices, &drawer->index_capacity,
                                              3 * count, sizeof *drawer->indices, "indices");
    drawer->masks = burnish_reserve_discard(memory, drawer->masks, &drawer->mask_capacity,
                                            count / BURNISH_BATCH_SIZE + 1, sizeof *drawer->masks,
                                            "transparent triangles");
    if (memory->status != BURNISH_STATUS_OK) {
        return 0;
    }
    memset(drawer->masks, 0, (count / BURNISH_BATCH_SIZE + 1) * sizeof *drawer->masks);
    for (size_t i = 0; i < batches; ++i) {
        const unsigned transparent = drawer->transparent ? drawer->transparent[i] : 0;
        for (unsigned rest = large[i]; rest; rest &= rest - 1, ++found) {
            const unsigned lane = (unsigned)__builtin_ctz(rest);
            memcpy(drawer->indices + 3 * found, mesh->indices + 3 * (i * BURNISH_BATCH_SIZE + lane),
                   3 * sizeof(uint32_t));
            drawer->masks[found / BURNISH_BATCH_SIZE] |=
                (uint16_t)((transparent >> lane & 1) << found % BURNISH_BATCH_SIZE);
        }
    }
    return count;
}

/* Draws what the small triangles have left of map i. */
static burnish_status finish_map(burnish_map_drawer *drawer, const maps_context *some, int i,
                                 burnish_tasks *tasks, burnish_memory *memory) {
    const burnish_mesh_view *mesh = some->mesh;
    uint16_t *depths = some->depths + (size_t)i * some->stride;
    if (!some->is_begun[i]) {
        return burnish_map_draw(drawer, some->ops, mesh, &some->views[i], depths, tasks, memory);
    }
    const size_t count =
        collect_large(drawer, mesh, drawer->large + (size_t)i * batches_of(mesh), memory);
    const burnish_raster_view raster = raster_view(&some->views[i], mesh);
    if (count == 0) {
        drawer->geometry.cells = some->cells[i];
        return memory->status == BURNISH_STATUS_OK ? check_overdraw(drawer, &raster, memory)
                                                   : memory->status;
    }
    const burnish_triangles triangles = {mesh->positions, mesh->vertex_count, drawer->indices,
                                         count, NULL};
    map_context map = {drawer, some->ops, &raster, depths, 1, some->cells[i]};
    return draw_triangles(&map, &triangles, drawer->transparent ? drawer->masks : NULL, tasks,
                          memory);
}

/* Draws at most MAPS_AT_ONCE maps by at most `threads` threads. */
static burnish_status draw_some(burnish_map_drawer *drawer, maps_context *some, int threads,
                                burnish_tasks *tasks, burnish_memory *memory) {
    burnish_tasks_run(tasks, ((size_t)some->count + BURNISH_MAPS - 1) / BURNISH_MAPS, 1, threads,
                      draw_pair, some);
    burnish_status status = burnish_tasks_check(tasks, memory->error);
    for (int i = 0; i < some->count && status == BURNISH_STATUS_OK; ++i) {
        status = finish_map(drawer, some, i, tasks, memory);
    }
    return status;
}

burnish_status burnish_maps_draw(burnish_map_drawer *drawer, const burnish_isa_ops *ops,
                                 const burnish_mesh_view *mesh, const burnish_map_view *views,
                                 int count, uint16_t *depths, size_t stride, burnish_tasks *tasks,
                                 burnish_memory *memory) {
    const size_t fit = VERTEX_BUDGET / sizeof *drawer->vertices / (mesh->vertex_count + 1) + 1;
    const size_t all = (size_t)burnish_tasks_threads(tasks), threads = all < fit ? all : fit;
    drawer->vertices = burnish_reserve_discard(memory, drawer->vertices, &drawer->vertex_capacity,
                                               threads * mesh->vertex_count,
                                               sizeof *drawer->vertices, "vertices of depth maps");
    drawer->large = burnish_reserve_discard(memory, drawer->large, &drawer->large_capacity,
                                            MAPS_AT_ONCE * batches_of(mesh), sizeof *drawer->large,
                                            "triangles of depth maps");
    burnish_status status = memory->status;
    for (int first = 0; first < count && status == BURNISH_STATUS_OK; first += MAPS_AT_ONCE) {
        const int rest = count - first;
        maps_context some = {drawer,
                             ops,
                             mesh,
                             views + first,
                             rest < MAPS_AT_ONCE ? rest : MAPS_AT_ONCE,
                             depths + (size_t)first * stride,
                             stride,
                             {0},
                             {0}};
        status = draw_some(drawer, &some, (int)threads, tasks, memory);
    }
    return status;
}

void burnish_map_drawer_destroy(burnish_map_drawer *drawer, const burnish_context *context) {
    destroy_tiles(drawer, context);
    burnish_release(context, drawer->vertices);
    burnish_release(context, drawer->large);
    burnish_release(context, drawer->indices);
    burnish_release(context, drawer->masks);
    drawer->vertices = NULL;
    drawer->large = NULL;
    drawer->indices = NULL;
    drawer->masks = NULL;
    drawer->vertex_capacity = drawer->large_capacity = 0;
    drawer->index_capacity = drawer->mask_capacity = 0;
    burnish_bins_destroy(&drawer->bins);
    burnish_geometry_destroy(&drawer->geometry);
}
