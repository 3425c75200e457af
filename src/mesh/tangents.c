/* Tangent edges: smooth edges where a bend begins, such as the borders of a fillet.
 *
 * A bend is a row of facets of equal width that turn by equal angles; at its border with a straight
 * face the turn is half of that. A row that does not match to SIMILAR, as in a scan, is not a bend. */
#include "mesh/build/builder.h"
#include "mesh/edges.h"

#define FLAT 1e-3    /* sine: triangles are in one plane */
#define SIMILAR 0.08 /* share by which turns and widths may differ; sin 15 / sin 30 = 0.52 */
#define REACH 3      /* triangles of a facet */

enum { NO_BEND, FLAT_EDGE, BENT_EDGE };

typedef struct finder {
    const burnish_mesh_view *mesh;
    burnish_edge *edges;
    uint8_t *kinds;   /* of each edge */
    uint32_t *around; /* of each triangle: its edges + 1, without those of NO_BEND; else 0 */
} finder;

/* The opposite edge of a facet, and the triangle beyond; all zero if there is none. */
typedef struct crossing {
    uint32_t edge, beyond;
    double turn, wide;
} crossing;

static burnish_vec3 along(const finder *f, uint32_t from, uint32_t to) {
    return burnish_vec3_sub(burnish_vec3_loadf(f->mesh->positions + 3 * (size_t)to),
                            burnish_vec3_loadf(f->mesh->positions + 3 * (size_t)from));
}

static burnish_vec3 cross_of(const finder *f, uint32_t triangle) {
    return burnish_face_cross(f->mesh->positions, f->mesh->indices + 3 * (size_t)triangle);
}

/* Most edges of most meshes get no further, so this takes no root. */
static uint8_t kind_of(const finder *f, const burnish_edge *edge) {
    if (edge->triangles[1] == BURNISH_EDGE_OPEN ||
        edge->flags & (BURNISH_EDGE_SHARP | BURNISH_EDGE_ALIKE)) {
        return NO_BEND;
    }
    const burnish_vec3 a = cross_of(f, edge->triangles[0]), b = cross_of(f, edge->triangles[1]);
    const burnish_vec3 across = burnish_vec3_cross(a, b);
    const double cosine = burnish_vec3_dot(a, b);
    const double squares = burnish_vec3_dot(a, a) * burnish_vec3_dot(b, b);
    return !(cosine > 0 && 4 * cosine * cosine > squares)             ? NO_BEND
           : burnish_vec3_dot(across, across) < FLAT * FLAT * squares ? FLAT_EDGE
                                                                      : BENT_EDGE;
}

/* The sine of an edge's turn, below 0 in a hollow. */
static double turn_of(const finder *f, const burnish_edge *edge) {
    const burnish_vec3 a = burnish_vec3_normalize(cross_of(f, edge->triangles[0]));
    const burnish_vec3 b = burnish_vec3_normalize(cross_of(f, edge->triangles[1]));
    const burnish_vec3 u = burnish_vec3_normalize(along(f, edge->ends[0], edge->ends[1]));
    return burnish_vec3_dot(burnish_vec3_cross(a, b), u);
}

static double distance_of(const finder *f, const burnish_edge *edge, uint32_t vertex) {
    const burnish_vec3 u = burnish_vec3_normalize(along(f, edge->ends[0], edge->ends[1]));
    return burnish_vec3_length(burnish_vec3_cross(u, along(f, edge->ends[0], vertex)));
}

static int is_similar(double a, double b) {
    return burnish_magnitude(a - b) < SIMILAR * burnish_magnitude(b);
}

static int has_end(const burnish_edge *edge, uint32_t vertex) {
    return edge->ends[0] == vertex || edge->ends[1] == vertex;
}

/* From an edge across the facet of a triangle, which is entered from another edge. */
static crossing cross_facet(const finder *f, const burnish_edge *edge, uint32_t triangle,
                            uint32_t from, int reach) {
    crossing found = {0, 0, 0, 0};
    for (int k = 0; k < 3 && reach > 0 && found.turn == 0; ++k) {
        const uint32_t i = f->around[3 * (size_t)triangle + (size_t)k] - 1;
        if (i == UINT32_MAX || i == from) {
            continue;
        }
        const burnish_edge *other = &f->edges[i];
        const uint32_t beyond = other->triangles[other->triangles[0] == triangle];
        if (f->kinds[i] == FLAT_EDGE) {
            found = cross_facet(f, edge, beyond, i, reach - 1);
        } else if (!has_end(edge, other->ends[0]) && !has_end(edge, other->ends[1])) {
            const double wide = distance_of(f, edge, other->ends[0]);
            if (is_similar(distance_of(f, edge, other->ends[1]), wide)) { /* parallel */
                found = (crossing){i, beyond, turn_of(f, other), wide};
            }
        }
    }
    return found;
}

/* 1: a bend begins at the edge with the facet on one side, and the other side is wider. */
static int begins_bend(const finder *f, uint32_t i, int side) {
    const burnish_edge *edge = &f->edges[i];
    const crossing a = cross_facet(f, edge, edge->triangles[side], i, REACH);
    if (a.turn == 0 || !is_similar(2 * turn_of(f, edge), a.turn)) {
        return 0;
    }
    const crossing b = cross_facet(f, &f->edges[a.edge], a.beyond, a.edge, REACH);
    const double area = burnish_vec3_length(cross_of(f, edge->triangles[!side]));
    const double length = burnish_vec3_length(along(f, edge->ends[0], edge->ends[1]));
    return area > a.wide * length && is_similar(b.wide, a.wide) &&
           (is_similar(b.turn, a.turn) || is_similar(2 * b.turn, a.turn));
}

void burnish_edges_find_tangents(const burnish_mesh_view *mesh, burnish_memory *memory,
                                 burnish_edges *edges) {
    finder f = {mesh, edges->items, NULL, NULL};
    f.kinds = burnish_allocate(memory, edges->count, sizeof *f.kinds, "edges");
    f.around = burnish_allocate_zeroed(memory, mesh->triangle_count, 3 * sizeof *f.around, "edges");
    const size_t count = memory->status == BURNISH_STATUS_OK ? edges->count : 0;
    for (uint32_t i = 0; i < count; ++i) {
        f.kinds[i] = kind_of(&f, &edges->items[i]);
        for (int k = 0; k < 2 && f.kinds[i] != NO_BEND; ++k) {
            uint32_t *at = f.around + 3 * (size_t)edges->items[i].triangles[k];
            at[at[0] == 0 ? 0 : at[1] == 0 ? 1 : 2] = i + 1;
        }
    }
    for (size_t i = 0; i < 2 * count; ++i) { /* a facet is seen across a flat edge */
        const uint32_t triangle = edges->items[i / 2].triangles[i % 2];
        for (int k = 0; k < 3 && f.kinds[i / 2] == FLAT_EDGE; ++k) {
            const uint32_t other = f.around[3 * (size_t)triangle + (size_t)k] - 1;
            if (other != UINT32_MAX && f.kinds[other] == BENT_EDGE &&
                begins_bend(&f, other, edges->items[other].triangles[0] != triangle)) {
                edges->items[other].flags |= BURNISH_EDGE_TANGENT;
            }
        }
    }
    burnish_release(memory->context, f.kinds);
    burnish_release(memory->context, f.around);
}
