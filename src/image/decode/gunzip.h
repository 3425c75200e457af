/* Decompresses gzip files (RFC 1952) and raw deflate (RFC 1951) with ISA-L or, if the build lacks
 * it, zlib. */
#ifndef BURNISH_IMAGE_DECODE_GUNZIP_H
#define BURNISH_IMAGE_DECODE_GUNZIP_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

typedef struct burnish_gzip_file {
    const uint8_t *bytes;
    size_t size;
    const char *name;   /* for messages */
    uint64_t max_bytes; /* a larger result is rejected with LIMIT */
    uint64_t budget;    /* the same, with a message that suggests to decompress the file first */
} burnish_gzip_file;

/* Decompresses a file; it can have several gzip members.
 *   unpacked   receives *unpacked_size bytes, from `memory`; NULL on error
 * Errors: FORMAT (damaged, truncated), LIMIT, MEMORY. */
burnish_status burnish_gunzip(const burnish_gzip_file *file, burnish_memory *memory,
                              uint8_t **unpacked, size_t *unpacked_size);

static inline int burnish_is_gzip(const uint8_t *bytes, size_t size) {
    return size >= 3 && bytes[0] == 0x1f && bytes[1] == 0x8b && bytes[2] == 8;
}

/* ---- Step by step: one of the libraries ---- */

/* What a step did. */
typedef enum burnish_inflate_result {
    BURNISH_INFLATE_MORE, /* it needs input or room */
    BURNISH_INFLATE_END,  /* of one member; for gzip, its checksum is right */
    BURNISH_INFLATE_DAMAGED,
    BURNISH_INFLATE_MEMORY /* out of memory; the error is set */
} burnish_inflate_result;

typedef struct burnish_inflate burnish_inflate;

/* is_raw: 1: deflate without gzip's frame. NULL on failure, which is recorded in memory. */
burnish_inflate *burnish_inflate_create(burnish_memory *memory, int is_raw);
void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate);

/* Decompresses from *from, which has *left bytes left, and advances both. *written receives the
 * number of bytes written. After END, another member can follow. */
burnish_inflate_result burnish_inflate_step(burnish_inflate *inflate, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written);

/* Extends the CRC-32 of gzip and ZIP by further bytes; start with crc 0. */
uint32_t burnish_inflate_crc32(uint32_t crc, const uint8_t *bytes, size_t size);

#endif
