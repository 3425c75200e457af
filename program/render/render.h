/* The work of `burnish render`: checks of its settings, and one picture, sheet or turntable. */
#ifndef TOOL_RENDER_RENDER_H
#define TOOL_RENDER_RENDER_H

#include "render/settings/settings.h"

/* Takes the output from the operands if it is the last one. *is_many: 1 if the pictures are a
 * batch's. Errors: ARGUMENT, READ, WRITE. */
burnish_status render_read_operands(render_settings *settings, cli_call *call, int *is_many,
                                    burnish_error *error);

/* Checks flags that exclude each other, and chooses the instruction set. Errors: ARGUMENT. */
burnish_status render_check(render_settings *settings, burnish_error *error);

/* Checks flags as render_check does, and finds the output's name and format. Errors: ARGUMENT. */
burnish_status render_finish(render_settings *settings, burnish_error *error);

/* Draws, writes and reports, from settings that render_finish has completed. Sets *exit_code if
 * success is not 0. */
burnish_status render_run(render_settings *settings, int *exit_code, burnish_error *error);

#endif
