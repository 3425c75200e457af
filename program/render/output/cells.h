/* Draws the cells of a picture. */
#ifndef TOOL_RENDER_CELLS_H
#define TOOL_RENDER_CELLS_H

#include "render/output/report.h"

/* Draws a cell whose view, lobe and camera are set, and warns about it. */
burnish_status render_draw_cell(render_result *result, burnish_renderer *renderer,
                                burnish_render_options *options, render_cell *cell,
                                burnish_error *error);

/* Draws only its pixels, without annotations; *depth as in render_draw. */
burnish_status render_draw_pixels(render_result *result, burnish_renderer *renderer,
                                  burnish_render_options *options, render_cell *cell, float **depth,
                                  burnish_error *error);

#endif
