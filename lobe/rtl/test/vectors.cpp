/* vectors.cpp: vectors for axis_tb.v and boundary_tb.v. A line is one: TDATA in 48 bits and the C core's value in 16.
 * Usage: vectors FIT ORDER RESULT ROUND LAMBDA COUNT
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "reference.h"

static uint32_t state = 1;

static uint32_t any(uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return (uint32_t)((uint64_t)state * below >> 32);
}

int main(int argc, char **argv) {
    static const char *const FITS[] = {"TAYLOR", "ENERGY", "SHIFT7", "SHIFT3", "ZETA"};
    if (argc != 7) {
        return 2;
    }
    unsigned which = 0;
    while (strcmp(FITS[which], argv[1]) != 0) {
        if (++which == 5) {
            return 2;
        }
    }
    const unit u = {argv[1], (fit)which, (uint16_t)atoi(argv[2]), (uint16_t)atoi(argv[3]), atoi(argv[4]), atoi(argv[5])};
    for (int i = 0; i < atoi(argv[6]); ++i) {
        /* Half of the angles lie near the highlight, where lobes are not 0. */
        const uint32_t depth = i % 2 ? 0x8001u : 0x0800u;
        vector v = {};
        v.exponent = (uint16_t)(1 + any(i % 2 ? 40 : 1023));
        v.cosine = (uint16_t)(0x8000u - any(depth));
        v.lambda = any(depth << 9) & 0xFFFFFFu;
        v.slope = (uint16_t)any(0x10000);
        v.shift = (uint8_t)any(16);
        const uint64_t control = u.which == FIT_ZETA ? (uint32_t)v.shift << 16 | v.slope : v.exponent;
        const uint64_t data = u.lambda ? control << 24 | v.lambda : control << 16 | v.cosine;
        printf("%012" PRIx64 "%04x\n", data, (unsigned)expected(u, v));
    }
    return 0;
}
