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
#include "simd/isa_ops.h"

/* How a pixel's position on the screen becomes one in space. A visible point lies, from the eye, at
 *   (ray + x ray_x + y ray_y + (1 - depth) ray_depth) / q,   x, y in pixels from the centre,
 *   q = depth * q_per_depth + q_constant (1/w in perspective, 1 in parallel projection). */
typedef struct burnish_rays {
    float ray[3], ray_x[3], ray_y[3], ray_depth[3];
    float q_per_depth, q_constant;
} burnish_rays;

/* A material and its lobe, before they are folded with the lights. */
typedef struct burnish_shade_material {
    burnish_material material;
    burnish_lobe_spec lobe;
} burnish_shade_material;

typedef struct burnish_shader {
    burnish_rays rays; /* from the eye */
    const burnish_kernels *batch;
    burnish_kernels_lighting lighting; /* lights, from the eye, and viewer; not the material */
    const burnish_shade_material *materials;
    /* the mesh */
    const burnish_attributes *attributes;
    const uint16_t *triangle_materials; /* or NULL */
    int needs_position; /* 1: a point light or a local viewer: points must have x, y and depth */
} burnish_shader;

/* Whether normals are scaled as Lyon does: points keep the length that interpolation leaves. */
static inline int burnish_shader_is_lyon(const burnish_shader *shader) {
    return shader->lighting.lobe.kind == BURNISH_LOBE_LYON &&
           shader->lighting.specular_model == BURNISH_SPECULAR_BLINN;
}

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
