/* board.h: ulx3s, whose picture is decoded from the bits of its four differential pairs.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DEMO_BOARD_H
#define BURNISH_DEMO_BOARD_H

#include <cstdint>

#include "Vulx3s.h"
#include "tmds.h"

/* What leaves the board in a pixel's time. */
struct seen {
    bool visible, hsync, vsync;
    uint32_t color;
};

class board {
  public:
    static const int late = 40; /* demo, demo_tmds, a symbol's own time */

    board() { top.eval(); }

    /* A pixel's time with buttons down: five clocks of two bits. A symbol begins at the rising edge of the clock channel. */
    void tick(unsigned buttons) {
        top.btn = (uint8_t)((buttons & 1u) << 5 | (buttons >> 1 & 1u) << 6 |
                            (buttons >> 2 & 1u) << 3 | (buttons >> 3 & 1u) << 1 | 1u);
        for (int i = 0; i < 10; ++i) {
            top.clk_25mhz = i % 2 == 0;
            top.eval();
            const bool high = top.gpdi_dp >> 3 & 1;
            if (high && !was_high) {
                take();
            }
            was_high = high;
            for (int k = 0; k < 3; ++k) {
                bits[k] |= (top.gpdi_dp >> k & 1u) << count;
            }
            ++count;
        }
    }

    seen look() const { return now; }

    /* Whether its symbols are aligned. */
    bool ready() const { return locked; }

  private:
    Vulx3s top;
    seen now = {false, true, true, 0};
    bool was_high = true, locked = false;
    unsigned bits[3] = {0, 0, 0};
    int count = 0;

    /* A symbol of each channel. Synchronisation stays as it is while bytes are sent; a symbol that
     * is none, or channels that disagree, show as a picture in a wrong place. */
    void take() {
        const decoded blue = decode(bits[0]), green = decode(bits[1]), red = decode(bits[2]);
        locked = count == 10 && (blue.control < 0) == (green.control < 0) &&
                 (blue.control < 0) == (red.control < 0);
        now.visible = blue.control < 0;
        now.color = locked ? red.value << 16 | green.value << 8 | blue.value : 0;
        if (!now.visible) {
            now.hsync = blue.control & 1;
            now.vsync = blue.control >> 1;
        }
        bits[0] = bits[1] = bits[2] = 0;
        count = 0;
    }
};

#endif
