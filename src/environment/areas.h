/* Area lights as polygons. */
#ifndef BURNISH_ENVIRONMENT_AREAS_H
#define BURNISH_ENVIRONMENT_AREAS_H

#include "burnish/light.h"
#include "environment/lobes.h"
#include "shading/polygon.h"

/* The polygon of a light, distant if the light is, in the light's space; a disc is a polygon of the
 * same area. Returns 0 if the light shines on nothing: it is seen from its edge, or is so small,
 * large or far away that single precision cannot hold it.
 *   lobes  NULL: only diffuse light is wanted */
int burnish_area_polygon(const burnish_area_light *light, const burnish_light_lobes *lobes,
                         burnish_polygon_constants *polygon);

#endif
