/* What the built-in objects share: a data of exact size, filled vertex by vertex. */
#ifndef BURNISH_MESH_BUILTIN_H
#define BURNISH_MESH_BUILTIN_H

#include "core/vector.h"
#include "mesh/mesh_data.h"

/* Makes room in an empty data for a surface whose vertices carry a normal each.
 * Errors: LIMIT (more triangles than options->max_triangles), MEMORY. */
burnish_status burnish_surface_reserve(burnish_mesh_data *data, const char *name,
                                       size_t vertex_count, size_t triangle_count,
                                       const burnish_load_options *options, burnish_error *error);

/* Appends a vertex within the room reserved. */
void burnish_surface_vertex(burnish_mesh_data *data, burnish_vec3 position, burnish_vec3 normal);

/* Appends a triangle, counter-clockwise seen from outside, within the room reserved. */
void burnish_surface_triangle(burnish_mesh_data *data, uint32_t a, uint32_t b, uint32_t c);

/* Newell's teapot; errors as burnish_surface_reserve. */
burnish_status burnish_make_teapot(const burnish_load_options *options, burnish_mesh_data *data,
                                   burnish_error *error);

#endif
