// lighting/specular/burnish.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../common/burnishLobe.wgsl"
#include "../common/burnishZeta.wgsl"
#include "../common/burnishNormalization.wgsl"
#include "../common/burnishExponent.wgsl"

// The highlight without pow in one function: the lobe of order 2 with the energy of NoH^shininess,
// shininess in [1, 65536].
fn specularBurnish(NoH: f32, shininess: f32) -> f32 {
    return burnishLobe2(NoH, burnishZetaEnergy(shininess, 2.0));
}

// The same with the integral 1 over the solid angle.
fn specularBurnishNormalized(NoH: f32, shininess: f32) -> f32 {
    let zeta = burnishZetaEnergy(shininess, 2.0);
    return burnishNormalizeLobe(zeta, 2.0) * burnishLobe2(NoH, zeta);
}
