/* Distant area lights in maps. */
#ifndef BURNISH_ENVIRONMENT_AREAS_H
#define BURNISH_ENVIRONMENT_AREAS_H

#include <stddef.h>

#include "burnish/light.h"
#include "environment/lobes.h"

/* Adds the light of `light` in count directions w, unit vectors: the mean radiance weighted by the
 * lobes or, with lobes NULL, D(w) of light.h. */
void burnish_light_add_area(const burnish_area_light *light, const burnish_light_lobes *lobes,
                            const float *const w[3], size_t count, float *const rgb[3]);

#endif
