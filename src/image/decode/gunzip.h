/* Gzip files (RFC 1952) and plain deflate (RFC 1951) unpacked, by ISA-L or, where that is not built
 * in, zlib. */
#ifndef BURNISH_IMAGE_DECODE_GUNZIP_H
#define BURNISH_IMAGE_DECODE_GUNZIP_H

#include <stddef.h>
#include <stdint.h>

#include "core/memory.h"

/* Unpacks a file, of which there may be several one after the other.
 *   name       for messages
 *   max_bytes  more are refused with LIMIT
 *   budget     so are these, with a line that says to unpack the file first
 *   unpacked   receives *unpacked_size bytes, from `memory`; NULL on error
 * Errors: FORMAT (damaged, truncated), LIMIT, MEMORY. */
burnish_status burnish_gunzip(const uint8_t *bytes, size_t size, const char *name,
                              uint64_t max_bytes, uint64_t budget, burnish_memory *memory,
                              uint8_t **unpacked, size_t *unpacked_size);

static inline int burnish_is_gzip(const uint8_t *bytes, size_t size) {
    return size >= 3 && bytes[0] == 0x1f && bytes[1] == 0x8b && bytes[2] == 8;
}

/* ---- Step by step: one of the libraries ---- */

/* What a step did. */
typedef enum burnish_inflate_result {
    BURNISH_INFLATE_MORE, /* it wants input, or room */
    BURNISH_INFLATE_END,  /* of one file; of gzip, whose checksum is right */
    BURNISH_INFLATE_DAMAGED,
    BURNISH_INFLATE_MEMORY /* is out, which its error says */
} burnish_inflate_result;

typedef struct burnish_inflate burnish_inflate;

/* is_raw: 1: deflate without gzip's frame. NULL on failure, which memory knows. */
burnish_inflate *burnish_inflate_create(burnish_memory *memory, int is_raw);
void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate);

/* Unpacks from *from, of which *left bytes are left, into room: both are moved on. Returns how many
 * bytes were written through *written. After END the next file may follow. */
burnish_inflate_result burnish_inflate_step(burnish_inflate *inflate, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written);

/* gzip's and ZIP's checksum of what `crc` is of, 0 for nothing, and further bytes. */
uint32_t burnish_inflate_crc32(uint32_t crc, const uint8_t *bytes, size_t size);

#endif
