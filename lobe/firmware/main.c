/* The firmware: draws the frames and sends each as a PPM over the serial line. FRAMES: how many. */
#include "picture.h"
#include "target.h"

#ifndef FRAMES
#define FRAMES PICTURE_FRAMES
#endif

static picture frame;

int main(void) {
    uint8_t i;
    for (i = 0; i < FRAMES; ++i) {
        target_mark();
        picture_draw(&frame, i);
        target_mark();
        picture_write(&frame, target_put);
    }
    target_end();
    return 0;
}
