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

// ---- lighting/common/burnishComposite ----

// Composite lobes, closer to cos^n than burnishLobe...: v = min(top, max(0, top - slope lambda)), v = v v, then
// v = v (v + offset) for each offset. The number in a name is the number of multiplications. lobe.h computes the
// constants of an exponent: burnish_composite_create.
fn burnishCompositeOfLambda3(lambda: f32, top: f32, slope: f32, offset1: f32) -> f32 {
    let base = top - slope * lambda;
    let v = clamp(base, 0.0, top);
    var value = v * v;
    value = value * (value + offset1);
    return value;
}

fn burnishCompositeOfLambda4(lambda: f32, top: f32, slope: f32, offset1: f32, offset2: f32) -> f32 {
    var value = burnishCompositeOfLambda3(lambda, top, slope, offset1);
    value = value * (value + offset2);
    return value;
}

fn burnishCompositeOfLambda5(lambda: f32, top: f32, slope: f32, offset1: f32, offset2: f32,
                             offset3: f32) -> f32 {
    var value = burnishCompositeOfLambda4(lambda, top, slope, offset1, offset2);
    value = value * (value + offset3);
    return value;
}

fn burnishCompositeOfLambda6(lambda: f32, top: f32, slope: f32, offset1: f32, offset2: f32,
                             offset3: f32, offset4: f32) -> f32 {
    var value = burnishCompositeOfLambda5(lambda, top, slope, offset1, offset2, offset3);
    value = value * (value + offset4);
    return value;
}

// The same of a cosine.
fn burnishComposite3(cosine: f32, top: f32, slope: f32, offset1: f32) -> f32 {
    return burnishCompositeOfLambda3(1.0 - cosine, top, slope, offset1);
}

fn burnishComposite4(cosine: f32, top: f32, slope: f32, offset1: f32, offset2: f32) -> f32 {
    return burnishCompositeOfLambda4(1.0 - cosine, top, slope, offset1, offset2);
}

fn burnishComposite5(cosine: f32, top: f32, slope: f32, offset1: f32, offset2: f32,
                     offset3: f32) -> f32 {
    return burnishCompositeOfLambda5(1.0 - cosine, top, slope, offset1, offset2, offset3);
}

fn burnishComposite6(cosine: f32, top: f32, slope: f32, offset1: f32, offset2: f32, offset3: f32,
                     offset4: f32) -> f32 {
    return burnishCompositeOfLambda6(1.0 - cosine, top, slope, offset1, offset2, offset3, offset4);
}

// ---- lighting/common/burnishExpFalloff ----

// About e^-x in 3, 4 or 5 multiplications, within 0.0294, 0.00518 and 0.000136: 1 for x <= 0, never increasing, and
// exactly 0 from x = 4.15566015, 5.97967911 and 9.25124741 on. docs/shaders.md has uses.
fn burnishExpFalloff3(x: f32) -> f32 {
    return burnishCompositeOfLambda3(x, 0.942223668, 0.226732612, 0.238612935);
}

fn burnishExpFalloff4(x: f32) -> f32 {
    return burnishCompositeOfLambda4(x, 0.881662667, 0.147443146, 0.275810421, 0.402908295);
}

fn burnishExpFalloff5(x: f32) -> f32 {
    return burnishCompositeOfLambda5(x, 0.812974453, 0.087877281, 0.273172706, 0.955595791,
                                     0.0586450733);
}

// ---- lighting/common/burnishFresnelWeight ----

// Schlick's (1 - cosine)^5 in three multiplications, without pow: the share of white in F0 + (1 - F0) weight.
// Source: Schlick, An Inexpensive BRDF Model for Physically-Based Rendering, 1994.
fn burnishFresnelWeight(cosine: f32) -> f32 {
    let u = clamp(1.0 - cosine, 0.0, 1.0);
    let u2 = u * u;
    return (u2 * u2) * u;
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

// ---- lighting/specular/composite ----

// NoH^shininess within 0.0009 for a shininess in [16, 65536], in one function. What depends on the shininess alone costs
// more than the rest: burnishComposite5 with constants from lobe.h in uniforms is cheaper and closer.
fn specularComposite(NoH: f32, shininess: f32) -> f32 {
    let zeta = max(0.0825871 * shininess - 0.302206 - 0.357094 / shininess, 1.0);
    let b1 = max(0.0221645 - 1.137416 / shininess, 0.0);
    let b2 = max(0.7635843 - 12.38983 / shininess, 0.0);
    let b3 = max(0.0612814 - 1.554842 / shininess, 0.0);
    let scale1 = 1.0 + b1;
    let scale2 = scale1 * (scale1 + b2 * scale1);
    let scale3 = scale2 * (scale2 + b3 * scale2);
    return burnishComposite5(NoH, 1.0, zeta, b1, b2 * scale1, b3 * scale2) / scale3;
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

// ---- math/burnishArctangent ----

// The angle of (x, y) in [-pi, pi], within 1e-6. Vulkan permits an error of 4096 ulp in atan.
fn burnishArctangent(y: f32, x: f32) -> f32 {
    let high = max(abs(x), abs(y));
    let t = min(abs(x), abs(y)) / max(high, 1.0e-37);
    let z = t * t;

                  let odd = ((((0.0080058695 * z - 0.0374396637) * z + 0.0843499963) * z - 0.1351193412) * z + 0.1988725216) * z;
    var angle = ((odd - 0.3332700497) * z + 0.9999994138) * t;
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
fn burnishEdgeDiffuse(a: vec3f, b: vec3f, n: vec3f, N: vec3f) -> f32 {
    return burnishArctangent(dot(n, cross(a, b)), dot(a, b)) * dot(n, N);
}

// 1 + u + ... + u^m for m = 1, 2, 4 or 8
fn burnishPowerSum(u: f32, order: i32) -> f32 {
    var sum = 1.0 + u;
    var power = u * u;
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
fn burnishGapPair(gap1: f32, gap2: f32, zeta: f32, order: i32) -> f32 {
    let p1 = burnishPowerSum(max(1.0 - zeta * gap1, 0.0), order);
    let p2 = burnishPowerSum(max(1.0 - zeta * gap2, 0.0), order);
    let q1 = 2.0 - gap1;
    let q2 = 2.0 - gap2;
    return (p1 * q2 + p2 * q1) / (q1 * q2);
}

// Nodes and weights of Gauss and Legendre's rule.
fn burnishGaussNode(i: i32) -> vec2f {
    var node = vec2f(0.183434642, 0.362683783);
    if (i == 1) {
        node = vec2f(0.52553241, 0.313706646);
    }
    if (i == 2) {
        node = vec2f(0.796666477, 0.222381034);
    }
    if (i == 3) {
        node = vec2f(0.960289856, 0.101228536);
    }
    return node;
}

// The lobe's, zeta >= 1: its sum is zeta (m + 1) times the integral of the lobe around R. s is R.n. (xa, ya) and
// (xb, yb) are the ends a and b in the edge's plane: x is the direction nearest to R and k its
// cosine. Outside of the lobe an edge adds the azimuth around R that it sweeps.
// Source: docs/theory.md; Gauss and Legendre's rule with 8 nodes in the tangent of a quarter of the arc.
fn burnishEdgeLobe(s: f32, k: f32, xa: f32, ya: f32, xb: f32, yb: f32, zeta: f32,
                   order: i32) -> f32 {
    let gap = s * s / (1.0 + k);
    let h = min((1.0 / zeta - gap) / k, 0.999); // 1 - cosine of the end of the lobe
    var outside = vec2f(s * s * xa * xb + ya * yb, s * (xa * yb - xb * ya)); // the whole edge
    var inside = 0.0;
    if (h > 0.0 && k > 0.001) {
        let x = 1.0 - h;
        let y = sqrt(h * (2.0 - h));
        var x1 = xa;
        var y1 = ya;
        var x2 = xb;
        var y2 = yb;
        var before = vec2f(1.0, 0.0);
        var after = vec2f(1.0, 0.0);
        var misses = 0.0;
        if (xa <= 0.0 || abs(ya) > y) {
            x1 = x;
            y1 = -y;
            before = vec2f(s * s * xa * x - ya * y, -s * (xa * y + x * ya));
            misses = 1.0;
        }
        if (xb <= 0.0 || abs(yb) > y) {
            x2 = x;
            y2 = y;
            after = vec2f(s * s * x * xb + y * yb, s * (x * yb - xb * y));
            misses = misses + 1.0;
        }
        if (misses < 2.0 || (ya < 0.0 && yb > 0.0)) {
            outside = vec2f(before.x * after.x - before.y * after.y,
                            before.x * after.y + before.y * after.x);
            // the arc's middle, half of its angle, and the tangent of a quarter of its length
            var middle = vec2f(x1 + x2, y1 + y2);
            middle = middle * inverseSqrt(dot(middle, middle));
            var halved = vec2f(1.0 + middle.x, middle.y);
            halved = halved * inverseSqrt(dot(halved, halved));
            let sine = 0.5 * (middle.x * (y2 - y1) - middle.y * (x2 - x1));
            let tangent = sine / (1.0 + middle.x * x2 + middle.y * y2);
            var sum = 0.0;
            for (var i: i32 = 0; i < 4; i = i + 1) {
                let node = burnishGaussNode(i);
                let t = node.x * tangent;
                let inverse = 1.0 / (1.0 + t * t);
                let bend = 2.0 * k * inverse;
                let sine1 = halved.y + halved.x * t;
                let sine2 = halved.y - halved.x * t;
                let gap1 = gap + bend * sine1 * sine1;
                let gap2 = gap + bend * sine2 * sine2;
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
fn burnishGgxLobes(roughness: f32) -> vec3f {
    let r = max(roughness, 0.03);
    let a = r * r;
    let scale = 0.78 / (a * a);
    let zeta = scale * (0.130873 + a * (0.145536 + a * (0.125278 + a * (0.244102 + a * 0.399355))));
    let tail = scale * (0.045493 + a * (0.060453 + a * (0.474393 + a * (0.793652 - a * 0.361736))));
    let weight = 0.398137 + a * (0.546989 + a * (-2.960546 + a * (6.946654 - a * 3.944059)));
    return vec3f(max(zeta, 1.0), max(tail, 1.0), weight);
}

// The axis of the lobes: rough surfaces reflect more toward N.
fn burnishGgxAxis(N: vec3f, V: vec3f, roughness: f32) -> vec3f {
    let NoV = dot(N, V);
    let R = N * (2.0 * NoV) - V;
    let lean = pow(roughness, 1.7 + 3.3 * max(NoV, 0.0)) * 1.1 * roughness / (roughness + 0.1);
    let axis = R + (N - R) * lean;
    return axis * inverseSqrt(dot(axis, axis));
}

// GGX is narrower across the plane of N and V. A map makes the lobes round: p becomes p + s (s.p) strength,
// s being this unit vector or 0.
fn burnishGgxAcross(N: vec3f, V: vec3f) -> vec3f {
    let across = cross(N, V);
    return across * inverseSqrt(max(dot(across, across), 1.0e-12));
}

fn burnishGgxStretch(NoV: f32, roughness: f32) -> f32 {
    let x = clamp(NoV, 0.03, 1.0);
    let width = x + (1.0 - x) * 1.5 * roughness * roughness * sqrt(roughness);
    return 1.0 / width - 1.0;
}

// The share F0 x + y of white light that GGX reflects once: fitted to sums over visible normals. From NoV = 0.05
// on, x + y is within 0.013 and y within 0.015. src/shading/environment_simd.h has the same.
fn burnishGgxAlbedo(NoV: f32, roughness: f32) -> vec2f {
    let r = roughness;
    let fall = 1.0 - NoV;
    let cubed = fall * fall * fall;
    let above = NoV / (NoV + 1.5 * r * r + 9.536743e-7);
    let below = 1.0 - above;
    var lost = -21.1263 + r * (50.4039 + r * (r * 73.1733 - 45.6626));
    lost = lost * below + (23.1922 + r * (r * (39.2847 - r * 135.1644) - 38.3755));
    lost = lost * below + (r * (r * (r * 92.1318 - 3.6416) - 12.2444) - 1.2358);
    lost = lost * below + (0.0902 + r * (r * (16.1298 - r * 30.1591) - 1.6499));
    lost = max(lost * r * above, 0.0);
    let narrow = NoV + 0.3 + 2.0 * r * r;
    var y = r * (r * 2.9062 - 0.7393) - 0.0746;
    y = y * cubed + (r * (0.4253 - r * 3.192) - 0.0182);
    y = y * cubed + (0.1829 + r * (0.2027 + r * 0.6153));
    y = max(y * cubed / (narrow * narrow), 0.0);
    return vec2f(1.0 - lost - y, y);
}

// ---- lighting/area/burnishAreaLight ----

// The light of a parallelogram or an ellipse of radiance 1 as vec2(diffuse, specular):
//   diffuse   1 / pi times the integral of max(0, N.w) over the light, at most 1
//   specular  its mean under a lobe: 1 where the light fills the lobe
// Both leave out what is below the horizon of N. The corners are center +- halfU +- halfV, seen from
// the surface; N, R and V have unit length. The light shines to the side of cross(halfU, halfV): sides
// is 1, or 2 if it shines to both.

// The specular part of an edge, 2 pi times too large. s is R.n; lobe is burnishGgxLobes'.
fn burnishEdgeSpecular(a: vec3f, b: vec3f, n: vec3f, s: f32, R: vec3f, lobe: vec3f,
                       order: i32) -> f32 {
    var nearest = R - n * s;
    var k = sqrt(dot(nearest, nearest));
    if (k < 0.0001) { // R is n: all directions are as near
        k = 0.0001;
        nearest = a;
    }
    nearest = nearest * inverseSqrt(max(dot(nearest, nearest), 1.0e-30));
    let across = cross(n, nearest);
    let lengthA = inverseSqrt(max(dot(a, a), 1.0e-30));
    let lengthB = inverseSqrt(max(dot(b, b), 1.0e-30));
    let xa = dot(a, nearest) * lengthA;
    let ya = dot(a, across) * lengthA;
    let xb = dot(b, nearest) * lengthB;
    let yb = dot(b, across) * lengthB;
    var result = burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.x, order);
    if (lobe.z > 0.0) {
        result = result + lobe.z * (burnishEdgeLobe(s, k, xa, ya, xb, yb, lobe.y, 1) - result);
    }
    return result;
}

// A regular polygon in the coordinates of halfU and halfV: 4 corners at (+-1, +-1), or 12 around a disc
// with its area. The lobes are seen through the map p + across (across.p) stretch.
fn burnishRegularLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                       across: vec3f, stretch: f32, lobe: vec3f, order: i32, corners: i32) -> vec2f {
    var up = halfV;
    let side = dot(cross(halfU, halfV), center);
    if (side < 0.0) {
        up = -halfV;
    }
    var at = vec2f(1.0, 1.0);
    var turn = vec2f(0.0, 1.0);
    if (corners == 12) {
        at = vec2f(1.02332671, 0.0);
        turn = vec2f(0.866025404, 0.5);
    }
    var a = center + halfU * at.x + up * at.y;
    var leaves = N;
    var enters = N;
    var isCut = 0.0;
    var diffuse = 0.0;
    var specular = 0.0;
    for (var i: i32 = 0; i < corners + 1; i = i + 1) {
        let next = vec2f(turn.x * at.x - turn.y * at.y, turn.y * at.x + turn.x * at.y);
        let edge = halfU * (next.x - at.x) + up * (next.y - at.y);
        let b = a + edge;
        var start = a;
        var end = b;
        var n = cross(a, edge);
        var m = cross(a + across * (stretch * dot(a, across)), edge + across * (stretch * dot(edge,
                      across)));
        let heightA = dot(a, N);
        let heightB = dot(b, N);
        var isUp = step(0.0, max(heightA, heightB));
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
            n = n * inverseSqrt(max(dot(n, n), 1.0e-30));
            diffuse = diffuse + burnishEdgeDiffuse(start, end, n, N);
            m = m * inverseSqrt(max(dot(m, m), 1.0e-30));
            start = start + across * (stretch * dot(start, across));
            end = end + across * (stretch * dot(end, across));
            specular = specular + burnishEdgeSpecular(start, end, m, dot(m, R), R, lobe, order);
        }
        a = b;
        at = next;
    }
    var light = vec2f(clamp(diffuse * 0.159154943, 0.0, 1.0), clamp(specular * 0.159154943, 0.0,
                      1.0));
    if (side == 0.0 || (sides == 1 && side > 0.0)) { // edge on, without area, or from behind
        light = vec2f(0.0, 0.0);
    }
    return light;
}

// Under the lobe of order 1, 2, 4 or 8 and slope zeta >= 1 around R.
fn burnishRectLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                    zeta: f32, order: i32) -> vec2f {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, vec3f(zeta, zeta, 0.0),
                               order, 4);
}

fn burnishDiscLight(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, R: vec3f,
                    zeta: f32, order: i32) -> vec2f {
    return burnishRegularLight(center, halfU, halfV, sides, N, R, N, 0.0, vec3f(zeta, zeta, 0.0),
                               order, 12);
}

// Under GGX, seen from V. Multiply the specular part by F0 x + y of burnishGgxAlbedo.
fn burnishRectLightGgx(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, V: vec3f,
                       roughness: f32) -> vec2f {
    let R = burnishGgxAxis(N, V, roughness);
    let across = burnishGgxAcross(N, V);
    let stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 4);
}

fn burnishDiscLightGgx(center: vec3f, halfU: vec3f, halfV: vec3f, sides: i32, N: vec3f, V: vec3f,
                       roughness: f32) -> vec2f {
    let R = burnishGgxAxis(N, V, roughness);
    let across = burnishGgxAcross(N, V);
    let stretch = burnishGgxStretch(dot(N, V), roughness);
    return burnishRegularLight(center, halfU, halfV, sides, N, R, across, stretch,
                               burnishGgxLobes(roughness), 4, 12);
}
