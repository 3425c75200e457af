/* model.h: the demonstration's pictures by the C core, pixel for pixel.
 *
 * Everything but the sphere's root comes from lobe_q15.h and shade_q15.h; Schlick's lobe from the
 * formula of reference.h.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DEMO_MODEL_H
#define BURNISH_DEMO_MODEL_H

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "../../test/reference.h"
#include "burnish/shade_q15.h"

const int width = 640, height = 480, line_clocks = 800, lines = 525;

class model {
  public:
    /* The tables of a folder, without their files' names. */
    explicit model(const std::string &folder)
        : roots(read(folder, "sqrt.mem", 256)), codes(read(folder, "srgb.mem", 1024)),
          halves(read(folder, "light.mem", 256)), names(read(folder, "names.mem", 512)),
          numbers(read(folder, "exponents.mem", 1024)), spans(read(folder, "spans.mem", 128)),
          normals(read(folder, "normals.mem", 18432)) {}

    /* Between two pictures, as demo_state. */
    void next_picture(unsigned buttons) {
        const unsigned pressed = now & ~before;
        left = pressed & 1u ? (left + 1) % 4 : left;
        right = pressed & 2u ? (right + 1) % 4 : right;
        exponent = pressed & 4u ? (exponent + 1) % 16 : exponent;
        phase = now & 8u ? phase : (phase + 1) % 256;
        before = now;
        now = buttons;
    }

    /* The sRGB codes of a pixel, red on top. */
    uint32_t pixel(int x, int y) const {
        const unsigned choice = x < 320 ? left : right;
        const int place = x < 320 ? x : x - 320;
        int16_t normal[3];
        uint16_t color[3];
        switch (object(place, y, normal)) {
        case 1:
            shade(sphere, choice, normal, color);
            break;
        case 2:
            shade(teapot, choice, normal, color);
            break;
        default:
            return ink(place, y, choice) ? 0xEEEEEEu : x == 319 || x == 320 ? 0x444444u : 0x111111u;
        }
        uint32_t rgb = 0;
        for (uint16_t c : color) {
            rgb = rgb << 8 | (uint32_t)codes[c >= BURNISH_Q15_ONE ? 1023u : (unsigned)c >> 5];
        }
        return rgb;
    }

  private:
    typedef std::vector<uint64_t> table;
    table roots, codes, halves, names, numbers, spans, normals;
    unsigned left = 0, right = 1, exponent = 6, phase = 0, now = 0, before = 0;
    const uint16_t sphere[3] = {5, 1, 1}, teapot[3] = {1, 3, 4}; /* eighths */

    static table read(const std::string &folder, const char *name, size_t count) {
        const std::string path = folder + "/" + name;
        FILE *file = fopen(path.c_str(), "r");
        table words;
        unsigned long long word;
        while (file && fscanf(file, "%llx", &word) == 1) {
            words.push_back(word);
        }
        if (file) {
            fclose(file);
        }
        if (words.size() != count) {
            fprintf(stderr, "demo: %s: expected %zu words, found %zu\n", path.c_str(), count,
                    words.size());
            exit(2);
        }
        return words;
    }

    /* The teapot's normal at a place of its map, or 0. */
    uint32_t teapot_at(int x, int y) const {
        const uint64_t span = spans[(size_t)y];
        const int first = span >> 15 & 255, count = (int)(span >> 23);
        if (x < first || x >= first + count) {
            return 0;
        }
        return (uint32_t)normals[(span + (uint64_t)x) & 0x7FFF];
    }

    /* What is seen, and its normal. */
    int object(int place, int y, int16_t normal[3]) const {
        if (place >= 32 && place < 288 && y >= 312 && y < 440) {
            const uint32_t word = teapot_at(place - 32, y - 312);
            normal[0] = (int16_t)(word << 5);
            normal[1] = (int16_t)(word >> 11 << 5);
            normal[2] = (int16_t)(word >> 22 << 5);
            if (word) {
                return 2;
            }
        }
        const int sx = 2 * place - 319, sy = 299 - 2 * y, rest = 65536 - sx * sx - sy * sy;
        if (rest <= 0) {
            return 0;
        }
        const uint64_t word = roots[(size_t)rest >> 8];
        normal[0] = (int16_t)(sx * 128);
        normal[1] = (int16_t)(sy * 128);
        normal[2] = (int16_t)((word & 0xFFFF) + ((word >> 16) * (uint64_t)(rest & 255) >> 8));
        return 1;
    }

    void shade(const uint16_t eighths[3], unsigned choice, const int16_t normal[3],
               uint16_t color[3]) const {
        static const uint16_t exponents[16] = {4,  6,  8,   12,  16,  24,  32,  48,
                                               64, 96, 128, 192, 256, 384, 512, 1023};
        static const unit lobes[4] = {{"", FIT_SHIFT7, 2, 8, 0, 0},
                                      {"", FIT_ROM, 2, 8, 0, 0},
                                      {"", FIT_TAYLOR, 2, 8, 0, 0},
                                      {"", FIT_TAYLOR, 4, 8, 0, 0}};
        const int16_t half[3] = {(int16_t)halves[phase], (int16_t)(halves[phase] >> 16),
                                 (int16_t)(halves[phase] >> 32)};
        vector v = {};
        v.exponent = exponents[exponent];
        v.cosine = burnish_q15_cosine(burnish_q15_dot(normal, half));
        const uint16_t n_dot_l =
            burnish_q15_reflect_cosine(v.cosine, (uint16_t)half[2], (int32_t)normal[2] << 15);
        const uint16_t weight = burnish_q15_weight(n_dot_l);
        const uint16_t lobe = (uint16_t)(257 * expected(lobes[choice], v));
        for (int i = 0; i < 3; ++i) {
            color[i] = (uint16_t)(512 * eighths[i]);
            if (n_dot_l) {
                color[i] = burnish_q15_accumulate(color[i], (uint16_t)(4096 * eighths[i]), weight);
                color[i] = burnish_q15_accumulate(color[i], 0x6000, lobe);
            }
        }
    }

    bool ink(int place, int y, unsigned choice) const {
        const int across = place - 56, down = y - 452;
        if (across < 0 || across >= 192 || down < 0 || down >= 16) {
            return false;
        }
        const uint64_t word = across < 128
                                  ? names[choice * 128 + (size_t)(down * 8 + across / 16)]
                                  : numbers[exponent * 64 + (size_t)(down * 4 + across % 128 / 16)];
        return word >> (15 - across % 16) & 1u;
    }
};

#endif
