/* A picture drawn by others too, a band of rows at a time, into a PNG that grows with them. */
#ifndef TOOL_RENDER_BANDS_H
#define TOOL_RENDER_BANDS_H

#include "render/output/report.h"

/* What bands are drawn with; the only cell has its camera. */
typedef struct render_bands {
    render_result *result;
    burnish_renderer *renderer;
    burnish_render_options *options;
    burnish_file_check *ready; /* gets result, when the file is written */
} render_bands;

/* Draws and writes all bands, of which no more wait than their order needs: the file of one
 * machine. Errors: those of drawing, of encoding and of writing, after which no file appears. */
burnish_status render_write_bands(const render_bands *bands, burnish_error *error);

/* Draws the bands that --runner is asked for, and writes nothing. */
burnish_status render_serve_bands(const render_bands *bands, burnish_error *error);

#endif
