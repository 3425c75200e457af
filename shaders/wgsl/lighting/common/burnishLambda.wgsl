// lighting/common/burnishLambda.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishDot.wgsl"

// 1 - a.b of two unit vectors as half the square of their chord. Narrow lobes need it: it
// keeps the digits that 1 - dot(a, b) loses near 1.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, 1993.
fn burnishLambda(a: vec3f, b: vec3f) -> f32 {
    let chord = a - b;
    return 0.5 * burnishDot(chord, chord);
}
