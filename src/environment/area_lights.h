/* Area lights as polygons, spheres and tubes, and a GGX highlight of a given alpha as a sum of
 * lobes. */
#ifndef BURNISH_ENVIRONMENT_AREA_LIGHTS_H
#define BURNISH_ENVIRONMENT_AREA_LIGHTS_H

#include "burnish/light.h"
#include "shading/polygon.h"

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

static inline int burnish_area_is_flat(const burnish_area_light *light) {
    return light->shape <= BURNISH_AREA_DISC;
}

/* Of a sphere or line. */
double burnish_area_radius(const burnish_area_light *light);

/* The polygon, sphere or tube of a light, distant if the light is, in the light's space; a disc is
 * a polygon of the same area. Returns 0 if the light shines on nothing: it is seen from its edge,
 * or is so small, large or far away that single precision cannot hold it.
 *   lobes  NULL: only diffuse light is wanted */
int burnish_area_polygon(const burnish_area_light *light, const burnish_light_lobes *lobes,
                         burnish_polygon_constants *polygon);

#endif
