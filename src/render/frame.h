/* One frame: bands of tiles, each from visibility to pixels while it is in cache. */
#ifndef BURNISH_RENDER_FRAME_H
#define BURNISH_RENDER_FRAME_H

#include "burnish/render.h"
#include "raster/fragments.h"
#include "render/fragments.h"
#include "render/planes.h"
#include "render/store.h"

typedef struct burnish_frame {
    const burnish_isa_ops *ops;
    const burnish_geometry *geometry;
    burnish_surface surface;
    burnish_output output;
    burnish_plane_writer planes;
    int has_planes;    /* 1: the target has some */
    int counts_pixels; /* 1: covered pixels and their bounds are counted */
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

/* Draws every tile. report gets covered_pixels and bounds where they are
 * counted. Errors: MEMORY,
 * CANCELLED. */
burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_tiles *tiles,
                                  burnish_render_report *report, burnish_error *error);
void burnish_tiles_destroy(burnish_tiles *tiles, const burnish_context *context);

#endif
