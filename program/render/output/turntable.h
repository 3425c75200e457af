/* Turntables: one turn of the camera around the object, written as one file. */
#ifndef TOOL_RENDER_TURNTABLE_H
#define TOOL_RENDER_TURNTABLE_H

#include "render/output/report.h"
#include "render/scene/camera.h"

/* The camera of the first frame, which keeps the object in the picture for the whole turn. Errors:
 * ARGUMENT, MEMORY. */
burnish_status render_turntable_camera(const burnish_mesh *mesh, const render_settings *settings,
                                       render_view view, render_room *room, burnish_camera *camera,
                                       burnish_error *error);

/* Draws cell->image with cell->camera. */
typedef burnish_status render_draw_frame(render_result *result, burnish_renderer *renderer,
                                         burnish_render_options *options, render_cell *cell,
                                         burnish_error *error);

/* A turntable. result->cells[0] has the first frame's camera and an image. */
typedef struct render_turntable {
    render_result *result;
    burnish_renderer *renderer;
    burnish_render_options *options;
    render_draw_frame *draw;
    burnish_file_check *ready; /* receives result when all frames are written */
} render_turntable;

/* Draws and writes all frames; afterwards the cell has the image of the last one. Errors: as for
 * drawing, the format and writing; no file appears then. */
burnish_status render_write_turntable(const render_turntable *turntable, burnish_error *error);

#endif
