/* The depth maps of ambient occlusion: their directions, and drawing them with the rasteriser. */
#include "render/occlusion.h"

#include <string.h>

#include "core/vector.h"
#include "simd/isa_ops.h"

/* Maps are drawn from this far, in the raster's space, where the mesh fills the unit sphere. */
#define DISTANCE 2.0
#define RANGE (DISTANCE + 2.0)

/* Depths in [0, 1) are stored in 16 bits: 130 steps per texel's width. */
#define LARGEST_DEPTH 65535.0f

/* How far points are moved off the surface, in texels: less makes a curved surface hide itself,
 * more opens creases. */
#define OFFSET 2.5

/* The sky below is this bright where above it is 1. */
#define DARK_SKY 0.35

/* ---- Directions ---- */

/* A direction and two axes across it. */
typedef struct map_frame {
    burnish_vec3 toward, right, up;
    int size;
    double texels; /* per unit */
} map_frame;

/* Point i of a spherical Fibonacci set. */
static map_frame frame_of(int i, int count, int size) {
    const double golden_angle = 2.39996322972865332;
    const double z = 1 - (2.0 * i + 1) / count, radius = burnish_sqrt(1 - z * z);
    double sine, cosine;
    map_frame frame;
    burnish_sincos(golden_angle * i, &sine, &cosine);
    frame.toward = (burnish_vec3){radius * cosine, radius * sine, z};
    frame.right = (burnish_vec3){-sine, cosine, 0}; /* no pole is a point of the set */
    frame.up = burnish_vec3_cross(frame.toward, frame.right);
    frame.size = size;
    frame.texels = (size - 4) * 0.5;
    return frame;
}

/* As many directions as do not show as silhouettes where a mesh is smooth and small, and as few as
 * do not take too long where it is large: those are rough. */
static int choose_count(const burnish_mesh_view *mesh) {
    static const struct {
        size_t triangles;
        int count;
    } steps[] = {{40000, 128}, {131072, 48}, {524288, 32}, {2097152, 24}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
        if (mesh->triangle_count <= steps[i].triangles) {
            return steps[i].count;
        }
    }
    return 16;
}

static void store_row(burnish_vec3 axis, double factor, double constant, float row[4]) {
    row[0] = (float)(axis.x * factor);
    row[1] = (float)(axis.y * factor);
    row[2] = (float)(axis.z * factor);
    row[3] = (float)constant;
}

static burnish_vec3 center_of(const burnish_mesh_view *mesh) {
    const burnish_vec3 sum = burnish_vec3_add(burnish_vec3_loadf(mesh->bounds_min),
                                              burnish_vec3_loadf(mesh->bounds_max));
    return burnish_vec3_scale(sum, 0.5);
}

/* Units of the raster's space per unit of the mesh. */
static double scale_of(const burnish_mesh_view *mesh) {
    const burnish_vec3 diagonal = burnish_vec3_sub(burnish_vec3_loadf(mesh->bounds_max),
                                                   burnish_vec3_loadf(mesh->bounds_min));
    const double half = burnish_vec3_length(diagonal) * 0.5;
    return half > 0 ? 1 / half : 1;
}

/* The view that a map is drawn with. */
static burnish_raster_view view_of(const map_frame *frame, const burnish_mesh_view *mesh) {
    const double scale = scale_of(mesh);
    const burnish_vec3 center = center_of(mesh);
    burnish_raster_view view = {.width = frame->size,
                                .height = frame->size,
                                .samples = 1,
                                .origin = {(float)center.x, (float)center.y, (float)center.z}};
    store_row(frame->right, frame->texels * scale, 0, view.rows[0]);
    store_row(frame->up, frame->texels * scale, 0, view.rows[1]);
    store_row(frame->toward, scale / RANGE, 1 - DISTANCE / RANGE, view.rows[2]);
    view.rows[3][3] = 1;
    return view;
}

/* The same for a point of the raster's space, in texels from the first one's centre. */
static burnish_occlusion_direction direction_of(const map_frame *frame) {
    const double middle = frame->size * 0.5 - 0.5;
    burnish_occlusion_direction direction = {
        .toward = {(float)frame->toward.x, (float)frame->toward.y, (float)frame->toward.z}};
    store_row(frame->right, frame->texels, middle, direction.column);
    store_row(frame->up, -frame->texels, middle, direction.row);
    store_row(frame->toward, LARGEST_DEPTH / RANGE, LARGEST_DEPTH * (1 - DISTANCE / RANGE),
              direction.depth);
    return direction;
}

/* ---- Maps ---- */

/* What the tasks of a map share. */
typedef struct map_context {
    burnish_occlusion *occlusion;
    const burnish_isa_ops *ops;
    const burnish_raster_view *view;
    uint16_t *depths;
} map_context;

/* A tile's depths to rows of the map. */
static void store_tile(const burnish_tile *tile, uint16_t *depths, size_t size) {
    uint16_t codes[BURNISH_TILE_PIXELS];
    for (int i = 0; i < BURNISH_TILE_PIXELS; ++i) {
        const float depth = tile->buffer.depths[i]; /* below 0 where nothing is */
        codes[i] = (uint16_t)(int)((depth > 0 ? depth : 0) * LARGEST_DEPTH + 0.5f);
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

static void draw_map_tile(void *context, size_t index, int thread) {
    const map_context *map = context;
    const burnish_bins *bins = &map->occlusion->bins;
    burnish_tile *tile = &map->occlusion->tiles[thread];
    const int column = (int)index % bins->columns;
    const int row = bins->first_row + (int)index / bins->columns;
    if (burnish_tile_draw(tile, map->ops, map->view, &map->occlusion->geometry, bins, column,
                          row)) {
        store_tile(tile, map->depths, (size_t)map->view->width);
    } else {
        clear_tile(tile, map->depths, (size_t)map->view->width);
    }
}

static burnish_status draw_map(burnish_occlusion *occlusion, const burnish_isa_ops *ops,
                               const burnish_mesh_view *mesh, const burnish_raster_view *view,
                               uint16_t *depths, burnish_tasks *tasks, burnish_memory *memory) {
    const burnish_triangles triangles = {mesh->positions, mesh->vertex_count, mesh->indices,
                                         mesh->triangle_count};
    map_context map = {occlusion, ops, view, depths};
    burnish_bins *bins = &occlusion->bins;
    burnish_status status =
        burnish_geometry_update(&occlusion->geometry, ops, view, &triangles, tasks, memory->error);
    burnish_bins_begin(bins, memory->context);
    while (status == BURNISH_STATUS_OK) {
        status = burnish_bin_tiles(bins, ops, &occlusion->geometry, view, tasks, memory->error);
        if (status == BURNISH_STATUS_OK) {
            const int count = bins->columns * (bins->end_row - bins->first_row);
            burnish_tasks_run(tasks, (size_t)count, 1, occlusion->tile_count, draw_map_tile, &map);
            status = burnish_tasks_check(tasks, memory->error);
        }
        if (bins->end_row >= bins->rows) {
            break;
        }
    }
    return status;
}

static void destroy_tiles(burnish_occlusion *occlusion, const burnish_context *context) {
    for (int i = 0; i < occlusion->tile_count; ++i) {
        burnish_tile_destroy(&occlusion->tiles[i]);
    }
    burnish_release(context, occlusion->tiles);
    occlusion->tiles = NULL;
    occlusion->tile_count = 0;
}

/* Tiles and maps for `count` directions. */
static burnish_status reserve(burnish_occlusion *occlusion, int count, int size, int threads,
                              burnish_memory *memory) {
    static const burnish_tile_options depth_only = {.samples = 1};
    const size_t texels = (size_t)size * (size_t)size;
    occlusion->depths =
        burnish_reserve_discard(memory, occlusion->depths, &occlusion->capacity,
                                (size_t)count * texels, sizeof *occlusion->depths, "depth maps");
    if (occlusion->tile_count != threads) {
        destroy_tiles(occlusion, memory->context);
        occlusion->tiles =
            burnish_allocate_zeroed(memory, (size_t)threads, sizeof *occlusion->tiles, "tiles");
        occlusion->tile_count = occlusion->tiles ? threads : 0;
        burnish_status status = memory->status;
        for (int i = 0; i < occlusion->tile_count && status == BURNISH_STATUS_OK; ++i) {
            status = burnish_tile_create(&occlusion->tiles[i], &depth_only, memory->context,
                                         memory->error);
        }
        if (status != BURNISH_STATUS_OK) {
            destroy_tiles(occlusion, memory->context);
            return status;
        }
    }
    return memory->status;
}

static burnish_status draw_maps(burnish_occlusion *occlusion, const burnish_isa_ops *ops,
                                const burnish_mesh_view *mesh, int count, int size,
                                burnish_tasks *tasks, burnish_memory *memory) {
    const size_t texels = (size_t)size * (size_t)size;
    occlusion->mesh = 0;
    burnish_status status = reserve(occlusion, count, size, burnish_tasks_threads(tasks), memory);
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        const map_frame frame = frame_of(i, count, size);
        const burnish_raster_view view = view_of(&frame, mesh);
        uint16_t *depths = occlusion->depths + (size_t)i * texels;
        occlusion->directions[i] = direction_of(&frame);
        occlusion->directions[i].depths = depths;
        status = draw_map(occlusion, ops, mesh, &view, depths, tasks, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        occlusion->mesh = mesh->serial;
        occlusion->count = count;
        occlusion->size = size;
    }
    return status;
}

/* ---- Look-ups ---- */

/* A row for points that count from the eye. */
static void move_row(const float row[4], const double eye[3], float moved[4]) {
    memcpy(moved, row, 4 * sizeof *moved);
    moved[3] = (float)((double)row[3] + (double)row[0] * eye[0] + (double)row[1] * eye[1] +
                       (double)row[2] * eye[2]);
}

burnish_status burnish_occlusion_update(burnish_occlusion *occlusion, const burnish_isa_ops *ops,
                                        const burnish_mesh_view *mesh, int wanted, int size,
                                        const double eye[3], const double up[3],
                                        burnish_tasks *tasks, burnish_memory *memory,
                                        burnish_occlusion_lookup *lookup) {
    const int count = wanted == BURNISH_OCCLUSION_AUTO ? choose_count(mesh) : wanted;
    const double texel = 2.0 / (size - 4);
    if (occlusion->mesh != mesh->serial || occlusion->count != count || occlusion->size != size) {
        burnish_status status = draw_maps(occlusion, ops, mesh, count, size, tasks, memory);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    for (int i = 0; i < count; ++i) {
        const burnish_occlusion_direction *from = &occlusion->directions[i];
        burnish_occlusion_direction *to = &occlusion->seen[i];
        const double height = (double)from->toward[0] * up[0] + (double)from->toward[1] * up[1] +
                              (double)from->toward[2] * up[2];
        *to = *from;
        to->weight = (float)(DARK_SKY + (1 - DARK_SKY) * (0.5 + 0.5 * height));
        move_row(from->column, eye, to->column);
        move_row(from->row, eye, to->row);
        move_row(from->depth, eye, to->depth);
    }
    lookup->count = count;
    lookup->size = size;
    lookup->directions = occlusion->seen;
    lookup->offset = (float)(OFFSET * texel);
    lookup->slope = (float)(RANGE / (LARGEST_DEPTH * texel));
    return BURNISH_STATUS_OK;
}

void burnish_occlusion_destroy(burnish_occlusion *occlusion, const burnish_context *context) {
    destroy_tiles(occlusion, context);
    burnish_bins_destroy(&occlusion->bins);
    burnish_geometry_destroy(&occlusion->geometry);
    burnish_release(context, occlusion->depths);
    memset(occlusion, 0, sizeof *occlusion);
}
