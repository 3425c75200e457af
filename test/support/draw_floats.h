/* A mesh's picture as linear light: 4 floats a pixel. */
#ifndef TEST_DRAW_FLOATS_H
#define TEST_DRAW_FLOATS_H

#include "burnish/render.h"
#include "support.h"

/* report: may be NULL */
static inline void draw_floats(const burnish_mesh *mesh, const burnish_render_options *options,
                               float *pixels, burnish_render_report *report) {
    burnish_target target = burnish_target_default();
    burnish_renderer *renderer;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    target.pixels = (burnish_pixels){options->width, options->height, BURNISH_PIXELS_RGBA_FLOAT,
                                     16 * (size_t)options->width, (uint8_t *)pixels};
    CHECK1(burnish_renderer_create(NULL, &renderer, NULL) == BURNISH_STATUS_OK);
    CHECK_OK(burnish_renderer_draw_into(renderer, mesh, options, &target, report, &error), error);
    burnish_renderer_destroy(renderer);
}

#endif
