// The part of OSL that shaders/burnish.osl uses, in C++, to run it on a CPU.
#include <algorithm>
#include <cmath>

#include "vectors.h"

typedef float3 vector;
using std::abs;
using std::exp2;
using std::max;
using std::min;
using std::pow;
using std::sqrt;
inline float step(float edge, float x) {
    return x < edge ? 0.0f : 1.0f;
}
inline float clamp(float x, float low, float high) {
    return std::min(std::max(x, low), high);
}
inline float inversesqrt(float x) {
    return 1.0f / std::sqrt(x);
}
