/* Radiance of an environment in a direction, for backgrounds. */
#ifndef BURNISH_ENVIRONMENT_LOOKUP_H
#define BURNISH_ENVIRONMENT_LOOKUP_H

#include "environment/environment.h"

/* The coarsest level whose texels are at most `angle` wide (radians), else 0. */
int burnish_environment_level_of(const burnish_environment *environment, double angle);

/* Weighs 4 x 4 texels by cubic B-splines: smooth, never negative, and exact for linear gradients.
 *   direction  in the axes of the environment, of any length but 0 */
void burnish_environment_lookup(const burnish_environment *environment, int level,
                                const double direction[3], float rgb[3]);

#endif
