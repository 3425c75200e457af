/* Decodes images from untrusted files: BMP and TGA, and PNG, JPEG and WebP if the build has their
 * libraries. */
#ifndef BURNISH_IMAGE_DECODE_DECODE_H
#define BURNISH_IMAGE_DECODE_DECODE_H

#include "base/memory.h"
#include "burnish/image.h"
#include "core/tasks.h"

/* An encoded image in memory. */
typedef struct burnish_encoded {
    const uint8_t *bytes;
    size_t size;
    const char *name;     /* for messages */
    int channels;         /* 4: always RGBA; 0: RGBA if the file has any transparency, else RGB */
    int max_side;         /* wider or higher images are rejected with LIMIT */
    uint64_t max_pixels;  /* larger ones also */
    burnish_tasks *tasks; /* for what can be shared; NULL: the caller alone */
    uint64_t *decoded;    /* += the decoded pixels, damaged ones included; may be NULL */
} burnish_encoded;

/* Decodes to 8 bits per channel; 16 bits are rounded to the nearest value. Gamma and profiles of
 * the file are ignored. Sizes are checked before memory is allocated. If the compression of the
 * format has a bound, memory is proportional to the size of the file.
 *   picture  receives the picture, from `memory`; empty on error
 * Errors: FORMAT, LIMIT, MEMORY; ARGUMENT if this build lacks the format's library. */
burnish_status burnish_decode(const burnish_encoded *from, burnish_memory *memory,
                              burnish_image *picture);

/* ---- One function per format, for bytes with its signature ---- */

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

/* Whether bytes have a plausible TGA header; TGA has no signature. */
int burnish_is_tga(const uint8_t *bytes, size_t size);

/* Checks the size of an image. Call it before a library allocates rows.
 * Errors: FORMAT (a side is 0), LIMIT. */
burnish_status burnish_decode_check(const burnish_encoded *from, uint64_t width, uint64_t height,
                                    const burnish_memory *memory);

/* Allocates the pixels of an image, not cleared. The size comes from the file.
 * Errors: FORMAT, LIMIT, MEMORY. */
burnish_status burnish_decode_reserve(const burnish_encoded *from, uint64_t width, uint64_t height,
                                      int channels, burnish_memory *memory, burnish_image *picture);

/* 5 bits to 8: 31 becomes 255. */
static inline uint8_t burnish_widen_5_bits(unsigned bits) {
    bits &= 31;
    return (uint8_t)(bits << 3 | bits >> 2);
}

/* ---- Images of floats ---- */

/* Receives an image of linear colours.
 *   begin  its size, checked, and the bytes that a pixel takes when the file is unpacked, before
 *          its pixels; an error ends decoding
 *   add    each pixel once, in the order of the file */
typedef struct burnish_float_sink {
    burnish_status (*begin)(void *context, uint64_t width, uint64_t height, uint64_t pixel_bytes);
    void (*add)(void *context, int x, int y, const float rgb[3]);
    void *context;
} burnish_float_sink;

/* Decodes Radiance HDR or EXR; from->channels is not used. Values are arbitrary, NaN included.
 * Errors: FORMAT, LIMIT, MEMORY; ARGUMENT if this build lacks OpenEXR. */
burnish_status burnish_decode_floats(const burnish_encoded *from, burnish_memory *memory,
                                     const burnish_float_sink *sink);

burnish_status burnish_decode_hdr(const burnish_encoded *from, burnish_memory *memory,
                                  const burnish_float_sink *sink);
burnish_status burnish_decode_exr(const burnish_encoded *from, burnish_memory *memory,
                                  const burnish_float_sink *sink);

#endif
