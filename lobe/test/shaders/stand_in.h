// The shaders for Metal (-DMETAL) or OSL as C++, and what their tests share. No compiler of either language runs on Linux
// or is in Debian; both are C++ and C but for their vectors.
#ifndef BURNISH_TEST_STAND_IN_H
#define BURNISH_TEST_STAND_IN_H

#ifdef METAL
#define BURNISH_EXACT
#include "burnish.metal"
typedef float3 vector;
#else
#include "osl_stdlib.h"
// after it, which has vector
#include "burnish.osl"
#endif
#include "burnish/theory.h"
#include "values.glsl"
#ifdef METAL
typedef float2 vec2;
#else
typedef vector vec2;
#endif
typedef vector vec3;
#include "area.glsl"
#include "area.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

static int checks, failures;

static void check(bool good, const char *what, double actual, double expected) {
    ++checks;
    if (!good && ++failures < 20) {
        std::printf("%s: %.9g, expected %.9g\n", what, actual, expected);
    }
}

static void check_near(const char *what, double actual, double expected, double relative) {
    check(std::fabs(actual - expected) <= relative * std::fabs(expected), what, actual, expected);
}

static bool same_bits(float a, float b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

static inline double solve(burnish_lobe_fit fit, int order, double n, double q) {
    burnish_lobe_spec spec = {};
    double zeta = 0, scale = 0;
    spec.fit = fit;
    spec.order = order;
    spec.parameter = q;
    burnish_lobe_solve(&spec, n, &zeta, &scale);
    return zeta;
}

#endif
