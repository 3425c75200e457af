/* The work of `burnish render`. */
#ifndef TOOL_RENDER_RENDER_H
#define TOOL_RENDER_RENDER_H

#include "render/settings/settings.h"

/* Draws, writes and reports one picture, sheet or turntable, from settings that render_finish has
 * completed. Sets *exit_code if success is not 0. */
burnish_status render_run(render_settings *settings, int *exit_code, burnish_error *error);

/* Takes the output from the operands if it is the last one. *is_many: 1 if the pictures are a
 * batch's. Errors: ARGUMENT, READ, WRITE. */
burnish_status render_read_operands(render_settings *settings, cli_call *call, int *is_many,
                                    burnish_error *error);

#endif
