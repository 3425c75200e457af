// lighting/burnishLit.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../math/burnishDot.glsl"
#include "../math/burnishInverseSqrt.glsl"
#include "common/burnishHalfCosine.glsl"
#include "common/burnishReflectCosine.glsl"

#ifndef FNC_LIGHTING_BURNISH_LIT
#define FNC_LIGHTING_BURNISH_LIT

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// The weights of a light's diffuse and specular colour, (max(0, N.L), lobe), of order 2, 4, 8, 16
// or 32. N may have any length, such as an interpolated normal; L and V point away from the
// surface and have unit length.
vec2 burnishLitByCosine(float NoL, float cosine, float zeta, int order) {
    BURNISH_PRECISE float base = cosine * zeta + (1.0 - zeta);
    float lobe = 0.0;
    if (NoL > 0.0) {
        lobe = clamp(base, 0.0, 1.0);
    }
    lobe = lobe * lobe;
    if (order >= 4) {
        lobe = lobe * lobe;
    }
    if (order >= 8) {
        lobe = lobe * lobe;
    }
    if (order >= 16) {
        lobe = lobe * lobe;
    }
    if (order >= 32) {
        lobe = lobe * lobe;
    }
    return vec2(max(NoL, 0.0), lobe);
}

// Blinn's model.
vec2 burnishLit(vec3 N, vec3 L, vec3 V, float zeta, int order) {
    float inverse = burnishInverseSqrt(burnishDot(N, N));
    float NoL = burnishDot(N, L) * inverse;
    float NoV = burnishDot(N, V) * inverse;
    float cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Phong's model.
vec2 burnishLitPhong(vec3 N, vec3 L, vec3 V, float zeta, int order) {
    float inverse = burnishInverseSqrt(burnishDot(N, N));
    float NoL = burnishDot(N, L) * inverse;
    float NoV = burnishDot(N, V) * inverse;
    float cosine = burnishReflectCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Blinn's model, L from the surface to a light, of any length.
vec2 burnishLitPoint(vec3 N, vec3 L, vec3 V, float zeta, int order) {
    float inverseN = burnishInverseSqrt(burnishDot(N, N));
    float inverseL = burnishInverseSqrt(burnishDot(L, L));
    float NoL = burnishDot(N, L) * (inverseN * inverseL);
    float NoV = burnishDot(N, V) * inverseN;
    float cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V) * inverseL);
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

#endif
