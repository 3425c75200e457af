/* What binary STL consists of. */
#ifndef BURNISH_MESH_READ_STL_H
#define BURNISH_MESH_READ_STL_H

#include <stddef.h>
#include <stdint.h>

enum {
    BURNISH_STL_TITLE_SIZE = 80,
    BURNISH_STL_HEADER_SIZE = 84, /* the title and the count of facets */
    BURNISH_STL_FACET_SIZE = 50
};

static inline uint32_t burnish_stl_u32(const uint8_t *p) {
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* Whether the size of a file is the one that its header tells. */
static inline int burnish_is_binary_stl(const uint8_t *head, size_t size) {
    const size_t rest = size - BURNISH_STL_HEADER_SIZE;
    return size >= BURNISH_STL_HEADER_SIZE && rest % BURNISH_STL_FACET_SIZE == 0 &&
           rest / BURNISH_STL_FACET_SIZE == burnish_stl_u32(head + BURNISH_STL_TITLE_SIZE);
}

#endif
