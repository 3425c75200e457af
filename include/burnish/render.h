/* burnish/render.h: draw a mesh into an image, or into the caller's memory.
 *
 * The Phong illumination equation, per pixel, in linear light:
 *   I = Ia ka + sum over lights Il (kd max(0, N.L) + ks S(c)),  S = 0 where N.L <= 0,
 * with c = N.H (Blinn) or R.V (Phong) and S any lobe that burnish knows.
 *
 * Transparent surfaces (burnish_material.transparency, alpha of vertex colours) are laid over what
 * is behind them at every sample, in linear light and in the order of their depths: a C + (1 - a) L
 * for a surface of opacity a and colour C, highlights included, before the light L. Both sides of
 * them show; they cast no ambient occlusion.
 *
 * Cuts (burnish_mesh_clip of mesh.h) of solids are filled: where the nearest triangle is seen from
 * inside, the plane of the cut shows, in the triangle's material a little warmer, with lines at 45
 * degrees; depth and normal are the plane's, the triangle's number is the triangle's. Transparent
 * triangles are cut and not filled.
 *
 * What it does not do: reflections, refraction.
 *
 * How to use it.
 *   1. Options: burnish_render_options options = burnish_render_options_default();
 *      set options.camera (burnish_camera_frame of mesh.h shows the whole mesh) and what else
 *      differs from the defaults.
 *   2. A single picture: burnish_render(mesh, &options, &image, NULL, &error).
 *   3. Many pictures: a burnish_renderer keeps its memory from one to the next:
 *      burnish_renderer_create, burnish_renderer_draw for each, burnish_renderer_destroy.
 *   4. Into memory of your own (a window's surface, a shared segment), or with planes of depth,
 *      triangles, normals and coverage: fill a burnish_target from burnish_target_default() and
 *      call burnish_renderer_draw_into.
 *   5. Where memory comes from, who runs the work, progress and cancelling: a burnish_context.
 *
 * What it promises. The same mesh, options and target format give the same bytes on every machine,
 * compiler, instruction set and number of threads, whatever the caller's floating-point
 * environment, which is as before afterwards. After an error, a shortage of memory or cancelling a
 * renderer can be used as if nothing had happened.
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
    BURNISH_COUNTS_NONE,
    BURNISH_COUNTS_AREA /* all, and hidden_share */
} burnish_counts;

/* Directions of ambient occlusion: at most so many; or chosen by the number of triangles, from 72
 * for up to 8,192 to 18 for more than a million. */
#define BURNISH_OCCLUSION_MAX 256
#define BURNISH_OCCLUSION_AUTO (-1)

/* Transparent surfaces that a sample shows at most: the nearest ones, fewer (32 at least) where
 * large ones are so many that more would exceed max_overdraw; those behind them are left out, and
 * counted in the report. */
#define BURNISH_TRANSPARENT_LAYERS_MAX 256
/* Edges that are drawn as lines, hidden ones removed. */
typedef uint32_t burnish_edge_flags; /* a sum of: */
enum {
    BURNISH_EDGES_SILHOUETTES = 1, /* where the surface turns away, and what is behind it is
                                      further away */
    BURNISH_EDGES_CREASES = 2,     /* where it is shaded with two normals */
    BURNISH_EDGES_BOUNDARIES = 4,  /* of one triangle */
    BURNISH_EDGES_MATERIALS = 8,   /* between two materials */
    BURNISH_EDGES_FEATURES = 15,   /* all of these */
    BURNISH_EDGES_ALL = 16,        /* of every triangle: a wireframe */
    /* FEATURES, thin and soft, in a parallel projection along an axis of the mesh's coordinates: a
     * step is of one colour with what is behind it. In other views nothing. */
    BURNISH_EDGES_AXIS_VIEWS = 32
};

/* The widest line, in pixels. */
#define BURNISH_EDGE_WIDTH_MAX 100

/* As many threads as the process may use, or as the context's task runner has. */
#define BURNISH_THREADS_AUTO 0

/* What max_overdraw is unless it is set. */
#define BURNISH_OVERDRAW_DEFAULT 1000

/* How to draw. Start from burnish_render_options_default(). */
typedef struct burnish_render_options {
    uint32_t cookie;                /* set by burnish_render_options_default() */
    const burnish_context *context; /* of burnish_render; with a renderer NULL, or its own */
    int width, height;              /* pixels, [1, BURNISH_IMAGE_MAX_SIZE] */
    int first_row, row_count;       /* what is drawn of the picture: row_count rows from first_row
                                       on; 0, 0: all. See "Rows of a picture" below */
    int samples;                    /* coverage samples per pixel: 1, 4, 8 or 16 */
    int threads; /* [1, 1024] or BURNISH_THREADS_AUTO; never changes the pixels */
    const burnish_kernels *kernels; /* NULL: burnish_kernels_best(); never change the pixels */
    burnish_camera camera;
    burnish_lobe_spec lobe; /* any that burnish_lobe_spec_check accepts */
    burnish_specular_model specular_model;
    int local_viewer;       /* 1: V points from each pixel to the camera; 0: V is the camera's axis
                               everywhere */
    float ambient_light[3]; /* Ia, linear */
    int occlusion; /* directions that ambient occlusion is found from, [0, BURNISH_OCCLUSION_MAX];
                      0: none; or BURNISH_OCCLUSION_AUTO; an odd number counts as the next one */
    float occlusion_strength; /* [0, 1]: what a point that sees no sky loses of its light */
    double up[3]; /* the direction in which the object stands, of any length, for occlusion's sky
                     and the ground; 0, 0, 0: the mesh's up_axis */
    int ground; /* 1: the object casts the sky's shadow on the plane across `up` through its lowest
                   point. The background is darkened where it shows the plane from above; where
                   transparent, it is black, alpha the shadow */
    int shadow; /* 1: the object casts the first light's shadow on itself and the ground; that light
                   must be directional */
    burnish_light lights[BURNISH_LIGHT_MAX];
    int light_count;          /* [0, BURNISH_LIGHT_MAX] */
    burnish_edge_flags edges; /* 0: none */
    float edge_width;         /* pixels, (0, BURNISH_EDGE_WIDTH_MAX], of outlines: where there is a
                              step in depth. Other lines have 3/5 of it */
    uint8_t edge_color[3];    /* sRGB */
    float edge_opacity;       /* [0, 1] */
    uint8_t background[3];    /* sRGB */
    int transparent;          /* 1: the image has alpha and no background */
    int ignore_colors;        /* 1: the mesh's vertex colours are not used */
    int cull_back_faces; /* 1: triangles seen from their back are not drawn: a closed surface looks
                            the same and takes less time; otherwise both sides are lit */
    double max_overdraw; /* [1, infinity]: how often large triangles may cover the picture (one of
                            less than 512 x 512 pixels as many times more), and, twice as often,
                            each depth map that shadows need (256 x 256), before it is refused with
                            LIMIT: a bound of time. Of every triangle that may be seen and whose
                            bounds are more than 16 pixels wide or high its 8 x 8 pixel cells count,
                            hidden or not: those of its bounds or, where fewer, of its area and
                            outline; those of transparent triangles 16 times */
    burnish_counts counts; /* of the report; never changes the pixels */
} burnish_render_options;

/* 1024x768, 4 samples, energy:2, Blinn, local viewer, the default rig (key, fill and rim light that
 * follow the camera, a little ambient light), a camera that must be set (its position equals its
 * focal point, which burnish_render refuses). */
BURNISH_API void burnish_render_options_init(burnish_render_options *options, uint64_t layout);
static inline burnish_render_options burnish_render_options_default(void) {
    burnish_render_options options;
    burnish_render_options_init(&options, BURNISH_LAYOUT(burnish_render_options));
    return options;
}

/* ---- Rows of a picture ----
 *
 * Many machines can draw one picture, and one machine a picture larger than its memory: with
 * options.first_row and row_count a call draws these rows alone, and they have the bits that they
 * have in the whole picture, whatever the other options are. Images and targets then hold row_count
 * rows, the first of them first_row. Nothing of the picture's other rows is shaded or kept, but
 * where there are edges, whose lines are found from depths and triangles of all rows: 8 bytes per
 * pixel of the whole picture.
 *
 * Any rows will do; no work is done twice where first_row and row_count are multiples of 64. A
 * renderer that draws rows of one mesh and view one call after the other transforms and culls the
 * mesh in the first of them, and finds its lines there.
 *
 * Of the report, covered_pixels and bounds are those of the rows drawn, bounds in the whole
 * picture's coordinates; triangles_drawn, hidden_share and layers_dropped may count the rows up to
 * the next multiples of 64 too; overdraw is the whole picture's, and so is what max_overdraw
 * refuses. */

/* What was drawn. */
typedef struct burnish_render_report {
    size_t triangles;       /* of the mesh */
    size_t triangles_drawn; /* that show in at least one sample */
    double hidden_share; /* of the mesh's area, that of triangles that show in no sample, [0, 1] */
    size_t covered_pixels; /* pixels with at least one covered sample */
    int bounds[4];         /* x0, y0, x1, y1 (exclusive) of the covered pixels; all 0 when blank */
    int threads;           /* used */
    burnish_isa isa;       /* used */
    int occlusion_directions; /* that ambient occlusion was found from; 0: none */
    double overdraw;          /* what max_overdraw limits, of the picture */
    size_t layers_dropped; /* transparent layers of samples that were left out because nearer ones
                              are too many */
    int shadow;            /* 1: the first light's was drawn */
    int ground; /* 1: its shadow was drawn; 0: not asked for, or the camera is below it */
    size_t lobe_fallbacks; /* materials whose exponent is too low for the lobe's order: drawn with
                              the highest order that it allows */
    double seconds_transform; /* materials, vertices, clipping, culling */
    double seconds_draw;      /* tiles: binning, visibility, shading */
} burnish_render_report;

/* Draws the mesh into a new image (RGB, or RGBA when transparent). report may be NULL.
 * Memory besides the image: 36 bytes per vertex (20 for its position on the screen, 16 for its
 * normal), 16 more where the mesh has colours; 13 bytes per triangle and 1 where drawn ones are
 * counted; 0.3 kB per material and 76 bytes more per light; tile lists of 8 bytes per entry, which
 * stands for up to 16 neighbouring triangles, about 128 MiB of them at most unless a single row of
 * tiles needs more; and for each thread 0.2 MB, with several samples 0.2 MB more and 0.7 MB per
 * sample, of which only what is needed is touched. Ambient occlusion takes 130 KiB per direction
 * (33 for pictures of less than 384 pixels), and vertices, triangles and tile lists once more; the
 * ground the same, of at least 16 directions, and 2.2 MB; a shadow 2 MB, 8 in pictures of more than
 * 1024 pixels.
 * Transparent triangles take 1 bit per triangle of the mesh, and for each thread 1.1 MB per sample.
 * Errors: ARGUMENT, MEMORY, CANCELLED, LIMIT (max_overdraw; also a mesh so small, below about 1e-33
 * across, or so much enlarged that single precision can't hold it); the image is then empty. */
BURNISH_API burnish_status burnish_render(const burnish_mesh *mesh,
                                          const burnish_render_options *options,
                                          burnish_image *image, burnish_render_report *report,
                                          burnish_error *error);

/* ---- Targets ---- */

/* The triangle of a pixel that shows none. */
#define BURNISH_TRIANGLE_NONE UINT32_MAX

/* Where a picture goes: the caller's memory, in rows from the top, strides in bytes from one row to
 * the next. What lies between rows is not touched. A plane that is NULL is not drawn and costs
 * nothing.
 *
 * Alpha is straight: 255 (1 in floats) where options.transparent is 0, else the mean over a pixel's
 * samples of 1 - the product of the transparencies of what they show, 0 for nothing. RGBA_FLOAT is
 * linear light, not clamped above; for the other formats light is clamped to 1 before a pixel's
 * samples are mixed.
 *
 * In its planes a pixel shows one triangle: of those in its samples the one in most of them, of
 * equals the one in the first of them. Depth and normal are those at the pixel's centre where one
 * triangle shows in all samples, else at the mean of the samples that show it, which lies inside
 * it: where the triangle is shaded. Nothing is mixed: a transparent triangle counts as an opaque
 * one. */
typedef struct burnish_target {
    uint32_t cookie;        /* set by burnish_target_default() */
    burnish_pixels pixels;  /* of options.width x the rows drawn; pixels.pixels NULL: nothing is
                               shaded. RGB8 not with options.transparent */
    float *depth;           /* distance from the camera along its axis, in the mesh's units; where
                               nothing shows infinity */
    size_t depth_stride;    /* at least 4 width, a multiple of 4 */
    uint32_t *triangles;    /* number of the triangle in burnish_mesh_get_view()'s indices, or
                               BURNISH_TRIANGLE_NONE */
    size_t triangle_stride; /* at least 4 width, a multiple of 4 */
    float *normals;       /* x, y, z of the interpolated normal, of unit length within 2e-7, in the
                             mesh's axes, turned round on triangles seen from their back; where
                             nothing shows, or there is no normal, 0, 0, 0 */
    size_t normal_stride; /* at least 12 width, a multiple of 4 */
    uint8_t *coverage;    /* 255 times the part of the samples that show something, rounded */
    size_t coverage_stride; /* at least width */
} burnish_target;

/* Every pointer NULL. */
BURNISH_API void burnish_target_init(burnish_target *target, uint64_t layout);
static inline burnish_target burnish_target_default(void) {
    burnish_target target;
    burnish_target_init(&target, BURNISH_LAYOUT(burnish_target));
    return target;
}

/* ---- Renderers ---- */

/* What is worth keeping from one frame to the next: the memory that burnish_render would ask for
 * and give back each time. One thread may use a renderer at a time. */
typedef struct burnish_renderer burnish_renderer;

/* *renderer is NULL on error. Release it with burnish_renderer_destroy.
 *   context   where its memory comes from, who runs its tasks, hears of its progress and may cancel
 *             it; NULL: the process' default. Must outlive the renderer
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_renderer_create(const burnish_context *context,
                                                   burnish_renderer **renderer,
                                                   burnish_error *error);

/* Like burnish_render, the same pixels, into an image that is empty ({0}) or was drawn before: its
 * memory is used again where size and channels allow. Scenes and options may differ from frame to
 * frame. Errors as there; the image is then empty. */
BURNISH_API burnish_status burnish_renderer_draw(
    burnish_renderer *renderer, const burnish_mesh *mesh, const burnish_render_options *options,
    burnish_image *image, burnish_render_report *report, burnish_error *error);

/* The same into the caller's memory.
 *   target   from burnish_target_default(), with the planes to draw set; its memory is not kept
 * Errors: as burnish_render, and ARGUMENT for a target that does not fit, which is then not
 * touched. After any other error it holds some pixels. */
BURNISH_API burnish_status burnish_renderer_draw_into(
    burnish_renderer *renderer, const burnish_mesh *mesh, const burnish_render_options *options,
    const burnish_target *target, burnish_render_report *report, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_renderer_destroy(burnish_renderer *renderer);

/* ---- Lines ---- */

/* The edges that a frame showed, as polylines in pixels from the top left corner of the picture. */
typedef struct burnish_lines {
    int width, height;      /* of the picture */
    uint8_t color[3];       /* sRGB */
    float opacity;          /* [0, 1] */
    size_t line_count;      /* 0: the frame had no lines */
    const uint32_t *starts; /* line_count + 1: the first point of each line */
    const float *points;    /* x, y of each point */
    size_t point_count;
    const float *widths; /* pixels, of each line */
} burnish_lines;

/* Those of the last frame, valid until the next one. NULL for NULL. */
BURNISH_API const burnish_lines *burnish_renderer_get_lines(const burnish_renderer *renderer);

struct burnish_drawing; /* drawing.h */

/* Puts the last frame into a drawing (drawing.h), after what it has: first areas, then lines, one
 * path per width. Areas are the surfaces whose colour is not the background's and the cuts that are
 * filled, which are hatched as in the picture; what is in front of one hides it. Colours are flat:
 * ambient light times ka, as with BURNISH_LOOK_DRAWING. Of lights, textures, colours of vertices,
 * ambient occlusion, ground and shadow a drawing shows nothing; transparent surfaces, and those of
 * more than 127 colours, are not filled.
 *   mesh, options  those of the last frame, of all rows
 *   drawing        of the picture's size
 * Borders of areas are right to about a quarter of a pixel, to one pixel in pictures of more than
 * 16 million pixels. The same lines and areas everywhere. Memory, where there are areas: 16 bytes
 * per pixel, at most 64 MiB or 1 byte per pixel, 8 KiB per pixel of a row, and a frame without
 * shading. Errors: ARGUMENT, MEMORY, CANCELLED, LIMIT; the drawing can then only be destroyed. */
BURNISH_API burnish_status burnish_renderer_trace(burnish_renderer *renderer,
                                                  const burnish_mesh *mesh,
                                                  const burnish_render_options *options,
                                                  struct burnish_drawing *drawing,
                                                  burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
