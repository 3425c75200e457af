/* Which faces around a vertex share a normal: joined across smooth edges. */
#ifndef BURNISH_MESH_BUILD_NORMALS_JOINING_H
#define BURNISH_MESH_BUILD_NORMALS_JOINING_H

#include "mesh/build/normals/normals.h"

/* Edges with at most this many faces at a vertex are compared face by face, regardless of the order
 * of the faces. Beyond it only neighbours in that order are compared, to keep the cost linear. */
enum { BURNISH_PAIRWISE_MAX = 8 };

/* Faces of a vertex that have bits in sets. */
enum { BURNISH_SETS_MAX = 32 };

/* Cached answers: a power of two. Zeros are not an answer, since no triangle is its own neighbour.
 */
enum { BURNISH_ANSWERS = 1024 };

typedef struct burnish_answer {
    uint32_t triangles[2], edge[2]; /* ascending */
    int is_smooth;
} burnish_answer;

static inline burnish_vec3 burnish_ring_normal(const burnish_rings *rings, size_t i) {
    return (burnish_vec3){rings->x[i], rings->y[i], rings->z[i]};
}

static inline uint32_t burnish_find_root(uint32_t *parents, uint32_t i) {
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

/* For each of a few faces, as bits, the faces that it shares an edge with. */
typedef struct burnish_neighbors {
    uint32_t smooth[BURNISH_SETS_MAX];   /* across a smooth edge */
    uint32_t doubtful[BURNISH_SETS_MAX]; /* later ones across an edge that may be smooth */
    uint32_t any_doubtful;
} burnish_neighbors;

/* Sets of joined faces among a few, whose neighbours are known, as burnish_join_few has them; asks
 * the surface about doubtful edges. */
size_t burnish_join_neighbors(burnish_rings *rings, size_t first, size_t count,
                              burnish_neighbors *neighbors, uint32_t sets[BURNISH_SETS_MAX]);

/* Sets of joined faces among a few, at most BURNISH_SETS_MAX, as bits, in the order of their first
 * faces. Returns how many; 0 if an edge has more than BURNISH_PAIRWISE_MAX faces. */
size_t burnish_join_few(burnish_rings *rings, size_t first, size_t count,
                        uint32_t sets[BURNISH_SETS_MAX]);

/* Sets among any number, in rings->parents; returns whether all are one. */
int burnish_join_many(burnish_rings *rings, size_t first, size_t count);

#endif
