// lighting/area/burnishEdge.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishArctangent.glsl"

#ifndef FNC_LIGHTING_AREA_BURNISH_EDGE
#define FNC_LIGHTING_AREA_BURNISH_EDGE

// What an edge adds to the light of a polygon: an arc from a to b of the great circle with unit normal n,
// which points into the polygon.

// Lambert's: its sum is 2 times the integral of max(0, N.w).
float burnishEdgeDiffuse(vec3 a, vec3 b, vec3 n, vec3 N) {
    return burnishArctangent(dot(n, cross(a, b)), dot(a, b)) * dot(n, N);
}

// 1 + u + ... + u^m for m = 1, 2, 4 or 8
float burnishPowerSum(float u, int order) {
    float sum = 1.0 + u;
    float power = u * u;
    if (order >= 4) {
        sum = sum * (1.0 + power);
        power = power * power;
    }
    if (order >= 8) {
        sum = sum * (1.0 + power);
        power = power * power;
    }
    if (order >= 2) {
        sum = sum + power;
    }
    return sum;
}

// (1 + u + ... + u^m) / (1 + c) at two points of the arc, whose gaps are 1 - c.
float burnishGapPair(float gap1, float gap2, float zeta, int order) {
    float p1 = burnishPowerSum(max(1.0 - zeta * gap1, 0.0), order);
    float p2 = burnishPowerSum(max(1.0 - zeta * gap2, 0.0), order);
    float q1 = 2.0 - gap1;
    float q2 = 2.0 - gap2;
    return (p1 * q2 + p2 * q1) / (q1 * q2);
}

// Nodes and weights of Gauss and Legendre's rule.
vec2 burnishGaussNode(int i) {
    vec2 node = vec2(0.183434642, 0.362683783);
    if (i == 1) {
        node = vec2(0.52553241, 0.313706646);
    }
    if (i == 2) {
        node = vec2(0.796666477, 0.222381034);
    }
    if (i == 3) {
        node = vec2(0.960289856, 0.101228536);
    }
    return node;
}

// The lobe's, zeta >= 1: its sum is zeta (m + 1) times the integral of the lobe around R. s is R.n. (xa, ya) and
// (xb, yb) are the ends a and b in the edge's plane: x is the direction nearest to R and k its
// cosine. Outside of the lobe an edge adds the azimuth around R that it sweeps.
// Source: docs/theory.md; Gauss and Legendre's rule with 8 nodes in the tangent of a quarter of the arc.
float burnishEdgeLobe(float s, float k, float xa, float ya, float xb, float yb, float zeta,
                      int order) {
    float gap = s * s / (1.0 + k);
    float h = min((1.0 / zeta - gap) / k, 0.999); // 1 - cosine of the end of the lobe
    vec2 outside = vec2(s * s * xa * xb + ya * yb, s * (xa * yb - xb * ya)); // the whole edge
    float inside = 0.0;
    if (h > 0.0 && k > 0.001) {
        float x = 1.0 - h;
        float y = sqrt(h * (2.0 - h));
        float x1 = xa;
        float y1 = ya;
        float x2 = xb;
        float y2 = yb;
        vec2 before = vec2(1.0, 0.0);
        vec2 after = vec2(1.0, 0.0);
        float misses = 0.0;
        if (xa <= 0.0 || abs(ya) > y) {
            x1 = x;
            y1 = -y;
            before = vec2(s * s * xa * x - ya * y, -s * (xa * y + x * ya));
            misses = 1.0;
        }
        if (xb <= 0.0 || abs(yb) > y) {
            x2 = x;
            y2 = y;
            after = vec2(s * s * x * xb + y * yb, s * (x * yb - xb * y));
            misses = misses + 1.0;
        }
        if (misses < 2.0 || (ya < 0.0 && yb > 0.0)) {
            outside = vec2(before.x * after.x - before.y * after.y,
                           before.x * after.y + before.y * after.x);
            // the arc's middle, half of its angle, and the tangent of a quarter of its length
            vec2 middle = vec2(x1 + x2, y1 + y2);
            middle = middle * inversesqrt(dot(middle, middle));
            vec2 halved = vec2(1.0 + middle.x, middle.y);
            halved = halved * inversesqrt(dot(halved, halved));
            float sine = 0.5 * (middle.x * (y2 - y1) - middle.y * (x2 - x1));
            float tangent = sine / (1.0 + middle.x * x2 + middle.y * y2);
            float sum = 0.0;
            for (int i = 0; i < 4; i = i + 1) {
                vec2 node = burnishGaussNode(i);
                float t = node.x * tangent;
                float inverse = 1.0 / (1.0 + t * t);
                float bend = 2.0 * k * inverse;
                float sine1 = halved.y + halved.x * t;
                float sine2 = halved.y - halved.x * t;
                float gap1 = gap + bend * sine1 * sine1;
                float gap2 = gap + bend * sine2 * sine2;
                sum = sum + node.y * inverse * burnishGapPair(gap1, gap2, zeta, order);
            }
            inside = 2.0 * zeta * s * tangent * sum;
        }
    }
    return inside + burnishArctangent(outside.y, outside.x);
}

#endif
