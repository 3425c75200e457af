/* Lines: the edges of a mesh that a drawing shows, as polylines on the screen.
 *
 * Lines come from geometry, visibility from the frame's depth and triangle planes. Per mesh: its
 * edges. Per frame: which of them are silhouettes or wanted for another reason, chained where they
 * meet; samples a pixel apart along each chain ask the planes what is seen there; runs of visible
 * samples become polylines. */
#ifndef BURNISH_RENDER_LINES_LINES_H
#define BURNISH_RENDER_LINES_LINES_H

#include "base/memory.h"
#include "burnish/render.h"
#include "core/tasks.h"
#include "mesh/axes.h"
#include "raster/raster_view.h"
#include "render/space.h"

/* The view of the frame whose lines are drawn. */
typedef struct burnish_line_view {
    const burnish_raster_view *raster;
    burnish_view_distance distance;
} burnish_line_view;

/* A segment on the screen, cut to the picture. */
typedef struct burnish_line_segment {
    float x[2], y[2];
    float key[2]; /* what is linear along it: 1 / distance, or distance in parallel projection */
    uint32_t ends[2]; /* vertices, or BURNISH_LINE_CUT */
    uint32_t triangles[2];
    int8_t outside;     /* where no triangle of the edge lies: 1 left of it, -1 right, 0 nowhere */
    uint8_t has_front;  /* 1: a triangle of the edge is front-facing */
    uint8_t is_feature; /* 1: drawn even without a step in depth; 2: as a tangent edge */
    uint8_t is_done;    /* BURNISH_LINE_OUTSIDE the picture, or the pass that has walked it */
} burnish_line_segment;

#define BURNISH_LINE_CUT UINT32_MAX

enum { BURNISH_LINE_OUTSIDE = 1, BURNISH_LINE_VISIBLE, BURNISH_LINE_HIDDEN };

/* What is kept from frame to frame. All zero before the first. */
typedef struct burnish_line_art {
    uint64_t mesh; /* whose edges they are, burnish_mesh_view.serial; 0: nobody's */
    burnish_edges edges;
    int has_tangents;   /* 1: their tangent edges are marked */
    uint64_t axes_mesh; /* whose axes they are; 0: nobody's */
    burnish_axes axes;
    uint32_t *joints; /* of each vertex: a segment's end there, while segments are linked */
    size_t joint_capacity;

    int8_t *facing; /* of each triangle: 1 front, -1 back, 0 edge on */
    size_t facing_capacity;
    size_t *block_counts; /* of segments in blocks of edges */
    size_t block_capacity;
    burnish_line_segment *segments;
    size_t segment_count, segment_capacity;
    uint32_t *links; /* of each segment's ends: the end that follows there */
    size_t link_capacity;

    float *points;    /* x, y of all lines */
    uint32_t *starts; /* of each line, its first point; and the end */
    float *widths;    /* of each line */
    uint8_t *is_rim;  /* of each line: 1: the background begins there */
    size_t point_capacity, start_capacity, width_capacity, rim_capacity;
    burnish_lines lines; /* what there is in these arrays */

    float *depth; /* planes of the frame that the target lacks */
    uint32_t *triangles;
    size_t depth_capacity, triangle_capacity;
} burnish_line_art;

/* Adds to the target the planes that lines need and it lacks, pixels packed. Errors: MEMORY. */
burnish_status burnish_line_art_planes(burnish_line_art *art, const burnish_render_options *options,
                                       burnish_target *target, burnish_memory *memory);

/* Releases the planes that it has added. */
void burnish_line_art_drop_planes(burnish_line_art *art, const burnish_context *context);

/* Finds the lines of a frame that was drawn into the target's planes. Errors: MEMORY, LIMIT,
 * CANCELLED; there are then no lines. */
burnish_status burnish_line_art_update(burnish_line_art *art, const burnish_mesh_view *mesh,
                                       const burnish_line_view *view,
                                       const burnish_render_options *options,
                                       const burnish_target *target, burnish_tasks *tasks,
                                       burnish_memory *memory);

/* Draws the lines into pixels, which hold the options' rows. Errors: MEMORY, CANCELLED. */
burnish_status burnish_line_art_draw(const burnish_line_art *art,
                                     const burnish_render_options *options,
                                     const burnish_pixels *pixels, burnish_tasks *tasks,
                                     burnish_memory *memory);

void burnish_line_art_destroy(burnish_line_art *art, const burnish_context *context);

#endif
