// lighting/common/burnishReflectCosine.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// R.V of Phong's model, R being L mirrored at N, from three cosines of unit vectors.
fn burnishReflectCosine(NoL: f32, NoV: f32, LoV: f32) -> f32 {
    let cosine = (2.0 * NoL) * NoV - LoV;
    return cosine;
}
