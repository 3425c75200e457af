/* From a camera and lights in scene units to what raster and shade work with. */
#ifndef BURNISH_RENDER_VIEW_H
#define BURNISH_RENDER_VIEW_H

#include "burnish/render.h"
#include "raster/raster.h"
#include "shading/shade.h"

/* Errors: ARGUMENT (a camera without a direction, or further away than float arithmetic reaches).
 */
burnish_status burnish_view_create(const burnish_mesh_view *mesh,
                                   const burnish_render_options *options,
                                   burnish_raster_view *raster, burnish_rays *shade,
                                   burnish_kernels_lighting *lighting, burnish_error *error);

#endif
