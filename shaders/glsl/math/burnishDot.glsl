// math/burnishDot.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_MATH_BURNISH_DOT
#define FNC_MATH_BURNISH_DOT

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// a.b
float burnishDot(vec3 a, vec3 b) {
#ifdef BURNISH_EXACT
    // the CPU's order of additions; dot() does not define one
    BURNISH_PRECISE float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
#else
    return dot(a, b);
#endif
}

#endif
