/* Vertices to the screen, triangles to oriented, clipped, culled set-up triangles: by the tiers, a
 * chunk after another; clipped and large triangles are set up here, one at a time. */
#include <string.h>

#include "core/memory.h"
#include "raster/raster.h"
#include "simd/isa_ops.h"

/* A piece of a clipped triangle; vertices count from the chunk's own clipped ones. */
typedef struct clipped_piece {
    burnish_triangle_bounds triangle;
    burnish_primitive corners;
} clipped_piece;

static void put_lane(burnish_triangle_batch *block, size_t lane, burnish_triangle_bounds triangle) {
    block->nearest[lane] = triangle.nearest;
    block->first[lane] = triangle.first;
    block->last[lane] = triangle.last;
}

/* A vertex that clipping made, on the screen and in the mesh. */
typedef struct clipped_vertex {
    burnish_screen_vertex at;
    float inverse_w;
    burnish_clip_vertex clip;
} clipped_vertex;

/* What a chunk of triangles became besides its slots. */
typedef struct chunk_output {
    size_t triangle_count;
    clipped_piece *pieces;
    size_t piece_count, piece_capacity;
    clipped_vertex *clips;
    size_t clip_count, clip_capacity;
    burnish_status status;
    burnish_error error;
} chunk_output;

int32_t burnish_to_fixed(float pixels) {
    const float rounder = 12582912.0f; /* 1.5 * 2^23: adding it leaves no fraction bits */
    float sum = pixels * (float)BURNISH_SUBPIXELS + rounder;
    return (int32_t)(sum - rounder);
}

static void to_clip_space(const burnish_raster_view *view, const float p[3], float clip[4]) {
    float x = p[0] - view->origin[0], y = p[1] - view->origin[1], z = p[2] - view->origin[2];
    for (int i = 0; i < 4; ++i) {
        const float *row = view->rows[i];
        clip[i] = ((row[0] * x + row[1] * y) + row[2] * z) + row[3];
    }
}

/* The perspective division of a point that needs no clipping. */
static burnish_screen_vertex project(const burnish_raster_view *view, const float clip[4],
                                     float *inverse_w) {
    burnish_screen_vertex vertex;
    *inverse_w = 1.0f / clip[3];
    vertex.x = burnish_to_fixed(clip[0] * *inverse_w) + view->width * (BURNISH_SUBPIXELS / 2);
    vertex.y = view->height * (BURNISH_SUBPIXELS / 2) - burnish_to_fixed(clip[1] * *inverse_w);
    vertex.depth = clip[2] * *inverse_w;
    vertex.outcode = 0;
    return vertex;
}

/* What the tasks of burnish_geometry_update share. */
typedef struct chunk_context {
    burnish_geometry *geometry;
    const burnish_isa_ops *ops;
    const burnish_raster_view *view;
    const float *positions;
    size_t triangle_count; /* of the mesh */
    struct chunk_output *chunks;
} chunk_context;

static void transform_chunk(void *of, size_t index, int thread) {
    const chunk_context *context = of;
    burnish_screen_vertices *vertices = &context->geometry->vertices;
    const size_t first = index * BURNISH_TASK_GRAIN, end = first + BURNISH_TASK_GRAIN;
    (void)thread;
    context->ops->transform_vertices(vertices, context->view, context->positions, first,
                                     end < vertices->mesh_count ? end : vertices->mesh_count);
}

static int64_t min3(int64_t a, int64_t b, int64_t c) {
    int64_t d = a < b ? a : b;
    return d < c ? d : c;
}

static int64_t max3(int64_t a, int64_t b, int64_t c) {
    int64_t d = a > b ? a : b;
    return d > c ? d : c;
}

/* First and last pixel along one axis whose samples can lie in [low, high] (1/256 pixel). */
static void pixel_range(int64_t low, int64_t high, int samples, int64_t *first, int64_t *last) {
    int64_t to_first = samples == 1 ? BURNISH_SUBPIXELS / 2 - 1 : 0;
    int64_t to_last = samples == 1 ? BURNISH_SUBPIXELS / 2 : 0;
    *first = (low + to_first) >> 8;
    *last = (high - to_last) >> 8;
}

/* Finds the side that is seen and the coarse blocks; returns 0 when it can't cover a sample. */
static int set_up(const burnish_raster_view *view, const burnish_screen_vertex v[3],
                  burnish_triangle_bounds *triangle, unsigned *back) {
    int64_t area = (int64_t)(v[1].x - v[0].x) * (v[2].y - v[0].y) -
                   (int64_t)(v[2].x - v[0].x) * (v[1].y - v[0].y);
    if (area == 0 || (view->cull_back_faces && area > 0)) {
        return 0;
    }
    int64_t x0, x1, y0, y1;
    pixel_range(min3(v[0].x, v[1].x, v[2].x), max3(v[0].x, v[1].x, v[2].x), view->samples, &x0,
                &x1);
    pixel_range(min3(v[0].y, v[1].y, v[2].y), max3(v[0].y, v[1].y, v[2].y), view->samples, &y0,
                &y1);
    x0 = x0 < 0 ? 0 : x0;
    y0 = y0 < 0 ? 0 : y0;
    x1 = x1 >= view->width ? view->width - 1 : x1;
    y1 = y1 >= view->height ? view->height - 1 : y1;
    if (x0 > x1 || y0 > y1) {
        return 0;
    }
    float nearest = v[0].depth > v[1].depth ? v[0].depth : v[1].depth;
    triangle->nearest = nearest > v[2].depth ? nearest : v[2].depth;
    triangle->first = (uint32_t)(x0 / BURNISH_HIZ_PIXELS | y0 / BURNISH_HIZ_PIXELS << 16);
    triangle->last = (uint32_t)(x1 / BURNISH_HIZ_PIXELS | y1 / BURNISH_HIZ_PIXELS << 16);
    *back = area > 0;
    return 1;
}

static burnish_status append_piece(chunk_output *output, const clipped_piece *piece) {
    burnish_status status = burnish_legacy_reserve(
        (void **)&output->pieces, &output->piece_capacity, output->piece_count + 1, sizeof *piece,
        "clipped triangles", &output->error);
    if (status == BURNISH_STATUS_OK) {
        output->pieces[output->piece_count++] = *piece;
    }
    return status;
}

/* Cuts the triangle and appends what is left as a fan. The new vertices are numbered from
 * mesh_count + the chunk's own count; join_pieces adds the chunk's place. */
static burnish_status append_clipped(const chunk_context *context, uint32_t source,
                                     chunk_output *output) {
    burnish_clip_corner corners[BURNISH_CLIP_MAX];
    for (int i = 0; i < 3; ++i) {
        uint32_t vertex = context->geometry->indices[3 * (size_t)source + i];
        to_clip_space(context->view, context->positions + 3 * (size_t)vertex, corners[i].position);
        for (int j = 0; j < 3; ++j) {
            corners[i].weights[j] = i == j;
        }
    }
    int count = burnish_clip_triangle(corners);
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    const size_t first = output->clip_count;
    burnish_status status =
        burnish_legacy_reserve((void **)&output->clips, &output->clip_capacity, first + count,
                               sizeof *output->clips, "clipped vertices", &output->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    clipped_vertex *made = output->clips + first;
    for (int i = 0; i < count; ++i) {
        made[i].at = project(context->view, corners[i].position, &made[i].inverse_w);
        made[i].clip.triangle = source;
        memcpy(made[i].clip.weights, corners[i].weights, sizeof made[i].clip.weights);
    }
    output->clip_count = first + count;
    for (int i = 1; i + 1 < count && status == BURNISH_STATUS_OK; ++i) {
        const uint32_t base = (uint32_t)(context->geometry->vertices.mesh_count + first),
                       a = base + i;
        const burnish_screen_vertex v[3] = {made[0].at, made[i].at, made[i + 1].at};
        clipped_piece piece;
        unsigned back;
        if (set_up(context->view, v, &piece.triangle, &back)) {
            piece.corners = (burnish_primitive){{base, a + 1 - back, a + back}, 2 * source + back};
            status = append_piece(output, &piece);
        }
    }
    return status;
}

/* A triangle that the tier leaves to us: clipped or large. */
static burnish_status set_up_other(const chunk_context *context, size_t triangle,
                                   burnish_triangle_batch *block, burnish_batch_header *header,
                                   chunk_output *output) {
    const size_t lane = triangle % BURNISH_BATCH_SIZE;
    burnish_screen_vertex v[3];
    burnish_triangle_bounds made;
    unsigned outcodes = 0, back;
    for (size_t i = 0; i < 3; ++i) {
        v[i] = context->geometry->vertices.items[context->geometry->indices[3 * triangle + i]];
        outcodes |= v[i].outcode;
    }
    if (outcodes & BURNISH_OUT_CLIP) {
        return append_clipped(context, (uint32_t)triangle, output);
    }
    if (set_up(context->view, v, &made, &back)) {
        put_lane(block, lane, made);
        header->visible[back] |= (uint16_t)(1u << lane);
        header->tile = BURNISH_NO_TILE; /* it hardly fits one */
        ++output->triangle_count;
    }
    return BURNISH_STATUS_OK;
}

/* Sets up the mesh's triangles [first, end); a chunk begins with a block. */
static burnish_status set_up_chunk(const chunk_context *context, size_t first, size_t end,
                                   chunk_output *output) {
    burnish_geometry *geometry = context->geometry;
    for (size_t at = first; at < end; at += BURNISH_BATCH_SIZE) {
        const size_t count = end - at < BURNISH_BATCH_SIZE ? end - at : BURNISH_BATCH_SIZE;
        burnish_triangle_batch *block = &geometry->batches[at / BURNISH_BATCH_SIZE];
        burnish_batch_header *header = &geometry->headers[at / BURNISH_BATCH_SIZE];
        unsigned others;
        output->triangle_count += (size_t)context->ops->cull_and_bound(
            &geometry->vertices, context->view, geometry->indices, at, count, block, header,
            &others);
        for (; others; others &= others - 1) { /* hardly ever */
            burnish_status status =
                set_up_other(context, at + (size_t)__builtin_ctz(others), block, header, output);
            if (status != BURNISH_STATUS_OK) {
                return status;
            }
        }
    }
    return BURNISH_STATUS_OK;
}

/* Makes room behind the mesh's vertices; all of them are there already. */
static burnish_status grow_vertices(burnish_screen_vertices *vertices, size_t extra,
                                    burnish_error *error) {
    size_t count = vertices->mesh_count + extra;
    if (count >= BURNISH_NO_TRIANGLE) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "clipping makes more than 2^32 vertices; split the mesh");
    }
    burnish_status status =
        burnish_legacy_reserve((void **)&vertices->items, &vertices->item_capacity, count,
                               sizeof *vertices->items, "screen vertices", error);
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_legacy_reserve((void **)&vertices->inverse_w, &vertices->inverse_capacity,
                                   count, sizeof *vertices->inverse_w, "screen vertices", error);
    }
    vertices->count = count;
    return status;
}

/* Makes room for the pieces of clipped triangles and their vertices. */
static burnish_status reserve_pieces(burnish_geometry *geometry, size_t pieces, size_t clips,
                                     burnish_error *error) {
    const size_t blocks = (pieces + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    geometry->batch_count = geometry->mesh_batches + blocks;
    burnish_status status = burnish_legacy_reserve((void **)&geometry->batches,
                                                   &geometry->batch_capacity, geometry->batch_count,
                                                   sizeof *geometry->batches, "triangles", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve((void **)&geometry->headers, &geometry->header_capacity,
                                        geometry->batch_count, sizeof *geometry->headers,
                                        "triangles", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve_discard(
            (void **)&geometry->pieces, &geometry->piece_capacity, pieces, sizeof *geometry->pieces,
            "clipped triangles", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve_discard(
            (void **)&geometry->clip_vertices, &geometry->clip_capacity, clips,
            sizeof *geometry->clip_vertices, "clipped vertices", error);
    }
    return status == BURNISH_STATUS_OK ? grow_vertices(&geometry->vertices, clips, error) : status;
}

static void add_piece(burnish_geometry *geometry, const clipped_piece *piece, size_t clip_base) {
    const size_t number = geometry->piece_count++, lane = number % BURNISH_BATCH_SIZE;
    const size_t block = geometry->mesh_batches + number / BURNISH_BATCH_SIZE;
    burnish_batch_header *header = &geometry->headers[block];
    burnish_primitive *corners = &geometry->pieces[number];
    *corners = piece->corners;
    for (int i = 0; i < 3; ++i) {
        corners->vertices[i] += (uint32_t)clip_base;
    }
    if (lane == 0) {
        *header = (burnish_batch_header){{0, 0}, BURNISH_NO_TILE};
    }
    put_lane(&geometry->batches[block], lane, piece->triangle);
    header->visible[corners->id_and_facing & 1] |= (uint16_t)(1u << lane);
}

/* Appends the pieces of clipped triangles and their vertices in the order of the chunks. */
static burnish_status join_pieces(burnish_geometry *geometry, const chunk_output *chunks,
                                  size_t chunk_count, size_t pieces, size_t clips,
                                  burnish_error *error) {
    burnish_screen_vertices *vertices = &geometry->vertices;
    burnish_status status = reserve_pieces(geometry, pieces, clips, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    size_t clip_base = 0;
    for (size_t i = 0; i < chunk_count; ++i) {
        const chunk_output *chunk = &chunks[i];
        for (size_t j = 0; j < chunk->clip_count; ++j) {
            const size_t place = clip_base + j, vertex = vertices->mesh_count + place;
            geometry->clip_vertices[place] = chunk->clips[j].clip;
            vertices->items[vertex] = chunk->clips[j].at;
            vertices->inverse_w[vertex] = chunk->clips[j].inverse_w;
        }
        for (size_t j = 0; j < chunk->piece_count; ++j) {
            add_piece(geometry, &chunk->pieces[j], clip_base);
        }
        clip_base += chunk->clip_count;
    }
    geometry->triangle_count += geometry->piece_count;
    return BURNISH_STATUS_OK;
}

static burnish_status join_chunks(burnish_geometry *geometry, const chunk_output *chunks,
                                  size_t chunk_count, burnish_error *error) {
    size_t pieces = 0, clips = 0;
    for (size_t i = 0; i < chunk_count; ++i) {
        if (chunks[i].status != BURNISH_STATUS_OK) {
            if (error) {
                *error = chunks[i].error;
            }
            return chunks[i].status;
        }
        geometry->triangle_count += chunks[i].triangle_count;
        pieces += chunks[i].piece_count;
        clips += chunks[i].clip_count;
    }
    return clips > 0 ? join_pieces(geometry, chunks, chunk_count, pieces, clips, error)
                     : BURNISH_STATUS_OK;
}

static burnish_status allocate(burnish_geometry *geometry, size_t vertex_count,
                               size_t triangle_count, burnish_error *error) {
    burnish_screen_vertices *vertices = &geometry->vertices;
    vertices->mesh_count = vertices->count = vertex_count;
    geometry->mesh_batches = (triangle_count + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    geometry->batch_count = geometry->mesh_batches;
    geometry->piece_count = geometry->triangle_count = 0;
    burnish_status status = burnish_legacy_reserve_discard(
        (void **)&vertices->items, &vertices->item_capacity, vertex_count, sizeof *vertices->items,
        "screen vertices", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve_discard(
            (void **)&vertices->inverse_w, &vertices->inverse_capacity, vertex_count,
            sizeof *vertices->inverse_w, "screen vertices", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve_discard((void **)&geometry->batches,
                                                &geometry->batch_capacity, geometry->mesh_batches,
                                                sizeof *geometry->batches, "triangles", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_reserve_discard((void **)&geometry->headers,
                                                &geometry->header_capacity, geometry->mesh_batches,
                                                sizeof *geometry->headers, "triangles", error);
    }
    return status;
}

static void set_up_task(void *of, size_t index, int thread) {
    const chunk_context *context = of;
    const size_t first = index * BURNISH_TASK_GRAIN, rest = context->triangle_count - first;
    chunk_output *output = &context->chunks[index];
    (void)thread;
    output->status = set_up_chunk(
        context, first, first + (rest < BURNISH_TASK_GRAIN ? rest : BURNISH_TASK_GRAIN), output);
}

static burnish_status set_up_all(chunk_context *context, burnish_tasks *pool,
                                 burnish_error *error) {
    const size_t count = (context->triangle_count + BURNISH_TASK_GRAIN - 1) / BURNISH_TASK_GRAIN;
    chunk_output *chunks = calloc(count ? count : 1, sizeof *chunks);
    if (!chunks) {
        return burnish_fail_memory(error, "triangle chunks", count * sizeof *chunks);
    }
    context->chunks = chunks;
    burnish_tasks_run(pool, count, 1, 0, set_up_task, context);
    burnish_status status = join_chunks(context->geometry, chunks, count, error);
    for (size_t i = 0; i < count; ++i) {
        free(chunks[i].pieces);
        free(chunks[i].clips);
    }
    free(chunks);
    return status;
}

burnish_status burnish_geometry_update(burnish_geometry *geometry, const burnish_isa_ops *ops,
                                       const burnish_raster_view *view, const float *positions,
                                       size_t vertex_count, const uint32_t *indices,
                                       size_t triangle_count, burnish_tasks *pool,
                                       burnish_error *error) {
    burnish_status status = allocate(geometry, vertex_count, triangle_count, error);
    if (status == BURNISH_STATUS_OK) {
        chunk_context context = {geometry, ops, view, positions, triangle_count, NULL};
        geometry->indices = indices;
        burnish_tasks_run(pool, (vertex_count + BURNISH_TASK_GRAIN - 1) / BURNISH_TASK_GRAIN, 1, 0,
                          transform_chunk, &context);
        status = set_up_all(&context, pool, error);
    }
    return status;
}

void burnish_geometry_destroy(burnish_geometry *geometry) {
    free(geometry->vertices.items);
    free(geometry->vertices.inverse_w);
    free(geometry->clip_vertices);
    free(geometry->batches);
    free(geometry->headers);
    free(geometry->pieces);
    memset(geometry, 0, sizeof *geometry);
}
