/* Builds without ISA-L and zlib can not decompress, and report that. */
#include "base/error.h"
#include "image/decode/gunzip.h"

burnish_inflate *burnish_inflate_create(burnish_memory *memory, int is_raw) {
    (void)is_raw;
    memory->status = burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                                  "compressed files are not read by this build of the library; "
                                  "unpack the file first, or build with zlib");
    return NULL;
}

void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate) {
    (void)context;
    (void)inflate;
}

burnish_inflate_result burnish_inflate_step(burnish_inflate *inflate, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written) {
    (void)inflate;
    (void)from;
    (void)left;
    (void)to;
    (void)room;
    *written = 0;
    return BURNISH_INFLATE_DAMAGED;
}

uint32_t burnish_inflate_crc32(uint32_t crc, const uint8_t *bytes, size_t size) {
    (void)bytes;
    (void)size;
    return crc;
}
