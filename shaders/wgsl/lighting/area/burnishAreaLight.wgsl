// lighting/area/burnishAreaLight.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "burnishEdge.wgsl"
#include "burnishGgx.wgsl"

// The light of a parallelogram or an ellipse of radiance 1 as vec2(diffuse, specular):
//   diffuse   1 / pi times the integral of max(0, N.w) over the light, at most 1
//   specular  its mean under a lobe: 1 where the light fills the lobe
// Both leave out what is below the horizon of N. The corners are center +- halfU +- halfV, seen from
// the surface; N, R and V have unit length. The light shines to the side of cross(halfU, halfV): sides
// is 1, or 2 if it shines to both.

// The specular part of an edge, 2 pi times too large. s is R.n; lobe is burnishGgxLobes'.
fn burnishEdgeSpecular(a: vec3f, b: vec3f, n: vec3f, s: f32, R: vec3f, lobe: vec3f,
                       order: i32) -> f32 {
    var nearest = R - n * s;
    var k = sqrt(dot(nearest, nearest));
    if (k < 0.0001) { // R is n: all directions are as near
        k = 0.0001;
        nearest = a;
    }
    nearest = nearest * inverseSqrt(max(dot(nearest, nearest), 1.0e-30));
    let across = cross(n, nearest);
    let lengthA = inverseSqrt(max(dot(a, a), 1.0e-30));
    let lengthB = inverseSqrt(max(dot(b, b), 1.0e-30));
    let xa = dot(a, nearest) * lengthA;
    let ya = dot(a, across) * lengthA;
    let xb = dot(b, nearest) * lengthB;
    let yb = dot(b, across) * lengthB;
    var result = burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.x, order);
    if (lobe.z > 0.0) {
        result = result + lobe.z * (burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.y, 1) - result);
    }
    return result;
}

// A regular polygon in the coordinates of halfU and halfV: 4 corners at (+-1, +-1), or 12 around a disc
// with its area. The lobes are seen through the map p + across (across.p) stretch.
fn burnishRegularLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                       across: vec3f, stretch: f32, lobe: vec3f, order: i32, corners: i32) -> vec2f {
    var up = halfV;
    let side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    var at = vec2f(1.0, 1.0);
    var turn = vec2f(0.0, 1.0);
    if (corners == 12) {
        at = vec2f(1.02332671, 0.0);
        turn = vec2f(0.866025404, 0.5);
    }
    var a = center + halfU * at.x + up * at.y;
    var leaves = N;
    var enters = N;
    var isCut = 0.0;
    var diffuse = 0.0;
    var specular = 0.0;
    for (var i: i32 = 0; i < corners + 1; i = i + 1) {
        let next = vec2f(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        let edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        let b = a + edge;
        var start = a;
        var end = b;
        var n = cross(a, edge);
        var m = cross(a + across * (stretch * dot(a, across)), edge + across * (stretch * dot(edge,
                      across)));
        let heightA = dot(a, N);
        let heightB = dot(b, N);
        var isUp = step(0.0, max(heightA, heightB));
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
            n = n * inverseSqrt(max(dot(n, n), 1.0e-30));
            diffuse = diffuse + burnishEdgeDiffuse(start, end, n, N);
            m = m * inverseSqrt(max(dot(m, m), 1.0e-30));
            start = start + across * (stretch * dot(start, across));
            end = end + across * (stretch * dot(end, across));
            specular = specular + burnishEdgeSpecular(start, end, m, dot(m, R), R, lobe, order);
        }
        a = b;
        at = next;
    }
    var light = vec2f(clamp(diffuse * 0.159154943, 0.0, 1.0), clamp(specular * 0.159154943, 0.0,
                      1.0));
    if (side == 0.0 || (sides == 1 && side > 0.0)) { // edge on, without area, or from behind
        light = vec2f(0.0, 0.0);
    }
    return light;
}

// Under the lobe of order 1, 2, 4 or 8 and slope zeta >= 1 around R.
fn burnishRectLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                    zeta: f32, order: i32) -> vec2f {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, vec3f(zeta, zeta, 0.0),
                               order, 4);
}

fn burnishDiscLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                    zeta: f32, order: i32) -> vec2f {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, vec3f(zeta, zeta, 0.0),
                               order, 12);
}

// Under GGX, seen from V. Multiply the specular part by F0 x + y of burnishGgxAlbedo.
fn burnishRectLightGgx(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, V: vec3f,
                       roughness: f32) -> vec2f {
    let R = burnishGgxAxis(N, V, roughness);
    let across = burnishGgxAcross(N, V);
    let stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 4);
}

fn burnishDiscLightGgx(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, V: vec3f,
                       roughness: f32) -> vec2f {
    let R = burnishGgxAxis(N, V, roughness);
    let across = burnishGgxAcross(N, V);
    let stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 12);
}
