/* Constants, and tests for finite numbers without libm. */
#ifndef BURNISH_BASE_NUMBERS_H
#define BURNISH_BASE_NUMBERS_H

#include <float.h>
#include <stdint.h>

#define BURNISH_PI 3.14159265358979323846
#define BURNISH_DEGREE (BURNISH_PI / 180) /* in radians */

static inline int burnish_is_finite(double x) {
    return x >= -DBL_MAX && x <= DBL_MAX;
}
static inline int burnish_is_finitef(float x) {
    return x >= -FLT_MAX && x <= FLT_MAX;
}
/* The same for a float's bits. */
static inline int burnish_is_finite_bits(uint32_t bits) {
    return (bits & 0x7F800000u) != 0x7F800000u;
}

#endif
