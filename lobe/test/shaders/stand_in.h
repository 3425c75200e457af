// The shaders for Metal, GLSL, HLSL or OSL (-DMETAL ...) as C++, and what their tests share. All of them are C++ and C but
// for their vectors and libraries; no compiler of Metal or OSL runs on Linux or is in Debian.
#ifndef BURNISH_TEST_STAND_IN_H
#define BURNISH_TEST_STAND_IN_H

#include "library.h"

#ifdef OSL
typedef float3 vector;
typedef vector vec2;
typedef vector vec3;
#include "burnish.osl"
#else
#define BURNISH_EXACT
typedef float2 vec2;
typedef float3 vec3;
#ifdef METAL
#include "burnish.metal"
#elif defined GLSL
#include "burnish.glsl"
#else
#include "burnish.hlsl"
#endif
typedef float3 vector;
#endif
#include "area.glsl"
#include "area.h"
#include "burnish/theory.h"
#include "values.glsl"

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
