/* Several inputs as one scene (--scene). */
#ifndef TOOL_RENDER_SCENE_JOIN_INPUTS_H
#define TOOL_RENDER_SCENE_JOIN_INPUTS_H

#include "base/cli/options.h"
#include "cli/input.h"

/* Makes a scene of the call's operands: sets load->items, which the caller releases, and load->root
 * unless it is given: the deepest folder that contains all inputs. Errors: ARGUMENT (what is no
 * file, a root that does not contain all), READ, MEMORY. */
burnish_status render_join_inputs(const cli_call *call, cli_input *load, burnish_error *error);

void render_release_inputs(cli_input *load);

#endif
