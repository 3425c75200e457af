/* Reads untrusted PNG files. */
#ifndef TOOL_PICTURE_READ_PNG_H
#define TOOL_PICTURE_READ_PNG_H

#include <stddef.h>

#include "burnish/image.h"

/* 1 if the bytes begin with the PNG signature. */
int picture_is_png(const uint8_t *bytes, size_t size);

/* Decodes any PNG: palettes, grey, transparent colours, 1 to 16 bits, interlaced. 16 bits are
 * rounded to 8; values are read as sRGB, and gamma and profiles are ignored. The result is RGBA if
 * the file has transparency, else RGB. Memory is proportional to the file's size: larger pictures
 * than the data can encode are rejected.
 *   name   for messages
 *   image  receives the picture; empty on error
 * Errors: FORMAT, LIMIT (sides over BURNISH_IMAGE_MAX_SIZE), MEMORY; ARGUMENT if burnish was built
 * without libpng. */
burnish_status picture_decode_png(const char *name, const uint8_t *bytes, size_t size,
                                  burnish_image *image, burnish_error *error);

/* Reads and decodes a file. Errors: as above, and READ; FORMAT if it is not a PNG file. */
burnish_status picture_read_png(const char *path, uint64_t max_bytes, burnish_image *image,
                                burnish_error *error);

#endif
