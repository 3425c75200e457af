// lighting/burnishLighting.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "common/burnishZeta.wgsl"
#include "burnishLit.wgsl"

// Blinn's lighting equation for one white light and order 2, ambient + diffuse N.L + specular lobe:
// the shortest way to a lit surface. Several lights: add up burnishLit's weights yourself.
fn burnishLighting(N: vec3f, L: vec3f, V: vec3f, ambient: vec3f, diffuse: vec3f, specular: vec3f,
                   n: f32) -> vec3f {
    let weights = burnishLit(N, L, V, burnishZetaEnergy(n, 2.0), 2);
    let color = ambient + diffuse * weights.x + specular * weights.y;
    return color;
}
