/* Text within the library: the public function for a part of a string. */
#ifndef BURNISH_IMAGE_TEXT_TEXT_H
#define BURNISH_IMAGE_TEXT_TEXT_H

#include <stddef.h>

#include "burnish/image.h"
#include "burnish/sheet.h"
#include "image/text/strokes.h"

/* The sign of a diameter in UTF-8. */
#define BURNISH_DIAMETER "\xC3\x98"

/* burnish_image_draw_text for the first length bytes of text. */
float burnish_text_draw(burnish_image *image, float x, float y, float height,
                        const uint8_t color[3], const char *text, size_t length);

/* 1: burnish's own font has a glyph for each character, or for its letter without an accent. */
int burnish_text_is_legible(const char *text);

/* Gives all pixels a colour, opaque. */
void burnish_image_fill(burnish_image *image, const uint8_t color[3]);

/* Text, or as much of it as fits a width together with an ellipsis, in whole characters; the caller
 * releases it. NULL: nothing fits, or out of memory. font: NULL for burnish's own. */
char *burnish_text_fit(const burnish_font *font, const char *text, int height, float width,
                       burnish_memory *memory);

/* Takes the strokes of one glyph. */
typedef void burnish_take_strokes(void *context, const burnish_stroke *strokes, size_t count);

/* The strokes that burnish_text_draw would draw. */
void burnish_text_strokes(float x, float y, float height, const char *text, size_t length,
                          burnish_take_strokes *take, void *context);

/* Strokes that are kept: zeros and `memory` are an empty list. */
typedef struct burnish_stroke_list {
    burnish_stroke *items; /* the caller releases them */
    size_t count, capacity;
    burnish_memory *memory; /* its status tells of failures */
} burnish_stroke_list;

/* Appends to the list `context`: a burnish_take_strokes. */
void burnish_stroke_list_append(void *context, const burnish_stroke *strokes, size_t count);

#endif
