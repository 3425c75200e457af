/* reference.h: what a unit of rtl/ must answer: the C core's bits, or for opponents the same integers as
 * a formula.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RTL_REFERENCE_H
#define BURNISH_RTL_REFERENCE_H

#include "burnish/lobe_q15.h"

enum fit { FIT_TAYLOR, FIT_ENERGY, FIT_SHIFT7, FIT_SHIFT3, FIT_ZETA };

struct unit {
    const char *name;
    fit which;
    uint16_t order, result;
    int round, lambda;
};

/* A vector: one word on every port. */
struct vector {
    uint16_t cosine, exponent, slope;
    uint32_t lambda;
    uint8_t shift;
};

/* The slope of a unit's fit. An exponent below the order makes no lobe in C; the hardware computes it all
 * the same, with the slope that the fit's formula gives. */
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
    }
}

static inline uint16_t expected(const unit &u, const vector &v) {
    uint16_t slope = 0;
    uint8_t shift = 0;
    slope_of(u, v, &slope, &shift);
    const uint8_t squarings = burnish_q15_squarings(u.order);
    const uint32_t w = u.lambda ? burnish_q15_product_lambda(slope, v.lambda)
                                : burnish_q15_product(slope, burnish_q15_lambda(v.cosine));
    if (u.result == 8) {
        return burnish_q15_fast8_of(w, shift, squarings);
    }
    return u.round ? burnish_q15_near_of(w, shift, squarings)
                   : burnish_q15_fast_of(w, shift, squarings);
}

#endif
