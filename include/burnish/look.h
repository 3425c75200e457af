/* burnish/look.h: looks: named sets of lights, background, occlusion and edges.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_LOOK_H
#define BURNISH_LOOK_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/mesh.h"
#include "burnish/render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The looks. docs/README.md shows them. */
typedef enum burnish_look {
    BURNISH_LOOK_PLAIN, /* the default: key, fill and rim light on white */
    /* A product studio of area lights and a dome (light.h), with ambient occlusion on a light grey
     * background. White surfaces get up to twice the light of white, which soft tone mapping
     * keeps below it; metals reflect the lights. */
    BURNISH_LOOK_STUDIO,
    BURNISH_LOOK_CLAY,      /* all surfaces in one matt, warm colour, without highlights */
    BURNISH_LOOK_TECHNICAL, /* edges over light, matt surfaces; one light, white background */
    BURNISH_LOOK_DRAWING,   /* only edges: surfaces and background are white */
    BURNISH_LOOK_LOBES,     /* one light on dark surfaces, white background: for highlights */
    /* The lights of PLAIN, dimmed until a white surface reaches about 0.9 of white and no colour
     * saturates; background and edges of STUDIO, less occlusion. */
    BURNISH_LOOK_THREE_POINT,
    BURNISH_LOOK_COUNT
} burnish_look;

/* Sets the lights, area lights, dome, ambient light, tone mapping, background, occlusion, edges, edge_width,
 * outline_contrast and ignore_colors of a look. Call it before you change options.
 * Errors: ARGUMENT (options not initialised, unknown look). */
BURNISH_API burnish_status burnish_render_options_set_look(burnish_render_options *options,
                                                           burnish_look look, burnish_error *error);

/* Sets the colours of a look in the materials of a mesh, but not their exponents: CLAY and DRAWING
 * change all materials, PLAIN changes none, and the other looks change materials without their own
 * colours (has_diffuse 0). STUDIO makes them metallic-roughness materials, the others Phong
 * materials.
 * As burnish_mesh_set_material(), it excludes other threads from the mesh.
 * Errors: ARGUMENT (unknown look), MEMORY. */
BURNISH_API burnish_status burnish_look_set_materials(burnish_look look, burnish_mesh *mesh,
                                                      burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
