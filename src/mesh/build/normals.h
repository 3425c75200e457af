/* Generated normals: the average of the faces around a vertex, weighted by their angles there. */
#ifndef BURNISH_MESH_BUILD_NORMALS_H
#define BURNISH_MESH_BUILD_NORMALS_H

#include <stddef.h>
#include <stdint.h>

#include "core/memory.h"
#include "core/vector.h"

/* The one-rings of some vertices: what is known of the faces at their corners, in arrays of
 * `capacity`. */
typedef struct burnish_rings {
    double crease_cosine;
    int flat; /* crease angle 0: no edge is smooth */
    int wide; /* eight faces are compared at once: the processor has AVX2 */
    size_t capacity;
    /* arrays of `capacity` and eight more, so that eight can be read from anywhere */
    double *x, *y, *z;         /* unit normals of the corners' faces */
    double *lengths, *dots;    /* |a x b| and a . b of the edges at the corner */
    double *angles;            /* between them */
    uint32_t *next, *previous; /* the edges' other ends */
    uint32_t *parents;         /* sets of joined faces of the vertex at hand, and ... */
    burnish_vec3 *sums;        /* ... their normals */
    uint64_t *edges;           /* 2 per corner: other end and face */
} burnish_rings;

/* Scratch for one thread and `capacity` corners at a time.
 *   crease_angle  degrees, [0, 180]
 *   wide          1: the processor has AVX2; the results have the same bits
 * Errors: memory->status; the arrays are then incomplete. */
void burnish_rings_create(burnish_rings *rings, size_t capacity, double crease_angle, int wide,
                          burnish_memory *memory);

/* Releases the scratch; rings of zero bytes are allowed. */
void burnish_rings_destroy(burnish_rings *rings, const burnish_context *context);

/* Measures the faces at corners of any number of vertices.
 *
 * positions:        3 per vertex
 * corner_positions: 3 per triangle, every triangle with area
 * corners:          count corners (3 * triangle + 0..2), those of a vertex together
 * count:            at most the rings' capacity */
void burnish_rings_measure(burnish_rings *rings, const float *positions,
                           const uint32_t *corner_positions, const uint32_t *corners, size_t count);

/* Unit normals of the corners that meet in one vertex, O(count log count).
 *
 * Two faces are joined when they share an edge at this vertex and their normals differ by less than
 * the crease angle; each set of joined faces has one normal, the sum of its unit face normals times
 * their angles at the vertex (Thuermer and Wuethrich 1998), which does not depend on how a flat
 * face is cut into triangles. Where the sum cancels to nothing, each face keeps its own.
 *
 * first, count: where the vertex's corners stand among those measured
 * normals:      3 per corner, in their order, written
 * Returns 1 when all of them are the same, bit for bit; then only the first one is written. */
int burnish_rings_normals(burnish_rings *rings, size_t first, size_t count, float *normals);

/* The cross product of two edges: twice the area long, along the normal by winding. */
static inline burnish_vec3 burnish_face_cross(const float *positions, const uint32_t vertices[3]) {
    burnish_vec3 a = burnish_vec3_loadf(positions + 3 * (size_t)vertices[0]);
    burnish_vec3 b = burnish_vec3_loadf(positions + 3 * (size_t)vertices[1]);
    burnish_vec3 c = burnish_vec3_loadf(positions + 3 * (size_t)vertices[2]);
    return burnish_vec3_cross(burnish_vec3_sub(b, a), burnish_vec3_sub(c, a));
}

/* Writes v / |v| in float with no negative zeros; 0 when v has no direction or is not finite. */
void burnish_store_unit(burnish_vec3 v, float unit[3]);

#endif
