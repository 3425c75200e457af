/* tmds.h: symbols of the Digital Visual Interface, read back.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DEMO_TMDS_H
#define BURNISH_DEMO_TMDS_H

/* Of controls 0 .. 3; Digital Visual Interface specification 1.0, 3.2.2. */
static const unsigned control_symbols[4] = {0x354, 0x0AB, 0x154, 0x2AB};

struct decoded {
    int control; /* 0 .. 3; -1: a byte */
    unsigned value;
};

static inline decoded decode(unsigned symbol) {
    for (int i = 0; i < 4; ++i) {
        if (symbol == control_symbols[i]) {
            return {i, 0};
        }
    }
    const unsigned coded = symbol >> 9 & 1u ? symbol ^ 0x2FFu : symbol;
    const unsigned differ = (coded ^ coded << 1) & 0xFFu;
    return {-1, coded >> 8 & 1u ? differ : differ ^ 0xFEu};
}

#endif
