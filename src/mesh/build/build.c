/* From what a reader hands over to a scene: drop, weld, order, orient, make normals, number
 * vertices.
 *
 * The triangles of larger meshes are ordered in space, so that sixteen neighbours mostly fall into
 * one tile and share vertices. meshoptimizer's vertex cache order is left out on purpose: it helps
 * hardware that transforms a vertex once per use, burnish transforms each once, and its cost is
 * quadratic in the faces around a vertex (a fan of 80,000 takes 5 s, version 0.18). */
#include <stdatomic.h>
#include <string.h>

#include "core/tasks.h"
#include "mesh/build/normals.h"
#include "mesh/build/order.h"
#include "mesh/build/weld.h"
#include "mesh/mesh.h"
#include "mesh/mesh_data.h"
#include "mesh/read/text.h"

enum {
    SHARE = 8192,           /* triangles, positions or vertices that are worth a thread */
    POSITIONS_A_TURN = 512, /* that a thread takes at a time */
    CORNERS_AT_ONCE = 512   /* measured together; the fan's arrays stay in the first-level cache */
};

/* One vertex of the result while they are collected. */
typedef struct built_vertex {
    uint32_t corner;   /* the first one that uses it */
    uint32_t position; /* number of the welded position */
    float normal[3];
    uint32_t color; /* the four bytes */
} built_vertex;

/* What one thread makes vertices with. */
typedef struct vertex_maker {
    burnish_fan fan;
    float *normals;               /* 3 a corner of one position */
    burnish_weld_record *records; /* 1 a corner of one position */
    built_vertex *vertices;
    size_t count, capacity;
    burnish_status status;
    burnish_error error;
} vertex_maker;

typedef struct builder {
    burnish_mesh_data *data;
    const char *name;
    burnish_error *error;
    burnish_mesh *scene;

    size_t position_count;     /* welded positions, at the head of the positions */
    size_t triangle_count;     /* triangles with area, at the head of the data's arrays */
    uint32_t *corner_vertices; /* 3 a triangle: welded positions */

    uint32_t *first_corner; /* position_count + 1: where a position's corners start in ... */
    uint32_t *corners;      /* ... all corners, by position */
    size_t max_faces;       /* around one position */
    int has_colors;
    int normals_complete; /* every corner has a normal of the file's */

    vertex_maker *makers;
    int maker_count;
    size_t vertex_count;
} builder;

/* Moves the different positions to the head of the array; remap gives each old one its new number.
 */
static burnish_status weld_positions(builder *b, uint32_t **remap) {
    burnish_mesh_data *data = b->data;
    for (size_t i = 0; i < 3 * data->streams[BURNISH_POSITION].count; ++i) {
        burnish_positions(data)[i] += 0.0f; /* -0 becomes 0 */
    }
    burnish_status status = burnish_legacy_allocate(
        (void **)remap, data->streams[BURNISH_POSITION].count, sizeof **remap, "welding", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_weld(burnish_positions(data), data->streams[BURNISH_POSITION].count,
                              b->data->tasks, *remap, &b->position_count, b->error);
    }
    if (status == BURNISH_STATUS_OK && b->position_count < data->streams[BURNISH_POSITION].count) {
        size_t next = 0;
        for (size_t i = 0; i < data->streams[BURNISH_POSITION].count; ++i) {
            if ((*remap)[i] == next) {
                memmove(burnish_positions(data) + 3 * next++, burnish_positions(data) + 3 * i,
                        3 * sizeof(float));
            }
        }
    }
    return status;
}

/* What the tasks of prepare_normals share. */
typedef struct unit_context {
    float *normals;
    atomic_size_t missing;
} unit_context;

static void unit_range(void *of, size_t first, size_t end) {
    unit_context *context = of;
    size_t missing = 0;
    for (size_t i = first; i < end; ++i) {
        float *n = context->normals + 3 * i;
        burnish_store_unit(burnish_vec3_loadf(n), n);
        missing += n[0] == 0 && n[1] == 0 && n[2] == 0;
    }
    atomic_fetch_add(&context->missing, missing);
}

/* Normals that are numbered as positions are get corners of their own: orienting moves both. */
static burnish_status number_normals(builder *b) {
    burnish_mesh_data *data = b->data;
    burnish_stream *normals = &data->streams[BURNISH_NORMAL];
    if (normals->count > 0 && !normals->corners &&
        burnish_mesh_data_reserve_corners(data, BURNISH_NORMAL, data->triangle_count) ==
            BURNISH_STATUS_OK) {
        memcpy(normals->corners, data->streams[BURNISH_POSITION].corners,
               3 * data->triangle_count * sizeof *normals->corners);
    }
    return data->memory.status;
}

/* Makes the file's normals unit vectors; those without a direction become 0: to be made. */
static void prepare_normals(builder *b) {
    const uint32_t *corners = b->data->streams[BURNISH_NORMAL].corners;
    const size_t corner_count = corners ? 3 * b->data->triangle_count : 0;
    unit_context context = {.normals = burnish_normals(b->data)};
    burnish_tasks_ranges(b->data->tasks, b->data->streams[BURNISH_NORMAL].count, SHARE, unit_range,
                         &context);
    size_t missing = atomic_load(&context.missing);
    for (size_t i = 0; i < corner_count; ++i) {
        missing += corners[i] == BURNISH_NONE;
    }
    b->normals_complete = corners && missing == 0;
}

/* The file's normal of a corner, or NULL when one must be made. */
static const float *file_normal(const burnish_mesh_data *data, size_t corner) {
    if (!data->streams[BURNISH_NORMAL].corners ||
        data->streams[BURNISH_NORMAL].corners[corner] == BURNISH_NONE) {
        return NULL;
    }
    const float *n =
        burnish_normals(data) + 3 * (size_t)data->streams[BURNISH_NORMAL].corners[corner];
    return n[0] != 0 || n[1] != 0 || n[2] != 0 ? n : NULL;
}

static void swap_corners(uint32_t *corners, size_t triangle) {
    if (corners) {
        uint32_t second = corners[3 * triangle + 1];
        corners[3 * triangle + 1] = corners[3 * triangle + 2];
        corners[3 * triangle + 2] = second;
    }
}

/* Turns a triangle whose winding contradicts the file's normals. It comes before normals are made,
 * because those follow the winding. */
static void orient(const builder *b, size_t triangle, burnish_vec3 cross) {
    burnish_mesh_data *data = b->data;
    burnish_vec3 sum = {0, 0, 0};
    for (size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
        const float *normal = file_normal(data, corner);
        if (normal) {
            sum = burnish_vec3_add(sum, burnish_vec3_loadf(normal));
        }
    }
    if (burnish_vec3_dot(cross, sum) < 0) {
        swap_corners(b->corner_vertices, triangle);
        swap_corners(data->streams[BURNISH_POSITION].corners, triangle);
        swap_corners(data->streams[BURNISH_NORMAL].corners, triangle);
    }
}

/* A repeated position makes an edge, and so the product, exactly 0. */
static int is_area(burnish_vec3 cross) {
    return cross.x != 0 || cross.y != 0 || cross.z != 0;
}

static burnish_vec3 cross_of(const builder *b, size_t triangle) {
    return burnish_face_cross(burnish_positions(b->data), b->corner_vertices + 3 * triangle);
}

/* What the tasks of weld_corners share. */
typedef struct weld_context {
    builder *b;
    const uint32_t *remap;
    atomic_size_t with_area;
} weld_context;

static void weld_range(void *of, size_t first, size_t end) {
    weld_context *context = of;
    builder *b = context->b;
    const uint32_t *corners = b->data->streams[BURNISH_POSITION].corners;
    size_t with_area = 0;
    for (size_t i = first; i < end; ++i) {
        for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
            b->corner_vertices[k] = context->remap[corners[k]];
        }
        const burnish_vec3 cross = cross_of(b, i);
        with_area += (size_t)is_area(cross);
        if (b->data->streams[BURNISH_NORMAL].corners) {
            orient(b, i, cross);
        }
    }
    atomic_fetch_add(&context->with_area, with_area);
}

/* Fills corner_vertices, oriented; returns how many triangles have an area. */
static size_t weld_corners(builder *b, const uint32_t *remap) {
    weld_context context = {.b = b, .remap = remap};
    burnish_tasks_ranges(b->data->tasks, b->data->triangle_count, SHARE, weld_range, &context);
    return atomic_load(&context.with_area);
}

static void move_triangle(builder *b, size_t from, size_t to) {
    burnish_mesh_data *data = b->data;
    memmove(b->corner_vertices + 3 * to, b->corner_vertices + 3 * from, 3 * sizeof(uint32_t));
    memmove(data->streams[BURNISH_POSITION].corners + 3 * to,
            data->streams[BURNISH_POSITION].corners + 3 * from, 3 * sizeof(uint32_t));
    if (data->streams[BURNISH_NORMAL].corners) {
        memmove(data->streams[BURNISH_NORMAL].corners + 3 * to,
                data->streams[BURNISH_NORMAL].corners + 3 * from, 3 * sizeof(uint32_t));
    }
    if (data->triangle_materials) {
        data->triangle_materials[to] = data->triangle_materials[from];
    }
}

/* Moves the triangles with area to the head of the data's arrays and fills corner_vertices. */
static burnish_status keep_triangles(builder *b, const uint32_t *remap) {
    burnish_mesh_data *data = b->data;
    burnish_status status =
        burnish_legacy_allocate((void **)&b->corner_vertices, data->triangle_count,
                                3 * sizeof *b->corner_vertices, "triangles", b->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    size_t kept = weld_corners(b, remap);
    if (kept == 0) {
        return burnish_fail_at(b->error, BURNISH_STATUS_FORMAT, burnish_place_file(b->name),
                               "no triangle has any area; %zu triangles were read, and a mesh "
                               "needs at least one whose corners are not on a line",
                               data->triangle_count);
    }
    if (kept < data->triangle_count) {
        burnish_mesh_data_warn(data, "%s: %zu of %zu triangles have no area and were left out",
                               burnish_show_name(b->name).text, data->triangle_count - kept,
                               data->triangle_count);
        size_t next = 0;
        for (size_t i = 0; i < data->triangle_count; ++i) {
            if (is_area(cross_of(b, i))) {
                move_triangle(b, i, next++);
            }
        }
    }
    b->triangle_count = kept;
    return BURNISH_STATUS_OK;
}

/* What the tasks of permute share: items of `size` bytes. */
typedef struct permute_context {
    const uint32_t *order;
    const uint8_t *from;
    uint8_t *to;
} permute_context;

static void permute_triples(void *of, size_t first, size_t end) {
    const permute_context *context = of;
    enum { SIZE = 3 * sizeof(uint32_t) };
    for (size_t i = first; i < end; ++i) {
        memcpy(context->to + SIZE * i, context->from + SIZE * (size_t)context->order[i], SIZE);
    }
}

static void permute_materials(void *of, size_t first, size_t end) {
    const permute_context *context = of;
    enum { SIZE = sizeof(uint16_t) };
    for (size_t i = first; i < end; ++i) {
        memcpy(context->to + SIZE * i, context->from + SIZE * (size_t)context->order[i], SIZE);
    }
}

/* Puts an array of items of `size` bytes, one a triangle, in order; NULL stays. */
static burnish_status permute(builder *b, const uint32_t *order, void **array, size_t size,
                              burnish_range_task *task) {
    void *made = NULL;
    if (!*array) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_legacy_allocate(&made, b->triangle_count, size, "ordering", b->error);
    if (status == BURNISH_STATUS_OK) {
        permute_context context = {order, *array, made};
        burnish_tasks_ranges(b->data->tasks, b->triangle_count, SHARE, task, &context);
        free(*array);
        *array = made;
    }
    return status;
}

/* Orders the triangles in space. */
static burnish_status order_triangles(builder *b) {
    burnish_mesh_data *data = b->data;
    const size_t count = b->triangle_count, triple = 3 * sizeof(uint32_t);
    uint32_t *order = NULL;
    if (count < BURNISH_ORDER_LEAST) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_legacy_allocate((void **)&order, count, sizeof *order, "ordering", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_order_triangles(burnish_positions(data), b->position_count,
                                         b->corner_vertices, count, data->tasks, order, b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = permute(b, order, (void **)&b->corner_vertices, triple, permute_triples);
    }
    if (status == BURNISH_STATUS_OK && b->has_colors) {
        status = permute(b, order, (void **)&data->streams[BURNISH_POSITION].corners, triple,
                         permute_triples);
        data->streams[BURNISH_POSITION].corner_capacity = count;
    }
    if (status == BURNISH_STATUS_OK) {
        status = permute(b, order, (void **)&data->streams[BURNISH_NORMAL].corners, triple,
                         permute_triples);
        data->streams[BURNISH_NORMAL].corner_capacity = count;
    }
    if (status == BURNISH_STATUS_OK) {
        status = permute(b, order, (void **)&data->triangle_materials, sizeof(uint16_t),
                         permute_materials);
        data->triangle_material_capacity = count;
    }
    free(order);
    return status;
}

/* Lists the corners of every welded position, in the order of the triangles. */
static burnish_status list_corners(builder *b) {
    size_t corner_count = 3 * b->triangle_count;
    burnish_status status =
        burnish_legacy_allocate((void **)&b->first_corner, b->position_count + 2,
                                sizeof *b->first_corner, "vertices", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&b->corners, corner_count, sizeof *b->corners,
                                         "vertices", b->error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    /* Counting sort with the counts two places on, so that filling leaves the starts in place. */
    memset(b->first_corner, 0, (b->position_count + 2) * sizeof *b->first_corner);
    for (size_t i = 0; i < corner_count; ++i) {
        ++b->first_corner[b->corner_vertices[i] + (size_t)2];
    }
    for (size_t i = 2; i < b->position_count + 2; ++i) {
        if (b->first_corner[i] > b->max_faces) {
            b->max_faces = b->first_corner[i];
        }
        b->first_corner[i] += b->first_corner[i - 1];
    }
    for (size_t i = 0; i < corner_count; ++i) {
        b->corners[b->first_corner[b->corner_vertices[i] + (size_t)1]++] = (uint32_t)i;
    }
    return BURNISH_STATUS_OK;
}

/* ---- vertices ---- */

static int needs_normal(const builder *b, const uint32_t *corners, size_t count) {
    for (size_t i = 0; i < count && !b->normals_complete; ++i) {
        if (!file_normal(b->data, corners[i])) {
            return 1;
        }
    }
    return 0;
}

static void describe_corner(const builder *b, uint32_t corner, const float *normal,
                            burnish_weld_record *record) {
    *record = (burnish_weld_record){{0}, corner};
    memcpy(record->key, normal, 3 * sizeof(float));
    if (b->has_colors) {
        memcpy(&record->key[3],
               burnish_colors(b->data) +
                   4 * (size_t)b->data->streams[BURNISH_POSITION].corners[corner],
               4);
    }
}

static int same_vertex(const burnish_weld_record *x, const burnish_weld_record *y) {
    return memcmp(x->key, y->key, sizeof x->key) == 0;
}

/* Appends a vertex of which record is the first corner. Room was made. */
static void append_vertex(vertex_maker *maker, uint32_t position,
                          const burnish_weld_record *record) {
    built_vertex *vertex = &maker->vertices[maker->count++];
    vertex->corner = record->value;
    vertex->position = position;
    memcpy(vertex->normal, record->key, sizeof vertex->normal);
    vertex->color = record->key[3];
}

/* Gives each corner of one position its vertex: corners with equal normal and colour share one. In
 * the scene's indices stands the first corner of that vertex for now. */
static void number_corners(builder *b, vertex_maker *maker, uint32_t position) {
    enum { FEW = 16 };
    const uint32_t *corners = b->corners + b->first_corner[position];
    size_t count = b->first_corner[position + (size_t)1] - b->first_corner[position];
    burnish_weld_record *records = maker->records;
    uint32_t *indices = b->scene->indices;
    for (size_t i = 0; i < count; ++i) {
        describe_corner(b, corners[i], maker->normals + 3 * i, &records[i]);
    }
    if (count > FEW) {
        burnish_weld_sort(records, count);
    }
    for (size_t i = 0; i < count; ++i) {
        size_t head = count > FEW && i > 0 ? i - 1 : 0;
        while (head < i && !same_vertex(&records[head], &records[i])) {
            ++head;
        }
        indices[records[i].value] = head < i ? indices[records[head].value] : records[i].value;
        if (head == i) {
            append_vertex(maker, position, &records[i]);
        }
    }
}

/* All corners of a position have one normal, the first in maker, and no colour. */
static void share_vertex(builder *b, vertex_maker *maker, uint32_t position) {
    const uint32_t *corners = b->corners + b->first_corner[position];
    const uint32_t *end = b->corners + b->first_corner[position + (size_t)1];
    burnish_weld_record record = {{0}, *corners};
    memcpy(record.key, maker->normals, 3 * sizeof(float));
    append_vertex(maker, position, &record);
    for (const uint32_t *corner = corners; corner < end; ++corner) {
        b->scene->indices[*corner] = *corners;
    }
}

/* Whether corners that have normals of the file's have the same one. */
static int have_one_normal(const builder *b, const uint32_t *corners, size_t count) {
    const uint32_t *normals = b->data->streams[BURNISH_NORMAL].corners;
    for (size_t i = 1; i < count; ++i) {
        if (normals[corners[i]] != normals[corners[0]]) {
            return 0;
        }
    }
    return 1;
}

/* The vertices of one position; measured: whether its corners stand in the fan, from `first` on. */
static void make_position(builder *b, vertex_maker *maker, uint32_t position, int measured,
                          size_t first) {
    const uint32_t *corners = b->corners + b->first_corner[position];
    size_t count = b->first_corner[position + (size_t)1] - b->first_corner[position];
    maker->status =
        burnish_legacy_reserve((void **)&maker->vertices, &maker->capacity, maker->count + count,
                               sizeof *maker->vertices, "vertices", &maker->error);
    if (maker->status != BURNISH_STATUS_OK) {
        return;
    }
    if (b->normals_complete && !b->has_colors && have_one_normal(b, corners, count)) {
        memcpy(maker->normals, file_normal(b->data, corners[0]), 3 * sizeof(float));
        share_vertex(b, maker, position);
        return;
    }
    if (measured && needs_normal(b, corners, count) &&
        burnish_fan_normals(&maker->fan, first, count, maker->normals)) {
        if (!b->data->streams[BURNISH_NORMAL].corners && !b->has_colors) {
            share_vertex(b, maker, position);
            return;
        }
        for (size_t i = 1; i < count; ++i) {
            memcpy(maker->normals + 3 * i, maker->normals, 3 * sizeof(float));
        }
    }
    for (size_t i = 0; i < count && b->data->streams[BURNISH_NORMAL].corners; ++i) {
        const float *given = file_normal(b->data, corners[i]);
        if (given) {
            memcpy(maker->normals + 3 * i, given, 3 * sizeof(float));
        }
    }
    number_corners(b, maker, position);
}

/* The vertices of positions [first, end), whose corners fit the fan; the first one may not. */
static void make_block(builder *b, vertex_maker *maker, size_t first, size_t end) {
    uint32_t start = b->first_corner[first];
    size_t count = b->first_corner[end] - start;
    int measured = needs_normal(b, b->corners + start, count);
    if (measured) {
        burnish_fan_measure(&maker->fan, burnish_positions(b->data), b->corner_vertices,
                            b->corners + start, count);
    }
    for (size_t i = first; i < end && maker->status == BURNISH_STATUS_OK; ++i) {
        if (b->first_corner[i + 1] > b->first_corner[i]) {
            make_position(b, maker, (uint32_t)i, measured, b->first_corner[i] - start);
        }
    }
}

/* The vertices of positions [first, end), but for those with more corners than fit the fan. */
static void make_turn(builder *b, vertex_maker *maker, size_t first, size_t end) {
    const uint32_t *starts = b->first_corner;
    while (first < end && maker->status == BURNISH_STATUS_OK) {
        size_t next = first + 1;
        while (next < end && starts[next + 1] - starts[first] <= maker->fan.capacity) {
            ++next;
        }
        if (starts[next] - starts[first] <= maker->fan.capacity) {
            make_block(b, maker, first, next);
        }
        first = next;
    }
}

static burnish_status create_maker(vertex_maker *maker, size_t capacity, double angle,
                                   burnish_error *error) {
    burnish_status status = burnish_fan_create(&maker->fan, capacity, angle, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&maker->normals, capacity,
                                         3 * sizeof *maker->normals, "vertices", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&maker->records, capacity, sizeof *maker->records,
                                         "vertices", error);
    }
    return status;
}

static void destroy_maker_scratch(vertex_maker *maker) {
    burnish_fan_destroy(&maker->fan);
    free(maker->normals);
    free(maker->records);
    maker->normals = NULL;
    maker->records = NULL;
}

static void destroy_makers(builder *b) {
    for (int i = 0; i < b->maker_count; ++i) {
        destroy_maker_scratch(&b->makers[i]);
        free(b->makers[i].vertices);
    }
    free(b->makers);
    b->makers = NULL;
    b->maker_count = 0;
}

/* Positions with more corners than fit: one by one, with a fan of their size. */
static burnish_status make_large(builder *b, double angle) {
    vertex_maker *maker = &b->makers[0];
    burnish_status status;
    destroy_maker_scratch(maker);
    status = create_maker(maker, b->max_faces, angle, b->error);
    for (size_t i = 0; i < b->position_count && status == BURNISH_STATUS_OK; ++i) {
        if (b->first_corner[i + 1] - b->first_corner[i] > CORNERS_AT_ONCE) {
            make_block(b, maker, i, i + 1);
            status = maker->status;
        }
    }
    return status;
}

static burnish_status allocate_vertices(builder *b) {
    burnish_mesh *scene = b->scene;
    size_t count = b->vertex_count;
    burnish_status status = burnish_legacy_allocate(&scene->attributes[BURNISH_POSITION], count,
                                                    3 * sizeof(float), "vertices", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate(&scene->attributes[BURNISH_NORMAL], count,
                                         3 * sizeof(float), "vertices", b->error);
    }
    if (status == BURNISH_STATUS_OK && b->has_colors) {
        status = burnish_legacy_allocate(&scene->attributes[BURNISH_COLOR], count, 4, "vertices",
                                         b->error);
    }
    return status;
}

/* ---- meshes whose file gives all normals, and no colour ---- */

/* A vertex: a position with a normal. */
typedef struct given_vertex {
    uint32_t position, normal; /* in the mesh data */
    uint32_t next;             /* of the same position, or BURNISH_NONE */
} given_vertex;

/* The vertex of a position that was found last: mostly the only one. */
typedef struct given_head {
    uint32_t vertex, normal; /* BURNISH_NONE: none yet */
} given_head;

typedef struct given_vertices {
    given_head *heads; /* a position each */
    given_vertex *items;
    size_t count, capacity;
} given_vertices;

static int same_normal(const builder *b, uint32_t x, uint32_t y) {
    const float *normals = burnish_normals(b->data);
    return memcmp(normals + 3 * (size_t)x, normals + 3 * (size_t)y, 3 * sizeof(float)) == 0;
}

/* The vertex of a position with a normal that is not its last one's: found, or appended. Gives up,
 * *done is 0, where the position has many. */
static burnish_status find_given(builder *b, given_vertices *vertices, uint32_t position,
                                 uint32_t normal, uint32_t *vertex, int *done) {
    enum { MANY = 16 };
    given_head *head = &vertices->heads[position];
    int passed = 0;
    *vertex = head->vertex;
    while (*vertex != BURNISH_NONE && !same_normal(b, vertices->items[*vertex].normal, normal)) {
        *vertex = vertices->items[*vertex].next;
        ++passed;
    }
    if (*vertex != BURNISH_NONE) {
        return BURNISH_STATUS_OK;
    }
    *done = passed < MANY;
    if (vertices->count == vertices->capacity) {
        burnish_status status = burnish_legacy_reserve(
            (void **)&vertices->items, &vertices->capacity, vertices->count + 1,
            sizeof *vertices->items, "vertices", b->error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    *vertex = (uint32_t)vertices->count++;
    vertices->items[*vertex] = (given_vertex){position, normal, head->vertex};
    *head = (given_head){*vertex, normal};
    return BURNISH_STATUS_OK;
}

/* Numbers the vertices in the order in which the triangles first use them, into the scene's
 * indices. Gives up, *done is 0, where a position has many. */
static burnish_status number_given(builder *b, given_vertices *vertices, int *done) {
    const uint32_t *normals = b->data->streams[BURNISH_NORMAL].corners;
    burnish_status status = BURNISH_STATUS_OK;
    memset(vertices->heads, 0xff, b->position_count * sizeof *vertices->heads);
    *done = 1;
    for (size_t i = 0; i < 3 * b->triangle_count && *done; ++i) {
        const given_head head = vertices->heads[b->corner_vertices[i]];
        uint32_t vertex = head.vertex;
        if (head.normal != normals[i]) {
            status = find_given(b, vertices, b->corner_vertices[i], normals[i], &vertex, done);
            *done &= status == BURNISH_STATUS_OK;
        }
        b->scene->indices[i] = vertex;
    }
    return status;
}

/* What the tasks of take_given share. */
typedef struct given_context {
    const builder *b;
    const given_vertex *vertices;
} given_context;

static void write_given(void *of, size_t first, size_t end) {
    const given_context *context = of;
    const burnish_mesh_data *data = context->b->data;
    burnish_mesh *scene = context->b->scene;
    for (size_t i = first; i < end; ++i) {
        const given_vertex *vertex = &context->vertices[i];
        memcpy(((float *)scene->attributes[BURNISH_POSITION]) + 3 * i,
               burnish_positions(data) + 3 * (size_t)vertex->position, 3 * sizeof(float));
        memcpy(((float *)scene->attributes[BURNISH_NORMAL]) + 3 * i,
               burnish_normals(data) + 3 * (size_t)vertex->normal, 3 * sizeof(float));
    }
}

/* What is common, and what make_vertices would find. *done becomes 0 where it can't be used. */
static burnish_status take_given(builder *b, int *done) {
    given_vertices vertices = {0};
    *done = 0;
    if (!b->normals_complete || b->has_colors) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = burnish_legacy_allocate((void **)&vertices.heads, b->position_count,
                                                    sizeof *vertices.heads, "vertices", b->error);
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_legacy_reserve((void **)&vertices.items, &vertices.capacity, b->position_count,
                                   sizeof *vertices.items, "vertices", b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = number_given(b, &vertices, done);
    }
    free(vertices.heads);
    if (*done && status == BURNISH_STATUS_OK) {
        b->vertex_count = vertices.count;
        status = allocate_vertices(b);
    }
    if (*done && status == BURNISH_STATUS_OK) {
        given_context context = {b, vertices.items};
        burnish_tasks_ranges(b->data->tasks, vertices.count, SHARE, write_given, &context);
    }
    free(vertices.items);
    return status;
}

/* Everything that is kept per corner, once the vertices stand: most of the memory. */
static void release_corners(builder *b) {
    burnish_mesh_data *data = b->data;
    free(b->corners);
    free(b->first_corner);
    free(b->corner_vertices);
    b->corners = b->first_corner = b->corner_vertices = NULL;
    burnish_release(data->memory.context, data->streams[BURNISH_POSITION].corners);
    data->streams[BURNISH_POSITION].corners = NULL;
    data->streams[BURNISH_POSITION].corner_capacity = data->triangle_count = 0;
    burnish_mesh_data_drop(data, BURNISH_NORMAL);
    burnish_mesh_data_drop(data, BURNISH_COLOR);
}

static double crease_angle(const burnish_load_options *options, burnish_format format) {
    if (options->crease_angle != BURNISH_CREASE_AUTO) {
        return options->crease_angle;
    }
    return burnish_format_get_info(format)->crease_angle;
}

static burnish_status create_makers(builder *b, double angle) {
    size_t capacity = b->max_faces < CORNERS_AT_ONCE ? b->max_faces : CORNERS_AT_ONCE;
    if (capacity < CORNERS_AT_ONCE && 3 * b->triangle_count > capacity) {
        capacity =
            3 * b->triangle_count < CORNERS_AT_ONCE ? 3 * b->triangle_count : CORNERS_AT_ONCE;
    }
    const size_t worth = b->position_count / (SHARE / 2),
                 all = (size_t)burnish_tasks_threads(b->data->tasks);
    const int count = worth <= 1 ? 1 : (int)(worth < all ? worth : all);
    burnish_status status = burnish_legacy_allocate((void **)&b->makers, (size_t)count,
                                                    sizeof *b->makers, "vertices", b->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    memset(b->makers, 0, (size_t)count * sizeof *b->makers);
    b->maker_count = count;
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        status = create_maker(&b->makers[i], capacity, angle, b->error);
    }
    return status;
}

static void turn_task(void *of, size_t turn, int thread) {
    builder *b = of;
    const size_t first = turn * POSITIONS_A_TURN, end = first + POSITIONS_A_TURN;
    make_turn(b, &b->makers[thread], first, end < b->position_count ? end : b->position_count);
}

static burnish_status make_vertices(builder *b, double angle) {
    burnish_status status = create_makers(b, angle);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    size_t turns = (b->position_count + POSITIONS_A_TURN - 1) / POSITIONS_A_TURN;
    burnish_tasks_run(b->data->tasks, turns, 1, b->maker_count, turn_task, b);
    for (int i = 0; i < b->maker_count; ++i) {
        if (b->makers[i].status != BURNISH_STATUS_OK) {
            if (b->error) {
                *b->error = b->makers[i].error;
            }
            return b->makers[i].status;
        }
    }
    if (b->max_faces > CORNERS_AT_ONCE) {
        status = make_large(b, angle);
    }
    for (int i = 0; i < b->maker_count; ++i) {
        destroy_maker_scratch(&b->makers[i]);
        b->vertex_count += b->makers[i].count;
    }
    return status;
}

/* Numbers the vertices in the order in which the triangles first use them. A vertex's first corner
 * comes before its others, so that their numbers are known by then. */
static void number_vertices(builder *b) {
    uint32_t *indices = b->scene->indices, next = 0;
    for (size_t i = 0; i < 3 * b->triangle_count; ++i) {
        indices[i] = indices[i] == i ? next++ : indices[indices[i]];
    }
}

/* What the tasks of write_vertices share. */
typedef struct write_context {
    const builder *b;
    const built_vertex *vertices;
} write_context;

static void write_range(void *of, size_t first, size_t end) {
    const write_context *context = of;
    const burnish_mesh_data *data = context->b->data;
    burnish_mesh *scene = context->b->scene;
    for (size_t k = first; k < end; ++k) {
        const built_vertex *vertex = &context->vertices[k];
        size_t number = scene->indices[vertex->corner];
        memcpy(((float *)scene->attributes[BURNISH_POSITION]) + 3 * number,
               burnish_positions(data) + 3 * (size_t)vertex->position, 3 * sizeof(float));
        memcpy(((float *)scene->attributes[BURNISH_NORMAL]) + 3 * number, vertex->normal,
               3 * sizeof(float));
        if (((uint8_t *)scene->attributes[BURNISH_COLOR])) {
            memcpy(((uint8_t *)scene->attributes[BURNISH_COLOR]) + 4 * number, &vertex->color, 4);
        }
    }
}

static void write_vertices(builder *b) {
    for (int i = 0; i < b->maker_count; ++i) {
        write_context context = {b, b->makers[i].vertices};
        burnish_tasks_ranges(b->data->tasks, b->makers[i].count, SHARE, write_range, &context);
    }
}

static burnish_status finish_vertices(builder *b) {
    burnish_status status = allocate_vertices(b);
    if (status == BURNISH_STATUS_OK) {
        number_vertices(b);
        write_vertices(b);
    }
    return status;
}

/* Moves the materials to the scene, and their numbers where there is more than one. */
static burnish_status take_materials(builder *b) {
    burnish_mesh_data *data = b->data;
    burnish_mesh *scene = b->scene;
    if (data->material_count == 0) {
        burnish_status status = burnish_legacy_allocate(
            (void **)&scene->materials, 1, sizeof *scene->materials, "material", b->error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        scene->materials[0] = burnish_material_default();
        scene->material_count = 1;
    } else {
        scene->materials = data->materials;
        scene->material_count = data->material_count;
        data->materials = NULL;
        data->material_count = data->material_capacity = 0;
    }
    if (scene->material_count > 1 && data->triangle_materials) {
        for (size_t i = 0; i < b->triangle_count; ++i) {
            if (data->triangle_materials[i] >= scene->material_count) {
                return burnish_fail_at(b->error, BURNISH_STATUS_FORMAT, burnish_place_file(b->name),
                                       "triangle %zu has material %d, but there are only %zu", i,
                                       data->triangle_materials[i], scene->material_count);
            }
        }
        scene->triangle_materials = data->triangle_materials;
        data->triangle_materials = NULL;
        data->triangle_material_capacity = 0;
    }
    return BURNISH_STATUS_OK;
}

static void describe_mesh(burnish_mesh *scene, size_t vertex_count, size_t triangle_count) {
    burnish_mesh_view *mesh = &scene->view;
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    mesh->positions = ((float *)scene->attributes[BURNISH_POSITION]);
    mesh->normals = ((float *)scene->attributes[BURNISH_NORMAL]);
    mesh->colors = ((uint8_t *)scene->attributes[BURNISH_COLOR]);
    mesh->indices = scene->indices;
    mesh->triangle_materials = scene->triangle_materials;
    memcpy(mesh->bounds_min, ((float *)scene->attributes[BURNISH_POSITION]),
           sizeof mesh->bounds_min);
    memcpy(mesh->bounds_max, ((float *)scene->attributes[BURNISH_POSITION]),
           sizeof mesh->bounds_max);
    for (size_t i = 0; i < vertex_count; ++i) {
        const float *position = ((float *)scene->attributes[BURNISH_POSITION]) + 3 * i;
        for (int axis = 0; axis < 3; ++axis) {
            float value = position[axis];
            float *low = &mesh->bounds_min[axis], *high = &mesh->bounds_max[axis];
            *low = value < *low ? value : *low;
            *high = value > *high ? value : *high;
        }
    }
}

/* Vertices and indices of the triangles that are kept. */
static burnish_status number_mesh(builder *b, double angle) {
    int done = 0;
    burnish_status status =
        burnish_legacy_allocate((void **)&b->scene->indices, b->triangle_count,
                                3 * sizeof *b->scene->indices, "triangles", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = take_given(b, &done);
    }
    if (status != BURNISH_STATUS_OK || done) {
        return status;
    }
    status = list_corners(b);
    if (status == BURNISH_STATUS_OK) {
        status = make_vertices(b, angle);
    }
    if (status == BURNISH_STATUS_OK) {
        release_corners(b);
        status = finish_vertices(b);
    }
    return status;
}

/* The steps in order; on failure what was made so far stays in b and b->scene. */
static burnish_status build(builder *b, const burnish_load_options *options) {
    uint32_t *remap = NULL;
    burnish_status status = number_normals(b);
    if (status == BURNISH_STATUS_OK) {
        status = weld_positions(b, &remap);
    }
    if (status == BURNISH_STATUS_OK) {
        prepare_normals(b);
        status = keep_triangles(b, remap);
    }
    free(remap);
    if (!b->has_colors) { /* corner_vertices tell all that is still needed */
        free(b->data->streams[BURNISH_POSITION].corners);
        b->data->streams[BURNISH_POSITION].corners = NULL;
        b->data->streams[BURNISH_POSITION].corner_capacity = 0;
    }
    if (status == BURNISH_STATUS_OK) {
        status = order_triangles(b);
    }
    if (status == BURNISH_STATUS_OK) {
        status = number_mesh(b, crease_angle(options, b->scene->info.format));
    }
    if (status == BURNISH_STATUS_OK) {
        status = take_materials(b);
    }
    return status;
}

burnish_status burnish_mesh_build(burnish_mesh_data *data, const char *name,
                                  const burnish_load_options *options, burnish_format format,
                                  burnish_mesh **scene, burnish_error *error) {
    builder b = {.data = data,
                 .name = name,
                 .error = error,
                 .has_colors = data->streams[BURNISH_COLOR].count > 0};
    *scene = NULL;
    burnish_status status =
        burnish_legacy_allocate((void **)&b.scene, 1, sizeof *b.scene, "mesh", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *b.scene = (burnish_mesh){.info.format = format, .context = data->memory.context};
    memcpy(b.scene->view.up_axis, burnish_format_get_info(format)->up_axis,
           sizeof b.scene->view.up_axis);
    status = build(&b, options);
    release_corners(&b);
    destroy_makers(&b);
    if (status != BURNISH_STATUS_OK) {
        burnish_mesh_destroy(b.scene);
        return status;
    }
    describe_mesh(b.scene, b.vertex_count, b.triangle_count);
    b.scene->warnings = data->warnings;
    b.scene->warning_count = data->warning_count;
    data->warnings = NULL;
    data->warning_count = data->warning_capacity = 0;
    *scene = b.scene;
    return BURNISH_STATUS_OK;
}
