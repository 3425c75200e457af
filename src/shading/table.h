/* The signatures that every tier implements, and the table of one tier. */
#ifndef BURNISH_SHADING_TABLE_H
#define BURNISH_SHADING_TABLE_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/kernels.h"
#include "core/srgb.h"
#include "shading/lobe_constants.h"

/* Marks what burnish_kernels_prepare made. */
#define BURNISH_SHADER_COOKIE 0x73686472u

/* out[i] = lobe(in[i]); out may be in. */
typedef void burnish_lobe_function(const burnish_kernels_lobe_constants *lobe, size_t count,
                                   const float *in, float *out);

/* out = in scaled to unit length; out may be in. */
typedef void burnish_normalize_function(size_t count, const float *const in[3],
                                        float *const out[3]);

/* The lighting of count points, as burnish/kernels.h says. Exactly one of rgba and rgb is written.
 */
typedef void burnish_shade_function(const burnish_kernels_shader *shader,
                                    const burnish_kernels_points *points, size_t count,
                                    uint8_t *rgba, float *const rgb[3]);

/* How a pixel's place becomes a place in space. A visible point lies, from the eye, at
 *   (ray + x ray_x + y ray_y + (1 - depth) ray_depth) / q,   x, y in pixels from the centre,
 *   q = depth * q_per_depth + q_constant (1/w in perspective, 1 in parallel projection). */
typedef struct burnish_rays {
    float ray[3], ray_x[3], ray_y[3], ray_depth[3];
    float q_per_depth, q_constant;
} burnish_rays;

/* Places from the eye, times w, and w of `count` pixels, a multiple of 16: in blocks of 4 x 4 side
 * by side, a block's pixels row by row. The centre of the first one is at (x, y). */
typedef void burnish_locate_function(const burnish_rays *rays, float x, float y, size_t count,
                                     const float *depths, float *const position[3], float *w);

/* count linear colours, a multiple of 16, to sRGB codes: red in the lowest byte of a pixel, then
 * green and blue. With `shown`, pixels where it is >= 0 also get the bits of alpha, and the others
 * are `behind`. */
typedef void burnish_encode_function(const burnish_srgb_encoder *encoder, size_t count,
                                     const float *const rgb[3], const int32_t *shown,
                                     uint32_t alpha, uint32_t behind, uint32_t *pixels);

/* count groups of four pixels, each group `apart` pixels after the last, to 12 bytes a group, which
 * follow one another: red, green, blue. The highest byte of a pixel must be 0. Up to four bytes
 * after the last may be written. */
typedef void burnish_pack_function(size_t count, const uint32_t *pixels, size_t apart, uint8_t *to);

enum { BURNISH_LOBE_INPUT_COSINE, BURNISH_LOBE_INPUT_LAMBDA, BURNISH_LOBE_INPUT_COUNT };

/* DISTANT: every light directional, the viewer distant and Blinn's cosine: the half vectors are
 * constant. GENERAL: anything. */
enum { BURNISH_SHADE_DISTANT, BURNISH_SHADE_GENERAL, BURNISH_SHADE_GEOMETRY_COUNT };

enum { BURNISH_SHADE_RGBA8, BURNISH_SHADE_FLOAT, BURNISH_SHADE_OUTPUT_COUNT };

struct burnish_kernels {
    burnish_isa isa;
    burnish_lobe_function *lobe[BURNISH_LOBE_BODY_COUNT][BURNISH_LOBE_INPUT_COUNT];
    burnish_normalize_function *normalize;
    burnish_locate_function *locate;
    burnish_encode_function *encode;
    burnish_pack_function *pack;
    burnish_shade_function
        *shade[BURNISH_LOBE_BODY_COUNT][BURNISH_SHADE_GEOMETRY_COUNT][BURNISH_SHADE_OUTPUT_COUNT];
};

/* The tables; those of other processors are not in the build. */
extern const struct burnish_kernels burnish_kernels_scalar;
#if defined(__SSE2__)
extern const struct burnish_kernels burnish_kernels_sse2;
extern const struct burnish_kernels burnish_kernels_avx2;
extern const struct burnish_kernels burnish_kernels_avx512;
#endif
#if defined(__aarch64__)
extern const struct burnish_kernels burnish_kernels_neon;
#endif
#if defined(__wasm_simd128__)
extern const struct burnish_kernels burnish_kernels_wasm;
#endif

#endif
