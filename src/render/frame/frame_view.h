/* Camera, lights and materials, as raster and shading work with them. */
#ifndef BURNISH_RENDER_FRAME_FRAME_VIEW_H
#define BURNISH_RENDER_FRAME_FRAME_VIEW_H

#include "base/memory.h"
#include "burnish/render.h"
#include "render/frame/surface.h"
#include "render/light/ground.h"
#include "render/light/maps/occlusion.h"
#include "render/light/maps/shadow.h"
#include "render/space.h"

typedef struct burnish_view {
    burnish_raster_view raster;
    burnish_shading shading; /* kernels and ops are the caller's to set */
    burnish_view_distance distance;
    double eye[3]; /* in the raster's space */
    burnish_area_view area;
    double pixel; /* what one is wide there, about, in the middle of the mesh */
    burnish_occlusion_lookup occlusion;
    burnish_ray_light ray_light;
    burnish_ground_view ground;
    burnish_vec3 key; /* toward the first light, a unit vector; 0, 0, 0: it is not directional */
    burnish_shadow_lookup shadow;
    size_t lobe_fallbacks; /* materials with a lower order than the lobe's: their exponent allows no
                              more */
} burnish_view;

/* A frame's materials, each folded with the lights. Owned; all zero before the first frame, a later
 * frame uses the arrays again. */
typedef struct burnish_shaders {
    burnish_kernels_shader *items;   /* one per material, and white */
    burnish_light_constants *lights; /* light_count per shader */
    size_t item_capacity, light_capacity;
} burnish_shaders;

/* The view reads the shaders and, where a material is special, texturing, which learns what the
 * view says; NULL: none is. Errors: ARGUMENT (a camera without a direction, or further away than
 * float arithmetic reaches; a material that can't be shaded), LIMIT, MEMORY. */
burnish_status burnish_view_create(const burnish_drawn_mesh *mesh,
                                   const burnish_render_options *options, burnish_shaders *shaders,
                                   burnish_texturing *texturing, burnish_view *view,
                                   burnish_memory *memory);

#endif
