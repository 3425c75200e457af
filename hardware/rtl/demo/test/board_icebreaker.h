/* board_icebreaker.h: icebreaker with its 4 bits a channel, and a flash memory at its pins that
 * holds teapot.bin. See board_core.h.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DEMO_BOARD_H
#define BURNISH_DEMO_BOARD_H

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "Vicebreaker.h"
#include "seen.h"

/* A flash memory of two commands: 0xAB wakes it, 0x03 and an address read it. */
class flash {
  public:
    explicit flash(const std::string &path) {
        FILE *file = fopen(path.c_str(), "rb");
        int byte;
        while (file && (byte = fgetc(file)) != EOF) {
            bytes.push_back((uint8_t)byte);
        }
        if (file) {
            fclose(file);
        }
    }

    int out(bool select_n, bool clock, bool in) {
        if (select_n) {
            awake = awake || (taken == 8 && command == 0xAB);
            taken = 0;
            command = 0;
        } else if (clock && !clocked) {
            command = taken < 32 ? command << 1 | in : command;
            ++taken;
        } else if (!clock && clocked && taken >= 32 && awake && command >> 24 == 0x03) {
            const uint32_t bit = taken - 32, place = (command & 0xFFFFFFu) - 0x20000u + bit / 8;
            level = place < bytes.size() ? bytes[place] >> (7 - bit % 8) & 1 : 1;
        }
        clocked = clock;
        return level;
    }

  private:
    std::vector<uint8_t> bytes;
    bool awake = false, clocked = false;
    uint32_t command = 0, taken = 0;
    int level = 1;
};

class board {
  public:
    static const int late = 39; /* demo, demo_dither, the pins */

    explicit board(const std::string &tables) : memory(tables + "/teapot.bin") { top.eval(); }

    void tick(unsigned buttons) {
        top.BTN1 = buttons & 1u;
        top.BTN2 = buttons >> 1 & 1u;
        top.BTN3 = buttons >> 2 & 1u;
        top.BTN_N = !(buttons >> 3 & 1u);
        top.CLK = 0;
        top.FLASH_IO1 = (uint8_t)memory.out(top.FLASH_SSB, top.FLASH_SCK, top.FLASH_IO0);
        top.eval();
        top.CLK = 1;
        top.eval();
    }

    seen look() const {
        return {top.dvi_de != 0, top.dvi_hsync != 0, top.dvi_vsync != 0,
                (uint32_t)(top.dvi_r << 8 | top.dvi_g << 4 | top.dvi_b)};
    }

    bool ready() const { return !top.LEDG_N; }

    /* 8 bits a channel to 4 by Bayer's matrix. */
    static uint32_t shown(uint32_t rgb, int x, int y) {
        static const unsigned matrix[4][4] = {
            {0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
        uint32_t color = 0;
        for (int shift = 16; shift >= 0; shift -= 8) {
            const unsigned code = rgb >> shift & 255u;
            color = color << 4 | (code - code / 16 + matrix[y % 4][x % 4]) / 16;
        }
        return color;
    }

    static uint32_t bytes_of(uint32_t color) {
        return (color >> 8) * 0x110000u | (color >> 4 & 15u) * 0x1100u | (color & 15u) * 0x11u;
    }

  private:
    Vicebreaker top;
    flash memory;
};

#endif
