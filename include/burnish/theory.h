/* burnish/theory.h: what is true of a lobe, in double precision: the slope that every fit gives,
 * lobes by any fit, and the exact values that lobes are measured against.
 *
 * What it does not do: shade. Pictures use burnish/lobe.h; this is for set-up, tests and figures.
 * Notation: n exponent, m order, c cosine of the lobe angle, zeta slope of the lobe's base.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_THEORY_H
#define BURNISH_THEORY_H

#include "burnish/lobe.h"
#include "burnish/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The slope zeta that a fit gives for an exponent.
 *   taylor     n / m
 *   energy     (n + 1) / (m + 1)
 *   level      (1 - Q^(1/m)) / (1 - Q^(1/n))
 *   shift7     7n / 16, m = 2
 *   shift3     3n / 8, m = 2
 *   projected  the root >= 1 of (m+1)(m+2) zeta^2 - (m+2)(n+2) zeta + (n+2) = 0
 * Guarantees: plain IEEE operations in a fixed order, no libm: the same bits on every machine.
 * Relative error below 2e-15, for level with Q in [1e-300, 1 - 1e-9] too.
 *
 *   fit       one of the six
 *   order     m: 2, 4, 8, 16 or 32, from 4 on at most the exponent; SHIFT7 and SHIFT3: 2
 *   exponent  n: [1, 65536]; PROJECTED: at least the order, for order 2 too, since the equation
 *             above counts no light from below c = 0 and zeta < 1 would put some there
 *   level     Q: (0, 1); read for LEVEL only
 *   zeta      receives the slope, 0 on error; not NULL
 * Errors: ERROR_FIT, ERROR_ORDER, ERROR_EXPONENT, ERROR_ORDER_FOR_EXPONENT, ERROR_LEVEL; NaN is an
 * error everywhere. */
BURNISH_API burnish_lobe_status burnish_theory_zeta(burnish_fit fit, int order, double exponent,
                                                    double level, double *zeta);

/* Makes a lobe by any fit: burnish_theory_zeta rounded to float, thereby bit for bit what
 * burnish_lobe_create gives where that knows the fit and the exponent is a float.
 *   lobe                         becomes the lobe, on error the dark one; not NULL
 *   fit, order, exponent, level  as for burnish_theory_zeta
 * Errors: those of burnish_theory_zeta. */
BURNISH_API burnish_lobe_status burnish_theory_lobe(burnish_lobe *lobe, burnish_fit fit, int order,
                                                    double exponent, double level);

/* Values of the lobes in double precision, to measure float ones against. All take any double for c
 * (<= 0 gives 0 except for the family and the Gaussian, > 1 counts as 1, NaN gives 0), return a
 * value in [0, 1], and give 0 for a NaN parameter. Absolute error below 1e-14, relative error below
 * 1e-12 where the value is at least 1e-6. The power and the Gaussian use the C library. */

/* max(0, 1 - zeta (1 - c))^order; zeta >= 0; an order that does not exist gives 0. */
BURNISH_API double burnish_theory_family(double zeta, int order, double cosine);

/* cosine^exponent, exponent >= 0: 0 for c <= 0 even at exponent 0, 1 for c > 0 there. */
BURNISH_API double burnish_theory_power(double cosine, double exponent);

/* c / (n - n c + c), exponent >= 1. Source: Schlick 1994. */
BURNISH_API double burnish_theory_schlick(double cosine, double exponent);

/* exp(-(n + .775) (1 - c)), exponent >= 0: the spherical Gaussian. Source: Lagarde 2012. */
BURNISH_API double burnish_theory_gaussian(double cosine, double exponent);

/* c^2 / (n/2 + (1 - n/2) c^2), exponent > 0: the GameCube's lobe. */
BURNISH_API double burnish_theory_gx(double cosine, double exponent);

#ifdef __cplusplus
}
#endif

#endif
