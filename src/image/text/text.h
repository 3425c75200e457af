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

#endif
