/* Generated normals: the average of the faces around a vertex, weighted by their angles there. */
#ifndef BURNISH_MESH_BUILD_NORMALS_NORMALS_H
#define BURNISH_MESH_BUILD_NORMALS_NORMALS_H

#include "mesh/build/normals/welded.h"

/* A sum shorter than this share of its weights is rounding noise around zero. */
#define BURNISH_CANCELLED 1e-9
#define BURNISH_LARGEST_ANGLE 4 /* more than pi */

/* A flat face with so many times the area of the other faces gives its normal to all of them. */
#define BURNISH_FLAT_SHARE 4

/* Faces of a vertex that share a normal. */
typedef struct burnish_face_set {
    burnish_vec3 sum;       /* of unit normals times angles */
    double area, flat_area; /* twice the areas: of all; of the largest and those coplanar with it */
    size_t largest;
    int dominated; /* the flat ones give the normal */
} burnish_face_set;

/* The one-rings of some vertices: what is known of the faces at their corners, in arrays of
 * `capacity`. */
typedef struct burnish_rings {
    double sharp_cosine;  /* an edge is smooth above it, ... */
    double smooth_cosine; /* ... and above this one whatever is around */
    const burnish_surface *surface;
    int asks;                /* 1: edges in between ask the surface; 0: there are none */
    const uint32_t *corners; /* those measured */
    int flat;                /* crease angle 0: no edge is smooth */
    int wide;                /* 1: the processor has AVX2, 2: AVX-512 */
    size_t capacity;
    /* arrays of `capacity` + 8 items: eight can be read from any index */
    double *x, *y, *z;         /* unit normals of the corners' faces */
    double *lengths;           /* twice their areas */
    double *angles;            /* between the edges at the corner */
    uint32_t *next, *previous; /* the edges' other ends */
    uint32_t *parents;         /* sets of joined faces of the vertex at hand, and ... */
    burnish_face_set *sets;    /* ... what is known of them */
    uint64_t *edges;           /* 2 per corner: other end and face */
    struct burnish_answer
        *answers; /* the latest answers of the surface: each edge is asked for from both ends */
    struct burnish_known *known; /* for the surface while it answers */
} burnish_rings;

/* Scratch for one thread and `capacity` corners at a time. crease_angle is in degrees, [0, 180], or
 * BURNISH_CREASE_AUTO: then the measured surface, which stays until the rings go, decides. `wide`
 * does not affect the bits of the results. Errors: memory->status; the
 * arrays are then incomplete. */
void burnish_rings_create(burnish_rings *rings, size_t capacity, double crease_angle,
                          const burnish_surface *surface, int wide, burnish_memory *memory);

/* Releases the scratch; rings of zero bytes are allowed. */
void burnish_rings_destroy(burnish_rings *rings, const burnish_context *context);

/* Measures the faces at corners of any number of vertices.
 *
 * corners: count corners (3 * triangle + 0..2), grouped by vertex, valid until the next call
 * count:   at most the rings' capacity */
void burnish_rings_measure(burnish_rings *rings, const uint32_t *corners, size_t count);

/* Computes unit normals of the corners that meet in one vertex, in O(count log count).
 *
 * Two faces are joined when they share an edge at this vertex and their normals differ by less than
 * the crease angle, or as burnish_surface_is_smooth decides. Each set of joined faces has one
 * normal: the sum of its unit face normals times their angles at the vertex (Thuermer and Wuethrich
 * 1998). It does not depend on how a flat face is cut into triangles. With BURNISH_CREASE_AUTO a
 * flat face with four times the area of the rest of its set determines the normal, so the slivers
 * of a fillet do not bend it. If the sum cancels to zero, each face keeps its own normal.
 *
 * first, count: the range of the vertex's corners among the measured ones
 * normals:      3 per corner, in their order, written
 * Returns 1 when all of them are the same, bit for bit; then only the first one is written. */
int burnish_rings_normals(burnish_rings *rings, size_t first, size_t count, float *normals);

/* The same for up to BURNISH_SETS_MAX faces whose neighbours are known. */
struct burnish_neighbors;
int burnish_rings_normals_of(burnish_rings *rings, size_t first, size_t count,
                             struct burnish_neighbors *neighbors, float *normals);

/* Writes v / |v| in float with no negative zeros; 0 when v has no direction or is not finite. */
void burnish_store_unit(burnish_vec3 v, float unit[3]);

#endif
