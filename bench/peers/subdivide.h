/* A finer mesh from a coarse one: every triangle becomes four at its edges' middles. */
#ifndef BURNISH_BENCH_PEERS_SUBDIVIDE_H
#define BURNISH_BENCH_PEERS_SUBDIVIDE_H

#include "burnish/scene.h"

/* Subdivides `levels` times: 4^levels times the triangles, the surface unchanged, normals
 * interpolated. An edge that two triangles share gets one middle vertex.
 *   scene   left as it is; not NULL
 *   levels  [0, 4]
 *   finer   the new scene, the caller's; NULL on error
 * Errors: those of burnish_scene_create, MEMORY. */
burnish_status burnish_peers_subdivide(const burnish_scene *scene, int levels,
                                       burnish_scene **finer, burnish_error *error);

#endif
