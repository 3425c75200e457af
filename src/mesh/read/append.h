/* How readers fill a burnish_source: one value at a time, limits checked. */
#ifndef BURNISH_MESH_READ_APPEND_H
#define BURNISH_MESH_READ_APPEND_H

#include "mesh/read/reader.h"
#include "mesh/read/text.h"

/* Corner indices stop below BURNISH_SOURCE_NONE. */
#define BURNISH_POSITION_LIMIT ((size_t)UINT32_MAX - 1)

/* Appends one position, which the caller has found finite. With colours in use it becomes white.
 * Errors: LIMIT, MEMORY. */
burnish_status burnish_append_position(burnish_source *source, burnish_place place,
                                       const float position[3], burnish_error *error);

/* Gives the last position a colour; positions without one become white. Errors: MEMORY. */
burnish_status burnish_append_color(burnish_source *source, const uint8_t rgba[4],
                                    burnish_error *error);

burnish_status burnish_append_normal(burnish_source *source, burnish_place place,
                                     const float normal[3], burnish_error *error);

/* Appends the triangles of a polygon, concave ones cut properly (polygon.h).
 *
 * positions: count indices, in range
 * normals:   count indices or BURNISH_SOURCE_NONE; NULL: none
 * count:     >= 3
 * Errors: LIMIT (max_triangles), MEMORY. */
burnish_status burnish_append_polygon(burnish_source *source, const burnish_load_options *options,
                                      burnish_place place, const uint32_t *positions,
                                      const uint32_t *normals, size_t count, burnish_error *error);

/* The same into count - 2 triangles for which there is room, from first_triangle on; counts nothing
 * and checks nothing. With source->corner_normals these are written too. */
void burnish_place_polygon(burnish_source *source, size_t first_triangle, const uint32_t *positions,
                           const uint32_t *normals, size_t count);

/* Room for `more` triangles. Errors: LIMIT (max_triangles), MEMORY. */
burnish_status burnish_reserve_triangles(burnish_source *source,
                                         const burnish_load_options *options, burnish_place place,
                                         size_t more, burnish_error *error);

#endif
