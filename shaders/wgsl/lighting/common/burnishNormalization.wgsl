// lighting/common/burnishNormalization.wgsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// Factors that normalise a lobe to the integral 1 over the hemisphere around its axis, for zeta >= 1.

// Of the lobe of order m.
fn burnishNormalizeLobe(zeta: f32, m: f32) -> f32 {
    return zeta * (m + 1.0) * 0.159154943;
}

// Of cos^n.
fn burnishNormalizePower(n: f32) -> f32 {
    return (n + 1.0) * 0.159154943;
}

// The same of lobe times cosine: a distribution of normals D(N.H).
fn burnishNormalizeLobeDistribution(zeta: f32, m: f32) -> f32 {
    return zeta * zeta * (m + 1.0) * (m + 2.0) * 0.159154943 / (zeta * (m + 2.0) - 1.0);
}

fn burnishNormalizePowerDistribution(n: f32) -> f32 {
    return (n + 2.0) * 0.159154943;
}
