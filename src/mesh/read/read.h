/* The table of formats: recognising and reading an input. */
#ifndef BURNISH_MESH_READ_READ_H
#define BURNISH_MESH_READ_READ_H

#include <stddef.h>
#include <stdint.h>

#include "mesh/read/io/reader.h"

/* Reads an input of a format. If *format is AUTO, it is set to the format recognised from the bytes
 * and the name. Errors: FORMAT, LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_read(burnish_reader *reader, burnish_format *format);

/* The format recognised from bytes and name; AUTO if unknown. */
burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name);

/* The format of the name's extension, also with ".gz"; AUTO: none, or no name. */
burnish_format burnish_format_of_name(const char *name);

/* Whether a longer stream that begins with these bytes may be of a format, or of any format if that
 * is AUTO. This keeps an endless stream of other data from filling the memory. Returns 1 in case of
 * doubt, and for BURNISH_FORMAT_COUNT. */
int burnish_may_be(burnish_format format, const uint8_t *bytes, size_t size, const char *name);

/* The format of a file of `size` bytes that may be streamed; AUTO: it must be read whole.
 *
 * format: the caller's, or AUTO
 * head:   its first BURNISH_STREAMED_HEAD bytes, fewer than size
 * name:   of the file, or NULL */
burnish_format burnish_streamed_format(burnish_format format, const uint8_t *head, size_t size,
                                       const char *name);

/* ---- foreign.c ---- */

/* Returns "a STEP file" or the like, from the first bytes or, for some, the file extension; NULL if
 * unknown. */
const char *burnish_describe_foreign(const uint8_t *bytes, size_t size, const char *name);

/* Whether bytes are a Git LFS pointer, the placeholder of a file that was not fetched. */
int burnish_is_lfs_pointer(const uint8_t *bytes, size_t size);

/* ---- unpack.c ---- */

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
