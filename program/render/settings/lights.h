/* Values of the flags for light. */
#ifndef TOOL_RENDER_SETTINGS_LIGHTS_H
#define TOOL_RENDER_SETTINGS_LIGHTS_H

#include "render/settings/settings.h"

/* The comment names the type of the target. */
cli_handler render_flag_light;   /* render_lights */
cli_handler render_flag_ambient; /* render_ambient */

#endif
