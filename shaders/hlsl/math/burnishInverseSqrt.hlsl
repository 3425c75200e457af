// math/burnishInverseSqrt.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_MATH_BURNISH_INVERSE_SQRT
#define FNC_MATH_BURNISH_INVERSE_SQRT

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// 1 / sqrt(x)
float burnishInverseSqrt(float x) {
#ifdef BURNISH_EXACT
    // the CPU's operations: within 1.04e-7 relative for x in [2^-126, 2^127], near 1e19 for 0
    float guess = asfloat(0x5f200000u - (asuint(x) >> 1));
    BURNISH_PRECISE float squared = (x * guess) * guess;
    BURNISH_PRECISE float y = guess * (1.6819136142730713 - 0.7039516568183899 * squared);
    BURNISH_PRECISE float rest = 1.0 - (x * y) * y;
    BURNISH_PRECISE float root = y + y * (rest * (0.5 + 0.375 * rest));
    return root;
#else
    return rsqrt(x);
#endif
}

#endif
