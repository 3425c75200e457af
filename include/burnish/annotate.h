/* burnish/annotate.h: lines and numbers around a drawn mesh: dimensions, scale bar, axes, bounding
 * box, ground grid.
 *
 *     burnish_annotate_options annotations = burnish_annotate_options_default();
 *     annotations.kinds = BURNISH_ANNOTATION_DIMENSIONS | BURNISH_ANNOTATION_AXES;
 *     burnish_annotate_inset(mesh, &annotations, &framing, width, height, framing.inset, &error);
 *     burnish_camera_frame(mesh, &framing, &camera, &error);
 *     ... draw the mesh with that camera ...
 *     burnish_annotate(mesh, &annotations, &camera, &pixels, depth, stride, NULL, &error);
 *
 * Numbers are lengths in the mesh's own units, rounded to four significant digits; no unit is
 * guessed. The same mesh, camera and size give the same pixels everywhere.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_ANNOTATE_H
#define BURNISH_ANNOTATE_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/drawing.h"
#include "burnish/image.h"
#include "burnish/mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What can be drawn. */
typedef uint32_t burnish_annotation_flags; /* a sum of: */
enum {
    BURNISH_ANNOTATION_AXES = 1,       /* the directions of X, Y and Z, in a corner */
    BURNISH_ANNOTATION_BOX = 2,        /* edges of the bounding box, dashed behind the object */
    BURNISH_ANNOTATION_DIMENSIONS = 4, /* lengths of the bounding box, outside the object */
    BURNISH_ANNOTATION_SCALE = 8,      /* a bar 1, 2 or 5 times a power of 10 long; nothing in
                                          perspective, which has no scale */
    BURNISH_ANNOTATION_GRID = 16, /* on the ground: lines 1, 2 or 5 times a power of 10 apart */
    BURNISH_ANNOTATION_ALL = 31
};

/* What to draw, and in front of what. Start from burnish_annotate_options_default(). */
typedef struct burnish_annotate_options {
    uint32_t cookie;                /* set by burnish_annotate_options_default() */
    const burnish_context *context; /* NULL: the default */
    burnish_annotation_flags kinds;
    double up[3];          /* the ground's normal, of any length; the nearest axis counts;
                                       all 0: the mesh's */
    double text_height;    /* of a capital letter, in pixels, [5, 256]; 0: a 44th of the
                                       smaller side, at least 9 */
    uint8_t background[3]; /* sRGB: lines and letters stand out from it */
    int transparent;       /* 1: what is behind is not known: dark ink with a pale rim */
} burnish_annotate_options;

/* No kinds, white background. */
BURNISH_API void burnish_annotate_options_init(burnish_annotate_options *options, uint64_t layout);
static inline burnish_annotate_options burnish_annotate_options_default(void) {
    burnish_annotate_options options;
    burnish_annotate_options_init(&options, BURNISH_LAYOUT(burnish_annotate_options));
    return options;
}

/* Draws them over a picture of the mesh. No label overlaps another, or the bounding box on the
 * screen, which holds the object. What finds no room is left out.
 *   camera    the picture was drawn with
 *   pixels    the picture, of any format
 *   depth     distances as burnish_target has them, of the picture's size: what they hide of box
 *             and grid is dashed or left out; NULL: nothing is hidden
 *   stride    bytes from row to row of depth, a multiple of 4
 *   left_out  receives how many labels found no room; may be NULL
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_annotate(const burnish_mesh *mesh,
                                            const burnish_annotate_options *annotations,
                                            const burnish_camera *camera,
                                            const burnish_pixels *pixels, const float *depth,
                                            size_t stride, size_t *left_out, burnish_error *error);

/* The same lines and labels in a drawing, after what it has: a path per width, colour and label.
 * Errors: as burnish_annotate; after MEMORY the drawing can only be destroyed. */
BURNISH_API burnish_status burnish_annotate_drawing(const burnish_mesh *mesh,
                                                    const burnish_annotate_options *annotations,
                                                    const burnish_camera *camera,
                                                    burnish_drawing *drawing, const float *depth,
                                                    size_t stride, size_t *left_out,
                                                    burnish_error *error);

/* The insets of a framing that leave room for them.
 *   framing        its aspect is width / height; its insets do not count
 *   width, height  of the picture in pixels
 *   inset          receives left, right, bottom, top as burnish_framing has them
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_annotate_inset(const burnish_mesh *mesh,
                                                  const burnish_annotate_options *annotations,
                                                  const burnish_framing *framing, int width,
                                                  int height, double inset[4],
                                                  burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
