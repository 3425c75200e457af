/* A mesh for depth maps: the vertices in a cube of space become one of them, and triangles that lose
 * an edge are left out. Whatever is smaller than a texel is then drawn into none of the maps. */
#ifndef BURNISH_RENDER_LIGHT_VERTEX_CLUSTERS_H
#define BURNISH_RENDER_LIGHT_VERTEX_CLUSTERS_H

#include "base/memory.h"
#include "burnish/mesh.h"

/* Memory that is kept from mesh to mesh. All zero before the first. */
typedef struct burnish_clusters {
    float *positions;  /* of the clusters */
    uint32_t *indices; /* of the triangles that are left */
    uint32_t *cluster; /* of each vertex of the mesh */
    uint64_t *slots;   /* of a hash table: cell + 1 in the upper half, cluster; 0: free */
    size_t position_capacity, index_capacity, cluster_capacity, slot_capacity;
} burnish_clusters;

/* Makes *coarse a mesh of triangles with fewer vertices, valid until the next call. No vertex moves
 * by more than sqrt(3) cells. The result depends on the order of vertices alone.
 *   cell         edge of the cubes, in the raster's space
 *   transparent  triangles that are left out, as burnish_transparency's masks; NULL: none
 * Errors: MEMORY. */
burnish_status burnish_clusters_make(burnish_clusters *clusters, const burnish_mesh_view *mesh,
                                     double cell, const uint16_t *transparent,
                                     burnish_memory *memory, burnish_mesh_view *coarse);
void burnish_clusters_destroy(burnish_clusters *clusters, const burnish_context *context);

#endif
