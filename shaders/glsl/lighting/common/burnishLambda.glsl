// lighting/common/burnishLambda.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishDot.glsl"

#ifndef FNC_LIGHTING_COMMON_BURNISH_LAMBDA
#define FNC_LIGHTING_COMMON_BURNISH_LAMBDA

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// 1 - a.b of two unit vectors as half the square of their chord. Narrow lobes need it: it
// keeps the digits that 1 - dot(a, b) loses near 1.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, 1993.
float burnishLambda(vec3 a, vec3 b) {
    BURNISH_PRECISE vec3 chord = a - b;
    return 0.5 * burnishDot(chord, chord);
}

#endif
