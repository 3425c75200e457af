/* Edges by counting sort: each side of a triangle is listed with the lesser of its positions, and
 * the list of a position is sorted by the greater. */
#include "mesh/edges.h"

#include "mesh/build/builder.h"
#include "mesh/build/weld.h"

#define SORT_TYPE uint64_t
#define SORT_NAME(name) sort_side_##name
#define SORT_LESS(a, b) (*(a) < *(b))
#define SORT_INSERTION_MAX 24 /* a position is the lesser one of about three sides */
#include "mesh/build/sort.h"

/* 8 degrees: below that, normals differ only by rounding. */
#define SHARP_COSINE 0.99026806874157036

typedef struct finder {
    const burnish_mesh_view *mesh;
    burnish_edges *edges;
    uint32_t *heads; /* of each vertex: the first one at its position */
    uint32_t *first; /* of each vertex: where its sides start in ... */
    uint64_t *sides; /* ... the greater vertex << 32 | 3 triangle + corner where it starts */
} finder;

static const uint8_t following[3] = {1, 2, 0};

/* Flags while edges are found: at which ends an edge is sharp. */
enum { SHARP_FIRST = 8, SHARP_SECOND = 16, SHARP_BOTH = SHARP_FIRST | SHARP_SECOND };

/* ---- Listing ---- */

/* The welded ends of a side, lesser first; equal where a triangle has no such side. */
static void side_ends(const finder *f, size_t side, uint32_t *lesser, uint32_t *greater) {
    const size_t corner = side % 3;
    const uint32_t a = f->heads[f->mesh->indices[side]];
    const uint32_t b = f->heads[f->mesh->indices[side - corner + following[corner]]];
    *lesser = a < b ? a : b;
    *greater = a < b ? b : a;
}

static void count_sides(void *context, size_t first, size_t end) {
    finder *f = context;
    for (size_t side = 3 * first; side < 3 * end; ++side) {
        uint32_t lesser, greater;
        side_ends(f, side, &lesser, &greater);
        f->first[lesser + (size_t)2] += lesser != greater;
    }
}

static void place_sides(void *context, size_t first, size_t end) {
    finder *f = context;
    for (size_t side = 3 * first; side < 3 * end; ++side) {
        uint32_t lesser, greater;
        side_ends(f, side, &lesser, &greater);
        if (lesser != greater) {
            f->sides[f->first[lesser + (size_t)1]++] = (uint64_t)greater << 32 | side;
        }
    }
}

static void sort_sides(void *context, size_t first, size_t end) {
    finder *f = context;
    for (size_t i = first; i < end; ++i) {
        sort_side_array(f->sides + f->first[i], f->first[i + 1] - f->first[i]);
    }
}

/* For each vertex the first vertex at its position. */
static burnish_status weld_vertices(finder *f, burnish_tasks *tasks, burnish_memory *memory) {
    const size_t count = f->mesh->vertex_count;
    size_t unique = 0;
    float *positions = burnish_allocate(memory, count, 3 * sizeof *positions, "edges");
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_weld(f->mesh->positions, count, tasks, memory, f->heads, positions, &unique);
    }
    burnish_release(memory->context, positions);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    uint32_t next = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t number = f->heads[i];
        if (number == next) {
            f->first[next++] = i;
        }
        f->heads[i] = f->first[number];
    }
    memset(f->first, 0, (count + 2) * sizeof *f->first);
    return burnish_tasks_check(tasks, memory->error);
}

/* ---- Edges ---- */

/* The number of sides, from the first on, that belong to one edge. */
static size_t count_equal(const uint64_t *sides, size_t count) {
    size_t same = 1;
    while (same < count && sides[same] >> 32 == sides[0] >> 32) {
        ++same;
    }
    return same;
}

static burnish_vec3 face_normal(const finder *f, uint32_t side) {
    return burnish_vec3_normalize(
        burnish_face_cross(f->mesh->positions, f->mesh->indices + side / 3 * 3));
}

/* The vertex that a side's triangle has at a welded end. */
static uint32_t corner_at(const finder *f, uint32_t side, uint32_t end) {
    const uint32_t *corners = f->mesh->indices + side / 3 * 3;
    for (int k = 0; k < 2; ++k) {
        if (f->heads[corners[k]] == end) {
            return corners[k];
        }
    }
    return corners[2];
}

static int normals_differ(const finder *f, uint32_t a, uint32_t b, double sign) {
    const float *normals = f->mesh->normals;
    return a != b && sign * burnish_vec3_dot(burnish_vec3_loadf(normals + 3 * (size_t)a),
                                             burnish_vec3_loadf(normals + 3 * (size_t)b)) <
                         SHARP_COSINE;
}

/* BURNISH_EDGE_SHARP with the ends at which the normals differ, or 0. A triangle that is wound against
 * its neighbour has the opposite normals, and is no fold. */
static uint32_t find_sharpness(const finder *f, const uint32_t sides[2], const uint32_t ends[2]) {
    const double sign = f->heads[f->mesh->indices[sides[1]]] == ends[0] ? -1 : 1;
    uint32_t differ = 0;
    for (int k = 0; k < 2; ++k) {
        if (normals_differ(f, corner_at(f, sides[0], ends[k]), corner_at(f, sides[1], ends[k]),
                           sign)) {
            differ |= SHARP_FIRST << k | BURNISH_EDGE_SHARP;
        }
    }
    return differ && sign * burnish_vec3_dot(face_normal(f, sides[0]), face_normal(f, sides[1])) <
                         SHARP_COSINE
               ? differ
               : 0;
}

/* Among several sides, the one whose triangle is bent most against the first. */
static uint32_t choose_partner(const finder *f, const uint64_t *sides, size_t count) {
    const burnish_vec3 normal = face_normal(f, (uint32_t)sides[0]);
    double least = 2;
    uint32_t chosen = (uint32_t)sides[1];
    for (size_t i = 1; i < count && count > 2; ++i) {
        const double cosine = burnish_vec3_dot(normal, face_normal(f, (uint32_t)sides[i]));
        const double bend = cosine < 0 ? -cosine : cosine; /* a second layer is not bent */
        if (bend < least) {
            least = bend;
            chosen = (uint32_t)sides[i];
        }
    }
    return chosen;
}

static burnish_edge make_edge(const finder *f, const uint64_t *sides, size_t count) {
    const uint32_t *indices = f->mesh->indices;
    const uint16_t *materials = f->mesh->triangle_materials;
    const uint32_t side = (uint32_t)sides[0], corner = side % 3;
    burnish_edge edge = {
        .ends = {f->heads[indices[side]], f->heads[indices[side - corner + following[corner]]]},
        .triangles = {side / 3, BURNISH_EDGE_OPEN}};
    if (count > 1) {
        const uint32_t pair[2] = {side, choose_partner(f, sides, count)};
        edge.triangles[1] = pair[1] / 3;
        edge.flags = find_sharpness(f, pair, edge.ends);
        edge.flags |= f->heads[indices[pair[1]]] == edge.ends[0] ? BURNISH_EDGE_ALIKE : 0;
        if (materials && materials[edge.triangles[0]] != materials[edge.triangles[1]]) {
            edge.flags |= BURNISH_EDGE_MATERIAL;
        }
    }
    return edge;
}

static void count_edges(void *context, size_t first, size_t end) {
    finder *f = context;
    for (size_t v = first; v < end; ++v) {
        for (size_t i = f->first[v]; i < f->first[v + 1]; ++f->edges->count) {
            i += count_equal(f->sides + i, f->first[v + 1] - i);
        }
    }
}

static void make_edges(void *context, size_t first, size_t end) {
    finder *f = context;
    for (size_t v = first; v < end; ++v) {
        for (size_t i = f->first[v]; i < f->first[v + 1];) {
            const size_t count = count_equal(f->sides + i, f->first[v + 1] - i);
            f->edges->items[f->edges->count++] = make_edge(f, f->sides + i, count);
            i += count;
        }
    }
}

/* An edge that is sharp only at an end where a crease passes is a smooth edge: its two triangles
 * have different normals there because they are on both sides of a corner of that crease. */
static void drop_stitches(finder *f) {
    burnish_edges *edges = f->edges;
    memset(f->first, 0, f->mesh->vertex_count * sizeof *f->first);
    for (size_t i = 0; i < edges->count; ++i) {
        const burnish_edge *edge = &edges->items[i];
        if ((edge->flags & SHARP_BOTH) == SHARP_BOTH) {
            ++f->first[edge->ends[0]];
            ++f->first[edge->ends[1]];
        }
    }
    for (size_t i = 0; i < edges->count; ++i) {
        burnish_edge *edge = &edges->items[i];
        const uint32_t sharp = edge->flags & SHARP_BOTH;
        edge->flags &= ~(uint32_t)SHARP_BOTH;
        if ((sharp == SHARP_FIRST || sharp == SHARP_SECOND) &&
            f->first[edge->ends[sharp == SHARP_SECOND]] >= 2) {
            edge->flags &= ~(uint32_t)BURNISH_EDGE_SHARP;
        }
    }
}

/* A counting sort with its counts two entries ahead, so filling leaves the starts in place. */
static burnish_status list_sides(finder *f, burnish_tasks *tasks, burnish_error *error) {
    const size_t triangles = f->mesh->triangle_count, vertices = f->mesh->vertex_count;
    burnish_tasks_in_order(tasks, triangles, BURNISH_BUILD_STEP, count_sides, f);
    burnish_status status = burnish_tasks_check(tasks, error);
    for (size_t i = 2; i < vertices + 2; ++i) {
        f->first[i] += f->first[i - 1];
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_in_order(tasks, triangles, BURNISH_BUILD_STEP, place_sides, f);
        status = burnish_tasks_check(tasks, error);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(tasks, vertices, BURNISH_BUILD_GRAIN, sort_sides, f);
        status = burnish_tasks_check(tasks, error);
    }
    return status;
}

static burnish_status find_edges(finder *f, burnish_tasks *tasks, burnish_memory *memory) {
    const size_t vertices = f->mesh->vertex_count;
    burnish_status status = weld_vertices(f, tasks, memory);
    if (status == BURNISH_STATUS_OK) {
        status = list_sides(f, tasks, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_in_order(tasks, vertices, BURNISH_BUILD_STEP, count_edges, f);
        f->edges->items =
            burnish_allocate(memory, f->edges->count, sizeof *f->edges->items, "edges");
        status = memory->status;
    }
    if (status == BURNISH_STATUS_OK) {
        f->edges->count = 0;
        burnish_tasks_in_order(tasks, vertices, BURNISH_BUILD_STEP, make_edges, f);
        drop_stitches(f);
        status = burnish_tasks_check(tasks, memory->error);
    }
    return status;
}

burnish_status burnish_edges_find(const burnish_mesh_view *mesh, burnish_tasks *tasks,
                                  burnish_memory *memory, burnish_edges *edges) {
    const char *what = "edges";
    finder f = {.mesh = mesh, .edges = edges};
    *edges = (burnish_edges){0};
    f.heads = burnish_allocate(memory, mesh->vertex_count, sizeof *f.heads, what);
    f.first = burnish_allocate(memory, mesh->vertex_count + 2, sizeof *f.first, what);
    f.sides = burnish_allocate(memory, mesh->triangle_count, 3 * sizeof *f.sides, what);
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = find_edges(&f, tasks, memory);
    }
    burnish_release(memory->context, f.heads);
    burnish_release(memory->context, f.first);
    burnish_release(memory->context, f.sides);
    if (status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, edges->items);
        *edges = (burnish_edges){0};
    }
    return status;
}
