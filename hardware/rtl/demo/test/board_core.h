/* board_core.h: the demonstration without a board, as film.cpp drives it.
 *
 * A board has a constructor that takes the tables' folder; tick, a pixel's time with buttons down;
 * look, what leaves it; ready, whether its picture is complete; late, how many pixels after the
 * column's counter it leaves; shown, the colour of a pixel there, and bytes_of, that as 8 bits a
 * channel.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DEMO_BOARD_H
#define BURNISH_DEMO_BOARD_H

#include <cstdint>
#include <string>

#include "Vdemo_simulated.h"
#include "seen.h"

class board {
  public:
    static const int late = 37; /* demo */

    explicit board(const std::string &) { top.eval(); }

    void tick(unsigned buttons) {
        top.buttons = (uint8_t)buttons;
        top.clk = 0;
        top.eval();
        top.clk = 1;
        top.eval();
    }

    seen look() const {
        return {top.visible != 0, top.hsync != 0, top.vsync != 0,
                (uint32_t)top.red << 16 | (uint32_t)top.green << 8 | top.blue};
    }

    bool ready() const { return true; }

    static uint32_t shown(uint32_t rgb, int, int) { return rgb; }

    static uint32_t bytes_of(uint32_t color) { return color; }

  private:
    Vdemo_simulated top;
};

#endif
