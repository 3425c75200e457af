/* Half precision in C: the results of a GPU's 16-bit arithmetic, operation by operation. A float
 * has more than twice a half's digits: an operation on floats, rounded to half, is the correctly
 * rounded operation on halves. */
#ifndef TEST_SHADERS_HALF_H
#define TEST_SHADERS_HALF_H

#include <math.h>
#include <stdint.h>
#include <string.h>

static inline float half_to_float(uint16_t half) {
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    float value = exponent == 0    ? ldexpf((float)fraction, -24)
                  : exponent == 31 ? (fraction ? NAN : INFINITY)
                                   : ldexpf((float)(1024 + fraction), exponent - 25);
    return half & 0x8000 ? -value : value;
}

/* x rounded to the nearest half, halves to even; subnormal ones are kept, 65520 and more are
 * infinite. */
static inline float half_round(float x) {
    const float magnitude = fabsf(x);
    int exponent;
    if (!(magnitude < 65520.0f)) {
        return isnan(x) ? x : copysignf(INFINITY, x);
    }
    frexpf(magnitude, &exponent);
    const int last = exponent - 11 < -24 ? -24 : exponent - 11; /* of the last digit */
    return ldexpf(rintf(ldexpf(x, -last)), last);
}

/* A lobe of order 2 << squarings of 1 - cosine, and of a cosine, as burnishLobeOfLambda2 ... and
 * burnishLobe2 ... compute it. */
static inline float half_lobe_of_lambda(float lambda, float zeta, int squarings) {
    float u = half_round(1.0f - half_round(zeta * lambda));
    u = u > 0.0f ? u : 0.0f;
    u = u < 1.0f ? u : 1.0f;
    for (int i = 0; i <= squarings; ++i) {
        u = half_round(u * u);
    }
    return u;
}

static inline float half_lobe(float cosine, float zeta, int squarings) {
    return half_lobe_of_lambda(half_round(1.0f - cosine), zeta, squarings);
}

#endif
