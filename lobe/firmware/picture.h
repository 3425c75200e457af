/* The picture that every target draws: a rotating knot, shaded by shade_q15.h at every pixel. */
#ifndef BURNISH_FIRMWARE_PICTURE_H
#define BURNISH_FIRMWARE_PICTURE_H

#include <stdint.h>

enum {
    PICTURE_SIZE = 64,  /* pixels per side */
    PICTURE_FRAMES = 4, /* an eighth of a turn apart */
    PICTURE_LARGEST_LINE = 16
};

/* The framebuffer and the depths, 12 KiB: RGB565 as displays take it, and one byte of depth per
 * pixel. */
typedef struct picture {
    uint16_t pixels[PICTURE_SIZE * PICTURE_SIZE]; /* RGB565 */
    uint8_t depth[PICTURE_SIZE * PICTURE_SIZE];   /* larger is nearer */
} picture;

/* Draws one frame and overwrites the picture.
 *   frame  0 .. PICTURE_FRAMES - 1, or any: the rotation continues */
void picture_draw(picture *to, uint8_t frame);

/* Writes the picture as a binary PPM. put takes one byte. */
void picture_write(const picture *from, void (*put)(uint8_t byte));

#endif
