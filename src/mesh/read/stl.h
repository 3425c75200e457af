/* STL: the layout of binary files, and their reader. */
#ifndef BURNISH_MESH_READ_STL_H
#define BURNISH_MESH_READ_STL_H

#include "base/bytes.h"
#include "mesh/read/io/reader.h"

enum {
    BURNISH_STL_TITLE_SIZE = 80,
    BURNISH_STL_HEADER_SIZE = 84, /* the title and the count of facets */
    BURNISH_STL_FACET_SIZE = 50,
    BURNISH_STL_NORMAL_SIZE = 12 /* before a facet's corners */
};

/* Whether the size of a file matches the count in its header. */
static inline int burnish_is_binary_stl(const uint8_t *head, size_t size) {
    const size_t rest = size - BURNISH_STL_HEADER_SIZE;
    return size >= BURNISH_STL_HEADER_SIZE && rest % BURNISH_STL_FACET_SIZE == 0 &&
           rest / BURNISH_STL_FACET_SIZE == burnish_load32(head + BURNISH_STL_TITLE_SIZE);
}

/* Coordinates that no unit of length produces, but that the bytes of other files do: below 2^-100
 * but not 0, or 2^101 and above. */
static inline int burnish_is_odd_coordinate(uint32_t bits) {
    enum { LEAST = 27, MOST = 227, EXPONENT_AT = 23 };
    const uint32_t exponent = bits >> EXPONENT_AT & 0xFF;
    return (bits & 0x7FFFFFFFu) != 0 && (exponent < LEAST || exponent > MOST);
}

/* Reads a binary file of at least a header. Errors: as burnish_read. */
burnish_status burnish_stl_read_binary(burnish_reader *reader);

#endif
