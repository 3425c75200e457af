/* burnish/shading.h: the inputs of the Phong illumination equation: lobes, materials, lights and
 * specular models. kernels.h and render.h draw with them; theory.h analyses the lobes.
 *
 * How to name a lobe.
 *   1. By its words:
 *          burnish_lobe_spec lobe;
 *          status = burnish_lobe_spec_parse("minimax:4", &lobe, &error);
 *      or by its members: burnish_lobe_spec lobe = {.fit = BURNISH_FIT_MINIMAX, .order = 4};
 *   2. Use it in render options or a lighting, where each material has its exponent, or call
 *      burnish_lobe_solve() for its slope.
 *
 * A spec of zeros is refused, since no lobe has order 0. No function allocates or keeps state, and
 * all may be called from any thread. Results do not depend on the locale.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_SHADING_H
#define BURNISH_SHADING_H

#include <stddef.h>

#include "burnish/core.h"
#include "burnish/lobe.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Lobes ---- */

/* The specular lobes, as functions of a cosine c and an exponent n. */
typedef enum burnish_lobe_kind {
    BURNISH_LOBE_FAMILY,        /* scale max(0, 1 - zeta (1 - c))^m; a fit sets zeta and scale */
    BURNISH_LOBE_POWER,         /* c^n: the reference */
    BURNISH_LOBE_INTEGER_POWER, /* c^n for an integer n; kernels.h only, no word */
    BURNISH_LOBE_SCHLICK,       /* c / (n - n c + c) */
    BURNISH_LOBE_LYON,          /* taylor, from the chord of two nearly unit vectors */
    BURNISH_LOBE_GAUSSIAN,      /* exp(-(n + 0.775) (1 - c)) */
    BURNISH_LOBE_GX,            /* c^2 / (n/2 + (1 - n/2) c^2) */
    BURNISH_LOBE_NV2X,          /* max(0, c + k0) / (k2 + k1 c); theory.h only, like the next two */
    BURNISH_LOBE_KUIJK_BLAKE,   /* quadratic in the angle, in two pieces */
    BURNISH_LOBE_TABLE,         /* c^n at c = i / (entries - 1), nearest or linear */
    BURNISH_LOBE_KIND_COUNT
} burnish_lobe_kind;

/* The largest table. */
#define BURNISH_LOBE_ENTRIES_MAX 65536

/* A lobe without its exponent, which each material sets. */
typedef struct burnish_lobe_spec {
    burnish_lobe_kind kind;
    burnish_lobe_fit fit; /* FAMILY */
    int order;            /* FAMILY, LYON: m = 2, 4, 8, 16 or 32 */
    double parameter;     /* FAMILY with fit LEVEL: Q in (0, 1); with fit GIVEN: zeta in
                             (0, 65536] */
    int entries;          /* TABLE: number of entries, [2, BURNISH_LOBE_ENTRIES_MAX] */
    int linear;           /* TABLE: 1: linear interpolation; 0: the nearest entry */
} burnish_lobe_spec;

/* Parses the words of a lobe:
 *   FIT[:ORDER]   with FIT taylor, energy, levelQ, shift7, shift3, projected, minimax,
 *                 leastsquares, affine or zetaZ, and order 2 by default. Q and Z are decimal
 *                 numbers with at most 15 digits, without leading zeros, and 20 decimals
 *   lyon[:ORDER]
 *   power, schlick, gaussian, gx
 * Parameters:
 *   text   the words, zero-terminated; not NULL
 *   lobe   receives the lobe, unchanged on error; not NULL
 *   error  receives the message; may be NULL
 * Errors: ARGUMENT, with the list of words; also for lobes that only theory.h evaluates. */
BURNISH_API burnish_status burnish_lobe_spec_parse(const char *text, burnish_lobe_spec *lobe,
                                                   burnish_error *error);

/* burnish_lobe_spec_parse() that also accepts the lobes that only theory.h evaluates. */
BURNISH_API burnish_status burnish_lobe_spec_parse_any(const char *text, burnish_lobe_spec *lobe,
                                                       burnish_error *error);

/* Writes the words that burnish_lobe_spec_parse_any() parses to the same lobe, with 15 digits of
 * the parameter; "unknown" for a lobe without words.
 *   lobe  not NULL
 *   text  receives the words, truncated to size
 *   size  of text in bytes; BURNISH_LOBE_NAME_SIZE is enough */
#define BURNISH_LOBE_NAME_SIZE 32
BURNISH_API void burnish_lobe_spec_name(const burnish_lobe_spec *lobe, char *text, size_t size);

/* Checks whether render.h and kernels.h can draw a lobe: its kind, fit, order and parameter.
 * burnish_lobe_solve() checks the exponent.
 *   lobe   not NULL
 *   error  receives the message; may be NULL
 * Errors: ARGUMENT. */
BURNISH_API burnish_status burnish_lobe_spec_check(const burnish_lobe_spec *lobe,
                                                   burnish_error *error);

/* Computes the slope zeta and the scale (value at the peak) of a lobe
 * scale max(0, 1 - zeta (1 - c))^m.
 *   taylor        n / m
 *   energy        (n + 1) / (m + 1)
 *   level         (1 - Q^(1/m)) / (1 - Q^(1/n))
 *   shift7        7n / 16, m = 2
 *   shift3        3n / 8, m = 2
 *   projected     the root >= 1 of (m+1)(m+2) zeta^2 - (m+2)(n+2) zeta + (n+2) = 0
 *   minimax       the zeta for which the largest errors above and below cos^n are equal. The error
 *                 above falls with zeta and the error below rises, so the solution is unique
 *   leastsquares  the zeta with the least integral of (lobe - c^n)^2 over c in [0, 1]
 *   affine        u = max(0, A c + B), scale = (A + B)^m, zeta = A / (A + B), with the least
 *                 maximum error over A and B. It costs no more than the others. For large n the
 *                 error falls from 0.0699 (minimax) to 0.0578 at m = 2, and from 0.0332 to 0.0281
 *                 at m = 4; the peak is lower by that error
 *   given         the parameter of the spec, for every exponent
 * scale is 1 for all fits but affine. LYON has the slope of taylor.
 *
 * Guarantees: IEEE operations in a fixed order without libm, so the bits are the same on every
 * machine. The relative error of zeta is below 2e-15, for level with Q in [1e-300, 1 - 1e-9];
 * minimax, leastsquares and affine are within 1e-9 of the optimum.
 *
 *   lobe      FAMILY or LYON; not NULL
 *   exponent  n in [1, 65536]; at least the order for orders of 4 and more, and for PROJECTED and
 *             AFFINE at order 2; any for GIVEN
 *   zeta      receives the slope, 0 on error; not NULL
 *   scale     receives the value at the peak, 0 on error; not NULL
 * Errors: ERROR_FIT (or another kind), ERROR_ORDER, ERROR_EXPONENT, ERROR_ORDER_FOR_EXPONENT,
 * ERROR_LEVEL, ERROR_ZETA. NaN is an error.
 * Source: minimax by Beaudoin and Guardado 2002, whose tables it reproduces. */
BURNISH_API burnish_lobe_status burnish_lobe_solve(const burnish_lobe_spec *lobe, double exponent,
                                                   double *zeta, double *scale);

/* The words of one lobe of each kind and fit, such as "taylor:2", for lists and help; NULL after
 * the last. Lobes that only theory.h evaluates come last. */
BURNISH_API const char *burnish_lobe_spec_example(size_t index);

/* ---- Textures ---- */

/* The uses of a texture. COLOR, SPECULAR and EMISSIVE contain colours (sRGB), the others
 * numbers. */
typedef enum burnish_texture_slot {
    BURNISH_TEXTURE_COLOR,              /* multiplies ambient and diffuse, or the base colour; for
                                           alpha see alpha_mode */
    BURNISH_TEXTURE_SPECULAR,           /* rgb multiplies specular */
    BURNISH_TEXTURE_EXPONENT,           /* r multiplies the exponent */
    BURNISH_TEXTURE_METALLIC_ROUGHNESS, /* g multiplies roughness, b metallic */
    BURNISH_TEXTURE_NORMAL,             /* tangent space, green up: 2 rgb - 1 */
    BURNISH_TEXTURE_EMISSIVE,           /* rgb multiplies emissive */
    BURNISH_TEXTURE_OCCLUSION,          /* r multiplies the ambient light */
    BURNISH_TEXTURE_OPACITY,            /* r multiplies the opacity */
    BURNISH_TEXTURE_SLOT_COUNT
} burnish_texture_slot;

/* How a texture continues beyond its image. */
typedef enum burnish_texture_wrap {
    BURNISH_WRAP_REPEAT,
    BURNISH_WRAP_CLAMP,
    BURNISH_WRAP_MIRROR
} burnish_texture_wrap;

/* The use of a texture by a material. All 0: no texture. */
typedef struct burnish_texture_use {
    int texture;        /* 1 + number of the texture in the mesh; 0: no texture */
    int wrap[2];        /* burnish_texture_wrap of u and v */
    int is_nearest;     /* 1: the nearest texel, for pixel art; 0: filtered */
    int has_transform;  /* 1: u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5 */
    float transform[6]; /* finite */
    float strength;     /* NORMAL: factor of x and y; OCCLUSION: 0 none to 1 full. Not used for
                           the other slots */
} burnish_texture_use;

/* The effect of alpha in textures and of the opacity. */
typedef enum burnish_alpha_mode {
    BURNISH_ALPHA_IGNORE, /* the alpha of textures is ignored */
    BURNISH_ALPHA_MASK,   /* opaque if the opacity is at least alpha_cutoff, else invisible */
    BURNISH_ALPHA_BLEND   /* alpha multiplies the opacity */
} burnish_alpha_mode;

/* ---- Materials ---- */

/* A material: coefficients of the Phong equation or, with is_metallic 1, the metallic-roughness
 * parameters of glTF, from which these coefficients follow. Colours are linear light, [0, 1] in a
 * mesh, [0, 1e6] in kernels.h, which uses only the members up to exponent. If all members from
 * has_diffuse on are 0, the material is a plain opaque Phong material. */
typedef struct burnish_material {
    float ambient[3];   /* ka: factor of the ambient light */
    float diffuse[3];   /* kd: times max(0, N.L) */
    float specular[3];  /* ks: times the specular lobe; 0, 0, 0: no lobe */
    float exponent;     /* n of the specular lobe, [1, 65536] */
    int has_diffuse;    /* 1: vertex colours multiply ambient and diffuse; 0: they replace them */
    float transparency; /* 1 - opacity, [0, 1]: 0 is opaque */

    float emissive[3]; /* emitted light */
    int is_unlit;      /* 1: the colour is drawn without lighting */

    /* 0: a Phong material. The lights of light.h use metallic, roughness and reflectance if one of
     *    them is not 0, with the base colour `ambient`; otherwise they are not used.
     * 1: a metallic-roughness material; diffuse is the base colour, and ambient, specular and
     *    exponent are not used. With the base colour, these coefficients replace them:
     *      kd = base (1 - metallic), ka = base
     *      n  = 2 / roughness^4 - 2, at least 1
     *      ks = min(1, (reflectance (1 - metallic) + base metallic) (n + 2) / 8)
     *    The factor (n + 2) / 8 lets a wide lobe reflect as much as a narrow lobe. */
    int is_metallic;
    float metallic, roughness; /* [0, 1] */
    float reflectance[3];      /* of a dielectric at normal incidence: 0.04 for an index of
                                  refraction of 1.5 */

    burnish_alpha_mode alpha_mode;
    float alpha_cutoff; /* MASK: [0, 1] */
    burnish_texture_use textures[BURNISH_TEXTURE_SLOT_COUNT];
} burnish_material;

/* ---- Lights ---- */

typedef enum burnish_light_kind {
    BURNISH_LIGHT_DIRECTIONAL,
    BURNISH_LIGHT_POINT
} burnish_light_kind;

/* A light. Point lights do not fall off with distance. */
typedef struct burnish_light {
    burnish_light_kind kind;
    int follows_camera; /* 1: vector is in camera space: x right, y up, z toward the viewer; the
                           unit for point lights is the distance from camera to focal point. Not
                           for kernels.h, which has no camera */
    double vector[3];   /* DIRECTIONAL: toward the light, of any length > 0 (kernels.h: 1); POINT:
                           its position */
    float color[3];     /* linear, [0, 1e6] */
} burnish_light;

/* The most lights. */
#define BURNISH_LIGHT_MAX 64

/* The cosine that the lobe uses. With unit vectors N (normal), L (light) and V (viewer):
 * BLINN: N.H, H = (L + V) / |L + V|; PHONG: R.V, R = 2 (N.L) N - L. */
typedef enum burnish_specular_model {
    BURNISH_SPECULAR_BLINN,
    BURNISH_SPECULAR_PHONG
} burnish_specular_model;

#ifdef __cplusplus
}
#endif

#endif
