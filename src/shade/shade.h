/* From visible points to colours: the Phong equation by kernels, in linear light.
 *
 * Everything here happens in the raster's space: model space moved by burnish_raster_view.origin
 * and scaled so that the scene is about 1 in size; the eye may be anywhere in it. */
#ifndef BURNISH_SHADE_SHADE_H
#define BURNISH_SHADE_SHADE_H

#include <stdint.h>

#include "kernels/kernels.h"
#include "raster/raster.h"

/* A material, ready for the kernels. */
typedef struct burnish_shade_material {
    float ambient[3];  /* Ia ka */
    float diffuse[3];  /* kd */
    float specular[3]; /* ks */
    burnish_lobe_kernel lobe;
    int lyon; /* 1: lambda by chord and Lyon's three-term normalisation */
} burnish_shade_material;

typedef struct burnish_shade_light {
    int point;       /* 0: directional */
    float vector[3]; /* directional: unit, toward the light; point: from the eye to the light */
    float half[3];   /* directional with a distant viewer: the unit half vector */
    float color[3];
} burnish_shade_light;

/* How a pixel's place becomes a place in space. A visible point lies, from the eye, at
 *   (ray + x ray_x + y ray_y + (1 - depth) ray_depth) / q,   x, y in pixels from the centre,
 *   q = depth * q_per_depth + q_constant (1/w in perspective, 1 in parallel projection). */
typedef struct burnish_shade_view {
    float ray[3], ray_x[3], ray_y[3], ray_depth[3];
    float q_per_depth, q_constant;
    float to_viewer[3]; /* unit; V where the viewer is distant */
    int local_viewer;   /* V from each point */
    int phong;          /* c = R.V instead of N.H */
} burnish_shade_view;

typedef struct burnish_shader {
    burnish_shade_view view;
    const burnish_shade_material *materials;
    const burnish_shade_light *lights;
    int light_count;
    /* the mesh */
    const float *normals;               /* 3 a vertex */
    const uint8_t *colors;              /* 4 a vertex or NULL */
    const uint16_t *triangle_materials; /* or NULL */
    const uint32_t *indices;
    const burnish_geometry *geometry;
} burnish_shader;

/* Colours of a block of visible points, each channel >= 0, not yet clamped. */
typedef struct burnish_shaded {
    float channel[3][BURNISH_FRAGMENT_BLOCK];
} burnish_shaded;

void burnish_shade(const burnish_shader *shader, const burnish_fragments *fragments,
                   burnish_shaded *shaded);

#endif
