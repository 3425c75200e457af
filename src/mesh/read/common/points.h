/* Point clouds and lines as meshes: a small round solid for each point, a thin prism for each line.
 * So all that is done with triangles is done with them. */
#ifndef BURNISH_MESH_READ_COMMON_POINTS_H
#define BURNISH_MESH_READ_COMMON_POINTS_H

#include "mesh/read/io/reader.h"

/* Two positions that a line joins. */
typedef struct burnish_segment {
    uint32_t from, to;
} burnish_segment;

/* Replaces mesh data without triangles by solids that stand for its positions, or for lines between
 * them. Colours are kept. A point's solid is shaded by the point's normal where the file has
 * normals, numbered as positions are, else as a ball; texture coordinates are dropped.
 *
 * Their diameter is the option point_size. Where that is 0: for points twice the median distance to
 * the nearest other point, so that a scanned surface closes, and for lines a 300th of the bounding
 * box's diagonal; in both cases from a 2000th to a 25th of that.
 *
 *   segments  count of them, of positions that are there; count 0: every position is a point
 * Errors: LIMIT (max_triangles, budget, positions), MEMORY, CANCELLED. */
burnish_status burnish_make_points(burnish_reader *reader, const burnish_segment *segments,
                                   size_t count);

/* Whether so many points, or lines, would be made. Errors: LIMIT. */
burnish_status burnish_check_points(burnish_reader *reader, size_t count, int are_lines);

#endif
