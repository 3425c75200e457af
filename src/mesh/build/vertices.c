/* Vertices of any mesh: the corners that meet in a position share one if normal, colour and texture
 * coordinates are equal. Normals that the file lacks are generated. Threads take positions.
 * Vertices are then numbered in the order in which triangles first use them, so the result does not
 * depend on the threads. */
#include "mesh/build/vertices.h"
#include "mesh/build/builder.h"
#include "mesh/build/normals/creases.h"
#include "mesh/build/normals/fans.h"
#include "mesh/build/weld.h"

enum {
    POSITIONS_PER_THREAD = BURNISH_BUILD_GRAIN / 2, /* worth a thread */
    POSITIONS_PER_TASK = 512,
    CORNERS_MAX = 512, /* of one position: with more, its rings leave the first-level cache */
    FEW = 16,          /* corners that are compared one by one, ... */
    FEW_NORMALS = 64,  /* ... if they have only a normal */
    PROBES = 8         /* slots that a corner may be in */
};

/* ---- what the two ways to vertices share ---- */

burnish_status burnish_build_allocate_indices(burnish_builder *b) {
    b->mesh->indices =
        burnish_allocate(b->memory, b->triangle_count, 3 * sizeof *b->mesh->indices, "triangles");
    return b->memory->status;
}

burnish_status burnish_build_allocate_vertices(burnish_builder *b) {
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (!b->mesh->attributes[i] &&
            (i < BURNISH_EXTRA_ATTRIBUTES || b->data->streams[i].count > 0)) {
            b->mesh->attributes[i] =
                burnish_allocate(b->memory, b->vertex_count,
                                 burnish_attribute_size((burnish_attribute)i), "vertices");
        }
    }
    return b->memory->status;
}

void burnish_build_find_extras(burnish_builder *b) {
    b->extra_count = 0;
    for (int i = BURNISH_EXTRA_ATTRIBUTES; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (b->data->streams[i].count > 0) {
            b->extras[b->extra_count++] = (burnish_extra){
                (burnish_attribute)i, burnish_stream_corners(b->data, (burnish_attribute)i),
                b->data->streams[i].items};
        }
    }
}

/* The state of a thread that makes vertices. */
typedef struct vertex_maker {
    burnish_builder *b;
    burnish_memory memory;
    burnish_error error;
    burnish_rings rings;
    burnish_fans *fans;
    size_t waiting[BURNISH_PAIRWISE_MAX + 1]; /* positions by their number of faces; 0: more */
    uint32_t positions[BURNISH_PAIRWISE_MAX + 1][BURNISH_FANS];
    uint32_t *corners; /* of the positions with more faces */
    size_t corner_count;
    float *normals;               /* 3 per corner of one position */
    burnish_weld_record *records; /* 1 per corner of one position */
    burnish_later_vertices *later;
    burnish_first_vertices *first; /* of all makers */
} vertex_maker;

/* ---- one position ---- */

static int needs_normal(const burnish_builder *b, const uint32_t *corners, size_t count) {
    for (size_t i = 0; i < count && !b->normals_complete; ++i) {
        if (!burnish_file_normal(b->data, corners[i])) {
            return 1;
        }
    }
    return 0;
}

static void describe_corner(const burnish_builder *b, uint32_t corner, const float *normal,
                            burnish_weld_record *record) {
    size_t used = 3 * sizeof(float);
    *record = (burnish_weld_record){{0}, corner};
    memcpy(record->key, normal, used);
    for (int i = 0; i < b->extra_count; ++i) {
        used += burnish_copy_extra(&b->extras[i], b->extras[i].corners[corner],
                                   (uint8_t *)record->key + used);
    }
}

static int same_vertex(const burnish_weld_record *x, const burnish_weld_record *y) {
    return memcmp(x->key, y->key, sizeof x->key) == 0;
}

/* Makes room for more vertices. */
static int reserve_vertices(vertex_maker *maker, size_t count) {
    burnish_later_vertices *later = maker->later;
    later->items = burnish_reserve(&maker->memory, later->items, &later->capacity,
                                   later->count + count, sizeof *later->items, "vertices");
    return maker->memory.status == BURNISH_STATUS_OK;
}

/* Takes a vertex; there is room. */
static void take_vertex(vertex_maker *maker, uint32_t position, uint32_t first_corner,
                        const void *normal) {
    const burnish_builder *b = maker->b;
    if (first_corner == b->corners[b->first_corner[position]]) {
        memcpy(maker->first->normals + 3 * (size_t)position, normal, 3 * sizeof(float));
        return;
    }
    burnish_later_vertex *vertex = &maker->later->items[maker->later->count++];
    vertex->corner = first_corner;
    vertex->position = position;
    memcpy(vertex->normal, normal, sizeof vertex->normal);
    maker->first->is_split[position] = 1;
}

/* The same for few corners that have only a normal. */
static void number_by_normal(vertex_maker *maker, uint32_t position, const uint32_t *corners,
                             size_t count) {
    uint32_t *to = maker->first->heads;
    uint32_t heads[FEW_NORMALS];
    size_t found = 0;
    for (size_t i = 0; i < count; ++i) {
        const float *normal = maker->normals + 3 * i;
        size_t k = 0;
        while (k < found &&
               memcmp(maker->normals + 3 * heads[k], normal, 3 * sizeof *normal) != 0) {
            ++k;
        }
        if (k == found) {
            heads[found++] = (uint32_t)i;
            take_vertex(maker, position, corners[i], normal);
        }
        to[corners[i]] = corners[heads[k]];
    }
}

/* The seed keeps files from having corners that all get one slot. */
static size_t hash_record(const burnish_weld_record *record, uint64_t seed) {
    for (int i = 0; i < BURNISH_WELD_KEY_WORDS; ++i) {
        seed = (seed ^ record->key[i]) * 0x9e3779b97f4a7c15u;
        seed ^= seed >> 29;
    }
    return (size_t)(seed >> 16);
}

/* Describes corners in maker->records; one that equals a corner before it is mostly left out and
 * refers to that among the heads. Returns how many are left. The table is in the rings, whose
 * normals are made. */
static size_t describe_different(vertex_maker *maker, const uint32_t *corners, size_t count) {
    burnish_weld_record *records = maker->records;
    uint32_t *slots = maker->rings.parents; /* numbers of records; BURNISH_NONE: free */
    size_t size = 1, left = 0;
    while (2 * size <= count) {
        size *= 2;
    }
    memset(slots, 0xff, size * sizeof *slots);
    for (size_t i = 0; i < count; ++i) {
        burnish_weld_record *record = &records[left];
        describe_corner(maker->b, corners[i], maker->normals + 3 * i, record);
        const size_t hash = hash_record(record, (uintptr_t)records);
        uint32_t *slot = &slots[hash & (size - 1)];
        for (size_t k = 1;
             k < PROBES && *slot != BURNISH_NONE && !same_vertex(&records[*slot], record); ++k) {
            slot = &slots[(hash + k) & (size - 1)];
        }
        if (*slot != BURNISH_NONE && same_vertex(&records[*slot], record)) {
            maker->first->heads[corners[i]] = records[*slot].value;
            continue;
        }
        *slot = *slot == BURNISH_NONE ? (uint32_t)left : *slot;
        ++left;
    }
    return left;
}

/* Where many meet, most are equal to others, and fewer are to be sorted. */
static size_t describe_corners(vertex_maker *maker, const uint32_t *corners, size_t count) {
    if (count > CORNERS_MAX) {
        return describe_different(maker, corners, count);
    }
    for (size_t i = 0; i < count; ++i) {
        describe_corner(maker->b, corners[i], maker->normals + 3 * i, &maker->records[i]);
    }
    return count;
}

/* Gives each corner of one position its vertex: corners that have the same share one. */
static void number_corners(vertex_maker *maker, uint32_t position) {
    const burnish_builder *b = maker->b;
    const uint32_t *corners = b->corners + b->first_corner[position];
    const size_t count = b->first_corner[position + (size_t)1] - b->first_corner[position];
    burnish_weld_record *records = maker->records;
    uint32_t *heads = maker->first->heads;
    if (count <= FEW_NORMALS && !b->has_extras) {
        number_by_normal(maker, position, corners, count);
        return;
    }
    const size_t left = describe_corners(maker, corners, count);
    if (left > FEW) {
        burnish_weld_sort(records, left);
    }
    for (size_t i = 0; i < left; ++i) {
        size_t head = left > FEW && i > 0 ? i - 1 : 0;
        while (head < i && !same_vertex(&records[head], &records[i])) {
            ++head;
        }
        heads[records[i].value] = head < i ? heads[records[head].value] : records[i].value;
        if (head == i) {
            take_vertex(maker, position, records[i].value, records[i].key);
        }
    }
    for (size_t i = 0; i < count && left < count; ++i) { /* those left out */
        heads[corners[i]] = heads[heads[corners[i]]];
    }
}

/* All corners of a position have one normal, the first in maker, and nothing else. */
static void share_vertex(vertex_maker *maker, uint32_t position) {
    memcpy(maker->first->normals + 3 * (size_t)position, maker->normals, 3 * sizeof(float));
}

/* Whether all corners have the same normal from the file. */
static int have_one_normal(const burnish_builder *b, const uint32_t *corners, size_t count) {
    const uint32_t *normals = burnish_stream_corners(b->data, BURNISH_NORMAL);
    for (size_t i = 1; i < count; ++i) {
        if (normals[corners[i]] != normals[corners[0]]) {
            return 0;
        }
    }
    return 1;
}

static uint32_t corner_count(const burnish_builder *b, size_t position) {
    return b->first_corner[position + 1] - b->first_corner[position];
}

/* The vertices of one position.
 *   made  maker has generated normals of its corners; 2: they have one, the first */
static void make_position(vertex_maker *maker, uint32_t position, int made) {
    const burnish_builder *b = maker->b;
    const uint32_t *corners = b->corners + b->first_corner[position];
    const size_t count = corner_count(b, position);
    const int has_file_normals = b->data->streams[BURNISH_NORMAL].count > 0;
    if (!reserve_vertices(maker, count)) {
        return;
    }
    if (!made && !b->has_extras && have_one_normal(b, corners, count)) {
        memcpy(maker->normals, burnish_file_normal(b->data, corners[0]), 3 * sizeof(float));
        share_vertex(maker, position);
        return;
    }
    if (made > 1 && !has_file_normals && !b->has_extras) {
        share_vertex(maker, position);
        return;
    }
    for (size_t i = 1; i < count && made > 1; ++i) {
        memcpy(maker->normals + 3 * i, maker->normals, 3 * sizeof(float));
    }
    for (size_t i = 0; i < count && has_file_normals; ++i) {
        const float *normal = burnish_file_normal(b->data, corners[i]);
        if (normal) {
            memcpy(maker->normals + 3 * i, normal, 3 * sizeof(float));
        }
    }
    number_corners(maker, position);
}

/* ---- many positions ---- */

/* The vertices of the positions with so many faces that wait. */
static void make_waiting(vertex_maker *maker, size_t faces) {
    const burnish_builder *b = maker->b;
    const uint32_t *positions = maker->positions[faces];
    uint32_t starts[BURNISH_FANS] = {0};
    const size_t count = maker->waiting[faces];
    const int is_plain = b->data->streams[BURNISH_NORMAL].count == 0 && !b->has_extras;
    maker->waiting[faces] = 0;
    for (size_t i = 0; i < count; ++i) {
        starts[i] = b->first_corner[positions[i]];
    }
    burnish_fans_normals(maker->fans, &maker->rings, starts, count, faces);
    size_t copied = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!maker->fans->is_one[i]) {
            burnish_fans_to_rings(maker->fans, &maker->rings, i, faces, b->corners + starts[i],
                                  copied);
            copied += faces;
        }
    }
    maker->rings.corners = maker->fans->corners;
    copied = 0;
    for (size_t i = 0; i < count && maker->memory.status == BURNISH_STATUS_OK; ++i) {
        int one = (int)maker->fans->is_one[i];
        for (int k = 0; k < 3; ++k) {
            maker->normals[k] = maker->fans->normals[k][i];
        }
        if (one && is_plain) { /* most vertices */
            share_vertex(maker, positions[i]);
            continue;
        }
        if (!one) {
            burnish_neighbors neighbors;
            burnish_fans_neighbors(maker->fans, i, faces, &neighbors);
            one =
                burnish_rings_normals_of(&maker->rings, copied, faces, &neighbors, maker->normals);
            copied += faces;
        }
        make_position(maker, positions[i], 1 + one);
    }
}

/* The same for those with many faces. */
static void make_many_faces(vertex_maker *maker) {
    const size_t count = maker->waiting[0];
    burnish_rings_measure(&maker->rings, maker->corners, maker->corner_count);
    maker->waiting[0] = maker->corner_count = 0;
    for (size_t i = 0, first = 0; i < count; ++i) {
        const uint32_t position = maker->positions[0][i];
        const size_t faces = corner_count(maker->b, position);
        make_position(maker, position,
                      1 + burnish_rings_normals(&maker->rings, first, faces, maker->normals));
        first += faces;
    }
}

/* Makes the vertices of a position, or lets it wait for others. */
static void take_position(vertex_maker *maker, uint32_t position) {
    const burnish_builder *b = maker->b;
    const uint32_t *corners = b->corners + b->first_corner[position];
    const size_t faces = corner_count(b, position);
    if (!needs_normal(b, corners, faces)) {
        make_position(maker, position, 0);
        return;
    }
    const size_t kind = faces <= BURNISH_PAIRWISE_MAX && !maker->rings.flat ? faces : 0;
    if (kind == 0) {
        if (maker->corner_count + faces > maker->rings.capacity) {
            make_many_faces(maker);
        }
        memcpy(maker->corners + maker->corner_count, corners, faces * sizeof *corners);
        maker->corner_count += faces;
    }
    maker->positions[kind][maker->waiting[kind]++] = position;
    if (maker->waiting[kind] == BURNISH_FANS) {
        kind > 0 ? make_waiting(maker, kind) : make_many_faces(maker);
    }
}

/* The vertices of some positions, but for those with more corners than fit the rings. */
static void make_task(void *context, size_t task, int thread) {
    vertex_maker *maker = (vertex_maker *)context + thread;
    const size_t count = maker->b->position_count, first = task * POSITIONS_PER_TASK;
    const size_t end = count - first < POSITIONS_PER_TASK ? count : first + POSITIONS_PER_TASK;
    for (size_t i = first; i < end && maker->memory.status == BURNISH_STATUS_OK; ++i) {
        const size_t corners = corner_count(maker->b, i);
        if (corners > 0 && corners <= maker->rings.capacity) {
            take_position(maker, (uint32_t)i);
        }
    }
}

static void make_rest(vertex_maker *maker) {
    for (size_t faces = 1; faces <= BURNISH_PAIRWISE_MAX; ++faces) {
        if (maker->waiting[faces] > 0 && maker->memory.status == BURNISH_STATUS_OK) {
            make_waiting(maker, faces);
        }
    }
    if (maker->waiting[0] > 0 && maker->memory.status == BURNISH_STATUS_OK) {
        make_many_faces(maker);
    }
}

static void rest_task(void *context, size_t maker, int thread) {
    (void)thread;
    make_rest((vertex_maker *)context + maker);
}

/* ---- makers ---- */

static void destroy_scratch(vertex_maker *maker) {
    const burnish_context *context = maker->memory.context;
    burnish_rings_destroy(&maker->rings, context);
    burnish_release(context, maker->fans);
    burnish_release(context, maker->corners);
    burnish_release(context, maker->normals);
    burnish_release(context, maker->records);
    maker->fans = NULL;
    maker->corners = NULL;
    maker->normals = NULL;
    maker->records = NULL;
}

static void create_scratch(vertex_maker *maker, size_t capacity) {
    const burnish_builder *b = maker->b;
    burnish_rings_create(&maker->rings, capacity, b->crease_angle, &b->surface, b->surface.wide,
                         &maker->memory);
    maker->fans = burnish_allocate(&maker->memory, 1, sizeof *maker->fans, "vertices");
    maker->corners = burnish_allocate(&maker->memory, capacity, sizeof *maker->corners, "vertices");
    maker->normals =
        burnish_allocate(&maker->memory, capacity, 3 * sizeof *maker->normals, "vertices");
    maker->records = burnish_allocate(&maker->memory, capacity, sizeof *maker->records, "vertices");
}

static vertex_maker *create_makers(burnish_builder *b, burnish_first_vertices *first,
                                   burnish_later_vertices *lists, int count) {
    const size_t corners = 3 * b->triangle_count;
    vertex_maker *makers =
        burnish_allocate_zeroed(b->memory, (size_t)count, sizeof *makers, "vertices");
    for (int i = 0; i < count && makers; ++i) {
        makers[i].b = b;
        makers[i].first = first;
        makers[i].later = &lists[i];
        makers[i].memory = burnish_memory_of(b->memory->context, &makers[i].error);
        create_scratch(&makers[i], corners < CORNERS_MAX ? corners : CORNERS_MAX);
        burnish_memory_join(b->memory, &makers[i].memory);
    }
    return makers;
}

/* Positions with more corners than fit: one by one, with rings of their size. */
static void make_large(vertex_maker *maker) {
    const burnish_builder *b = maker->b;
    destroy_scratch(maker);
    create_scratch(maker, b->max_faces);
    for (size_t i = 0; i < b->position_count && maker->memory.status == BURNISH_STATUS_OK; ++i) {
        if (corner_count(b, i) > CORNERS_MAX) {
            take_position(maker, (uint32_t)i);
            make_rest(maker);
        }
    }
}

static burnish_status run_makers(burnish_builder *b, vertex_maker *makers, int count) {
    const size_t tasks = (b->position_count + POSITIONS_PER_TASK - 1) / POSITIONS_PER_TASK;
    burnish_tasks_run(b->data->tasks, tasks, 1, count, make_task, makers);
    burnish_status status = burnish_tasks_check(b->data->tasks, b->memory->error);
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_run(b->data->tasks, (size_t)count, 1, 0, rest_task, makers);
    }
    if (status == BURNISH_STATUS_OK && b->max_faces > CORNERS_MAX) {
        make_large(&makers[0]);
    }
    return status;
}

static burnish_status make_vertices(burnish_builder *b, burnish_first_vertices *first,
                                    burnish_later_vertices *lists, int count) {
    vertex_maker *makers = create_makers(b, first, lists, count);
    burnish_status status = b->memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = run_makers(b, makers, count);
    }
    for (int i = 0; i < count && makers; ++i) {
        burnish_memory_join(b->memory, &makers[i].memory);
        destroy_scratch(&makers[i]);
    }
    burnish_release(b->memory->context, makers);
    return status == BURNISH_STATUS_OK ? b->memory->status : status;
}

/* ---- the result ---- */

static void describe_surface(burnish_builder *b) {
    b->surface = (burnish_surface){.positions = burnish_positions(b->data),
                                   .corner_positions = b->corner_positions,
                                   .first_corner = b->first_corner,
                                   .corners = b->corners,
                                   .wide = b->wide};
    b->surface.is_organic =
        !b->normals_complete && b->crease_angle == BURNISH_CREASE_AUTO &&
        burnish_surface_is_organic(&b->surface, b->position_count, b->data->tasks);
}

static void create_first(burnish_builder *b, burnish_first_vertices *first) {
    first->normals = burnish_allocate(b->memory, b->position_count, 3 * sizeof(float), "vertices");
    first->is_split = burnish_allocate_zeroed(b->memory, b->position_count, 1, "vertices");
    first->heads = b->mesh->indices; /* those of an attempt to find vertices by numbers */
    b->mesh->indices = NULL;
    if (!first->heads) {
        first->heads = burnish_allocate(b->memory, b->triangle_count, BURNISH_TRIPLE, "triangles");
    }
}

static void destroy_first(burnish_builder *b, burnish_first_vertices *first) {
    burnish_release(b->memory->context, first->normals);
    burnish_release(b->memory->context, first->is_split);
    burnish_release(b->memory->context, first->heads);
}

static burnish_status build_any(burnish_builder *b) {
    const size_t worth = b->position_count / POSITIONS_PER_THREAD,
                 all = (size_t)burnish_tasks_threads(b->data->tasks);
    const int count = worth <= 1 ? 1 : (int)(worth < all ? worth : all);
    burnish_status status = burnish_build_list_corners(b);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    describe_surface(b);
    burnish_first_vertices first;
    burnish_later_vertices *lists =
        burnish_allocate_zeroed(b->memory, (size_t)count, sizeof *lists, "vertices");
    burnish_build_find_extras(b);
    create_first(b, &first);
    status = make_vertices(b, &first, lists, count);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_build_write_vertices(b, &first, lists, (size_t)count);
    }
    for (int i = 0; i < count && lists; ++i) {
        burnish_release(b->memory->context, lists[i].items);
    }
    burnish_release(b->memory->context, lists);
    destroy_first(b, &first);
    return status;
}

burnish_status burnish_build_vertices(burnish_builder *b) {
    int done;
    burnish_status status = burnish_build_indexed(b, &done);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_build_move(b, !done);
    }
    return status == BURNISH_STATUS_OK && !done ? build_any(b) : status;
}
