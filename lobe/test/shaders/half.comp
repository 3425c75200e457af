// One lobe in half precision at all 65,536 cosines; half.glsl is written by lobe/scripts/shaders --half.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require
#include "half.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Values { float values[]; };
layout(push_constant) uniform Constants {
    float zeta;
    int number;
};

void main() {
    uint i = gl_GlobalInvocationID.x;
    float16_t c = float16_t(unpackHalf2x16(i).x);
    float16_t z = float16_t(zeta);
    float16_t value = burnishLobe2(c, z);
    if (number == 1) { value = burnishLobe4(c, z); }
    if (number == 2) { value = burnishLobe8(c, z); }
    if (number == 3) { value = burnishLobe16(c, z); }
    if (number == 4) { value = burnishLobe32(c, z); }
    values[i] = float(value);
}
