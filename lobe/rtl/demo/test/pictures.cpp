/* pictures.cpp: the pictures of the simulated ulx3s, compared with model.h.
 *
 * Usage: pictures TABLES PICTURES FILE.ppm
 *
 * Compares so many pictures, in which the buttons are pressed one after the other: every pixel, and
 * the synchronisation at every clock. FILE.ppm receives the last one.
 * Exits with 1 and a line on a difference.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include "board.h"
#include "model.h"
#include "verilated.h"

namespace {

struct screen {
    board shows;
    size_t clocks = 0, wrong_pixels = 0, wrong_syncs = 0;

    /* One picture from the hardware; a clock for each of 800 x 525 places. core NULL: pixels are
     * not compared, and rgb may be NULL. */
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
                const uint32_t expected = core->pixel(x, y);
                if (expected != now.color && wrong_pixels++ < 5) {
                    fprintf(stderr, "pictures: pixel %d, %d: %06x in place of %06x\n", x, y, now.color,
                            expected);
                }
            }
            for (int k = 0; visible && rgb && k < 3; ++k) {
                rgb[(y * width + x) * 3 + k] = (uint8_t)(now.color >> (16 - 8 * k));
            }
            shows.tick(buttons);
        }
    }
};

void write_picture(const char *name, const std::vector<uint8_t> &rgb) {
    FILE *file = fopen(name, "wb");
    if (!file) {
        fprintf(stderr, "pictures: %s: cannot be written\n", name);
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
    if (argc != 4) {
        fprintf(stderr, "usage: pictures TABLES PICTURES FILE.ppm\n");
        return 2;
    }
    model core(argv[1]);
    screen display;
    const int pictures = atoi(argv[2]);
    std::vector<uint8_t> rgb(width * height * 3);
    for (int i = 0; !display.shows.ready(); ++i) {
        if (i == 20) {
            fprintf(stderr, "pictures: no symbols after 20 pictures\n");
            return 1;
        }
        display.draw(nullptr, 0, nullptr);
        core.next_picture(0);
    }
    for (int i = 0; i < pictures; ++i) {
        display.draw(&core, buttons_of(i), rgb.data());
        core.next_picture(buttons_of(i));
    }
    write_picture(argv[3], rgb);
    printf("pictures: %d, %zu pixels and %zu synchronisations differ from the C core\n", pictures,
           display.wrong_pixels, display.wrong_syncs);
    return display.wrong_pixels || display.wrong_syncs;
}
