/* A renderer that drew other frames draws what a new one does. */
#ifndef TEST_KEPT_RENDERER_H
#define TEST_KEPT_RENDERER_H

#include <string.h>

#include "burnish/render.h"
#include "support.h"

/* Frames the mesh and draws it by the kept renderer into *kept_image, and by a new one. */
static inline void check_kept_renderer(burnish_renderer *kept, burnish_image *kept_image,
                                       const burnish_mesh *mesh, burnish_render_options *options,
                                       const char *what) {
    const burnish_framing framing = burnish_framing_default();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_image fresh = {0};
    burnish_camera_frame(mesh, &framing, &options->camera, &error);
    const int are_drawn =
        burnish_renderer_draw(kept, mesh, options, kept_image, NULL, &error) == BURNISH_STATUS_OK &&
        burnish_render(mesh, options, &fresh, NULL, &error) == BURNISH_STATUS_OK;
    if (CHECK(are_drawn, "%s: %s", what, error.text)) {
        CHECK(memcmp(kept_image->pixels, fresh.pixels,
                     (size_t)(3 * options->width * options->height)) == 0,
              "%s: another picture from a renderer that drew before", what);
    }
    burnish_image_destroy(&fresh);
}

#endif
