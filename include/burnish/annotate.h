/* burnish/annotate.h: dimensions, scale bar, axes, bounding box, ground grid and callouts
 * around a drawn mesh.
 *
 *     burnish_annotate_options annotations = burnish_annotate_options_default();
 *     annotations.kinds = BURNISH_ANNOTATION_DIMENSIONS | BURNISH_ANNOTATION_AXES;
 *     burnish_annotate_inset(mesh, &annotations, &framing, width, height, framing.inset, &error);
 *     burnish_camera_frame(mesh, &framing, &camera, &error);
 *     ... draw the mesh with that camera ...
 *     burnish_annotate(mesh, &annotations, &camera, &pixels, NULL, &error);
 *
 * Numbers are lengths in the units of the mesh, rounded to four significant digits. The same mesh,
 * camera and size give the same pixels on every machine.
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

/* The annotations: a sum of BURNISH_ANNOTATION_... values. */
typedef uint32_t burnish_annotation_flags;
enum {
    BURNISH_ANNOTATION_AXES = 1,       /* the directions of X, Y and Z, in a corner */
    BURNISH_ANNOTATION_BOX = 2,        /* the bounding box, dashed behind the object */
    BURNISH_ANNOTATION_DIMENSIONS = 4, /* lengths of the bounding box, outside the object */
    BURNISH_ANNOTATION_SCALE = 8,      /* a bar of 1, 2 or 5 times a power of 10; not drawn in
                                          perspective, which has no scale */
    BURNISH_ANNOTATION_GRID = 16,      /* ground lines 1, 2 or 5 times a power of 10 apart */
    BURNISH_ANNOTATION_CALLOUTS = 32,  /* numbers at the parts, and a list of them on the right */
    BURNISH_ANNOTATION_SECTION = 64, /* of the plane `section`: arrows and letters where a parallel
                                        view looks along it, "A-A" where it looks at it */
    BURNISH_ANNOTATION_HOLES = 128,  /* diameters of holes and cylinders that are seen end on, and
                                          positions from the left and the lower edge of the box;
                                          burnish_annotate_inset() leaves them no room */
    BURNISH_ANNOTATION_ALL = 255
};

/* The most balloons of a picture, and the most entries of a parts list. */
enum { BURNISH_BALLOONS_MAX = 64, BURNISH_CALLOUTS_MAX = 1000 };

/* An entry of a parts list. Parts share one if they have the same name, but for digits and signs at
 * its end, as many triangles, and the same area within 1e-5 of it. */
typedef struct burnish_callout {
    size_t part, count; /* the first of its parts in burnish_contents.parts; how many it has */
    int is_visible, has_balloon;
    int x, y; /* the pixel where the leader starts, well within a face; 0, 0: not visible */
} burnish_callout;

/* A parts list. An entry's number is its place from 1. */
typedef struct burnish_callouts {
    size_t count, left_out; /* parts that it has no place for */
    burnish_callout items[BURNISH_CALLOUTS_MAX];
} burnish_callouts;

/* Options for annotations. Start from burnish_annotate_options_default(). */
typedef struct burnish_annotate_options {
    uint32_t cookie;                /* set by burnish_annotate_options_default() */
    const burnish_context *context; /* NULL: the default */
    burnish_annotation_flags kinds;
    double up[3];          /* the normal of the ground, of any length; the nearest axis is
                                       used; all 0: the up axis of the mesh */
    double text_height;    /* of a capital letter in pixels, [5, 256]; 0: 1/44 of the
                                       smaller side, at least 9 */
    uint32_t lengths;      /* of the axes that DIMENSIONS measures, a sum: 1 X, 2 Y, 4 Z; 0: all */
    uint8_t background[3]; /* sRGB; the colours of lines and letters contrast with it */
    int transparent;       /* 1: the background is unknown: dark ink with a pale outline */
    const float *depth;    /* distances as in burnish_target, of the size of the image: hidden parts
                                       of the box are dashed, hidden parts of the grid omitted;
                                       NULL: nothing is hidden */
    size_t depth_stride;   /* bytes from row to row of depth, a multiple of 4 */
    burnish_callouts *callouts; /* receives the parts list of CALLOUTS; NULL: there are none */
    const uint32_t *triangles; /* ids as in burnish_target, row by row, for balloons; may be NULL */
    burnish_clip_plane section; /* its normal, of length 1, points to the viewer of the section */
} burnish_annotate_options;

/* No annotations, a white background. */
BURNISH_API void burnish_annotate_options_init(burnish_annotate_options *options, uint64_t layout);
static inline burnish_annotate_options burnish_annotate_options_default(void) {
    burnish_annotate_options options;
    burnish_annotate_options_init(&options, BURNISH_LAYOUT(burnish_annotate_options));
    return options;
}

/* Draws annotations over an image of the mesh. Labels overlap neither each other nor the projected
 * bounding box. A label without enough room is omitted.
 *   camera    of the image
 *   pixels    the image, in any format
 *   left_out  receives the number of omitted labels; may be NULL
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_annotate(const burnish_mesh *mesh,
                                            const burnish_annotate_options *annotations,
                                            const burnish_camera *camera,
                                            const burnish_pixels *pixels, size_t *left_out,
                                            burnish_error *error);

/* Adds annotations to a drawing: a path per width, colour and label. Parameters as for
 * burnish_annotate(). Errors: as for burnish_annotate(); after MEMORY the drawing can only be
 * destroyed. */
BURNISH_API burnish_status burnish_annotate_drawing(const burnish_mesh *mesh,
                                                    const burnish_annotate_options *annotations,
                                                    const burnish_camera *camera,
                                                    burnish_drawing *drawing, size_t *left_out,
                                                    burnish_error *error);

/* Computes the insets of a framing that leave room for annotations. Depth does not affect them.
 *   framing        with aspect width / height; its insets are ignored
 *   width, height  of the image in pixels
 *   inset          receives left, right, bottom and top for burnish_framing
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
