/* From the camera flags to a camera. */
#ifndef TOOL_RENDER_CAMERA_H
#define TOOL_RENDER_CAMERA_H

#include "render/settings.h"

/* The camera of one view of the mesh.
 *   height  of a parallel projection before --camera-zoom-factor; 0: as the flags say */
burnish_status render_camera(const burnish_mesh *mesh, const render_settings *settings,
                             render_view view, double height, burnish_camera *camera,
                             burnish_error *error);

/* "front", "right" ...; "view" for VIEW_FREE. */
const char *render_view_name(render_view view);

/* The up axis in use, as --up names it. */
const char *render_up_name(const burnish_mesh *mesh, const render_settings *settings);

#endif
