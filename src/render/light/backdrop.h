/* The environment as the background of a frame. */
#ifndef BURNISH_RENDER_LIGHT_BACKDROP_H
#define BURNISH_RENDER_LIGHT_BACKDROP_H

#include "burnish/render.h"
#include "core/vec3.h"

typedef struct burnish_backdrop {
    const burnish_environment *environment;
    int level;
    float strength;
    double corner[3], right[3], down[3]; /* direction at pixel (0, 0), and its change per pixel, in
                                            the axes of the environment */
} burnish_backdrop;

/* up: of the object, a unit vector */
burnish_backdrop burnish_backdrop_make(const burnish_render_options *options, burnish_vec3 up);

/* Linear light of the background at the centre of a pixel. */
void burnish_backdrop_light(const burnish_backdrop *backdrop, int x, int y, float rgb[3]);

#endif
