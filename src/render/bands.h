/* Tiles of a picture, band after band: a band is as many rows of tiles as fit the budget of tile
 * lists. Frames and depth maps are drawn so. */
#ifndef BURNISH_RENDER_BANDS_H
#define BURNISH_RENDER_BANDS_H

#include "core/tasks.h"
#include "raster/bins.h"

/* What a picture's tiles are drawn from. */
typedef struct burnish_bands {
    burnish_bins *bins;
    const burnish_raster_ops *ops;
    const burnish_geometry *geometry;
    const burnish_raster_view *view;
    burnish_tasks *tasks;
    int threads;                    /* that draw at the same time, at most */
    const burnish_context *context; /* whose memory is used */
} burnish_bands;

/* Draws the tile (column, row), whose lists are in the bins; `thread` < threads. */
typedef void burnish_tile_function(void *context, int column, int row, int thread);

/* Draws every tile once. Errors: MEMORY, CANCELLED, LIMIT. */
burnish_status burnish_bands_draw(const burnish_bands *bands, burnish_tile_function *draw,
                                  void *context, burnish_error *error);

/* The same for the rows of tiles [first_row, end_row) alone. */
burnish_status burnish_bands_draw_rows(const burnish_bands *bands, int first_row, int end_row,
                                       burnish_tile_function *draw, void *context,
                                       burnish_error *error);

#endif
