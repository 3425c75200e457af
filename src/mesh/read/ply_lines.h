/* Rows of an ASCII PLY body that are one line each: read by threads. */
#ifndef BURNISH_MESH_READ_PLY_LINES_H
#define BURNISH_MESH_READ_PLY_LINES_H

#include "mesh/read/ply_cursor.h"

/* Appends all vertices of the element at hand, which has some, to a source that has none, and moves
 * the cursor behind them. Returns 0 when nothing was done: it does not pay, or something is unusual
 * or wrong, which reading value by value will tell. */
int burnish_ply_vertex_lines(burnish_ply_cursor *ply, burnish_source *source);

/* The same for faces, in a source that has all its vertices. */
int burnish_ply_face_lines(burnish_ply_cursor *ply, const burnish_load_options *options,
                           burnish_source *source);

#endif
