/* The third way in: copy lobe_q15.h and shade_q15.h, and shade with integers only. The loop below is
 * what a microcontroller would run; only the last lines, which write a picture, need a host.
 *
 *     cc -std=c99 -I../../lobe/include/burnish shade_integers.c -o shade_integers && ./shade_integers > sphere.ppm
 */
#include <stdio.h>

#include "shade_q15.h"

enum { SIZE = 96, RADIUS = 44 };

/* The whole root of a number, by the digits of its square. */
static uint16_t root(uint32_t x) {
    uint16_t r = 0;
    uint16_t bit;
    for (bit = 0x800; bit; bit >>= 1) {
        if ((uint32_t)(r + bit) * (uint32_t)(r + bit) <= x) {
            r = (uint16_t)(r + bit);
        }
    }
    return r;
}

int main(void) {
    /* What the surface gives back, and what falls on it: UQ1.15, 0x8000 is 1. */
    static const burnish_q15_material brass = {
        {0x1800, 0x1400, 0x0800}, {0x5800, 0x4400, 0x1C00}, {0x5000, 0x4800, 0x3000}};
    static const uint16_t white[3] = {0x8000, 0x8000, 0x8000};
    /* Directions: Q15, any length for the light, unit length for the viewer. */
    static const int16_t to_light[3] = {-12000, 15000, 16000}, to_viewer[3] = {0, 0, 0x7FFF};

    burnish_q15_light lamp;
    burnish_q15_shader shader;
    uint16_t color[3];
    uint8_t rgb[3];
    int row, column;

    /* Once: everything that does not depend on the pixel. */
    if (!burnish_q15_light_create(&lamp, to_light, to_viewer, white, &brass) ||
        burnish_q15_shader_create(&shader, BURNISH_Q15_ENERGY, 2, 50, &brass, white) !=
            BURNISH_Q15_OK) {
        return 1;
    }
    printf("P6\n%d %d\n255\n", SIZE, SIZE);
    for (row = 0; row < SIZE; ++row) {
        for (column = 0; column < SIZE; ++column) {
            const int32_t x = 2 * column + 1 - SIZE, y = SIZE - 1 - 2 * row;
            const int32_t rest = 4 * RADIUS * RADIUS - x * x - y * y;
            rgb[0] = rgb[1] = rgb[2] = 30;
            if (rest > 0) {
                const int32_t v[3] = {16 * x, 16 * y, root((uint32_t)rest * 256)};
                int16_t normal[3];
                /* Per pixel. Normals that come out of interpolation are nearly of unit length: there
                 * burnish_q15_normalize_near does it in half the time. */
                burnish_q15_normalize(v, normal);
                burnish_q15_shade(&shader, &lamp, 1, normal, color);
                burnish_q15_rgb888(color, rgb);
            }
            fwrite(rgb, 1, 3, stdout);
        }
    }
    return 0;
}
