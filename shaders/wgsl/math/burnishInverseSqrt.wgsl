// math/burnishInverseSqrt.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// 1 / sqrt(x)
fn burnishInverseSqrt(x: f32) -> f32 {
    return inverseSqrt(x);
}
