/* A picture drawn by several processes, in bands of rows, and written band by band as PNG. */
#ifndef TOOL_RENDER_BANDS_H
#define TOOL_RENDER_BANDS_H

#include "render/output/report.h"

/* A picture in bands. The only cell has its camera. */
typedef struct render_bands {
    render_result *result;
    burnish_renderer *renderer;
    burnish_render_options *options;
    burnish_file_check *ready; /* receives result when the file is written */
} render_bands;

/* Draws and writes all bands. The file has the same bytes as with one process. Errors: as for
 * drawing, encoding and writing; no file appears then. */
burnish_status render_write_bands(const render_bands *bands, burnish_error *error);

/* Draws the bands that are requested from --runner, and writes no file. */
burnish_status render_serve_bands(const render_bands *bands, burnish_error *error);

#endif
