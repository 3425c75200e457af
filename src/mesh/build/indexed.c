/* Vertices of a mesh that has all normals in its file, and at most one attribute besides: a vertex
 * is a position with a normal and an item of that attribute, found by their numbers in the order of
 * the triangles. vertices.c would find the same by what corners hold, which takes longer. */
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
    const burnish_extra *extra; /* the attribute besides; NULL: none */
    position_head *heads;       /* one per position */
    indexed_vertex *vertices;
    uint32_t *items; /* of each vertex: its number of that attribute */
    size_t count, capacity, item_capacity;
    int has_many; /* 1: a position has many vertices */
} indexer;

static int same_normal(const indexer *x, uint32_t a, uint32_t b) {
    return memcmp(x->normals + 3 * (size_t)a, x->normals + 3 * (size_t)b, 3 * sizeof(float)) == 0;
}

static int same_item(const indexer *x, uint32_t a, uint32_t b) {
    uint8_t first[BURNISH_ATTRIBUTE_BYTES], second[BURNISH_ATTRIBUTE_BYTES];
    if (!x->extra || a == b) {
        return 1;
    }
    const size_t size = burnish_copy_extra(x->extra, a, first);
    burnish_copy_extra(x->extra, b, second);
    return memcmp(first, second, size) == 0;
}

/* Appends a vertex; there is room. It becomes the one that is looked at first. */
static inline uint32_t append_vertex(indexer *x, uint32_t position, uint32_t normal,
                                     uint32_t next) {
    const uint32_t vertex = (uint32_t)x->count++;
    x->vertices[vertex] = (indexed_vertex){position, normal, next};
    x->heads[position] = (position_head){vertex, normal};
    return vertex;
}

/* The vertex of a position where that is not its last one by its numbers: found, or appended; there
 * is room. Returns BURNISH_NONE where the position has many. */
static uint32_t find_vertex(indexer *x, uint32_t position, uint32_t normal, uint32_t item) {
    enum { MANY = 64 };
    const uint32_t last = x->heads[position].vertex;
    uint32_t vertex = last;
    int passed = 0;
    while (vertex != BURNISH_NONE && !(same_normal(x, x->vertices[vertex].normal, normal) &&
                                       same_item(x, x->extra ? x->items[vertex] : 0, item))) {
        vertex = x->vertices[vertex].next;
        ++passed;
    }
    if (vertex != BURNISH_NONE || passed >= MANY) {
        return vertex;
    }
    vertex = append_vertex(x, position, normal, last);
    if (x->extra) {
        x->items[vertex] = item;
    }
    return vertex;
}

/* Room for the vertices of one more triangle. */
static inline int has_room(indexer *x) {
    burnish_memory *memory = x->b->memory;
    if (x->capacity - x->count < 3) {
        x->vertices = burnish_reserve(memory, x->vertices, &x->capacity, x->count + 3,
                                      sizeof *x->vertices, "vertices");
    }
    if (x->extra && x->item_capacity - x->count < 3) {
        x->items = burnish_reserve(memory, x->items, &x->item_capacity, x->count + 3,
                                   sizeof *x->items, "vertices");
    }
    return memory->status == BURNISH_STATUS_OK;
}

/* items NULL: there is no attribute besides. */
static inline __attribute__((always_inline)) void index_range(indexer *x, size_t first, size_t end,
                                                              const uint32_t *items) {
    const uint32_t *positions = x->b->corner_positions;
    const uint32_t *normals = burnish_stream_corners(x->b->data, BURNISH_NORMAL);
    const uint32_t *order = x->b->order;
    const position_head *heads = x->heads;
    uint32_t *indices = x->b->mesh->indices + 3 * first;
    for (size_t i = first; i < end && !x->has_many && has_room(x); ++i) {
        const size_t start = 3 * (size_t)(order ? order[i] : i);
        for (size_t corner = start; corner < start + 3; ++corner) {
            const uint32_t position = positions[corner], normal = normals[corner];
            const uint32_t item = items ? items[corner] : 0;
            const position_head head = heads[position];
            uint32_t vertex = head.vertex;
            if (vertex == BURNISH_NONE) {
                vertex = append_vertex(x, position, normal, BURNISH_NONE);
                if (items) {
                    x->items[vertex] = item;
                }
            } else if (head.normal != normal || (items && x->items[vertex] != item)) {
                vertex = find_vertex(x, position, normal, item);
                x->has_many |= vertex == BURNISH_NONE;
            }
            *indices++ = vertex;
        }
    }
}

/* Numbers the vertices in the order in which the triangles first use them, into the mesh's indices.
 */
static void index_corners(void *context, size_t first, size_t end) {
    const indexer *x = context;
    if (x->extra) {
        index_range(context, first, end, x->extra->corners);
    } else {
        index_range(context, first, end, NULL);
    }
}

static void write_vertices(void *context, size_t first, size_t end) {
    const indexer *x = context;
    const float *positions = burnish_positions(x->b->data);
    void *const *attributes = x->b->mesh->attributes;
    float *to_positions = attributes[BURNISH_POSITION], *to_normals = attributes[BURNISH_NORMAL];
    for (size_t i = first; i < end; ++i) {
        const indexed_vertex *vertex = &x->vertices[i];
        memcpy(to_positions + 3 * i, positions + 3 * (size_t)vertex->position, 3 * sizeof(float));
        memcpy(to_normals + 3 * i, x->normals + 3 * (size_t)vertex->normal, 3 * sizeof(float));
    }
    if (x->extra) {
        const size_t size = burnish_attribute_size(x->extra->attribute);
        uint8_t *to = attributes[x->extra->attribute];
        for (size_t i = first; i < end; ++i) {
            burnish_copy_extra(x->extra, x->items[i], to + size * i);
        }
    }
}

/* Corners go before vertices are made, which take their memory. */
static burnish_status make_vertices(indexer *x) {
    burnish_builder *b = x->b;
    b->vertex_count = x->count;
    burnish_build_release_numbers(b);
    burnish_status status = burnish_build_allocate_vertices(b);
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(b->data->tasks, x->count, BURNISH_BUILD_GRAIN, write_vertices, x);
    }
    return status;
}

burnish_status burnish_build_indexed(burnish_builder *b, int *done) {
    indexer x = {.b = b, .normals = burnish_normals(b->data)};
    *done = 0;
    burnish_build_find_extras(b);
    if (!b->normals_complete || b->extra_count > 1) {
        return BURNISH_STATUS_OK;
    }
    x.extra = b->extra_count > 0 ? b->extras : NULL;
    burnish_build_allocate_indices(b);
    x.heads = burnish_allocate(b->memory, b->position_count, sizeof *x.heads, "vertices");
    x.vertices = burnish_reserve(b->memory, NULL, &x.capacity, b->position_count + 3,
                                 sizeof *x.vertices, "vertices");
    burnish_status status = b->memory->status;
    if (status == BURNISH_STATUS_OK) {
        memset(x.heads, 0xff, b->position_count * sizeof *x.heads);
        burnish_tasks_in_order(b->data->tasks, b->triangle_count, BURNISH_BUILD_STEP, index_corners,
                               &x);
        status = b->memory->status;
    }
    burnish_release(b->memory->context, x.heads);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_tasks_check(b->data->tasks, b->memory->error);
    }
    if (status == BURNISH_STATUS_OK && !x.has_many) {
        *done = 1;
        status = make_vertices(&x);
    }
    burnish_release(b->memory->context, x.vertices);
    burnish_release(b->memory->context, x.items);
    return status;
}
