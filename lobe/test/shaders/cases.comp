// The lobes of an array of cases.
#version 450
#extension GL_GOOGLE_include_directive : require
#define BURNISH_EXACT
#include "burnish.glsl"
#include "values.glsl"
layout(local_size_x = 64) in;
struct Case {
    float cosine, zeta, n;
    int number;
};
layout(std430, binding = 0) readonly buffer Cases { Case cases[]; };
layout(std430, binding = 1) writeonly buffer Values { float values[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    Case one = cases[i];
    values[i] = lobeByNumber(one.number, one.cosine, one.zeta, one.n);
}
