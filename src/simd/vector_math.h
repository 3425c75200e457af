/* Inverse square root, logarithm, power and arctangent over vectors, in plain multiplies and adds:
 * the same bits on every instruction set.
 *
 * Largest absolute error of c^n and of the Gaussian against the exact ones, n in [1, 65536]: 1e-7
 * (the kernels test measures 8.6e-8 over 2^20 cosines for each of 11 exponents); results below
 * 2^-126 are 0. */
#ifndef BURNISH_SIMD_VECTOR_MATH_H
#define BURNISH_SIMD_VECTOR_MATH_H

#include <string.h>

#include "simd/vector.h"

/* 1 / sqrt(x), relative error at most 1.04e-7 for x in [2^-126, 2^127] (every float of two octaves
 * tried), against 0.9e-7 of an IEEE root and division. For x = 0 the result is near 1e19, so 0
 * times it is 0; for negative x, infinity and NaN it is unspecified and may be NaN.
 *
 * The exponent is halved by a shift, which leaves 3 %. One Newton step whose two constants spread
 * that error evenly leaves 6.5e-4, one step of third order leaves rounding. The first step's idea:
 * Moroz, Walczyk, Hrynchyshyn, Holimath, Cieslinski 2018; the constants are solved anew for this
 * guess. Eleven operations and no division: why it is preferred says bench/NOTES.md. */
BURNISH_INLINE vf vector_inverse_sqrt(vf x) {
    vf y = vf_from_bits(vi_sub(vi_set(0x5f200000), vi_shr(vf_bits(x), 1)));
    vf squared = vf_mul(vf_mul(x, y), y);
    y = vf_mul(y, vf_sub(vf_set(0x1.ae91e4p+0f), vf_mul(vf_set(0x1.686c5ap-1f), squared)));
    vf rest = vf_sub(vf_set(1.0f), vf_mul(vf_mul(x, y), y));
    vf step = vf_mul(rest, vf_add(vf_set(0.5f), vf_mul(vf_set(0.375f), rest)));
    return vf_add(y, vf_mul(y, step));
}

/* Base-2 logarithm of x in [2^-126, 2^126], relative error about 1e-7, also near x = 1: x = 2^e m
 * with m in [sqrt(1/2), sqrt(2)), then (m - 1) P(m - 1), P by Remez exchange to 2.6e-8 relative. */
BURNISH_INLINE vf vector_log2(vf x) {
    vi exponent = vi_sar(vi_sub(vf_bits(x), vi_set(0x3f3504f3)), 23);
    vf f = vf_sub(vf_from_bits(vi_sub(vf_bits(x), vi_shl(exponent, 23))), vf_set(1.0f));
    vf p = vf_set(0.125836993602f);
    p = vf_sub(vf_mul(p, f), vf_set(0.207269727418f));
    p = vf_add(vf_mul(p, f), vf_set(0.215715607726f));
    p = vf_sub(vf_mul(p, f), vf_set(0.238944824982f));
    p = vf_add(vf_mul(p, f), vf_set(0.28791624837f));
    p = vf_sub(vf_mul(p, f), vf_set(0.360703682601f));
    p = vf_add(vf_mul(p, f), vf_set(0.480910642927f));
    p = vf_sub(vf_mul(p, f), vf_set(0.721347346807f));
    p = vf_add(vf_mul(p, f), vf_set(1.44269500365f));
    return vf_add(vf_mul(p, f), vf_from_int(exponent));
}

/* 2^y for y <= 0, relative error below 1e-7; 0 below 2^-126 and for NaN, 1 exactly at y = 0.
 * y = k + r, abs(r) <= 1/2; 2^r = 1 + r P(r), P by Remez exchange to 4.7e-11. */
BURNISH_INLINE vf vector_exp2(vf y) {
    const vf rounder = vf_set(12582912.0f); /* 1.5 * 2^23: its last bits take the integer */
    vf clamped = vf_max(y, vf_set(-126.0f));
    vf shifted = vf_add(clamped, rounder);
    vf r = vf_sub(clamped, vf_sub(shifted, rounder));
    vf p = vf_set(1.5196172078e-5f);
    p = vf_add(vf_mul(p, r), vf_set(0.000154667379032f));
    p = vf_add(vf_mul(p, r), vf_set(0.00133339347832f));
    p = vf_add(vf_mul(p, r), vf_set(0.00961803819968f));
    p = vf_add(vf_mul(p, r), vf_set(0.0555041036676f));
    p = vf_add(vf_mul(p, r), vf_set(0.24022651066f));
    p = vf_add(vf_mul(p, r), vf_set(0.693147180704f));
    p = vf_add(vf_mul(p, r), vf_set(1.0f));
    vi k = vi_sub(vf_bits(shifted), vf_bits(rounder));
    vf scale = vf_from_bits(vi_shl(vi_add(k, vi_set(127)), 23));
    return vf_and_mask(vf_greater(y, vf_set(-126.0f)), vf_mul(p, scale));
}

/* max(0, cosine)^exponent, exponent in [1, 65536]; in [0, 1] for every float, NaN gives 0. */
BURNISH_INLINE vf vector_power(vf cosine, vf exponent) {
    const vf least = vf_set(0x1p-126f);
    vf c = vf_max(vf_min(cosine, vf_set(1.0f)), least);
    vf value = vf_min(vector_exp2(vf_mul(exponent, vector_log2(c))), vf_set(1.0f));
    return vf_and_mask(vf_greater(cosine, least), value);
}

/* x clamped to [0, 1]; NaN gives 0. */
BURNISH_INLINE vf vector_saturate(vf x) {
    return vf_min(vf_max(x, vf_set(0.0f)), vf_set(1.0f));
}

/* The angle of (x, y) in [-pi, pi], at most 2.6e-7 off; 0 for (0, 0). x and y in [-2^126, 2^126].
 *
 * q = min / max; atan(q) / q in q^2 by Remez exchange to 1.4e-8. */
BURNISH_INLINE vf vector_atan2(vf y, vf x) {
    const vf zero = vf_set(0.0f);
    const vf width = vf_max(x, vf_sub(zero, x)), height = vf_max(y, vf_sub(zero, y));
    const vm is_steep = vf_greater(height, width);
    const vf larger = vf_max(vf_blend(is_steep, height, width), vf_set(0x1p-126f));
    const vf q = vf_div(vf_blend(is_steep, width, height), larger), z = vf_mul(q, q);
    vf p = vf_set(0.0029035554525656845f);
    p = vf_sub(vf_mul(p, z), vf_set(0.016283019547727085f));
    p = vf_add(vf_mul(p, z), vf_set(0.0430393862835615f));
    p = vf_sub(vf_mul(p, z), vf_set(0.07533677582337878f));
    p = vf_add(vf_mul(p, z), vf_set(0.10654678085105558f));
    p = vf_sub(vf_mul(p, z), vf_set(0.14207133823830823f));
    p = vf_add(vf_mul(p, z), vf_set(0.19993054126727938f));
    p = vf_sub(vf_mul(p, z), vf_set(0.3333309395812433f));
    vf angle = vf_add(q, vf_mul(q, vf_mul(p, z)));
    angle = vf_blend(is_steep, vf_sub(vf_set(1.57079632679489661923f), angle), angle);
    angle = vf_blend(vf_greater(zero, x), vf_sub(vf_set(3.14159265358979323846f), angle), angle);
    return vf_blend(vf_greater(zero, y), vf_sub(zero, angle), angle);
}

/* Vectors to unit length. */
BURNISH_INLINE void normalize_vectors(const float *const in[3], size_t from, float *const out[3],
                                      size_t to) {
    vf x = vf_load(in[0] + from), y = vf_load(in[1] + from), z = vf_load(in[2] + from);
    vf squared = vf_add(vf_add(vf_mul(x, x), vf_mul(y, y)), vf_mul(z, z));
    vf scale = vector_inverse_sqrt(squared);
    vf_store(out[0] + to, vf_mul(x, scale));
    vf_store(out[1] + to, vf_mul(y, scale));
    vf_store(out[2] + to, vf_mul(z, scale));
}

BURNISH_INLINE void normalize_array(size_t count, const float *const in[3], float *const out[3]) {
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        normalize_vectors(in, i, out, i);
    }
    if (i < count) {
        float block[3][LANES];
        float *const blocks[3] = {block[0], block[1], block[2]};
        const float *const sources[3] = {block[0], block[1], block[2]};
        memset(block, 0, sizeof block);
        for (int axis = 0; axis < 3; ++axis) {
            memcpy(block[axis], in[axis] + i, (count - i) * sizeof(float));
        }
        normalize_vectors(sources, 0, blocks, 0);
        for (int axis = 0; axis < 3; ++axis) {
            memcpy(out[axis] + i, block[axis], (count - i) * sizeof(float));
        }
    }
}

#endif
