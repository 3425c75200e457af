/* The frames that a target sent, side by side and four times as large, as a PNG.
 * Usage: sheet OUTPUT.png < FRAMES.ppm */
#include <stdio.h>
#include <string.h>

#include "../picture.h"
#include "burnish/image.h"

enum { ZOOM = 4 };

/* Copies one frame, every pixel as a square. */
static int take(burnish_image *sheet, int frame) {
    static const char wanted[] = "P6\n64 64\n255\n";
    char header[sizeof wanted] = "";
    uint8_t pixels[PICTURE_SIZE * PICTURE_SIZE * 3];
    if (fread(header, 1, sizeof wanted - 1, stdin) != sizeof wanted - 1 ||
        memcmp(header, wanted, sizeof wanted) != 0 ||
        fread(pixels, 1, sizeof pixels, stdin) != sizeof pixels) {
        return 0;
    }
    for (int row = 0; row < PICTURE_SIZE * ZOOM; ++row) {
        for (int column = 0; column < PICTURE_SIZE * ZOOM; ++column) {
            const uint8_t *from = pixels + 3 * (row / ZOOM * PICTURE_SIZE + column / ZOOM);
            memcpy(sheet->pixels + 3 * (row * sheet->width + frame * PICTURE_SIZE * ZOOM + column),
                   from, 3);
        }
    }
    return 1;
}

int main(int argc, char **argv) {
    burnish_image sheet;
    burnish_error error;
    if (argc != 2) {
        fprintf(stderr, "usage: sheet OUTPUT.png < FRAMES.ppm\n");
        return 2;
    }
    if (burnish_image_create(&sheet, PICTURE_SIZE * ZOOM * PICTURE_FRAMES, PICTURE_SIZE * ZOOM, 3,
                             &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "sheet: %s\n", error.text);
        return 1;
    }
    for (int frame = 0; frame < PICTURE_FRAMES; ++frame) {
        if (!take(&sheet, frame)) {
            fprintf(stderr, "sheet: frame %d: expected a PPM of 64 x 64 pixels\n", frame);
            return 1;
        }
    }
    if (burnish_image_write_png(&sheet, argv[1], &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "sheet: %s\n", error.text);
        return 1;
    }
    burnish_image_destroy(&sheet);
    return 0;
}
