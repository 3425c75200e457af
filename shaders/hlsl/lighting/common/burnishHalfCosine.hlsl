// lighting/common/burnishHalfCosine.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#include "../../math/burnishInverseSqrt.hlsl"

#ifndef FNC_LIGHTING_COMMON_BURNISH_HALF_COSINE
#define FNC_LIGHTING_COMMON_BURNISH_HALF_COSINE

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// N.H of Blinn's model from three cosines of unit vectors: no half vector, no second normalisation.
float burnishHalfCosine(float NoL, float NoV, float LoV) {
    BURNISH_PRECISE float squared = max(2.0 + 2.0 * LoV, 0.00000095367431640625);
    BURNISH_PRECISE float sum = NoL + NoV;
    return sum * burnishInverseSqrt(squared);
}

#endif
