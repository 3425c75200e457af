// lighting/common/burnishExponent.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// From roughness to the exponent n and back. alpha is Beckmann's or GGX's width; roughness is its
// square root, as in glTF and most engines.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007.
fn burnishExponentFromAlpha(alpha: f32) -> f32 {
    return 2.0 / (alpha * alpha) - 2.0;
}

fn burnishAlphaFromExponent(n: f32) -> f32 {
    return sqrt(2.0 / (n + 2.0));
}

// n in [1, 65536], the range of the lobes: a mirror's is infinite.
fn burnishExponentFromRoughness(roughness: f32) -> f32 {
    let alpha = max(roughness * roughness, 0.0055);
    return clamp(burnishExponentFromAlpha(alpha), 1.0, 65536.0);
}

fn burnishRoughnessFromExponent(n: f32) -> f32 {
    return sqrt(burnishAlphaFromExponent(n));
}

// The exponent of Phong's R.V whose highlight is about as wide as Blinn's N.H with n, and back.
fn burnishPhongFromBlinn(n: f32) -> f32 {
    return 0.25 * n;
}

fn burnishBlinnFromPhong(n: f32) -> f32 {
    return 4.0 * n;
}

// The exponent for the mean of unit normals with that length, from a filtered normal map.
// Source: Toksvig, Mipmapping Normal Maps, 2005.
fn burnishToksvigExponent(n: f32, meanLength: f32) -> f32 {
    let l = clamp(meanLength, 0.0, 1.0);
    return n * l / (l + n * (1.0 - l));
}
