// burnish.wgsl: highlights without pow, and light, all in one file
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// WGSL.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// ---- math/burnishDot ----

// a.b
fn burnishDot(a: vec3f, b: vec3f) -> f32 {
    return dot(a, b);
}

// ---- math/burnishInverseSqrt ----

// 1 / sqrt(x)
fn burnishInverseSqrt(x: f32) -> f32 {
    return inverseSqrt(x);
}

// ---- lighting/common/burnishLambda ----

// 1 - a.b of two unit vectors as half the square of their chord. Narrow lobes need it: it
// keeps the digits that 1 - dot(a, b) loses near 1.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, 1993.
fn burnishLambda(a: vec3f, b: vec3f) -> f32 {
    let chord = a - b;
    return 0.5 * burnishDot(chord, chord);
}

// ---- lighting/common/burnishLobe ----

// The lobe (1 - zeta lambda)^m by squarings, m = 2, 4, 8, 16 or 32, in [0, 1], which
// replaces cos^n. burnishZeta... computes the slope zeta for an exponent n; lambda is 1 - cosine, from
// burnishLambda for n in the thousands. The lobe is 0 from lambda = 1 / zeta on.
fn burnishBase(lambda: f32, zeta: f32) -> f32 {
    let base = 1.0 - zeta * lambda;
    return clamp(base, 0.0, 1.0);
}

fn burnishLobeOfLambda2(lambda: f32, zeta: f32) -> f32 {
    let u = burnishBase(lambda, zeta);
    return u * u;
}

fn burnishLobeOfLambda4(lambda: f32, zeta: f32) -> f32 {
    let u2 = burnishLobeOfLambda2(lambda, zeta);
    return u2 * u2;
}

fn burnishLobeOfLambda8(lambda: f32, zeta: f32) -> f32 {
    let u4 = burnishLobeOfLambda4(lambda, zeta);
    return u4 * u4;
}

fn burnishLobeOfLambda16(lambda: f32, zeta: f32) -> f32 {
    let u8 = burnishLobeOfLambda8(lambda, zeta);
    return u8 * u8;
}

fn burnishLobeOfLambda32(lambda: f32, zeta: f32) -> f32 {
    let u16 = burnishLobeOfLambda16(lambda, zeta);
    return u16 * u16;
}

// The same of a cosine: N.H of Blinn's model, R.V of Phong's.
fn burnishLobe2(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda2(1.0 - cosine, zeta);
}

fn burnishLobe4(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda4(1.0 - cosine, zeta);
}

fn burnishLobe8(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda8(1.0 - cosine, zeta);
}

fn burnishLobe16(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda16(1.0 - cosine, zeta);
}

fn burnishLobe32(cosine: f32, zeta: f32) -> f32 {
    return burnishLobeOfLambda32(1.0 - cosine, zeta);
}

// ---- lighting/common/burnishPower ----

// cosine^n itself, 0 for a cosine below 0.
fn burnishPower(cosine: f32, n: f32) -> f32 {
    return pow(max(cosine, 0.0), n);
}

// ---- lighting/common/burnishSchlick ----

// Schlick's lobe c / (n - n c + c): one division, brighter than cos^n everywhere.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV, 1994.
fn burnishSchlick(cosine: f32, n: f32) -> f32 {
    let c = clamp(cosine, 0.0, 1.0);
    let below = c + n * (1.0 - c);
    return c / below;
}

// ---- lighting/common/burnishZeta ----

// The slope zeta of the lobe of order m = 2, 4, 8, 16 or 32 for cos^n, n >= m (order 2:
// n >= 1). It depends on the material alone: compute it once, outside the shader.

// The same curvature at the peak; never above cos^n.
fn burnishZetaTaylor(n: f32, m: f32) -> f32 {
    return n / m;
}

// The same integral over the solid angle: the default, for highlights that look right.
fn burnishZetaEnergy(n: f32, m: f32) -> f32 {
    return (n + 1.0) / (m + 1.0);
}

// The same integral of lobe times cosine: for distributions of normals.
fn burnishZetaProjected(n: f32, m: f32) -> f32 {
    let b = (m + 2.0) * (n + 2.0);
    let a = 2.0 * (m + 1.0) * (m + 2.0);
    return (b + sqrt(b * b - 2.0 * a * (n + 2.0))) / a;
}

// Equals cos^n at the angle where cos^n is q, 0 < q < 1. Relative error up to n / 10^7: for large n compute it
// in double precision.
fn burnishZetaLevel(n: f32, m: f32, q: f32) -> f32 {
    return (1.0 - pow(q, 1.0 / m)) / (1.0 - pow(q, 1.0 / n));
}

// Order 2 in integers. Its level, the q of burnishZetaLevel, is 0.50 at n = 10 and tends to 0.58.
fn burnishZetaShift7(n: f32) -> f32 {
    return 0.4375 * n;
}

// Order 2 in integers: a lower largest error from n = 6 on.
fn burnishZetaShift3(n: f32) -> f32 {
    return 0.375 * n;
}

// Its largest error against cos^n is within 0.001 of the least possible one, for n >= m.
// The optimum needs a search: `burnish lobe table --lobes=minimax:4 --exponents=64 --metrics=zeta`.
fn burnishZetaMinimax(n: f32, m: f32) -> f32 {
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
fn burnishNormalizeLobe(zeta: f32, m: f32) -> f32 {
    return zeta * (m + 1.0) * 0.159154943;
}

// Of cos^n.
fn burnishNormalizePower(n: f32) -> f32 {
    return (n + 1.0) * 0.159154943;
}

// The same of lobe times cosine: a distribution of normals D(N.H).
fn burnishNormalizeLobeDistribution(zeta: f32, m: f32) -> f32 {
    return zeta * zeta * (m + 1.0) * (m + 2.0) * 0.159154943 / (zeta * (m + 2.0) - 1.0);
}

fn burnishNormalizePowerDistribution(n: f32) -> f32 {
    return (n + 2.0) * 0.159154943;
}

// ---- lighting/common/burnishExponent ----

// From roughness to the exponent n and back. alpha is Beckmann's or GGX's width; roughness is its
// square root, as in glTF and most engines.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007.
fn burnishExponentFromAlpha(alpha: f32) -> f32 {
    return 2.0 / (alpha * alpha) - 2.0;
}

fn burnishAlphaFromExponent(n: f32) -> f32 {
    return sqrt(2.0 / (n + 2.0));
}

// n in [1, 65536], the range of the lobes: a mirror's is infinite.
fn burnishExponentFromRoughness(roughness: f32) -> f32 {
    let alpha = max(roughness * roughness, 0.0055);
    return clamp(burnishExponentFromAlpha(alpha), 1.0, 65536.0);
}

fn burnishRoughnessFromExponent(n: f32) -> f32 {
    return sqrt(burnishAlphaFromExponent(n));
}

// The exponent of Phong's R.V whose highlight is about as wide as Blinn's N.H with n, and back.
fn burnishPhongFromBlinn(n: f32) -> f32 {
    return 0.25 * n;
}

fn burnishBlinnFromPhong(n: f32) -> f32 {
    return 4.0 * n;
}

// The exponent for the mean of unit normals with that length, from a filtered normal map.
// Source: Toksvig, Mipmapping Normal Maps, 2005.
fn burnishToksvigExponent(n: f32, meanLength: f32) -> f32 {
    let l = clamp(meanLength, 0.0, 1.0);
    return n * l / (l + n * (1.0 - l));
}

// ---- lighting/common/burnishHalfCosine ----

// N.H of Blinn's model from three cosines of unit vectors: no half vector, no second normalisation.
fn burnishHalfCosine(NoL: f32, NoV: f32, LoV: f32) -> f32 {
    let squared = max(2.0 + 2.0 * LoV, 0.00000095367431640625);
    let sum = NoL + NoV;
    return sum * burnishInverseSqrt(squared);
}

// ---- lighting/common/burnishReflectCosine ----

// R.V of Phong's model, R being L mirrored at N, from three cosines of unit vectors.
fn burnishReflectCosine(NoL: f32, NoV: f32, LoV: f32) -> f32 {
    let cosine = (2.0 * NoL) * NoV - LoV;
    return cosine;
}

// ---- lighting/specular/burnish ----

// The highlight without pow in one function: the lobe of order 2 with the energy of NoH^shininess,
// shininess in [1, 65536].
fn specularBurnish(NoH: f32, shininess: f32) -> f32 {
    return burnishLobe2(NoH, burnishZetaEnergy(shininess, 2.0));
}

// The same with the integral 1 over the solid angle.
fn specularBurnishNormalized(NoH: f32, shininess: f32) -> f32 {
    let zeta = burnishZetaEnergy(shininess, 2.0);
    return burnishNormalizeLobe(zeta, 2.0) * burnishLobe2(NoH, zeta);
}

// ---- lighting/burnishLit ----

// The weights of a light's diffuse and specular colour, (max(0, N.L), lobe), of order 2, 4, 8, 16
// or 32. N may have any length, such as an interpolated normal; L and V point away from the
// surface and have unit length.
fn burnishLitByCosine(NoL: f32, cosine: f32, zeta: f32, order: i32) -> vec2f {
    let base = cosine * zeta + (1.0 - zeta);
    var lobe = 0.0;
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
    return vec2f(max(NoL, 0.0), lobe);
}

// Blinn's model.
fn burnishLit(N: vec3f, L: vec3f, V: vec3f, zeta: f32, order: i32) -> vec2f {
    let inverse = burnishInverseSqrt(burnishDot(N, N));
    let NoL = burnishDot(N, L) * inverse;
    let NoV = burnishDot(N, V) * inverse;
    let cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Phong's model.
fn burnishLitPhong(N: vec3f, L: vec3f, V: vec3f, zeta: f32, order: i32) -> vec2f {
    let inverse = burnishInverseSqrt(burnishDot(N, N));
    let NoL = burnishDot(N, L) * inverse;
    let NoV = burnishDot(N, V) * inverse;
    let cosine = burnishReflectCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Blinn's model, L from the surface to a light, of any length.
fn burnishLitPoint(N: vec3f, L: vec3f, V: vec3f, zeta: f32, order: i32) -> vec2f {
    let inverseN = burnishInverseSqrt(burnishDot(N, N));
    let inverseL = burnishInverseSqrt(burnishDot(L, L));
    let NoL = burnishDot(N, L) * (inverseN * inverseL);
    let NoV = burnishDot(N, V) * inverseN;
    let cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V) * inverseL);
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// ---- lighting/burnishLighting ----

// Blinn's lighting equation for one white light and order 2, ambient + diffuse N.L + specular lobe:
// the shortest way to a lit surface. Several lights: add up burnishLit's weights yourself.
fn burnishLighting(N: vec3f, L: vec3f, V: vec3f, ambient: vec3f, diffuse: vec3f, specular: vec3f,
                   n: f32) -> vec3f {
    let weights = burnishLit(N, L, V, burnishZetaEnergy(n, 2.0), 2);
    let color = ambient + diffuse * weights.x + specular * weights.y;
    return color;
}
