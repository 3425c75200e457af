/* The inside of a burnish_environment: an image of the light from all directions, and smaller ones
 * that wide lobes are computed from.
 *
 * Row j and column i of an image of `height` rows: polar angle t = pi (j + 1/2) / height from the y
 * axis, azimuth a = 2 pi (i + 1/2) / width - pi; direction (sin t cos a, cos t, sin t sin a). */
#ifndef BURNISH_ENVIRONMENT_ENVIRONMENT_H
#define BURNISH_ENVIRONMENT_ENVIRONMENT_H

#include "base/memory.h"
#include "burnish/light.h"

/* The first image of an environment has at most so many columns, a power of two, and half as many
 * rows. The last has the least. */
enum {
    BURNISH_ENVIRONMENT_WIDTH = 1024,
    BURNISH_ENVIRONMENT_LEAST = 32,
    BURNISH_ENVIRONMENT_LEVELS = 6
};

typedef struct burnish_environment_level {
    int width, height;
    const float *texels[3];  /* planes */
    const float *columns[2]; /* cosine and sine of the azimuth */
    const float *rows[2];    /* cosine and sine of the polar angle */
    const float *weights;    /* solid angle of a texel of each row */
} burnish_environment_level;

struct burnish_environment {
    const burnish_context *owner; /* of the memory */
    uint64_t hash;                /* of the first image */
    int level_count;
    burnish_environment_level levels[BURNISH_ENVIRONMENT_LEVELS];
    float *memory;
};

#endif
