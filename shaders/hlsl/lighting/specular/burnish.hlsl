// lighting/specular/burnish.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../common/burnishLobe.hlsl"
#include "../common/burnishZeta.hlsl"
#include "../common/burnishNormalization.hlsl"
#include "../common/burnishExponent.hlsl"

#ifndef FNC_LIGHTING_SPECULAR_BURNISH
#define FNC_LIGHTING_SPECULAR_BURNISH

// The highlight without pow in one function: the lobe of order 2 with the energy of NoH^shininess,
// shininess in [1, 65536].
float specularBurnish(float NoH, float shininess) {
    return burnishLobe2(NoH, burnishZetaEnergy(shininess, 2.0));
}

// The same with the integral 1 over the solid angle.
float specularBurnishNormalized(float NoH, float shininess) {
    float zeta = burnishZetaEnergy(shininess, 2.0);
    return burnishNormalizeLobe(zeta, 2.0) * burnishLobe2(NoH, zeta);
}

#ifdef STR_SHADING_DATA
// For LYGIA's specular(): #define SPECULAR_FNC specularBurnish
float specularBurnish(ShadingData shadingData) {
    return specularBurnish(shadingData.NoH, burnishExponentFromRoughness(shadingData.roughness));
}
#endif

#endif
