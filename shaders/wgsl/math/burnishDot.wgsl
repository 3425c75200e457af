// math/burnishDot.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// a.b
fn burnishDot(a: vec3f, b: vec3f) -> f32 {
    return dot(a, b);
}
