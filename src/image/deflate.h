/* Deflate (RFC 1951) in independent bands, with ISA-L or, if the build lacks it, zlib. */
#ifndef BURNISH_IMAGE_DEFLATE_H
#define BURNISH_IMAGE_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

/* A compressor; one thread at a time may use it. */
typedef struct burnish_deflate burnish_deflate;

/* NULL on failure, which is recorded in memory. */
burnish_deflate *burnish_deflate_create(burnish_memory *memory);

/* NULL is allowed. */
void burnish_deflate_destroy(const burnish_context *context, burnish_deflate *deflate);

/* Room for `bytes` compressed bytes. */
size_t burnish_deflate_bound(size_t bytes);

/* Compresses size > 0 bytes up to a byte boundary, the last band with deflate's end; room: at least
 * burnish_deflate_bound(size). Returns the number of bytes written, or 0 if the library exceeds its
 * bounds. */
size_t burnish_deflate_band(burnish_deflate *deflate, const uint8_t *bytes, size_t size, int last,
                            uint8_t *packed, size_t room);

/* Checksums of a whole piece: RFC 1952, RFC 1950. */
uint32_t burnish_deflate_crc32(const uint8_t *bytes, size_t size);
uint32_t burnish_deflate_adler32(const uint8_t *bytes, size_t size);

#endif
