/* A finer mesh from a coarse one: every triangle becomes four at its edges' middles. */
#ifndef BURNISH_BENCH_PEERS_SUBDIVIDE_H
#define BURNISH_BENCH_PEERS_SUBDIVIDE_H

#include "burnish/mesh.h"

/* Subdivides `levels` times: 4^levels times the triangles, the surface unchanged, normals
 * interpolated. An edge that two triangles share gets one middle vertex.
 *   mesh    unchanged; not NULL
 *   levels  [0, 4]
 *   finer   the new mesh, owned by the caller; NULL on error
 * Errors: MEMORY and the errors of burnish_mesh_create. */
burnish_status burnish_peers_subdivide(const burnish_mesh *scene, int levels, burnish_mesh **finer,
                                       burnish_error *error);

#endif
