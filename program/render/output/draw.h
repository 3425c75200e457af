/* Draws pictures: of result->mesh, with result->renderer and result->options. */
#ifndef TOOL_RENDER_OUTPUT_DRAW_H
#define TOOL_RENDER_OUTPUT_DRAW_H

#include "render/output/result.h"

/* Aims and draws all cells, composes them, and draws planes: sets result->picture, its hash and
 * result->planes. Errors: as for cameras and drawing. */
burnish_status render_draw_picture(render_result *result, burnish_error *error);

/* Draws a cell whose view, lobe and camera are set, with annotations and legend, as pixels and for
 * an SVG or PDF as lines; warns about it. */
burnish_status render_draw_cell(render_result *result, render_cell *cell, burnish_error *error);

/* Draws a cell as a frame of a turntable: without annotations, and nothing is reported. */
burnish_status render_draw_frame(render_result *result, render_cell *cell, burnish_error *error);

#endif
