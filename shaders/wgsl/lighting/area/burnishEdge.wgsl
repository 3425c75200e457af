// lighting/area/burnishEdge.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishArctangent.wgsl"

// What an edge adds to the light of a polygon: an arc from a to b of the great circle with unit normal n,
// which points into the polygon.

// Lambert's: its sum is 2 times the integral of max(0, N.w).
fn burnishEdgeDiffuse(a: vec3f, b: vec3f, n: vec3f, N: vec3f) -> f32 {
    return burnishArctangent(dot(n, cross(a, b)), dot(a, b)) * dot(n, N);
}

// 1 + u + ... + u^m for m = 1, 2, 4 or 8
fn burnishPowerSum(u: f32, order: i32) -> f32 {
    var sum = 1.0 + u;
    var power = u * u;
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
fn burnishGapPair(gap1: f32, gap2: f32, zeta: f32, order: i32) -> f32 {
    let p1 = burnishPowerSum(max(1.0 - zeta * gap1, 0.0), order);
    let p2 = burnishPowerSum(max(1.0 - zeta * gap2, 0.0), order);
    let q1 = 2.0 - gap1;
    let q2 = 2.0 - gap2;
    return (p1 * q2 + p2 * q1) / (q1 * q2);
}

// Nodes and weights of Gauss and Legendre's rule.
fn burnishGaussNode(i: i32) -> vec2f {
    var node = vec2f(0.183434642, 0.362683783);
    if (i == 1) {
        node = vec2f(0.52553241, 0.313706646);
    }
    if (i == 2) {
        node = vec2f(0.796666477, 0.222381034);
    }
    if (i == 3) {
        node = vec2f(0.960289856, 0.101228536);
    }
    return node;
}

// The lobe's, zeta >= 1: its sum is zeta (m + 1) times the integral of the lobe around R. s is R.n. (xa, ya) and
// (xb, yb) are the ends a and b in the edge's plane: x is the direction nearest to R and k its
// cosine. Outside of the lobe an edge adds the azimuth around R that it sweeps.
// Source: docs/theory.md; Gauss and Legendre's rule with 8 nodes in the tangent of a quarter of the arc.
fn burnishEdgeLobe(s: f32, k: f32, xa: f32, ya: f32, xb: f32, yb: f32, zeta: f32,
                   order: i32) -> f32 {
    let gap = s * s / (1.0 + k);
    let h = min((1.0 / zeta - gap) / k, 0.999); // 1 - cosine of the end of the lobe
    var outside = vec2f(s * s * xa * xb + ya * yb, s * (xa * yb - xb * ya)); // the whole edge
    var inside = 0.0;
    if (h > 0.0 && k > 0.001) {
        let x = 1.0 - h;
        let y = sqrt(h * (2.0 - h));
        var x1 = xa;
        var y1 = ya;
        var x2 = xb;
        var y2 = yb;
        var before = vec2f(1.0, 0.0);
        var after = vec2f(1.0, 0.0);
        var misses = 0.0;
        if (xa <= 0.0 || abs(ya) > y) {
            x1 = x;
            y1 = -y;
            before = vec2f(s * s * xa * x - ya * y, -s * (xa * y + x * ya));
            misses = 1.0;
        }
        if (xb <= 0.0 || abs(yb) > y) {
            x2 = x;
            y2 = y;
            after = vec2f(s * s * x * xb + y * yb, s * (x * yb - xb * y));
            misses = misses + 1.0;
        }
        if (misses < 2.0 || (ya < 0.0 && yb > 0.0)) {
            outside = vec2f(before.x * after.x - before.y * after.y,
                            before.x * after.y + before.y * after.x);
            // the arc's middle, half of its angle, and the tangent of a quarter of its length
            var middle = vec2f(x1 + x2, y1 + y2);
            middle = middle * inverseSqrt(dot(middle, middle));
            var halved = vec2f(1.0 + middle.x, middle.y);
            halved = halved * inverseSqrt(dot(halved, halved));
            let sine = 0.5 * (middle.x * (y2 - y1) - middle.y * (x2 - x1));
            let tangent = sine / (1.0 + middle.x * x2 + middle.y * y2);
            var sum = 0.0;
            for (var i: i32 = 0; i < 4; i = i + 1) {
                let node = burnishGaussNode(i);
                let t = node.x * tangent;
                let inverse = 1.0 / (1.0 + t * t);
                let bend = 2.0 * k * inverse;
                let sine1 = halved.y + halved.x * t;
                let sine2 = halved.y - halved.x * t;
                let gap1 = gap + bend * sine1 * sine1;
                let gap2 = gap + bend * sine2 * sine2;
                sum = sum + node.y * inverse * burnishGapPair(gap1, gap2, zeta, order);
            }
            inside = 2.0 * zeta * s * tangent * sum;
        }
    }
    return inside + burnishArctangent(outside.y, outside.x);
}
