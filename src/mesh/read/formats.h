/* The table of formats: recognising and reading an input. */
#ifndef BURNISH_MESH_READ_FORMATS_H
#define BURNISH_MESH_READ_FORMATS_H

#include "mesh/read/io/reader.h"

/* Reads an input of a format, or of the one that its bytes and name tell where that is AUTO:
 * *format says which it was. Errors: FORMAT, LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_read(burnish_reader *reader, burnish_format *format);

/* The format that bytes and name tell of; AUTO when neither does. */
burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name);

/* Whether a stream that begins with some bytes, and is longer, may be of a format, or of any where
 * that is AUTO; keeps an endless stream of something else from filling the memory. Says yes where
 * it can't know.
 *   format  BURNISH_FORMAT_COUNT: any bytes will do */
int burnish_may_be(burnish_format format, const uint8_t *bytes, size_t size, const char *name);

/* The format of a file of `size` bytes that may be read in pieces; AUTO: it is to be read whole.
 *
 * format: what the caller says that it is, or AUTO
 * head:   its first BURNISH_PIECES_HEAD bytes, fewer than size
 * name:   of the file, or NULL */
burnish_format burnish_pieces_format(burnish_format format, const uint8_t *head, size_t size,
                                     const char *name);

#endif
