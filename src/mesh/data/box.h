/* Boxes around positions. */
#ifndef BURNISH_MESH_DATA_BOX_H
#define BURNISH_MESH_DATA_BOX_H

#include <float.h>

#include "burnish/mesh.h"

static inline burnish_box burnish_box_none(void) {
    return (burnish_box){{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
}

static inline void burnish_box_extend(burnish_box *box, const float p[3]) {
    for (int k = 0; k < 3; ++k) {
        box->low[k] = p[k] < box->low[k] ? p[k] : box->low[k];
        box->high[k] = p[k] > box->high[k] ? p[k] : box->high[k];
    }
}

static inline int burnish_box_holds(const burnish_box *box, const float p[3]) {
    return p[0] >= box->low[0] && p[0] <= box->high[0] && p[1] >= box->low[1] &&
           p[1] <= box->high[1] && p[2] >= box->low[2] && p[2] <= box->high[2];
}

static inline double burnish_box_longest_side(const burnish_box *box) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
        const double side = (double)box->high[k] - (double)box->low[k];
        longest = side > longest ? side : longest;
    }
    return longest;
}

/* The box of every `step`-th of `count` positions in another box, which may be the same object. Returns
 * how many there are; 0 leaves *box as it is. */
static inline size_t burnish_box_inside(const float *positions, size_t count, size_t step,
                                        const burnish_box *within, burnish_box *box) {
    const burnish_box limits = *within;
    size_t found = 0;
    for (size_t i = 0; i < count; i += step) {
        const float *p = positions + 3 * i;
        if (!burnish_box_holds(&limits, p)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            box->low[k] = found == 0 || p[k] < box->low[k] ? p[k] : box->low[k];
            box->high[k] = found == 0 || p[k] > box->high[k] ? p[k] : box->high[k];
        }
        ++found;
    }
    return found;
}

#endif
