// lighting/burnishLighting.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "common/burnishZeta.hlsl"
#include "burnishLit.hlsl"

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
float3 burnishLighting(float3 N, float3 L, float3 V, float3 ambient, float3 diffuse,
                       float3 specular, float n) {
    float2 weights = burnishLit(N, L, V, burnishZetaEnergy(n, 2.0), 2);
    BURNISH_PRECISE float3 color = ambient + diffuse * weights.x + specular * weights.y;
    return color;
}

#endif
