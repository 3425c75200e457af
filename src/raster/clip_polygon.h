/* Homogeneous clipping. */
#ifndef BURNISH_RASTER_CLIP_POLYGON_H
#define BURNISH_RASTER_CLIP_POLYGON_H

#include "raster/raster_view.h"

/* A corner of a polygon while it is clipped. */
typedef struct burnish_clip_corner {
    float position[4]; /* x, y, z, w as burnish_raster_view defines them */
    float weights[3];  /* in the triangle */
} burnish_clip_corner;

enum { BURNISH_CLIP_MAX = 8 }; /* corners of a triangle cut by five planes */

/* Cuts a convex polygon by the near plane and the guard band.
 *   corners  `count` of them, room for BURNISH_CLIP_MAX
 *   count    [3, BURNISH_CLIP_MAX]
 * Returns the number left, 0 or 3 .. BURNISH_CLIP_MAX: corners beyond that, which only rounding can
 * make of a triangle, are dropped. A point on an edge that two triangles share comes out with the
 * same bits for both. */
int burnish_clip_polygon(burnish_clip_corner *corners, int count);

#endif
