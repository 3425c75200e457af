/* Attributes of visible points, perspective-correct. */
#ifndef BURNISH_SHADE_INTERPOLATE_H
#define BURNISH_SHADE_INTERPOLATE_H

#include "shade/shade.h"

/* A block of points while it is shaded. */
typedef struct burnish_points {
    int count;
    float normal[3][BURNISH_FRAGMENT_BLOCK];  /* unit, turned toward the viewer's side */
    float length[BURNISH_FRAGMENT_BLOCK];     /* of the normal before it was normalised, near 1 */
    float diffuse[3][BURNISH_FRAGMENT_BLOCK]; /* colour of the surface at the vertices, 1 without */
    uint16_t material[BURNISH_FRAGMENT_BLOCK];
} burnish_points;

/* Normals, their lengths, vertex colours and materials of a block. */
void burnish_interpolate(const burnish_shader *shader, const burnish_fragments *fragments,
                         burnish_points *points);

#endif
