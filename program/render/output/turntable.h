/* Turntables: one turn of the camera around the object, frame after frame into one file. */
#ifndef TOOL_RENDER_TURNTABLE_H
#define TOOL_RENDER_TURNTABLE_H

#include "render/camera.h"
#include "render/output/report.h"

/* The camera of the first frame, from which the object stays within the picture for the whole turn.
 * Errors: ARGUMENT, MEMORY. */
burnish_status render_turntable_camera(const burnish_mesh *mesh, const render_settings *settings,
                                       render_view view, render_room *room, burnish_camera *camera,
                                       burnish_error *error);

/* Draws cell->image by cell->camera. */
typedef burnish_status render_draw_frame(render_result *result, burnish_renderer *renderer,
                                         burnish_render_options *options, render_cell *cell,
                                         burnish_error *error);

/* What a turntable is made with; result->cells[0] has the first frame's camera and an image. */
typedef struct render_turntable {
    render_result *result;
    burnish_renderer *renderer;
    burnish_render_options *options;
    render_draw_frame *draw;
    burnish_file_check *ready; /* gets result, when all frames are written */
} render_turntable;

/* Draws and writes all frames; afterwards the cell's image is that of the last one. Errors: those
 * of drawing, of the format and of writing, after which no file appears. */
burnish_status render_write_turntable(const render_turntable *turntable, burnish_error *error);

/* Draws the frames that --runner is asked for, and writes nothing. */
burnish_status render_serve_turntable(const render_turntable *turntable, burnish_error *error);

#endif
