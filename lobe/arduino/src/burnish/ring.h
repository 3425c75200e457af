/* burnish/ring.h: a ring that turns, to begin with: an object for strip.h made of sines.
 *
 * How to use it.
 *     burnish_ring ring;
 *     burnish_ring_create(&ring, 32 * 16, 32 * 16, 21 * 16, 9 * 16);      once
 *     burnish_ring_turn(&ring, yaw, pitch);                                per frame
 *     burnish_ring_draw(&ring, &strip);                                    per strip
 *
 * On AVR it takes 250 bytes of memory and 250 more on the stack while it is drawn.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RING_H
#define BURNISH_RING_H

#include "strip.h"

#ifdef __AVR__
#include <avr/pgmspace.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Cross-sections along the ring, an even number, and the corners of each. */
#ifndef BURNISH_RING_SIDES
#define BURNISH_RING_SIDES 24
#endif
#ifndef BURNISH_RING_CORNERS
#define BURNISH_RING_CORNERS 10
#endif

typedef struct burnish_ring {
    int16_t x, y;                           /* the middle, 1/16 pixel */
    int16_t large, small;                   /* radii of ring and tube, 1/16 pixel */
    int16_t deep;                           /* depth of 1/16 pixel */
    int16_t axis[3];                        /* Q15 */
    int16_t outward[BURNISH_RING_SIDES][3]; /* Q15: from the middle to the cross-sections */
    int16_t round[BURNISH_RING_CORNERS][2]; /* Q15: cosine and sine around the tube */
} burnish_ring;

/* The sine of an angle, 65536 being a whole turn: Q15, within 0.0013. */
static inline int16_t burnish_ring_sine(uint16_t angle) {
    static const int16_t quarter[17]
#ifdef __AVR__
        PROGMEM
#endif
        = {0,     3212,  6393,  9512,  12539, 15446, 18204, 20787, 23170,
           25329, 27245, 28898, 30273, 31356, 32137, 32609, 32767};
    const uint16_t half = angle & 0x7FFFu;
    const uint16_t folded = half > 0x4000u ? (uint16_t)(0x8000u - half) : half;
    const uint8_t step = (uint8_t)(folded >> 10), after = step < 16 ? (uint8_t)(step + 1) : step;
#ifdef __AVR__
    const int16_t low = (int16_t)pgm_read_word(&quarter[step]);
    const int16_t high = (int16_t)pgm_read_word(&quarter[after]);
#else
    const int16_t low = quarter[step], high = quarter[after];
#endif
    const int16_t value = (int16_t)(low + burnish_strip_scale((int16_t)(high - low),
                                                              (int16_t)((folded & 1023u) << 5)));
    return (int16_t)(angle & 0x8000u ? -value : value);
}

static inline int16_t burnish_ring_cosine(uint16_t angle) {
    return burnish_ring_sine((uint16_t)(angle + 0x4000u));
}

/* Makes a ring that faces the viewer.
 *   x, y   its middle, 1/16 pixel
 *   large  radius from there to the middle of the tube, 1/16 pixel
 *   small  radius of the tube; large + small below 2048 */
static inline void burnish_ring_create(burnish_ring *ring, int16_t x, int16_t y, int16_t large,
                                       int16_t small) {
    uint8_t i;
    ring->x = x;
    ring->y = y;
    ring->large = large;
    ring->small = small;
    ring->deep = (int16_t)(0x3C00 / (large + small));
    for (i = 0; i < BURNISH_RING_CORNERS; ++i) {
        const uint16_t angle = (uint16_t)(i * (uint16_t)(65536ul / BURNISH_RING_CORNERS));
        ring->round[i][0] = burnish_ring_cosine(angle);
        ring->round[i][1] = burnish_ring_sine(angle);
    }
}

/* Turns the ring: about a vertical axis by yaw, then towards the viewer by pitch; 65536 is a whole
 * turn. */
static inline void burnish_ring_turn(burnish_ring *ring, uint16_t yaw, uint16_t pitch) {
    const int16_t cy = burnish_ring_cosine(yaw), sy = burnish_ring_sine(yaw);
    const int16_t cp = burnish_ring_cosine(pitch), sp = burnish_ring_sine(pitch);
    const int16_t across[3] = {cy, burnish_strip_scale(sy, sp),
                               (int16_t)-burnish_strip_scale(sy, cp)};
    const int16_t up[3] = {0, cp, sp};
    uint8_t i, k;
    ring->axis[0] = sy;
    ring->axis[1] = (int16_t)-burnish_strip_scale(cy, sp);
    ring->axis[2] = burnish_strip_scale(cy, cp);
    for (i = 0; i < BURNISH_RING_SIDES; ++i) {
        const uint16_t angle = (uint16_t)(i * (uint16_t)(65536ul / BURNISH_RING_SIDES));
        const int16_t c = burnish_ring_cosine(angle), s = burnish_ring_sine(angle);
        for (k = 0; k < 3; ++k) {
            ring->outward[i][k] =
                (int16_t)(burnish_strip_scale(across[k], c) + burnish_strip_scale(up[k], s));
        }
    }
}

/* The corners of a cross-section. */
static inline void burnish_ring_section(const burnish_ring *ring, uint8_t side,
                                        burnish_strip_corner corners[BURNISH_RING_CORNERS]) {
    const int16_t *outward = ring->outward[side];
    int16_t middle[3];
    uint8_t i, k;
    for (k = 0; k < 3; ++k) {
        middle[k] = burnish_strip_scale(ring->large, outward[k]);
    }
    for (i = 0; i < BURNISH_RING_CORNERS; ++i) {
        burnish_strip_corner *to = &corners[i];
        for (k = 0; k < 3; ++k) {
            to->normal[k] = (int16_t)(burnish_strip_scale(outward[k], ring->round[i][0]) +
                                      burnish_strip_scale(ring->axis[k], ring->round[i][1]));
        }
        to->x = (int16_t)(ring->x + middle[0] + burnish_strip_scale(to->normal[0], ring->small));
        to->y = (int16_t)(ring->y - middle[1] - burnish_strip_scale(to->normal[1], ring->small));
        to->z = (int16_t)(0x4000 + (middle[2] + burnish_strip_scale(to->normal[2], ring->small)) *
                                       ring->deep);
    }
}

/* Draws the part of the ring that is in the strip. */
static inline void burnish_ring_draw(const burnish_ring *ring, const burnish_strip *strip) {
    burnish_strip_corner corners[2][BURNISH_RING_CORNERS];
    uint8_t held[2] = {255, 255}, side, i;
    const int16_t above = (int16_t)(strip->top * 16 - ring->small);
    const int16_t below = (int16_t)((strip->top + strip->rows) * 16 + ring->small);
    for (side = 0; side < BURNISH_RING_SIDES; ++side) {
        const uint8_t ends[2] = {side, (uint8_t)(side + 1 < BURNISH_RING_SIDES ? side + 1 : 0)};
        const int16_t y =
            (int16_t)(ring->y - burnish_strip_scale(ring->large, ring->outward[ends[0]][1]));
        const int16_t next_y =
            (int16_t)(ring->y - burnish_strip_scale(ring->large, ring->outward[ends[1]][1]));
        const burnish_strip_corner *here = corners[side & 1], *next = corners[(side + 1) & 1];
        if ((y < above && next_y < above) || (y > below && next_y > below)) {
            continue;
        }
        for (i = 0; i < 2; ++i) {
            if (held[ends[i] & 1] != ends[i]) {
                held[ends[i] & 1] = ends[i];
                burnish_ring_section(ring, ends[i], corners[ends[i] & 1]);
            }
        }
        for (i = 0; i < BURNISH_RING_CORNERS; ++i) {
            const uint8_t after = (uint8_t)(i + 1 < BURNISH_RING_CORNERS ? i + 1 : 0);
            burnish_strip_triangle(strip, &here[i], &next[i], &next[after]);
            burnish_strip_triangle(strip, &here[i], &next[after], &here[after]);
        }
    }
}

#ifdef __cplusplus
}
#endif

#endif
