/* Shared by the files of theory. */
#ifndef BURNISH_THEORY_INTERNAL_H
#define BURNISH_THEORY_INTERNAL_H

#include "base/arithmetic.h"
#include "base/numbers.h"
#include "burnish/theory.h"

/* Fills *error, which may be NULL, and returns ARGUMENT. */
__attribute__((format(printf, 2, 3))) burnish_status burnish_theory_fail(burnish_error *error,
                                                                         const char *format, ...);

/* c^n by lambda = 1 - c, exact to rounding where c is close to 1; 0 from lambda = 1 on. */
double burnish_theory_power_at_lambda(double lambda, double exponent);

/* 1 - cos(angle) without cancellation, and back. */
double burnish_theory_lambda_of_angle(double angle);
double burnish_theory_angle_of_lambda(double lambda);

/* Entry i of a table, i = 0 at c = 0. */
double burnish_theory_table_entry(const burnish_theory_model *model, long i);

/* The smallest lambda in [0, 2] at which the lobe is at most level; NaN if it never is. */
double burnish_theory_lambda_at(const burnish_theory_model *model, double level);

/* An integrand over s = sqrt(lambda), which spreads the peak of a narrow lobe. */
typedef double (*burnish_theory_integrand)(double s, const void *context);

/* The integral of f from s0 to s1 by adaptive Gauss-Kronrod, in panels that end at the model's
 * corners and steps, absolute error about `tolerance` per panel. */
double burnish_theory_quadrature(burnish_theory_integrand f, const void *context,
                                 const burnish_theory_model *model, double s0, double s1,
                                 double tolerance);

/* Gauss-Legendre's rule on [-1, 1]. */
enum { BURNISH_THEORY_NODES_MAX = 64 };
typedef struct burnish_theory_nodes {
    int count; /* [1, 64] */
    double nodes[BURNISH_THEORY_NODES_MAX], weights[BURNISH_THEORY_NODES_MAX];
} burnish_theory_nodes;

void burnish_theory_gauss(int count, burnish_theory_nodes *rule);

/* The integral over c of lobe (times c) for lambda from lambda0 to lambda1, without 2 pi. */
double burnish_theory_integral_between(const burnish_theory_model *model,
                                       burnish_theory_measure measure, double lambda0,
                                       double lambda1);

/* The same in closed form, from lambda = 0, and the lambda of a sample, for lobes with a
 * burnish_theory_polynomial(); weighted samples for zeta >= 1. */
double burnish_theory_polynomial_integral(const burnish_theory_model *model, int weighted,
                                          double end);
double burnish_theory_polynomial_sample(const burnish_theory_model *model, int weighted, double xi);

/* First and second derivative in lambda of the lobes with a formula in the cosine. */
void burnish_theory_lambda_slopes(const burnish_theory_model *model, double lambda,
                                  double slope[2]);

/* How a smooth lobe meets cos^n. With v = lambda (GX: 1 - c^2), the logarithm of the ratio of
 * slopes is
 *     g(v) = log_slope + e log(1 + s v) - k v - log(p + 1) - p log(1 - v).
 * Its derivative has at most one zero, so lobe - cos^n has at most two stationary points. */
typedef struct burnish_theory_shape {
    double log_slope, e, s, k, p;
    double end; /* the v at which the lobe ends: its zero, at most 1 */
} burnish_theory_shape;

/* Fills the stationary points v of lobe - cos^n in (0, end); returns their number. */
int burnish_theory_stationary(const burnish_theory_shape *shape, double end, double v[2]);

burnish_theory_shape burnish_theory_family_shape(double zeta, double scale, int order,
                                                 double exponent);
burnish_theory_shape burnish_theory_moebius_shape(double a, double b, double exponent);

/* The constants of NV2X: (1 - a lambda) / (1 + b lambda) with the least maximum error. */
void burnish_theory_solve_moebius(double exponent, double *a, double *b);

/* Clamps to [0, 1]; NaN gives 0. */
static inline double saturate(double x) {
    x = x > 0 ? x : 0;
    return x < 1 ? x : 1;
}

#endif
