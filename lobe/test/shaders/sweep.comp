// One lobe at the cosines whose bits are first, first + step, ...
#version 450
#extension GL_GOOGLE_include_directive : require
#define BURNISH_EXACT
#include "burnish.glsl"
#include "values.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Constants {
    float zeta, n;
    int number;
    uint first, step;
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    values[i] = lobeByNumber(number, uintBitsToFloat(first + step * i), zeta, n);
}
