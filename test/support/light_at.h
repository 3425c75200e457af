/* For tests of area lights' kernels: what one point receives. */
#ifndef BURNISH_TEST_LIGHT_AT_H
#define BURNISH_TEST_LIGHT_AT_H

#include "kernels_input.h"

/* A point as the kernels get it. */
typedef struct place {
    float normal[3], position[3], w, axis[3];
} place;

/* stretch: may be NULL */
static inline burnish_status light_at(const burnish_kernels *kernels,
                                      const burnish_kernels_polygon *polygon, const place *at,
                                      const float *stretch, float light[2], burnish_error *error) {
    burnish_kernels_points points = {.w = &at->w};
    burnish_kernels_axes axes = {.stretch = {NULL}};
    float *const out[2] = {&light[0], &light[1]};
    for (int k = 0; k < 3; ++k) {
        points.normal[k] = &at->normal[k];
        points.position[k] = &at->position[k];
        axes.axis[k] = &at->axis[k];
        axes.stretch[k] = stretch ? &stretch[k] : NULL;
    }
    light[0] = light[1] = NAN;
    return burnish_kernels_polygon_light(kernels, polygon, &points, &axes, 1, out, error);
}

#endif
