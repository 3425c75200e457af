/* burnish/theory.h: properties of lobes in double precision: values, derivatives, widths, energy,
 * sampling, errors against cos^n, cost, and the claims of the paper with their verdicts.
 *
 * How to use it.
 *   1. Make a model, from words or from parts:
 *          burnish_theory_model model;
 *          status = burnish_theory_model_parse("energy:2", 100, &model, &error);
 *   2. Call burnish_theory_value, burnish_theory_angle_at, burnish_theory_compare ...
 *
 * It does not shade: images use burnish/lobe.h. This header is for set-up, tests and figures.
 * Notation: n exponent, m order, c cosine of the lobe angle, lambda = 1 - c, zeta slope of the base
 * of the lobe. Angles are radians in [0, pi].
 *
 * What it promises. Every function takes any model that a function here made successfully. No
 * function allocates, prints or keeps state; all can be called from any thread. Results do not
 * depend on the locale. Slopes (burnish_lobe_solve) have the same bits on every machine; the rest
 * uses the C library and can differ in the last digits.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_THEORY_H
#define BURNISH_THEORY_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/lobe_spec.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Functions of libburnish_theory, a static library on every system. */
#if defined(__GNUC__) && !defined(_WIN32)
#define BURNISH_THEORY_API __attribute__((visibility("default")))
#else
#define BURNISH_THEORY_API
#endif

/* Values of the lobes in double precision, references for the float ones. c can be any double: > 1
 * counts as 1, NaN gives 0, and <= 0 gives 0 except for the family. A NaN parameter
 * gives 0. Results are in [0, 1], with an absolute error below 1e-14 and a relative error below
 * 1e-12 for values of at least 1e-6. cos^n uses the C library. */

/* max(0, 1 - zeta (1 - c))^order; zeta >= 0; an order that does not exist gives 0. */
BURNISH_THEORY_API double burnish_theory_family(double zeta, int order, double cosine);

/* cosine^exponent, exponent >= 0: 0 for c <= 0 even at exponent 0, 1 for c > 0 there. */
BURNISH_THEORY_API double burnish_theory_power(double cosine, double exponent);

/* c / (n - n c + c), exponent >= 1. Source: Schlick 1994. */
BURNISH_THEORY_API double burnish_theory_schlick(double cosine, double exponent);

/* ---- Models ----
 *
 * One lobe at one exponent, with all that its evaluation needs. */

/* Made by burnish_theory_model_create; read its members, but do not change them. */
typedef struct burnish_theory_model {
    burnish_lobe_spec lobe; /* any kind but INTEGER_POWER */
    double exponent;        /* n of the cos^n that it approximates: [1, 65536] */
    double zeta;    /* FAMILY, LYON, COMPOSITE: the slope; NV2X: 1 / (1 + k0); otherwise 0 */
    double scale;   /* value at the peak: 1, in (0, 1) with fit AFFINE */
    double k[4];    /* NV2X: k0, k1, k2; KUIJK_BLAKE: a, b of the formula below;
                               COMPOSITE: b of each step; the others are 0 */
    int steps;      /* COMPOSITE: number of b; POWER: multiplications of a product */
    int is_product; /* POWER: 1: cos^n is a product of cosines, as EXACT draws it */
} burnish_theory_model;

/* Makes the model of a lobe.
 *   family, lyon   burnish_lobe_solve
 *   composite      burnish_composite_constants()
 *   nv2x           a Moebius function of the cosine, as in NVIDIA's NV1x and NV2x chips. Their
 *                  constants are known to two digits, from reverse engineering. k0, k1 and k2 are
 *                  the best of this form: value 1 at the peak, least maximum error
 *   kuijk-blake    with the angle x: 1 - x^2/(ab) to a, (x - b)^2 / (b (b - a)) from a to b,
 *                  a = (n + 5.6) / (n (0.09 n + 5.2)), b = (n + 65) / (5 n + 31.7); a poor fit from
 *                  n = 128 up. Source: Kuijk and Blake 1989
 *   table          of c^n, not stored: entry i is (i / (entries - 1))^n; the nearest entry
 *                  (halves round up) or linear interpolation
 *
 *   model     receives the model, on error cos^1; not NULL
 *   lobe      any but INTEGER_POWER; may be a member of model; not NULL
 *   exponent  n: [1, 65536]; for FAMILY and LYON as for burnish_lobe_solve
 * Errors: as for burnish_lobe_solve; ERROR_COMPOSITE; ERROR_FIT for another kind, ERROR_EXPONENT,
 * ERROR_ORDER for a table's number of entries. */
BURNISH_THEORY_API burnish_lobe_status burnish_theory_model_create(burnish_theory_model *model,
                                                                   const burnish_lobe_spec *lobe,
                                                                   double exponent);

/* Makes the model of a lobe from its words: the words of burnish_lobe_spec_parse(), and nv2x,
 * kuijk-blake, tableN, tableN:nearest, tableN:linear (N entries). burnish_lobe_spec_name() writes
 * them.
 *   text      the words, zero-terminated; not NULL
 *   exponent  n: [1, 65536]
 *   model     receives the model, unchanged on error; not NULL
 *   error     receives the message; may be NULL
 * Errors: ARGUMENT. */
BURNISH_THEORY_API burnish_status burnish_theory_model_parse(const char *text, double exponent,
                                                             burnish_theory_model *model,
                                                             burnish_error *error);

/* Makes the model of a composite lobe from its constants, for other fits than lobe.h has. Its words
 * are those of composite:M, M = steps + 2.
 *   model     receives the model, unchanged on error; not NULL
 *   exponent  n: [1, 65536], for errors and cost
 *   zeta      (0, 65536]
 *   b         of each step, each >= 0; may be NULL without steps
 *   steps     [0, 4]
 * Errors: ERROR_COMPOSITE, ERROR_EXPONENT, ERROR_ZETA. */
BURNISH_THEORY_API burnish_lobe_status burnish_theory_composite_create(burnish_theory_model *model,
                                                                       double exponent, double zeta,
                                                                       const double *b, int steps);

enum { BURNISH_THEORY_DEGREE_MAX = 32 };

/* The coefficients of a lobe that is a polynomial in u = max(0, 1 - zeta lambda): family, lyon and
 * composites. All are >= 0, and they add up to the value at the peak, so the lobe is a mixture of
 * powers of u: integrals, samples, harmonics and the light of polygons follow from those of powers.
 *   coefficients  of u^0, u^1 ...; those above the degree are 0
 * Returns the degree; 0 for other lobes. */
BURNISH_THEORY_API int
burnish_theory_polynomial(const burnish_theory_model *model,
                          double coefficients[BURNISH_THEORY_DEGREE_MAX + 1]);

/* ---- Values ----
 *
 * All models are defined for every angle, are 1 (fit affine: scale) at angle 0 and never increase
 * with the angle. Absolute error below 1e-13 for the lambda form. */

/* The lobe at 1 - cosine, the form that stays exact for large exponents.
 *   lambda  any number; <= 0 counts as 0, NaN gives 0 */
BURNISH_THEORY_API double burnish_theory_value_at_lambda(const burnish_theory_model *model,
                                                         double lambda);

/* The lobe at a cosine; > 1 counts as 1, NaN gives 0. */
BURNISH_THEORY_API double burnish_theory_value(const burnish_theory_model *model, double cosine);

/* The lobe at an angle in radians, [0, pi]. */
BURNISH_THEORY_API double burnish_theory_value_at_angle(const burnish_theory_model *model,
                                                        double angle);

/* Value, first and second derivative in the angle, for an angle in [0, pi]. At a corner or
 * step of the lobe (its zero, table nodes), these are the values on the side of the peak. For m =
 * 2: W' = -2 zeta sin(x) u, W'' = 2 zeta^2 sin^2(x) - 2 zeta cos(x) u.
 *   derivatives  receives the three numbers; not NULL */
BURNISH_THEORY_API void burnish_theory_derivatives(const burnish_theory_model *model, double angle,
                                                   double derivatives[3]);

/* Radius of curvature of the curve over the angle, (1 + S'^2)^(3/2) / abs(S'') with the derivatives
 * above. Both axes have the same unit (1 radian, 1 of the value). A small
 * radius is a sharp bend. It is 1/(m zeta) at the peak of the family, 1/n at the peak of cos^n.
 * Infinity if S'' is 0: at an inflection, beyond the zero, between the nodes of a table.
 *   angle  [0, pi] */
BURNISH_THEORY_API double burnish_theory_curvature_radius(const burnish_theory_model *model,
                                                          double angle);

/* Lyon's approximation of 1/sqrt(s) near 1: 1 + e/2 + 3 e^2/8, e = 1 - s. Source: Lyon 1993. */
BURNISH_THEORY_API double burnish_theory_lyon_normalize_factor(double s);

/* ---- Widths ---- */

/* The smallest angle at which the lobe is 0 up to rounding. It is acos(1 - 1/zeta) for the family
 * and pi/2 for power, schlick and gx. For a nearest table, the lowest entry begins there.
 * Returns NaN for a lobe without a zero: the Gaussian, and the family with zeta < 1/2. */
BURNISH_THEORY_API double burnish_theory_zero_angle(const burnish_theory_model *model);

/* The cosine of that angle, computed directly: 1 - 1/zeta for the family, below -1 without a zero
 * (zeta < 1/2); NaN for the Gaussian. */
BURNISH_THEORY_API double burnish_theory_cutoff_cosine(const burnish_theory_model *model);

/* burnish_theory_curvature_radius at the zero, on the side of the peak, in closed form. m = 2:
 * 1 / (4 zeta - 2). Infinity if S'' is 0 (m >= 4, tables); NaN without a zero. */
BURNISH_THEORY_API double burnish_theory_zero_curvature_radius(const burnish_theory_model *model);

/* The inflection of cos^n: acos(sqrt((n - 1) / n)). n >= 1, otherwise NaN. */
BURNISH_THEORY_API double burnish_theory_inflection_angle(double exponent);

/* The smallest angle at which the lobe is at most a level, for instance 2^-q:
 * power acos(L^(1/n)); schlick acos(n / (1/L + n - 1)); family acos(1 - (1 - L^(1/m)) / zeta) ...
 *   level  [0, 1); 0 is burnish_theory_zero_angle
 * Returns 0 if the peak is not above the level; NaN if the lobe is above the level at every angle,
 * and for a level out of range. */
BURNISH_THEORY_API double burnish_theory_angle_at(const burnish_theory_model *model, double level);

/* R: the angle at which cos^n reaches 2^-bits, divided by the angle at which the lobe reaches it.
 * Above 1 the lobe ends sooner.
 *   bits  q > 0, not necessarily an integer
 * Returns NaN if the lobe never falls to that level. */
BURNISH_THEORY_API double burnish_theory_width_ratio(const burnish_theory_model *model,
                                                     double bits);

/* ---- Energy and sampling ----
 *
 * The lobe over the hemisphere around its axis, c in [0, 1]. */

typedef enum burnish_theory_measure {
    BURNISH_THEORY_SOLID_ANGLE,    /* d omega */
    BURNISH_THEORY_COSINE_WEIGHTED /* c d omega: projected solid angle */
} burnish_theory_measure;

/* The integral of the lobe, in steradians. Closed forms for family, composites (cut off at c = 0 if
 * zeta < 1), power, gaussian and tables, adaptive Gauss-Kronrod for the others. Relative error
 * below 1e-11. Family: 2 pi / (zeta (m+1)) and, for zeta >= 1,
 * 2 pi (zeta (m+2) - 1) / (zeta^2 (m+1)(m+2)); power: 2 pi / (n+1), 2 pi / (n+2). */
BURNISH_THEORY_API double burnish_theory_integral(const burnish_theory_model *model,
                                                  burnish_theory_measure measure);

/* The part of that integral with cosines in [from, 1].
 *   from  [0, 1] */
BURNISH_THEORY_API double burnish_theory_partial_integral(const burnish_theory_model *model,
                                                          burnish_theory_measure measure,
                                                          double from);

/* The factor for Phong (c = R.V) with which a lobe never reflects more light than arrives, and
 * exactly as much at normal incidence: 1 / (cosine-weighted integral). */
BURNISH_THEORY_API double burnish_theory_phong_factor(const burnish_theory_model *model);

/* The same factor for Blinn (c = N.H): 1 / (8 pi integral over h in [sqrt(1/2), 1] of
 * S(h) (2 h^2 - 1) h dh). For cos^n: (n+2)(n+4) / (8 pi (2^(-n/2) + n)). */
BURNISH_THEORY_API double burnish_theory_blinn_factor(const burnish_theory_model *model);

/* The common approximation of that factor for cos^n: (n + 8) / (8 pi). */
BURNISH_THEORY_API double burnish_theory_blinn_factor_common(double exponent);

/* The factor that makes the lobe a distribution of normals: 1 / (cosine-weighted integral). D(h)
 * (n.h) d omega then integrates to 1. cos^n: (n + 2) / (2 pi). */
BURNISH_THEORY_API double burnish_theory_normal_factor(const burnish_theory_model *model);

/* Density per steradian of directions drawn in proportion to the lobe, or to lobe times cosine:
 * S(c) / integral or S(c) c / integral; 0 below c = 0 and above 1. */
BURNISH_THEORY_API double burnish_theory_pdf(const burnish_theory_model *model,
                                             burnish_theory_measure measure, double cosine);

/* The cosine of a direction drawn with that density from a uniform number.
 * Power, the Gaussian over solid angle and the family have exact closed forms. For the family it is
 * 1 - (1 - xi^(1/(m+1))) / zeta over solid angle and, cosine-weighted, a mixture of two power
 * densities in u (zeta >= 1). Composites are a mixture of powers. The others invert their integral
 * numerically to 1e-12, which is about 100 times slower. Except for mixtures the cosine never
 * decreases with xi.
 *   xi  [0, 1]; clamped
 * Returns a cosine in [0, 1]. */
BURNISH_THEORY_API double burnish_theory_sample_cosine(const burnish_theory_model *model,
                                                       burnish_theory_measure measure, double xi);

/* A direction around (0, 0, 1) with that density.
 *   xi         two uniform numbers in [0, 1): cosine, azimuth
 *   direction  receives a unit vector; not NULL */
BURNISH_THEORY_API void burnish_theory_sample_direction(const burnish_theory_model *model,
                                                        burnish_theory_measure measure,
                                                        const double xi[2], double direction[3]);

/* ---- Harmonics ---- */

/* 2 pi times the integral over c in [-1, 1] of max(0, 1 + zeta (c - 1))^order P_degree(c), P being
 * Legendre's polynomial. A function convolved with the lobe has its spherical harmonics of that
 * degree multiplied by it. Exact but for rounding, 2e-14 of degree 0.
 *   order   >= 1
 *   zeta    > 0
 *   degree  >= 0; order + degree: at most 127
 * Returns NaN for numbers out of range. */
BURNISH_THEORY_API double burnish_theory_zonal(int order, double zeta, int degree);

/* The same for a model with burnish_theory_polynomial(). NaN for others.
 *   degree  [0, 127 - the polynomial's] */
BURNISH_THEORY_API double burnish_theory_model_zonal(const burnish_theory_model *model, int degree);

/* ---- Area lights ----
 *
 * Lights of radiance 1, reflected by a lobe around the mirror direction r. The errors hold for zeta
 * from 0.3 to 65536 and coefficients >= 0. Every function returns NaN for numbers out of range or
 * not finite, and for a vector of length 0. docs/theory.md has the derivations. */

enum { BURNISH_THEORY_POWERS_MAX = 40 };

/* S = the sum of coefficients[i] u^i where u = 1 + zeta (c - 1) is positive, and 0 elsewhere: a
 * member of the family, a sum of members with one slope, or a composite lobe. Degree 0 is a cap. */
typedef struct burnish_theory_powers {
    double zeta; /* (0, 1e9] */
    int degree;  /* [0, 40] */
    double coefficients[BURNISH_THEORY_POWERS_MAX + 1];
} burnish_theory_powers;

/* u^order. An order that is not in [0, 40] makes the functions below return NaN. */
BURNISH_THEORY_API burnish_theory_powers burnish_theory_powers_of_order(int order, double zeta);

/* A sphere: the integral of S over the directions within an angle of another direction, in
 * steradians. Error below 1e-12 of the whole lobe.
 *   axis    r, of any length
 *   normal  cuts the light off at the horizon of this vector; NULL: not cut
 *   centre  the middle of the cap, of any length
 *   angle   [0, pi]; for a sphere of radius s at distance d, asin(s / d) */
BURNISH_THEORY_API double burnish_theory_cap(const burnish_theory_powers *lobe,
                                             const double axis[3], const double *normal,
                                             const double centre[3], double angle);

/* ---- The light of a polygon ----
 *
 * A polygon of radiance 1, reflected by a lobe around the mirror direction r. docs/theory.md has
 * the derivation. */

enum { BURNISH_THEORY_POLYGON_ORDER_MAX = 32 };

/* The integral over the polygon of max(0, 1 + zeta (r.w - 1))^order d omega, in steradians.
 * Positive if the vertices turn counter-clockwise as seen from the origin, negative if clockwise; a
 * part that the path surrounds twice counts twice. The polygon must fit in an open hemisphere, as
 * flat polygons do. Equal neighbours are allowed. Order 1 and zeta 1 give Lambert's formula: the
 * irradiance from the part of the polygon above the horizon of r.
 *   order     [1, 32], any integer
 *   zeta      (0, 1e9]
 *   axis      r, of any length
 *   normal    cuts the polygon off at the horizon of this vector; NULL: not cut
 *   vertices  count points, seen from the origin
 *   count     fewer than 3 give 0
 * The error is below 1e-12 of the whole lobe, 2 pi/(zeta (order + 1)), for zeta in [1/2, 65536].
 * Returns NaN for numbers out of range or not finite, and for a vector of length 0. */
BURNISH_THEORY_API double burnish_theory_polygon(int order, double zeta, const double axis[3],
                                                 const double *normal, const double (*vertices)[3],
                                                 int count);

/* The same for a polynomial lobe. */
BURNISH_THEORY_API double burnish_theory_polygon_polynomial(const burnish_theory_powers *lobe,
                                                            const double axis[3],
                                                            const double *normal,
                                                            const double (*vertices)[3], int count);

/* ---- Sums of lobes for rough surfaces ----
 *
 * alpha is the width of GGX or Beckmann, usually the square of a roughness slider. At normal
 * incidence such a surface blurs its environment, around the mirror direction, by a lobe
 * proportional to D(h) max(0, c), c = R.w and h^2 = (1 + c) / 2. Source: Karis 2013. */

typedef enum burnish_theory_distribution {
    BURNISH_THEORY_GGX,
    BURNISH_THEORY_BECKMANN
} burnish_theory_distribution;

enum { BURNISH_THEORY_LOBE_SUM_MAX = 3 };

/* The sum of weight_j S_j zeta_j (order_j + 1) / (2 pi), S_j = max(0, 1 + zeta_j (c - 1))^order_j.
 * Its integral over solid angle is 1. */
typedef struct burnish_theory_lobe_sum {
    int count;        /* [1, 3] */
    int order[3];     /* fixed for each distribution and count */
    double zeta[3];   /* >= 1: the sum is 0 from c = 0 down */
    double weight[3]; /* shares of energy, which add up to 1 */
} burnish_theory_lobe_sum;

/* Fits 1 to 3 lobes, with the least energy in the wrong direction. Slopes and weights are
 * polynomials in alpha, fitted over [0.0025, 1]; below, the lobes keep their shape. GGX: 1, 2 and 3
 * lobes move at most 26 %, 12 % and 6.3 % of the energy; docs/theory.md has the errors by alpha.
 *   alpha  (0, 1]
 *   count  [1, 3]
 *   sum    receives the lobes; not NULL
 *   error  receives the message; may be NULL
 * Errors: ARGUMENT. */
BURNISH_THEORY_API burnish_status
burnish_theory_lobe_sum_fit(burnish_theory_distribution distribution, double alpha, int count,
                            burnish_theory_lobe_sum *sum, burnish_error *error);

/* The sum at 1 - c, lambda >= 0, per steradian. */
BURNISH_THEORY_API double burnish_theory_lobe_sum_value(const burnish_theory_lobe_sum *sum,
                                                        double lambda);

/* The lobe of the rough surface, per steradian, to 1e-8. NaN if alpha is not in (0, 1]. */
BURNISH_THEORY_API double burnish_theory_rough_value(burnish_theory_distribution distribution,
                                                     double alpha, double lambda);

/* How far a sum is from it, to 1e-4. */
typedef struct burnish_theory_lobe_sum_error {
    double moved; /* energy in the wrong direction, half the integral of abs(sum - lobe) */
    double cap;   /* largest error of the energy inside a cap around c = 1 */
    double peak;  /* value at c = 1, of the lobe's */
} burnish_theory_lobe_sum_error;

/* Measures a sum; alpha in (0, 1]. */
BURNISH_THEORY_API void burnish_theory_lobe_sum_compare(burnish_theory_distribution distribution,
                                                        double alpha,
                                                        const burnish_theory_lobe_sum *sum,
                                                        burnish_theory_lobe_sum_error *error);

/* ---- Errors against cos^n ---- */

/* How far a lobe is from cos^n, for angles from 0 to `end`. */
typedef struct burnish_theory_difference {
    double end;            /* end of the range, radians */
    double absolute;       /* largest abs(lobe - cos^n) */
    double absolute_angle; /* its angle */
    double above, below;   /* largest lobe - cos^n and cos^n - lobe, each >= 0 */
    double relative;       /* largest abs(lobe / cos^n - 1), infinity if cos^n is 0 */
    double relative_angle; /* its angle */
    double integral;       /* integral of abs(lobe - cos^n) over the solid angle, steradians */
    double rms;            /* root of the mean of (lobe - cos^n)^2 over the solid angle */
} burnish_theory_difference;

/* Measures the difference. The maxima are certified. The slopes of a lobe and of cos^n are equal at
 * two points at most (proof: docs/theory.md), which are found by bisection (family, schlick,
 * gaussian, gx, nv2x; for each cell of a table one point in closed form). For kuijk-blake and
 * composites both curves fall with the angle, so lobe(a) - cos^n(b) bounds the error on [a, b], and
 * intervals are split until no bound exceeds the maximum found by more than 1e-9, for composites of
 * it; these have a bound by second derivatives, too.
 *   end     (0, pi/2], such as burnish_theory_inflection_angle(), burnish_theory_angle_at() of
 *           cos^n, or pi/2 for the whole range
 *   result  receives the numbers, all NaN if end is out of range; not NULL
 * Guarantees: maxima within 1e-9, angles with an error within 1e-9 of the maximum; integral and rms
 * within 1e-8 relative if the maximum is above 1e-7. */
BURNISH_THEORY_API void burnish_theory_compare(const burnish_theory_model *model, double end,
                                               burnish_theory_difference *result);

/* The largest absolute error alone, which is much faster. */
BURNISH_THEORY_API double burnish_theory_maximum_error(const burnish_theory_model *model,
                                                       double end);

/* lobe / cos^n - 1 at an angle; -1 if the lobe is 0, infinity if only cos^n is 0; 0 for cos^n. */
BURNISH_THEORY_API double burnish_theory_relative_error(const burnish_theory_model *model,
                                                        double angle);

/* The angle at which the family's relative error has its extreme, before it falls to -1 at the
 * zero: cos = n (zeta - 1) / (zeta (n - m)). For energy, m = 2, tan = sqrt(2n + 1) / n; for shift7,
 * tan = 2 sqrt(7n - 15) / (7n - 16). NaN for other lobes and without such an angle (zeta <= 1, n <=
 * m, zeta > n/m). */
BURNISH_THEORY_API double burnish_theory_extreme_angle(const burnish_theory_model *model);

/* The same angle by a search that does not use the formula: the maximum of lobe / cos^n.
 * NaN if burnish_theory_extreme_angle() is NaN. */
BURNISH_THEORY_API double burnish_theory_extreme_angle_searched(const burnish_theory_model *model);

/* ---- Exponents and roughness ---- */

/* n = 2 / alpha^2 - 2: cos^n as a distribution of normals for a Beckmann or GGX alpha.
 * alpha: (0, 1]. Source: Walter et al. 2007. */
BURNISH_THEORY_API double burnish_theory_exponent_from_alpha(double alpha);

/* alpha = sqrt(2 / (n + 2)), n >= 0. */
BURNISH_THEORY_API double burnish_theory_alpha_from_exponent(double exponent);

/* With alpha = roughness^2, the perceptual roughness of most engines. */
BURNISH_THEORY_API double burnish_theory_exponent_from_roughness(double roughness);
BURNISH_THEORY_API double burnish_theory_roughness_from_exponent(double exponent);

/* The Phong exponent with a highlight about as wide as a Blinn exponent: n / 4; and the inverse. */
BURNISH_THEORY_API double burnish_theory_phong_from_blinn(double exponent);
BURNISH_THEORY_API double burnish_theory_blinn_from_phong(double exponent);

/* Toksvig's exponent for averaged normals: n l / (l + n (1 - l)).
 *   exponent  n >= 0
 *   length    l, the length of the mean of unit normals: [0, 1], clamped
 * Source: Toksvig 2005. */
BURNISH_THEORY_API double burnish_theory_toksvig_exponent(double exponent, double length);

/* ---- Cost and choice ---- */

/* Operations of one evaluation from a cosine (kuijk-blake: the angle, by one arc cosine), with
 * constants computed per material. The family: u = max(0, A c + B), then log2(m) squarings.
 * Composites: from lambda. */
typedef struct burnish_theory_cost {
    int multiplications;
    int additions;   /* and subtractions */
    int comparisons; /* and max, min and selections */
    int divisions;
    int transcendentals; /* pow, exp, acos: one each */
    int lookups;         /* reads of a table */
    long memory;         /* entries of that table */
} burnish_theory_cost;

BURNISH_THEORY_API burnish_theory_cost burnish_theory_model_cost(const burnish_theory_model *model);

/* Returns < 0 if a is cheaper, > 0 if b is cheaper, 0 if they are equal. Compares the
 * transcendentals, then the divisions, then the lookups, then multiplications, additions and
 * comparisons together. */
BURNISH_THEORY_API int burnish_theory_cost_order(const burnish_theory_cost *a,
                                                 const burnish_theory_cost *b);

/* Finds the cheapest lobe whose largest absolute error against c^n, c in [0, 1], is at most
 * epsilon; of equally cheap lobes, the one with the least error. c^n itself is a candidate, so
 * there is always a result. Lobes that can not be drawn (burnish_lobe_spec_check()) are not
 * candidates.
 *   exponent  n: [1, 65536]
 *   epsilon   (0, 1)
 *   affine    1: lobes whose peak is not 1 (fit affine) are also candidates
 *   model     receives the lobe; not NULL
 *   cost      receives its cost; may be NULL
 *   maximum   receives its error; may be NULL
 *   error     receives the message; may be NULL
 * Errors: ARGUMENT. */
BURNISH_THEORY_API burnish_status burnish_theory_choose(double exponent, double epsilon, int affine,
                                                        burnish_theory_model *model,
                                                        burnish_theory_cost *cost, double *maximum,
                                                        burnish_error *error);

/* ---- The memory of boundary cosines ----
 *
 * One stored cosine per exponent; at and below it the lobe need not be computed. */

/* The cosine at which the lobe has fallen to 2^-bits; bits 0: to zero, the cutoff cosine.
 *   bits  q: [0, 1024]
 * Clamped to [0, 1]: 0 if the lobe is brighter at every c > 0. NaN for other bits. */
BURNISH_THEORY_API double burnish_theory_boundary_cosine(const burnish_theory_model *model,
                                                         double bits);

/* 1 minus that cosine, exact for narrow lobes. */
BURNISH_THEORY_API double burnish_theory_boundary_lambda(const burnish_theory_model *model,
                                                         double bits);

typedef enum burnish_theory_rounding {
    BURNISH_THEORY_NEAREST, /* halves round up */
    BURNISH_THEORY_DOWN,    /* for cosines: cuts nothing visible */
    BURNISH_THEORY_UP       /* the same for 1 - cosine */
} burnish_theory_rounding;

/* A fixed-point format. The word is [sign] integer_bits fraction_bits, 32 bits at most. */
typedef struct burnish_theory_format {
    int is_signed; /* 1: two's complement with one more bit for the sign */
    int integer_bits, fraction_bits;
} burnish_theory_format;

/* Reads "UQ0.15" (unsigned, 0 integer and 15 fraction bits), "Q0.15" (the same and a sign bit),
 * "Q15" or "UQ16" (no integer bits).
 * Errors: ARGUMENT for anything else, no bits, or more than 32 with the sign. */
BURNISH_THEORY_API burnish_status burnish_theory_format_parse(const char *text,
                                                              burnish_theory_format *format,
                                                              burnish_error *error);

/* Writes "UQ0.15" or "Q1.14"; size 16 is enough. */
BURNISH_THEORY_API void burnish_theory_format_name(const burnish_theory_format *format, char *text,
                                                   size_t size);

/* The width of a word in bits, the sign included. */
BURNISH_THEORY_API int burnish_theory_format_width(const burnish_theory_format *format);

/* A number in that format: x 2^fraction_bits rounded as stated, then limited to the range of the
 * format: 1 becomes the largest word of UQ0.15. NaN gives 0. */
BURNISH_THEORY_API int64_t burnish_theory_format_encode(const burnish_theory_format *format,
                                                        burnish_theory_rounding rounding, double x);

/* The value of a word. */
BURNISH_THEORY_API double burnish_theory_format_decode(const burnish_theory_format *format,
                                                       int64_t word);

/* The contents of a memory. */
typedef struct burnish_theory_memory {
    burnish_lobe_spec lobe; /* the exponent comes from the list */
    double bits;            /* q: [1, 1024], or 0 for the cutoff */
    int lambda;             /* 1: words hold 1 - cosine, 0: cosines */
    burnish_theory_format format;
    burnish_theory_rounding rounding;
} burnish_theory_memory;

/* Fills a memory: words[i] is the boundary for exponents[i]. For an exponent below the order,
 * the highest possible order is used.
 *   exponents, count  each n: [1, 65536]
 *   words             receives count words; not NULL unless count is 0
 *   error             receives the message; may be NULL
 * Errors: ARGUMENT. */
BURNISH_THEORY_API burnish_status burnish_theory_memory_fill(const burnish_theory_memory *memory,
                                                             const double *exponents, size_t count,
                                                             int64_t *words, burnish_error *error);

/* ---- Metrics ----
 *
 * The properties above by name: the columns of `burnish-lobe table`. */

typedef struct burnish_theory_metric {
    const char *group;          /* "shape", "widths", "energies", "errors", "cost", "sums" */
    const char *name;           /* "max-error" */
    const char *key;            /* for CSV and JSON: "max_error" */
    const char *heading, *unit; /* for tables; the unit of the value: "", "deg", "%", "sr" ... */
    const char *about;          /* what it is; _BITS_ is the argument */
    int decimals;               /* for reading; below 0: -decimals significant digits */
    const char *takes;          /* its argument: "BITS", "DEG", "LENGTH", or "LOBES", a whole
                                   number; NULL: none */
    double low, high, usual;    /* of the argument */
    int needs_difference;
} burnish_theory_metric;

/* All metrics; NULL past the last. */
BURNISH_THEORY_API const burnish_theory_metric *burnish_theory_metric_at(size_t index);

/* The value of a metric in its unit; NaN where it is not defined.
 *   metric      from burnish_theory_metric_at(); not NULL
 *   argument    [low, high]; ignored without an argument
 *   difference  of the model, from burnish_theory_compare(); may be NULL without
 *               needs_difference */
BURNISH_THEORY_API double burnish_theory_metric_value(const burnish_theory_metric *metric,
                                                      const burnish_theory_model *model,
                                                      double argument,
                                                      const burnish_theory_difference *difference);

/* ---- The paper's claims ----
 *
 * The paper approximates BRDFs by cosine-quadratic functions, order 2 of the family. Its references
 * date it after 2005; no bibliographic record of it was found.
 * Every number is computed on request; every verdict follows from the numbers. */

typedef enum burnish_theory_verdict {
    BURNISH_THEORY_HOLDS,
    BURNISH_THEORY_HOLDS_IN_PART, /* for some of the values; the note says for which */
    BURNISH_THEORY_DOES_NOT_HOLD, /* for none of the values */
    BURNISH_THEORY_BENCHMARK,     /* a timing; run the benchmark */
    BURNISH_THEORY_COUNTED,       /* a count of operations, in firmware/operations.csv */
    BURNISH_THEORY_VERDICT_COUNT
} burnish_theory_verdict;

/* "holds", "holds in part", "does not hold", "measured by benchmark", "counted in machine code". */
BURNISH_THEORY_API const char *burnish_theory_verdict_text(burnish_theory_verdict verdict);

/* The relation between values and bound that decides the verdict. */
typedef enum burnish_theory_relation {
    BURNISH_THEORY_AT_MOST,  /* every value <= bound */
    BURNISH_THEORY_AT_LEAST, /* every value >= bound */
    BURNISH_THEORY_ABOUT,    /* every value within half a unit of the bound's last digit */
    BURNISH_THEORY_NONE      /* not judged here: BENCHMARK or COUNTED */
} burnish_theory_relation;

enum { BURNISH_THEORY_CLAIM_VALUES = 18 };

typedef struct burnish_theory_claim {
    const char *id;       /* one word for tables and options */
    const char *claim;    /* the statement, in our words */
    const char *source;   /* who states it: "the paper", or "Lyon 1993" for background */
    const char *quantity; /* what the values measure, with unit */
    const char *note;     /* why, for a verdict that needs an explanation; otherwise "" */
    const char *command;  /* a command line that shows it */
    int count;            /* number of values: [0, BURNISH_THEORY_CLAIM_VALUES] */
    struct burnish_theory_claim_value {
        char label[32]; /* "n=100", "W_0.5 n=21" */
        double value;
        int judged; /* 0: for information, not part of the claim */
    } values[BURNISH_THEORY_CLAIM_VALUES];
    burnish_theory_relation relation;
    double bound; /* what the values are judged against */
    double unit;  /* of the last stated digit, for ABOUT; 0 for an exact statement */
    burnish_theory_verdict verdict;
} burnish_theory_claim;

/* How many claims there are. */
BURNISH_THEORY_API size_t burnish_theory_claim_count(void);

/* Computes one claim; under a second each.
 *   index  [0, burnish_theory_claim_count())
 *   claim  receives it; its strings are static; not NULL
 * Errors: ARGUMENT for an index out of range. */
BURNISH_THEORY_API burnish_status burnish_theory_claim_compute(size_t index,
                                                               burnish_theory_claim *claim);

#ifdef __cplusplus
}
#endif

#endif
