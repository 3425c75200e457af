// lighting/common/burnishLobe.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_LOBE
#define FNC_LIGHTING_COMMON_BURNISH_LOBE

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// The lobe (1 - zeta lambda)^m by squarings, m = 2, 4, 8, 16 or 32, in [0, 1], which
// replaces cos^n. burnishZeta... computes the slope zeta for an exponent n; lambda is 1 - cosine, from
// burnishLambda for n in the thousands. The lobe is 0 from lambda = 1 / zeta on.
float burnishBase(float lambda, float zeta) {
    BURNISH_PRECISE float base = 1.0 - zeta * lambda;
    return clamp(base, 0.0, 1.0);
}

float burnishLobeOfLambda2(float lambda, float zeta) {
    float u = burnishBase(lambda, zeta);
    return u * u;
}

float burnishLobeOfLambda4(float lambda, float zeta) {
    float u2 = burnishLobeOfLambda2(lambda, zeta);
    return u2 * u2;
}

float burnishLobeOfLambda8(float lambda, float zeta) {
    float u4 = burnishLobeOfLambda4(lambda, zeta);
    return u4 * u4;
}

float burnishLobeOfLambda16(float lambda, float zeta) {
    float u8 = burnishLobeOfLambda8(lambda, zeta);
    return u8 * u8;
}

float burnishLobeOfLambda32(float lambda, float zeta) {
    float u16 = burnishLobeOfLambda16(lambda, zeta);
    return u16 * u16;
}

// The same of a cosine: N.H of Blinn's model, R.V of Phong's.
float burnishLobe2(float cosine, float zeta) {
    return burnishLobeOfLambda2(1.0 - cosine, zeta);
}

float burnishLobe4(float cosine, float zeta) {
    return burnishLobeOfLambda4(1.0 - cosine, zeta);
}

float burnishLobe8(float cosine, float zeta) {
    return burnishLobeOfLambda8(1.0 - cosine, zeta);
}

float burnishLobe16(float cosine, float zeta) {
    return burnishLobeOfLambda16(1.0 - cosine, zeta);
}

float burnishLobe32(float cosine, float zeta) {
    return burnishLobeOfLambda32(1.0 - cosine, zeta);
}

#endif
