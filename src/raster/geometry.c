/* Vertices to the screen, triangles to oriented, clipped, culled set-up triangles. */
#include <string.h>

#include "base/memory.h"
#include "raster/raster.h"

/* Triangles that one task handles; fixed, so that the result does not depend on threads. */
enum { CHUNK = 1 << 15 };

enum {
    OUT_LEFT = 1,
    OUT_RIGHT = 2,
    OUT_BOTTOM = 4,
    OUT_TOP = 8,
    OUT_NEAR = 16,
    OUT_GUARD = 32,
    OUT_REJECT = OUT_LEFT | OUT_RIGHT | OUT_BOTTOM | OUT_TOP | OUT_NEAR,
    OUT_CLIP = OUT_NEAR | OUT_GUARD
};

/* What a chunk of triangles became; vertex indices of clipped vertices count from the chunk's own.
 */
typedef struct chunk_output {
    burnish_setup_triangle *triangles; /* whole ones, in the chunk's place of the frame's array */
    size_t triangle_count;
    burnish_setup_triangle *pieces; /* of clipped ones */
    size_t piece_count, piece_capacity;
    burnish_clip_vertex *clips;
    burnish_clip_corner *corners; /* parallel to clips */
    size_t clip_count, clip_capacity, corner_capacity;
    burnish_status status;
    burnish_error error;
} chunk_output;

typedef struct setup_context {
    const burnish_raster_view *view;
    const burnish_screen_vertices *vertices;
    const float *positions;
    const uint32_t *indices;
} setup_context;

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

static uint8_t outcode(const burnish_raster_view *view, const float clip[4]) {
    float half_width = (float)view->width * 0.5f * clip[3];
    float half_height = (float)view->height * 0.5f * clip[3];
    float guard = BURNISH_GUARD_BAND * clip[3];
    unsigned code = 0;
    code |= clip[0] < -half_width ? OUT_LEFT : 0;
    code |= clip[0] > half_width ? OUT_RIGHT : 0;
    code |= clip[1] < -half_height ? OUT_BOTTOM : 0;
    code |= clip[1] > half_height ? OUT_TOP : 0;
    code |= clip[2] > clip[3] ? OUT_NEAR : 0;
    code |=
        clip[0] < -guard || clip[0] > guard || clip[1] < -guard || clip[1] > guard ? OUT_GUARD : 0;
    return (uint8_t)code;
}

/* The perspective division of a point that needs no clipping. */
static burnish_screen_vertex project(const burnish_raster_view *view, const float clip[4]) {
    burnish_screen_vertex vertex;
    vertex.inverse_w = 1.0f / clip[3];
    vertex.x = burnish_to_fixed(clip[0] * vertex.inverse_w) + view->width * (BURNISH_SUBPIXELS / 2);
    vertex.y =
        view->height * (BURNISH_SUBPIXELS / 2) - burnish_to_fixed(clip[1] * vertex.inverse_w);
    vertex.depth = clip[2] * vertex.inverse_w;
    return vertex;
}

static void transform_vertices(burnish_screen_vertices *vertices, const burnish_raster_view *view,
                               const float *positions, int threads) {
    (void)threads;
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t i = 0; i < vertices->mesh_count; ++i) {
        float clip[4];
        to_clip_space(view, positions + 3 * i, clip);
        vertices->outcodes[i] = outcode(view, clip);
        if (vertices->outcodes[i] & OUT_CLIP) {
            memset(&vertices->items[i], 0, sizeof vertices->items[i]);
        } else {
            vertices->items[i] = project(view, clip);
        }
    }
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

/* Orients the triangle and finds its tiles; returns 0 when it can't cover a sample. */
static int set_up(const burnish_raster_view *view, const int32_t x[3], const int32_t y[3],
                  uint32_t source, burnish_setup_triangle *triangle) {
    int64_t area = (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(x[2] - x[0]) * (y[1] - y[0]);
    if (area == 0) {
        return 0;
    }
    int64_t x0, x1, y0, y1;
    pixel_range(min3(x[0], x[1], x[2]), max3(x[0], x[1], x[2]), view->samples, &x0, &x1);
    pixel_range(min3(y[0], y[1], y[2]), max3(y[0], y[1], y[2]), view->samples, &y0, &y1);
    x0 = x0 < 0 ? 0 : x0;
    y0 = y0 < 0 ? 0 : y0;
    x1 = x1 >= view->width ? view->width - 1 : x1;
    y1 = y1 >= view->height ? view->height - 1 : y1;
    if (x0 > x1 || y0 > y1) {
        return 0;
    }
    triangle->source = source * 2 + (area > 0);
    if (area < 0) { /* y points down: this is a front face */
        uint32_t swap = triangle->vertices[1];
        triangle->vertices[1] = triangle->vertices[2];
        triangle->vertices[2] = swap;
    }
    triangle->tiles[0] = (uint8_t)(x0 / BURNISH_TILE_SIZE);
    triangle->tiles[1] = (uint8_t)(y0 / BURNISH_TILE_SIZE);
    triangle->tiles[2] = (uint8_t)(x1 / BURNISH_TILE_SIZE);
    triangle->tiles[3] = (uint8_t)(y1 / BURNISH_TILE_SIZE);
    return 1;
}

static burnish_status append_piece(chunk_output *output, const burnish_setup_triangle *triangle) {
    burnish_status status =
        burnish_grow((void **)&output->pieces, &output->piece_capacity, output->piece_count + 1,
                     sizeof *triangle, "clipped triangles", &output->error);
    if (status == BURNISH_STATUS_OK) {
        output->pieces[output->piece_count++] = *triangle;
    }
    return status;
}

/* Cuts the triangle and appends what is left as a fan. The new vertices are numbered from
 * mesh_count + the chunk's own count; burnish_geometry_create adds the chunk's place. */
static burnish_status append_clipped(const setup_context *context, uint32_t source,
                                     chunk_output *output) {
    burnish_clip_corner corners[BURNISH_CLIP_MAX];
    for (int i = 0; i < 3; ++i) {
        uint32_t vertex = context->indices[3 * (size_t)source + i];
        to_clip_space(context->view, context->positions + 3 * (size_t)vertex, corners[i].position);
        for (int j = 0; j < 3; ++j) {
            corners[i].weights[j] = i == j;
        }
    }
    int count = burnish_clip_triangle(corners);
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    size_t first = output->clip_count;
    burnish_status status =
        burnish_grow((void **)&output->clips, &output->clip_capacity, first + count,
                     sizeof *output->clips, "clipped vertices", &output->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_grow((void **)&output->corners, &output->corner_capacity, first + count,
                              sizeof *output->corners, "clipped vertices", &output->error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    int32_t x[BURNISH_CLIP_MAX], y[BURNISH_CLIP_MAX];
    for (int i = 0; i < count; ++i) {
        burnish_screen_vertex vertex = project(context->view, corners[i].position);
        x[i] = vertex.x;
        y[i] = vertex.y;
        burnish_clip_vertex clip = {source, {0}};
        memcpy(clip.weights, corners[i].weights, sizeof clip.weights);
        output->clips[first + i] = clip;
        output->corners[first + i] = corners[i];
    }
    output->clip_count = first + count;
    for (int i = 1; i + 1 < count && status == BURNISH_STATUS_OK; ++i) {
        uint32_t base = (uint32_t)(context->vertices->mesh_count + first);
        burnish_setup_triangle triangle = {
            {base, base + (uint32_t)i, base + (uint32_t)i + 1}, 0, {0}};
        const int32_t tx[3] = {x[0], x[i], x[i + 1]}, ty[3] = {y[0], y[i], y[i + 1]};
        if (set_up(context->view, tx, ty, source, &triangle)) {
            status = append_piece(output, &triangle);
        }
    }
    return status;
}

static burnish_status set_up_chunk(const setup_context *context, size_t first, size_t end,
                                   chunk_output *output) {
    const burnish_screen_vertices *vertices = context->vertices;
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = first; i < end && status == BURNISH_STATUS_OK; ++i) {
        burnish_setup_triangle triangle = {{0}, 0, {0}};
        memcpy(triangle.vertices, context->indices + 3 * i, sizeof triangle.vertices);
        const uint32_t *v = triangle.vertices;
        unsigned a = vertices->outcodes[v[0]], b = vertices->outcodes[v[1]],
                 c = vertices->outcodes[v[2]];
        if (a & b & c & OUT_REJECT) {
            continue;
        }
        if ((a | b | c) & OUT_CLIP) {
            status = append_clipped(context, (uint32_t)i, output);
            continue;
        }
        const burnish_screen_vertex *items = vertices->items;
        const int32_t x[3] = {items[v[0]].x, items[v[1]].x, items[v[2]].x};
        const int32_t y[3] = {items[v[0]].y, items[v[1]].y, items[v[2]].y};
        if (set_up(context->view, x, y, (uint32_t)i, &triangle)) {
            output->triangles[output->triangle_count++] = triangle;
        }
    }
    return status;
}

static burnish_status grow_vertices(burnish_screen_vertices *vertices, size_t extra,
                                    burnish_error *error) {
    size_t count = vertices->mesh_count + extra;
    if (count >= BURNISH_NO_TRIANGLE) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "clipping makes more than 2^32 vertices; split the mesh");
    }
    size_t capacity = vertices->mesh_count;
    return burnish_grow((void **)&vertices->items, &capacity, count, sizeof *vertices->items,
                        "screen vertices", error);
}

/* Moves the chunks' triangles together and appends the pieces of clipped ones behind them. */
static burnish_status join_triangles(burnish_geometry *geometry, const chunk_output *chunks,
                                     size_t chunk_count, size_t capacity, burnish_error *error) {
    size_t pieces = 0, clip_base = 0;
    for (size_t i = 0; i < chunk_count; ++i) {
        burnish_setup_triangle *to = geometry->triangles + geometry->triangle_count;
        if (to != chunks[i].triangles) {
            memmove(to, chunks[i].triangles, chunks[i].triangle_count * sizeof *to);
        }
        geometry->triangle_count += chunks[i].triangle_count;
        pieces += chunks[i].piece_count;
    }
    if (pieces == 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_grow((void **)&geometry->triangles, &capacity, geometry->triangle_count + pieces,
                     sizeof *geometry->triangles, "triangles", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < chunk_count; ++i) {
        for (size_t j = 0; j < chunks[i].piece_count; ++j) {
            burnish_setup_triangle piece = chunks[i].pieces[j];
            for (int k = 0; k < 3; ++k) {
                piece.vertices[k] += (uint32_t)clip_base;
            }
            geometry->triangles[geometry->triangle_count++] = piece;
        }
        clip_base += chunks[i].clip_count;
    }
    return BURNISH_STATUS_OK;
}

/* Joins the chunks in their order; the clipped vertices move behind the mesh's. */
static burnish_status join_chunks(burnish_geometry *geometry, const burnish_raster_view *view,
                                  const chunk_output *chunks, size_t chunk_count, size_t capacity,
                                  burnish_error *error) {
    burnish_screen_vertices *vertices = &geometry->vertices;
    size_t clips = 0, clip_base = 0;
    for (size_t i = 0; i < chunk_count; ++i) {
        clips += chunks[i].clip_count;
    }
    burnish_status status = join_triangles(geometry, chunks, chunk_count, capacity, error);
    if (status == BURNISH_STATUS_OK && clips > 0) {
        status = burnish_allocate((void **)&geometry->clip_vertices, clips,
                                  sizeof *geometry->clip_vertices, "clipped vertices", error);
        if (status == BURNISH_STATUS_OK) {
            status = grow_vertices(vertices, clips, error);
        }
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < chunk_count; ++i) {
        const chunk_output *chunk = &chunks[i];
        for (size_t j = 0; j < chunk->clip_count; ++j) {
            size_t place = clip_base + j;
            geometry->clip_vertices[place] = chunk->clips[j];
            vertices->items[vertices->mesh_count + place] =
                project(view, chunk->corners[j].position);
        }
        clip_base += chunk->clip_count;
    }
    vertices->count = vertices->mesh_count + clip_base;
    return BURNISH_STATUS_OK;
}

static burnish_status allocate_vertices(burnish_screen_vertices *vertices, size_t count,
                                        burnish_error *error) {
    vertices->mesh_count = vertices->count = count;
    burnish_status status = burnish_allocate((void **)&vertices->items, count,
                                             sizeof *vertices->items, "screen vertices", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&vertices->outcodes, count, 1, "screen vertices", error);
    }
    return status;
}

static burnish_status set_up_triangles(burnish_geometry *geometry, const setup_context *context,
                                       size_t triangle_count, int threads, burnish_error *error) {
    (void)threads;
    size_t chunk_count = (triangle_count + CHUNK - 1) / CHUNK;
    chunk_output *chunks = calloc(chunk_count ? chunk_count : 1, sizeof *chunks);
    if (!chunks) {
        return burnish_fail_memory(error, "triangle chunks", chunk_count * sizeof *chunks);
    }
    burnish_status status = burnish_allocate((void **)&geometry->triangles, triangle_count,
                                             sizeof *geometry->triangles, "triangles", error);
    if (status != BURNISH_STATUS_OK) {
        free(chunks);
        return status;
    }
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (size_t i = 0; i < chunk_count; ++i) {
        size_t end = (i + 1) * CHUNK;
        chunks[i].triangles = geometry->triangles + i * CHUNK;
        chunks[i].status = set_up_chunk(context, i * CHUNK,
                                        end < triangle_count ? end : triangle_count, &chunks[i]);
    }
    for (size_t i = 0; i < chunk_count && status == BURNISH_STATUS_OK; ++i) {
        status = chunks[i].status;
        if (status != BURNISH_STATUS_OK && error) {
            *error = chunks[i].error;
        }
    }
    if (status == BURNISH_STATUS_OK) {
        status = join_chunks(geometry, context->view, chunks, chunk_count, triangle_count, error);
    }
    for (size_t i = 0; i < chunk_count; ++i) {
        free(chunks[i].pieces);
        free(chunks[i].clips);
        free(chunks[i].corners);
    }
    free(chunks);
    return status;
}

burnish_status burnish_geometry_create(burnish_geometry *geometry, const burnish_raster_view *view,
                                       const float *positions, size_t vertex_count,
                                       const uint32_t *indices, size_t triangle_count, int threads,
                                       burnish_error *error) {
    memset(geometry, 0, sizeof *geometry);
    burnish_status status = allocate_vertices(&geometry->vertices, vertex_count, error);
    if (status == BURNISH_STATUS_OK) {
        setup_context context = {view, &geometry->vertices, positions, indices};
        transform_vertices(&geometry->vertices, view, positions, threads);
        status = set_up_triangles(geometry, &context, triangle_count, threads, error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_geometry_destroy(geometry);
    }
    return status;
}

void burnish_geometry_destroy(burnish_geometry *geometry) {
    free(geometry->vertices.items);
    free(geometry->vertices.outcodes);
    free(geometry->clip_vertices);
    free(geometry->triangles);
    memset(geometry, 0, sizeof *geometry);
}
