/* Inflate by zlib. */
#include <zlib.h>

#include "image/gunzip.h"

enum { GZIP_WINDOW_BITS = 15 + 16 };

struct burnish_inflate {
    z_stream stream;
    burnish_memory memory; /* of zlib's own allocations */
};

static void *take(void *memory, uInt count, uInt size) {
    return burnish_allocate(memory, count, size, "unpacking");
}

static void give_back(void *memory, void *items) {
    burnish_release(((burnish_memory *)memory)->context, items);
}

burnish_inflate *burnish_inflate_create(burnish_memory *memory) {
    burnish_inflate *made = burnish_allocate_zeroed(memory, 1, sizeof *made, "unpacking");
    if (!made) {
        return NULL;
    }
    made->memory = *memory;
    made->stream.zalloc = take;
    made->stream.zfree = give_back;
    made->stream.opaque = &made->memory;
    if (inflateInit2(&made->stream, GZIP_WINDOW_BITS) != Z_OK) {
        memory->status = made->memory.status != BURNISH_STATUS_OK
                             ? made->memory.status
                             : burnish_fail_memory(memory->error, "zlib", sizeof *made);
        burnish_release(memory->context, made);
        return NULL;
    }
    return made;
}

void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate) {
    inflateEnd(&inflate->stream);
    burnish_release(context, inflate);
}

burnish_inflate_result burnish_inflate_step(burnish_inflate *unpacker, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written) {
    z_stream *stream = &unpacker->stream;
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
    return code == Z_OK || code == Z_BUF_ERROR ? BURNISH_INFLATE_MORE : BURNISH_INFLATE_DAMAGED;
}
