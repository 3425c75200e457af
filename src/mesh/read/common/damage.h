/* Values and faces that can't be used are left out of a mesh, with one warning for all.
 *
 * Readers note them in reader->damage, in the words of an error, and store NaN for a bad position,
 * or an index without a position for a bad corner. */
#ifndef BURNISH_MESH_READ_COMMON_DAMAGE_H
#define BURNISH_MESH_READ_COMMON_DAMAGE_H

#include "mesh/read/io/reader.h"

/* Whether a corner has a position that is finite. */
int burnish_is_good_position(const burnish_mesh_data *mesh, uint32_t corner);

/* Moves positions that are not finite to one that is. Nothing may use them. */
void burnish_fill_positions(burnish_mesh_data *mesh);

/* Copies a triangle to another place, with all that is stored per triangle. */
void burnish_keep_triangle(burnish_mesh_data *mesh, size_t from, size_t to);

/* Gives all corners of polygons with a bad corner the position BURNISH_NONE. Call it before polygons
 * are cut. */
void burnish_mark_damage(burnish_reader *reader);

/* Leaves out points whose position is not finite, with their values. */
void burnish_drop_points(burnish_reader *reader);

/* After reading: leaves out triangles with a bad corner, makes all positions finite, and warns.
 * Without damage it does nothing. Errors: FORMAT (nothing is left, with the first message). */
burnish_status burnish_drop_damage(burnish_reader *reader);

#endif
