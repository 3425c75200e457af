/* Measures point clouds: where most points are, and how dense they are. All results depend
 * on the points and their order alone. */
#ifndef BURNISH_MESH_READ_COMMON_CLOUD_H
#define BURNISH_MESH_READ_COMMON_CLOUD_H

#include "base/memory.h"
#include "core/tasks.h"
#include "mesh/data/box.h"

typedef struct burnish_cloud {
    const float *positions; /* 3 per point, finite */
    size_t count;           /* > 0 */
    int are_splats;         /* 1: of a capture, with surroundings that are not framed */
    burnish_box inner;
    size_t outside;  /* points outside the inner box */
    double spacing;  /* median distance to the 6th nearest position, or to the farthest of fewer */
    double wide;     /* the same, but three quarters are below it; 0: no two points are near */
    uint32_t *order; /* the points cell by cell of a grid, the caller's to release; NULL if spacing
                        is 0 */
} burnish_cloud;

/* Measures the points, positions and count being set.
 *
 * The inner box is the bounding box, unless outliers dominate it: with 8 points or more, let T be
 * the box of all points but the most extreme 1/1000 (at least one) at either end of each axis,
 * widened on all sides by half its longest side. If the bounding box is over 4 times as long, along
 * its diagonal, as the box of the points in T, the inner box is the latter. Strays, whose 6th nearest
 * point is over 8 times as far as `spacing`, are left out of it too, if they are at most 1/100 and its
 * diagonal becomes shorter by 1.15.
 *
 * Splats thin out around what was captured: there T is the box of all but the most extreme 1/50,
 * widened by 3/20, and bounds that are 1.15 times as long suffice.
 *
 * Errors: MEMORY. */
burnish_status burnish_cloud_measure(burnish_cloud *cloud, burnish_memory *memory);

/* For qsort(). */
int burnish_compare_floats(const void *a, const void *b);

double burnish_cloud_diagonal(const burnish_box *box);

/* ---- cloud_normals.c ---- */

/* Estimates unit normals, 3 floats per point, of the plane through the
 * neighbourhood of a point, blended between neighbourhoods, of either sign. 0, 0, 0 if that is not like a surface.
 * If that holds for half of the points or more, *are_surface is 0, and all are 0, 0, 0.
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_cloud_normals(const burnish_cloud *cloud, float *normals, int *are_surface,
                                     burnish_tasks *tasks, burnish_memory *memory);

#endif
