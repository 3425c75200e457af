/* burnish/shading.h: what the Phong illumination equation is given: lobe, material, light, specular
 * model. kernels.h and render.h draw with these; theory.h measures the same lobes.
 *
 * How to name a lobe.
 *   1. In words, which programs and pictures share:
 *          burnish_lobe_spec lobe;
 *          status = burnish_lobe_spec_parse("minimax:4", &lobe, &error);
 *      or in parts: burnish_lobe_spec lobe = {.fit = BURNISH_FIT_MINIMAX, .order = 4};
 *   2. Hand it on (render options, lighting), where each material brings its exponent; or ask for
 *      its slope: burnish_lobe_solve.
 *
 * A spec of zeros is refused, since no lobe has order 0. No function allocates or keeps state; all
 * may be called from any thread. Results do not depend on the locale.
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
    BURNISH_LOBE_FAMILY,        /* scale max(0, 1 - zeta (1 - c))^m, slope and scale by a fit */
    BURNISH_LOBE_POWER,         /* c^n: the reference */
    BURNISH_LOBE_INTEGER_POWER, /* c^n of a whole n by multiplications; kernels.h only, no word */
    BURNISH_LOBE_SCHLICK,       /* c / (n - n c + c) */
    BURNISH_LOBE_LYON,          /* taylor from the chord of vectors of nearly unit length */
    BURNISH_LOBE_GAUSSIAN,      /* exp(-(n + .775) (1 - c)) */
    BURNISH_LOBE_GX,            /* c^2 / (n/2 + (1 - n/2) c^2) */
    BURNISH_LOBE_NV2X,          /* max(0, c + k0) / (k2 + k1 c); theory.h only, as are the next */
    BURNISH_LOBE_KUIJK_BLAKE,   /* quadratic in the angle, in two pieces */
    BURNISH_LOBE_TABLE,         /* the power at c = i / (entries - 1), nearest or linear */
    BURNISH_LOBE_KIND_COUNT
} burnish_lobe_kind;

/* The largest table. */
#define BURNISH_LOBE_ENTRIES_MAX 65536

/* Which lobe. The exponent is not part of it: each material has its own. */
typedef struct burnish_lobe_spec {
    burnish_lobe_kind kind;
    burnish_lobe_fit fit; /* FAMILY */
    int order;            /* FAMILY, LYON: m = 2, 4, 8, 16 or 32 */
    double parameter;     /* FAMILY with fit LEVEL: Q in (0, 1); with fit GIVEN: zeta in
                             (0, 65536] */
    int entries;          /* TABLE: number of entries, [2, BURNISH_LOBE_ENTRIES_MAX] */
    int linear;           /* TABLE: 1: linear interpolation; 0: the nearest entry */
} burnish_lobe_spec;

/* Reads a lobe's words: FIT[:ORDER] (order 2 where left out) with FIT taylor, energy, levelQ,
 * shift7, shift3, projected, minimax, leastsquares, affine or zetaZ (Q, Z decimal numbers of at
 * most 15 digits, leading zeros not counted, and 20 decimals); lyon[:ORDER]; power, schlick,
 * gaussian, gx. text   the words, zero-terminated; not NULL lobe   becomes the lobe, as it was on
 * error; not NULL error  receives the one line of an error; may be NULL Errors: ARGUMENT with the
 * list of words; also for the lobes that only theory.h knows. */
BURNISH_API burnish_status burnish_lobe_spec_parse(const char *text, burnish_lobe_spec *lobe,
                                                   burnish_error *error);

/* burnish_lobe_spec_parse, which also accepts the lobes that only theory.h evaluates. */
BURNISH_API burnish_status burnish_lobe_spec_parse_any(const char *text, burnish_lobe_spec *lobe,
                                                       burnish_error *error);

/* Writes the words that burnish_lobe_spec_parse (for the lobes of theory.h:
 * burnish_lobe_spec_parse_any) reads back as the same lobe, the parameter to 15 digits; "unknown"
 * for a lobe without words.
 *   lobe  not NULL
 *   text  receives the words, cut to size
 *   size  bytes; BURNISH_LOBE_NAME_SIZE is enough */
#define BURNISH_LOBE_NAME_SIZE 32
BURNISH_API void burnish_lobe_spec_name(const burnish_lobe_spec *lobe, char *text, size_t size);

/* Whether pictures and kernels can draw a lobe: its kind, fit, order and parameter. What its
 * exponent allows is burnish_lobe_solve's.
 *   lobe   not NULL
 *   error  receives the one line of an error; may be NULL
 * Errors: ARGUMENT. */
BURNISH_API burnish_status burnish_lobe_spec_check(const burnish_lobe_spec *lobe,
                                                   burnish_error *error);

/* The slope zeta and the scale (value at the peak) of a lobe max(0, 1 - zeta (1 - c))^m scale.
 *   taylor        n / m
 *   energy        (n + 1) / (m + 1)
 *   level         (1 - Q^(1/m)) / (1 - Q^(1/n))
 *   shift7        7n / 16, m = 2
 *   shift3        3n / 8, m = 2
 *   projected     the root >= 1 of (m+1)(m+2) zeta^2 - (m+2)(n+2) zeta + (n+2) = 0
 *   minimax       zeta where the largest error above the power equals the largest one below it.
 *                 Above falls and below rises with zeta, so there is one such place
 *   leastsquares  zeta with the least integral of (lobe - power)^2 over c in [0, 1]
 *   affine        u = max(0, A c + B), scale = (A + B)^m, zeta = A / (A + B): least maximum error
 *                 over both. Costs what the others cost and lowers the error by a sixth (for large
 *                 n to .0578 from minimax's .0699 at m = 2, to .0281 from .0332 at m = 4), for a
 *                 peak that is lower by that error
 *   given         the spec's parameter, whatever the exponent
 * scale is 1 but for affine. LYON has taylor's slope.
 * Guarantees: plain IEEE operations in a fixed order, no libm: the same bits on every machine. zeta
 * within 2e-15 relative, for level with Q in [1e-300, 1 - 1e-9] too; minimax, leastsquares and
 * affine within 1e-9 of the optimum, scale too.
 *
 *   lobe      FAMILY or LYON; not NULL
 *   exponent  n: [1, 65536]. From order 4 on at least the order; PROJECTED and AFFINE: at order 2
 *             too; GIVEN: any
 *   zeta      receives the slope, 0 on error; not NULL
 *   scale     receives the value at the peak, 0 on error; not NULL
 * Errors: ERROR_FIT (another kind, too), ERROR_ORDER, ERROR_EXPONENT, ERROR_ORDER_FOR_EXPONENT,
 * ERROR_LEVEL, ERROR_ZETA; NaN is an error everywhere.
 * Source: minimax by Beaudoin and Guardado 2002, whose tables it reproduces. */
BURNISH_API burnish_lobe_status burnish_lobe_solve(const burnish_lobe_spec *lobe, double exponent,
                                                   double *zeta, double *scale);

/* One lobe of each sort, as words, for lists and help: "taylor:2", ...; NULL from the end on. Those
 * that only theory.h knows come last. */
BURNISH_API const char *burnish_lobe_spec_example(size_t index);

/* ---- Textures ---- */

/* What a texture of a material says of a point. COLOR, SPECULAR and EMISSIVE are colours (sRGB),
 * the others numbers. */
typedef enum burnish_texture_slot {
    BURNISH_TEXTURE_COLOR,              /* rgb times ambient and diffuse, or times the base colour;
                                           alpha: alpha_mode */
    BURNISH_TEXTURE_SPECULAR,           /* rgb times specular */
    BURNISH_TEXTURE_EXPONENT,           /* r times the exponent */
    BURNISH_TEXTURE_METALLIC_ROUGHNESS, /* g times roughness, b times metallic */
    BURNISH_TEXTURE_NORMAL,             /* tangent space, green up: 2 rgb - 1 */
    BURNISH_TEXTURE_EMISSIVE,           /* rgb times emissive */
    BURNISH_TEXTURE_OCCLUSION,          /* r: what of the ambient light arrives */
    BURNISH_TEXTURE_OPACITY,            /* r times the opacity */
    BURNISH_TEXTURE_SLOT_COUNT
} burnish_texture_slot;

/* What lies beyond the image of a texture. */
typedef enum burnish_texture_wrap {
    BURNISH_WRAP_REPEAT,
    BURNISH_WRAP_CLAMP,
    BURNISH_WRAP_MIRROR
} burnish_texture_wrap;

/* A texture as a material uses it. All 0: none. */
typedef struct burnish_texture_use {
    int texture;        /* 1 + number of the texture in the mesh; 0: none */
    int wrap[2];        /* burnish_texture_wrap of u and v */
    int is_nearest;     /* 1: the nearest texel, for pixel art; 0: filtered */
    int has_transform;  /* 1: u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5 */
    float transform[6]; /* finite */
    float strength;     /* NORMAL: factor of x and y, 1 as the image says; OCCLUSION: 0 none, 1 as
                           the image says. Not read elsewhere */
} burnish_texture_use;

/* What a texture's alpha and a material's opacity do. */
typedef enum burnish_alpha_mode {
    BURNISH_ALPHA_IGNORE, /* the alpha of textures means nothing */
    BURNISH_ALPHA_MASK,   /* opaque where the opacity is at least alpha_cutoff, nothing elsewhere */
    BURNISH_ALPHA_BLEND   /* it multiplies the opacity */
} burnish_alpha_mode;

/* ---- Materials ---- */

/* Coefficients of the Phong equation. Colours are linear light, [0, 1] in a mesh, [0, 1e6] in
 * kernels.h, which reads nothing below the exponent. What all 0 says from has_diffuse on is a plain
 * opaque material. */
typedef struct burnish_material {
    float ambient[3];   /* ka: reflects the ambient light */
    float diffuse[3];   /* kd: times max(0, N.L) */
    float specular[3];  /* ks: times the specular lobe; all 0: no lobe is computed */
    float exponent;     /* n of the specular lobe, [1, 65536] */
    int has_diffuse;    /* 1: vertex colours multiply ambient and diffuse; 0: they take their place
                         */
    float transparency; /* 1 - opacity, [0, 1]: 0 is opaque */

    float emissive[3]; /* light of its own */
    int is_unlit;      /* 1: the colour is drawn as it is, whatever the lights are */

    /* 1: the material is a base colour (in diffuse; ambient and specular and the exponent are not
     * read), metallic, roughness and reflectance, as in glTF:
     *   kd = base (1 - metallic), ka = base, ks = reflectance (1 - metallic) + base metallic,
     *   n = 2 / roughness^4 - 2, at least 1, and ks times (n + 2) / 8, at most 1: so a wide lobe
     *   reflects as much as a narrow one, up to there */
    int is_metallic;
    float metallic, roughness; /* [0, 1] */
    float reflectance[3];      /* at normal incidence of what is no metal: 0.04 for an index of
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

/* One light; point lights do not fall off with distance. */
typedef struct burnish_light {
    burnish_light_kind kind;
    int follows_camera; /* 1: vector is in camera space (x right, y up, z toward the viewer; a point
                           light's unit is the distance from camera to focal point). kernels.h has
                           no camera and refuses it */
    double vector[3];   /* DIRECTIONAL: toward the light, any length > 0 (kernels.h: 1); POINT: its
                           position */
    float color[3];     /* linear, [0, 1e6] */
} burnish_light;

/* At most this many lights. */
#define BURNISH_LIGHT_MAX 64

/* Which cosine the lobe gets. With N, L, V the unit vectors of normal, light and viewer:
 * BLINN: N.H, H = (L + V) / |L + V|; PHONG: R.V, R = 2 (N.L) N - L. */
typedef enum burnish_specular_model {
    BURNISH_SPECULAR_BLINN,
    BURNISH_SPECULAR_PHONG
} burnish_specular_model;

#ifdef __cplusplus
}
#endif

#endif
