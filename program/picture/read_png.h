/* Reading PNG files, which may be hostile. */
#ifndef TOOL_PICTURE_READ_PNG_H
#define TOOL_PICTURE_READ_PNG_H

#include <stddef.h>

#include "burnish/image.h"

/* 1 where the bytes begin as a PNG does. */
int picture_is_png(const uint8_t *bytes, size_t size);

/* Decodes any PNG: palettes, grey, transparent colours, 1 to 16 bits, interlaced. Sixteen bits
 * become the nearest eight; codes are taken as sRGB, whatever gamma or profile the file states.
 * RGBA where the file has any transparency, else RGB. Memory stays in proportion to the bytes: a
 * picture larger than they can hold is refused.
 *   name   stands in messages
 *   image  receives the picture; empty on error
 * Errors: FORMAT, LIMIT (sides over BURNISH_IMAGE_MAX_SIZE), MEMORY; ARGUMENT where burnish was
 * built without libpng. */
burnish_status picture_decode_png(const char *name, const uint8_t *bytes, size_t size,
                                  burnish_image *image, burnish_error *error);

/* The whole file, or standard input for "-": *bytes, to be freed. Errors: READ, LIMIT, MEMORY. */
burnish_status picture_read_bytes(const char *path, uint64_t max_bytes, uint8_t **bytes,
                                  size_t *size, burnish_error *error);

/* Both. A file that is no PNG is FORMAT. */
burnish_status picture_read_png(const char *path, uint64_t max_bytes, burnish_image *image,
                                burnish_error *error);

#endif
