/* Lines and points of files that have faces too. */
#ifndef BURNISH_MESH_READ_COMMON_BESIDE_FACES_H
#define BURNISH_MESH_READ_COMMON_BESIDE_FACES_H

#include "mesh/read/common/points.h"

/* Whether so many lines and points may be added to the mesh data; if not, a warning says so. */
int burnish_fits_beside(burnish_reader *reader, uint64_t count);

/* Adds lines, and points as lines from a position to itself, to mesh data with triangles whose
 * attributes are numbered as positions are. They are solids of 8 triangles, or 4 if they are many, in one white material
 * without light, with the colours of their ends. The facts and the bounds of the mesh leave the
 * solids out; the bounds contain the ends.
 *
 * The diameter of lines is the option point_size, or 1/400 of the diagonal of the bounding box; that
 * of points is three times as large.
 *
 *   ends      the positions and, unless absent, colours that segments refer to
 *   segments  `count` of them, for which burnish_fits_beside returned 1
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_add_beside(burnish_reader *reader, const burnish_mesh_data *ends,
                                  const burnish_segment *segments, size_t count);

#endif
