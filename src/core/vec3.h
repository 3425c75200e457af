/* Three-vectors in double precision, for set-up work. */
#ifndef BURNISH_CORE_VEC3_H
#define BURNISH_CORE_VEC3_H

#include "base/elementary.h"

typedef struct burnish_vec3 {
    double x, y, z;
} burnish_vec3;

static inline burnish_vec3 burnish_vec3_load(const double v[3]) {
    return (burnish_vec3){v[0], v[1], v[2]};
}
static inline burnish_vec3 burnish_vec3_loadf(const float v[3]) {
    return (burnish_vec3){v[0], v[1], v[2]};
}
static inline void burnish_vec3_store(burnish_vec3 a, double v[3]) {
    v[0] = a.x;
    v[1] = a.y;
    v[2] = a.z;
}
static inline burnish_vec3 burnish_vec3_add(burnish_vec3 a, burnish_vec3 b) {
    return (burnish_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline burnish_vec3 burnish_vec3_sub(burnish_vec3 a, burnish_vec3 b) {
    return (burnish_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline burnish_vec3 burnish_vec3_scale(burnish_vec3 a, double s) {
    return (burnish_vec3){a.x * s, a.y * s, a.z * s};
}
static inline double burnish_magnitude(double x) {
    return x < 0 ? -x : x;
}
static inline double burnish_vec3_dot(burnish_vec3 a, burnish_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline burnish_vec3 burnish_vec3_cross(burnish_vec3 a, burnish_vec3 b) {
    return (burnish_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline double burnish_vec3_length(burnish_vec3 a) {
    return __builtin_sqrt(burnish_vec3_dot(a, a)); /* burnish_sqrt, without the call */
}
/* Unit vector along a, or zero when a has no direction. */
static inline burnish_vec3 burnish_vec3_normalize(burnish_vec3 a) {
    double length = burnish_vec3_length(a);
    return length > 0 ? burnish_vec3_scale(a, 1 / length) : (burnish_vec3){0, 0, 0};
}

#endif
