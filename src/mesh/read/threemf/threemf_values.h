/* The materials, colours and coordinates of triangles' properties. */
#ifndef BURNISH_MESH_READ_THREEMF_THREEMF_VALUES_H
#define BURNISH_MESH_READ_THREEMF_THREEMF_VALUES_H

#include "mesh/read/threemf/threemf.h"

/* Mixes composites, and chooses what is drawn of multiple properties. Returns 0 on failure. */
int burnish_threemf_mix(burnish_threemf *threemf);

/* Resolves the group and properties of an object's triangles, and gives the mesh the materials and
 * textures that they use. Returns 0 on failure. */
int burnish_threemf_use_values(burnish_threemf *threemf, const burnish_threemf_object *object);

/* After all triangles: decides whether their plain material is the look's grey, and warns of
 * colours with alpha 0. */
void burnish_threemf_settle_values(burnish_threemf *threemf);

/* The material of a triangle whose group is resolved. */
uint16_t burnish_threemf_material_of(const burnish_threemf *threemf,
                                     const burnish_threemf_triangle *triangle);

#endif
