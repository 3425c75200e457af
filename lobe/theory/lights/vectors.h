/* Vectors of three doubles. */
#ifndef BURNISH_THEORY_VECTORS_H
#define BURNISH_THEORY_VECTORS_H

#include <math.h>

static inline double vector_dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void vector_cross(const double a[3], const double b[3], double product[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double vector_largest(const double a[3]) {
    return fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
}

/* unit can be a. */
static inline void vector_normalize(const double a[3], double unit[3]) {
    double largest = vector_largest(a);
    double scaled[3] = {a[0] / largest, a[1] / largest, a[2] / largest};
    double length = sqrt(vector_dot(scaled, scaled));
    for (int i = 0; i < 3; ++i) {
        unit[i] = scaled[i] / length;
    }
}

/* Whether it is finite and has a length. */
static inline int vector_is_direction(const double a[3]) {
    double size = fabs(a[0]) + fabs(a[1]) + fabs(a[2]);
    return size > 0 && size < HUGE_VAL;
}

#endif
