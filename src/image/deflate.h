/* Deflate (RFC 1951) in bands that know nothing of each other, by ISA-L or, where that is not
 * built in, zlib. */
#ifndef BURNISH_IMAGE_DEFLATE_H
#define BURNISH_IMAGE_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

#include "core/memory.h"

/* A compressor; one thread at a time may use it. */
typedef struct burnish_deflate burnish_deflate;

/* NULL on failure, which memory knows. */
burnish_deflate *burnish_deflate_create(burnish_memory *memory);

/* NULL is allowed. */
void burnish_deflate_destroy(const burnish_context *context, burnish_deflate *deflate);

/* Room for `bytes` compressed bytes. */
size_t burnish_deflate_bound(size_t bytes);

/* Compresses size > 0 bytes up to a byte boundary, the last band with deflate's end; room: at least
 * burnish_deflate_bound(size). Returns how many bytes that takes, 0 when the library did not keep
 * to its bounds. */
size_t burnish_deflate_band(burnish_deflate *deflate, const uint8_t *bytes, size_t size, int last,
                            uint8_t *packed, size_t room);

/* Checksums of a whole piece: RFC 1952, RFC 1950. */
uint32_t burnish_deflate_crc32(const uint8_t *bytes, size_t size);
uint32_t burnish_deflate_adler32(const uint8_t *bytes, size_t size);

#endif
