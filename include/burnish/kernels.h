/* burnish/kernels.h: lobes and the lighting equation over arrays, with the instruction sets of the
 * processor and the same bits on each of them.
 *
 * It does not start threads, keep state or draw triangles, and allocates only shaders. Any number
 * of threads may call it at once, each with its own part of the arrays.
 *
 * How to use it.
 *   1. Once: const burnish_kernels *kernels = burnish_kernels_best();
 *   2. Lobes over arrays of cosines: burnish_kernels_lobe_of_cosines(kernels, &lobe, n, ...).
 *   3. Lighting: start from burnish_kernels_lighting_default(), create a shader per material with
 *      burnish_kernels_shader_create(), and call burnish_kernels_shade_rgba8() or _float().
 *   4. Area lights: start from burnish_kernels_polygon_default(), and call
 *      burnish_kernels_polygon_light().
 *
 * Vectors are stored as one float array for x, one for y and one for z. Arrays need the alignment
 * of a float; 64 bytes are fastest. They can have any length, including 0.
 *
 * Guarantees. A result depends only on its own point: not on its index, the length of the array,
 * the instruction set, the compiler, the thread or the floating-point environment, which is
 * restored. The kernels use no fused multiply-add, no approximate instruction and no libm. NaN and
 * infinity in one point do not affect another point.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_KERNELS_H
#define BURNISH_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/lobe.h"
#include "burnish/shading.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The kernels of one instruction set. Constant, never freed. */
typedef struct burnish_kernels burnish_kernels;

/* The kernels of the fastest available instruction set, or of the one in the environment variable
 * BURNISH_ISA if it is available. Never NULL. */
BURNISH_API const burnish_kernels *burnish_kernels_best(void);

/* The kernels of an instruction set; NULL if it is not available. The functions below accept NULL
 * as burnish_kernels_best(), with the same results. */
BURNISH_API const burnish_kernels *burnish_kernels_for(burnish_isa isa);

/* The instruction set of these kernels. */
BURNISH_API burnish_isa burnish_kernels_get_isa(const burnish_kernels *kernels);

/* ---- Lobes ---- */

/* The value of a lobe is in [0, 1] for every float, and 0 for NaN.
 *   family           burnish_lobe_at_cosine() of lobe.h, bit for bit, times the scale
 *   schlick, gx      burnish_schlick_at_cosine(), burnish_gx_at_cosine(), bit for bit
 *   lyon             for a cosine, the family with the fit taylor
 *   power, gaussian  polynomials with an error below 1e-7; 0 below 2^-126
 *   integer power    as power, with multiplications */

/* values[i] = lobe(cosines[i]).
 *   kernels   NULL: burnish_kernels_best()
 *   lobe      one that burnish_lobe_spec_check() accepts, or integer power; not NULL. The fits
 *             minimax, leastsquares and affine are solved in each call, which takes 10 to 100
 *             microseconds
 *   exponent  n in [1, 65536]; for the family see burnish_lobe_solve(); an integer for integer
 *             power
 *   count     number of cosines
 *   cosines   any floats
 *   values    receives count values; the array cosines, or one that does not overlap it
 *   error     receives the message; may be NULL
 * Arrays of 8 MiB and more are written past the caches.
 * Errors: ARGUMENT (a lobe or exponent out of range); nothing is written. */
BURNISH_API burnish_status burnish_kernels_lobe_of_cosines(const burnish_kernels *kernels,
                                                           const burnish_lobe_spec *lobe,
                                                           float exponent, size_t count,
                                                           const float *cosines, float *values,
                                                           burnish_error *error);

/* values[i] = lobe at lambdas[i] = 1 - cosine, which keeps its precision for large exponents in the
 * family; the other lobes use the cosine 1 - lambda. Parameters and errors as above. */
BURNISH_API burnish_status burnish_kernels_lobe_of_lambdas(const burnish_kernels *kernels,
                                                           const burnish_lobe_spec *lobe,
                                                           float exponent, size_t count,
                                                           const float *lambdas, float *values,
                                                           burnish_error *error);

/* ---- Vectors ---- */

/* Scales vectors to unit length without root or division, each component within 2e-7 relative.
 *   kernels  NULL: burnish_kernels_best()
 *   count    number of vectors
 *   in       x, y, z of lengths in [2^-60, 2^60]; (0, 0, 0) stays (0, 0, 0). Other lengths do not
 *            give a unit vector
 *   out      receives x, y, z; can be the arrays of in */
BURNISH_API void burnish_kernels_normalize(const burnish_kernels *kernels, size_t count,
                                           const float *const in[3], float *const out[3]);

/* ---- Lighting ----
 *
 * For a point with normal N, surface colour d and position P, toward the light L, toward the viewer
 * V (all made unit vectors here), each colour channel is
 *
 *   d (Ia ka + sum over lights of kd colour max(0, N.L))
 *     + sum over the lights with N.L > 0 of ks colour lobe(c)
 *
 * with c by the specular model (shading.h), and colour as the light's members for point lights
 * lessen it. Values are linear light.
 *
 * Accuracy: about zeta 2^-22 in the base of a lobe of the family, from rounding c to float. */

/* Material, lights and viewer. Start from burnish_kernels_lighting_default(). */
typedef struct burnish_kernels_lighting {
    uint32_t cookie;           /* set by burnish_kernels_lighting_default() */
    burnish_material material; /* colours in [0, 1e6]; has_diffuse is not read */
    burnish_lobe_spec lobe;    /* for lyon with Blinn, N must have nearly unit length; the lobe
                                  scales it by burnish_lyon_normalize_factor() */
    burnish_specular_model specular_model;
    float ambient_light[3]; /* Ia, [0, 1e6] */
    int local_viewer;       /* 0: V is `viewer` everywhere; 1: `viewer` is a position */
    float viewer[3];        /* unit vector toward the viewer, or its position */
    int light_count;        /* [0, BURNISH_LIGHT_MAX] */
    burnish_light lights[BURNISH_LIGHT_MAX]; /* without follows_camera; directions have length 1.
                                                Rounded to float */
} burnish_kernels_lighting;

/* Ambient 0.05, diffuse 0.6, specular 0.35, exponent 32, energy:2, Blinn, white ambient light, a
 * distant viewer toward +z, one white directional light from (-0.48, 0.6, 0.64). */
BURNISH_API void burnish_kernels_lighting_init(burnish_kernels_lighting *lighting, uint64_t layout);
static inline burnish_kernels_lighting burnish_kernels_lighting_default(void) {
    burnish_kernels_lighting lighting;
    burnish_kernels_lighting_init(&lighting, BURNISH_LAYOUT(burnish_kernels_lighting));
    return lighting;
}

/* A lighting that was checked and reduced to constants. Any number of threads may use it. */
typedef struct burnish_kernels_shader burnish_kernels_shader;

/* Creates a shader, with some tens of operations per light. The fits minimax, leastsquares and
 * affine take 10 to 100 microseconds.
 *   lighting  not NULL; not used after the call
 *   context   supplies memory; NULL: malloc. Must outlive the shader
 *   shader    receives the shader, NULL on error; release it with burnish_kernels_shader_destroy()
 *   error     receives the message; may be NULL
 * Errors: ARGUMENT (not initialised, numbers out of range, directions that differ from unit length
 * by more than 1e-3), MEMORY. */
BURNISH_API burnish_status burnish_kernels_shader_create(const burnish_kernels_lighting *lighting,
                                                         const burnish_context *context,
                                                         burnish_kernels_shader **shader,
                                                         burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_kernels_shader_destroy(burnish_kernels_shader *shader);

/* The points to shade: arrays of count floats. */
typedef struct burnish_kernels_points {
    const float *normal[3];   /* length in [2^-60, 2^60]; (0, 0, 0) gets only the ambient term */
    const float *diffuse[3];  /* d, >= 0; all NULL: 1 */
    const float *position[3]; /* times w; for point lights or a local viewer */
    const float *w;           /* > 0: the point is at position / w; NULL: 1 */
    const float *first_light; /* [0, 1]: share of the first light that arrives; NULL: 1 */
} burnish_kernels_points;

/* Shades points to pixels: channel = 255 min(1, value), rounded to nearest even; alpha 255.
 *   kernels  NULL: burnish_kernels_best()
 *   shader   from burnish_kernels_shader_create(); not NULL
 *   points   no array overlaps the output; differences of positions in [2^-60, 2^60]
 *   count    number of points
 *   rgba     receives 4 count bytes, red first
 *   error    receives the message; may be NULL
 * Errors: ARGUMENT (a missing shader or array); nothing is written. */
BURNISH_API burnish_status burnish_kernels_shade_rgba8(const burnish_kernels *kernels,
                                                       const burnish_kernels_shader *shader,
                                                       const burnish_kernels_points *points,
                                                       size_t count, uint8_t *rgba,
                                                       burnish_error *error);

/* Shades points to linear floats, in three arrays of count, without an upper limit. Other
 * parameters and errors as for burnish_kernels_shade_rgba8(). */
BURNISH_API burnish_status burnish_kernels_shade_float(const burnish_kernels *kernels,
                                                       const burnish_kernels_shader *shader,
                                                       const burnish_kernels_points *points,
                                                       size_t count, float *const rgb[3],
                                                       burnish_error *error);

/* ---- Area lights ----
 *
 * The light of a convex polygon, sphere or tube P of radiance 1, seen from a point with normal N,
 * over the part of P above the horizon (N.w > 0):
 *
 *   diffuse  = 1/pi integral of max(0, N.w) dw          Lambert's formula
 *   specular = sum over lobes of weight / E integral of S(R.w) dw
 *
 * with the lobes S(c) = max(0, 1 + zeta (c - 1))^m or composites around the axis R, such as the
 * mirror direction, and E, the integral of S over all directions: 2 pi / (zeta (m + 1)). A light
 * that fills the hemisphere has diffuse = 1; a light that fills a lobe's cone has specular =
 * weight.
 *
 * A sphere is a cap of directions. A tube is the strip between its two tangent planes through the
 * point, and its ends are open. A point inside is lit nearly as on the surface, from the side of
 * the centre or axis.
 *
 * Accuracy over random lights: diffuse 3e-7; specular, relative to the weight, 5e-5 for zeta >= 1
 * and 2e-4 below. With a stretch, a sphere is a polygon of 16 corners. */

#define BURNISH_POLYGON_VERTEX_MAX 16
#define BURNISH_POLYGON_LOBE_MAX 3

/* A part of a reflection. */
typedef struct burnish_kernels_lobe {
    int order;    /* m: 1, 2, 4, 8, 16 or 32; 0: `composite` instead */
    float zeta;   /* [0.5, 65536]; for a sphere at least 1; not read with order 0 */
    float weight; /* [0, 1e6] */
    burnish_composite
        composite; /* order 0: from burnish_composite_create(), with its energy as E */
} burnish_kernels_lobe;

/* A light and the lobes that reflect it. Start from burnish_kernels_polygon_default(). */
typedef struct burnish_kernels_polygon {
    uint32_t cookie;  /* set by burnish_kernels_polygon_default() */
    int is_distant;   /* 1: vertices are directions of any length, the same from all points; 0: they
                         are positions */
    int is_two_sided; /* 0: the light shines to the side from which the vertices are in
                         counterclockwise order; a distant one on (0, 0, 0). 1: to both sides */
    int vertex_count; /* [3, BURNISH_POLYGON_VERTEX_MAX]; 1: a sphere around the vertex; 2: a tube
                         from one vertex to the other */
    /* Corners of a flat and convex polygon, within 1e-4 of its size; coordinates in
     * [-2^40, 2^40]. */
    float vertices[BURNISH_POLYGON_VERTEX_MAX][3];
    float radius;   /* of a sphere or tube, (0, 2^40]; if it is distant, below the distance of its
                     middle from (0, 0, 0) */
    int lobe_count; /* [0, BURNISH_POLYGON_LOBE_MAX] */
    burnish_kernels_lobe lobes[BURNISH_POLYGON_LOBE_MAX];
} burnish_kernels_polygon;

/* A square of side 2 at z = 1 that shines toward (0, 0, 0), one-sided, with one lobe of order 2,
 * zeta 1 and weight 1. */
BURNISH_API void burnish_kernels_polygon_init(burnish_kernels_polygon *polygon, uint64_t layout);
static inline burnish_kernels_polygon burnish_kernels_polygon_default(void) {
    burnish_kernels_polygon polygon;
    burnish_kernels_polygon_init(&polygon, BURNISH_LAYOUT(burnish_kernels_polygon));
    return polygon;
}

/* The directions of reflection: arrays of count floats. With e, the stretch, the specular light is
 * that of a polygon whose vertices p, relative to the point, are moved to p + e (e.p). The
 * highlight is narrower along e. */
typedef struct burnish_kernels_axes {
    const float *axis[3];    /* R: unit vectors */
    const float *stretch[3]; /* e: normal to N; all NULL: 0 */
} burnish_kernels_axes;

/* Computes the light of a polygon at points.
 *   kernels  NULL: burnish_kernels_best()
 *   polygon  not NULL
 *   points   not NULL; normals of lengths in [2^-60, 2^60]; all NULL: no horizon, then light[0] is
 *            NULL. Positions and w as for point lights; not read for distant lights. diffuse and
 *            first_light are not read
 *   axes     not read without lobes; may be NULL then
 *   count    number of points
 *   light    light[0] receives count values of diffuse in [0, 1], light[1] of specular, at least 0;
 *            one of them may be NULL. No array overlaps an input
 *   error    receives the message; may be NULL
 * Points in the plane of a light, within rounding, get exactly 0.
 * Errors: ARGUMENT (not initialised, numbers out of range, a polygon that has no area, is not flat
 * or not convex, a distant light seen from its edge, a missing array); nothing is written. */
BURNISH_API burnish_status burnish_kernels_polygon_light(const burnish_kernels *kernels,
                                                         const burnish_kernels_polygon *polygon,
                                                         const burnish_kernels_points *points,
                                                         const burnish_kernels_axes *axes,
                                                         size_t count, float *const light[2],
                                                         burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
