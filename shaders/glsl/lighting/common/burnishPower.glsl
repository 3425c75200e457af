// lighting/common/burnishPower.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_POWER
#define FNC_LIGHTING_COMMON_BURNISH_POWER

// cosine^n itself, 0 for a cosine below 0.
float burnishPower(float cosine, float n) {
    return pow(max(cosine, 0.0), n);
}

#endif
