/* The layout of description structs: whether a caller was compiled with this library's headers. */
#ifndef BURNISH_BASE_LAYOUT_H
#define BURNISH_BASE_LAYOUT_H

#include "base/error.h"

/* The value of `cookie`, the first member of every description struct of `type`. It depends on the
 * size of the struct and the version of the headers. */
#define BURNISH_COOKIE(tag, type)                                                                  \
    ((uint32_t)(tag) ^ (uint32_t)(BURNISH_LAYOUT(type) * 0x9E3779B97F4A7C15U >> 32))

/* What a ..._init() function does: copies the defaults if the caller has the same layout. Otherwise
 * it clears the caller's struct and leaves a cookie that burnish_layout_check() recognises.
 *   value     the caller's struct; never written beyond the size in `layout`
 *   layout    BURNISH_LAYOUT as the caller was compiled
 *   own       BURNISH_LAYOUT as the library was compiled
 *   defaults  a struct with its cookie */
void burnish_layout_init(void *value, uint64_t layout, uint64_t own, const void *defaults);

/* Errors: ARGUMENT if value is NULL, was not initialised, or has another layout.
 *   what  the name of the argument, which begins the message
 *   type  the name of the struct without its prefix burnish_ */
burnish_status burnish_layout_check(const void *value, uint32_t cookie, const char *what,
                                    const char *type, burnish_error *error);

#endif
