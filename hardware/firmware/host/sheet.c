/* The frames that a target sent, beside and below each other and enlarged, as a PNG.
 *
 * Usage: sheet OUTPUT.png COLUMNS ROWS < FRAMES
 *
 * Frames are binary PPMs, four times as large, or PBMs of a display whose dots light up, three
 * times as large with a gap between them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/image.h"

enum { SIDE_MAX = 256, COUNT_MAX = 64 };

typedef struct frames {
    int width, height, dots, zoom, gap; /* dots: 1 for PBM; gap: pixels of the sheet */
} frames;

/* A display's dot in a frame, and what is between frames. */
static const uint8_t lit[3] = {0xDC, 0xF0, 0xFF}, dark[3] = {0x08, 0x0A, 0x10},
                     between[3] = {0x30, 0x34, 0x3A};

/* Reads a header; the one that follows it must be the same. */
static int read_header(frames *f) {
    char kind[3];
    int largest = 1;
    if (scanf("%2s %d %d", kind, &f->width, &f->height) != 3 ||
        (strcmp(kind, "P6") == 0 && scanf("%d", &largest) != 1) || getchar() != '\n') {
        return 0;
    }
    f->dots = strcmp(kind, "P4") == 0;
    f->zoom = f->dots ? 3 : 4;
    f->gap = f->dots ? 6 : 0;
    return (f->dots || (strcmp(kind, "P6") == 0 && largest == 255)) && f->width > 0 &&
           f->height > 0 && f->width <= SIDE_MAX && f->height <= SIDE_MAX && f->width % 8 == 0;
}

/* Copies one frame, every pixel as a square. left, top: in pixels of the sheet */
static int take(const frames *f, burnish_image *sheet, int left, int top) {
    static uint8_t pixels[SIDE_MAX * SIDE_MAX * 3];
    const size_t size = (size_t)f->width * (size_t)f->height;
    const size_t bytes = f->dots ? size / 8 : size * 3;
    if (fread(pixels, 1, bytes, stdin) != bytes) {
        return 0;
    }
    for (int row = 0; row < f->height * f->zoom; ++row) {
        for (int column = 0; column < f->width * f->zoom; ++column) {
            const int i = row / f->zoom * f->width + column / f->zoom;
            const uint8_t *color = !f->dots                           ? pixels + 3 * i
                                   : pixels[i / 8] >> (7 - i % 8) & 1 ? dark
                                                                      : lit;
            memcpy(sheet->pixels + 3 * ((top + row) * sheet->width + left + column), color, 3);
        }
    }
    return 1;
}

/* All frames but the header of the first, which has been read. */
static int take_all(const frames *f, burnish_image *sheet, int columns, int count) {
    for (int i = 0; i < sheet->width * sheet->height; ++i) {
        memcpy(sheet->pixels + 3 * i, between, 3);
    }
    for (int frame = 0; frame < count; ++frame) {
        frames next = *f;
        if ((frame && (!read_header(&next) || memcmp(&next, f, sizeof next) != 0)) ||
            !take(f, sheet, frame % columns * (f->width * f->zoom + f->gap) + f->gap,
                  frame / columns * (f->height * f->zoom + f->gap) + f->gap)) {
            fprintf(stderr,
                    "sheet: frame %d: expected a picture of %d x %d pixels like the first\n", frame,
                    f->width, f->height);
            return 0;
        }
    }
    return 1;
}

int main(int argc, char **argv) {
    burnish_image sheet;
    burnish_error error;
    frames f;
    const int columns = argc == 4 ? atoi(argv[2]) : 0, rows = argc == 4 ? atoi(argv[3]) : 0;
    if (columns < 1 || rows < 1 || columns > COUNT_MAX || rows > COUNT_MAX) {
        fprintf(stderr, "usage: sheet OUTPUT.png COLUMNS ROWS < FRAMES\n");
        return 2;
    }
    if (!read_header(&f)) {
        fprintf(stderr, "sheet: expected a binary PPM or PBM of at most %d x %d pixels\n", SIDE_MAX,
                SIDE_MAX);
        return 1;
    }
    if (burnish_image_create(&sheet, columns * (f.width * f.zoom + f.gap) + f.gap,
                             rows * (f.height * f.zoom + f.gap) + f.gap, 3,
                             &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "sheet: %s\n", error.text);
        return 1;
    }
    if (!take_all(&f, &sheet, columns, columns * rows)) {
        return 1;
    }
    if (burnish_image_write_png(&sheet, argv[1], &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "sheet: %s\n", error.text);
        return 1;
    }
    burnish_image_destroy(&sheet);
    return 0;
}
