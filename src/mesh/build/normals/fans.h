/* Normals of many vertices at once, each with the same number of faces: vectors go over vertices. */
#ifndef BURNISH_MESH_BUILD_NORMALS_FANS_H
#define BURNISH_MESH_BUILD_NORMALS_FANS_H

#include "mesh/build/normals/joining.h"

enum { BURNISH_FANS = 32 /* vertices */ };

/* The faces at up to BURNISH_FANS vertices: one row per face. */
typedef struct burnish_fans {
    double x[BURNISH_PAIRWISE_MAX][BURNISH_FANS]; /* unit normals */
    double y[BURNISH_PAIRWISE_MAX][BURNISH_FANS];
    double z[BURNISH_PAIRWISE_MAX][BURNISH_FANS];
    double lengths[BURNISH_PAIRWISE_MAX][BURNISH_FANS]; /* twice the areas */
    double angles[BURNISH_PAIRWISE_MAX][BURNISH_FANS];
    uint32_t next[BURNISH_PAIRWISE_MAX][BURNISH_FANS]; /* other ends of the edges */
    uint32_t previous[BURNISH_PAIRWISE_MAX][BURNISH_FANS];
    int64_t joined[BURNISH_PAIRWISE_MAX][BURNISH_FANS];   /* bits: neighbours across smooth edges */
    int64_t doubtful[BURNISH_PAIRWISE_MAX][BURNISH_FANS]; /* bits: later ones, across others */
    int64_t chosen[BURNISH_PAIRWISE_MAX][BURNISH_FANS];   /* masks: whether a face counts */
    double sum[3][BURNISH_FANS];
    uint32_t corners[BURNISH_PAIRWISE_MAX * BURNISH_FANS]; /* of vertices copied to rings */
    float normals[3][BURNISH_FANS];                        /* the result, and ... */
    uint32_t
        is_one[BURNISH_FANS]; /* ... whether all faces are one set, whose sum does not cancel */
} burnish_fans;

/* Measures the faces of `count` vertices and computes the normals of those whose faces are joined by
 * edges that are smooth whatever is around: burnish_rings_normals would have the same bits.
 *
 * starts: of each vertex's corners in the surface's list
 * count:  1 to BURNISH_FANS
 * faces:  of each vertex, 1 to BURNISH_PAIRWISE_MAX */
void burnish_fans_normals(burnish_fans *fans, const burnish_rings *rings, const uint32_t *starts,
                          size_t count, size_t faces);

/* The neighbours of a vertex's faces. */
void burnish_fans_neighbors(const burnish_fans *fans, size_t vertex, size_t faces,
                            burnish_neighbors *neighbors);

/* Copies the faces of a vertex to the rings' arrays, from `first` on, and its corners to those of
 * the fans. What reads them as vectors waits until they are stored: copy several vertices before. */
void burnish_fans_to_rings(burnish_fans *fans, const burnish_rings *rings, size_t vertex,
                           size_t faces, const uint32_t *corners, size_t first);

#endif
