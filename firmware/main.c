/* The firmware: draws the frames and sends each as a PPM over the serial line. */
#include "picture.h"
#include "target.h"

static picture frame;

int main(void) {
    uint8_t i;
    for (i = 0; i < PICTURE_FRAMES; ++i) {
        target_mark();
        picture_draw(&frame, i);
        target_mark();
        picture_write(&frame, target_put);
    }
    target_end();
    return 0;
}
