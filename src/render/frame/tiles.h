/* Bands of tiles, each from visibility to pixels while it is in cache. */
#ifndef BURNISH_RENDER_FRAME_TILES_H
#define BURNISH_RENDER_FRAME_TILES_H

#include "render/frame/target.h"

typedef struct burnish_frame {
    const burnish_raster_ops *ops;
    const burnish_geometry *geometry;
    burnish_surface surface;
    burnish_output output;
    int counts_pixels; /* 1: covered pixels and their bounds are counted */
    int layer_passes;  /* of transparent layers, [1, BURNISH_LAYER_PASSES] */
    uint8_t *drawn;    /* a byte per triangle of the mesh, set when it shows in a sample; or NULL */
    burnish_tasks *tasks;
    const burnish_context *context; /* whose memory is used */
} burnish_frame;

/* What threads draw tiles with; kept from frame to frame. All zero before the first. */
typedef struct burnish_tile_worker burnish_tile_worker;
typedef struct burnish_tiles {
    burnish_bins bins;
    burnish_tile_worker *workers;
    int worker_count;
} burnish_tiles;

/* Draws every tile of the output's rows. report gets covered_pixels and bounds where they are
 * counted. Errors: MEMORY, CANCELLED. */
burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_tiles *tiles,
                                  burnish_render_report *report, burnish_error *error);
void burnish_tiles_destroy(burnish_tiles *tiles, const burnish_context *context);

#endif
