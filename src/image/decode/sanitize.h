/* For the memory sanitizer, which sees no writes of libraries that are not built with it. */
#ifndef BURNISH_IMAGE_DECODE_SANITIZE_H
#define BURNISH_IMAGE_DECODE_SANITIZE_H

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

/* Around calls of such a library, whose own arrays look unwritten to functions of libc. */
static inline void burnish_outside_begin(void) {
#if defined(BURNISH_MSAN)
    __msan_scoped_disable_interceptor_checks();
#endif
}
static inline void burnish_outside_end(void) {
#if defined(BURNISH_MSAN)
    __msan_scoped_enable_interceptor_checks();
#endif
}

#endif
