/* Deflate by zlib, for systems and processors that ISA-L does not support. */
#include "image/deflate.h"
#include "image/zlib_stream.h"

enum { LEVEL = 1, WINDOW_BITS = 15, MEMORY_LEVEL = 8, FLUSH_SIZE = 64 };

struct burnish_deflate {
    burnish_zlib zlib;
};

burnish_deflate *burnish_deflate_create(burnish_memory *memory) {
    burnish_zlib *made = burnish_zlib_create(memory, "the PNG's compressor");
    if (made) { /* negative: without zlib's header and trailer */
        const int code = deflateInit2(&made->stream, LEVEL, Z_DEFLATED, -WINDOW_BITS, MEMORY_LEVEL,
                                      Z_DEFAULT_STRATEGY);
        made = burnish_zlib_begun(made, code, memory);
    }
    return (burnish_deflate *)made;
}

void burnish_deflate_destroy(const burnish_context *context, burnish_deflate *deflate) {
    if (deflate) {
        deflateEnd(&deflate->zlib.stream);
        burnish_release(context, deflate);
    }
}

size_t burnish_deflate_bound(size_t bytes) {
    return compressBound((uLong)bytes) + bytes / 1024 + FLUSH_SIZE;
}

size_t burnish_deflate_band(burnish_deflate *maker, const uint8_t *bytes, size_t size, int last,
                            uint8_t *packed, size_t room) {
    z_stream *stream = &maker->zlib.stream;
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
