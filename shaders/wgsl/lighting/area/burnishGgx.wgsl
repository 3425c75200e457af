// lighting/area/burnishGgx.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// GGX as lobes: roughness is the square root of its width alpha.

// (zeta of a lobe of order 4, zeta of its tail of order 1, weight of the tail).
// Source: docs/theory.md, fitted to GGX seen from above. Slopes are 0.78 times that, and the axis
// and the stretch are fitted too: least errors of 8,400 random lights over all views.
fn burnishGgxLobes(roughness: f32) -> vec3f {
    let r = max(roughness, 0.03);
    let a = r * r;
    let scale = 0.78 / (a * a);
    let zeta = scale * (0.130873 + a * (0.145536 + a * (0.125278 + a * (0.244102 + a * 0.399355))));
    let tail = scale * (0.045493 + a * (0.060453 + a * (0.474393 + a * (0.793652 - a * 0.361736))));
    let weight = 0.398137 + a * (0.546989 + a * (-2.960546 + a * (6.946654 - a * 3.944059)));
    return vec3f(max(zeta, 1.0), max(tail, 1.0), weight);
}

// The axis of the lobes: rough surfaces reflect more toward N.
fn burnishGgxAxis(N: vec3f, V: vec3f, roughness: f32) -> vec3f {
    let NoV = dot(N, V);
    let R = N * (2.0 * NoV) - V;
    let lean = pow(roughness, 1.7 + 3.3 * max(NoV, 0.0)) * 1.1 * roughness / (roughness + 0.1);
    let axis = R + (N - R) * lean;
    return axis * inverseSqrt(dot(axis, axis));
}

// GGX is narrower across the plane of N and V. A map makes the lobes round: p becomes p + s (s.p) strength,
// s being this unit vector or 0.
fn burnishGgxAcross(N: vec3f, V: vec3f) -> vec3f {
    let across = cross(N, V);
    return across * inverseSqrt(max(dot(across, across), 1.0e-12));
}

fn burnishGgxStretch(NoV: f32, roughness: f32) -> f32 {
    let x = clamp(NoV, 0.03, 1.0);
    let width = x + (1.0 - x) * 1.5 * roughness * roughness * sqrt(roughness);
    return 1.0 / width - 1.0;
}

// The share (x F0 + y) of white light that GGX reflects.
// Source: Karis, Physically Based Shading on Mobile, 2014.
fn burnishGgxAlbedo(NoV: f32, roughness: f32) -> vec2f {
    let x = 1.0 - roughness;
    let y = 0.0425 - 0.0275 * roughness;
    let bend = min(x * x, exp2(-9.28 * NoV)) * x + y;
    return vec2f(1.04 - 0.572 * roughness - 1.04 * bend, 1.04 * bend + 0.022 * roughness - 0.04);
}
