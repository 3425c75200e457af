/* From visible points to colours: the Phong equation by kernels, in linear light.
 *
 * Everything here happens in the raster's space: model space moved and scaled so that the scene is
 * about 1 in size; positions count from the eye. */
#ifndef BURNISH_SHADING_SHADE_H
#define BURNISH_SHADING_SHADE_H

#include <stdint.h>

#include "simd/isa_ops.h"

/* How a point of the screen becomes one of space. What is visible at (x, y), in pixels from the
 * image's centre, right and up, lies from the eye at
 *   (ray + x ray_x + y ray_y + (1 - depth) ray_depth) / q,
 *   q = depth * q_per_depth + q_constant (1/w in perspective, 1 in parallel projection). */
typedef struct burnish_rays {
    float ray[3], ray_x[3], ray_y[3], ray_depth[3];
    float q_per_depth, q_constant;
} burnish_rays;

/* Points of the screen: (x + x_offset[i], y + y_offset[i]) with the depth of what they show. */
typedef struct burnish_screen_points {
    float x, y;
    const float *x_offset, *y_offset, *depth;
} burnish_screen_points;

/* Fragments that are shaded at once: their arrays stay in L1. */
enum { BURNISH_SHADE_BATCH = 256 };

/* Fragments to be shaded: arrays of `count` <= BURNISH_SHADE_BATCH, readable up to the next
 * multiple of 16. This is the one form that shading sees, whether the arrays are rows of a tile or
 * were gathered. */
typedef struct burnish_fragment_batch {
    int count;
    const float *normal[3];       /* turned toward the viewer's side, times 1/w */
    const float *color[3];        /* linear vertex colours times 1/w; all NULL: none */
    const float *inverse_w;       /* 1/w; read where burnish_shading_divides */
    burnish_screen_points points; /* read where burnish_shading.needs_position */
    const uint16_t *material;     /* NULL: all are 0 */
} burnish_fragment_batch;

/* What a frame is shaded with. */
typedef struct burnish_shading {
    const burnish_isa_ops *ops;
    const burnish_kernels_shader *shaders; /* one per material */
    burnish_rays rays;                     /* from the eye */
    int needs_position;                    /* 1: a point light or a local viewer */
    int is_lyon; /* 1: Lyon's lobe reads the length that interpolation leaves a normal */
} burnish_shading;

/* What a thread needs to shade a batch. */
typedef struct burnish_shade_scratch {
    float normal[3][BURNISH_SHADE_BATCH], diffuse[3][BURNISH_SHADE_BATCH];
    float position[3][BURNISH_SHADE_BATCH], w[BURNISH_SHADE_BATCH];
} burnish_shade_scratch;

/* Whether attributes are needed themselves, not times 1/w: colours, and normals whose length
 * matters. */
static inline int burnish_shading_divides(const burnish_shading *shading, int has_colors) {
    return has_colors || shading->is_lyon;
}

/* rgb gets the colours: linear light, >= 0, not clamped above. */
void burnish_shade(const burnish_shading *shading, const burnish_fragment_batch *batch,
                   burnish_shade_scratch *scratch, float *const rgb[3]);

#endif
