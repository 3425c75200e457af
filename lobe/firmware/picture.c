/* A rotating knot in integers: rotate, rasterise, interpolate normals, shade. No floating point,
 * one division per triangle, no memory but the framebuffer, a byte of depth per pixel and two rings
 * of points. The same C runs on every target and on the host and gives the same pixels. */
#include "picture.h"

#include "burnish/shade_q15.h"
#include "object.h"

/* A point in screen space. */
typedef struct point {
    int16_t x, y;      /* 1/16 pixel */
    int16_t z;         /* larger is nearer: 0 .. 255 in 1/64 */
    int16_t normal[3]; /* Q15 */
} point;

/* A triangle ready to be filled. */
typedef struct triangle {
    const point *corner[3];
    int32_t whole, inverse;          /* twice the area, and 2^30 over it */
    int32_t second_step, third_step; /* of edge functions, per pixel */
} triangle;

/* The state of one frame. */
typedef struct stage {
    picture *to;
    burnish_q15_shader shader;
    burnish_q15_light lights[2];
    int16_t turn[3][3]; /* Q15 */
} stage;

enum { ROUND = 256, QUARTER = ROUND / 4 }; /* angle units per turn */

/* sin of a quarter turn in 16 steps, Q15. */
static const int16_t sines[17] FLASH = {0,     3212,  6393,  9512,  12539, 15446,
                                        18204, 20787, 23170, 25329, 27245, 28898,
                                        30273, 31356, 32137, 32609, 32767};

/* sin of an angle in 1/256 turn, linear between 64 values per turn: within 0.0013. */
static int16_t sine(uint8_t angle) {
    const uint8_t half = angle & 127u;
    const uint8_t folded = (uint8_t)(half > QUARTER ? 2 * QUARTER - half : half);
    const uint8_t step = folded >> 2;
    const int16_t low = FLASH_INT16(&sines[step]);
    const int16_t high = FLASH_INT16(&sines[step < 16 ? step + 1 : 16]);
    const int16_t value = (int16_t)(low + (((int32_t)(high - low) * (folded & 3)) >> 2));
    return (int16_t)(angle & 128u ? -value : value);
}

static int16_t cosine(uint8_t angle) {
    return sine((uint8_t)(angle + QUARTER));
}

static int16_t multiply_q15(int16_t a, int16_t b) {
    return (int16_t)(((int32_t)a * b) >> 15);
}

/* Rotates by the frame's angle about the object's axis, then tilts it towards the viewer. */
static void set_turn(int16_t turn[3][3], uint8_t frame) {
    const uint8_t angle = (uint8_t)(frame * (ROUND / 8) + 14), lean = 28;
    const int16_t c = cosine(angle), s = sine(angle), cl = cosine(lean), sl = sine(lean);
    turn[0][0] = c;
    turn[0][1] = (int16_t)-s;
    turn[0][2] = 0;
    turn[1][0] = multiply_q15(s, cl);
    turn[1][1] = multiply_q15(c, cl);
    turn[1][2] = (int16_t)-sl;
    turn[2][0] = multiply_q15(s, sl);
    turn[2][1] = multiply_q15(c, sl);
    turn[2][2] = cl;
}

/* A row of the rotation times a vector of bytes, 127 being 1: Q15, scaled by 127/128. */
static int16_t turned(const int16_t row[3], const int8_t v[3]) {
    const int32_t sum = burnish_q15_multiply_signed(row[0], v[0]) +
                        burnish_q15_multiply_signed(row[1], v[1]) +
                        burnish_q15_multiply_signed(row[2], v[2]);
    return (int16_t)(sum >> 7);
}

/* One ring of the object, rotated and projected. */
static void turn_ring(const stage *on, uint8_t ring, point points[OBJECT_SEGMENTS]) {
    uint8_t segment, k;
    for (segment = 0; segment < OBJECT_SEGMENTS; ++segment) {
        point *p = &points[segment];
        int8_t stored[6];
        for (k = 0; k < 6; ++k) {
            stored[k] = FLASH_INT8(&object_points[ring][segment][k]);
        }
        /* 127 is 31 pixels from the centre */
        p->x = (int16_t)(PICTURE_SIZE * 8 + (turned(on->turn[0], stored) >> 6));
        p->y = (int16_t)(PICTURE_SIZE * 8 - (turned(on->turn[1], stored) >> 6));
        p->z = (int16_t)(8192 + (turned(on->turn[2], stored) >> 2));
        for (k = 0; k < 3; ++k) {
            p->normal[k] = turned(on->turn[k], stored + 3);
        }
    }
}

/* first plus two weighted differences; all fit 16 bits, since neighbouring points are close.
 *   b, c  weights of the second and third corner, Q15 */
static int16_t between(int16_t first, int16_t second, int16_t third, int16_t b, int16_t c) {
    const int32_t sum = burnish_q15_multiply_signed((int16_t)(second - first), b) +
                        burnish_q15_multiply_signed((int16_t)(third - first), c);
    return (int16_t)(first + (int16_t)((sum * 2) >> 16)); /* a shift by a word is the cheapest */
}

/* Shades one pixel. */
static uint16_t shade_pixel(const stage *on, const triangle *t, int16_t b, int16_t c) {
    int16_t normal[3];
    uint16_t color[3];
    uint8_t k;
    for (k = 0; k < 3; ++k) {
        normal[k] = between(t->corner[0]->normal[k], t->corner[1]->normal[k],
                            t->corner[2]->normal[k], b, c);
    }
    burnish_q15_normalize_near(normal, normal);
    burnish_q15_shade(&on->shader, on->lights, 2, normal, color);
    return burnish_q15_rgb565(color);
}

/* An edge function as a weight in Q15, always below 1. */
static int16_t weight(int32_t edge, int32_t inverse) {
    const uint16_t w = (uint16_t)(((uint32_t)edge * (uint32_t)inverse * 2u) >> 16);
    return (int16_t)(w > 0x7FFF ? 0x7FFF : w);
}

/* Twice the signed area of a triangle, positive when it is front-facing. 1/256 pixel squared
 */
static int32_t area(const point *a, const point *b, const point *c) {
    return (int32_t)(b->y - a->y) * (c->x - a->x) - (int32_t)(b->x - a->x) * (c->y - a->y);
}

static int16_t least(int16_t a, int16_t b) {
    return a < b ? a : b;
}
static int16_t most(int16_t a, int16_t b) {
    return a > b ? a : b;
}

/* Fills one row of a triangle from a pixel on, where its edge functions are second and third. */
static void fill_row(const stage *on, const triangle *t, uint16_t pixel, uint8_t count,
                     int32_t second, int32_t third) {
    for (; count > 0; --count, ++pixel, second += t->second_step, third += t->third_step) {
        int16_t b, c;
        uint8_t depth;
        if (second < 0 || third < 0 || t->whole - second - third < 0) {
            continue;
        }
        b = weight(second, t->inverse);
        c = weight(third, t->inverse);
        depth = (uint8_t)(between(t->corner[0]->z, t->corner[1]->z, t->corner[2]->z, b, c) >> 6);
        if (depth > on->to->depth[pixel]) {
            on->to->depth[pixel] = depth;
            on->to->pixels[pixel] = shade_pixel(on, t, b, c);
        }
    }
}

/* Draws the pixels whose centres are inside a triangle or on its edge. */
static void fill(const stage *on, const point *p, const point *q, const point *r) {
    const int32_t whole = area(p, q, r);
    int16_t left, right, top, bottom;
    triangle t;
    if (whole <= 0) {
        return;
    }
    t.corner[0] = p;
    t.corner[1] = q;
    t.corner[2] = r;
    t.whole = whole;
    t.inverse = (int32_t)0x40000000l / whole;
    t.second_step = 16 * (int32_t)(p->y - r->y);
    t.third_step = 16 * (int32_t)(q->y - p->y);
    left = (int16_t)((least(p->x, least(q->x, r->x)) + 7) >> 4);
    right = (int16_t)((most(p->x, most(q->x, r->x)) - 8) >> 4);
    top = (int16_t)((least(p->y, least(q->y, r->y)) + 7) >> 4);
    bottom = (int16_t)((most(p->y, most(q->y, r->y)) - 8) >> 4);
    if (left > right) {
        return;
    }
    for (; top <= bottom; ++top) {
        const point middle = {(int16_t)(left * 16 + 8), (int16_t)(top * 16 + 8), 0, {0, 0, 0}};
        fill_row(on, &t, (uint16_t)(top * PICTURE_SIZE + left), (uint8_t)(right - left + 1),
                 area(p, &middle, r), area(p, q, &middle));
    }
}

/* The background: dusk blue, darker towards the bottom. */
static void clear(picture *to) {
    uint16_t row, column;
    for (row = 0; row < PICTURE_SIZE; ++row) {
        const uint16_t color[3] = {(uint16_t)(3600 - 40 * row), (uint16_t)(5200 - 56 * row),
                                   (uint16_t)(8400 - 80 * row)};
        const uint16_t pixel = burnish_q15_rgb565(color);
        for (column = 0; column < PICTURE_SIZE; ++column) {
            to->pixels[row * PICTURE_SIZE + column] = pixel;
            to->depth[row * PICTURE_SIZE + column] = 0;
        }
    }
}

/* Copper under a white lamp from the upper left and a blue one from the right. */
static void light(stage *on) {
    static const burnish_q15_material copper = {
        {0x1C00, 0x0E00, 0x0900}, {0x6000, 0x2E00, 0x1900}, {0x5800, 0x4A00, 0x3C00}};
    static const uint16_t dim[3] = {0x8000, 0x8000, 0x8000}, white[3] = {0x7800, 0x7800, 0x7400},
                          blue[3] = {0x1000, 0x2800, 0x5000};
    static const int16_t to_viewer[3] = {0, 0, 0x7FFF}, upper_left[3] = {-15000, 21000, 20000},
                         right[3] = {26000, -6000, 6000};
    burnish_q15_shader_create(&on->shader, BURNISH_Q15_SHIFT7, 2, 24, &copper, dim);
    burnish_q15_light_create(&on->lights[0], upper_left, to_viewer, white, &copper);
    burnish_q15_light_create(&on->lights[1], right, to_viewer, blue, &copper);
}

void picture_draw(picture *to, uint8_t frame) {
    point rings[2][OBJECT_SEGMENTS];
    stage on;
    uint8_t ring, segment;
    on.to = to;
    set_turn(on.turn, frame);
    light(&on);
    clear(to);
    turn_ring(&on, 0, rings[0]);
    for (ring = 0; ring < OBJECT_RINGS; ++ring) {
        const point *here = rings[ring & 1];
        point *next = rings[(ring + 1) & 1];
        turn_ring(&on, (uint8_t)(ring + 1 < OBJECT_RINGS ? ring + 1 : 0), next);
        for (segment = 0; segment < OBJECT_SEGMENTS; ++segment) {
            const uint8_t after = (uint8_t)(segment + 1 < OBJECT_SEGMENTS ? segment + 1 : 0);
            fill(&on, &here[segment], &next[after], &next[segment]);
            fill(&on, &here[segment], &here[after], &next[after]);
        }
    }
}

void picture_write(const picture *from, void (*put)(uint8_t byte)) {
    static const char header[] = "P6\n64 64\n255\n";
    uint16_t i;
    for (i = 0; header[i]; ++i) {
        put((uint8_t)header[i]);
    }
    for (i = 0; i < PICTURE_SIZE * PICTURE_SIZE;
         ++i) { /* 5 and 6 bits to 8 by repeating the top ones */
        const uint16_t pixel = from->pixels[i];
        const uint8_t red = (uint8_t)(pixel >> 11), green = (uint8_t)((pixel >> 5) & 63u),
                      blue = (uint8_t)(pixel & 31u);
        put((uint8_t)(red << 3 | red >> 2));
        put((uint8_t)(green << 2 | green >> 4));
        put((uint8_t)(blue << 3 | blue >> 2));
    }
}
