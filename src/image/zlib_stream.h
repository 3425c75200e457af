/* A stream of zlib whose memory comes from a context. */
#ifndef BURNISH_IMAGE_ZLIB_STREAM_H
#define BURNISH_IMAGE_ZLIB_STREAM_H

#include <zlib.h>

#include "base/memory.h"

typedef struct burnish_zlib {
    z_stream stream;
    burnish_memory memory; /* of zlib's own allocations */
    const char *what;      /* they are for, in messages */
} burnish_zlib;

static inline void *burnish_zlib_take(void *zlib, uInt count, uInt size) {
    burnish_zlib *z = zlib;
    return burnish_allocate(&z->memory, count, size, z->what);
}

static inline void burnish_zlib_give_back(void *zlib, void *items) {
    burnish_release(((burnish_zlib *)zlib)->memory.context, items);
}

/* Call before zlib's init function; NULL without memory. */
static inline burnish_zlib *burnish_zlib_create(burnish_memory *memory, const char *what) {
    burnish_zlib *made = burnish_allocate_zeroed(memory, 1, sizeof *made, what);
    if (made) {
        made->memory = *memory;
        made->what = what;
        made->stream.zalloc = burnish_zlib_take;
        made->stream.zfree = burnish_zlib_give_back;
        made->stream.opaque = made;
    }
    return made;
}

/* Call after zlib's init function: the stream, or NULL with memory->status set if it failed. */
static inline burnish_zlib *burnish_zlib_begun(burnish_zlib *made, int code,
                                               burnish_memory *memory) {
    if (code == Z_OK) {
        return made;
    }
    memory->status = made->memory.status != BURNISH_STATUS_OK
                         ? made->memory.status
                         : burnish_fail_memory(memory->error, "zlib", sizeof *made);
    burnish_release(memory->context, made);
    return NULL;
}

#endif
