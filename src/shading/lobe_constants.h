/* A lobe with everything worked out that does not depend on the point, and the forms that the
 * kernels come in. */
#ifndef BURNISH_SHADING_LOBE_CONSTANTS_H
#define BURNISH_SHADING_LOBE_CONSTANTS_H

#include <stdint.h>

#include "burnish/kernels.h"

/* The bodies that lobes are evaluated by. */
typedef enum burnish_lobe_body {
    BURNISH_LOBE_BODY_NONE,     /* 0 */
    BURNISH_LOBE_BODY_SQUARE,   /* the family, m = 2 */
    BURNISH_LOBE_BODY_SQUARES,  /* the family, m = 4 .. 32 */
    BURNISH_LOBE_BODY_POWER,    /* any exponent, by polynomials */
    BURNISH_LOBE_BODY_MULTIPLY, /* whole exponents, by multiplications */
    BURNISH_LOBE_BODY_SCHLICK,
    BURNISH_LOBE_BODY_GAUSSIAN,
    BURNISH_LOBE_BODY_GX,
    BURNISH_LOBE_BODY_COUNT
} burnish_lobe_body;

enum { BURNISH_LOBE_INPUT_COSINE, BURNISH_LOBE_INPUT_LAMBDA, BURNISH_LOBE_INPUT_COUNT };

/* DISTANT: every light directional, the viewer distant and Blinn's cosine: the half vectors are
 * constant. GENERAL: anything. */
enum { BURNISH_SHADE_DISTANT, BURNISH_SHADE_GENERAL, BURNISH_SHADE_GEOMETRY_COUNT };

enum { BURNISH_SHADE_RGBA8, BURNISH_SHADE_FLOAT, BURNISH_SHADE_OUTPUT_COUNT };

/* Marks what burnish_kernels_prepare made. */
#define BURNISH_SHADER_COOKIE 0x73686472u

/* Fills *constants, and *scale with the value at the peak. Returns OK or ARGUMENT, with a line. */
burnish_status burnish_lobe_constants_make(const burnish_lobe_spec *lobe, float exponent,
                                           burnish_kernels_lobe_constants *constants, float *scale,
                                           burnish_error *error);

#endif
