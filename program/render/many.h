/* What `burnish render` does with more than one picture. The room batch implements it. */
#ifndef TOOL_RENDER_MANY_H
#define TOOL_RENDER_MANY_H

#include "render/settings.h"

/* Draws each operand of the call by these settings, as `burnish batch` would, into files below
 * --output-dir or where the template of --output says. Sets call->exit_code where some failed.
 * Errors: ARGUMENT (flags for one picture, names), MEMORY, READ, WRITE. */
burnish_status render_many(const render_settings *settings, cli_call *call, burnish_error *error);

#endif
