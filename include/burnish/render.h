/* burnish/render.h: draw a scene into an image.
 *
 * The Phong illumination equation, per pixel, in linear light (model.md's notation):
 *   I = Ia ka + sum over lights Il (kd max(0, N.L) + ks S(c)),  S = 0 where N.L <= 0,
 * with c = N.H (Blinn) or R.V (Phong) and S any lobe that burnish knows. The same scene and options
 * give the same bytes on every machine, compiler and thread count.
 *
 * What it does not do: shadows, reflections, transparency, textures.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RENDER_H
#define BURNISH_RENDER_H

#include "burnish/core.h"
#include "burnish/image.h"
#include "burnish/kernels.h"
#include "burnish/mesh.h"
#include "burnish/shading.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the report counts; the rest of it stays 0. Marking which triangles are drawn takes longer
 * than counting pixels. */
typedef enum burnish_counts {
    BURNISH_COUNTS_ALL,
    BURNISH_COUNTS_PIXELS, /* covered_pixels and bounds */
    BURNISH_COUNTS_NONE
} burnish_counts;

/* How to draw. Start from burnish_render_options_default(). */
typedef struct burnish_render_options {
    uint32_t cookie;   /* set by burnish_render_options_default() */
    int width, height; /* pixels, [1, BURNISH_IMAGE_MAX_SIZE] */
    int samples;       /* coverage samples a pixel: 1, 4, 8 or 16 */
    int threads;       /* [1, 1024]; 0: as many as the machine offers. Never changes the pixels */
    const burnish_kernels
        *batch; /* the kernels; NULL: burnish_kernels_best(). Never change the pixels */
    burnish_camera camera;
    burnish_lobe_spec lobe; /* any that burnish_lobe_spec_check accepts */
    burnish_specular_model specular_model;
    int local_viewer;       /* 1: V points from each pixel to the camera; 0: V is the camera's axis
                               everywhere */
    float ambient_light[3]; /* Ia, linear */
    burnish_light lights[BURNISH_LIGHT_MAX];
    int light_count;       /* [0, BURNISH_LIGHT_MAX] */
    uint8_t background[3]; /* sRGB */
    int transparent;       /* 1: the image has alpha and no background */
    int ignore_colors;     /* 1: the mesh's vertex colours are not used */
    int cull_back_faces; /* 1: triangles seen from their back are not drawn: a closed surface looks
                            the same and takes less time; otherwise both sides are lit */
    burnish_counts counts; /* of the report; never changes the pixels */
} burnish_render_options;

/* 1024x768, 4 samples, energy:2, Blinn, local viewer, the default rig (key, fill and rim light that
 * follow the camera, a little ambient light), a camera that must be set (its position equals its
 * focal point, which burnish_render refuses). */
BURNISH_API burnish_render_options burnish_render_options_default(void);

/* What was drawn. */
typedef struct burnish_render_report {
    size_t triangles;       /* of the mesh */
    size_t triangles_drawn; /* that own at least one sample after clipping and depth test */
    size_t covered_pixels;  /* pixels with at least one covered sample */
    int bounds[4];          /* x0, y0, x1, y1 (exclusive) of the covered pixels; all 0 when blank */
    int threads;            /* used */
    burnish_isa isa;        /* used */
    size_t lobe_fallbacks;  /* materials whose exponent is too low for the chosen order: drawn with
                               the highest order that fits */
    double seconds_transform; /* vertices, clipping, set-up, binning */
    double seconds_draw;      /* visibility and shading */
} burnish_render_report;

/* Draws the scene into a new image (RGB, or RGBA when transparent). report may be NULL.
 * Memory besides the image: 36 bytes a vertex (20 its place on the screen, 16 its normal), 16 more
 * where the mesh has colours; 13 bytes a triangle and 1 where drawn ones are counted; tile lists of
 * 8 bytes an entry, which stands for up to 16 neighbouring triangles, about 128 MiB of them at most
 * unless a single row of tiles needs more; and for each thread 0.2 MB, with several samples 0.2 MB
 * more and 0.7 MB a sample, of which only what is needed is touched.
 * Errors: ARGUMENT, MEMORY, LIMIT (also a mesh so small, below about 1e-33 across, or so much
 * enlarged that single precision can't hold it); the image is then empty. */
BURNISH_API burnish_status burnish_render(const burnish_mesh *scene,
                                          const burnish_render_options *options,
                                          burnish_image *image, burnish_render_report *report,
                                          burnish_error *error);

/* What is worth keeping from one frame to the next: the memory that burnish_render would ask for
 * and give back each time. One thread may use a renderer at a time. */
typedef struct burnish_renderer burnish_renderer;

/* Errors: ARGUMENT, MEMORY. Release it with burnish_renderer_destroy. */
BURNISH_API burnish_status burnish_renderer_create(burnish_renderer **renderer,
                                                   burnish_error *error);

/* Like burnish_render, the same pixels, into an image that is empty ({0}) or was drawn before: its
 * memory is used again where size and channels allow. Scenes and options may differ from frame to
 * frame. Errors as there; the image is then empty. */
BURNISH_API burnish_status burnish_renderer_draw(
    burnish_renderer *renderer, const burnish_mesh *scene, const burnish_render_options *options,
    burnish_image *image, burnish_render_report *report, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_renderer_destroy(burnish_renderer *renderer);

#ifdef __cplusplus
}
#endif

#endif
