/* A polygonal light, sphere or tube and its lobes, with everything worked out that does not depend
 * on the point. */
#ifndef BURNISH_SHADING_POLYGON_H
#define BURNISH_SHADING_POLYGON_H

#include "burnish/kernels.h"

typedef struct burnish_polygon_lobe {
    int squarings; /* log2 of the order */
    int terms;     /* composites: of 1 + (u + u^2) (term[0] + term[1] u^2 + ...), else 0 */
    float term[16];
    int is_narrow; /* zeta is large: what is not a polynomial is nearly one */
    float zeta, weight;
    float least_cosine, least_cosine_squared; /* of the part of the cap with c > 0 */
} burnish_polygon_lobe;

/* Spheres and tubes are polygons that face each point: c + x u + y v with the corners (x, y) in
 * `vertex`, c toward the centre, and u and v that depend on the point (round_simd.h). */
typedef enum burnish_polygon_shape {
    BURNISH_POLYGON_FLAT,
    BURNISH_POLYGON_SPHERE,
    BURNISH_POLYGON_TUBE
} burnish_polygon_shape;

typedef struct burnish_polygon_constants {
    burnish_polygon_shape shape;
    float thickness;            /* radius of spheres and tubes */
    float axis[3], half_length; /* of a tube: unit vector; else 0 */
    int vertex_count, is_distant, is_two_sided;
    int lobe_count;
    burnish_polygon_lobe lobes[BURNISH_POLYGON_LOBE_MAX];
    float vertex[BURNISH_POLYGON_VERTEX_MAX][3];
    float normal[3], offset; /* unit normal of the bright side, and its product with vertices */
    float center[3], radius; /* of a sphere around the vertices */
    float reach_cosine, reach_sine; /* of the widest lobe's cap */
} burnish_polygon_constants;

/* Checks a polygon and fills *constants. Errors: ARGUMENT. */
burnish_status burnish_polygon_constants_make(const burnish_kernels_polygon *polygon,
                                              burnish_polygon_constants *constants,
                                              burnish_error *error);

#endif
