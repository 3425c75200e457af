/* A stroke font of burnish's own: a plain technical sans, drawn as the path of a round pen.
 *
 * Units: the middle of the pen runs from 0 (baseline) to 100 (capitals), to 68 (small letters), and
 * down to -26 (descenders); the ink is half a pen wider on every side. */
#ifndef BURNISH_IMAGE_TEXT_STROKE_FONT_H
#define BURNISH_IMAGE_TEXT_STROKE_FONT_H

#include <stddef.h>
#include <stdint.h>

#include "image/text/strokes.h"

enum {
    BURNISH_GLYPH_DIAMETER = 127, /* its place among the characters */
    BURNISH_GLYPH_CAP = 100,
    BURNISH_GLYPH_DESCENDER = -26,
    BURNISH_GLYPH_MAX_STROKES = 1024 /* a test draws every glyph at the largest size */
};

typedef struct burnish_glyph {
    uint8_t left, width, right; /* white left of the ink, width of the pen's path, white right */
    uint8_t stem;               /* x of an inner stem; 0: none */
    uint8_t bars[2];            /* y of inner bars, rising; 0: none. Small letters have 68 here */
    /* M x y: move; L x y, H x, V y: line; C x1 y1 x2 y2 x y: cubic Bezier curve; A x y, B x y: a
     * quarter of an ellipse that leaves horizontally (A) or vertically (B); D x y: a dot. */
    const char *path;
} burnish_glyph;

/* How glyph units become pixels. Baseline, capitals, descenders, the outermost stems, and inner
 * stems and bars keep whole pixels between them, which makes them equally sharp. */
typedef struct burnish_glyph_scale {
    float x, y;   /* pixels of the origin: the middle of the pen at (0, 0) units; y downward */
    float unit;   /* pixels a unit */
    float radius; /* of the pen, in pixels */
} burnish_glyph_scale;

/* The glyph of an ASCII character 32..126 or of a diameter, of '?' for any other. */
const burnish_glyph *burnish_glyph_find(unsigned char character);

/* The whole number of pixels nearest to units >= 0. */
float burnish_glyph_pixels(const burnish_glyph_scale *scale, int units);

/* Flattens a glyph; returns the number of strokes, at most BURNISH_GLYPH_MAX_STROKES. */
size_t burnish_glyph_strokes(const burnish_glyph *glyph, const burnish_glyph_scale *scale,
                             burnish_stroke strokes[BURNISH_GLYPH_MAX_STROKES]);

#endif
