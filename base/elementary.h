/* Elementary functions in double precision with the same bits on every machine: plain IEEE
 * operations in a fixed order, no libm. For set-up work (cameras, built-in objects, angle weights,
 * fits), not for pixels. Each states its largest error against the exact value, in units in the
 * last place (ulp) of the result; test_elementary measures it and fails above it. */
#ifndef BURNISH_BASE_ELEMENTARY_H
#define BURNISH_BASE_ELEMENTARY_H

#include <stddef.h>

#include "base/arithmetic.h"

/* IEEE square root, correctly rounded; negative gives NaN. */
double burnish_sqrt(double x);
float burnish_sqrtf(float x);

/* Sine and cosine of x radians, abs(x) <= 1e6, within 1 ulp (measured 0.77); outside that range and
 * for NaN both are NaN. */
void burnish_sincos(double x, double *sine, double *cosine);

/* Angle of the point (x, y) in (-pi, pi], within 1.5 ulp (measured 1.38); (0, 0) gives 0, whatever
 * the signs of the zeros, and y = -0 counts as 0. Two infinities count as equal; NaN gives NaN. */
double burnish_atan2(double y, double x);

/* Arc cosine in [0, pi], within 2.5 ulp also near 1 (measured 2.06); arguments outside [-1, 1] are
 * clamped, NaN gives NaN. */
double burnish_acos(double x);

/* Natural logarithm within 1 ulp also near 1 (measured 0.82); 0 gives -infinity, infinity gives
 * infinity, negative or NaN gives NaN. */
double burnish_log(double x);

/* exp(x) - 1 without cancellation near 0, within 1.5 ulp (measured 1.28); infinity if the result
 * exceeds the largest double (x above 709.78), NaN gives NaN. */
double burnish_expm1(double x);

#endif
