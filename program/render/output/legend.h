/* The legend of --color-by: a bar of the colours, with numbers. */
#ifndef TOOL_RENDER_OUTPUT_LEGEND_H
#define TOOL_RENDER_OUTPUT_LEGEND_H

#include "render/output/report.h"

/* Draws it over the image, on the right; nothing if the colours have none. */
void render_draw_legend(const render_result *result, burnish_image *image);

#endif
