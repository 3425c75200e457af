/* Rows of a binary PLY body that all have one size: converted by threads. */
#ifndef BURNISH_MESH_READ_PLY_ROWS_H
#define BURNISH_MESH_READ_PLY_ROWS_H

#include "mesh/read/ply.h"

/* The rows of one element as they stand in the file. */
typedef struct burnish_ply_rows {
    const uint8_t *bytes; /* the first row; `size` bytes up to the end of the file */
    size_t size;
    size_t count;
    int big_endian;
    const burnish_ply_property *properties; /* of a row */
    size_t property_count;
} burnish_ply_rows;

/* Appends the vertices to a source that has none.
 *
 * used: bytes of all rows, or 0: nothing was appended, since something is unusual or wrong, which
 *       reading value by value will tell
 * Errors: MEMORY, LIMIT. */
burnish_status burnish_ply_vertex_rows(const burnish_ply_rows *rows, burnish_source *source,
                                       size_t *used, burnish_error *error);

/* The same for faces that are all triangles. vertex_count: corners are below it. */
burnish_status burnish_ply_triangle_rows(const burnish_ply_rows *rows, size_t vertex_count,
                                         const burnish_load_options *options,
                                         burnish_source *source, size_t *used,
                                         burnish_error *error);

#endif
