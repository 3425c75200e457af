/* Unwrapping an input: gzip and UTF-16. */
#ifndef BURNISH_MESH_READ_IO_UNPACK_H
#define BURNISH_MESH_READ_IO_UNPACK_H

#include "mesh/read/io/reader.h"

/* The byte order mark of UTF-16. */
static inline int burnish_has_utf16_mark(const uint8_t *bytes, size_t size) {
    return size >= 2 &&
           ((bytes[0] == 0xFF && bytes[1] == 0xFE) || (bytes[0] == 0xFE && bytes[1] == 0xFF));
}

/* Unpacks gzip, and makes UTF-8 of text in UTF-16 with a byte order mark: input->bytes and
 * input->size then describe *unpacked, which the caller releases. *unpacked is NULL if nothing had
 * to be unwrapped. Errors: FORMAT, LIMIT (more than max_input_bytes), MEMORY. */
burnish_status burnish_unpack_input(burnish_reader_input *input, burnish_memory *memory,
                                    uint8_t **unpacked);

#endif
