/* The same frames on the host: what every target's output is compared with, byte by byte. */
#include <stdio.h>

#include "picture.h"

static void put(uint8_t byte) {
    putchar(byte);
}

int main(void) {
    static picture frame;
    for (uint8_t i = 0; i < PICTURE_FRAMES; ++i) {
        picture_draw(&frame, i);
        picture_write(&frame, put);
    }
    return fflush(stdout) == 0 ? 0 : 1;
}
