/* Point clouds and lines as meshes: a small round solid for each point, a thin prism for each line.
 * Everything that works with triangles then works with them. */
#ifndef BURNISH_MESH_READ_COMMON_POINTS_H
#define BURNISH_MESH_READ_COMMON_POINTS_H

#include "mesh/read/io/reader.h"

/* Two positions that a line joins. */
typedef struct burnish_segment {
    uint32_t from, to;
} burnish_segment;

/* Replaces mesh data without triangles by solids at its positions, or along lines between them.
 * Colours are kept. If the file has normals, numbered like positions, a point's solid is shaded by
 * the point's normal, otherwise as a ball. Texture coordinates are dropped.
 *
 * Their diameter is the option point_size. If that is 0, the diameter of points is twice the median
 * distance to the nearest other point, which closes a scanned surface. Lines use 1/300 of the
 * bounding box's diagonal. Both are clamped to 1/2000 to 1/25 of the diagonal.
 *
 *   segments  `count` lines between positions; count 0: every position is a point
 * Errors: LIMIT (max_triangles, budget, positions), MEMORY, CANCELLED. */
burnish_status burnish_make_points(burnish_reader *reader, const burnish_segment *segments,
                                   size_t count);

/* Checks that so many points, or lines, may be made. Errors: LIMIT. */
burnish_status burnish_check_points(burnish_reader *reader, size_t count, int are_lines);

#endif
