// lighting/area/burnishGgx.hlsl: part of burnish, highlights without pow
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// HLSL, shader model 4 and later. BURNISH_EXACT: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef FNC_LIGHTING_AREA_BURNISH_GGX
#define FNC_LIGHTING_AREA_BURNISH_GGX

// GGX as lobes: roughness is the square root of its width alpha.

// (zeta of a lobe of order 4, zeta of its tail of order 1, weight of the tail).
// Source: docs/theory.md, fitted to GGX seen from above. Slopes are 0.78 times that, and the axis
// and the stretch are fitted too: least errors of 8,400 random lights over all views.
float3 burnishGgxLobes(float roughness) {
    float r = max(roughness, 0.03);
    float a = r * r;
    float scale = 0.78 / (a * a);

                             float zeta = scale * (0.130873 + a * (0.145536 + a * (0.125278 + a * (0.244102 + a * 0.399355))));

                             float tail = scale * (0.045493 + a * (0.060453 + a * (0.474393 + a * (0.793652 - a * 0.361736))));
    float weight = 0.398137 + a * (0.546989 + a * (-2.960546 + a * (6.946654 - a * 3.944059)));
    return float3(max(zeta, 1.0), max(tail, 1.0), weight);
}

// The axis of the lobes: rough surfaces reflect more toward N.
float3 burnishGgxAxis(float3 N, float3 V, float roughness) {
    float NoV = dot(N, V);
    float3 R = N * (2.0 * NoV) - V;
    float lean = pow(roughness, 1.7 + 3.3 * max(NoV, 0.0)) * 1.1 * roughness / (roughness + 0.1);
    float3 axis = R + (N - R) * lean;
    return axis * rsqrt(dot(axis, axis));
}

// GGX is narrower across the plane of N and V. A map makes the lobes round: p becomes p + s (s.p) strength,
// s being this unit vector or 0.
float3 burnishGgxAcross(float3 N, float3 V) {
    float3 across = cross(N, V);
    return across * rsqrt(max(dot(across, across), 1.0e-12));
}

float burnishGgxStretch(float NoV, float roughness) {
    float x = clamp(NoV, 0.03, 1.0);
    float width = x + (1.0 - x) * 1.5 * roughness * roughness * sqrt(roughness);
    return 1.0 / width - 1.0;
}

// The share F0 x + y of white light that GGX reflects: polynomials fitted to its integrals, without light
// that is reflected more than once. x + y is within 0.04, y within 0.045.
float2 burnishGgxAlbedo(float NoV, float roughness) {
    float r = roughness;
    float q = 1.0 - NoV;
    float q5 = q * q * q * q * q;
    float sum = 1.0 + r * (0.39698 + r * (r * 0.28534 - 1.39467));
    sum = sum + q5 * r * (r * (6.34208 - r * 5.25493) - 1.02413);
    sum = sum + q * r * (0.05344 + r * (1.33749 - r * 1.34041));
    sum = sum + q * q * r * (r * (r * 4.50138 - 3.66818) - 0.32463);
    float y = r * (r * 0.08623 - 0.04109) - 0.03907;

                     y = y + q5 * (1.05434 + r * (r * 2.25303 - 3.16369)) + q * (0.11963 + r * (0.53691 - r * 0.74945));
    return float2(sum - max(y, 0.0), max(y, 0.0));
}

#endif
