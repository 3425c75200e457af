/* Point clouds, which are drawn as spheres, and lines as meshes of thin rods. */
#ifndef BURNISH_MESH_READ_COMMON_POINTS_H
#define BURNISH_MESH_READ_COMMON_POINTS_H

#include "mesh/read/io/reader.h"

/* Two positions that a line joins. */
typedef struct burnish_segment {
    uint32_t from, to;
} burnish_segment;

/* Completes mesh data without triangles: a point cloud, or lines. Colours are kept, texture
 * coordinates dropped.
 *
 * A cloud keeps its positions and gets point_radius. Normals are those of the file, if there is one
 * per position and the option `normals` is not OWN; they are estimated for AUTO and OWN; a normal
 * of 0, 0, 0 means that the point looks like a ball. Lines are replaced by rods,
 * with round ends up to 20,000 of them.
 *
 * The diameter is the option point_size. If that is 0, the radius of points is 1.2 times wide
 * (cloud.h), at most 1/20 of the diagonal of the inner box. Clouds that would need more, and points
 * that are not like a surface, become balls with a radius of a quarter of the spacing, at most 1/50
 * of that diagonal. No radius is below 1/4000 of it. The diameter of lines is 1/300 of the bounding
 * box's diagonal.
 *
 *   segments  `count` lines between positions; count 0: every position is a point
 * Errors: LIMIT (max_triangles, budget, positions), MEMORY, CANCELLED. */
burnish_status burnish_make_points(burnish_reader *reader, const burnish_segment *segments,
                                   size_t count);

/* Checks that so many points, or lines, may be made. Errors: LIMIT. */
burnish_status burnish_check_points(burnish_reader *reader, size_t count, int are_lines);

#endif
