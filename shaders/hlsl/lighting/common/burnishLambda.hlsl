// lighting/common/burnishLambda.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishDot.hlsl"

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
float burnishLambda(float3 a, float3 b) {
    BURNISH_PRECISE float3 chord = a - b;
    return 0.5 * burnishDot(chord, chord);
}

#endif
