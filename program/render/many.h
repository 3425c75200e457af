/* `burnish render` with several inputs; implemented in program/batch. */
#ifndef TOOL_RENDER_MANY_H
#define TOOL_RENDER_MANY_H

#include "render/settings/settings.h"

/* Draws each operand of the call with these settings, as `burnish batch` does, to files in
 * --output-dir or named by the template of --output. Sets call->exit_code if some inputs fail.
 * Errors: ARGUMENT (flags for one picture, names), MEMORY, READ, WRITE. */
burnish_status render_many(const render_settings *settings, cli_call *call, burnish_error *error);

#endif
