// lighting/common/burnishHalfCosine.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishInverseSqrt.wgsl"

// N.H of Blinn's model from three cosines of unit vectors: no half vector, no second normalisation.
fn burnishHalfCosine(NoL: f32, NoV: f32, LoV: f32) -> f32 {
    let squared = max(2.0 + 2.0 * LoV, 0.00000095367431640625);
    let sum = NoL + NoV;
    return sum * burnishInverseSqrt(squared);
}
