/* ASCII STL. */
#ifndef BURNISH_MESH_READ_STL_TEXT_H
#define BURNISH_MESH_READ_STL_TEXT_H

#include "mesh/read/reader.h"

/* Large files are read with the threads of source->pool. Errors: FORMAT, LIMIT, MEMORY. */
burnish_status burnish_read_stl_text(const burnish_reader_input *input, burnish_source *source,
                                     burnish_error *error);

#endif
