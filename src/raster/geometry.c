/* Vertices to the screen, triangles to batches: by the templates, a grain after another. Triangles
 * that cross the near plane or the guard band are clipped here. */
#include "raster/geometry.h"

#include <assert.h>
#include <string.h>

#include "base/memory.h"
#include "core/vec3.h"
#include "raster/discs.h"
#include "raster/raster_ops.h"
#include "raster/tile_layout.h"

/* A vertex that clipping made, on the screen and in the mesh. */
typedef struct clipped_vertex {
    burnish_screen_vertex at;
    float inverse_w;
    burnish_clip_vertex clip;
} clipped_vertex;

/* Vertices count from the part's own clipped ones. */
typedef struct clipped_triangle {
    uint32_t vertices[3], id;
} clipped_triangle;

/* What one task found in its triangles of the mesh. */
typedef struct burnish_geometry_part {
    size_t visible;
    uint64_t cells;
    clipped_vertex *vertices;
    clipped_triangle *triangles;
    size_t vertex_count, vertex_capacity, triangle_count, triangle_capacity;
    burnish_status status;
    burnish_error error;
} burnish_geometry_part;

/* What the tasks of burnish_geometry_update share. */
typedef struct update_context {
    burnish_geometry *geometry;
    const burnish_raster_ops *ops;
    const burnish_raster_view *view;
    const burnish_triangles *triangles;
} update_context;

static void transform_task(void *context, size_t index, int thread) {
    const update_context *update = context;
    burnish_screen_vertices *vertices = &update->geometry->vertices;
    const size_t first = index * BURNISH_TASK_GRAIN, end = first + BURNISH_TASK_GRAIN;
    (void)thread;
    update->ops->transform_vertices(vertices, update->view, update->triangles->positions, first,
                                    end < vertices->mesh_count ? end : vertices->mesh_count);
}

static void to_clip_space(const burnish_raster_view *view, const float p[3], float clip[4]) {
    float x = p[0] - view->origin[0], y = p[1] - view->origin[1], z = p[2] - view->origin[2];
    for (int i = 0; i < 4; ++i) {
        const float *row = view->rows[i];
        clip[i] = ((row[0] * x + row[1] * y) + row[2] * z) + row[3];
    }
}

/* The perspective division of a corner that clipping has left. */
static clipped_vertex project_corner(const burnish_raster_view *view,
                                     const burnish_clip_corner *corner, uint32_t triangle) {
    const float *clip = corner->position;
    const float inverse_w = 1.0f / clip[3];
    const int half = BURNISH_SUBPIXELS / 2;
    clipped_vertex made = {.inverse_w = inverse_w, .clip.triangle = triangle};
    made.at.x = burnish_to_fixed(clip[0] * inverse_w) + view->width * half;
    made.at.y = view->height * half - burnish_to_fixed(clip[1] * inverse_w);
    made.at.depth = clip[2] * inverse_w;
    memcpy(made.clip.weights, corner->weights, sizeof made.clip.weights);
    return made;
}

/* Cuts a triangle and appends what is left as a fan. */
static burnish_status clip_triangle(const update_context *update, uint32_t triangle,
                                    burnish_geometry_part *part) {
    burnish_clip_corner corners[BURNISH_CLIP_MAX];
    for (int i = 0; i < 3; ++i) {
        const size_t vertex = update->triangles->indices[3 * (size_t)triangle + i];
        to_clip_space(update->view, update->triangles->positions + 3 * vertex, corners[i].position);
        for (int j = 0; j < 3; ++j) {
            corners[i].weights[j] = i == j;
        }
    }
    const int count = burnish_clip_polygon(corners, 3);
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_memory memory = burnish_memory_of(update->geometry->context, &part->error);
    const size_t first = part->vertex_count;
    part->vertices =
        burnish_reserve(&memory, part->vertices, &part->vertex_capacity, first + (size_t)count,
                        sizeof *part->vertices, "clipped vertices");
    part->triangles = burnish_reserve(&memory, part->triangles, &part->triangle_capacity,
                                      part->triangle_count + (size_t)count, sizeof *part->triangles,
                                      "clipped triangles");
    if (memory.status != BURNISH_STATUS_OK) {
        return memory.status;
    }
    for (int i = 0; i < count; ++i) {
        part->vertices[part->vertex_count++] = project_corner(update->view, &corners[i], triangle);
    }
    for (uint32_t i = 1; i + 1 < (uint32_t)count; ++i) {
        const uint32_t base = (uint32_t)first;
        part->triangles[part->triangle_count++] =
            (clipped_triangle){{base, base + i, base + i + 1}, triangle};
    }
    return BURNISH_STATUS_OK;
}

/* ---- Work ---- */

enum { CELL = BURNISH_HIZ_PIXELS * BURNISH_SUBPIXELS };

/* Cells that an edge may pass through. */
static int64_t edge_cells(const burnish_screen_vertex *a, const burnish_screen_vertex *b) {
    const int64_t dx = (int64_t)a->x - b->x, dy = (int64_t)a->y - b->y;
    return ((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy)) / CELL + 2;
}

/* Cells that a triangle touches, at most. A cell that it does not cover is one of an edge. */
static uint64_t triangle_cells(const burnish_geometry *geometry, const uint32_t v[3],
                               uint32_t first, uint32_t last) {
    const burnish_screen_vertex *items = geometry->vertices.items;
    const burnish_screen_vertex *a = &items[v[0]], *b = &items[v[1]], *c = &items[v[2]];
    const int64_t box = (int64_t)(BURNISH_PACKED_X(last) - BURNISH_PACKED_X(first) + 1) *
                        (BURNISH_PACKED_Y(last) - BURNISH_PACKED_Y(first) + 1);
    const int64_t twice = ((int64_t)b->x - a->x) * ((int64_t)c->y - a->y) -
                          ((int64_t)b->y - a->y) * ((int64_t)c->x - a->x);
    const int64_t area = (twice < 0 ? -twice : twice) / (2 * (int64_t)CELL * CELL);
    const int64_t touched = area + edge_cells(a, b) + edge_cells(b, c) + edge_cells(c, a);
    return (uint64_t)(touched < box ? touched : box);
}

/* What the large triangles of a batch add to geometry->cells. Only visible ones have bounds. */
static uint64_t batch_cells(const burnish_geometry *geometry, size_t number,
                            const uint32_t *indices, unsigned transparent) {
    static const uint32_t bits[BURNISH_BATCH_SIZE] = {
        1 << 0, 1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
        1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};
    const burnish_triangle_batch *batch = &geometry->batches[number];
    const uint32_t visible =
        geometry->headers[number].visible[0] | geometry->headers[number].visible[1];
    unsigned large = 0;
    uint32_t any = 0;
    uint64_t cells = 0;
    if (!visible) {
        return 0;
    }
    for (unsigned i = 0; i < BURNISH_BATCH_SIZE; ++i) { /* mostly none is large */
        any |= (batch->last[i] - batch->first[i]) & (visible & bits[i] ? UINT32_MAX : 0);
    }
    if (!(any & 0xfffefffeu)) {
        return 0;
    }
    for (unsigned i = 0; i < BURNISH_BATCH_SIZE;
         ++i) { /* x and y at once: last is not before first */
        large |= (unsigned)(((batch->last[i] - batch->first[i]) & 0xfffefffeu) != 0) << i;
    }
    for (large &= visible; large; large &= large - 1) {
        const unsigned i = (unsigned)__builtin_ctz(large);
        cells +=
            triangle_cells(geometry, indices + 3 * (size_t)i, batch->first[i], batch->last[i]) *
            (transparent >> i & 1 ? BURNISH_LAYER_WORK : 1);
    }
    return cells;
}

/* The same for points, whose cells are those of their bounds. */
static uint64_t box_cells(const burnish_geometry *geometry, size_t number) {
    const burnish_triangle_batch *batch = &geometry->batches[number];
    uint64_t cells = 0;
    for (unsigned rest = geometry->headers[number].visible[0]; rest; rest &= rest - 1) {
        const unsigned i = (unsigned)__builtin_ctz(rest);
        const uint32_t first = batch->first[i], last = batch->last[i];
        if (((last - first) & 0xfffefffeu) != 0) {
            cells += (uint64_t)(BURNISH_PACKED_X(last) - BURNISH_PACKED_X(first) + 1) *
                     (BURNISH_PACKED_Y(last) - BURNISH_PACKED_Y(first) + 1);
        }
    }
    return cells;
}

burnish_status burnish_check_overdraw(double overdraw, double limit, const char *what,
                                      burnish_error *error) {
    if (overdraw <= limit) {
        return BURNISH_STATUS_OK;
    }
    return burnish_fail(error, BURNISH_STATUS_LIMIT,
                        "the triangles cover %s %.0f times, which takes long; the limit is %.0f: "
                        "raise --max-overdraw, or leave out what is hidden",
                        what, overdraw, limit);
}

/* ---- Points ---- */

static double length_of(const float row[4]) {
    return burnish_vec3_length(burnish_vec3_loadf(row));
}

static void store_unit(const float row[4], float out[3]) {
    const burnish_vec3 unit = burnish_vec3_normalize(burnish_vec3_loadf(row));
    out[0] = (float)unit.x;
    out[1] = (float)unit.y;
    out[2] = (float)unit.z;
}

/* Rows of a view are its axes, scaled: right, up, and forward in w, or against it in z. */
static burnish_point_view make_point_view(const burnish_raster_view *view, float radius) {
    const double size = (double)radius, w = length_of(view->rows[3]);
    const double pixels = length_of(view->rows[0]);
    burnish_point_view points = {
        .radius_w = (float)(size * pixels),
        .nearer_z = (float)(size * length_of(view->rows[2])),
        .nearer_w = (float)(-size * w),
        .slope = (float)(w / pixels),
        .opacity = 1,
        .center = {view->width * (BURNISH_SUBPIXELS / 2), view->height * (BURNISH_SUBPIXELS / 2)}};
    store_unit(view->rows[0], points.right);
    store_unit(view->rows[1], points.up);
    store_unit(w > 0 ? view->rows[3] : view->rows[2], points.forward);
    for (int k = 0; k < 3 && !(w > 0); ++k) {
        points.forward[k] = -points.forward[k];
    }
    return points;
}

/* The first and last pixel that a disc may touch along an axis, of `size` pixels; 0: none. */
static int touch_pixels(int32_t center, int32_t radius, int size, int *first, int *last) {
    const int32_t low = center - radius, high = center + radius;
    if (high < 0 || low >= size * BURNISH_SUBPIXELS) {
        return 0;
    }
    *first = low > 0 ? low / BURNISH_SUBPIXELS : 0;
    *last = high / BURNISH_SUBPIXELS;
    *last = *last < size ? *last : size - 1;
    return 1;
}

static int bound_point(const burnish_geometry *geometry, const burnish_raster_view *view,
                       size_t point, burnish_triangle_batch *batch, size_t i) {
    const burnish_screen_vertex *v = &geometry->vertices.items[point];
    int x0, y0, x1, y1;
    if (v->outcode & BURNISH_OUT_CLIP) {
        return 0;
    }
    const burnish_disc disc =
        burnish_disc_of(&geometry->points, v->depth, geometry->vertices.inverse_w[point]);
    if (!(disc.nearest < 1 && (disc.nearest > 0 || geometry->points.slope == 0)) ||
        !touch_pixels(v->x, disc.radius, view->width, &x0, &x1) ||
        !touch_pixels(v->y, disc.radius, view->height, &y0, &y1)) {
        return 0;
    }
    batch->nearest[i] = disc.nearest + (disc.nearest - v->depth); /* discs_simd.h: a radius more */
    batch->first[i] = BURNISH_PACK(x0 / BURNISH_HIZ_PIXELS, y0 / BURNISH_HIZ_PIXELS);
    batch->last[i] = BURNISH_PACK(x1 / BURNISH_HIZ_PIXELS, y1 / BURNISH_HIZ_PIXELS);
    return 1;
}

/* Bounds the points [first, first + count), which are a batch, and fills its header. Points that
 * reach the near plane or the guard band are left out. Returns bits of the visible ones. */
static unsigned bound_points(burnish_geometry *geometry, const burnish_raster_view *view,
                             size_t first, size_t count) {
    const size_t number = first / BURNISH_BATCH_SIZE;
    burnish_triangle_batch *batch = &geometry->batches[number];
    burnish_batch_header *header = &geometry->headers[number];
    unsigned visible = 0;
    for (size_t i = 0; i < BURNISH_BATCH_SIZE; ++i) {
        batch->nearest[i] = 0;
        batch->first[i] = batch->last[i] = 0;
        visible |= i < count && bound_point(geometry, view, first + i, batch, i) ? 1U << i : 0;
    }
    const unsigned any = visible ? (unsigned)__builtin_ctz(visible) : 0;
    const uint32_t tile = batch->first[any] & BURNISH_HIZ_TILE_MASK;
    unsigned elsewhere = 0;
    for (unsigned rest = visible; rest; rest &= rest - 1) {
        const int i = __builtin_ctz(rest);
        elsewhere |= (batch->first[i] & BURNISH_HIZ_TILE_MASK) != tile ||
                     (batch->last[i] & BURNISH_HIZ_TILE_MASK) != tile;
    }
    header->visible[0] = (uint16_t)visible;
    header->visible[1] = 0;
    header->tile = elsewhere ? BURNISH_NO_TILE : tile / BURNISH_HIZ_SIZE;
    return visible;
}

/* ---- Culling ---- */

/* Culls a part of the mesh's triangles, which begins with a batch, and clips triangles that need
 * it. */
static void cull_task(void *context, size_t index, int thread) {
    const update_context *update = context;
    burnish_geometry *geometry = update->geometry;
    burnish_geometry_part *part = &geometry->parts[index];
    const uint16_t *transparent = update->triangles->transparent;
    const size_t first = index * BURNISH_TASK_GRAIN;
    const size_t rest = update->triangles->triangle_count - first;
    const size_t end = first + (rest < BURNISH_TASK_GRAIN ? rest : BURNISH_TASK_GRAIN);
    (void)thread;
    part->visible = part->vertex_count = part->triangle_count = 0;
    part->cells = 0;
    part->status = BURNISH_STATUS_OK;
    for (size_t at = first; at < end; at += BURNISH_BATCH_SIZE) {
        const size_t count = end - at < BURNISH_BATCH_SIZE ? end - at : BURNISH_BATCH_SIZE;
        const size_t batch = at / BURNISH_BATCH_SIZE;
        unsigned clipped;
        if (!geometry->indices) {
            const unsigned visible = bound_points(geometry, update->view, at, count);
            part->visible += (size_t)__builtin_popcount(visible);
            part->cells += box_cells(geometry, batch);
            continue;
        }
        part->visible += (size_t)update->ops->cull_and_bound(
            &geometry->vertices, update->view, geometry->indices + 3 * at, count,
            &geometry->batches[batch], &geometry->headers[batch], &clipped);
        part->cells += batch_cells(geometry, batch, geometry->indices + 3 * at,
                                   transparent ? transparent[batch] : 0);
        for (; clipped && part->status == BURNISH_STATUS_OK; clipped &= clipped - 1) {
            part->status =
                clip_triangle(update, (uint32_t)at + (uint32_t)__builtin_ctz(clipped), part);
        }
    }
}

/* Reserves memory for clipped triangles and their vertices, which follow the mesh's own. */
static burnish_status reserve_clipped(burnish_geometry *geometry, size_t vertices, size_t triangles,
                                      burnish_error *error) {
    burnish_screen_vertices *screen = &geometry->vertices;
    const size_t batches = (triangles + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    burnish_memory memory = burnish_memory_of(geometry->context, error);
    geometry->clipped_count = triangles;
    geometry->batch_count = geometry->mesh_batches + batches;
    screen->count = screen->mesh_count + vertices;
    if (screen->count >= UINT32_MAX || geometry->batch_count > INT32_MAX / BURNISH_BATCH_SIZE) {
        return burnish_fail(
            error, BURNISH_STATUS_LIMIT,
            "clipping makes more than 2^32 vertices or 2^31 triangles; split the mesh");
    }
    geometry->batches =
        burnish_reserve(&memory, geometry->batches, &geometry->batch_capacity,
                        geometry->batch_count, sizeof *geometry->batches, "triangles");
    geometry->headers =
        burnish_reserve(&memory, geometry->headers, &geometry->header_capacity,
                        geometry->batch_count, sizeof *geometry->headers, "triangles");
    screen->items = burnish_reserve(&memory, screen->items, &screen->item_capacity, screen->count,
                                    sizeof *screen->items, "screen vertices");
    screen->inverse_w =
        burnish_reserve(&memory, screen->inverse_w, &screen->inverse_capacity, screen->count,
                        sizeof *screen->inverse_w, "screen vertices");
    geometry->clipped_indices =
        burnish_reserve_discard(&memory, geometry->clipped_indices, &geometry->index_capacity,
                                3 * triangles, sizeof *geometry->clipped_indices, "indices");
    geometry->clipped_ids =
        burnish_reserve_discard(&memory, geometry->clipped_ids, &geometry->id_capacity, triangles,
                                sizeof *geometry->clipped_ids, "clipped triangles");
    geometry->clip_vertices =
        burnish_reserve_discard(&memory, geometry->clip_vertices, &geometry->clip_capacity,
                                vertices, sizeof *geometry->clip_vertices, "clipped vertices");
    return memory.status;
}

/* Appends the clipped triangles and their vertices in the order of the parts. */
static void append_clipped(burnish_geometry *geometry, size_t part_count) {
    burnish_screen_vertices *screen = &geometry->vertices;
    size_t vertex = 0, triangle = 0;
    for (size_t i = 0; i < part_count; ++i) {
        const burnish_geometry_part *part = &geometry->parts[i];
        const uint32_t base = (uint32_t)(screen->mesh_count + vertex);
        for (size_t j = 0; j < part->triangle_count; ++j, ++triangle) {
            for (size_t k = 0; k < 3; ++k) {
                geometry->clipped_indices[3 * triangle + k] = base + part->triangles[j].vertices[k];
            }
            geometry->clipped_ids[triangle] = part->triangles[j].id;
        }
        for (size_t j = 0; j < part->vertex_count; ++j, ++vertex) {
            const clipped_vertex *made = &part->vertices[j];
            screen->items[screen->mesh_count + vertex] = made->at;
            screen->inverse_w[screen->mesh_count + vertex] = made->inverse_w;
            geometry->clip_vertices[vertex] = made->clip;
        }
    }
}

/* Which of the batch of clipped triangles from `at` on are transparent. */
static unsigned clipped_transparent(const update_context *update, size_t at) {
    const uint16_t *transparent = update->triangles->transparent;
    const burnish_geometry *geometry = update->geometry;
    unsigned mask = 0;
    for (size_t i = 0; transparent && i < BURNISH_BATCH_SIZE && at + i < geometry->clipped_count;
         ++i) {
        const uint32_t id = geometry->clipped_ids[at + i];
        mask |= (transparent[id / BURNISH_BATCH_SIZE] >> id % BURNISH_BATCH_SIZE & 1U) << i;
    }
    return mask;
}

/* Culls the clipped triangles like any others. */
static void cull_clipped(const update_context *update) {
    burnish_geometry *geometry = update->geometry;
    for (size_t at = 0; at < geometry->clipped_count; at += BURNISH_BATCH_SIZE) {
        const size_t rest = geometry->clipped_count - at;
        const size_t batch = geometry->mesh_batches + at / BURNISH_BATCH_SIZE;
        unsigned clipped;
        geometry->triangle_count += (size_t)update->ops->cull_and_bound(
            &geometry->vertices, update->view, geometry->clipped_indices + 3 * at,
            rest < BURNISH_BATCH_SIZE ? rest : BURNISH_BATCH_SIZE, &geometry->batches[batch],
            &geometry->headers[batch], &clipped);
        geometry->cells += batch_cells(geometry, batch, geometry->clipped_indices + 3 * at,
                                       clipped_transparent(update, at));
        assert(!clipped);
    }
}

/* Adds up what the parts found. */
static burnish_status join_parts(const update_context *update, size_t part_count,
                                 burnish_error *error) {
    burnish_geometry *geometry = update->geometry;
    size_t vertices = 0, triangles = 0;
    for (size_t i = 0; i < part_count; ++i) {
        const burnish_geometry_part *part = &geometry->parts[i];
        if (part->status != BURNISH_STATUS_OK) {
            if (error) {
                *error = part->error;
            }
            return part->status;
        }
        geometry->triangle_count += part->visible;
        geometry->cells += part->cells;
        vertices += part->vertex_count;
        triangles += part->triangle_count;
    }
    burnish_status status = reserve_clipped(geometry, vertices, triangles, error);
    if (status == BURNISH_STATUS_OK) {
        append_clipped(geometry, part_count);
        cull_clipped(update);
    }
    return status;
}

/* Room for the mesh's vertices and batches, and a part per task. */
static burnish_status reserve_mesh(burnish_geometry *geometry, const burnish_triangles *triangles,
                                   size_t part_count, burnish_error *error) {
    burnish_screen_vertices *screen = &geometry->vertices;
    burnish_memory memory = burnish_memory_of(geometry->context, error);
    const size_t parts = geometry->part_capacity;
    screen->mesh_count = screen->count = triangles->vertex_count;
    geometry->indices = triangles->indices;
    geometry->triangle_count = geometry->clipped_count = 0;
    geometry->cells = 0;
    geometry->mesh_batches =
        (triangles->triangle_count + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    geometry->batch_count = geometry->mesh_batches;
    screen->items =
        burnish_reserve_discard(&memory, screen->items, &screen->item_capacity, screen->count,
                                sizeof *screen->items, "screen vertices");
    screen->inverse_w =
        burnish_reserve_discard(&memory, screen->inverse_w, &screen->inverse_capacity,
                                screen->count, sizeof *screen->inverse_w, "screen vertices");
    geometry->batches =
        burnish_reserve_discard(&memory, geometry->batches, &geometry->batch_capacity,
                                geometry->batch_count, sizeof *geometry->batches, "triangles");
    geometry->headers =
        burnish_reserve_discard(&memory, geometry->headers, &geometry->header_capacity,
                                geometry->batch_count, sizeof *geometry->headers, "triangles");
    geometry->parts = burnish_reserve(&memory, geometry->parts, &geometry->part_capacity,
                                      part_count, sizeof *geometry->parts, "triangles");
    if (geometry->part_capacity > parts) {
        memset(geometry->parts + parts, 0,
               (geometry->part_capacity - parts) * sizeof *geometry->parts);
    }
    return memory.status;
}

burnish_status burnish_geometry_update(burnish_geometry *geometry, const burnish_raster_ops *ops,
                                       const burnish_raster_view *view,
                                       const burnish_triangles *triangles, burnish_tasks *tasks,
                                       burnish_error *error) {
    const size_t grain = BURNISH_TASK_GRAIN;
    const size_t part_count = (triangles->triangle_count + grain - 1) / grain;
    update_context update = {geometry, ops, view, triangles};
    geometry->context = tasks ? tasks->context : NULL;
    burnish_status status = reserve_mesh(geometry, triangles, part_count, error);
    if (!triangles->indices) {
        geometry->points = make_point_view(view, triangles->point_radius);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_run(tasks, (triangles->vertex_count + grain - 1) / grain, 1, 0,
                          transform_task, &update);
        burnish_tasks_run(tasks, part_count, 1, 0, cull_task, &update);
        status = tasks ? burnish_tasks_check(tasks, error) : BURNISH_STATUS_OK;
    }
    return status == BURNISH_STATUS_OK ? join_parts(&update, part_count, error) : status;
}

void burnish_geometry_destroy(burnish_geometry *geometry) {
    for (size_t i = 0; i < geometry->part_capacity; ++i) {
        burnish_release(geometry->context, geometry->parts[i].vertices);
        burnish_release(geometry->context, geometry->parts[i].triangles);
    }
    void *const arrays[] = {geometry->vertices.items, geometry->vertices.inverse_w,
                            geometry->clip_vertices,  geometry->clipped_indices,
                            geometry->clipped_ids,    geometry->batches,
                            geometry->headers,        geometry->parts};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; ++i) {
        burnish_release(geometry->context, arrays[i]);
    }
    memset(geometry, 0, sizeof *geometry);
}
