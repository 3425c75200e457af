/* burnish/kernels.h: lobes and the whole lighting equation over arrays, at the speed of the
 * machine, with the same bits on every instruction set.
 *
 * What it does not do: start threads, keep state or draw triangles; only a shader is allocated.
 * Call it from as many threads as you like, each with its own part of the arrays.
 *
 * How to use it.
 *   1. Once: const burnish_kernels *kernels = burnish_kernels_best();
 *   2. Lobes over arrays of cosines: burnish_kernels_lobe_of_cosines(kernels, &lobe, n, ...).
 *   3. Lighting: fill a burnish_kernels_lighting from burnish_kernels_lighting_default(), make a
 *      shader of it, one per material, with burnish_kernels_shader_create, then call
 *      burnish_kernels_shade_rgba8 or _float for the points.
 *
 * Arrays are structures of arrays: one float array for x, one for y, one for z. None needs any
 * alignment beyond a float's, though 64 bytes are fastest; lengths need not be a multiple of
 * anything, and 0 is fine.
 *
 * What it promises. A result depends on its own point only, not on its index in the array, the
 * array's length, the instruction set, the compiler, the thread or the caller's floating-point
 * environment, which is as before afterwards. No fused multiply-add, no approximate instruction, no
 * libm. NaN and infinity in an input harm no other point.
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

/* The kernels of the fastest instruction set that runs here, or of the one that the environment
 * variable BURNISH_ISA names; a name that does not run here is passed over. Never NULL. Keep the
 * result: it asks the processor. */
BURNISH_API const burnish_kernels *burnish_kernels_best(void);

/* The kernels of an instruction set, or NULL if this build or processor lacks it. Every function
 * below takes NULL as burnish_kernels_best(): the results are the same. */
BURNISH_API const burnish_kernels *burnish_kernels_for(burnish_isa isa);

/* The instruction set of these kernels. */
BURNISH_API burnish_isa burnish_kernels_get_isa(const burnish_kernels *kernels);

/* ---- Lobes ---- */

/* Each lobe gives a value in [0, 1] for every float, 0 for NaN.
 *   family       burnish_lobe_at_cosine of burnish/lobe.h, bit for bit, times the scale
 *   schlick, gx  burnish_schlick_at_cosine, burnish_gx_at_cosine, bit for bit
 *   lyon         of a cosine: the family's taylor
 *   power, gaussian  within 1e-7, by polynomials; 0 where they are below 2^-126
 *   whole power  the same as power, by multiplications */

/* values[i] = lobe(cosines[i]).
 *   kernels   from burnish_kernels_best or burnish_kernels_for; NULL: the best
 *   lobe      any that burnish_lobe_spec_check accepts, and whole power; not NULL. The searched
 *             fits (minimax, leastsquares, affine) are solved in each call: 10 to 100 microseconds
 *   exponent  n: [1, 65536], for the family as burnish_lobe_solve has it; a whole number for whole
 *             power
 *   count     number of cosines
 *   cosines   any floats
 *   values    receives count values; may be cosines itself, must not overlap it otherwise
 *   error     receives the one line of an error; may be NULL
 * Arrays of 8 MiB and more are written past the caches.
 * Errors: ARGUMENT for a lobe or exponent out of range; nothing is written. */
BURNISH_API burnish_status burnish_kernels_lobe_of_cosines(const burnish_kernels *kernels,
                                                           const burnish_lobe_spec *lobe,
                                                           float exponent, size_t count,
                                                           const float *cosines, float *values,
                                                           burnish_error *error);

/* values[i] = lobe at 1 - cosine = lambdas[i]: the form that keeps its digits for large exponents
 * (family; the other lobes take the cosine 1 - lambda). Otherwise the same. */
BURNISH_API burnish_status burnish_kernels_lobe_of_lambdas(const burnish_kernels *kernels,
                                                           const burnish_lobe_spec *lobe,
                                                           float exponent, size_t count,
                                                           const float *lambdas, float *values,
                                                           burnish_error *error);

/* ---- Vectors ---- */

/* Scales vectors to unit length, each component within 2e-7 relative, with neither root nor
 * division.
 *   kernels  from burnish_kernels_best or burnish_kernels_for; NULL: the best
 *   in       x, y, z of lengths in [2^-60, 2^60]; (0, 0, 0) stays (0, 0, 0), others give no unit
 *            vector
 *   out      receives x, y, z; may be in's arrays */
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
 * with c by the specular model (shading.h). Lights do not
 * fall off with distance: scale their colour. Numbers are linear light.
 *
 * Accuracy: with the family, zeta and the half vector are one constant where both light and viewer
 * are far; then, and with the cosines of point lights, rounding is that of c in float: about
 * zeta 2^-22 in the lobe's base. */

/* Material, lights and viewer. Start from burnish_kernels_lighting_default(). */
typedef struct burnish_kernels_lighting {
    uint32_t cookie;           /* set by burnish_kernels_lighting_default() */
    burnish_material material; /* colours in [0, 1e6]; has_diffuse is not read */
    burnish_lobe_spec lobe;    /* lyon with Blinn: N has nearly unit length and is scaled by
                                  burnish_lyon_normalize_factor for the lobe instead of exactly */
    burnish_specular_model specular_model;
    float ambient_light[3]; /* Ia, [0, 1e6] */
    int local_viewer;       /* 0: V is `viewer` everywhere; 1: the viewer stands at `viewer` */
    float viewer[3];        /* unit vector toward the viewer, or its position */
    int light_count;        /* [0, BURNISH_LIGHT_MAX] */
    burnish_light lights[BURNISH_LIGHT_MAX]; /* none follows a camera; directions of length 1;
                                                rounded to float */
} burnish_kernels_lighting;

/* Ambient .05, diffuse .6, specular .35, exponent 32, energy:2, Blinn, white ambient light, a
 * distant viewer toward +z, one white directional light from (-.48, .6, .64). */
BURNISH_API void burnish_kernels_lighting_init(burnish_kernels_lighting *lighting, uint64_t layout);
static inline burnish_kernels_lighting burnish_kernels_lighting_default(void) {
    burnish_kernels_lighting lighting;
    burnish_kernels_lighting_init(&lighting, BURNISH_LAYOUT(burnish_kernels_lighting));
    return lighting;
}

/* A lighting, checked and folded into what does not depend on the point. Constant. */
typedef struct burnish_kernels_shader burnish_kernels_shader;

/* Makes one. Some tens of operations per light; the searched fits of the family (minimax,
 * leastsquares, affine) take 10 to 100 microseconds.
 *   lighting  not NULL; not kept
 *   context   where its memory comes from; NULL: malloc. Must outlive the shader
 *   shader    receives it, NULL on error; give it to burnish_kernels_shader_destroy; not NULL
 *   error     receives the one line of an error; may be NULL
 * Errors: ARGUMENT for numbers out of range, directions that are not unit vectors (by more than
 * 1e-3), a lighting that does not come from burnish_kernels_lighting_default; MEMORY. */
BURNISH_API burnish_status burnish_kernels_shader_create(const burnish_kernels_lighting *lighting,
                                                         const burnish_context *context,
                                                         burnish_kernels_shader **shader,
                                                         burnish_error *error);

/* NULL is allowed. */
BURNISH_API void burnish_kernels_shader_destroy(burnish_kernels_shader *shader);

/* The points to shade: arrays of count floats. */
typedef struct burnish_kernels_points {
    const float *normal[3];   /* length in [2^-60, 2^60]; (0, 0, 0) gets the ambient term only */
    const float *diffuse[3];  /* d, >= 0; all NULL: 1 */
    const float *position[3]; /* times w; read where a light is a point or the viewer local */
    const float *w;           /* > 0: the point lies at position / w; NULL: 1 */
    const float *first_light; /* [0, 1]: what of the first light reaches the point; NULL: all */
} burnish_kernels_points;

/* Shades points into pixels: channel = 255 min(1, value), halves to even; alpha 255.
 *   kernels  from burnish_kernels_best or burnish_kernels_for; NULL: the best
 *   shader   from burnish_kernels_shader_create; not NULL
 *   points   no array overlaps the output; differences of positions in [2^-60, 2^60]
 *   count    number of points
 *   rgba     receives 4 count bytes, R first
 *   error    receives the one line of an error; may be NULL
 * Errors: ARGUMENT for a missing shader or array; nothing is written. */
BURNISH_API burnish_status burnish_kernels_shade_rgba8(const burnish_kernels *kernels,
                                                       const burnish_kernels_shader *shader,
                                                       const burnish_kernels_points *points,
                                                       size_t count, uint8_t *rgba,
                                                       burnish_error *error);

/* The same into linear floats, three arrays of count, not clamped above. */
BURNISH_API burnish_status burnish_kernels_shade_float(const burnish_kernels *kernels,
                                                       const burnish_kernels_shader *shader,
                                                       const burnish_kernels_points *points,
                                                       size_t count, float *const rgb[3],
                                                       burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
