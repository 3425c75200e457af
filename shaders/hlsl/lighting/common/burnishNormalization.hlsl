// lighting/common/burnishNormalization.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_NORMALIZATION
#define FNC_LIGHTING_COMMON_BURNISH_NORMALIZATION

// Factors that normalise a lobe to the integral 1 over the hemisphere around its axis, for zeta >= 1.

// Of the lobe of order m.
float burnishNormalizeLobe(float zeta, float m) {
    return zeta * (m + 1.0) * 0.159154943;
}

// Of cos^n.
float burnishNormalizePower(float n) {
    return (n + 1.0) * 0.159154943;
}

// The same of lobe times cosine: a distribution of normals D(N.H).
float burnishNormalizeLobeDistribution(float zeta, float m) {
    return zeta * zeta * (m + 1.0) * (m + 2.0) * 0.159154943 / (zeta * (m + 2.0) - 1.0);
}

float burnishNormalizePowerDistribution(float n) {
    return (n + 2.0) * 0.159154943;
}

#endif
