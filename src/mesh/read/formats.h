/* The table of formats: recognising and reading an input. */
#ifndef BURNISH_MESH_READ_FORMATS_H
#define BURNISH_MESH_READ_FORMATS_H

#include "mesh/read/io/reader.h"

/* Reads an input of a format. If *format is AUTO, it is set to the format recognised from the bytes
 * and the name. Errors: FORMAT, LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_read(burnish_reader *reader, burnish_format *format);

/* The format recognised from bytes and name; AUTO if unknown. */
burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name);

/* Whether a longer stream that begins with these bytes may be of a format, or of any format if that
 * is AUTO. This keeps an endless stream of other data from filling the memory. Returns 1 in case of
 * doubt, and for BURNISH_FORMAT_COUNT. */
int burnish_may_be(burnish_format format, const uint8_t *bytes, size_t size, const char *name);

/* The format of a file of `size` bytes that may be read in pieces; AUTO: it must be read whole.
 *
 * format: the caller's, or AUTO
 * head:   its first BURNISH_PIECES_HEAD bytes, fewer than size
 * name:   of the file, or NULL */
burnish_format burnish_pieces_format(burnish_format format, const uint8_t *head, size_t size,
                                     const char *name);

#endif
