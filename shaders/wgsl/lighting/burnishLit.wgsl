// lighting/burnishLit.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../math/burnishDot.wgsl"
#include "../math/burnishInverseSqrt.wgsl"
#include "common/burnishHalfCosine.wgsl"
#include "common/burnishReflectCosine.wgsl"

// The weights of a light's diffuse and specular colour, (max(0, N.L), lobe), of order 2, 4, 8, 16
// or 32. N may have any length, such as an interpolated normal; L and V point away from the
// surface and have unit length.
fn burnishLitByCosine(NoL: f32, cosine: f32, zeta: f32, order: i32) -> vec2f {
    let base = cosine * zeta + (1.0 - zeta);
    var lobe = 0.0;
    if (NoL > 0.0) {
        lobe = clamp(base, 0.0, 1.0);
    }
    lobe = lobe * lobe;
    if (order >= 4) {
        lobe = lobe * lobe;
    }
    if (order >= 8) {
        lobe = lobe * lobe;
    }
    if (order >= 16) {
        lobe = lobe * lobe;
    }
    if (order >= 32) {
        lobe = lobe * lobe;
    }
    return vec2f(max(NoL, 0.0), lobe);
}

// Blinn's model.
fn burnishLit(N: vec3f, L: vec3f, V: vec3f, zeta: f32, order: i32) -> vec2f {
    let inverse = burnishInverseSqrt(burnishDot(N, N));
    let NoL = burnishDot(N, L) * inverse;
    let NoV = burnishDot(N, V) * inverse;
    let cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Phong's model.
fn burnishLitPhong(N: vec3f, L: vec3f, V: vec3f, zeta: f32, order: i32) -> vec2f {
    let inverse = burnishInverseSqrt(burnishDot(N, N));
    let NoL = burnishDot(N, L) * inverse;
    let NoV = burnishDot(N, V) * inverse;
    let cosine = burnishReflectCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Blinn's model, L from the surface to a light, of any length.
fn burnishLitPoint(N: vec3f, L: vec3f, V: vec3f, zeta: f32, order: i32) -> vec2f {
    let inverseN = burnishInverseSqrt(burnishDot(N, N));
    let inverseL = burnishInverseSqrt(burnishDot(L, L));
    let NoL = burnishDot(N, L) * (inverseN * inverseL);
    let NoV = burnishDot(N, V) * inverseN;
    let cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V) * inverseL);
    return burnishLitByCosine(NoL, cosine, zeta, order);
}
