/* burnish/lobe_spec.h: lobes by their words ("energy:2"), and their slopes. shading.h includes it;
 * theory.h analyses the lobes.
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
#ifndef BURNISH_LOBE_SPEC_H
#define BURNISH_LOBE_SPEC_H

#include <stddef.h>

#include "burnish/core.h"
#include "burnish/lobe.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The specular lobes, as functions of a cosine c and an exponent n. */
typedef enum burnish_lobe_kind {
    BURNISH_LOBE_FAMILY,        /* scale max(0, 1 - zeta (1 - c))^m; a fit sets zeta and scale */
    BURNISH_LOBE_POWER,         /* c^n: the reference */
    BURNISH_LOBE_INTEGER_POWER, /* c^n for an integer n; kernels.h only, no word */
    BURNISH_LOBE_SCHLICK,       /* c / (n - n c + c) */
    BURNISH_LOBE_LYON,          /* taylor, from the chord of two nearly unit vectors */
    BURNISH_LOBE_GAUSSIAN,      /* exp(-(n + 0.775) (1 - c)) */
    BURNISH_LOBE_GX,            /* c^2 / (n/2 + (1 - n/2) c^2) */
    BURNISH_LOBE_COMPOSITE,     /* burnish_composite of lobe.h; an aim sets its constants */
    BURNISH_LOBE_EXACT,         /* burnish_lobe_exact(): c^n to 8 bits */
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
    burnish_lobe_fit fit;      /* FAMILY */
    burnish_composite_aim aim; /* COMPOSITE */
    int order;        /* FAMILY, LYON: m = 2, 4, 8, 16 or 32; COMPOSITE: multiplications, 2 to
                             6, with aim DISPLAY 5 or 6 */
    double parameter; /* FAMILY with fit LEVEL: Q in (0, 1); with fit GIVEN: zeta in
                             (0, 65536] */
    int entries;      /* TABLE: number of entries, [2, BURNISH_LOBE_ENTRIES_MAX] */
    int linear;       /* TABLE: 1: linear interpolation; 0: the nearest entry */
    int by_material;  /* render.h: 1: EXACT replaces this lobe for materials that state
                                  their exponent (has_exponent) */
} burnish_lobe_spec;

/* Parses the words of a lobe:
 *   FIT[:ORDER]   with FIT taylor, energy, levelQ, shift7, shift3, projected, minimax,
 *                 leastsquares, affine or zetaZ, and order 2 by default. Q and Z are decimal
 *                 numbers with at most 15 digits, without leading zeros, and 20 decimals
 *   lyon[:ORDER]
 *   composite[:M]  with M = 2 to 6 multiplications, 5 by default; display[:M] with M = 5 or 6
 *   power, schlick, gaussian, gx, exact
 *   auto           energy:2 by_material
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

/* Checks whether render.h and kernels.h can draw a lobe: its kind, fit, aim, order and parameter.
 * burnish_lobe_solve() and burnish_composite_create() check the exponent.
 *   lobe   not NULL
 *   error  receives the message; may be NULL
 * Errors: ARGUMENT. */
BURNISH_API burnish_status burnish_lobe_spec_check(const burnish_lobe_spec *lobe,
                                                   burnish_error *error);

/* The cheapest lobe that is exact to 8 bits: a highlight of intensity 1 has, in sRGB, at most one
 * code more or less than c^n, and the same code over at least nine tenths of its range.
 *   exponent  [1, 65536]
 * Returns INTEGER_POWER for integers with a product of at most 5 multiplications (its order), such
 * as 1 to 14, 16 and 32; composite display:5 from 8 on, which differs at 9 % of the range at most;
 * POWER for the rest. */
BURNISH_API burnish_lobe_spec burnish_lobe_exact(float exponent);

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
 * Errors: ERROR_FIT (or another kind: a composite has no slope and scale), ERROR_ORDER,
 * ERROR_EXPONENT, ERROR_ORDER_FOR_EXPONENT, ERROR_LEVEL, ERROR_ZETA. NaN is an error.
 * Source: minimax by Beaudoin and Guardado 2002, whose tables it reproduces. */
BURNISH_API burnish_lobe_status burnish_lobe_solve(const burnish_lobe_spec *lobe, double exponent,
                                                   double *zeta, double *scale);

/* The words of one lobe of each kind and fit, such as "taylor:2", for lists and help; NULL after
 * the last. Lobes that only theory.h evaluates come last. */
BURNISH_API const char *burnish_lobe_spec_example(size_t index);

#ifdef __cplusplus
}
#endif

#endif
