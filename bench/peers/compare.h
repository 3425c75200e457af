/* Two pictures of one scene, byte by byte, where they show the same triangle. */
#ifndef BURNISH_BENCH_PEERS_COMPARE_H
#define BURNISH_BENCH_PEERS_COMPARE_H

#include <stddef.h>

/* Pixels that neither picture covers are not counted. */
typedef struct burnish_peers_comparison {
    size_t same;           /* pixels where both show the same triangle */
    size_t histogram[256]; /* their bytes by difference */
    size_t other_triangle; /* both show a triangle, but not the same: at an edge */
    size_t other_histogram[256];
    size_t coverage; /* one shows a triangle, the other none */
    int largest;     /* difference where the triangle is the same */
    int largest_other;
} burnish_peers_comparison;

/* Reads two pictures and their triangle numbers, as worker.h says. Returns 0 if a file can't be
 * read. */
int burnish_peers_compare(const char *const pictures[2], const char *const triangles[2],
                          burnish_peers_comparison *comparison);

#endif
