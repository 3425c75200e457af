/* The welded mesh as the faces around a vertex are found in it. */
#ifndef BURNISH_MESH_BUILD_NORMALS_WELDED_H
#define BURNISH_MESH_BUILD_NORMALS_WELDED_H

#include <string.h>

#include "core/vec3.h"
#include "mesh/data/data.h"

/* The welded mesh, to measure the faces around a vertex and to look beyond them. */
typedef struct burnish_surface {
    const float *positions;
    const uint32_t *corner_positions; /* 3 per triangle, every triangle with area */
    const uint32_t *first_corner;     /* as the builder has them */
    const uint32_t *corners;
    int wide;                    /* as burnish_measure_faces() has it */
    int is_organic;              /* burnish_surface_is_organic() */
    struct burnish_known *known; /* a thread's own: what it computed; or NULL */
} burnish_surface;

/* The cross product of two edges: twice the area long, along the normal by winding. */
static inline burnish_vec3 burnish_face_cross(const float *positions, const uint32_t vertices[3]) {
    burnish_vec3 a = burnish_vec3_loadf(positions + 3 * (size_t)vertices[0]);
    burnish_vec3 b = burnish_vec3_loadf(positions + 3 * (size_t)vertices[1]);
    burnish_vec3 c = burnish_vec3_loadf(positions + 3 * (size_t)vertices[2]);
    return burnish_vec3_cross(burnish_vec3_sub(b, a), burnish_vec3_sub(c, a));
}

/* A repeated position makes an edge, and so the product, exactly 0. */
static inline int burnish_has_area(burnish_vec3 cross) {
    return cross.x != 0 || cross.y != 0 || cross.z != 0;
}

#endif
