/* Flags against each other, and the output's name and format. */
#ifndef TOOL_RENDER_CHECK_H
#define TOOL_RENDER_CHECK_H

#include "render/settings/settings.h"

/* Checks flags that exclude each other, and chooses the instruction set. Errors: ARGUMENT. */
burnish_status render_check(render_settings *settings, burnish_error *error);

/* Checks flags as render_check does, and finds the output's name and format. Errors: ARGUMENT. */
burnish_status render_finish(render_settings *settings, burnish_error *error);

#endif
