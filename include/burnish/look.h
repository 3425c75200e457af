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

/* Sets of options by name. */
typedef enum burnish_look {
    BURNISH_LOOK_PLAIN, /* what burnish_render_options_default() has: the default rig on white */
    /* The same rig, so weak that a white surface comes out near 0.9 of white and no surface's own
     * colour is cut off, on a ground a little darker than white, with ambient occlusion. */
    BURNISH_LOOK_STUDIO,
    BURNISH_LOOK_CLAY,      /* studio without highlights: every surface one matt warm colour */
    BURNISH_LOOK_TECHNICAL, /* edges over light, matt surfaces; one light, white ground */
    BURNISH_LOOK_DRAWING,   /* edges alone: surfaces as white as the ground */
    BURNISH_LOOK_LOBES,     /* one light on dark surfaces, white ground: highlights stand out */
    BURNISH_LOOK_COUNT
} burnish_look;

/* Sets the options' lights, ambient light, background, occlusion, edges, edge_width and
 * ignore_colors as the look has them; call it before settings of your own.
 * Errors: ARGUMENT (options not from burnish_render_options_default(), no such look). */
BURNISH_API burnish_status burnish_render_options_set_look(burnish_render_options *options,
                                                           burnish_look look, burnish_error *error);

/* Gives the look's colours, without a highlight's exponent, to those of a mesh's materials that
 * have none of their own (has_diffuse 0); with CLAY and DRAWING to all, with PLAIN to none. Errors:
 * ARGUMENT (no such look), MEMORY. */
BURNISH_API burnish_status burnish_look_set_materials(burnish_look look, burnish_mesh *mesh,
                                                      burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
