/* film.cpp: the simulated demonstration's pictures, compared with model.h.
 *
 * Usage: film TABLES PICTURES [FOLDER STEP]
 *
 * Compares so many pictures, in which the buttons are pressed one after the other: every pixel, and
 * the synchronisation at every clock. With FOLDER no button is pressed, the light goes STEP steps
 * from picture to picture, and each is written to FOLDER/NUMBER.ppm.
 * Compiled with DEMO_ICEBREAKER or DEMO_ULX3S the module is that board's.
 * Exits with 1 and a line on a difference.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#if defined(DEMO_ICEBREAKER)
#include "board_icebreaker.h"
#elif defined(DEMO_ULX3S)
#include "board_ulx3s.h"
#else
#include "board_core.h"
#endif
#include "model.h"
#include "verilated.h"

namespace {

struct screen {
    board shows;
    size_t clocks = 0, wrong_pixels = 0, wrong_syncs = 0;

    explicit screen(const std::string &tables) : shows(tables) {}

    /* One picture from the hardware; a clock for each of 800 x 525 places. core NULL: pixels are
     * not compared. rgb may be NULL. */
    void draw(const model *core, unsigned buttons, uint8_t *rgb) {
        for (int place = 0; place < line_clocks * lines; ++place, ++clocks) {
            const int y = place / line_clocks, x = place % line_clocks - board::late;
            const bool visible = y < height && x >= 0 && x < width;
            const seen now = shows.look();
            if (clocks > line_clocks) {
                const bool vsync = (y == 489 && x >= 656) || y == 490 || (y == 491 && x < 656);
                wrong_syncs += now.visible != visible || now.hsync == (x >= 656 && x < 752) ||
                               now.vsync == vsync;
            }
            if (visible && core) {
                const uint32_t expected = board::shown(core->pixel(x, y), x, y);
                if (expected != now.color && wrong_pixels++ < 5) {
                    fprintf(stderr, "film: pixel %d, %d: %06x in place of %06x\n", x, y, now.color,
                            expected);
                }
            }
            for (int k = 0; visible && rgb && k < 3; ++k) {
                rgb[(y * width + x) * 3 + k] = (uint8_t)(board::bytes_of(now.color) >> (16 - 8 * k));
            }
            shows.tick(buttons);
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
    for (int i = 0; !display.shows.ready(); ++i) {
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
