// lighting/common/burnishLobe.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// The lobe (1 - zeta lambda)^m by squarings, m = 2, 4, 8, 16 or 32, in [0, 1], which
// replaces cos^n. burnishZeta... computes the slope zeta for an exponent n; lambda is 1 - cosine, from
// burnishLambda for n in the thousands. The lobe is 0 from lambda = 1 / zeta on.
fn burnishBase(lambda: f32, zeta: f32) -> f32 {
    let base = 1.0 - zeta * lambda;
    return clamp(base, 0.0, 1.0);
}

fn burnishLobeOfLambda2(lambda: f32, zeta: f32) -> f32 {
    let u = burnishBase(lambda, zeta);
    return u * u;
}

fn burnishLobeOfLambda4(lambda: f32, zeta: f32) -> f32 {
    let u2 = burnishLobeOfLambda2(lambda, zeta);
    return u2 * u2;
}

fn burnishLobeOfLambda8(lambda: f32, zeta: f32) -> f32 {
    let u4 = burnishLobeOfLambda4(lambda, zeta);
    return u4 * u4;
}

fn burnishLobeOfLambda16(lambda: f32, zeta: f32) -> f32 {
    let u8 = burnishLobeOfLambda8(lambda, zeta);
    return u8 * u8;
}

fn burnishLobeOfLambda32(lambda: f32, zeta: f32) -> f32 {
    let u16 = burnishLobeOfLambda16(lambda, zeta);
    return u16 * u16;
}

// The same of a cosine: N.H of Blinn's model, R.V of Phong's.
fn burnishLobe2(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda2(1.0 - cosine, zeta);
}

fn burnishLobe4(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda4(1.0 - cosine, zeta);
}

fn burnishLobe8(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda8(1.0 - cosine, zeta);
}

fn burnishLobe16(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda16(1.0 - cosine, zeta);
}

fn burnishLobe32(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda32(1.0 - cosine, zeta);
}
