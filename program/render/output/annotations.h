/* Annotations and the legend of a cell, and drawings. */
#ifndef TOOL_RENDER_ANNOTATE_H
#define TOOL_RENDER_ANNOTATE_H

#include "burnish/sheet.h"
#include "picture/formats.h"
#include "render/output/result.h"

/* Makes the cell's drawing with annotations, from the last frame of the renderer. */
burnish_status render_trace(const render_result *result, render_cell *cell, const float *depth,
                            burnish_error *error);

/* The drawing of the only cell, or a sheet of all drawings, as SVG.
 *   cells  as the sheet of their images takes them
 *   ink    of labels */
burnish_status render_encode_drawing(const render_result *result, const burnish_sheet_cell *cells,
                                     const uint8_t ink[3], picture_file *file,
                                     burnish_error *error);

/* Draws the annotations over the cell, and warns about those without room.
 *   depth  distances of the mesh; NULL if no annotation is behind it */
burnish_status render_annotate(render_result *result, render_cell *cell, const float *depth,
                               burnish_error *error);

/* Draws the legend of --color-by over the image, on the right; nothing if the colours have none. */
void render_draw_legend(const render_result *result, burnish_image *image);

#endif
