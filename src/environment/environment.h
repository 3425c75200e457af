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

/* Fill an equirectangular image of 3 width height floats with the environments "room" and "sky". */
void burnish_room_fill(int width, int height, float *rgb);
void burnish_sky_fill(int width, int height, float *rgb);

/* ---- Radiance in a direction, for backgrounds ---- */

/* The coarsest level whose texels are at most `angle` wide (radians), else 0. */
int burnish_environment_level_of(const burnish_environment *environment, double angle);

/* Weighs 4 x 4 texels by cubic B-splines: smooth, never negative, and exact for linear gradients.
 *   direction  in the axes of the environment, of any length but 0 */
void burnish_environment_lookup(const burnish_environment *environment, int level,
                                const double direction[3], float rgb[3]);

#endif
