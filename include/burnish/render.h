/* burnish/render.h: draws a mesh into an image or into memory of the caller.
 *
 * The Phong illumination equation, per pixel, in linear light:
 *   I = Ia ka + sum over lights Il (kd max(0, N.L) + ks S(c)),  S = 0 where N.L <= 0,
 * with c = N.H (Blinn) or R.V (Phong) and S a lobe of shading.h.
 *
 * Transparent surfaces (burnish_material.transparency, alpha of vertex colours) are blended at
 * every sample, in linear light and in order of depth: a C + (1 - a) L for a surface with opacity a
 * and colour C, highlights included, in front of the light L. Both of their sides are visible. They
 * cast no ambient occlusion.
 *
 * Cuts of solids (burnish_mesh_clip()) are filled. If the nearest triangle is seen from inside, the
 * plane of the cut is visible instead, hatched at 45 degrees in a warmer tone of the material.
 * Depth and normal are taken from the plane, the triangle id from the triangle. Cuts of transparent
 * triangles are not filled.
 *
 * Area lights, a dome and an environment (light.h) are reflected; objects reflect each other
 * only with raytracing. It does not draw refraction.
 *
 * How to use it.
 *   1. Options: burnish_render_options options = burnish_render_options_default();
 *      Set options.camera; burnish_camera_frame() of mesh.h shows the whole mesh.
 *   2. A single image: burnish_render(mesh, &options, &image, NULL, &error).
 *   3. Many images: a burnish_renderer keeps its memory between frames. Call
 *      burnish_renderer_create(), burnish_renderer_draw() for each, burnish_renderer_destroy().
 *   4. Your own memory (the surface of a window, a shared segment), or planes of depth, triangle
 *      ids, normals and coverage: start from burnish_target_default() and call
 *      burnish_renderer_draw_into().
 *   5. Allocator, task runner, progress and cancelling: a burnish_context.
 *
 * Guarantees. The same mesh, options and target format give the same bytes on every machine,
 * compiler and instruction set and for any number of threads. The floating-point environment of the
 * caller has no influence and is restored. A renderer remains usable after an error.
 *
 * Threads. One thread at a time may use a renderer. Many renderers may draw the same mesh at once,
 * but not while burnish_mesh_set_material() or burnish_mesh_clip() changes it.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RENDER_H
#define BURNISH_RENDER_H

#include "burnish/core.h"
#include "burnish/image.h"
#include "burnish/kernels.h"
#include "burnish/light.h"
#include "burnish/mesh.h"
#include "burnish/shading.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the report counts; the other members stay 0. Counting triangles takes longer than counting
 * pixels. */
typedef enum burnish_counts {
    BURNISH_COUNTS_ALL,
    BURNISH_COUNTS_PIXELS, /* covered_pixels and bounds */
    BURNISH_COUNTS_NONE,
    BURNISH_COUNTS_AREA /* ALL and hidden_share */
} burnish_counts;

/* From linear light to the 8-bit values of an image. */
typedef enum burnish_tone_mapping {
    BURNISH_TONES_NONE,    /* light above 1 is clamped */
    BURNISH_TONES_NEUTRAL, /* Khronos PBR Neutral (2024): colours up to 0.76 keep their hue and
                              saturation, brighter ones approach white */
    BURNISH_TONES_SOFT,   /* NEUTRAL without its toe, which takes up to 0.04 off dark colours: light
                              up to 0.76 stays as it is */
    BURNISH_TONES_FILMIC, /* Narkowicz' fit of ACES (2016), for each channel: more contrast */
    BURNISH_TONES_COUNT
} burnish_tone_mapping;

/* The range of exposure, in stops. */
#define BURNISH_EXPOSURE_MAX 20

/* The most directions of ambient occlusion, and the automatic number: from 72 (48 in small images)
 * for up to 8,192 triangles down to 18 for more than a million, 36 for points. */
#define BURNISH_OCCLUSION_MAX 256
#define BURNISH_OCCLUSION_AUTO (-1)

/* The most transparent surfaces that a sample shows. The nearest are drawn; the report counts the
 * others. If large surfaces would exceed max_overdraw, the limit is lower, but at least 32. */
#define BURNISH_TRANSPARENT_LAYERS_MAX 256

/* The edges that are drawn as lines: a sum of BURNISH_EDGES_... values. */
typedef uint32_t burnish_edge_flags;
enum {
    BURNISH_EDGES_SILHOUETTES = 1, /* where the surface turns away from the camera in front of a
                                      more distant background */
    BURNISH_EDGES_CREASES = 2,     /* edges with two normals */
    BURNISH_EDGES_BOUNDARIES = 4,  /* edges of one triangle */
    BURNISH_EDGES_MATERIALS = 8,   /* between two materials */
    BURNISH_EDGES_FEATURES = 15,   /* all of these */
    BURNISH_EDGES_ALL = 16,        /* of every triangle: a wireframe */
    /* FEATURES as thin, soft lines in a parallel projection along an axis of the mesh, where a step
     * has the same colour as the surface behind it; no lines in other views. */
    BURNISH_EDGES_AXIS_VIEWS = 32,
    /* In addition, dashes for edges that the surface hides and no other line covers (ISO 128-2) */
    BURNISH_EDGES_HIDDEN = 64,
    /* In addition, chain lines along the axes that two circles of hard edges have in common, and
     * crosses where such an axis points to the viewer; without HIDDEN only if one circle is seen */
    BURNISH_EDGES_CENTERS = 128,
    /* In addition, thin lines where a bend, such as a fillet, meets a face (ISO 128-2) */
    BURNISH_EDGES_TANGENTS = 256
};

/* The widest line, in pixels. */
#define BURNISH_EDGE_WIDTH_MAX 100

/* One thread per processor, or the thread_count of the context's task runner. */
#define BURNISH_THREADS_AUTO 0

/* The default of max_overdraw. */
#define BURNISH_OVERDRAW_DEFAULT 1000

/* Options for drawing. Start from burnish_render_options_default(). The lights are in the struct,
 * not behind a pointer, so a copy is complete; the price is 4.3 kB. Only context, kernels and
 * environment are pointers. */
typedef struct burnish_render_options {
    uint32_t cookie;                /* set by burnish_render_options_default() */
    const burnish_context *context; /* for burnish_render(); with a renderer, NULL or its context */
    int width, height;              /* pixels, [1, BURNISH_IMAGE_MAX_SIZE] */
    int first_row, row_count;       /* draw row_count rows from first_row on; 0, 0: all rows. See
                                       "Rows of an image" below */
    int samples;                    /* coverage samples per pixel: 1, 4, 8 or 16 */
    int threads; /* [1, 1024] or BURNISH_THREADS_AUTO; does not affect the pixels */
    const burnish_kernels *kernels; /* NULL: burnish_kernels_best(); do not affect the pixels */
    burnish_camera camera;
    double principal_point[2]; /* where the axis of a perspective meets the image: pixels to the
                                  right of and above its middle, which is 0, 0 */
    double pixel_aspect;       /* width of a pixel divided by its height, [0.01, 100]; 1: square */
    burnish_lobe_spec lobe;    /* one that burnish_lobe_spec_check() accepts; where a texture varies
                               exponent, highlight or normal, POWER for COMPOSITE and EXACT */
    burnish_specular_model specular_model;
    int local_viewer;       /* 1: V points from the surface to the camera; 0: V is the axis of the
                               camera everywhere */
    float ambient_light[3]; /* Ia, linear */
    int occlusion; /* directions of ambient occlusion, [0, BURNISH_OCCLUSION_MAX]; 0: no occlusion;
                      or BURNISH_OCCLUSION_AUTO. An odd number is rounded up */
    float occlusion_strength; /* [0, 1]: what a point from which a light is hidden loses of it; by
                                 raytracing all. What surfaces around it reflect, by their colour,
                                 is added */
    int raytracing; /* 1: rays find what is hidden for occlusion, shadow and ground, instead of depth
                       maps, which stay for points, what bounces, and what smooth surfaces mirror
                       of others. Takes 75 bytes per triangle, 175 while it starts */
    double up[3]; /* the up direction for the ground, and for the sky as which lights without extent
                     count in occlusion; of any length; 0, 0, 0: the up_axis of the mesh */
    int ground;   /* 1: the object shades the plane normal to `up` through its lowest point. The
                   background is darkened where it shows that plane from above; a transparent
                   background becomes black with the shadow as alpha. Without `lights`, the shadow
                   falls away from the strongest area light */
    int shadow;   /* 1: the first light, which must be directional, or without such lights the
                   strongest area light, casts shadows on the object; on the ground it does
                   anyway if it is an area light */
    burnish_light lights[BURNISH_LIGHT_MAX];
    int light_count;                                        /* [0, BURNISH_LIGHT_MAX] */
    burnish_area_light area_lights[BURNISH_AREA_LIGHT_MAX]; /* light.h */
    int area_light_count;                                   /* [0, BURNISH_AREA_LIGHT_MAX] */
    int has_dome;                                           /* 1: dome shines */
    burnish_dome dome;
    float
        reflection_distance; /* 0, or [1.25, 1e6]: distant area lights and the dome are reflected as
                                  if they were on a sphere of so many radii of the object around it,
                                  so flat faces get a gradient. No effect with an environment, nor on
                                  the light that casts a shadow */
    const burnish_environment *environment; /* NULL: none; must outlive the call */
    float environment_strength;             /* factor of its radiance, [0, 1e6] */
    double
        environment_turn; /* degrees by which it is turned about up, counter-clockwise from above */
    int environment_follows_camera; /* 1: it turns with the camera, its up is the camera's y axis */
    /* Targets of linear light get neither exposure nor tone mapping, and `background` is shown as it
     * is; an environment behind the object gets both. */
    float exposure; /* stops, [-BURNISH_EXPOSURE_MAX, BURNISH_EXPOSURE_MAX]: light times
                       2^exposure */
    burnish_tone_mapping tone_mapping;
    burnish_edge_flags edges; /* 0: none */
    float edge_width;         /* of visible edges in pixels, (0, BURNISH_EDGE_WIDTH_MAX].
                              Hidden lines and axes have half of it, wireframes and edges that
                              are not opaque 3/5, but for outlines */
    uint8_t edge_color[3];    /* sRGB */
    float edge_opacity;       /* [0, 1] */
    int outline_contrast;  /* [0, 255]: where the outline of the object differs from the background
                             by less than this in every channel, in 8-bit sRGB values, a hairline
                             is drawn along it, inside; 0: never. Not drawn if transparent */
    uint8_t background[3]; /* sRGB */
    int background_environment; /* 1: the background shows `environment` instead, with its strength
                                   and turn. A parallel projection shows it as a perspective of
                                   camera.view_angle does. Needs an environment and no transparent
                                   background */
    int transparent;            /* 1: the image has alpha and no background */
    int ignore_colors;          /* 1: vertex colours are not used */
    int cull_back_faces;   /* 1: back-facing triangles are not drawn: faster, and the same image for
                            closed surfaces; 0: both sides are lit */
    double max_overdraw;   /* [1, infinity]: how often large triangles may cover the image (as many
                            times more if it has less than 512 x 512 pixels) and, twice as often,
                            each depth map of shadows (256 x 256). It limits the time: beyond it,
                            drawing fails with LIMIT. A visible or hidden triangle counts if its
                            bounds exceed 16 pixels, by the 8 x 8 pixel cells of its bounds or, if
                            fewer, of its area and outline; transparent triangles count 28 times */
    burnish_counts counts; /* for the report; does not affect the pixels */
} burnish_render_options;

/* 1024x768, 4 samples, the lobe auto (energy:2 by_material), Blinn, local viewer,
 * BURNISH_LOOK_PLAIN of look.h: key, fill and rim light that follow the camera, a little ambient
 * light, a white background. The camera must be set: its position equals its focal point, which is
 * refused. */
BURNISH_API void burnish_render_options_init(burnish_render_options *options, uint64_t layout);
static inline burnish_render_options burnish_render_options_default(void) {
    burnish_render_options options;
    burnish_render_options_init(&options, BURNISH_LAYOUT(burnish_render_options));
    return options;
}

/* ---- Rows of an image ----
 *
 * Several machines can draw one image, and one machine can draw an image larger than its memory.
 * With options.first_row and row_count a call draws only these rows, with the same bits as in the
 * whole image. Images and targets then hold row_count rows. Other rows are neither shaded nor
 * stored. Edges are the exception: they need depth and triangle ids of all rows, 8 bytes per pixel
 * of the whole image. A hairline (outline_contrast) needs the samples of one row more on each side,
 * whose tiles are drawn without shading; a renderer that draws rows from top to bottom keeps one of
 * them.
 *
 * If first_row and row_count are multiples of 64, no work is done twice. A renderer that draws the
 * rows of one mesh and view in several calls transforms, culls and finds lines only once.
 *
 * In the report, covered_pixels and bounds cover the drawn rows, with bounds in coordinates of the
 * whole image; triangles_drawn, hidden_share and layers_dropped can include rows up to the next
 * multiples of 64; overdraw covers the whole image. */

/* Reports what was drawn. */
typedef struct burnish_render_report {
    size_t triangles;       /* of the mesh */
    size_t triangles_drawn; /* visible in at least one sample */
    double hidden_share; /* of the area, in triangles that are not visible in any sample, [0, 1] */
    size_t covered_pixels;    /* with at least one covered sample */
    int bounds[4];            /* x0, y0, x1, y1 (exclusive) of the covered pixels; 0 if none */
    int threads;              /* used */
    burnish_isa isa;          /* used */
    int occlusion_directions; /* of ambient occlusion; 0: none */
    double overdraw;          /* the value that max_overdraw limits */
    size_t layers_dropped; /* transparent layers of samples that were omitted, behind the limit */
    int shadow;            /* 1: the shadow of a light was drawn */
    int ground; /* 1: its shadow was drawn; 0: not requested, or the camera is below it */
    size_t lobe_fallbacks; /* materials whose exponent is too low for the order of the lobe; drawn
                              with the highest order possible */
    double seconds_transform; /* materials, vertices, clipping, culling */
    double seconds_draw;      /* tiles: binning, visibility, shading */
} burnish_render_report;

/* Draws a mesh into a new image.
 *   mesh     only read
 *   options  from burnish_render_options_default(); options.context supplies memory and threads
 *   image    receives the image, RGB or, with options.transparent, RGBA; empty on error. Release it
 *            with burnish_image_destroy()
 *   report   may be NULL
 *   error    receives the message; may be NULL
 * Memory besides the image: 36 bytes per vertex (20 for its position on the screen, 16 for its
 * normal), 16 more with vertex colours; 13 bytes per triangle, 1 more if drawn triangles are
 * counted; with outline_contrast 1 byte per pixel; 13 bytes per point of a cloud; 0.3 kB per
 * material and 76 bytes more per light. Tile lists take 8 bytes per entry of up to 16 neighbouring
 * triangles, at most about 128 MiB unless a single row of tiles needs more. Each thread takes 0.2
 * MB and, with several samples, 0.2 MB and 0.7 MB per sample more. Ambient occlusion takes 130 KiB
 * per direction (33 KiB for images below 384 pixels), 16 bytes per vertex for each thread, up to 48
 * more per vertex, and 12 per triangle.
 * The ground takes the same for at least 16 directions, and 2.2 MB. A shadow takes 2 MB, 8 MB in
 * images above 1024 pixels. Transparent triangles take 1 bit per triangle of the mesh and, for each
 * thread, 1.1 MB per sample. Distant area lights, a dome or an environment take at most 5 MB for
 * each roughness of the materials, at most 16, and 12 MB if textures vary roughness. Images above 512
 * pixels take 45 MB for each roughness below 0.125, at most 5.
 * Errors: ARGUMENT, MEMORY, CANCELLED, LIMIT (max_overdraw, or a mesh that is too small, below
 * about 1e-33 across, or too much enlarged for single precision). */
BURNISH_API burnish_status burnish_render(const burnish_mesh *mesh,
                                          const burnish_render_options *options,
                                          burnish_image *image, burnish_render_report *report,
                                          burnish_error *error);

/* ---- Targets ---- */

/* The triangle id of a pixel without a triangle. */
#define BURNISH_TRIANGLE_NONE UINT32_MAX

/* The memory of the caller that receives an image: rows from the top, strides in bytes from one row
 * to the next. Bytes between rows are not written. A plane that is NULL is not drawn and costs
 * nothing.
 *
 * Alpha is straight: 255 (1 in floats) if options.transparent is 0; otherwise the mean over the
 * samples of 1 minus the product of the transparencies in the sample, 0 for the background.
 * RGBA_FLOAT is linear light without an upper limit, exposure or tone mapping. For the other formats
 * each sample's light gets both and is clamped to 1 before the samples are averaged.
 *
 * The planes hold one triangle per pixel: the triangle with the most samples or, if equal, the one
 * in the first sample. Depth and normal are taken at the centre of the pixel if the triangle has
 * all samples, else at the mean of its samples, which is where the triangle is shaded. Planes are
 * not averaged, and transparent triangles count as opaque. */
typedef struct burnish_target {
    uint32_t cookie;        /* set by burnish_target_default() */
    burnish_pixels pixels;  /* of options.width x the drawn rows; pixels.pixels NULL: nothing is
                               shaded. Not RGB8 with options.transparent */
    float *depth;           /* distance along the axis of the camera in units of the mesh; infinity
                               for the background */
    size_t depth_stride;    /* at least 4 width, a multiple of 4 */
    uint32_t *triangles;    /* triangle id: the number in burnish_mesh_view.indices, or
                               BURNISH_TRIANGLE_NONE; of a wall that a negative volume has cut,
                               one of the object that it cuts */
    size_t triangle_stride; /* at least 4 width, a multiple of 4 */
    float *normals;       /* x, y, z of the interpolated normal in axes of the mesh, of unit length
                             within 2e-7, flipped on back-facing triangles; 0, 0, 0 for the
                             background or without a normal */
    size_t normal_stride; /* at least 12 width, a multiple of 4 */
    uint8_t *coverage;    /* 255 times the share of covered samples, rounded */
    size_t coverage_stride; /* at least width */
} burnish_target;

/* All pointers are NULL. */
BURNISH_API void burnish_target_init(burnish_target *target, uint64_t layout);
static inline burnish_target burnish_target_default(void) {
    burnish_target target;
    burnish_target_init(&target, BURNISH_LAYOUT(burnish_target));
    return target;
}

/* ---- Renderers ---- */

/* A renderer keeps the memory that burnish_render() would allocate and release each time. One
 * thread at a time may use it. */
typedef struct burnish_renderer burnish_renderer;

/* Creates a renderer.
 *   context   supplies memory and threads, receives progress, can cancel; NULL: the default. Must
 *             outlive the renderer
 *   renderer  receives the renderer, NULL on error; release it with burnish_renderer_destroy()
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_renderer_create(const burnish_context *context,
                                                   burnish_renderer **renderer,
                                                   burnish_error *error);

/* Draws a frame, with the same pixels as burnish_render(). Mesh and options can differ from frame
 * to frame.
 *   image  empty ({0}) or drawn before; its memory is reused if context, size and channels match.
 *          Empty on error
 * Other parameters and errors as for burnish_render(). */
BURNISH_API burnish_status burnish_renderer_draw(
    burnish_renderer *renderer, const burnish_mesh *mesh, const burnish_render_options *options,
    burnish_image *image, burnish_render_report *report, burnish_error *error);

/* Draws a frame into memory of the caller.
 *   target  from burnish_target_default(), with the wanted planes set; not used after the call
 * Other parameters as for burnish_renderer_draw(). Errors: as for burnish_render(), and ARGUMENT
 * for a target that does not match the options, which is then not written. After other errors it is
 * incomplete. */
BURNISH_API burnish_status burnish_renderer_draw_into(
    burnish_renderer *renderer, const burnish_mesh *mesh, const burnish_render_options *options,
    const burnish_target *target, burnish_render_report *report, burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_renderer_destroy(burnish_renderer *renderer);

/* ---- Lines ---- */

/* The lines of a frame, dash by dash, as polylines in pixels from the top left corner of the image.
 */
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

/* The lines of the last frame, valid until the next frame. NULL for NULL. */
BURNISH_API const burnish_lines *burnish_renderer_get_lines(const burnish_renderer *renderer);

struct burnish_drawing; /* drawing.h */

/* Adds the last frame to a drawing (drawing.h): first areas, then lines, one path per width. Areas
 * are the visible parts of surfaces whose colour differs from the background, and of filled cuts,
 * which are hatched. Colours are flat: ambient light times ka, as with BURNISH_LOOK_DRAWING.
 * Lights, textures, vertex colours, ambient occlusion, ground and shadow are not drawn. Transparent
 * surfaces are not filled, nor are surfaces beyond 127 colours.
 *   renderer       with the last frame, of all rows
 *   mesh, options  as for the last frame
 *   drawing        of the size of the image
 * Borders of areas are accurate to about a quarter of a pixel, or to one pixel in images above 16
 * million pixels. The result is the same on every machine. Areas take 16 bytes per pixel, at most
 * 64 MiB or 1 byte per pixel, 8 KiB per pixel of a row, and a frame without shading.
 * Errors: ARGUMENT, MEMORY, CANCELLED, LIMIT; the drawing can then only be destroyed. */
BURNISH_API burnish_status burnish_renderer_trace(burnish_renderer *renderer,
                                                  const burnish_mesh *mesh,
                                                  const burnish_render_options *options,
                                                  struct burnish_drawing *drawing,
                                                  burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
