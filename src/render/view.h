/* From a camera and lights in scene units to what raster and shade work with. */
#ifndef BURNISH_RENDER_VIEW_H
#define BURNISH_RENDER_VIEW_H

#include "burnish/render.h"
#include "render/planes.h"

/* What a camera and lights become. */
typedef struct burnish_view {
    burnish_raster_view raster;
    burnish_rays rays; /* from the eye */
    burnish_view_distance distance;
    burnish_kernels_lighting lighting; /* lights from the eye, and viewer; no material */
} burnish_view;

/* Errors: ARGUMENT (a camera without a direction, or further away than float arithmetic reaches),
 * LIMIT. */
burnish_status burnish_view_create(const burnish_mesh_view *mesh,
                                   const burnish_render_options *options, burnish_view *view,
                                   burnish_error *error);

#endif
