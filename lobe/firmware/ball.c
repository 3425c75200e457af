/* Draws frames of the Arduino library's OledBall and sends each as a PBM, white dots being lit. */
#include "target.h"

#include "OledBall/scene.h"

#ifndef FRAMES
#define FRAMES 3
#endif

static scene ball;

static void send_page(void) {
    uint8_t row, column, i;
    for (row = 0; row < 8; ++row) {
        for (column = 0; column < SCENE_WIDTH; column = (uint8_t)(column + 8)) {
            uint8_t byte = 0;
            for (i = 0; i < 8; ++i) {
                byte = (uint8_t)(byte << 1 | !(ball.dots[column + i] >> row & 1));
            }
            target_put(byte);
        }
    }
}

int main(void) {
    static const char header[] = "P4\n128 64\n";
    uint8_t frame, page, i;
    scene_create(&ball);
    for (frame = 0; frame < FRAMES; ++frame) {
        for (i = 0; header[i]; ++i) {
            target_put((uint8_t)header[i]);
        }
        scene_turn(&ball, frame);
        for (page = 0; page < SCENE_PAGES; ++page) {
            target_mark();
            scene_page(&ball, page);
            target_mark();
            send_page();
        }
    }
    target_end();
    return 0;
}
