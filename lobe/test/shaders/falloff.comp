// e^-x and composite lobes of x = scale * i, for i = first, first + step, ...: by number, the multiplications of the
// lobe, and 10 more for e^-x.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "burnish.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Constants {
    float top, slope, offset[4], scale;
    int number;
    uint first, step;
};

float value(float x) {
    switch (number) {
    case 13: return burnishExpFalloff3(x);
    case 14: return burnishExpFalloff4(x);
    case 15: return burnishExpFalloff5(x);
    case 3: return burnishCompositeOfLambda3(x, top, slope, offset[0]);
    case 4: return burnishCompositeOfLambda4(x, top, slope, offset[0], offset[1]);
    case 5: return burnishCompositeOfLambda5(x, top, slope, offset[0], offset[1], offset[2]);
    }
    return burnishCompositeOfLambda6(x, top, slope, offset[0], offset[1], offset[2], offset[3]);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    values[i] = value(scale * float(first + step * i));
}
