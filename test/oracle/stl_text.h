/* ASCII STL. */
#ifndef ORACLE_MESH_READ_STL_TEXT_H
#define ORACLE_MESH_READ_STL_TEXT_H

#include "oracle/reader.h"

/* Large files are read with the threads of source->pool. Errors: FORMAT, LIMIT, MEMORY. */
burnish_status oracle_read_stl_text(const oracle_reader_input *input, oracle_source *source,
                                    burnish_error *error);

#endif
