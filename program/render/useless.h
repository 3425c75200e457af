/* Flags without an effect. */
#ifndef TOOL_RENDER_USELESS_H
#define TOOL_RENDER_USELESS_H

#include "render/output/result.h"

enum { RENDER_NEEDS_MAX = 40 };

/* What flags need of other flags, and of the input. Without a mesh no need of the input is met. They
 * return the number of needs. Call the first one when the format is known. */
size_t render_list_needs(const render_settings *settings, cli_need needs[RENDER_NEEDS_MAX]);
size_t render_list_input_needs(const render_settings *settings, const burnish_mesh *mesh,
                               cli_need needs[RENDER_NEEDS_MAX]);

/* Adds a warning to the result for each flag in vain. Errors: ARGUMENT with --strict. */
burnish_status render_warn_needs(render_result *result, const cli_need *needs, size_t count,
                                 burnish_error *error);

/* The same for all needs: without a mesh those of other flags, with a mesh those of the input. For a
 * picture of a batch, which warns once, notes the unmet needs of the input instead. */
burnish_status render_warn_useless(render_result *result, const burnish_mesh *mesh,
                                   burnish_error *error);

/* ARGUMENT for flags that a drawing, or an SVG or PDF, can not show. Call it when the format is
 * known. */
burnish_status render_check_drawing(render_settings *settings, burnish_error *error);

#endif
