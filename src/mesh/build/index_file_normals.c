/* Vertices of meshes whose file has all normals and nothing else: a vertex is a position with a
 * normal, found by their numbers in the order of the triangles. vertices.c would find the same by
 * what corners hold, which takes longer. */
#include "mesh/build/builder.h"

/* A vertex: numbers of the welded position and of the file's normal. */
typedef struct indexed_vertex {
    uint32_t position, normal;
    uint32_t next; /* of the same position, or BURNISH_NONE */
} indexed_vertex;

/* The vertex of a position that was found last: mostly the only one. */
typedef struct position_head {
    uint32_t vertex, normal; /* BURNISH_NONE: none yet */
} position_head;

typedef struct indexer {
    burnish_builder *b;
    const float *normals;
    position_head *heads; /* one per position */
    indexed_vertex *vertices;
    size_t count, capacity;
} indexer;

static int same_normal(const indexer *x, uint32_t a, uint32_t b) {
    return memcmp(x->normals + 3 * (size_t)a, x->normals + 3 * (size_t)b, 3 * sizeof(float)) == 0;
}

/* The vertex of a position with a normal that is not its last one's: found, or appended. Returns
 * BURNISH_NONE where the position has many, and for want of memory. */
static uint32_t find_vertex(indexer *x, uint32_t position, uint32_t normal) {
    enum { MANY = 16 };
    position_head *head = &x->heads[position];
    uint32_t vertex = head->vertex;
    int passed = 0;
    while (vertex != BURNISH_NONE && !same_normal(x, x->vertices[vertex].normal, normal)) {
        vertex = x->vertices[vertex].next;
        ++passed;
    }
    if (vertex != BURNISH_NONE || passed >= MANY) {
        return vertex;
    }
    if (x->count == x->capacity) {
        x->vertices = burnish_reserve(x->b->memory, x->vertices, &x->capacity, x->count + 1,
                                      sizeof *x->vertices, "vertices");
        if (x->b->memory->status != BURNISH_STATUS_OK) {
            return BURNISH_NONE;
        }
    }
    vertex = (uint32_t)x->count++;
    x->vertices[vertex] = (indexed_vertex){position, normal, head->vertex};
    *head = (position_head){vertex, normal};
    return vertex;
}

/* Numbers the vertices in the order in which the triangles first use them, into the mesh's indices.
 * Returns 0 where a position has many. */
static int number_vertices(indexer *x) {
    const burnish_builder *b = x->b;
    const uint32_t *normals = burnish_stream_corners(b->data, BURNISH_NORMAL);
    uint32_t *indices = b->mesh->indices;
    memset(x->heads, 0xff, b->position_count * sizeof *x->heads);
    for (size_t i = 0; i < 3 * b->triangle_count; ++i) {
        const position_head head = x->heads[b->corner_positions[i]];
        uint32_t vertex = head.vertex;
        if (head.normal != normals[i]) {
            vertex = find_vertex(x, b->corner_positions[i], normals[i]);
            if (vertex == BURNISH_NONE) {
                return 0;
            }
        }
        indices[i] = vertex;
    }
    return 1;
}

static void write_range(void *context, size_t first, size_t end) {
    const indexer *x = context;
    const float *positions = burnish_positions(x->b->data);
    float *to_positions = x->b->mesh->attributes[BURNISH_POSITION];
    float *to_normals = x->b->mesh->attributes[BURNISH_NORMAL];
    for (size_t i = first; i < end; ++i) {
        const indexed_vertex *vertex = &x->vertices[i];
        memcpy(to_positions + 3 * i, positions + 3 * (size_t)vertex->position, 3 * sizeof(float));
        memcpy(to_normals + 3 * i, x->normals + 3 * (size_t)vertex->normal, 3 * sizeof(float));
    }
}

burnish_status burnish_build_index_file_normals(burnish_builder *b, int *done) {
    indexer x = {.b = b, .normals = burnish_normals(b->data)};
    *done = b->normals_complete && !b->has_extras;
    if (!*done) {
        return BURNISH_STATUS_OK;
    }
    x.heads = burnish_allocate(b->memory, b->position_count, sizeof *x.heads, "vertices");
    x.vertices = burnish_reserve(b->memory, NULL, &x.capacity, b->position_count,
                                 sizeof *x.vertices, "vertices");
    *done = b->memory->status == BURNISH_STATUS_OK && number_vertices(&x);
    burnish_release(b->memory->context, x.heads);
    b->vertex_count = x.count;
    if (*done && burnish_build_allocate(b) == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(b->data->tasks, x.count, BURNISH_BUILD_GRAIN, write_range, &x);
    }
    burnish_release(b->memory->context, x.vertices);
    return b->memory->status;
}
