/* Pictures from files, which may be hostile: PNG, JPEG, WebP, each where its library is there, BMP
 * and TGA. */
#ifndef BURNISH_IMAGE_DECODE_DECODE_H
#define BURNISH_IMAGE_DECODE_DECODE_H

#include "burnish/image.h"
#include "core/memory.h"

/* A picture in a file's bytes. */
typedef struct burnish_encoded {
    const uint8_t *bytes;
    size_t size;
    const char *name;    /* for messages */
    int channels;        /* 4: always RGBA; 0: RGBA where the file has any transparency, else RGB */
    int max_side;        /* wider or higher ones are refused with LIMIT */
    uint64_t max_pixels; /* so are those with more */
    uint64_t *decoded; /* pixels are added to it once they are decoded, in part or damaged too; may
                          be NULL */
} burnish_encoded;

/* Codes of 8 bits, taken as they are whatever gamma or profile the file states; 16 bits become the
 * nearest 8. Memory is asked for once sizes are checked, and stays in proportion to the bytes where
 * the format's compression has a bound.
 *   picture  receives the picture, from `memory`; empty on error
 * Errors: FORMAT, LIMIT, MEMORY; ARGUMENT where this build lacks the format's library. */
burnish_status burnish_decode(const burnish_encoded *from, burnish_memory *memory,
                              burnish_image *picture);

/* ---- One function per format: bytes that begin as it does ---- */

burnish_status burnish_decode_png(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture);
burnish_status burnish_decode_jpeg(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture);
burnish_status burnish_decode_webp(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture);

burnish_status burnish_decode_bmp(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture);
burnish_status burnish_decode_tga(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture);

/* Whether bytes have the header of a TGA, which begins with nothing of its own. */
int burnish_is_tga(const uint8_t *bytes, size_t size);

/* Whether a picture of these sides is read: to be asked before a library allocates rows of them.
 * Errors: FORMAT (a side is 0), LIMIT. */
burnish_status burnish_decode_check(const burnish_encoded *from, uint64_t width, uint64_t height,
                                    const burnish_memory *memory);

/* Pixels for a picture that a file announces, not cleared. Errors: FORMAT, LIMIT, MEMORY. */
burnish_status burnish_decode_reserve(const burnish_encoded *from, uint64_t width, uint64_t height,
                                      int channels, burnish_memory *memory, burnish_image *picture);

#endif
