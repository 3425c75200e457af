/* reference.h: the result that a unit of rtl/ must give: the C core's bits, or for opponents the
 * same integers from a formula.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RTL_REFERENCE_H
#define BURNISH_RTL_REFERENCE_H

#include <cstdint>

#include "burnish/lobe_q15.h"

enum fit {
    FIT_TAYLOR,
    FIT_ENERGY,
    FIT_SHIFT7,
    FIT_SHIFT3,
    FIT_ZETA,
    FIT_COMPOSITE,
    FIT_POWER,
    FIT_DIVIDER
};

enum { HELD_EXPONENT = 60 };

struct unit {
    const char *name;
    fit which;
    uint16_t order,
        result; /* order: of composites 1, or HELD_EXPONENT if the constants hold still */
    int round, lambda;
};

/* A vector: one word on every port. */
struct vector {
    uint16_t cosine, exponent, slope;
    uint32_t lambda;
    uint8_t shift;
    burnish_composite_q15 composite;
};

/* The slope of a unit's fit. An exponent below the order has no lobe in C; the hardware computes
 * one with the slope of the fit's formula. */
static inline void slope_of(const unit &u, const vector &v, uint16_t *slope, uint8_t *shift) {
    switch (u.which) {
    case FIT_TAYLOR:
        *slope = v.exponent;
        *shift = (uint8_t)(burnish_q15_squarings(u.order) - 1);
        return;
    case FIT_SHIFT7:
        *slope = (uint16_t)(7 * v.exponent);
        *shift = 3;
        return;
    case FIT_SHIFT3:
        *slope = (uint16_t)(3 * v.exponent);
        *shift = 2;
        return;
    case FIT_ENERGY:
        *slope = burnish_q15_energy_slope(v.exponent, u.order, shift);
        return;
    case FIT_ZETA:
        *slope = v.slope;
        *shift = v.shift;
        return;
    default:
        return;
    }
}

/* Schlick's c / (n - n c + c) by a division. */
static inline uint16_t schlick_divided(const vector &v, uint16_t result) {
    const uint64_t c = v.cosine > 0x8000u ? 0x8000u : v.cosine;
    const uint64_t q = (c << result) / (v.exponent * (0x8000u - c) + c);
    return (uint16_t)(q >> result ? (1u << result) - 1u : q);
}

/* The lobe to fewer than 16 bits: fast8 of lobe_q15.h for any number of bits. */
static inline uint16_t fast_to(unsigned bits, uint_fast16_t a, uint8_t squarings) {
    const uint32_t x =
        squarings > 1 ? burnish_q15_fast_at(a, (uint8_t)(squarings - 1)) : 0xFFFFu - a;
    const uint32_t y = x >> (15 - bits); /* stands for the middle of its interval */
    return (uint16_t)((y * (y + 1) + (2u << bits) - 1) >> (bits + 2));
}

static inline uint16_t expected(const unit &u, const vector &v) {
    uint16_t slope = 0;
    uint8_t shift = 0;
    switch (u.which) {
    case FIT_DIVIDER:
        return schlick_divided(v, u.result);
    case FIT_POWER:
        return v.exponent % 16 ? burnish_cosine_power_q15(v.exponent % 16, v.cosine) : 0xFFFFu;
    case FIT_COMPOSITE: {
        burnish_composite_q15 lobe = v.composite;
        if (u.order == HELD_EXPONENT) {
            burnish_composite_q15_create(&lobe, HELD_EXPONENT);
        }
        return u.lambda ? burnish_composite_q15_at_lambda(&lobe, v.lambda)
                        : burnish_composite_q15_at_cosine(&lobe, v.cosine);
    }
    default:
        break;
    }
    slope_of(u, v, &slope, &shift);
    const uint8_t squarings = burnish_q15_squarings(u.order);
    const uint32_t w = u.lambda ? burnish_q15_product_lambda(slope, v.lambda)
                                : burnish_q15_product(slope, burnish_q15_lambda(v.cosine));
    const uint32_t a = w >> shift;
    if (a > 0xFFFFu) {
        return 0;
    }
    if (u.result == 8) {
        return burnish_q15_fast8_at(a, squarings);
    }
    if (u.result < 16) {
        return fast_to(u.result, a, squarings);
    }
    return u.round ? burnish_q15_near_at(a, squarings) : burnish_q15_fast_at(a, squarings);
}

#endif
