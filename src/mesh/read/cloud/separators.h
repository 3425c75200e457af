/* Rows of text whose values are separated by commas or semicolons: xyz.c */
#ifndef BURNISH_MESH_READ_CLOUD_SEPARATORS_H
#define BURNISH_MESH_READ_CLOUD_SEPARATORS_H

#include "mesh/read/io/reader.h"

/* Finds what separates the values of rows from byte `at` on; unless it is a blank, gives the reader an
 * input with blanks in its place. The caller releases blank->bytes. Errors: MEMORY. */
burnish_status burnish_blank_separators(burnish_reader *reader, size_t at,
                                        burnish_reader_input *blank);

#endif
