/* c^n and exp for pictures: polynomials in plain multiplies and adds, so that the comparison lobes
 * have the same bits on every machine too. The family needs none of this.
 *
 * Largest absolute error of both lobes against the exact ones, n in [1, 65536]: 1e-7 (the kernels
 * test measures 8.6e-8 over 2^20 cosines for each of 11 exponents); results below 2^-126 are 0. */
#ifndef BURNISH_KERNELS_POWER_H
#define BURNISH_KERNELS_POWER_H

#include <stdint.h>
#include <string.h>

static inline uint32_t burnish_kernel_bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline float burnish_kernel_from_bits(uint32_t bits) {
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Base-2 logarithm of x in [2^-126, 2^126], relative error about 1e-7, also near x = 1: x = 2^e m
 * with m in [sqrt(1/2), sqrt(2)), then (m - 1) P(m - 1), P by Remez exchange to 2.6e-8 relative. */
static inline float burnish_kernel_log2(float x) {
    const uint32_t sqrt_half = 0x3f3504f3u;
    int32_t exponent = (int32_t)(burnish_kernel_bits(x) - sqrt_half) >> 23;
    float f = burnish_kernel_from_bits(burnish_kernel_bits(x) - ((uint32_t)exponent << 23)) - 1.0f;
    float p = 0.125836993602f;
    p = p * f - 0.207269727418f;
    p = p * f + 0.215715607726f;
    p = p * f - 0.238944824982f;
    p = p * f + 0.28791624837f;
    p = p * f - 0.360703682601f;
    p = p * f + 0.480910642927f;
    p = p * f - 0.721347346807f;
    p = p * f + 1.44269500365f;
    return p * f + (float)exponent;
}

/* 2^y for y <= 0, relative error below 1e-7; 0 below 2^-126 and for NaN, 1 exactly at y = 0.
 * y = k + r, abs(r) <= 1/2; 2^r = 1 + r P(r), P by Remez exchange to 4.7e-11. */
static inline float burnish_kernel_exp2(float y) {
    const float rounder = 12582912.0f; /* 1.5 * 2^23 */
    float clamped = y > -126.0f ? y : -126.0f;
    float k = (clamped + rounder) - rounder;
    float r = clamped - k;
    float p = 1.5196172078e-5f;
    p = p * r + 0.000154667379032f;
    p = p * r + 0.00133339347832f;
    p = p * r + 0.00961803819968f;
    p = p * r + 0.0555041036676f;
    p = p * r + 0.24022651066f;
    p = p * r + 0.693147180704f;
    p = p * r + 1.0f;
    float scale = burnish_kernel_from_bits((uint32_t)((int32_t)k + 127) << 23);
    return y > -126.0f ? p * scale : 0.0f;
}

/* max(0, cosine)^exponent, exponent in [1, 65536]; in [0, 1] for every float, NaN gives 0. */
static inline float burnish_kernel_power(float cosine, float exponent) {
    float c = cosine < 1.0f ? cosine : 1.0f;
    c = cosine > 0x1p-126f ? c : 0x1p-126f;
    float value = burnish_kernel_exp2(exponent * burnish_kernel_log2(c));
    return cosine > 0x1p-126f ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

/* exp(-(n + .775) lambda): a spherical Gaussian fitted to cos^n (Lagarde 2012, as model.md states
 * it). */
static inline float burnish_kernel_gaussian(float cosine, float exponent) {
    const float log2_e = 1.44269504f;
    float lambda = 1.0f - cosine;
    lambda = lambda > 0.0f ? lambda : 0.0f;
    float value = burnish_kernel_exp2(-((exponent + 0.775f) * log2_e) * lambda);
    return cosine == cosine ? (value < 1.0f ? value : 1.0f) : 0.0f;
}

#endif
