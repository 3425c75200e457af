/* Text that is written piece by piece, with numbers that no locale changes. */
#ifndef BURNISH_IMAGE_TEXT_WRITER_H
#define BURNISH_IMAGE_TEXT_WRITER_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

/* All zero before the first piece, but for memory, whose status errors go to. */
typedef struct burnish_text_writer {
    burnish_memory memory;
    char *text; /* ends in 0 */
    size_t size, capacity;
} burnish_text_writer;

void burnish_put(burnish_text_writer *w, const char *text, size_t size);
void burnish_put_text(burnish_text_writer *w, const char *text);

/* value / 10^digits as a decimal, in the shortest exact form, without a 0 before the point: -1205
 * with 2 digits is "-12.05". A blank separates it from a preceding number if necessary. */
void burnish_put_decimal(burnish_text_writer *w, int64_t value, int digits, int needs_blank);

/* A number of hundredths between two texts. */
void burnish_put_number(burnish_text_writer *w, const char *before, int32_t hundredths,
                        const char *after);

/* To the nearest hundredth, within 1e7. */
int32_t burnish_to_hundredths(float value);

#endif
