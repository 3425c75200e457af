/* Draws frames of a copper ring that turns under two lamps, with the Arduino library's strip.h and
 * ring.h, and sends their pixels, RGB565, the high byte first. Four rows at a time: no framebuffer,
 * 640 bytes of colours and 320 of depth. */
#include <burnish.h>

#include "target.h"

#ifndef FRAMES
#define FRAMES 2
#endif

enum { SCENE_SIZE = 80, SCENE_ROWS = 4, SCENE_STRIPS = SCENE_SIZE / SCENE_ROWS };

typedef struct scene {
    burnish_ring ring;
    burnish_strip strip;
    burnish_q15_shader shader;
    burnish_q15_light lights[2];
    uint8_t depth[SCENE_SIZE * SCENE_ROWS];
    uint16_t colors[SCENE_SIZE * SCENE_ROWS]; /* a strip, RGB565 */
} scene;

static void scene_pixel(void *user_data, uint8_t x, uint8_t y, const int16_t normal[3]) {
    scene *s = (scene *)user_data;
    uint16_t color[3];
    burnish_q15_shade(&s->shader, s->lights, 2, normal, color);
    s->colors[(uint16_t)y * SCENE_SIZE + x] = burnish_q15_rgb565(color);
}

/* Once. Colours are UQ1.15, 0x8000 is 1; directions are Q15. */
static void scene_create(scene *s) {
    static const burnish_q15_material copper = {
        {0x1C00, 0x0E00, 0x0900}, {0x6000, 0x2E00, 0x1900}, {0x5800, 0x4A00, 0x3C00}};
    static const uint16_t dim[3] = {0x8000, 0x8000, 0x8000}, white[3] = {0x7800, 0x7800, 0x7400},
                          blue[3] = {0x1000, 0x2800, 0x5000};
    static const int16_t to_viewer[3] = {0, 0, 0x7FFF}, upper_left[3] = {-15000, 21000, 20000},
                         right[3] = {26000, -6000, 6000};
    burnish_q15_shader_create(&s->shader, BURNISH_Q15_SHIFT7, 2, 24, &copper, dim);
    burnish_q15_light_create(&s->lights[0], upper_left, to_viewer, white, &copper);
    burnish_q15_light_create(&s->lights[1], right, to_viewer, blue, &copper);
    burnish_ring_create(&s->ring, SCENE_SIZE * 8, SCENE_SIZE * 8, SCENE_SIZE * 27 / 5,
                        SCENE_SIZE * 11 / 5);
    s->strip.depth = s->depth;
    s->strip.width = SCENE_SIZE;
    s->strip.rows = SCENE_ROWS;
    s->strip.pixel = scene_pixel;
    s->strip.user_data = s;
}

/* Once per frame, then all strips. */
static void scene_turn(scene *s, uint8_t frame) {
    burnish_ring_turn(&s->ring, (uint16_t)(frame * 1024u), (uint16_t)(frame * 512u + 6000u));
}

/* Draws a strip into colors. */
static void scene_strip(scene *s, uint8_t strip) {
    uint16_t i;
    for (i = 0; i < SCENE_SIZE * SCENE_ROWS; ++i) {
        s->colors[i] = 0x0842; /* nearly black */
    }
    s->strip.top = (uint8_t)(strip * SCENE_ROWS);
    burnish_strip_clear(&s->strip);
    burnish_ring_draw(&s->ring, &s->strip);
}

static scene ring;

int main(void) {
    uint8_t frame, strip;
    uint16_t i;
    scene_create(&ring);
    for (frame = 0; frame < FRAMES; ++frame) {
        scene_turn(&ring, frame);
        for (strip = 0; strip < SCENE_STRIPS; ++strip) {
            target_mark();
            scene_strip(&ring, strip);
            target_mark();
            for (i = 0; i < SCENE_SIZE * SCENE_ROWS; ++i) {
                target_put((uint8_t)(ring.colors[i] >> 8));
                target_put((uint8_t)ring.colors[i]);
            }
        }
    }
    target_end();
    return 0;
}
