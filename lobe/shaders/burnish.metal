// burnish.metal: highlights without pow, and light, all in one file
// Written by scripts/shaders from shaders/burnish.shade; change that. docs/shaders.md explains.
// Metal. BURNISH_EXACT, -fno-fast-math and -ffp-contract=off: the CPU's bits.
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

#ifndef BURNISH_SHADERS
#define BURNISH_SHADERS

#include <metal_stdlib>

using namespace metal;

// ---- math/burnishDot ----

// a.b
inline float burnishDot(float3 a, float3 b) {
#ifdef BURNISH_EXACT
    // the CPU's order of additions; dot() does not define one
    float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
#else
    return dot(a, b);
#endif
}

// ---- math/burnishInverseSqrt ----

// 1 / sqrt(x)
inline float burnishInverseSqrt(float x) {
#ifdef BURNISH_EXACT
    // the CPU's operations: within 1.04e-7 relative for x in [2^-126, 2^127], near 1e19 for 0
    float guess = as_type<float>(0x5f200000u - (as_type<uint>(x) >> 1));
    float squared = (x * guess) * guess;
    float y = guess * (1.6819136142730713 - 0.7039516568183899 * squared);
    float rest = 1.0 - (x * y) * y;
    float root = y + y * (rest * (0.5 + 0.375 * rest));
    return root;
#else
    return rsqrt(x);
#endif
}

// ---- lighting/common/burnishLambda ----

// 1 - a.b of two unit vectors as half the square of their chord. Narrow lobes need it: it
// keeps the digits that 1 - dot(a, b) loses near 1.
// Source: Lyon, Phong Shading Reformulation for Hardware Renderer Simplification, 1993.
inline float burnishLambda(float3 a, float3 b) {
    float3 chord = a - b;
    return 0.5 * burnishDot(chord, chord);
}

// ---- lighting/common/burnishLobe ----

// The lobe (1 - zeta lambda)^m by squarings, m = 2, 4, 8, 16 or 32, in [0, 1], which
// replaces cos^n. burnishZeta... computes the slope zeta for an exponent n; lambda is 1 - cosine, from
// burnishLambda for n in the thousands. The lobe is 0 from lambda = 1 / zeta on.
inline float burnishBase(float lambda, float zeta) {
    float base = 1.0 - zeta * lambda;
    return clamp(base, 0.0, 1.0);
}

inline float burnishLobeOfLambda2(float lambda, float zeta) {
    float u = burnishBase(lambda, zeta);
    return u * u;
}

inline float burnishLobeOfLambda4(float lambda, float zeta) {
    float u2 = burnishLobeOfLambda2(lambda, zeta);
    return u2 * u2;
}

inline float burnishLobeOfLambda8(float lambda, float zeta) {
    float u4 = burnishLobeOfLambda4(lambda, zeta);
    return u4 * u4;
}

inline float burnishLobeOfLambda16(float lambda, float zeta) {
    float u8 = burnishLobeOfLambda8(lambda, zeta);
    return u8 * u8;
}

inline float burnishLobeOfLambda32(float lambda, float zeta) {
    float u16 = burnishLobeOfLambda16(lambda, zeta);
    return u16 * u16;
}

// The same of a cosine: N.H of Blinn's model, R.V of Phong's.
inline float burnishLobe2(float cosine, float zeta) {
    return burnishLobeOfLambda2(1.0 - cosine, zeta);
}

inline float burnishLobe4(float cosine, float zeta) {
    return burnishLobeOfLambda4(1.0 - cosine, zeta);
}

inline float burnishLobe8(float cosine, float zeta) {
    return burnishLobeOfLambda8(1.0 - cosine, zeta);
}

inline float burnishLobe16(float cosine, float zeta) {
    return burnishLobeOfLambda16(1.0 - cosine, zeta);
}

inline float burnishLobe32(float cosine, float zeta) {
    return burnishLobeOfLambda32(1.0 - cosine, zeta);
}

// ---- lighting/common/burnishComposite ----

// Composite lobes, closer to cos^n than burnishLobe...: v = min(top, max(0, top - slope lambda)), v = v v, then
// v = v (v + offset) for each offset. The number in a name is the number of multiplications. lobe.h computes the
// constants of an exponent: burnish_composite_create.
inline float burnishCompositeOfLambda3(float lambda, float top, float slope, float offset1) {
    float base = top - slope * lambda;
    float v = clamp(base, 0.0, top);
    float value = v * v;
    value = value * (value + offset1);
    return value;
}

inline float burnishCompositeOfLambda4(float lambda, float top, float slope, float offset1,
                                       float offset2) {
    float value = burnishCompositeOfLambda3(lambda, top, slope, offset1);
    value = value * (value + offset2);
    return value;
}

inline float burnishCompositeOfLambda5(float lambda, float top, float slope, float offset1,
                                       float offset2, float offset3) {
    float value = burnishCompositeOfLambda4(lambda, top, slope, offset1, offset2);
    value = value * (value + offset3);
    return value;
}

inline float burnishCompositeOfLambda6(float lambda, float top, float slope, float offset1,
                                       float offset2, float offset3, float offset4) {
    float value = burnishCompositeOfLambda5(lambda, top, slope, offset1, offset2, offset3);
    value = value * (value + offset4);
    return value;
}

// The same of a cosine.
inline float burnishComposite3(float cosine, float top, float slope, float offset1) {
    return burnishCompositeOfLambda3(1.0 - cosine, top, slope, offset1);
}

inline float burnishComposite4(float cosine, float top, float slope, float offset1, float offset2) {
    return burnishCompositeOfLambda4(1.0 - cosine, top, slope, offset1, offset2);
}

inline float burnishComposite5(float cosine, float top, float slope, float offset1, float offset2,
                               float offset3) {
    return burnishCompositeOfLambda5(1.0 - cosine, top, slope, offset1, offset2, offset3);
}

inline float burnishComposite6(float cosine, float top, float slope, float offset1, float offset2,
                               float offset3, float offset4) {
    return burnishCompositeOfLambda6(1.0 - cosine, top, slope, offset1, offset2, offset3, offset4);
}

// ---- lighting/common/burnishExpFalloff ----

// About e^-x in 3, 4 or 5 multiplications, within 0.0294, 0.00518 and 0.000136: 1 for x <= 0, never increasing, and
// exactly 0 from x = 4.15566015, 5.97967911 and 9.25124741 on. docs/shaders.md has uses.
inline float burnishExpFalloff3(float x) {
    return burnishCompositeOfLambda3(x, 0.942223668, 0.226732612, 0.238612935);
}

inline float burnishExpFalloff4(float x) {
    return burnishCompositeOfLambda4(x, 0.881662667, 0.147443146, 0.275810421, 0.402908295);
}

inline float burnishExpFalloff5(float x) {
    return burnishCompositeOfLambda5(x, 0.812974453, 0.087877281, 0.273172706, 0.955595791,
                                     0.0586450733);
}

// ---- lighting/common/burnishFresnelWeight ----

// Schlick's (1 - cosine)^5 in three multiplications, without pow: the share of white in F0 + (1 - F0) weight.
// Source: Schlick, An Inexpensive BRDF Model for Physically-Based Rendering, 1994.
inline float burnishFresnelWeight(float cosine) {
    float u = clamp(1.0 - cosine, 0.0, 1.0);
    float u2 = u * u;
    return (u2 * u2) * u;
}

// ---- lighting/common/burnishPower ----

// cosine^n itself, 0 for a cosine below 0.
inline float burnishPower(float cosine, float n) {
    return pow(max(cosine, 0.0), n);
}

// ---- lighting/common/burnishSchlick ----

// Schlick's lobe c / (n - n c + c): one division, brighter than cos^n everywhere.
// Source: Schlick, A Fast Alternative to Phong's Specular Model, Graphics Gems IV, 1994.
inline float burnishSchlick(float cosine, float n) {
    float c = clamp(cosine, 0.0, 1.0);
    float below = c + n * (1.0 - c);
    return c / below;
}

// ---- lighting/common/burnishZeta ----

// The slope zeta of the lobe of order m = 2, 4, 8, 16 or 32 for cos^n, n >= m (order 2:
// n >= 1). It depends on the material alone: compute it once, outside the shader.

// The same curvature at the peak; never above cos^n.
inline float burnishZetaTaylor(float n, float m) {
    return n / m;
}

// The same integral over the solid angle: the default, for highlights that look right.
inline float burnishZetaEnergy(float n, float m) {
    return (n + 1.0) / (m + 1.0);
}

// The same integral of lobe times cosine: for distributions of normals.
inline float burnishZetaProjected(float n, float m) {
    float b = (m + 2.0) * (n + 2.0);
    float a = 2.0 * (m + 1.0) * (m + 2.0);
    return (b + sqrt(b * b - 2.0 * a * (n + 2.0))) / a;
}

// Equals cos^n at the angle where cos^n is q, 0 < q < 1. Relative error up to n / 10^7: for large n compute it
// in double precision.
inline float burnishZetaLevel(float n, float m, float q) {
    return (1.0 - pow(q, 1.0 / m)) / (1.0 - pow(q, 1.0 / n));
}

// Order 2 in integers. Its level, the q of burnishZetaLevel, is 0.50 at n = 10 and tends to 0.58.
inline float burnishZetaShift7(float n) {
    return 0.4375 * n;
}

// Order 2 in integers: a lower largest error from n = 6 on.
inline float burnishZetaShift3(float n) {
    return 0.375 * n;
}

// Its largest error against cos^n is within 0.001 of the least possible one, for n >= m.
// The optimum needs a search: `burnish lobe table --lobes=minimax:4 --exponents=64 --metrics=zeta`.
inline float burnishZetaMinimax(float n, float m) {
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
inline float burnishNormalizeLobe(float zeta, float m) {
    return zeta * (m + 1.0) * 0.159154943;
}

// Of cos^n.
inline float burnishNormalizePower(float n) {
    return (n + 1.0) * 0.159154943;
}

// The same of lobe times cosine: a distribution of normals D(N.H).
inline float burnishNormalizeLobeDistribution(float zeta, float m) {
    return zeta * zeta * (m + 1.0) * (m + 2.0) * 0.159154943 / (zeta * (m + 2.0) - 1.0);
}

inline float burnishNormalizePowerDistribution(float n) {
    return (n + 2.0) * 0.159154943;
}

// ---- lighting/common/burnishExponent ----

// From roughness to the exponent n and back. alpha is Beckmann's or GGX's width; roughness is its
// square root, as in glTF and most engines.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007.
inline float burnishExponentFromAlpha(float alpha) {
    return 2.0 / (alpha * alpha) - 2.0;
}

inline float burnishAlphaFromExponent(float n) {
    return sqrt(2.0 / (n + 2.0));
}

// n in [1, 65536], the range of the lobes: a mirror's is infinite.
inline float burnishExponentFromRoughness(float roughness) {
    float alpha = max(roughness * roughness, 0.0055);
    return clamp(burnishExponentFromAlpha(alpha), 1.0, 65536.0);
}

inline float burnishRoughnessFromExponent(float n) {
    return sqrt(burnishAlphaFromExponent(n));
}

// The exponent of Phong's R.V whose highlight is about as wide as Blinn's N.H with n, and back.
inline float burnishPhongFromBlinn(float n) {
    return 0.25 * n;
}

inline float burnishBlinnFromPhong(float n) {
    return 4.0 * n;
}

// The exponent for the mean of unit normals with that length, from a filtered normal map.
// Source: Toksvig, Mipmapping Normal Maps, 2005.
inline float burnishToksvigExponent(float n, float meanLength) {
    float l = clamp(meanLength, 0.0, 1.0);
    return n * l / (l + n * (1.0 - l));
}

// ---- lighting/common/burnishHalfCosine ----

// N.H of Blinn's model from three cosines of unit vectors: no half vector, no second normalisation.
inline float burnishHalfCosine(float NoL, float NoV, float LoV) {
    float squared = max(2.0 + 2.0 * LoV, 0.00000095367431640625);
    float sum = NoL + NoV;
    return sum * burnishInverseSqrt(squared);
}

// ---- lighting/common/burnishReflectCosine ----

// R.V of Phong's model, R being L mirrored at N, from three cosines of unit vectors.
inline float burnishReflectCosine(float NoL, float NoV, float LoV) {
    float cosine = (2.0 * NoL) * NoV - LoV;
    return cosine;
}

// ---- lighting/specular/burnish ----

// The highlight without pow in one function: the lobe of order 2 with the energy of NoH^shininess,
// shininess in [1, 65536].
inline float specularBurnish(float NoH, float shininess) {
    return burnishLobe2(NoH, burnishZetaEnergy(shininess, 2.0));
}

// The same with the integral 1 over the solid angle.
inline float specularBurnishNormalized(float NoH, float shininess) {
    float zeta = burnishZetaEnergy(shininess, 2.0);
    return burnishNormalizeLobe(zeta, 2.0) * burnishLobe2(NoH, zeta);
}

// ---- lighting/specular/composite ----

// NoH^shininess within 0.0009 for a shininess in [16, 65536], in one function. What depends on the shininess alone costs
// more than the rest: burnishComposite5 with constants from lobe.h in uniforms is cheaper and closer.
inline float specularComposite(float NoH, float shininess) {
    float zeta = max(0.0825871 * shininess - 0.302206 - 0.357094 / shininess, 1.0);
    float b1 = max(0.0221645 - 1.137416 / shininess, 0.0);
    float b2 = max(0.7635843 - 12.38983 / shininess, 0.0);
    float b3 = max(0.0612814 - 1.554842 / shininess, 0.0);
    float scale1 = 1.0 + b1;
    float scale2 = scale1 * (scale1 + b2 * scale1);
    float scale3 = scale2 * (scale2 + b3 * scale2);
    return burnishComposite5(NoH, 1.0, zeta, b1, b2 * scale1, b3 * scale2) / scale3;
}

// ---- lighting/burnishLit ----

// The weights of a light's diffuse and specular colour, (max(0, N.L), lobe), of order 2, 4, 8, 16
// or 32. N may have any length, such as an interpolated normal; L and V point away from the
// surface and have unit length.
inline float2 burnishLitByCosine(float NoL, float cosine, float zeta, int order) {
    float base = cosine * zeta + (1.0 - zeta);
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
    return float2(max(NoL, 0.0), lobe);
}

// Blinn's model.
inline float2 burnishLit(float3 N, float3 L, float3 V, float zeta, int order) {
    float inverse = burnishInverseSqrt(burnishDot(N, N));
    float NoL = burnishDot(N, L) * inverse;
    float NoV = burnishDot(N, V) * inverse;
    float cosine = burnishHalfCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Phong's model.
inline float2 burnishLitPhong(float3 N, float3 L, float3 V, float zeta, int order) {
    float inverse = burnishInverseSqrt(burnishDot(N, N));
    float NoL = burnishDot(N, L) * inverse;
    float NoV = burnishDot(N, V) * inverse;
    float cosine = burnishReflectCosine(NoL, NoV, burnishDot(L, V));
    return burnishLitByCosine(NoL, cosine, zeta, order);
}

// Blinn's model, L from the surface to a light, of any length.
inline float2 burnishLitPoint(float3 N, float3 L, float3 V, float zeta, int order) {
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
inline float3 burnishLighting(float3 N, float3 L, float3 V, float3 ambient, float3 diffuse,
                              float3 specular, float n) {
    float2 weights = burnishLit(N, L, V, burnishZetaEnergy(n, 2.0), 2);
    float3 color = ambient + diffuse * weights.x + specular * weights.y;
    return color;
}

// ---- math/burnishArctangent ----

// The angle of (x, y) in [-pi, pi], within 1e-6. Vulkan permits an error of 4096 ulp in atan.
inline float burnishArctangent(float y, float x) {
    float high = max(abs(x), abs(y));
    float t = min(abs(x), abs(y)) / max(high, 1.0e-37);
    float z = t * t;

                    float odd = ((((0.0080058695 * z - 0.0374396637) * z + 0.0843499963) * z - 0.1351193412) * z + 0.1988725216) * z;
    float angle = ((odd - 0.3332700497) * z + 0.9999994138) * t;
    if (abs(y) > abs(x)) {
        angle = 1.57079633 - angle;
    }
    if (x < 0.0) {
        angle = 3.14159265 - angle;
    }
    if (y < 0.0) {
        angle = -angle;
    }
    return angle;
}

// ---- lighting/area/burnishEdge ----

// What an edge adds to the light of a polygon: an arc from a to b of the great circle with unit normal n,
// which points into the polygon.

// Lambert's: its sum is 2 times the integral of max(0, N.w).
inline float burnishEdgeDiffuse(float3 a, float3 b, float3 n, float3 N) {
    return burnishArctangent(dot(n, cross(a, b)), dot(a, b)) * dot(n, N);
}

// 1 + u + ... + u^m for m = 1, 2, 4 or 8
inline float burnishPowerSum(float u, int order) {
    float sum = 1.0 + u;
    float power = u * u;
    if (order >= 4) {
        sum = sum * (1.0 + power);
        power = power * power;
    }
    if (order >= 8) {
        sum = sum * (1.0 + power);
        power = power * power;
    }
    if (order >= 2) {
        sum = sum + power;
    }
    return sum;
}

// (1 + u + ... + u^m) / (1 + c) at two points of the arc, whose gaps are 1 - c.
inline float burnishGapPair(float gap1, float gap2, float zeta, int order) {
    float p1 = burnishPowerSum(max(1.0 - zeta * gap1, 0.0), order);
    float p2 = burnishPowerSum(max(1.0 - zeta * gap2, 0.0), order);
    float q1 = 2.0 - gap1;
    float q2 = 2.0 - gap2;
    return (p1 * q2 + p2 * q1) / (q1 * q2);
}

// Nodes and weights of Gauss and Legendre's rule.
inline float2 burnishGaussNode(int i) {
    float2 node = float2(0.183434642, 0.362683783);
    if (i == 1) {
        node = float2(0.52553241, 0.313706646);
    }
    if (i == 2) {
        node = float2(0.796666477, 0.222381034);
    }
    if (i == 3) {
        node = float2(0.960289856, 0.101228536);
    }
    return node;
}

// The lobe's, zeta >= 1: its sum is zeta (m + 1) times the integral of the lobe around R. s is R.n. (xa, ya) and
// (xb, yb) are the ends a and b in the edge's plane: x is the direction nearest to R and k its
// cosine. Outside of the lobe an edge adds the azimuth around R that it sweeps.
// Source: docs/theory.md; Gauss and Legendre's rule with 8 nodes in the tangent of a quarter of the arc.
inline float burnishEdgeLobe(float s, float k, float xa, float ya, float xb, float yb, float zeta,
                             int order) {
    float gap = s * s / (1.0 + k);
    float h = min((1.0 / zeta - gap) / k, 0.999); // 1 - cosine of the end of the lobe
    float2 outside = float2(s * s * xa * xb + ya * yb, s * (xa * yb - xb * ya)); // the whole edge
    float inside = 0.0;
    if (h > 0.0 && k > 0.001) {
        float x = 1.0 - h;
        float y = sqrt(h * (2.0 - h));
        float x1 = xa;
        float y1 = ya;
        float x2 = xb;
        float y2 = yb;
        float2 before = float2(1.0, 0.0);
        float2 after = float2(1.0, 0.0);
        float misses = 0.0;
        if (xa <= 0.0 || abs(ya) > y) {
            x1 = x;
            y1 = -y;
            before = float2(s * s * xa * x - ya * y, -s * (xa * y + x * ya));
            misses = 1.0;
        }
        if (xb <= 0.0 || abs(yb) > y) {
            x2 = x;
            y2 = y;
            after = float2(s * s * x * xb + y * yb, s * (x * yb - xb * y));
            misses = misses + 1.0;
        }
        if (misses < 2.0 || (ya < 0.0 && yb > 0.0)) {
            outside = float2(before.x * after.x - before.y * after.y,
                             before.x * after.y + before.y * after.x);
            // the arc's middle, half of its angle, and the tangent of a quarter of its length
            float2 middle = float2(x1 + x2, y1 + y2);
            middle = middle * rsqrt(dot(middle, middle));
            float2 halved = float2(1.0 + middle.x, middle.y);
            halved = halved * rsqrt(dot(halved, halved));
            float sine = 0.5 * (middle.x * (y2 - y1) - middle.y * (x2 - x1));
            float tangent = sine / (1.0 + middle.x * x2 + middle.y * y2);
            float sum = 0.0;
            for (int i = 0; i < 4; i = i + 1) {
                float2 node = burnishGaussNode(i);
                float t = node.x * tangent;
                float inverse = 1.0 / (1.0 + t * t);
                float bend = 2.0 * k * inverse;
                float sine1 = halved.y + halved.x * t;
                float sine2 = halved.y - halved.x * t;
                float gap1 = gap + bend * sine1 * sine1;
                float gap2 = gap + bend * sine2 * sine2;
                sum = sum + node.y * inverse * burnishGapPair(gap1, gap2, zeta, order);
            }
            inside = 2.0 * zeta * s * tangent * sum;
        }
    }
    return inside + burnishArctangent(outside.y, outside.x);
}

// ---- lighting/area/burnishGgx ----

// GGX as lobes: roughness is the square root of its width alpha.

// (zeta of a lobe of order 4, zeta of its tail of order 1, weight of the tail).
// Source: docs/theory.md, fitted to GGX seen from above. Slopes are 0.78 times that, and the axis
// and the stretch are fitted too: least errors of 8,400 random lights over all views.
inline float3 burnishGgxLobes(float roughness) {
    float r = max(roughness, 0.03);
    float a = r * r;
    float scale = 0.78 / (a * a);

                             float zeta = scale * (0.130873 + a * (0.145536 + a * (0.125278 + a * (0.244102 + a * 0.399355))));

                             float tail = scale * (0.045493 + a * (0.060453 + a * (0.474393 + a * (0.793652 - a * 0.361736))));
    float weight = 0.398137 + a * (0.546989 + a * (-2.960546 + a * (6.946654 - a * 3.944059)));
    return float3(max(zeta, 1.0), max(tail, 1.0), weight);
}

// The axis of the lobes: rough surfaces reflect more toward N.
inline float3 burnishGgxAxis(float3 N, float3 V, float roughness) {
    float NoV = dot(N, V);
    float3 R = N * (2.0 * NoV) - V;
    float lean = pow(roughness, 1.7 + 3.3 * max(NoV, 0.0)) * 1.1 * roughness / (roughness + 0.1);
    float3 axis = R + (N - R) * lean;
    return axis * rsqrt(dot(axis, axis));
}

// GGX is narrower across the plane of N and V. A map makes the lobes round: p becomes p + s (s.p) strength,
// s being this unit vector or 0.
inline float3 burnishGgxAcross(float3 N, float3 V) {
    float3 across = cross(N, V);
    return across * rsqrt(max(dot(across, across), 1.0e-12));
}

inline float burnishGgxStretch(float NoV, float roughness) {
    float x = clamp(NoV, 0.03, 1.0);
    float width = x + (1.0 - x) * 1.5 * roughness * roughness * sqrt(roughness);
    return 1.0 / width - 1.0;
}

// The share F0 x + y of white light that GGX reflects once: fitted to sums over visible normals. From NoV = 0.05
// on, x + y is within 0.013 and y within 0.015. src/shading/environment_simd.h has the same.
inline float2 burnishGgxAlbedo(float NoV, float roughness) {
    float r = roughness;
    float fall = 1.0 - NoV;
    float cubed = fall * fall * fall;
    float above = NoV / (NoV + 1.5 * r * r + 9.536743e-7);
    float below = 1.0 - above;
    float lost = -21.1263 + r * (50.4039 + r * (r * 73.1733 - 45.6626));
    lost = lost * below + (23.1922 + r * (r * (39.2847 - r * 135.1644) - 38.3755));
    lost = lost * below + (r * (r * (r * 92.1318 - 3.6416) - 12.2444) - 1.2358);
    lost = lost * below + (0.0902 + r * (r * (16.1298 - r * 30.1591) - 1.6499));
    lost = max(lost * r * above, 0.0);
    float narrow = NoV + 0.3 + 2.0 * r * r;
    float y = r * (r * 2.9062 - 0.7393) - 0.0746;
    y = y * cubed + (r * (0.4253 - r * 3.192) - 0.0182);
    y = y * cubed + (0.1829 + r * (0.2027 + r * 0.6153));
    y = max(y * cubed / (narrow * narrow), 0.0);
    return float2(1.0 - lost - y, y);
}

// ---- lighting/area/burnishAreaLight ----

// The light of a parallelogram or an ellipse of radiance 1 as vec2(diffuse, specular):
//   diffuse   1 / pi times the integral of max(0, N.w) over the light, at most 1
//   specular  its mean under a lobe: 1 where the light fills the lobe
// Both leave out what is below the horizon of N. The corners are center +- halfU +- halfV, seen from
// the surface; N, R and V have unit length. The light shines to the side of cross(halfU, halfV): sides
// is 1, or 2 if it shines to both.

// The specular part of an edge, 2 pi times too large. s is R.n; lobe is burnishGgxLobes'.
inline float burnishEdgeSpecular(float3 a, float3 b, float3 n, float s, float3 R, float3 lobe,
                                 int order) {
    float3 nearest = R - n * s;
    float k = sqrt(dot(nearest, nearest));
    if (k < 0.0001) { // R is n: all directions are as near
        k = 0.0001;
        nearest = a;
    }
    nearest = nearest * rsqrt(max(dot(nearest, nearest), 1.0e-30));
    float3 across = cross(n, nearest);
    float lengthA = rsqrt(max(dot(a, a), 1.0e-30));
    float lengthB = rsqrt(max(dot(b, b), 1.0e-30));
    float xa = dot(a, nearest) * lengthA;
    float ya = dot(a, across) * lengthA;
    float xb = dot(b, nearest) * lengthB;
    float yb = dot(b, across) * lengthB;
    float result = burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.x, order);
    if (lobe.z > 0.0) {
        result = result + lobe.z * (burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.y, 1) - result);
    }
    return result;
}

// A regular polygon in the coordinates of halfU and halfV: 4 corners at (+-1, +-1), or 12 around a disc
// with its area. The lobes are seen through the map p + across (across.p) stretch.
inline float2 burnishRegularLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                                  float3 R, float3 across, float stretch, float3 lobe, int order, int corners) {
    float3 up = halfV;
    float side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    float2 at = float2(1.0, 1.0);
    float2 turn = float2(0.0, 1.0);
    if (corners == 12) {
        at = float2(1.02332671, 0.0);
        turn = float2(0.866025404, 0.5);
    }
    float3 a = center + halfU * at.x + up * at.y;
    float3 leaves = N;
    float3 enters = N;
    float isCut = 0.0;
    float diffuse = 0.0;
    float specular = 0.0;
    for (int i = 0; i < corners + 1; i = i + 1) {
        float2 next = float2(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        float3 edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        float3 b = a + edge;
        float3 start = a;
        float3 end = b;
        float3 n = cross(a, edge);
        float3 m = cross(a + across * (stretch * dot(a, across)),
                         edge + across * (stretch * dot(edge, across)));
        float heightA = dot(a, N);
        float heightB = dot(b, N);
        float isUp = step(0.0, max(heightA, heightB));
        if (i == corners) { // what the horizon cuts off is replaced by an edge along it
            start = leaves;
            end = enters;
            n = N;
            m = N;
            isUp = isCut;
        } else {
            if (heightA < 0.0 && heightB >= 0.0) {
                start = a + edge * (heightA / (heightA - heightB));
                enters = start;
            }
            if (heightA >= 0.0 && heightB < 0.0) {
                end = a + edge * (heightA / (heightA - heightB));
                leaves = end;
                isCut = 1.0;
            }
        }
        if (isUp > 0.0) {
            n = n * rsqrt(max(dot(n, n), 1.0e-30));
            diffuse = diffuse + burnishEdgeDiffuse(start, end, n, N);
            m = m * rsqrt(max(dot(m, m), 1.0e-30));
            start = start + across * (stretch * dot(start, across));
            end = end + across * (stretch * dot(end, across));
            specular = specular + burnishEdgeSpecular(start, end, m, dot(m, R), R, lobe, order);
        }
        a = b;
        at = next;
    }
    float2 light = float2(clamp(diffuse * 0.159154943, 0.0, 1.0), clamp(specular * 0.159154943,
                          0.0, 1.0));
    if (side == 0.0 || (sides == 1 && side > 0.0)) { // edge on, without area, or from behind
        light = float2(0.0, 0.0);
    }
    return light;
}

// Under the lobe of order 1, 2, 4 or 8 and slope zeta >= 1 around R.
inline float2 burnishRectLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                               float3 R, float zeta, int order) {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, float3(zeta, zeta, 0.0),
                               order, 4);
}

inline float2 burnishDiscLight(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                               float3 R, float zeta, int order) {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, float3(zeta, zeta, 0.0),
                               order, 12);
}

// Under GGX, seen from V. Multiply the specular part by F0 x + y of burnishGgxAlbedo.
inline float2 burnishRectLightGgx(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                                  float3 V, float roughness) {
    float3 R = burnishGgxAxis(N, V, roughness);
    float3 across = burnishGgxAcross(N, V);
    float stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 4);
}

inline float2 burnishDiscLightGgx(float3 center, float3 halfU, float3 halfV, int sides, float3 N,
                                  float3 V, float roughness) {
    float3 R = burnishGgxAxis(N, V, roughness);
    float3 across = burnishGgxAcross(N, V);
    float stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 12);
}

#endif
