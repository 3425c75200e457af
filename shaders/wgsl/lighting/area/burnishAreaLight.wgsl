// lighting/area/burnishAreaLight.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "burnishEdge.wgsl"

// The light of a parallelogram or an ellipse of radiance 1 as vec2(diffuse, specular):
//   diffuse   1 / pi times the integral of max(0, N.w) over the light, at most 1
//   specular  its mean under the lobe of order m = 2, 4, 8, 16 or 32 and slope zeta >= 1 around R:
//             1 where the light fills the lobe
// Both leave out what is below the horizon of N. The corners are center +- halfU +- halfV, seen from the
// surface; N and R have unit length. The light shines to the side of cross(halfU, halfV): sides is 1,
// or 2 if it shines to both.

// The two parts of an edge, of which diffuse is 2 pi and specular 2 pi times too large. s is R.n.
fn burnishEdgeLight(a: vec3f, b: vec3f, n: vec3f, s: f32, N: vec3f, R: vec3f, zeta: f32,
                    order: i32) -> vec2f {
    var nearest = R - n * s;
    let k = max(sqrt(dot(nearest, nearest)), 0.0001);
    nearest = nearest * (1.0 / k);
    let across = cross(n, nearest);
    let lengthA = inverseSqrt(max(dot(a, a), 1.0e-30));
    let lengthB = inverseSqrt(max(dot(b, b), 1.0e-30));
    let xa = dot(a, nearest) * lengthA;
    let ya = dot(a, across) * lengthA;
    let xb = dot(b, nearest) * lengthB;
    let yb = dot(b, across) * lengthB;
    return vec2f(burnishEdgeDiffuse(a, b, n, N), burnishEdgeLobe(s, k, xa, ya, xb, yb, zeta,
                 order));
}

// A regular polygon of `count` corners in the coordinates of halfU and halfV: `corner`, and that
// turned again and again by `turn`, (cosine, sine).
fn burnishRegularLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                       zeta: f32, order: i32, corner: vec2f, turn: vec2f, count: i32) -> vec2f {
    var up = halfV;
    let side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    var at = corner;
    var a = center + halfU * at.x + up * at.y;
    var leaves = N;
    var enters = N;
    var isCut = 0.0;
    var isSeen = 0.0;
    var isInside = 1.0;
    var sum = vec2f(0.0, 0.0);
    for (var i: i32 = 0; i < count + 1; i = i + 1) {
        let next = vec2f(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        let edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        let b = a + edge;
        var start = a;
        var end = b;
        var n = cross(a, edge);
        n = n * inverseSqrt(max(dot(n, n), 1.0e-30));
        let heightA = dot(a, N);
        let heightB = dot(b, N);
        var isUp = step(0.0, max(heightA, heightB));
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
            var s = dot(n, R);
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
    let diffuse = clamp(sum.x * 0.159154943, 0.0, 1.0);
    let specular = clamp(isInside + sum.y * 0.159154943, 0.0, 1.0);
    return vec2f(isSeen * diffuse, isSeen * specular);
}

fn burnishRectLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                    zeta: f32, order: i32) -> vec2f {
    let corner = vec2f(1.0, 1.0);
    let turn = vec2f(0.0, 1.0);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, zeta, order, corner, turn, 4);
}

// The disc is a polygon of 12 corners with its area.
fn burnishDiscLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                    zeta: f32, order: i32) -> vec2f {
    let corner = vec2f(1.02332671, 0.0);
    let turn = vec2f(0.866025404, 0.5);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, zeta, order, corner, turn, 12);
}
