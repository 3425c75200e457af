// lighting/area/burnishAreaLight.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "burnishEdge.glsl"

#ifndef FNC_LIGHTING_AREA_BURNISH_AREA_LIGHT
#define FNC_LIGHTING_AREA_BURNISH_AREA_LIGHT

// The light of a parallelogram or an ellipse of radiance 1 as vec2(diffuse, specular):
//   diffuse   1 / pi times the integral of max(0, N.w) over the light, at most 1
//   specular  its mean under the lobe of order m = 2, 4, 8, 16 or 32 and slope zeta >= 1 around R:
//             1 where the light fills the lobe
// Both leave out what is below the horizon of N. The corners are center +- halfU +- halfV, seen from the
// surface; N and R have unit length. The light shines to the side of cross(halfU, halfV): sides is 1,
// or 2 if it shines to both.

// The two parts of an edge, of which diffuse is 2 pi and specular 2 pi times too large. s is R.n.
vec2 burnishEdgeLight(vec3 a, vec3 b, vec3 n, float s, vec3 N, vec3 R, float zeta, int order) {
    vec3 nearest = R - n * s;
    float k = max(sqrt(dot(nearest, nearest)), 0.0001);
    nearest = nearest * (1.0 / k);
    vec3 across = cross(n, nearest);
    float lengthA = inversesqrt(max(dot(a, a), 1.0e-30));
    float lengthB = inversesqrt(max(dot(b, b), 1.0e-30));
    float xa = dot(a, nearest) * lengthA;
    float ya = dot(a, across) * lengthA;
    float xb = dot(b, nearest) * lengthB;
    float yb = dot(b, across) * lengthB;
    return vec2(burnishEdgeDiffuse(a, b, n, N), burnishEdgeLobe(s, k, xa, ya, xb, yb, zeta, order));
}

// A regular polygon of `count` corners in the coordinates of halfU and halfV: `corner`, and that
// turned again and again by `turn`, (cosine, sine).
vec2 burnishRegularLight(vec3 center, vec3 halfU, vec3 halfV, int sides, vec3 N, vec3 R,
                         float zeta, int order, vec2 corner, vec2 turn, int count) {
    vec3 up = halfV;
    float side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    vec2 at = corner;
    vec3 a = center + halfU * at.x + up * at.y;
    vec3 leaves = N;
    vec3 enters = N;
    float isCut = 0.0;
    float isSeen = 0.0;
    float isInside = 1.0;
    vec2 sum = vec2(0.0, 0.0);
    for (int i = 0; i < count + 1; i = i + 1) {
        vec2 next = vec2(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        vec3 edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        vec3 b = a + edge;
        vec3 start = a;
        vec3 end = b;
        vec3 n = cross(a, edge);
        n = n * inversesqrt(max(dot(n, n), 1.0e-30));
        float heightA = dot(a, N);
        float heightB = dot(b, N);
        float isUp = step(0.0, max(heightA, heightB));
        if (i == count) { // what the horizon cuts off is replaced by an edge along it
            start = leaves;
            end = enters;
            n = N;
            isUp = isCut;
        } else {
            if (heightA < 0.0 && heightB >= 0.0) {
                start = a + edge * (heightA / (heightA - heightB));
                enters = start;
            }
            if (heightA >= 0.0 && heightB < 0.0) {
                end = a + edge * (heightA / (heightA - heightB));
                leaves = end;
                isCut = 1.0;
            }
        }
        if (isUp > 0.0) {
            float s = dot(n, R);
            if (s < 0.0) {
                isInside = 0.0;
            }
            if (abs(s) < 1.0e-15) {
                s = 1.0e-15;
            }
            isSeen = 1.0;
            sum = sum + burnishEdgeLight(start, end, n, s, N, R, zeta, order);
        }
        a = b;
        at = next;
    }
    if (sides == 1 && side >= 0.0) {
        isSeen = 0.0;
    }
    float diffuse = clamp(sum.x * 0.159154943, 0.0, 1.0);
    float specular = clamp(isInside + sum.y * 0.159154943, 0.0, 1.0);
    return vec2(isSeen * diffuse, isSeen * specular);
}

vec2 burnishRectLight(vec3 center, vec3 halfU, vec3 halfV, int sides, vec3 N, vec3 R, float zeta,
                      int order) {
    vec2 corner = vec2(1.0, 1.0);
    vec2 turn = vec2(0.0, 1.0);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, zeta, order, corner, turn, 4);
}

// The disc is a polygon of 12 corners with its area.
vec2 burnishDiscLight(vec3 center, vec3 halfU, vec3 halfV, int sides, vec3 N, vec3 R, float zeta,
                      int order) {
    vec2 corner = vec2(1.02332671, 0.0);
    vec2 turn = vec2(0.866025404, 0.5);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, zeta, order, corner, turn, 12);
}

#endif
