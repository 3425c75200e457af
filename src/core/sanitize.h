/* For the memory sanitizer, which sees no writes of libraries that are not built with it. */
#ifndef BURNISH_CORE_SANITIZE_H
#define BURNISH_CORE_SANITIZE_H

#include <stddef.h>

#if defined(BURNISH_MSAN)
#include <sanitizer/msan_interface.h>
#endif

/* A library that is not ours has written these bytes. */
static inline void burnish_written_outside(const void *bytes, size_t size) {
#if defined(BURNISH_MSAN)
    __msan_unpoison(bytes, size);
#else
    (void)bytes;
    (void)size;
#endif
}

#endif
