/* The kernels of environments, compiled once per instruction set (environment_isa.c). */
#ifndef BURNISH_ENVIRONMENT_ENVIRONMENT_OPS_H
#define BURNISH_ENVIRONMENT_ENVIRONMENT_OPS_H

#include "environment/environment.h"
#include "simd/isa.h"

/* A lobe max(0, 1 + zeta (c - 1))^order, order = 2^squarings, over the texels of a level. */
typedef struct burnish_environment_filter {
    const burnish_environment_level *level;
    float zeta; /* at least 1/2 */
    int squarings;
} burnish_environment_filter;

typedef struct burnish_environment_ops {
    /* Adds `scale` times the mean radiance around each of count unit vectors, weighted by the lobe:
     * a sum over the texels whose centre is inside of its cap, divided by the sum of the weights. */
    void (*filter_environment)(const burnish_environment_filter *filter, float scale,
                               const float *const axis[3], size_t count, float *const rgb[3]);
} burnish_environment_ops;

/* The table of an instruction set; NULL if this build does not have it. */
const burnish_environment_ops *burnish_environment_ops_for(burnish_isa isa);

#endif
