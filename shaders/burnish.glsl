// burnish.glsl: highlights without pow, and light, all in one file
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// GLSL 330, ES 300 with highp floats, and later. BURNISH_EXACT: the CPU's bits (GLSL 400, ES 320).
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef BURNISH_SHADERS
#define BURNISH_SHADERS

#ifndef BURNISH_PRECISE
#ifdef BURNISH_EXACT
#define BURNISH_PRECISE precise
#else
#define BURNISH_PRECISE
#endif
#endif

// ---- math/burnishDot ----

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

// ---- math/burnishInverseSqrt ----

// 1 / sqrt(x)
float burnishInverseSqrt(float x) {
#ifdef BURNISH_EXACT
    // the CPU's operations: within 1.04e-7 relative for x in [2^-126, 2^127], near 1e19 for 0
    float guess = uintBitsToFloat(0x5f200000u - (floatBitsToUint(x) >> 1));
    BURNISH_PRECISE float squared = (x * guess) * guess;
    BURNISH_PRECISE float y = guess * (1.6819136142730713 - 0.7039516568183899 * squared);
    BURNISH_PRECISE float rest = 1.0 - (x * y) * y;
    BURNISH_PRECISE float root = y + y * (rest * (0.5 + 0.375 * rest));
    return root;
#else
    return inversesqrt(x);
#endif
}

// ---- lighting/common/burnishLambda ----

// 1 - a.b of two unit vectors as half the square of their chord. Narrow lobes need it: it
// keeps the digits that 1 - dot(a, b) loses near 1.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, 1993.
float burnishLambda(vec3 a, vec3 b) {
    BURNISH_PRECISE vec3 chord = a - b;
    return 0.5 * burnishDot(chord, chord);
}

// ---- lighting/common/burnishLobe ----

// The lobe (1 - zeta lambda)^m by squarings, m = 2, 4, 8, 16 or 32, in [0, 1], which
// replaces cos^n. burnishZeta... computes the slope zeta for an exponent n; lambda is 1 - cosine, from
// burnishLambda for n in the thousands. The lobe is 0 from lambda = 1 / zeta on.
float burnishBase(float lambda, float zeta) {
    BURNISH_PRECISE float base = 1.0 - zeta * lambda;
    return clamp(base, 0.0, 1.0);
}

float burnishLobeOfLambda2(float lambda, float zeta) {
    float u = burnishBase(lambda, zeta);
    return u * u;
}

float burnishLobeOfLambda4(float lambda, float zeta) {
    float u2 = burnishLobeOfLambda2(lambda, zeta);
    return u2 * u2;
}

float burnishLobeOfLambda8(float lambda, float zeta) {
    float u4 = burnishLobeOfLambda4(lambda, zeta);
    return u4 * u4;
}

float burnishLobeOfLambda16(float lambda, float zeta) {
    float u8 = burnishLobeOfLambda8(lambda, zeta);
    return u8 * u8;
}

float burnishLobeOfLambda32(float lambda, float zeta) {
    float u16 = burnishLobeOfLambda16(lambda, zeta);
    return u16 * u16;
}

// The same of a cosine: N.H of Blinn's model, R.V of Phong's.
float burnishLobe2(float cosine, float zeta) {
    return burnishLobeOfLambda2(1.0 - cosine, zeta);
}

float burnishLobe4(float cosine, float zeta) {
    return burnishLobeOfLambda4(1.0 - cosine, zeta);
}

float burnishLobe8(float cosine, float zeta) {
    return burnishLobeOfLambda8(1.0 - cosine, zeta);
}

float burnishLobe16(float cosine, float zeta) {
    return burnishLobeOfLambda16(1.0 - cosine, zeta);
}

float burnishLobe32(float cosine, float zeta) {
    return burnishLobeOfLambda32(1.0 - cosine, zeta);
}

// ---- lighting/common/burnishPower ----

// cosine^n itself, 0 for a cosine below 0.
float burnishPower(float cosine, float n) {
    return pow(max(cosine, 0.0), n);
}

// ---- lighting/common/burnishSchlick ----

// Schlick's lobe c / (n - n c + c): one division, brighter than cos^n everywhere.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV, 1994.
float burnishSchlick(float cosine, float n) {
    float c = clamp(cosine, 0.0, 1.0);
    BURNISH_PRECISE float below = c + n * (1.0 - c);
    return c / below;
}

// ---- lighting/common/burnishZeta ----

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

// ---- lighting/common/burnishNormalization ----

// Factors that normalise a lobe to the integral 1 over the hemisphere around its axis, for zeta >= 1.

// Of the lobe of order m.
float burnishNormalizeLobe(float zeta, float m) {
    return zeta * (m + 1.0) * 0.159154943;
}

// Of cos^n.
float burnishNormalizePower(float n) {
    return (n + 1.0) * 0.159154943;
}

// The same of lobe times cosine: a distribution of normals D(N.H).
float burnishNormalizeLobeDistribution(float zeta, float m) {
    return zeta * zeta * (m + 1.0) * (m + 2.0) * 0.159154943 / (zeta * (m + 2.0) - 1.0);
}

float burnishNormalizePowerDistribution(float n) {
    return (n + 2.0) * 0.159154943;
}

// ---- lighting/common/burnishExponent ----

// From roughness to the exponent n and back. alpha is Beckmann's or GGX's width; roughness is its
// square root, as in glTF and most engines.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007.
float burnishExponentFromAlpha(float alpha) {
    return 2.0 / (alpha * alpha) - 2.0;
}

float burnishAlphaFromExponent(float n) {
    return sqrt(2.0 / (n + 2.0));
}

// n in [1, 65536], the range of the lobes: a mirror's is infinite.
float burnishExponentFromRoughness(float roughness) {
    float alpha = max(roughness * roughness, 0.0055);
    return clamp(burnishExponentFromAlpha(alpha), 1.0, 65536.0);
}

float burnishRoughnessFromExponent(float n) {
    return sqrt(burnishAlphaFromExponent(n));
}

// The exponent of Phong's R.V whose highlight is about as wide as Blinn's N.H with n, and back.
float burnishPhongFromBlinn(float n) {
    return 0.25 * n;
}

float burnishBlinnFromPhong(float n) {
    return 4.0 * n;
}

// The exponent for the mean of unit normals with that length, from a filtered normal map.
// Source: Toksvig, Mipmapping Normal Maps, 2005.
float burnishToksvigExponent(float n, float meanLength) {
    float l = clamp(meanLength, 0.0, 1.0);
    return n * l / (l + n * (1.0 - l));
}

// ---- lighting/common/burnishHalfCosine ----

// N.H of Blinn's model from three cosines of unit vectors: no half vector, no second normalisation.
float burnishHalfCosine(float NoL, float NoV, float LoV) {
    BURNISH_PRECISE float squared = max(2.0 + 2.0 * LoV, 0.00000095367431640625);
    BURNISH_PRECISE float sum = NoL + NoV;
    return sum * burnishInverseSqrt(squared);
}

// ---- lighting/common/burnishReflectCosine ----

// R.V of Phong's model, R being L mirrored at N, from three cosines of unit vectors.
float burnishReflectCosine(float NoL, float NoV, float LoV) {
    BURNISH_PRECISE float cosine = (2.0 * NoL) * NoV - LoV;
    return cosine;
}

// ---- lighting/specular/burnish ----

// The highlight without pow in one function: the lobe of order 2 with the energy of NoH^shininess,
// shininess in [1, 65536].
float specularBurnish(float NoH, float shininess) {
    return burnishLobe2(NoH, burnishZetaEnergy(shininess, 2.0));
}

// The same with the integral 1 over the solid angle.
float specularBurnishNormalized(float NoH, float shininess) {
    float zeta = burnishZetaEnergy(shininess, 2.0);
    return burnishNormalizeLobe(zeta, 2.0) * burnishLobe2(NoH, zeta);
}

#ifdef STR_SHADING_DATA
// For LYGIA's specular(): #define SPECULAR_FNC specularBurnish
float specularBurnish(ShadingData shadingData) {
    return specularBurnish(shadingData.NoH, burnishExponentFromRoughness(shadingData.roughness));
}
#endif

// ---- lighting/burnishLit ----

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

// ---- lighting/burnishLighting ----

// Blinn's lighting equation for one white light and order 2, ambient + diffuse N.L + specular lobe:
// the shortest way to a lit surface. Several lights: add up burnishLit's weights yourself.
vec3 burnishLighting(vec3 N, vec3 L, vec3 V, vec3 ambient, vec3 diffuse, vec3 specular, float n) {
    vec2 weights = burnishLit(N, L, V, burnishZetaEnergy(n, 2.0), 2);
    BURNISH_PRECISE vec3 color = ambient + diffuse * weights.x + specular * weights.y;
    return color;
}

#endif
