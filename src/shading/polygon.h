/* A polygonal light and its lobes, with everything worked out that does not depend on the point. */
#ifndef BURNISH_SHADING_POLYGON_H
#define BURNISH_SHADING_POLYGON_H

#include "burnish/kernels.h"

typedef struct burnish_polygon_constants {
    int vertex_count, is_distant, is_two_sided;
    int order; /* log2 of the lobes' order, minus 1 */
    int lobe_count;
    float vertex[BURNISH_POLYGON_VERTEX_MAX][3];
    float normal[3], offset; /* unit normal of the bright side, and its product with vertices */
    float zeta[BURNISH_POLYGON_LOBE_MAX], weight[BURNISH_POLYGON_LOBE_MAX];
} burnish_polygon_constants;

/* The orders 2, 4 and 8. */
enum { BURNISH_POLYGON_ORDER_COUNT = 3 };

/* Checks a polygon and fills *constants. Errors: ARGUMENT. */
burnish_status burnish_polygon_constants_make(const burnish_kernels_polygon *polygon,
                                              burnish_polygon_constants *constants,
                                              burnish_error *error);

#endif
