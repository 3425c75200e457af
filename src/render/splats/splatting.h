/* Draws the splats of a mesh (burnish_mesh_view.splats) over the target's background, and among
 * opaque triangles that the target shows already.
 *
 * A splat's covariance is projected by the derivative of the projection at its centre (EWA, Zwicker
 * et al. 2001; Kerbl et al. 2023), where that is at most 1.3 half images from the image's middle,
 * and 0.3 is added to its variances in pixels. A pixel's centre gets the opacity of its middle times
 * e^-d, d half the squared distance in standard deviations, by burnish_exp_falloff5, which ends at an
 * ellipse: nothing is cut off. Splats are blended in the order of their depths, equal ones in the
 * mesh's, in sRGB values. A splat whose centre is not nearer than the triangle that most samples of a
 * pixel show is only as opaque there as the share of samples is large that no triangle covers. */
#ifndef BURNISH_RENDER_SPLATS_SPLATTING_H
#define BURNISH_RENDER_SPLATS_SPLATTING_H

#include "base/memory.h"
#include "burnish/render.h"
#include "core/tasks.h"
#include "raster/raster_view.h"
#include "render/render_ops.h"

/* A splat on the screen: d = a (x - centre)^2 + b (y - middle)^2 with the centre of each row. */
typedef struct burnish_splat_item {
    float x, y;  /* the middle, in pixels from the image's top left corner */
    float slope; /* of the rows' centres: x + slope (y - middle) */
    float a, b;
    float color[3], opacity;
    float depth;                 /* of its centre: the distance along the camera's axis */
    uint16_t first_row, end_row; /* that it touches; equal: none */
} burnish_splat_item;

/* Rows that a thread draws at once: the light that passes all splats so far, and their light. */
typedef struct burnish_splat_band {
    int width, first_row, end_row; /* of the image */
    size_t stride;                 /* floats from row to row: the width up to a multiple of 16 */
    float *through, *rgb[3];
    float *surface, *open; /* the depths of triangles and what they leave uncovered; NULL: none */
} burnish_splat_band;

typedef struct burnish_splat_call {
    const burnish_mesh_view *mesh;
    const burnish_raster_view *view;
    const burnish_target *target;  /* its pixels hold the background, and triangles */
    const burnish_target *surface; /* depth and coverage of opaque triangles; depth NULL: none */
    float depth_scale[2]; /* a splat's depth: the first times w and the second times w - z */
    const burnish_render_ops *ops;
    int first_row, end_row; /* that are drawn, and that the target holds */
    int transparent;        /* 1: alpha, and no background */
    double max_overdraw;    /* for the picture's size */
} burnish_splat_call;

/* The report gets covered pixels, their bounds and overdraw. Memory: 60 bytes per splat, 384 per
 * column for each thread. Errors: MEMORY, LIMIT, CANCELLED. */
burnish_status burnish_splats_draw(const burnish_splat_call *call, burnish_render_report *report,
                                   burnish_tasks *tasks, burnish_memory *memory);

#endif
