/* How readers fill a oracle_source: one value at a time, limits checked. */
#ifndef ORACLE_MESH_READ_APPEND_H
#define ORACLE_MESH_READ_APPEND_H

#include "oracle/reader.h"
#include "oracle/text.h"

/* Corner indices stop below ORACLE_SOURCE_NONE. */
#define ORACLE_POSITION_LIMIT ((size_t)UINT32_MAX - 1)

/* Appends one position, which the caller has found finite. With colours in use it becomes white.
 * Errors: LIMIT, MEMORY. */
burnish_status oracle_append_position(oracle_source *source, oracle_place place,
                                      const float position[3], burnish_error *error);

/* Gives the last position a colour; positions without one become white. Errors: MEMORY. */
burnish_status oracle_append_color(oracle_source *source, const uint8_t rgba[4],
                                   burnish_error *error);

burnish_status oracle_append_normal(oracle_source *source, oracle_place place,
                                    const float normal[3], burnish_error *error);

/* Appends the triangles of a polygon, concave ones cut properly (polygon.h).
 *
 * positions: count indices, in range
 * normals:   count indices or ORACLE_SOURCE_NONE; NULL: none
 * count:     >= 3
 * Errors: LIMIT (max_triangles), MEMORY. */
burnish_status oracle_append_polygon(oracle_source *source, const burnish_load_options *options,
                                     oracle_place place, const uint32_t *positions,
                                     const uint32_t *normals, size_t count, burnish_error *error);

/* The same into count - 2 triangles for which there is room, from first_triangle on; counts nothing
 * and checks nothing. With source->corner_normals these are written too. */
void oracle_place_polygon(oracle_source *source, size_t first_triangle, const uint32_t *positions,
                          const uint32_t *normals, size_t count);

/* Room for `more` triangles. Errors: LIMIT (max_triangles), MEMORY. */
burnish_status oracle_reserve_triangles(oracle_source *source, const burnish_load_options *options,
                                        oracle_place place, size_t more, burnish_error *error);

#endif
