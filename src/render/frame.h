/* One frame: bands of tiles, each from visibility to pixels while it is in cache. */
#ifndef BURNISH_RENDER_FRAME_H
#define BURNISH_RENDER_FRAME_H

#include "burnish/render.h"
#include "core/srgb.h"
#include "raster/tile.h"
#include "shading/strip.h"

typedef struct burnish_frame {
    const burnish_raster_view *view;
    const burnish_isa_ops *ops;
    const burnish_geometry *geometry;
    const burnish_srgb_encoder *encoder;
    const burnish_shader *shader;
    const burnish_render_options *options;
    burnish_image *image; /* allocated; every pixel is written */
    burnish_tasks *pool;
    int wants_counts; /* 1: covered pixels and their bounds are wanted */
    uint8_t *drawn; /* a byte a triangle of the mesh, set when it owns a sample; NULL: not wanted */
} burnish_frame;

/* What threads draw tiles with; kept from frame to frame. All zero before the first. */
typedef struct burnish_tile_worker burnish_tile_worker;
typedef struct burnish_tiles {
    burnish_bins bins;
    burnish_tile_worker *workers;
    int worker_count;
    uint8_t *background; /* a row of the image where nothing is */
    size_t background_capacity;
} burnish_tiles;

/* Draws every tile. report gets covered_pixels and bounds where they are wanted. Errors: MEMORY. */
burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_tiles *tiles,
                                  burnish_render_report *report, burnish_error *error);
void burnish_tiles_destroy(burnish_tiles *tiles);

#endif
