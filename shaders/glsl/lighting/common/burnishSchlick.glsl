// lighting/common/burnishSchlick.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_SCHLICK
#define FNC_LIGHTING_COMMON_BURNISH_SCHLICK

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// Schlick's lobe c / (n - n c + c): one division, brighter than cos^n everywhere.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV, 1994.
float burnishSchlick(float cosine, float n) {
    float c = clamp(cosine, 0.0, 1.0);
    BURNISH_PRECISE float below = c + n * (1.0 - c);
    return c / below;
}

#endif
