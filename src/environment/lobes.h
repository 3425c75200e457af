/* A GGX highlight of a given alpha as a sum of lobes. */
#ifndef BURNISH_ENVIRONMENT_LOBES_H
#define BURNISH_ENVIRONMENT_LOBES_H

enum { BURNISH_LIGHT_LOBES_MAX = 3 };

/* S(c) = max(0, 1 + zeta (c - 1))^order around the reflected direction; zeta >= 1. */
typedef struct burnish_light_lobe {
    int order; /* 1, 2, 4, 8, 16 or 32 */
    float zeta;
    float weight; /* share of the energy; the sum over the lobes is 1 */
} burnish_light_lobe;

typedef struct burnish_light_lobes {
    int count; /* [1, BURNISH_LIGHT_LOBES_MAX] */
    burnish_light_lobe lobe[BURNISH_LIGHT_LOBES_MAX];
} burnish_light_lobes;

/* alpha: clamped to [0.0025, 1]. */
burnish_light_lobes burnish_light_lobes_for(float alpha);

/* Two lobes that are fitted to GGX over all views together with an axis and a stretch
 * (environment_simd.h), for lights that are integrated for each point. */
burnish_light_lobes burnish_light_lobes_near(float alpha);

#endif
