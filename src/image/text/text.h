/* Text within the library: the public function for a part of a string. */
#ifndef BURNISH_IMAGE_TEXT_TEXT_H
#define BURNISH_IMAGE_TEXT_TEXT_H

#include <stddef.h>

#include "burnish/image.h"
#include "burnish/sheet.h"
#include "image/text/strokes.h"

/* burnish_image_draw_text for the first length bytes of text. */
float burnish_text_draw(burnish_image *image, float x, float y, float height,
                        const uint8_t color[3], const char *text, size_t length);

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
