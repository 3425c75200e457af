/* Turntables: one turn of the camera around the object, written as one file. */
#ifndef TOOL_RENDER_TURNTABLE_H
#define TOOL_RENDER_TURNTABLE_H

#include "render/output/result.h"
#include "render/scene/cameras.h"

/* The camera of the first frame, which keeps the object in the picture for the whole turn. Errors:
 * ARGUMENT, MEMORY. */
burnish_status render_turntable_camera(const burnish_mesh *mesh, const render_settings *settings,
                                       render_view view, render_room *room, burnish_camera *camera,
                                       burnish_error *error);

/* Draws and writes all frames; result->cells[0] has the first one's camera and image, afterwards
 * the image of the last one. Errors: as for drawing, the format and writing; no file appears then.
 *   ready  receives result when all frames are written */
burnish_status render_write_turntable(render_result *result, burnish_file_check *ready,
                                      burnish_error *error);

#endif
