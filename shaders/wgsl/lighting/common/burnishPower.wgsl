// lighting/common/burnishPower.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// cosine^n itself, 0 for a cosine below 0.
fn burnishPower(cosine: f32, n: f32) -> f32 {
    return pow(max(cosine, 0.0), n);
}
