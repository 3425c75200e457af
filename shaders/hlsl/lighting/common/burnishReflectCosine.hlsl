// lighting/common/burnishReflectCosine.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_REFLECT_COSINE
#define FNC_LIGHTING_COMMON_BURNISH_REFLECT_COSINE

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// R.V of Phong's model, R being L mirrored at N, from three cosines of unit vectors.
float burnishReflectCosine(float NoL, float NoV, float LoV) {
    BURNISH_PRECISE float cosine = (2.0 * NoL) * NoV - LoV;
    return cosine;
}

#endif
