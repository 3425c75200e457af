/* The layout of binary STL. */
#ifndef BURNISH_MESH_READ_IO_BINARY_STL_H
#define BURNISH_MESH_READ_IO_BINARY_STL_H

#include <stddef.h>
#include <stdint.h>

#include "base/bytes.h"

enum {
    BURNISH_STL_TITLE_SIZE = 80,
    BURNISH_STL_HEADER_SIZE = 84, /* the title and the count of facets */
    BURNISH_STL_FACET_SIZE = 50
};

/* Whether the size of a file matches the count in its header. */
static inline int burnish_is_binary_stl(const uint8_t *head, size_t size) {
    const size_t rest = size - BURNISH_STL_HEADER_SIZE;
    return size >= BURNISH_STL_HEADER_SIZE && rest % BURNISH_STL_FACET_SIZE == 0 &&
           rest / BURNISH_STL_FACET_SIZE == burnish_load32(head + BURNISH_STL_TITLE_SIZE);
}

#endif
