/* From the camera flags to a camera. */
#ifndef BURNISH_TOOL_RENDER_CAMERA_H
#define BURNISH_TOOL_RENDER_CAMERA_H

#include "render/settings.h"

/* The camera of one view of the scene. */
burnish_status burnish_cli_camera(const burnish_mesh *scene, const burnish_cli_render *settings,
                                  burnish_cli_view view, burnish_camera *camera,
                                  burnish_error *error);

/* "front", "right" ...; "view" for BURNISH_CLI_VIEW_FREE. */
const char *burnish_cli_view_name(burnish_cli_view view);

/* The up axis in use, as --up names it. */
const char *burnish_cli_up_name(const burnish_mesh *scene, const burnish_cli_render *settings);

#endif
