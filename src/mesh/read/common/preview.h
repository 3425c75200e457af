/* Previews of binary STL: facets of which one in so many is read, to stay within a memory limit. */
#ifndef BURNISH_MESH_READ_COMMON_PREVIEW_H
#define BURNISH_MESH_READ_COMMON_PREVIEW_H

#include "mesh/read/io/reader.h"

/* Reads facets of a binary STL file, 50 bytes each from `offset` on, as points: one in `step`, at
 * the middle and with the normal of its triangle. Errors: FORMAT, LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_preview_facets(burnish_reader *reader, size_t offset, size_t count,
                                      size_t step);

#endif
