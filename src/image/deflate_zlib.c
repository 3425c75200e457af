/* Deflate by zlib, for systems and processors that ISA-L does not serve. */
#include <string.h>
#include <zlib.h>

#include "image/deflate.h"

enum { LEVEL = 1, WINDOW_BITS = 15, MEMORY_LEVEL = 8, FLUSH_SIZE = 64 };

struct burnish_deflate {
    z_stream stream;
    burnish_memory memory; /* of zlib's own allocations */
};

static void *take(void *memory, uInt count, uInt size) {
    return burnish_allocate(memory, count, size, "the PNG's compressor");
}

static void give_back(void *memory, void *items) {
    burnish_release(((burnish_memory *)memory)->context, items);
}

burnish_deflate *burnish_deflate_create(burnish_memory *memory) {
    burnish_deflate *made =
        burnish_allocate_zeroed(memory, 1, sizeof *made, "the PNG's compressor");
    if (!made) {
        return NULL;
    }
    made->memory = *memory;
    made->stream.zalloc = take;
    made->stream.zfree = give_back;
    made->stream.opaque = &made->memory;
    /* negative: without zlib's own head and end */
    if (deflateInit2(&made->stream, LEVEL, Z_DEFLATED, -WINDOW_BITS, MEMORY_LEVEL,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
        memory->status = made->memory.status != BURNISH_STATUS_OK
                             ? made->memory.status
                             : burnish_fail_memory(memory->error, "zlib", sizeof *made);
        burnish_release(memory->context, made);
        return NULL;
    }
    return made;
}

void burnish_deflate_destroy(const burnish_context *context, burnish_deflate *deflate) {
    if (deflate) {
        deflateEnd(&deflate->stream);
        burnish_release(context, deflate);
    }
}

size_t burnish_deflate_bound(size_t bytes) {
    return compressBound((uLong)bytes) + bytes / 1024 + FLUSH_SIZE;
}

size_t burnish_deflate_band(burnish_deflate *maker, const uint8_t *bytes, size_t size, int last,
                            uint8_t *packed, size_t room) {
    z_stream *stream = &maker->stream;
    deflateReset(stream);
    stream->next_in = (uint8_t *)bytes; /* only read */
    stream->avail_in = (uInt)size;
    stream->next_out = packed;
    stream->avail_out = (uInt)room;
    /* a full flush: a band starts without a history */
    const int done =
        last ? deflate(stream, Z_FINISH) == Z_STREAM_END : deflate(stream, Z_FULL_FLUSH) == Z_OK;
    return done && stream->avail_in == 0 && stream->avail_out > 0 ? room - stream->avail_out : 0;
}

uint32_t burnish_deflate_crc32(const uint8_t *bytes, size_t size) {
    return (uint32_t)crc32_z(0, bytes, size);
}

uint32_t burnish_deflate_adler32(const uint8_t *bytes, size_t size) {
    return (uint32_t)adler32_z(1, bytes, size);
}
