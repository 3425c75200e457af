// What the shaders take of their languages' libraries, in C++, to run them on a CPU.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "vectors.h"

#define precise
typedef unsigned int uint;
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
inline float rsqrt(float x) {
    return 1.0f / std::sqrt(x);
}
inline float inversesqrt(float x) {
    return rsqrt(x);
}
template <class To, class From> To as_type(From from) {
    To to;
    static_assert(sizeof to == sizeof from, "as_type");
    std::memcpy(&to, &from, sizeof to);
    return to;
}
inline float asfloat(uint bits) {
    return as_type<float>(bits);
}
inline uint asuint(float x) {
    return as_type<uint>(x);
}
inline float uintBitsToFloat(uint bits) {
    return as_type<float>(bits);
}
inline uint floatBitsToUint(float x) {
    return as_type<uint>(x);
}
