/* Vertices of a mesh whose file has all normals, and at most one other attribute. A vertex is a
 * position, a normal and an item of that attribute, and is found by their numbers in the order of
 * the triangles. vertices.c finds the same vertices by comparing values, which takes longer.
 *
 * Threads take slices of the triangles, each with vertices of its own. Vertices that no earlier
 * slice has are numbered after the earlier ones, exactly as a single slice would number them. */
#include "mesh/build/builder.h"
#include "mesh/build/vertices.h"

enum { SLICES_MAX = 4 /* each has heads of all positions */ };

/* A vertex: numbers of the welded position and of the file's normal. */
typedef struct indexed_vertex {
    uint32_t position, normal;
    uint32_t next; /* of the same position, or BURNISH_NONE */
} indexed_vertex;

/* The vertex of a position that was found last: mostly the only one. */
typedef struct position_head {
    uint32_t vertex, normal; /* BURNISH_NONE: none yet */
} position_head;

/* A slice of the triangles. */
typedef struct indexer {
    burnish_builder *b;
    burnish_memory memory;
    burnish_error error;
    const float *normals;
    const burnish_extra *extra; /* the attribute besides; NULL: none */
    size_t first, end;          /* triangles */
    position_head *heads;       /* one per position */
    indexed_vertex *vertices;
    uint32_t *items; /* of each vertex: its number of that attribute */
    size_t count, capacity, item_capacity;
    int has_many;        /* 1: a position has many vertices */
    uint32_t *numbers;   /* of each vertex: its number in the mesh; NULL: as in the slice */
    size_t first_number; /* slices before have the numbers below */
} indexer;

/* All slices; the first one's vertices are the mesh's first ones. */
typedef struct indexing {
    indexer slices[SLICES_MAX];
    size_t count;
} indexing;

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

/* The vertex of a position that is not its latest one: found by its numbers, or appended; there is
 * room. Returns BURNISH_NONE if the position has many. */
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
    burnish_memory *memory = &x->memory;
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

/* items NULL: no other attribute. */
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

/* Numbers the slice's vertices in the order in which its triangles first use them, into the mesh's
 * indices. */
static void index_corners(indexer *x, size_t first, size_t end) {
    if (x->extra) {
        index_range(x, first, end, x->extra->corners);
    } else {
        index_range(x, first, end, NULL);
    }
}

static void index_slice(void *context, size_t number, int thread) {
    indexer *x = &((indexing *)context)->slices[number];
    burnish_tasks *tasks = x->b->data->tasks;
    const size_t positions = x->b->position_count;
    x->heads = burnish_allocate(&x->memory, positions, sizeof *x->heads, "vertices");
    x->vertices = burnish_reserve(&x->memory, NULL, &x->capacity,
                                  positions / ((indexing *)context)->count + 3, sizeof *x->vertices,
                                  "vertices");
    if (x->memory.status != BURNISH_STATUS_OK) {
        return;
    }
    memset(x->heads, 0xff, positions * sizeof *x->heads);
    for (size_t i = x->first, end; i < x->end; i = end) {
        end = x->end - i < BURNISH_BUILD_STEP ? x->end : i + BURNISH_BUILD_STEP;
        index_corners(x, i, end);
        if (burnish_tasks_should_end(tasks, thread)) {
            return;
        }
    }
}

/* ---- Slices together ---- */

/* The vertex of a slice that is equal to one of another, or BURNISH_NONE. */
static uint32_t find_equal(const indexer *x, const indexer *other, size_t number) {
    const indexed_vertex *wanted = &other->vertices[number];
    uint32_t vertex = x->heads[wanted->position].vertex;
    while (vertex != BURNISH_NONE &&
           !(same_normal(x, x->vertices[vertex].normal, wanted->normal) &&
             (!x->extra || same_item(x, x->items[vertex], other->items[number])))) {
        vertex = x->vertices[vertex].next;
    }
    return vertex;
}

static uint32_t number_of(const indexer *x, uint32_t vertex) {
    return x->numbers ? x->numbers[vertex] : vertex;
}

/* A slice's vertices get the numbers of equal ones in slices before, whose numbers are known, or
 * BURNISH_NONE. */
static void find_numbers(void *context, size_t first, size_t end) {
    indexer *x = context;
    for (size_t i = first; i < end; ++i) {
        uint32_t number = BURNISH_NONE;
        for (const indexer *before = x; number == BURNISH_NONE && before->first > 0;) {
            const uint32_t vertex = find_equal(--before, x, i);
            number = vertex == BURNISH_NONE ? BURNISH_NONE : number_of(before, vertex);
        }
        x->numbers[i] = number;
    }
}

static void renumber_corners(void *context, size_t first, size_t end) {
    const indexer *x = context;
    uint32_t *indices = x->b->mesh->indices + 3 * x->first;
    for (size_t i = 3 * first; i < 3 * end; ++i) {
        indices[i] = x->numbers[indices[i]];
    }
}

/* Slice by slice: what no slice before has gets the next numbers. */
static burnish_status join_slices(indexing *all) {
    burnish_builder *b = all->slices[0].b;
    burnish_tasks *tasks = b->data->tasks;
    b->vertex_count = all->slices[0].count;
    for (size_t k = 1; k < all->count; ++k) {
        indexer *x = &all->slices[k];
        x->numbers = burnish_allocate(b->memory, x->count, sizeof *x->numbers, "vertices");
        if (!x->numbers) {
            return b->memory->status;
        }
        burnish_tasks_ranges(tasks, x->count, BURNISH_BUILD_GRAIN, find_numbers, x);
        burnish_status status = burnish_tasks_check(tasks, b->memory->error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        x->first_number = b->vertex_count;
        for (size_t i = 0; i < x->count; ++i) {
            if (x->numbers[i] == BURNISH_NONE) {
                x->numbers[i] = (uint32_t)b->vertex_count++;
            }
        }
        burnish_tasks_ranges(tasks, x->end - x->first, BURNISH_BUILD_GRAIN, renumber_corners, x);
    }
    return burnish_tasks_check(tasks, b->memory->error);
}

/* ---- The result ---- */

static void write_vertices(void *context, size_t first, size_t end) {
    const indexer *x = context;
    const float *positions = burnish_positions(x->b->data);
    void *const *attributes = x->b->mesh->attributes;
    float *to_positions = attributes[BURNISH_POSITION], *to_normals = attributes[BURNISH_NORMAL];
    const size_t size = x->extra ? burnish_attribute_size(x->extra->attribute) : 0;
    uint8_t *to_items = x->extra ? attributes[x->extra->attribute] : NULL;
    for (size_t i = first; i < end; ++i) {
        const indexed_vertex *vertex = &x->vertices[i];
        const size_t number = number_of(x, (uint32_t)i);
        if (number < x->first_number) {
            continue;
        }
        memcpy(to_positions + 3 * number, positions + 3 * (size_t)vertex->position,
               3 * sizeof(float));
        memcpy(to_normals + 3 * number, x->normals + 3 * (size_t)vertex->normal, 3 * sizeof(float));
        if (to_items) {
            burnish_copy_extra(x->extra, x->items[i], to_items + size * number);
        }
    }
}

/* Corners go before vertices are made, which take their memory. */
static burnish_status make_vertices(indexing *all) {
    burnish_builder *b = all->slices[0].b;
    burnish_build_release_numbers(b);
    burnish_status status = burnish_build_allocate_vertices(b);
    for (size_t k = 0; k < all->count && status == BURNISH_STATUS_OK; ++k) {
        burnish_tasks_ranges(b->data->tasks, all->slices[k].count, BURNISH_BUILD_GRAIN,
                             write_vertices, &all->slices[k]);
    }
    return status;
}

static void release_heads(indexing *all) {
    for (size_t k = 0; k < all->count; ++k) {
        burnish_release(all->slices[k].memory.context, all->slices[k].heads);
        all->slices[k].heads = NULL;
    }
}

/* One per thread that is worth it; the vertices do not depend on it. */
static void cut_slices(burnish_builder *b, indexing *all) {
    const size_t threads = (size_t)burnish_tasks_threads(b->data->tasks);
    const size_t most = threads < SLICES_MAX ? threads : SLICES_MAX;
    const size_t worth = b->triangle_count / BURNISH_BUILD_GRAIN;
    all->count = worth < 1 ? 1 : worth < most ? worth : most;
    for (size_t k = 0; k < all->count; ++k) {
        indexer *x = &all->slices[k];
        *x = (indexer){.b = b,
                       .normals = burnish_normals(b->data),
                       .extra = b->extra_count > 0 ? b->extras : NULL,
                       .first = k * b->triangle_count / all->count,
                       .end = (k + 1) * b->triangle_count / all->count};
        x->memory = burnish_memory_of(b->memory->context, &x->error);
    }
}

static burnish_status index_slices(burnish_builder *b, indexing *all, int *has_many) {
    burnish_tasks_run(b->data->tasks, all->count, 1, 0, index_slice, all);
    for (size_t k = 0; k < all->count; ++k) {
        burnish_memory_join(b->memory, &all->slices[k].memory);
        *has_many |= all->slices[k].has_many;
    }
    return b->memory->status == BURNISH_STATUS_OK
               ? burnish_tasks_check(b->data->tasks, b->memory->error)
               : b->memory->status;
}

burnish_status burnish_build_indexed(burnish_builder *b, int *done) {
    indexing all;
    int has_many = 0;
    *done = 0;
    burnish_build_find_extras(b);
    if (!b->normals_complete || b->extra_count > 1) {
        return BURNISH_STATUS_OK;
    }
    cut_slices(b, &all);
    burnish_status status = burnish_build_allocate_indices(b);
    if (status == BURNISH_STATUS_OK) {
        status = index_slices(b, &all, &has_many);
    }
    if (status == BURNISH_STATUS_OK && !has_many) {
        *done = 1;
        status = join_slices(&all);
    }
    release_heads(&all);
    if (status == BURNISH_STATUS_OK && *done) {
        status = make_vertices(&all);
    }
    for (size_t k = 0; k < all.count; ++k) {
        burnish_release(b->memory->context, all.slices[k].vertices);
        burnish_release(b->memory->context, all.slices[k].items);
        burnish_release(b->memory->context, all.slices[k].numbers);
    }
    return status;
}
