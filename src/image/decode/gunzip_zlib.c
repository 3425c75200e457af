/* Inflate by zlib. */
#include "image/decode/gunzip.h"
#include "image/zlib_stream.h"

enum { GZIP_WINDOW_BITS = 15 + 16, RAW_WINDOW_BITS = -15 };

struct burnish_inflate {
    burnish_zlib zlib;
};

burnish_inflate *burnish_inflate_create(burnish_memory *memory, int is_raw) {
    burnish_zlib *made = burnish_zlib_create(memory, "unpacking");
    if (made) {
        const int bits = is_raw ? RAW_WINDOW_BITS : GZIP_WINDOW_BITS;
        made = burnish_zlib_begun(made, inflateInit2(&made->stream, bits), memory);
    }
    return (burnish_inflate *)made;
}

void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate) {
    inflateEnd(&inflate->zlib.stream);
    burnish_release(context, inflate);
}

burnish_inflate_result burnish_inflate_step(burnish_inflate *unpacker, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written) {
    z_stream *stream = &unpacker->zlib.stream;
    const uInt taken = *left < UINT32_MAX ? (uInt)*left : UINT32_MAX;
    const uInt given = room < UINT32_MAX ? (uInt)room : UINT32_MAX;
    stream->next_in = (uint8_t *)(uintptr_t)*from; /* only read */
    stream->avail_in = taken;
    stream->next_out = to;
    stream->avail_out = given;
    const int code = inflate(stream, Z_NO_FLUSH);
    *from += taken - stream->avail_in;
    *left -= taken - stream->avail_in;
    *written = given - stream->avail_out;
    if (code == Z_STREAM_END) {
        inflateReset(stream);
        return BURNISH_INFLATE_END;
    }
    if (code == Z_MEM_ERROR) { /* its window is allocated when it is needed */
        return BURNISH_INFLATE_MEMORY;
    }
    return code == Z_OK || code == Z_BUF_ERROR ? BURNISH_INFLATE_MORE : BURNISH_INFLATE_DAMAGED;
}

uint32_t burnish_inflate_crc32(uint32_t crc, const uint8_t *bytes, size_t size) {
    return (uint32_t)crc32_z(crc, bytes, size);
}
