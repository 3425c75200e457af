/* Frames of a turntable, drawn by others too: sockets lead to processes with the same command line,
 * which draw the frames that they are asked for (docs/scale.md). */
#ifndef TOOL_RENDER_FRAMES_H
#define TOOL_RENDER_FRAMES_H

#include "burnish/image.h"
#include "cli/options.h"

/* Draws a frame into the image. */
typedef burnish_status render_frame_drawer(void *context, int frame, burnish_error *error);

typedef struct render_frames_plan {
    int runners;                /* sockets, from descriptor 3 on */
    int count;                  /* frames */
    size_t triangles, vertices; /* of the mesh, which all runners must have */
    const burnish_image *image; /* what the drawer draws into; its size counts from the start */
    render_frame_drawer *draw;
    void *context;
} render_frames_plan;

typedef struct render_frames render_frames;

/* *frames is NULL on error. Errors: ARGUMENT, MEMORY. */
burnish_status render_frames_create(const render_frames_plan *plan, render_frames **frames,
                                    burnish_error *error);
void render_frames_destroy(render_frames *frames); /* NULL is allowed */

/* Leaves the frame in the image, frames being asked for in their order; those after it are in work
 * then. What nobody else draws is drawn here, so that others can only help. Errors: those of the
 * drawer. */
burnish_status render_frames_take(render_frames *frames, int frame, burnish_error *error);

/* A runner's whole life; runners is 0. Errors: ARGUMENT (no socket, another mesh or version), those
 * of the drawer. */
burnish_status render_frames_serve(const render_frames_plan *plan, burnish_error *error);

#endif
