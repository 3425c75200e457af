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

// The share F0 x + y of white light that GGX reflects: polynomials fitted to its integrals, without light
// that is reflected more than once. x + y is within 0.04, y within 0.045.
fn burnishGgxAlbedo(NoV: f32, roughness: f32) -> vec2f {
    let r = roughness;
    let q = 1.0 - NoV;
    let q5 = q * q * q * q * q;
    var sum = 1.0 + r * (0.39698 + r * (r * 0.28534 - 1.39467));
    sum = sum + q5 * r * (r * (6.34208 - r * 5.25493) - 1.02413);
    sum = sum + q * r * (0.05344 + r * (1.33749 - r * 1.34041));
    sum = sum + q * q * r * (r * (r * 4.50138 - 3.66818) - 0.32463);
    var y = r * (r * 0.08623 - 0.04109) - 0.03907;

                     y = y + q5 * (1.05434 + r * (r * 2.25303 - 3.16369)) + q * (0.11963 + r * (0.53691 - r * 0.74945));
    return vec2f(sum - max(y, 0.0), max(y, 0.0));
}
