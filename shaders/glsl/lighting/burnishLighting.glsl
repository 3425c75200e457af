// lighting/burnishLighting.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "common/burnishZeta.glsl"
#include "burnishLit.glsl"

#ifndef FNC_LIGHTING_BURNISH_LIGHTING
#define FNC_LIGHTING_BURNISH_LIGHTING

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// Blinn's lighting equation for one white light and order 2, ambient + diffuse N.L + specular lobe:
// the shortest way to a lit surface. Several lights: add up burnishLit's weights yourself.
vec3 burnishLighting(vec3 N, vec3 L, vec3 V, vec3 ambient, vec3 diffuse, vec3 specular, float n) {
    vec2 weights = burnishLit(N, L, V, burnishZetaEnergy(n, 2.0), 2);
    BURNISH_PRECISE vec3 color = ambient + diffuse * weights.x + specular * weights.y;
    return color;
}

#endif
