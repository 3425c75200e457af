/* burnish/lobe.h: a family of specular lobes that needs no pow, no division and no libm.
 *
 * What it is. A specular highlight of the Phong and Blinn models is cos(angle)^n. This header
 * replaces it with
 *
 *     S(c) = u^m,   u = min(1, max(0, 1 - zeta (1 - c))),   m = 2, 4, 8, 16 or 32,
 *
 * where c is the cosine of the lobe angle (R.V for Phong, N.H for Blinn). The order m costs log2(m)
 * squarings and sets the quality; zeta follows from the exponent n by a fit, which sets the shape.
 * The lobe is 1 at c = 1 and 0 below the cutoff cosine 1 - 1/zeta. Rounding of 1 - c can leave up
 * to 4e-15 within 3e-8 below it if zeta < 2; from lambda = 1 - c it is exactly 0.
 *
 * How to use it.
 *   1. Copy this file; it includes nothing. Compile with -ffp-contract=off if exact bits matter.
 *   2. Once per material (a status other than BURNISH_LOBE_OK leaves a lobe that is 0 everywhere):
 *          burnish_lobe lobe;
 *          status = burnish_lobe_create(&lobe, BURNISH_FIT_ENERGY, 2, shininess);
 *   3. Once per light and pixel with N.L > 0:
 *          specular = burnish_lobe_at_cosine(lobe, n_dot_h);
 *      or, for large exponents, from the vectors themselves, which keep more bits than a cosine:
 *          specular = burnish_lobe_at_lambda(lobe, burnish_lobe_chord(n, h));
 *
 * What it does not do. It does not normalise vectors (Lyon's lobe below does), reflect, test N.L or
 * compute lighting. Fits that need roots or a search (level, projected, minimax, leastsquares,
 * affine) are in burnish/shading.h. Reference lobes that need libm are in burnish/theory.h.
 *
 * Schlick's (1 - c)^5 for Fresnel needs no pow either: u = 1 - c, u2 = u * u, u2 * u2 * u.
 *
 * What it promises.
 * - Every evaluation returns a finite value in [0, 1] for every float: NaN gives 0,
 *   infinities and denormals are fine. (Not under -ffast-math, which forbids NaN and infinity.)
 * - Results are defined operation by operation in IEEE single precision, in the order written; the
 *   set-up of a lobe uses double. With -ffp-contract=off the bits are the same everywhere.
 * - The family's and the composite lobes never decrease as c grows, not even by a rounding error.
 *
 * Accuracy at every float cosine in [-1, 1], compared with the formula in exact arithmetic with the
 * lobe's own zeta or exponent. Absolute errors are in units of 2^-24. Relative errors are in units
 * in the last place of the exact value, for values of at least 2^-10. Each entry is a bound,
 * followed in parentheses by the largest error found in 240 million random cases (composites: 18
 * million). The tests fail if an error exceeds its bound (test/sweep.h).
 *
 *     lobe     order  exponents    absolute      relative
 *     family       2  [1, 65536]   2.25  (1.98)  70   (64.2)
 *     family       4  [4, 65536]   4     (3.49)  30   (25.9)
 *     family       8  [8, 65536]   8     (7.27)  24   (20.9)
 *     family      16  [16, 65536]  16    (14.5)  32   (27.0)
 *     family      32  [32, 65536]  32    (28.7)  50   (43.7)
 *     composite:2     [1, 65536]   2.25  (1.62)  70   (63.0)
 *     composite:3     [1, 65536]   4.75  (4.25)  65   (54.4)
 *     composite:4     [1, 65536]   9.75  (8.73)  65   (56.4)
 *     composite:5     [1, 65536]   20    (17.7)  65   (54.6)
 *     composite:6     [1, 65536]   35    (31.4)  65   (57.6)
 *     schlick         [1, 65536]   1.75  (1.50)  4    (3.31)
 *     gx              [1, 65536]   2     (1.74)  5.5  (4.32)
 *
 * Rounding a fit's zeta to float moves the lobe by at most another half unit of 2^-24, since
 * m zeta lambda u^(m-1) never exceeds 1/2. test_lobe prints and asserts the resulting errors
 * of every fit and order over 4,000 reference values.
 *
 * Sources. Order 2 and its fits W, W1 and W_Q: a paper that approximates BRDFs by cosine-quadratic
 * functions. Its references date it after 2005; no bibliographic record of it was found.
 * Phong, Illumination for Computer Generated Pictures, CACM 1975; Blinn, Models of Light
 * Reflection, SIGGRAPH 1977. The form of the lobe is not new. Lyon, Phong Shading Reformulation for
 * Hardware Renderer Simplification, Apple TR 43, 1993: general m, chord form, zeta = n/m. Beaudoin
 * and Guardado, A Non-Integer Power Function on the Pixel Shader, 2002: fitted constants. Doom 3
 * shipped zeta = 4, m = 2; Unreal's mobile shader zeta = 6.645, m = 2. Schlick, A Fast Alternative
 * to Phong's Specular Model, Graphics Gems IV, 1994.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_LOBE_H
#define BURNISH_LOBE_H

#ifdef __cplusplus
extern "C" {
#endif

/* The exponents (shininess) for which lobes exist, and the largest zeta. */
#define BURNISH_LOBE_EXPONENT_MIN 1.0f
#define BURNISH_LOBE_EXPONENT_MAX 65536.0f
#define BURNISH_LOBE_ZETA_MAX 65536.0f

/* Why a lobe was not made: X(name, text). OK is 0. */
#define BURNISH_LOBE_STATUS_LIST(X)                                                                \
    X(OK, "success")                                                                               \
    X(ERROR_EXPONENT, "the exponent must be a number from 1 to 65536")                             \
    X(ERROR_ORDER, "the order must be 2, 4, 8, 16 or 32; shift7 and shift3 have order 2 only")     \
    X(ERROR_ORDER_FOR_EXPONENT, "the order is above the exponent: try a lower order")              \
    X(ERROR_FIT, "the fit is not one of enum burnish_lobe_fit")                                    \
    X(ERROR_FIT_NEEDS_SOLVE, "only taylor, energy, shift7 and shift3: take burnish_lobe_solve")    \
    X(ERROR_ZETA, "zeta must be a number above 0 and at most 65536")                               \
    X(ERROR_LEVEL, "the level must be a number between 0 and 1, both excluded")                    \
    X(ERROR_COMPOSITE, "composite has 2 to 6 multiplications, display has 5 or 6")

typedef enum burnish_lobe_status {
#define BURNISH_LOBE_STATUS_ENUM(name, text) BURNISH_LOBE_##name,
    BURNISH_LOBE_STATUS_LIST(BURNISH_LOBE_STATUS_ENUM)
#undef BURNISH_LOBE_STATUS_ENUM
        BURNISH_LOBE_STATUS_COUNT
} burnish_lobe_status;

/* The meaning of a status, in one line; "unknown status" for a value outside the list. */
static inline const char *burnish_lobe_status_text(burnish_lobe_status status) {
    switch (status) {
#define BURNISH_LOBE_STATUS_CASE(name, text)                                                       \
    case BURNISH_LOBE_##name:                                                                      \
        return text;
        BURNISH_LOBE_STATUS_LIST(BURNISH_LOBE_STATUS_CASE)
#undef BURNISH_LOBE_STATUS_CASE
    case BURNISH_LOBE_STATUS_COUNT:
        break;
    }
    return "unknown status";
}

/* How zeta follows from the exponent n and the order m. "Paper" is the work that burnish
 * implements; it has order 2 only. */
typedef enum burnish_lobe_fit {
    BURNISH_FIT_TAYLOR,    /* n/m: the same curvature at the peak; never above cos^n (paper's W) */
    BURNISH_FIT_ENERGY,    /* (n+1)/(m+1): the same integral over solid angle (paper's W1) */
    BURNISH_FIT_LEVEL,     /* meets cos^n at the value Q (paper's W_Q) */
    BURNISH_FIT_SHIFT7,    /* 7n/16, m = 2: integers (paper's W_0.5; its Q tends to 0.58) */
    BURNISH_FIT_SHIFT3,    /* 3n/8, m = 2: as cheap, lower largest absolute error for n >= 6 */
    BURNISH_FIT_PROJECTED, /* the same cosine-weighted integral */
    BURNISH_FIT_MINIMAX,   /* least maximum absolute error, c in [0, 1] */
    BURNISH_FIT_LEAST_SQUARES, /* least integral of the squared error over c */
    BURNISH_FIT_AFFINE, /* (A c + B)^m, A + B free: least maximum error; below 1 at the peak */
    BURNISH_FIT_GIVEN,  /* zeta as given: Doom 3's zeta4:2, Unreal's zeta6.645:2 */
    BURNISH_FIT_COUNT
} burnish_lobe_fit;

/* One lobe, passed by value. Make it with burnish_lobe_create or burnish_lobe_from_zeta and do not
 * change its members. If all are 0, it is the dark lobe, which is 0 everywhere, c = 1 included. */
typedef struct burnish_lobe {
    float zeta; /* slope of the base: (0, 65536], 0 in the dark lobe */
    int order;  /* 2, 4, 8, 16 or 32; 0 in the dark lobe */
} burnish_lobe;

/* 1 for the orders that exist. */
static inline int burnish_lobe_order_is_valid(int order) {
    return order == 2 || order == 4 || order == 8 || order == 16 || order == 32;
}

/* Checks whether an order and exponent have a lobe, whatever the fit. Order 2 is valid for every
 * exponent. A higher order needs exponent >= order: below that, zeta would be less than 1 and the
 * lobe above 0 at c = 0.
 * Returns OK, ERROR_ORDER, ERROR_EXPONENT or ERROR_ORDER_FOR_EXPONENT. */
static inline burnish_lobe_status burnish_lobe_check(int order, double exponent) {
    if (!burnish_lobe_order_is_valid(order)) {
        return BURNISH_LOBE_ERROR_ORDER;
    }
    if (!(exponent >= (double)BURNISH_LOBE_EXPONENT_MIN &&
          exponent <= (double)BURNISH_LOBE_EXPONENT_MAX)) {
        return BURNISH_LOBE_ERROR_EXPONENT;
    }
    return order > 2 && exponent < order ? BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT : BURNISH_LOBE_OK;
}

/* The highest order, at most the given one, that the exponent allows: the fallback after
 * ERROR_ORDER_FOR_EXPONENT.
 *   order     the requested order: 2, 4, 8, 16 or 32
 *   exponent  [1, 65536]
 * Returns an order, or 0 if an argument is out of range. */
static inline int burnish_lobe_highest_order(int order, float exponent) {
    burnish_lobe_status status = burnish_lobe_check(order, (double)exponent);
    while (status == BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT) {
        order /= 2;
        status = burnish_lobe_check(order, (double)exponent);
    }
    return status == BURNISH_LOBE_OK ? order : 0;
}

/* Makes the lobe with a given slope, for fits of your own. Minimax slopes for m = 2 by Beaudoin and
 * Guardado (2002): n = 4 1.683, 6 2.385, 10 3.802, 18 6.645; for large n about 0.7118 n/m. For
 * every n: burnish_lobe_solve of burnish/shading.h.
 *   lobe   becomes the lobe, on error the dark one; not NULL
 *   zeta   (0, 65536]
 *   order  2, 4, 8, 16 or 32
 * Errors: ERROR_ZETA (NaN and infinity included), ERROR_ORDER. */
static inline burnish_lobe_status burnish_lobe_from_zeta(burnish_lobe *lobe, float zeta,
                                                         int order) {
    lobe->zeta = 0.0f;
    lobe->order = 0;
    if (!burnish_lobe_order_is_valid(order)) {
        return BURNISH_LOBE_ERROR_ORDER;
    }
    if (!(zeta > 0.0f && zeta <= BURNISH_LOBE_ZETA_MAX)) {
        return BURNISH_LOBE_ERROR_ZETA;
    }
    lobe->zeta = zeta;
    lobe->order = order;
    return BURNISH_LOBE_OK;
}

/* Makes the lobe that approximates cos^exponent. zeta is the fit's formula evaluated in double
 * precision and rounded to float.
 *   lobe      becomes the lobe, on error the dark one; not NULL
 *   fit       TAYLOR, ENERGY, SHIFT7 or SHIFT3; for the others see burnish_lobe_solve
 *   order     2, 4, 8, 16 or 32; above 2 at most the exponent; SHIFT7 and SHIFT3: 2
 *   exponent  [1, 65536], not necessarily an integer
 * Errors: ERROR_FIT, ERROR_FIT_NEEDS_SOLVE, ERROR_ORDER, ERROR_EXPONENT (NaN included),
 * ERROR_ORDER_FOR_EXPONENT (burnish_lobe_highest_order finds the order to fall back to). */
static inline burnish_lobe_status burnish_lobe_create(burnish_lobe *lobe, burnish_lobe_fit fit,
                                                      int order, float exponent) {
    const double n = (double)exponent;
    const burnish_lobe_status status = burnish_lobe_check(order, n);
    const int is_shift = fit == BURNISH_FIT_SHIFT7 || fit == BURNISH_FIT_SHIFT3;
    double zeta;
    lobe->zeta = 0.0f;
    lobe->order = 0;
    if ((unsigned)fit >= BURNISH_FIT_COUNT) {
        return BURNISH_LOBE_ERROR_FIT;
    }
    if (!is_shift && fit != BURNISH_FIT_TAYLOR && fit != BURNISH_FIT_ENERGY) {
        return BURNISH_LOBE_ERROR_FIT_NEEDS_SOLVE;
    }
    if (is_shift && order != 2) {
        return BURNISH_LOBE_ERROR_ORDER;
    }
    if (status != BURNISH_LOBE_OK) {
        return status;
    }
    if (is_shift) {
        zeta = n * (fit == BURNISH_FIT_SHIFT7 ? 0.4375 : 0.375);
    } else {
        zeta = fit == BURNISH_FIT_ENERGY ? (n + 1.0) / (order + 1) : n / order;
    }
    return burnish_lobe_from_zeta(lobe, (float)zeta, order);
}

/* x clamped to [0, 1]; NaN gives 0. */
static inline float burnish_lobe_saturate(float x) {
    x = x > 0.0f ? x : 0.0f;
    return x < 1.0f ? x : 1.0f;
}

/* The lobe at lambda = 1 - cosine: (1 - zeta lambda)^order by squarings. Prefer this form for
 * large exponents: a float cosine near 1 has too few bits for 1 - cosine.
 *   lambda  any float; [-infinity, 0] gives 1, NaN gives 0
 * Returns a value in [0, 1]; 0 for the dark lobe. */
static inline float burnish_lobe_at_lambda(burnish_lobe lobe, float lambda) {
    float u = burnish_lobe_saturate(1.0f - lobe.zeta * lambda);
    u = u * u;
    u = lobe.order >= 4 ? u * u : u;
    u = lobe.order >= 8 ? u * u : u;
    u = lobe.order >= 16 ? u * u : u;
    u = lobe.order >= 32 ? u * u : u;
    return lobe.order >= 2 ? u : 0.0f;
}

/* The lobe at a cosine: burnish_lobe_at_lambda of 1 - cosine.
 *   cosine  any float; [1, infinity] gives 1, NaN gives 0
 * Returns a value in [0, 1]; 0 for the dark lobe. */
static inline float burnish_lobe_at_cosine(burnish_lobe lobe, float cosine) {
    return burnish_lobe_at_lambda(lobe, 1.0f - cosine);
}

/* lambda from two unit vectors: |a - b|^2 / 2, which is 1 - a.b without the cancellation near 1.
 *   a, b  three components each, of unit length; may be the same array
 * Returns a value >= 0, NaN if a component is NaN; burnish_lobe_at_lambda accepts both.
 * Source: Lyon 1993. */
static inline float burnish_lobe_chord(const float a[3], const float b[3]) {
    const float x = a[0] - b[0];
    const float y = a[1] - b[1];
    const float z = a[2] - b[2];
    return 0.5f * ((x * x + y * y) + z * z);
}

/* The cosine below which the lobe is 0: 1 - 1/zeta. It is rounded to float, so the lobe at this
 * cosine itself can be above 0 by a rounding error, and down to 3e-8 below it if zeta < 2.
 * Returns a value below -1 if the lobe never reaches 0 (zeta < 1/2); 1 for the dark lobe. */
static inline float burnish_lobe_cutoff_cosine(burnish_lobe lobe) {
    return lobe.order >= 2 ? 1.0f - 1.0f / lobe.zeta : 1.0f;
}

/* ---- Composite lobes ----------------------------------------------------------------------------
 *
 * More quality for the same multiplications: the base is squared once, then each multiplication is
 * a quadratic with a constant of its own in place of a squaring,
 *
 *     u = max(0, 1 - zeta lambda),  w = u^2,  then  w <- w (w + b) / (1 + b),  b >= 0.
 *
 * A step keeps 0, 1 and the order of values, so the lobe is 1 at the peak, 0 below its cutoff and
 * never decreases; b = 0 is a squaring. The divisions are folded into the constants.
 *
 * Largest absolute error against cos^n, for every n of the range:
 *
 *     multiplications   4 to 8   8 to 19.5   19.5 to 56   56 to 65536
 *     3                 .0137    .0236       .0274        .0301
 *     4                 .00086   .00064      .0032        .0053
 *     5                 .00086   .000034     .000071      .000147
 *     6                 .00086   .000034     .0000018     .0000021
 *
 * From 2 to 4 it is .0057, from 1 to 2 up to .25: take pow there, and plain products for n = 1 and
 * 3. For display, 5 multiplications give another 8-bit sRGB code at 9 % of the range at most, and
 * never one that differs by more than 1, for every n from 8 on.
 *
 * While n grows, lobes jump where it passes to other constants or an exact product: by at most
 * .0034 at n = 4, .00087 at 8 and .00033 above. */

/* The error that the constants make least. */
typedef enum burnish_composite_aim {
    BURNISH_COMPOSITE_MINIMAX, /* largest absolute difference from cos^n */
    BURNISH_COMPOSITE_DISPLAY, /* difference in 8-bit sRGB codes of a highlight of intensity 1 */
    BURNISH_COMPOSITE_AIM_COUNT
} burnish_composite_aim;

/* One lobe, passed by value; made by burnish_composite_create. All 0: the dark lobe. */
typedef struct burnish_composite {
    float top;           /* v at the peak */
    float slope;         /* v = top - slope lambda, in [0, top] */
    float offset[4];     /* after v <- v v: v <- v (v + offset); unused ones are 0 */
    int multiplications; /* 2 to 6; 0 in the dark lobe */
} burnish_composite;

/* Checks whether a lobe exists.
 * Returns OK, ERROR_COMPOSITE or ERROR_EXPONENT. */
static inline burnish_lobe_status burnish_composite_check(burnish_composite_aim aim,
                                                          int multiplications, double exponent) {
    const int least = aim == BURNISH_COMPOSITE_DISPLAY ? 5 : 2;
    if ((unsigned)aim >= BURNISH_COMPOSITE_AIM_COUNT || multiplications < least ||
        multiplications > 6) {
        return BURNISH_LOBE_ERROR_COMPOSITE;
    }
    return burnish_lobe_check(2, exponent);
}

/* The constants of exponents from `least` to that of the row above. Below the last of its rows, a
 * number of multiplications has no better lobe than fewer have. A row was fitted from the best
 * constants of single exponents by Levenberg's method, which lowered the p-norm of the error over
 * all exponents of the row for growing p; test_lobe measures the errors that are left. */
typedef struct burnish_composite_piece {
    struct {
        int multiplications;
        int aim;
        double least;
    } of;
    double constants[5][4]; /* of zeta/n and each 1/(1 + b): the coefficients of 1, x, x^2 and x^3
                               with x = least/n */
} burnish_composite_piece;

/* Finds the constants of a lobe.
 *   zeta  receives the slope, at least 1; not NULL
 *   b     receives the constants of the steps, the others are 0; not NULL
 * Returns the multiplications: the given ones or less, since steps that would change nothing are
 * left out. 0 and constants of 0 for arguments that burnish_composite_check refuses. */
static inline int burnish_composite_constants(burnish_composite_aim aim, int multiplications,
                                              double exponent, double *zeta, double b[4]) {
    static const burnish_composite_piece pieces[] = {
        {{6, 0, 180},
         {{0.069989768, -0.01945587, 0.0034145589, -0.00029784779},
          {0.51562318, 0.278354, 0.049158419, -0.0024053247},
          {0.25123311, 0.050947321, 0.0073835068, -0.0018952739},
          {0.88647147, 0.093917512, -0.050240153, 0.0056940088},
          {0.99687093, 0.0076143005, -0.0057332975, 0.0012470898}}},
        {{6, 0, 44},
         {{0.07836413, -0.0063139224, 0.0035065807, -0.00096388549},
          {0.29140411, -0.22605186, 0.069047734, -0.0023295616},
          {0.33288578, 0.2456584, 0.013470825, -0.05488364},
          {0.86057693, 0.12813266, -0.13885034, 0.077811614},
          {0.99223066, 0.0046319803, 0.0099972081, -0.0085819008}}},
        {{6, 0, 19.5},
         {{0.081461986, -0.0022564897, -0.0096178421, 0.0030626823},
          {0.22749673, -0.31030649, 0.13824148, -0.03764297},
          {0.36724273, 0.26575301, 0.057407768, 0.00074681009},
          {0.83533317, 0.15230126, 0.0080242765, 0.0043429792},
          {0.99080308, 0.018557535, -0.0046759158, -0.0054638555}}},
        {{5, 1, 60},
         {{0.097739161, 0.0041109691, -0.018528954, 0.0050563757},
          {0.76410949, -0.023919884, 0.19348926, 0.015800013},
          {0.46870086, -0.033224424, 0.061657011, -0.029005946},
          {0.96264163, 0.01661088, 0.022344056, -0.026291656}}},
        {{5, 1, 34},
         {{0.13161916, -0.11543136, 0.073055794, -0.015162561},
          {0.65564853, 0.95037001, -0.85185031, 0.24543061},
          {0.17071075, 0.44661509, 0.31898112, -0.25327954},
          {0.86433846, 0.31961186, -0.26214844, 0.077381337}}},
        {{5, 1, 20},
         {{0.099668351, -0.0017448111, 0.0030213995, -0.001925372},
          {0.575779, -0.27114155, 0.025103482, 0.016458129},
          {0.60015518, 0.2853941, -0.010480305, 0.0052470893},
          {0.97129347, 0.053096547, -0.035479353, 0.0064375334}}},
        {{5, 1, 8},
         {{0.092042975, 0.042718224, 0.02241936, -0.032346441},
          {0.59227681, -1.0511992, 0.59617029, -0.13716871},
          {0.65057288, 0.66686975, -0.9486884, 0.63332143},
          {1.0019142, -0.096458501, 0.19387654, -0.099381154}}},
        {{5, 0, 56},
         {{0.10792814, -0.0016516013, -0.021302449, 0.0036563961},
          {0.70845898, -0.053865121, 0.59744616, -0.25737433},
          {0.39368018, 0.026668221, -0.17367231, 0.19058516},
          {0.94322801, 0.059610859, -0.076989247, 0.041412279}}},
        {{5, 0, 37},
         {{0.12666581, -0.081018983, 0.037227954, -0.0040769079},
          {1},
          {0.14936498, 0.25970133, 0.45742315, -0.27853136},
          {0.71785722, 0.68721395, -0.58772854, 0.17926932}}},
        {{5, 0, 18},
         {{0.12253791, -0.055238554, 0.060162028, -0.014364107},
          {0.40944021, 0.16249244, -0.57955385, 0.23235473},
          {0.48676009, 0.42444086, 0.046378493, -0.14042989},
          {0.9300556, 0.20995014, -0.24873457, 0.095561382}}},
        {{5, 0, 9.5},
         {{0.12076028, -0.07479455, 0.1971871, -0.10891061},
          {0.59257073, -1.0435383, 0.59711984, -0.12148449},
          {0.27180259, 2.1313792, -3.0327737, 1.4471626},
          {1.0211784, -0.17224709, 0.21448834, -0.063656347}}},
        {{5, 0, 8},
         {{0.29428421, -0.2525334, -0.0094669415, 0.092738019},
          {0.79847866, -2.5537567, 3.0033498, -1.2480368},
          {-0.41630212, 0.21457866, 3.367895, -2.1666865},
          {0.52056461, 1.5581048, -1.6852607, 0.6065799}}},
        {{4, 0, 15},
         {{0.16996402, -0.011391732, -0.0057616285, -0.011018029},
          {0.72921871, 0.13503155, -0.001791482, 0.13754122},
          {0.65208683, 0.070512346, -0.021748007, 0.054447579}}},
        {{4, 0, 9},
         {{-0.26175117, 1.5267996, -1.716147, 0.59474362},
          {3.0800991, -7.7116355, 7.048314, -1.6760968},
          {1.9473532, -4.7549386, 6.4959852, -2.6883998}}},
        {{4, 0, 8},
         {{3.7224949, -10.298882, 9.8506461, -3.1476565},
          {-27.039985, 74.610916, -65.80556, 19.210673},
          {1}}},
        {{4, 0, 4.5},
         {{0.17842545, -0.26621267, 0.72625948, -0.38903876},
          {1.5522925, -3.1566474, 2.1003431, -0.46282934},
          {0.26981701, 3.2224674, -4.877704, 2.3263804}}},
        {{4, 0, 4},
         {{3.8427965, -11.013252, 11.211862, -3.7913575},
          {-3.5763022, 11.141243, -11.147386, 3.5808895},
          {-18.780978, 59.891101, -60.874138, 20.765081}}},
        {{3, 0, 4.5},
         {{0.24119935, -0.013401205, 0.17257427, -0.13098029},
          {0.79005611, 0.2582856, -0.96256518, 0.76325384}}},
        {{3, 0, 4},
         {{-18.174035, 60.122554, -65.102133, 23.406905},
          {118.03285, -382.00633, 413.41838, -148.46484}}},
        {{3, 0, 2.5},
         {{-0.55477267, 2.8042921, -2.9996881, 1.1835748},
          {5.9263532, -18.141022, 20.474886, -8.0857842}}},
        {{3, 0, 2},
         {{0.075826041, 0.61318481, -0.28904464, 0.10010053},
          {1.732613, -3.2789098, 2.2213088, -0.67545148}}},
        {{2, 0, 2}, {{0.3568503, 0.11678356, 0.021945934, 0.0044209982}}},
    };
    const burnish_composite_piece *piece = pieces;
    int used = 2, i, order = 2;
    *zeta = b[0] = b[1] = b[2] = b[3] = 0;
    if (burnish_composite_check(aim, multiplications, exponent) != BURNISH_LOBE_OK) {
        return 0;
    }
    for (i = 2; i <= multiplications; ++i, order *= 2) {
        if (exponent == order || exponent < 2) { /* cos^n is a lobe, or cos^2 the best one */
            *zeta = 1;
            return i;
        }
    }
    while (piece->of.multiplications > multiplications || exponent < piece->of.least ||
           (piece->of.aim == BURNISH_COMPOSITE_DISPLAY && aim != BURNISH_COMPOSITE_DISPLAY)) {
        ++piece;
    }
    for (i = 0; i < piece->of.multiplications - 1; ++i) {
        const double *k = piece->constants[i], x = piece->of.least / exponent;
        const double value = k[0] + x * (k[1] + x * (k[2] + x * k[3]));
        if (i == 0) {
            *zeta = value * exponent > 1 ? value * exponent : 1;
        } else if (value > 1e-6) {
            b[used++ - 2] = value < 1 ? 1 / value - 1 : 0;
        }
    }
    return used;
}

/* The square root of a number in (0, 1], from above by Newton's method. */
static inline double burnish_composite_root(double x) {
    double root = 1, last;
    do {
        last = root;
        root = 0.5 * (root + x / root);
    } while (root < last);
    return last;
}

/* The lobe at lambda = 1 - cosine, preferable for large exponents as burnish_lobe_at_lambda is.
 *   lambda  any float; [-infinity, 0] gives 1, NaN gives 0
 * Returns a value in [0, 1]; 0 for the dark lobe. */
static inline float burnish_composite_at_lambda(burnish_composite lobe, float lambda) {
    float v = lobe.top - lobe.slope * lambda;
    v = v > 0.0f ? v : 0.0f;
    v = v < lobe.top ? v : lobe.top;
    v = v * v;
    v = lobe.multiplications > 2 ? v * (v + lobe.offset[0]) : v;
    v = lobe.multiplications > 3 ? v * (v + lobe.offset[1]) : v;
    v = lobe.multiplications > 4 ? v * (v + lobe.offset[2]) : v;
    return lobe.multiplications > 5 ? v * (v + lobe.offset[3]) : v;
}

/* The lobe at a cosine: burnish_composite_at_lambda of 1 - cosine.
 *   cosine  any float; [1, infinity] gives 1, NaN gives 0
 * Returns a value in [0, 1]; 0 for the dark lobe, and for cosines of 0 and less. */
static inline float burnish_composite_at_cosine(burnish_composite lobe, float cosine) {
    return burnish_composite_at_lambda(lobe, 1.0f - cosine);
}

/* The cosine below which the lobe is 0, rounded to float; 1 for the dark lobe. */
static inline float burnish_composite_cutoff_cosine(burnish_composite lobe) {
    return lobe.multiplications > 0 ? 1.0f - lobe.top / lobe.slope : 1.0f;
}

/* Makes the lobe that approximates cos^exponent.
 *   lobe             becomes the lobe, on error the dark one; not NULL
 *   aim              MINIMAX or DISPLAY
 *   multiplications  2 to 6, with DISPLAY 5 or 6; the lobe can have fewer
 *   exponent         [1, 65536], not necessarily an integer
 * Errors: ERROR_COMPOSITE, ERROR_EXPONENT (NaN included). */
static inline burnish_lobe_status burnish_composite_create(burnish_composite *lobe,
                                                           burnish_composite_aim aim,
                                                           int multiplications, float exponent) {
    const double n = (double)exponent;
    const burnish_composite dark = {0, 0, {0, 0, 0, 0}, 0};
    double zeta, b[4], scale = 1; /* v is scale w; 1 after the last step */
    float top;
    int i, last = -1;
    const int used = burnish_composite_constants(aim, multiplications, n, &zeta, b);
    *lobe = dark;
    if (used == 0) {
        return burnish_composite_check(aim, multiplications, n);
    }
    lobe->multiplications = used;
    for (i = used - 3; i >= 0; --i) {
        scale = burnish_composite_root(scale / (1 + b[i]));
        lobe->offset[i] = (float)(b[i] * scale);
        last = last < 0 && b[i] > 0 ? i : last;
    }
    /* Rounding would leave a peak of nearly 1. Try values of top around its own; each sets the last
     * offset so that v (v + offset) is 1 within a rounding error, which 3 of 4 values hit. A tiny
     * offset of the only step, as for n = 4.0137, needs 592 tries, all others 33 at most. */
    top = (float)burnish_composite_root(scale);
    lobe->top = top;
    for (i = 0; last >= 0 && i < 1024; ++i) {
        double v, offset;
        lobe->top = top + (float)(i % 2 ? (i + 1) / 2 : -i / 2) * (1.0f / 16777216.0f);
        lobe->multiplications = last + 2;
        v = (double)burnish_composite_at_lambda(*lobe, 0.0f);
        offset = (1 + 1.0 / 67108864.0) / v - v;
        lobe->offset[last] = offset > 0 ? (float)offset : 0.0f;
        lobe->multiplications = used;
        if (burnish_composite_at_lambda(*lobe, 0.0f) == 1.0f) {
            break;
        }
    }
    lobe->slope = (float)((double)lobe->top * zeta);
    return BURNISH_LOBE_OK;
}

/* ---- Lobes to compare with ----------------------------------------------------------------------
 *
 * Known alternatives without libm. Lobes that need it (cos^n itself, the Gaussian) are in
 * burnish/theory.h. Each call takes the exponent, clamped to [1, 65536]; a NaN exponent gives 0. */

/* The exponent clamped to [1, 65536]; NaN stays NaN. */
static inline float burnish_lobe_clamp_exponent(float exponent) {
    exponent = exponent < BURNISH_LOBE_EXPONENT_MIN ? BURNISH_LOBE_EXPONENT_MIN : exponent;
    return exponent > BURNISH_LOBE_EXPONENT_MAX ? BURNISH_LOBE_EXPONENT_MAX : exponent;
}

/* Schlick's lobe c / (n - n c + c), evaluated as c / (c + n (1 - c)): one division. Above cos^n.
 *   cosine    any float; <= 0 and NaN give 0, >= 1 gives 1
 *   exponent  n, clamped to [1, 65536]; NaN gives 0
 * Returns a value in [0, 1]. Source: Schlick, Graphics Gems IV, 1994. */
static inline float burnish_schlick_at_cosine(float cosine, float exponent) {
    const float c = burnish_lobe_saturate(cosine);
    const float n = burnish_lobe_clamp_exponent(exponent);
    return burnish_lobe_saturate(c / (c + n * (1.0f - c)));
}

/* The GameCube's lobe c^2 / (n/2 + (1 - n/2) c^2), evaluated as c^2 / (c^2 + n/2 (1 - c) (1 + c)).
 *   cosine    any float; <= 0 and NaN give 0, >= 1 gives 1
 *   exponent  n, clamped to [1, 65536]; NaN gives 0
 * Returns a value in [0, 1]. */
static inline float burnish_gx_at_cosine(float cosine, float exponent) {
    const float c = burnish_lobe_saturate(cosine);
    const float n = burnish_lobe_clamp_exponent(exponent);
    const float squared = c * c;
    return burnish_lobe_saturate(squared / (squared + (0.5f * n) * ((1.0f - c) * (1.0f + c))));
}

/* Lyon's approximation of 1/sqrt(s) near s = 1: 1 + e/2 + 3 e^2/8 with e = 1 - s, the first three
 * terms of the series. Relative error below 0.0004 for s in [0.9, 1.1], 0.05 in [0.5, 1.5].
 *   s  the squared length of a vector that is nearly a unit vector
 * Returns 5/6 or more. Source: Lyon 1993. */
static inline float burnish_lyon_normalize_factor(float s) {
    const float e = 1.0f - s;
    return 1.0f + e * (0.5f + 0.375f * e);
}

/* Lyon's lobe from the chord of two vectors, which it does not normalise: (1 - beta r^2/2)^order
 * with r = |a - b| and beta = exponent/order. This is the family's taylor fit in chord form.
 *   a, b      three components each; unit vectors, or nearly so
 *   exponent  clamped to [1, 65536]; NaN gives 0
 *   order     2, 4, 8, 16 or 32; above 2 at most the exponent; otherwise the result is 0
 * Returns a value in [0, 1]. Source: Lyon 1993. */
static inline float burnish_lyon_at_chord(const float a[3], const float b[3], float exponent,
                                          int order) {
    burnish_lobe lobe; /* on error the dark lobe, which gives the promised 0 */
    (void)burnish_lobe_create(&lobe, BURNISH_FIT_TAYLOR, order,
                              burnish_lobe_clamp_exponent(exponent));
    return burnish_lobe_at_lambda(lobe, burnish_lobe_chord(a, b));
}

/* Lyon's lobe from vectors of nearly unit length, such as interpolated normals. Scales both by
 * burnish_lyon_normalize_factor, then calls burnish_lyon_at_chord. No square root, no division.
 *   n, h             three components each, squared lengths near 1
 *   exponent, order  as for burnish_lyon_at_chord
 * Returns a value in [0, 1]. Source: Lyon 1993. */
static inline float burnish_lyon_at_vectors(const float n[3], const float h[3], float exponent,
                                            int order) {
    const float n_scale = burnish_lyon_normalize_factor((n[0] * n[0] + n[1] * n[1]) + n[2] * n[2]);
    const float h_scale = burnish_lyon_normalize_factor((h[0] * h[0] + h[1] * h[1]) + h[2] * h[2]);
    float a[3], b[3];
    int i;
    for (i = 0; i < 3; ++i) {
        a[i] = n[i] * n_scale;
        b[i] = h[i] * h_scale;
    }
    return burnish_lyon_at_chord(a, b, exponent, order);
}

/* ---- Exponentials -------------------------------------------------------------------------------
 *
 * e^-x for x >= 0 with 3, 4 or 5 multiplications and an exact end, for Gaussian splats, fog and
 * soft shadows: the limit of the composite lobes for large exponents. The constants minimise the
 * largest absolute error over all x >= 0, and are rounded to keep the exact 1 and 0 with fused
 * multiply-adds, too.
 *
 *     multiplications  largest error  relative to e^-x, x <= 1  x <= 2   x <= 3   e^-END
 *     3                .029374        .0540                     .158     .577     .0157
 *     4                .005173        .0088                     .0276    .104     .0026
 *     5                .000136        .00023                    .00067   .0017    .0001
 *
 * These are bounds of the errors of every float x (test/falloff.h). */

/* The functions are 0 from here on. The Gaussian e^(-r^2 / (2 sigma^2)) ends at
 * r = sqrt(2 END) sigma: 2.883, 3.459 and 4.302 sigma. */
#define BURNISH_EXP_FALLOFF_END3 4.15566015f
#define BURNISH_EXP_FALLOFF_END4 5.97967911f
#define BURNISH_EXP_FALLOFF_END5 9.25124741f

/* About e^-x. The number in the name is the number of multiplications.
 *   x  any float; [-infinity, 0] gives exactly 1, NaN and [END, infinity] give exactly 0
 * Returns a value in [0, 1], which never increases with x. */
static inline float burnish_exp_falloff3(float x) {
    const burnish_composite lobe = {0.942223668f, 0.226732612f, {0.238612935f, 0, 0, 0}, 3};
    return burnish_composite_at_lambda(lobe, x);
}

static inline float burnish_exp_falloff4(float x) {
    const burnish_composite lobe = {
        0.881662667f, 0.147443146f, {0.275810421f, 0.402908295f, 0, 0}, 4};
    return burnish_composite_at_lambda(lobe, x);
}

static inline float burnish_exp_falloff5(float x) {
    const burnish_composite lobe = {
        0.812974453f, 0.087877281f, {0.273172706f, 0.955595791f, 0.0586450733f, 0}, 5};
    return burnish_composite_at_lambda(lobe, x);
}

#ifdef __cplusplus
}
#endif

#endif
