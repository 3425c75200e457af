// lighting/common/burnishExponent.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_EXPONENT
#define FNC_LIGHTING_COMMON_BURNISH_EXPONENT

// From roughness to the exponent n and back. alpha is Beckmann's or GGX's width; roughness is its
// square root, as in glTF and most engines.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007.
float burnishExponentFromAlpha(float alpha) {
    return 2.0 / (alpha * alpha) - 2.0;
}

float burnishAlphaFromExponent(float n) {
    return sqrt(2.0 / (n + 2.0));
}

// n in [1, 65536], the range of the lobes: a mirror's is infinite.
float burnishExponentFromRoughness(float roughness) {
    float alpha = max(roughness * roughness, 0.0055);
    return clamp(burnishExponentFromAlpha(alpha), 1.0, 65536.0);
}

float burnishRoughnessFromExponent(float n) {
    return sqrt(burnishAlphaFromExponent(n));
}

// The exponent of Phong's R.V whose highlight is about as wide as Blinn's N.H with n, and back.
float burnishPhongFromBlinn(float n) {
    return 0.25 * n;
}

float burnishBlinnFromPhong(float n) {
    return 4.0 * n;
}

// The exponent for the mean of unit normals with that length, from a filtered normal map.
// Source: Toksvig, Mipmapping Normal Maps, 2005.
float burnishToksvigExponent(float n, float meanLength) {
    float l = clamp(meanLength, 0.0, 1.0);
    return n * l / (l + n * (1.0 - l));
}

#endif
