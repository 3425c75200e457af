/* The picture of OledBall: a chequered ball that bounces and turns, in 128 by 64 dots, black and
 * white. Eight rows are drawn at a time, which is how the display takes them: a byte is eight dots
 * of a column. The same C draws the same dots on any processor.
 *
 * Of each dot of the ball: its normal, which on a ball is its position; N.L and N.H, which change
 * along a row by additions but for the part of z; diffuse light and highlight; the check, from the
 * planes between checks; and an ordered dither. */
#ifndef SCENE_H
#define SCENE_H

#include <burnish.h>

enum {
    SCENE_WIDTH = 128,
    SCENE_PAGES = 8,
    SCENE_RADIUS = 24,             /* dots */
    SCENE_SIZE = 2 * SCENE_RADIUS, /* positions are in half dots, all of them odd */
    SCENE_UNIT = 32700 / SCENE_SIZE,
    SCENE_MERIDIANS = 7, /* those that a side of the ball may show */
    SCENE_LEAN = 2900    /* of the axis; 65536 is a whole turn */
};

typedef struct scene {
    int16_t height[SCENE_SIZE * SCENE_SIZE / 8]; /* Q15: z of a dot, over (R^2 - x^2 - y^2) / 8 */
    int16_t to_light[3], half[3];                /* Q15 */
    int16_t lean[2];                             /* Q15: cosine and sine */
    int8_t meridian[SCENE_MERIDIANS][2];         /* cosine and sine, 127 is 1 */
    uint8_t parity;                              /* of the first meridian's check */
    int16_t x, y;                                /* the ball's middle, dots */
    uint8_t dots[SCENE_WIDTH];                   /* a page; bit 0 is the upper row */
} scene;

/* Of 64 dots, as many light up as a grey needs, spread evenly (Bayer 1973). */
static const uint8_t scene_order[8][8]
#ifdef __AVR__
    PROGMEM
#endif
    = {{0, 32, 8, 40, 2, 34, 10, 42},  {48, 16, 56, 24, 50, 18, 58, 26},
       {12, 44, 4, 36, 14, 46, 6, 38}, {60, 28, 52, 20, 62, 30, 54, 22},
       {3, 35, 11, 43, 1, 33, 9, 41},  {51, 19, 59, 27, 49, 17, 57, 25},
       {15, 47, 7, 39, 13, 45, 5, 37}, {63, 31, 55, 23, 61, 29, 53, 21}};

static uint8_t scene_order_at(uint8_t row, uint8_t column) {
#ifdef __AVR__
    return pgm_read_byte(&scene_order[row & 7][column & 7]);
#else
    return scene_order[row & 7][column & 7];
#endif
}

/* floor(sqrt(x)), by the digits of its square. */
static uint16_t scene_root(uint32_t x) {
    uint16_t root = 0, bit;
    for (bit = 0x8000u; bit; bit >>= 1) {
        const uint32_t next = (uint32_t)root + bit;
        root = next * next <= x ? (uint16_t)next : root;
    }
    return root;
}

/* Once. */
static void scene_create(scene *s) {
    static const int32_t lamp[3] = {-15000, 16000, 18000};
    static const int16_t to_viewer[3] = {0, 0, 0x7FFF};
    uint16_t i;
    for (i = 0; i < SCENE_SIZE * SCENE_SIZE / 8; ++i) {
        s->height[i] =
            (int16_t)scene_root((uint32_t)SCENE_UNIT * SCENE_UNIT * (uint32_t)(8 * i + 6));
    }
    burnish_q15_normalize(lamp, s->to_light);
    burnish_q15_half(s->to_light, to_viewer, s->half);
    s->lean[0] = burnish_ring_cosine(SCENE_LEAN);
    s->lean[1] = burnish_ring_sine(SCENE_LEAN);
}

/* Once per frame, then pages 0 to 7. */
static void scene_turn(scene *s, uint8_t frame) {
    const uint8_t across = frame & 127u, fall = frame & 31u;
    const uint16_t turned = (uint16_t)(across < 64 ? frame * 640u : (uint16_t)(0u - frame * 640u));
    const uint16_t spin = turned & 8191u; /* within a check */
    uint8_t i;
    s->x = (int16_t)(26 + (across < 64 ? across : 127 - across) * 6 / 5);
    s->y = (int16_t)(64 - SCENE_RADIUS - fall * (31 - fall) / 17);
    s->parity = (uint8_t)(turned >> 13);
    for (i = 0; i < SCENE_MERIDIANS; ++i) {
        const uint16_t angle = (uint16_t)(spin + (uint16_t)(i - 3) * 8192u);
        s->meridian[i][0] = (int8_t)(burnish_ring_cosine(angle) >> 8);
        s->meridian[i][1] = (int8_t)(burnish_ring_sine(angle) >> 8);
    }
}

/* Whether a point, x and z of the ball, is beyond a meridian. */
static inline uint8_t scene_beyond(const scene *s, uint8_t meridian, int8_t x, int8_t z) {
    return (int16_t)(x * s->meridian[meridian][0]) >= (int16_t)(z * s->meridian[meridian][1]);
}

/* The parallel's parity: at the equator and 41 degrees from it.  y  127 is 1 */
static inline uint8_t scene_parallel(int8_t y) {
    const uint8_t a = (uint8_t)(y < 0 ? -y : y);
    return (uint8_t)((y < 0) + (a > 84));
}

/* One row of the ball. */
static void scene_row(scene *s, uint8_t row) {
    const int8_t y = (int8_t)(2 * (s->y - row) - 1);
    const uint8_t bit = (uint8_t)(1u << (row & 7u));
    const int16_t inside = (int16_t)(SCENE_SIZE * SCENE_SIZE - y * y);
    int8_t x = -1;
    int16_t lit, shine, east, north;
    uint8_t meridian = 3;
    uint8_t *dot;
    while (x * x <= inside) {
        x = (int8_t)(x - 2);
    }
    x = (int8_t)(x + 2);
    {
        const int16_t nx = (int16_t)(x * SCENE_UNIT), ny = (int16_t)(y * SCENE_UNIT);
        lit = (int16_t)(burnish_strip_scale(nx, s->to_light[0]) +
                        burnish_strip_scale(ny, s->to_light[1]));
        shine =
            (int16_t)(burnish_strip_scale(nx, s->half[0]) + burnish_strip_scale(ny, s->half[1]));
        east = (int16_t)(burnish_strip_scale(nx, s->lean[0]) + burnish_strip_scale(ny, s->lean[1]));
        north =
            (int16_t)(burnish_strip_scale(ny, s->lean[0]) - burnish_strip_scale(nx, s->lean[1]));
    }
    const int16_t lit_step = burnish_strip_scale(2 * SCENE_UNIT, s->to_light[0]);
    const int16_t shine_step = burnish_strip_scale(2 * SCENE_UNIT, s->half[0]);
    const int16_t east_step = burnish_strip_scale(2 * SCENE_UNIT, s->lean[0]);
    const int16_t north_step = burnish_strip_scale(2 * SCENE_UNIT, s->lean[1]);
    dot = s->dots + s->x + (x - 1) / 2;
    for (; x * x <= inside; x = (int8_t)(x + 2), ++dot) {
        const int16_t z = s->height[(uint16_t)(inside - x * x) >> 3];
        const int16_t n_dot_l = (int16_t)(lit + burnish_strip_scale(z, s->to_light[2]));
        const int8_t along = (int8_t)(east >> 8), deep = (int8_t)(z >> 8);
        uint8_t check;
        uint16_t grey; /* UQ1.15 */
        while (meridian < SCENE_MERIDIANS - 1 &&
               scene_beyond(s, (uint8_t)(meridian + 1), along, deep)) {
            ++meridian;
        }
        while (meridian > 0 && !scene_beyond(s, meridian, along, deep)) {
            --meridian;
        }
        check = (uint8_t)(scene_parallel((int8_t)(north >> 8)) + meridian + s->parity) & 1u;
        grey = check ? 0x0800 : 0x0200;
        if (n_dot_l > 0) {
            const int16_t n_dot_h = (int16_t)(shine + burnish_strip_scale(z, s->half[2]));
            grey = burnish_q15_accumulate(grey, check ? 0x4800 : 0x0C00,
                                          burnish_q15_weight((uint16_t)n_dot_l));
            if (n_dot_h > 0) {
                grey =
                    burnish_q15_accumulate(grey, 0x7800, burnish_shift7_q15(48, (uint16_t)n_dot_h));
            }
        }
        if (grey > (uint16_t)(scene_order_at(row, (uint8_t)x >> 1) * 512u + 256u)) {
            *dot |= bit;
        } else {
            *dot &= (uint8_t)~bit;
        }
        lit = (int16_t)(lit + lit_step);
        shine = (int16_t)(shine + shine_step);
        east = (int16_t)(east + east_step);
        north = (int16_t)(north - north_step);
    }
}

/* Draws a page into dots. */
static void scene_page(scene *s, uint8_t page) {
    uint8_t i, row;
    for (i = 0; i < SCENE_WIDTH; ++i) { /* the floor */
        s->dots[i] = page == SCENE_PAGES - 1 && (i & 1u) ? 0x80 : 0;
    }
    for (row = (uint8_t)(page * 8); row < page * 8 + 8; ++row) {
        if (row >= s->y - SCENE_RADIUS && row < s->y + SCENE_RADIUS) {
            scene_row(s, row);
        }
    }
}

#endif
