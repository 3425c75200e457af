// lighting/common/burnishSchlick.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// Schlick's lobe c / (n - n c + c): one division, brighter than cos^n everywhere.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV, 1994.
fn burnishSchlick(cosine: f32, n: f32) -> f32 {
    let c = clamp(cosine, 0.0, 1.0);
    let below = c + n * (1.0 - c);
    return c / below;
}
