// lighting/common/burnishZeta.glsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_COMMON_BURNISH_ZETA
#define FNC_LIGHTING_COMMON_BURNISH_ZETA

// The slope zeta of the lobe of order m = 2, 4, 8, 16 or 32 for cos^n, n >= m (order 2:
// n >= 1). It depends on the material alone: compute it once, outside the shader.

// The same curvature at the peak; never above cos^n.
float burnishZetaTaylor(float n, float m) {
    return n / m;
}

// The same integral over the solid angle: the default, for highlights that look right.
float burnishZetaEnergy(float n, float m) {
    return (n + 1.0) / (m + 1.0);
}

// The same integral of lobe times cosine: for distributions of normals.
float burnishZetaProjected(float n, float m) {
    float b = (m + 2.0) * (n + 2.0);
    float a = 2.0 * (m + 1.0) * (m + 2.0);
    return (b + sqrt(b * b - 2.0 * a * (n + 2.0))) / a;
}

// Equals cos^n at the angle where cos^n is q, 0 < q < 1. Relative error up to n / 10^7: for large n compute it
// in double precision.
float burnishZetaLevel(float n, float m, float q) {
    return (1.0 - pow(q, 1.0 / m)) / (1.0 - pow(q, 1.0 / n));
}

// Order 2 in integers. Its level, the q of burnishZetaLevel, is 0.50 at n = 10 and tends to 0.58.
float burnishZetaShift7(float n) {
    return 0.4375 * n;
}

// Order 2 in integers: a lower largest error from n = 6 on.
float burnishZetaShift3(float n) {
    return 0.375 * n;
}

// Its largest error against cos^n is within 0.001 of the least possible one, for n >= m.
// The optimum needs a search: `burnish lobe table --lobes=minimax:4 --exponents=64 --metrics=zeta`.
float burnishZetaMinimax(float n, float m) {
    if (m >= 32.0) {
        return 0.0306084 * n + 0.0202 + 0.008 / n;
    }
    if (m >= 16.0) {
        return 0.0599556 * n + 0.0397 + 0.016 / n;
    }
    if (m >= 8.0) {
        return 0.114995 * n + 0.0762 + 0.031 / n;
    }
    if (m >= 4.0) {
        return 0.211335 * n + 0.14 + 0.058 / n;
    }
    return 0.355859 * n + 0.2345 + 0.104 / n;
}

#endif
