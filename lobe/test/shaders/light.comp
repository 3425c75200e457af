// Points, shaded as the CPU's kernels do: Blinn, a near viewer, distant lights.
#version 450
#extension GL_GOOGLE_include_directive : require
#define BURNISH_EXACT
#include "burnish.glsl"
layout(local_size_x = 64) in;
struct Light {
    float vector[3], diffuse[3], specular[3];
};
layout(std430, binding = 0) readonly buffer Points { float points[]; }; // arrays: normal, position, w
layout(std430, binding = 1) writeonly buffer Colors { float colors[]; };
layout(std430, binding = 2) readonly buffer Lights { Light lights[]; };
layout(push_constant) uniform Constants {
    float viewer[3], ambient[3];
    float zeta;
    int order, lightCount;
    uint count;
};

vec3 vector(float at[3]) { return vec3(at[0], at[1], at[2]); }

vec3 point(uint i, uint first) {
    return vec3(points[first * count + i], points[(first + 1) * count + i], points[(first + 2) * count + i]);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) {
        return;
    }
    precise vec3 toViewer = vector(viewer) * points[6 * count + i] - point(i, 3);
    vec3 V = toViewer * burnishInverseSqrt(burnishDot(toViewer, toViewer));
    precise vec3 diffuse = vector(ambient);
    precise vec3 specular = vec3(0.0);
    for (int l = 0; l < lightCount; ++l) {
        vec2 weights = burnishLit(point(i, 0), vector(lights[l].vector), V, zeta, order);
        diffuse += weights.x * vector(lights[l].diffuse);
        specular += weights.y * vector(lights[l].specular);
    }
    precise vec3 color = max(diffuse + specular, 0.0);
    colors[i] = color.x;
    colors[count + i] = color.y;
    colors[2 * count + i] = color.z;
}
