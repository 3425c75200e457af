// The light of the lines of lobe/test/data/area.csv.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "burnish.glsl"
#include "area.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Cases { float cases[]; };
layout(std430, binding = 1) writeonly buffer Values { vec2 values[]; };

vec3 at(uint i) { return vec3(cases[i], cases[i + 1], cases[i + 2]); }

void main() {
    uint i = gl_GlobalInvocationID.x * 21;
    values[gl_GlobalInvocationID.x] = areaLight(int(cases[i]), int(cases[i + 1]), int(cases[i + 2]), cases[i + 3], at(i + 4), at(i + 7), at(i + 10), at(i + 13), at(i + 16));
}
