/* Draws frames of the Arduino library's TftRing and sends their pixels, RGB565, the high byte
 * first. */
#include "target.h"

#include "TftRing/scene.h"

#ifndef FRAMES
#define FRAMES 2
#endif

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
