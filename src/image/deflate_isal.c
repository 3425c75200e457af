/* Deflate by ISA-L: twice as fast as zlib's fastest level. x86-64 without SSE4.2 searches with
 * another hash: 3 % longer. */
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#include <string.h>

#include "image/deflate.h"

enum {
    LEVEL = 1, /* level 2 takes 3 % longer and saves nothing, level 0 adds a fifth */
    SEARCH_SIZE = ISAL_DEF_LVL1_DEFAULT,
    BLOCK_FRAME = 1024, /* room for the overhead of incompressible bytes */
    PLAIN = 16,         /* bytes at the start of a band that are stored, not compressed */
    PLAIN_FRAME = 5
};

struct burnish_deflate {
    struct isal_zstream stream;
    _Alignas(BURNISH_ALIGNMENT) uint8_t search[SEARCH_SIZE];
};

burnish_deflate *burnish_deflate_create(burnish_memory *memory) {
    return burnish_allocate(memory, 1, sizeof(burnish_deflate), "the PNG's compressor");
}

void burnish_deflate_destroy(const burnish_context *context, burnish_deflate *deflate) {
    burnish_release(context, deflate);
}

size_t burnish_deflate_bound(size_t bytes) {
    return bytes + bytes / 8 + BLOCK_FRAME;
}

/* A stored block (RFC 1951, 3.2.4) that begins and ends with a byte. */
static uint8_t *put_stored(uint8_t *to, const uint8_t *bytes, size_t size, int last) {
    const uint8_t frame[PLAIN_FRAME] = {(uint8_t)(last != 0), (uint8_t)size, 0, (uint8_t)~size,
                                        UINT8_MAX};
    memcpy(to, frame, PLAIN_FRAME);
    memcpy(to + PLAIN_FRAME, bytes, size);
    return to + PLAIN_FRAME + size;
}

/* If nothing precedes a band, ISA-L 2.30 uses the hash of the stream's address instead of the hash
 * of the second byte (write_first_byte of igzip_icf_body_h1_gr_bt.asm). One process in a thousand
 * would then write other bytes. A dictionary avoids this: the first bytes of a band are stored, and
 * are the dictionary for the rest. */
size_t burnish_deflate_band(burnish_deflate *deflate, const uint8_t *bytes, size_t size, int last,
                            uint8_t *packed, size_t room) {
    struct isal_zstream *stream = &deflate->stream;
    const size_t plain = size < PLAIN ? size : PLAIN;
    if (room < PLAIN_FRAME + plain) {
        return 0;
    }
    uint8_t *begin = put_stored(packed, bytes, plain, last && plain == size);
    if (plain == size) {
        return (size_t)(begin - packed);
    }
    isal_deflate_init(stream);
    stream->level = LEVEL;
    stream->level_buf = deflate->search;
    stream->level_buf_size = SEARCH_SIZE;
    stream->flush = FULL_FLUSH; /* a band starts without a history */
    stream->end_of_stream = (uint16_t)last;
    if (isal_deflate_set_dict(stream, (uint8_t *)bytes, (uint32_t)plain) != COMP_OK) {
        return 0;
    }
    stream->next_in = (uint8_t *)bytes + plain; /* only read */
    stream->avail_in = (uint32_t)(size - plain);
    stream->next_out = begin;
    stream->avail_out = (uint32_t)(room - (size_t)(begin - packed));
    const int code = isal_deflate(stream);
    return code == COMP_OK && stream->avail_in == 0 && stream->avail_out > 0
               ? (size_t)(begin - packed) + stream->total_out
               : 0;
}

uint32_t burnish_deflate_crc32(const uint8_t *bytes, size_t size) {
    return crc32_gzip_refl(0, bytes, size);
}

uint32_t burnish_deflate_adler32(const uint8_t *bytes, size_t size) {
    return isal_adler32(1, bytes, size);
}
