/* One picture, sheet or turntable, from settings that render_finish has completed. */
#ifndef TOOL_RENDER_RENDER_H
#define TOOL_RENDER_RENDER_H

#include "render/settings/settings.h"

/* Draws, writes and reports. Sets *exit_code if success is not 0. */
burnish_status render_run(render_settings *settings, int *exit_code, burnish_error *error);

/* Completes the settings and draws call->operands[0], in the sandbox if they ask for it. Sets
 * call->exit_code. */
burnish_status render_one(render_settings *settings, cli_call *call, burnish_error *error);

#endif
