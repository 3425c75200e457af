/* One frame: bands of tiles, each from visibility to pixels while it is in cache. */
#ifndef BURNISH_RENDER_FRAME_H
#define BURNISH_RENDER_FRAME_H

#include "burnish/render.h"
#include "kernels/table.h"
#include "raster/visibility.h"
#include "shade/row.h"

typedef struct burnish_frame {
    const burnish_raster_view *view;
    const burnish_geometry *geometry;
    burnish_visibility_function *visibility;
    burnish_encode_function *encode;
    const burnish_srgb_encoder *encoder;
    const burnish_shader *shader;
    const burnish_render_options *options;
    burnish_image *image; /* allocated; every pixel is written */
    int threads;
    uint8_t *drawn; /* a byte a triangle of the mesh, set when it owns a sample; NULL: not wanted */
} burnish_frame;

/* Draws every tile. report gets covered_pixels and bounds. Errors: MEMORY. */
burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_render_report *report,
                                  burnish_error *error);

#endif
