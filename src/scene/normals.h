/* Made normals: the average of the faces around a vertex, weighted by their angles there. */
#ifndef BURNISH_SCENE_NORMALS_H
#define BURNISH_SCENE_NORMALS_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"
#include "base/vector.h"
#include "scene/weld.h"

/* Scratch for the faces around one vertex; made once for the vertex with the most faces. */
typedef struct burnish_fan {
    double crease_cosine;
    int flat; /* crease angle 0: no edge is smooth */
    burnish_vec3 *face_normals, *sums;
    double *angles;
    uint32_t *parents;
    burnish_weld_record *edges;
} burnish_fan;

/* max_faces: the most faces around one vertex; crease_angle: degrees, [0, 180].
 * Errors: MEMORY, LIMIT; the fan is then empty. */
burnish_status burnish_fan_create(burnish_fan *fan, size_t max_faces, double crease_angle,
                                  burnish_error *error);

/* Releases the scratch; a fan of zero bytes is allowed. */
void burnish_fan_destroy(burnish_fan *fan);

/* Unit normals of the corners that meet in one vertex, O(count log count).
 *
 * Two faces are joined when they share an edge at this vertex and their normals differ by less than
 * the crease angle; each set of joined faces has one normal, the sum of its unit face normals times
 * their angles at the vertex (Thuermer and Wuethrich 1998), which does not depend on how a flat
 * face is cut into triangles. Where the sum cancels to nothing, each face keeps its own.
 *
 * positions: 3 a vertex; corner_vertices: 3 a triangle, every triangle with area
 * corners:   count corners (3 * triangle + 0..2) whose vertex is the same
 * normals:   3 a corner, in the order of corners, written */
void burnish_fan_normals(burnish_fan *fan, const float *positions, const uint32_t *corner_vertices,
                         const uint32_t *corners, size_t count, float *normals);

/* The cross product of two edges: twice the area long, along the normal by winding. */
burnish_vec3 burnish_face_cross(const float *positions, const uint32_t vertices[3]);

/* Writes v / |v| in float with no negative zeros; 0 when v has no direction or is not finite. */
void burnish_store_unit(burnish_vec3 v, float unit[3]);

#endif
