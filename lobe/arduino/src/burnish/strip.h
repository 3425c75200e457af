/* burnish/strip.h: triangles with normals into a few rows of a picture, for processors with 2 KB.
 *
 * What it is. A rasteriser without a framebuffer. A picture is drawn strip by strip: for every
 * strip, all triangles; of each pixel, the nearest triangle's normal, interpolated and of unit
 * length, goes to a function of yours, which shades it and keeps the colour. A strip needs one byte
 * per pixel, for its depth.
 *
 * How to use it.
 *   1. Keep a byte of depth and your colours for a strip, say 64 by 8 pixels.
 *   2. For each strip:
 *          burnish_strip strip = {depth, 64, 8, 0, pixel, &colors};
 *          strip.top = 8 * i;
 *          burnish_strip_clear(&strip);
 *          burnish_strip_triangle(&strip, &corner[0], &corner[1], &corner[2]);    and so on
 *          send the colours to the display
 *   ring.h draws a whole object like this.
 *
 * What it promises. Integers only; the same pixels on every processor, and whatever the strips'
 * height. A pixel belongs to a triangle when its centre is inside it or on an edge. No memory is
 * touched outside the strip.
 *
 * What it does not do. No perspective, no clipping in depth, no antialiasing.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_STRIP_H
#define BURNISH_STRIP_H

#include "shade_q15.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A triangle's corner on the screen. */
typedef struct burnish_strip_corner {
    int16_t x, y;      /* 1/16 pixel, from the picture's upper left corner: -4096 .. 8191 */
    int16_t z;         /* larger is nearer: 0x200 .. 0x7E00, compared in steps of 0x80 */
    int16_t normal[3]; /* Q15: unit length, corners of a triangle at most 60 degrees apart */
} burnish_strip_corner;

/* Takes a pixel that is nearer than all before.
 *   x, y    0 .. width - 1 and 0 .. rows - 1, from the strip's upper left
 *   normal  Q15, unit */
typedef void burnish_strip_pixel(void *user_data, uint8_t x, uint8_t y, const int16_t normal[3]);

typedef struct burnish_strip {
    uint8_t *depth; /* width * rows bytes of yours */
    uint8_t width;  /* pixels */
    uint8_t rows;   /* pixels */
    uint8_t top;    /* the picture's row that is the strip's first */
    burnish_strip_pixel *pixel;
    void *user_data;
} burnish_strip;

/* Begins a strip: nothing is in it. */
static inline void burnish_strip_clear(const burnish_strip *strip) {
    uint16_t i;
    for (i = 0; i < (uint16_t)strip->width * strip->rows; ++i) {
        strip->depth[i] = 0;
    }
}

/* ---- Steps ----------------------------------------------------------------------------------- */

/* floor(a b / 2^15) of a length and a Q15 number. */
BURNISH_Q15_INLINE int16_t burnish_strip_scale(int16_t a, int16_t b) {
    return (int16_t)((burnish_q15_multiply_signed(a, b) * 2) >> 16);
}

/* Twice the signed area of a triangle, above 0 when it is front-facing.  1/256 pixel squared */
static inline int32_t burnish_strip_area(const burnish_strip_corner *a,
                                         const burnish_strip_corner *b,
                                         const burnish_strip_corner *c) {
    return burnish_q15_multiply_signed((int16_t)(b->y - a->y), (int16_t)(c->x - a->x)) -
           burnish_q15_multiply_signed((int16_t)(b->x - a->x), (int16_t)(c->y - a->y));
}

/* An edge function over the whole area, in Q15. Modulo 2 where it is outside the triangle.
 *   inverse  2^30 over the whole area */
BURNISH_Q15_INLINE int16_t burnish_strip_weight(int32_t edge, uint32_t inverse) {
    const uint16_t w = (uint16_t)(((uint32_t)edge * inverse * 2u) >> 16);
    return (int16_t)w;
}

/* What is interpolated: depth and normal. */
enum { BURNISH_STRIP_VALUES = 4 };

/* A triangle being drawn. first is the corner's that has no weight of its own. */
typedef struct burnish_strip_setup {
    int16_t first[BURNISH_STRIP_VALUES];
    int16_t to_second[BURNISH_STRIP_VALUES], to_third[BURNISH_STRIP_VALUES];
    int16_t step[BURNISH_STRIP_VALUES]; /* per pixel of a row */
    uint32_t inverse;
    int32_t whole, second_step, third_step;
} burnish_strip_setup;

/* to_second b + to_third c */
BURNISH_Q15_INLINE int16_t burnish_strip_mix(const burnish_strip_setup *t, uint8_t k, int16_t b,
                                             int16_t c) {
    return (int16_t)(uint16_t)((((uint32_t)burnish_q15_multiply_signed(t->to_second[k], b) +
                                 (uint32_t)burnish_q15_multiply_signed(t->to_third[k], c)) *
                                2u) >>
                               16);
}

/* 63/64 of a component: the rounded steps of a row do not overflow at -1 and 1. */
BURNISH_Q15_INLINE int16_t burnish_strip_shorten(int16_t x) {
    return (int16_t)(x - (x >> 6));
}

static inline void burnish_strip_set_up(burnish_strip_setup *t, const burnish_strip_corner *a,
                                        const burnish_strip_corner *b,
                                        const burnish_strip_corner *c) {
    uint8_t k;
    int16_t second, third;
    t->inverse = 0x40000000ul / (uint32_t)t->whole;
    t->second_step = (int32_t)16 * (int16_t)(a->y - c->y);
    t->third_step = (int32_t)16 * (int16_t)(b->y - a->y);
    /* Of triangles thinner than a pixel steps may overflow: no pixel follows another in a row. */
    second = burnish_strip_weight(t->second_step, t->inverse);
    third = burnish_strip_weight(t->third_step, t->inverse);
    for (k = 0; k < BURNISH_STRIP_VALUES; ++k) {
        const int16_t from = k ? burnish_strip_shorten(a->normal[k - 1]) : a->z;
        t->first[k] = from;
        t->to_second[k] = (int16_t)((k ? burnish_strip_shorten(b->normal[k - 1]) : b->z) - from);
        t->to_third[k] = (int16_t)((k ? burnish_strip_shorten(c->normal[k - 1]) : c->z) - from);
        t->step[k] = burnish_strip_mix(t, k, second, third);
    }
}

/* One row of a triangle.
 *   x, end         columns that it may cover: x .. end - 1
 *   second, third  edge functions at column x, the weights of the second and third corner */
static inline void burnish_strip_row(const burnish_strip *strip, const burnish_strip_setup *t,
                                     uint8_t x, uint8_t end, uint8_t y, int32_t second,
                                     int32_t third) {
    const int32_t first_step = t->second_step + t->third_step;
    int32_t first = t->whole - second - third;
    int16_t value[BURNISH_STRIP_VALUES], b, c;
    uint8_t *depth, k;
    while ((first | second | third) < 0) {
        if (++x >= end) {
            return;
        }
        second += t->second_step;
        third += t->third_step;
        first -= first_step;
    }
    b = burnish_strip_weight(second, t->inverse);
    c = burnish_strip_weight(third, t->inverse);
    /* a weight of 1 is the largest number */
    b = b < 0 ? (int16_t)0x7FFF : b;
    c = c < 0 ? (int16_t)0x7FFF : c;
    for (k = 0; k < BURNISH_STRIP_VALUES; ++k) {
        value[k] = (int16_t)(t->first[k] + burnish_strip_mix(t, k, b, c));
    }
    depth = strip->depth + (uint16_t)y * strip->width + x;
    for (;;) {
        const uint8_t z = (uint8_t)((uint16_t)value[0] >> 7);
        if (z > *depth) {
            int16_t normal[3];
            *depth = z;
            burnish_q15_normalize_near(value + 1, normal);
            strip->pixel(strip->user_data, x, y, normal);
        }
        second += t->second_step;
        third += t->third_step;
        first -= first_step;
        if (++x >= end || (first | second | third) < 0) {
            return;
        }
        ++depth;
        for (k = 0; k < BURNISH_STRIP_VALUES; ++k) {
            value[k] = (int16_t)(value[k] + t->step[k]);
        }
    }
}

BURNISH_Q15_INLINE int16_t burnish_strip_least(int16_t a, int16_t b, int16_t c) {
    const int16_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

BURNISH_Q15_INLINE int16_t burnish_strip_most(int16_t a, int16_t b, int16_t c) {
    const int16_t ab = a > b ? a : b;
    return ab > c ? ab : c;
}

/* ---- Drawing --------------------------------------------------------------------------------- */

/* Draws a triangle's part of the strip, when it is front-facing: a, b, c counter-clockwise as seen.
 * One division where it has a pixel here. strip    cleared for this row of strips a, b, c  at most
 * 255 pixels apart in x and in y */
static inline void burnish_strip_triangle(const burnish_strip *strip, const burnish_strip_corner *a,
                                          const burnish_strip_corner *b,
                                          const burnish_strip_corner *c) {
    burnish_strip_setup t;
    burnish_strip_corner middle;
    int16_t left, right, row, bottom; /* of pixels; one beyond the last */
    row = (int16_t)((burnish_strip_least(a->y, b->y, c->y) + 7) >> 4);
    bottom = (int16_t)((burnish_strip_most(a->y, b->y, c->y) + 8) >> 4);
    row = row < strip->top ? strip->top : row;
    bottom = bottom > strip->top + strip->rows ? (int16_t)(strip->top + strip->rows) : bottom;
    if (row >= bottom) {
        return;
    }
    left = (int16_t)((burnish_strip_least(a->x, b->x, c->x) + 7) >> 4);
    right = (int16_t)((burnish_strip_most(a->x, b->x, c->x) + 8) >> 4);
    left = left < 0 ? (int16_t)0 : left;
    right = right > strip->width ? (int16_t)strip->width : right;
    t.whole = burnish_strip_area(a, b, c);
    if (left >= right || t.whole <= 0) {
        return;
    }
    burnish_strip_set_up(&t, a, b, c);
    middle.x = (int16_t)(left * 16 + 8);
    for (; row < bottom; ++row) {
        middle.y = (int16_t)(row * 16 + 8);
        burnish_strip_row(strip, &t, (uint8_t)left, (uint8_t)right, (uint8_t)(row - strip->top),
                          burnish_strip_area(a, &middle, c), burnish_strip_area(a, b, &middle));
    }
}

#ifdef __cplusplus
}
#endif

#endif
