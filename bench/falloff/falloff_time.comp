// Sums 256 values of FALLOFF(x), a macro, in each invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "burnish.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Values { float values[]; };

float expOf(float x) { return exp(-x); }

// e^-x as 2^t: the whole part of t as bits of the exponent, a cubic for the rest, relative error 0.0001.
float expByBits(float x) {
    float t = max(-1.44269504 * x, -126.0);
    float whole = floor(t);
    float f = t - whole;
    float p = 1.0 + f * (0.69542435 + f * (0.22630768 + f * 0.07826797));
    return intBitsToFloat(floatBitsToInt(p) + (int(whole) << 23));
}

#define FOUR(x) (FALLOFF(x) + FALLOFF(x + 0.03125) + FALLOFF(x + 0.0625) + FALLOFF(x + 0.09375))

void main() {
    uint i = gl_GlobalInvocationID.x;
    float x = float(i) * 9.5367431640625e-07;
    float sum = 0.0;
    for (int k = 0; k < 16; ++k) {
        sum += FOUR(x) + FOUR(x + 0.125) + FOUR(x + 0.25) + FOUR(x + 0.375);
        x += 0.5;
    }
    values[i] = sum;
}
