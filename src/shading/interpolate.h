/* Attributes of visible points, perspective-correct. */
#ifndef BURNISH_SHADING_INTERPOLATE_H
#define BURNISH_SHADING_INTERPOLATE_H

#include "shading/shade.h"

/* A block of points while it is shaded. */
typedef struct burnish_points {
    int count;
    float normal[3][BURNISH_FRAGMENT_BATCH];  /* turned toward the viewer's side; times 1/w, for
                                                 Lyon's lobe as interpolated, near unit length */
    float diffuse[3][BURNISH_FRAGMENT_BATCH]; /* colour of the surface at the vertices, 1 without */
    uint16_t material[BURNISH_FRAGMENT_BATCH];
} burnish_points;

/* Normals, vertex colours (where the mesh has any) and materials of a block. */
void burnish_interpolate(const burnish_shader *shader, const burnish_fragments *fragments,
                         burnish_points *points);

#endif
