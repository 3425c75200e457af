// lighting/area/burnishAreaLight.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "burnishEdge.hlsl"
#include "burnishGgx.hlsl"

#ifndef FNC_LIGHTING_AREA_BURNISH_AREA_LIGHT
#define FNC_LIGHTING_AREA_BURNISH_AREA_LIGHT

// The light of a parallelogram or an ellipse of radiance 1 as vec2(diffuse, specular):
//   diffuse   1 / pi times the integral of max(0, N.w) over the light, at most 1
//   specular  its mean under a lobe: 1 where the light fills the lobe
// Both leave out what is below the horizon of N. The corners are center +- halfU +- halfV, seen from
// the surface; N, R and V have unit length. The light shines to the side of cross(halfU, halfV): sides
// is 1, or 2 if it shines to both.

// The specular part of an edge, 2 pi times too large. s is R.n; lobe is burnishGgxLobes'.
float burnishEdgeSpecular(float3 a, float3 b, float3 n, float s, float3 R, float3 lobe, int order) {
    float3 nearest = R - n * s;
    float k = sqrt(dot(nearest, nearest));
    if (k < 0.0001) { // R is n: all directions are as near
        k = 0.0001;
        nearest = a;
    }
    nearest = nearest * rsqrt(max(dot(nearest, nearest), 1.0e-30));
    float3 across = cross(n, nearest);
    float lengthA = rsqrt(max(dot(a, a), 1.0e-30));
    float lengthB = rsqrt(max(dot(b, b), 1.0e-30));
    float xa = dot(a, nearest) * lengthA;
    float ya = dot(a, across) * lengthA;
    float xb = dot(b, nearest) * lengthB;
    float yb = dot(b, across) * lengthB;
    float result = burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.x, order);
    if (lobe.z > 0.0) {
        result = result + lobe.z * (burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.y, 1) - result);
    }
    return result;
}

// A regular polygon in the coordinates of halfU and halfV: 4 corners at (+-1, +-1), or 12 around a disc
// with its area. The lobes are seen through the map p + across (across.p) stretch.
float2 burnishRegularLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                           float3 R, float3 across, float stretch, float3 lobe, int order, int corners) {
    float3 up = halfV;
    float side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    float2 at = float2(1.0, 1.0);
    float2 turn = float2(0.0, 1.0);
    if (corners == 12) {
        at = float2(1.02332671, 0.0);
        turn = float2(0.866025404, 0.5);
    }
    float3 a = center + halfU * at.x + up * at.y;
    float3 leaves = N;
    float3 enters = N;
    float isCut = 0.0;
    float diffuse = 0.0;
    float specular = 0.0;
    for (int i = 0; i < corners + 1; i = i + 1) {
        float2 next = float2(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        float3 edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        float3 b = a + edge;
        float3 start = a;
        float3 end = b;
        float3 n = cross(a, edge);
        float3 m = cross(a + across * (stretch * dot(a, across)),
                         edge + across * (stretch * dot(edge, across)));
        float heightA = dot(a, N);
        float heightB = dot(b, N);
        float isUp = step(0.0, max(heightA, heightB));
        if (i == corners) { // what the horizon cuts off is replaced by an edge along it
            start = leaves;
            end = enters;
            n = N;
            m = N;
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
            n = n * rsqrt(max(dot(n, n), 1.0e-30));
            diffuse = diffuse + burnishEdgeDiffuse(start, end, n, N);
            m = m * rsqrt(max(dot(m, m), 1.0e-30));
            start = start + across * (stretch * dot(start, across));
            end = end + across * (stretch * dot(end, across));
            specular = specular + burnishEdgeSpecular(start, end, m, dot(m, R), R, lobe, order);
        }
        a = b;
        at = next;
    }
    float2 light = float2(clamp(diffuse * 0.159154943, 0.0, 1.0), clamp(specular * 0.159154943,
                          0.0, 1.0));
    if (side == 0.0 || (sides == 1 && side > 0.0)) { // edge on, without area, or from behind
        light = float2(0.0, 0.0);
    }
    return light;
}

// Under the lobe of order 1, 2, 4 or 8 and slope zeta >= 1 around R.
float2 burnishRectLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N, float3 R,
                        float zeta, int order) {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, float3(zeta, zeta, 0.0),
                               order, 4);
}

float2 burnishDiscLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N, float3 R,
                        float zeta, int order) {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, float3(zeta, zeta, 0.0),
                               order, 12);
}

// Under GGX, seen from V. Multiply the specular part by F0 x + y of burnishGgxAlbedo.
float2 burnishRectLightGgx(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                           float3 V, float roughness) {
    float3 R = burnishGgxAxis(N, V, roughness);
    float3 across = burnishGgxAcross(N, V);
    float stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 4);
}

float2 burnishDiscLightGgx(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                           float3 V, float roughness) {
    float3 R = burnishGgxAxis(N, V, roughness);
    float3 across = burnishGgxAcross(N, V);
    float stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 12);
}

#endif
