/* The projection of a frame's lines. */
#include "render/lines/lines_steps.h"

burnish_line_projection burnish_line_project_view(const burnish_line_view *view,
                                                  const burnish_render_options *options) {
    const burnish_camera *camera = &options->camera;
    burnish_line_projection p = {.origin = burnish_vec3_loadf(view->raster->origin),
                                 .middle = {options->width * 0.5, options->height * 0.5},
                                 .size = {options->width, options->height},
                                 .distance = view->distance,
                                 .is_parallel = camera->orthographic_height > 0,
                                 .viewer = burnish_vec3_load(camera->position)};
    for (int i = 0; i < 16; ++i) {
        p.rows[i / 4][i % 4] = (double)view->raster->rows[i / 4][i % 4];
    }
    if (p.is_parallel) {
        p.viewer = burnish_vec3_normalize(
            burnish_vec3_sub(p.viewer, burnish_vec3_load(camera->focal_point)));
    }
    return p;
}

static double row_times(const double row[4], burnish_vec3 v) {
    return row[0] * v.x + row[1] * v.y + row[2] * v.z + row[3];
}

burnish_clip_point burnish_line_project(const burnish_line_projection *p, burnish_vec3 position) {
    const burnish_vec3 v = burnish_vec3_sub(position, p->origin);
    return (burnish_clip_point){row_times(p->rows[0], v), row_times(p->rows[1], v),
                                row_times(p->rows[2], v), row_times(p->rows[3], v)};
}

double burnish_line_key(const burnish_line_projection *p, burnish_clip_point c) {
    const double w = c.w * (double)p->distance.constant;
    return p->is_parallel ? (1 - c.z) * (double)p->distance.slope : w > 0 ? 1 / w : 0;
}
