// lighting/area/burnishAreaLight.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "burnishEdge.hlsl"

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
float2 burnishEdgeLight(float3 a, float3 b, float3 n, float s, float3 N, float3 R, float zeta,
                        int order) {
    float3 nearest = R - n * s;
    float k = max(sqrt(dot(nearest, nearest)), 0.0001);
    nearest = nearest * (1.0 / k);
    float3 across = cross(n, nearest);
    float lengthA = rsqrt(max(dot(a, a), 1.0e-30));
    float lengthB = rsqrt(max(dot(b, b), 1.0e-30));
    float xa = dot(a, nearest) * lengthA;
    float ya = dot(a, across) * lengthA;
    float xb = dot(b, nearest) * lengthB;
    float yb = dot(b, across) * lengthB;
    return float2(burnishEdgeDiffuse(a, b, n, N), burnishEdgeLobe(s, k, xa, ya, xb, yb, zeta,
                  order));
}

// A regular polygon of `count` corners in the coordinates of halfU and halfV: `corner`, and that
// turned again and again by `turn`, (cosine, sine).
float2 burnishRegularLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                           float3 R, float zeta, int order, float2 corner, float2 turn, int count) {
    float3 up = halfV;
    float side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    float2 at = corner;
    float3 a = center + halfU * at.x + up * at.y;
    float3 leaves = N;
    float3 enters = N;
    float isCut = 0.0;
    float isSeen = 0.0;
    float isInside = 1.0;
    float2 sum = float2(0.0, 0.0);
    for (int i = 0; i < count + 1; i = i + 1) {
        float2 next = float2(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        float3 edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        float3 b = a + edge;
        float3 start = a;
        float3 end = b;
        float3 n = cross(a, edge);
        n = n * rsqrt(max(dot(n, n), 1.0e-30));
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
    return float2(isSeen * diffuse, isSeen * specular);
}

float2 burnishRectLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N, float3 R,
                        float zeta, int order) {
    float2 corner = float2(1.0, 1.0);
    float2 turn = float2(0.0, 1.0);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, zeta, order, corner, turn, 4);
}

// The disc is a polygon of 12 corners with its area.
float2 burnishDiscLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N, float3 R,
                        float zeta, int order) {
    float2 corner = float2(1.02332671, 0.0);
    float2 turn = float2(0.866025404, 0.5);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, zeta, order, corner, turn, 12);
}

#endif
