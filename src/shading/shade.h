/* From visible points to colours: the Phong equation by kernels, in linear light.
 *
 * Everything here happens in the raster's space: model space moved by burnish_raster_view.origin
 * and scaled so that the scene is about 1 in size; the eye may be anywhere in it. */
#ifndef BURNISH_SHADING_SHADE_H
#define BURNISH_SHADING_SHADE_H

#include <stdint.h>

#include "burnish/kernels.h"
#include "raster/raster.h"
#include "shading/attributes.h"
#include "shading/table.h"

/* A material, before it is folded with the lights. */
typedef struct burnish_shade_material {
    float ambient[3];  /* Ia ka */
    float diffuse[3];  /* kd */
    float specular[3]; /* ks */
    burnish_kernels_lobe lobe;
} burnish_shade_material;

typedef struct burnish_shader {
    burnish_rays rays; /* from the eye */
    const burnish_kernels *batch;
    burnish_kernels_lighting lighting; /* lights, from the eye, and viewer; no material */
    const burnish_shade_material *materials;
    /* the mesh */
    const burnish_attributes *attributes;
    const uint16_t *triangle_materials; /* or NULL */
    int needs_position; /* 1: a light or the viewer is near, points must have x, y and depth */
} burnish_shader;

/* Colours of a block of visible points, each channel >= 0, not yet clamped. */
typedef struct burnish_shaded {
    float channel[3][BURNISH_FRAGMENT_BATCH];
} burnish_shaded;

/* The material that a thread shaded last, folded with the lights. */
typedef struct burnish_shade_cache {
    int material; /* -1: none yet */
    burnish_kernels_shader prepared;
} burnish_shade_cache;

/* Makes `material` the cache's. */
void burnish_shade_prepare(const burnish_shader *shader, int material, burnish_shade_cache *cache);

/* Whether every material and light can be shaded. Errors: ARGUMENT. */
burnish_status burnish_shader_check(const burnish_shader *shader, size_t material_count,
                                    burnish_error *error);

void burnish_shade(const burnish_shader *shader, burnish_shade_cache *cache,
                   const burnish_fragments *fragments, burnish_shaded *shaded);

#endif
