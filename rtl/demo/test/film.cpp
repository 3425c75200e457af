/* film.cpp: the simulated demonstration's pictures, compared with model.h.
 *
 * Usage: film TABLES PICTURES [FOLDER STEP]
 *
 * Compares so many pictures, in which the buttons are pressed one after the other: every pixel, and
 * the synchronisation at every clock. With FOLDER no button is pressed, the light goes STEP steps
 * from picture to picture, and each is written to FOLDER/NUMBER.ppm.
 * Compiled with DEMO_BOARD the module is icebreaker with its 4 bits a channel, and a flash memory
 * at its pins that holds TABLES/teapot.bin.
 * Exits with 1 and a line on a difference.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifdef DEMO_BOARD
#include "Vicebreaker.h"
typedef Vicebreaker design;
#else
#include "Vdemo_simulated.h"
typedef Vdemo_simulated design;
#endif
#include "model.h"
#include "verilated.h"

namespace {

struct seen {
    bool visible, hsync, vsync;
    uint32_t color;
};

#ifdef DEMO_BOARD

const int late = 39; /* demo, demo_dither, the pins */

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

void tick(design &top, unsigned buttons, flash &memory) {
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

seen look(const design &top) {
    return {top.dvi_de != 0, top.dvi_hsync != 0, top.dvi_vsync != 0,
            (uint32_t)(top.dvi_r << 8 | top.dvi_g << 4 | top.dvi_b)};
}

/* 8 bits a channel to 4 by Bayer's matrix. */
uint32_t shown(uint32_t rgb, int x, int y) {
    static const unsigned matrix[4][4] = {
        {0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    uint32_t color = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const unsigned code = rgb >> shift & 255u;
        color = color << 4 | (code - code / 16 + matrix[y % 4][x % 4]) / 16;
    }
    return color;
}

uint32_t bytes_of(uint32_t color) {
    return (color >> 8) * 0x110000u | (color >> 4 & 15u) * 0x1100u | (color & 15u) * 0x11u;
}

bool ready(const design &top) {
    return !top.LEDG_N;
}

#else

const int late = 37; /* demo */

struct flash {
    explicit flash(const std::string &) {}
};

void tick(design &top, unsigned buttons, flash &) {
    top.buttons = (uint8_t)buttons;
    top.clk = 0;
    top.eval();
    top.clk = 1;
    top.eval();
}

seen look(const design &top) {
    return {top.visible != 0, top.hsync != 0, top.vsync != 0,
            (uint32_t)top.red << 16 | (uint32_t)top.green << 8 | top.blue};
}

uint32_t shown(uint32_t rgb, int, int) {
    return rgb;
}

uint32_t bytes_of(uint32_t color) {
    return color;
}

bool ready(const design &) {
    return true;
}

#endif

struct screen {
    design top;
    flash memory;
    size_t clocks = 0, wrong_pixels = 0, wrong_syncs = 0;

    explicit screen(const std::string &tables) : memory(tables + "/teapot.bin") { top.eval(); }

    /* One picture from the hardware; a clock for each of 800 x 525 places. core NULL: pixels are
     * not compared. rgb may be NULL. */
    void draw(const model *core, unsigned buttons, uint8_t *rgb) {
        for (int place = 0; place < line_clocks * lines; ++place, ++clocks) {
            const int y = place / line_clocks, x = place % line_clocks - late;
            const bool visible = y < height && x >= 0 && x < width;
            const seen now = look(top);
            if (clocks > line_clocks) {
                const bool vsync = (y == 489 && x >= 656) || y == 490 || (y == 491 && x < 656);
                wrong_syncs += now.visible != visible || now.hsync == (x >= 656 && x < 752) ||
                               now.vsync == vsync;
            }
            if (visible && core) {
                const uint32_t expected = shown(core->pixel(x, y), x, y);
                if (expected != now.color && wrong_pixels++ < 5) {
                    fprintf(stderr, "film: pixel %d, %d: %06x in place of %06x\n", x, y, now.color,
                            expected);
                }
            }
            for (int k = 0; visible && rgb && k < 3; ++k) {
                rgb[(y * width + x) * 3 + k] = (uint8_t)(bytes_of(now.color) >> (16 - 8 * k));
            }
            tick(top, buttons, memory);
        }
    }
};

void write_picture(const std::string &folder, int number, const std::vector<uint8_t> &rgb) {
    char name[32];
    snprintf(name, sizeof name, "/%03d.ppm", number);
    FILE *file = fopen((folder + name).c_str(), "wb");
    if (!file) {
        fprintf(stderr, "film: %s%s: cannot be written\n", folder.c_str(), name);
        exit(2);
    }
    fprintf(file, "P6 %d %d 255\n", width, height);
    fwrite(rgb.data(), 1, rgb.size(), file);
    fclose(file);
}

/* Which buttons are down during a picture: one for two pictures, then none for two. */
unsigned buttons_of(int picture) {
    return picture % 4 < 2 ? 1u << picture / 4 % 4 : 0;
}

} // namespace

int main(int argc, char **argv) {
    if (argc != 3 && argc != 5) {
        fprintf(stderr, "usage: film TABLES PICTURES [FOLDER STEP]\n");
        return 2;
    }
    model core(argv[1]);
    screen display(argv[1]);
    const int pictures = atoi(argv[2]), step = argc > 4 ? atoi(argv[4]) : 1;
    std::vector<uint8_t> rgb(width * height * 3);
    for (int i = 0; !ready(display.top); ++i) {
        if (i == 20) {
            fprintf(stderr, "film: the map is not loaded after 20 pictures\n");
            return 1;
        }
        display.draw(nullptr, 0, nullptr);
        core.next_picture(0);
    }
    for (int i = 0; i < pictures; ++i) {
        const unsigned buttons = argc > 4 ? 0 : buttons_of(i);
        for (int k = 1; k < step; ++k) {
            display.draw(nullptr, buttons, nullptr);
            core.next_picture(buttons);
        }
        display.draw(&core, buttons, rgb.data());
        core.next_picture(buttons);
        if (argc > 4) {
            write_picture(argv[3], i, rgb);
        }
    }
    printf("film: %d pictures, %zu pixels and %zu synchronisations differ from the C core\n",
           pictures, display.wrong_pixels, display.wrong_syncs);
    return display.wrong_pixels || display.wrong_syncs;
}
