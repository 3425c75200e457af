/* Drawing a cell with its annotations. */
#ifndef TOOL_RENDER_ANNOTATE_H
#define TOOL_RENDER_ANNOTATE_H

#include "render/output/report.h"

/* Draws the mesh. *depth receives the distances that render_annotate wants, NULL where it wants
 * none; to be freed, also after an error, which leaves NULL. */
burnish_status render_draw(const render_result *result, burnish_renderer *renderer,
                           const burnish_render_options *options, render_cell *cell, float **depth,
                           burnish_error *error);

/* Makes the cell's drawing, of the frame that the renderer has drawn last, with annotations. */
burnish_status render_trace(const render_result *result, burnish_renderer *renderer,
                            const burnish_render_options *options, render_cell *cell,
                            const float *depth, burnish_error *error);

/* The cells' drawings as an SVG: the only one, or a sheet of them.
 *   cells  as the sheet of their images takes them
 *   ink    of labels */
burnish_status render_encode_drawing(const render_result *result, const burnish_sheet_cell *cells,
                                     const uint8_t ink[3], picture_file *file,
                                     burnish_error *error);

/* Draws what --annotate asks for over the cell, and warns of what found no room. */
burnish_status render_annotate(render_result *result, const burnish_render_options *options,
                               render_cell *cell, const float *depth, burnish_error *error);

#endif
