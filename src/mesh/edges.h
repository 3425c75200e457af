/* Edges of a mesh and their triangles, over welded positions, for line drawing. */
#ifndef BURNISH_MESH_EDGES_H
#define BURNISH_MESH_EDGES_H

#include "base/memory.h"
#include "burnish/mesh.h"
#include "core/tasks.h"

/* No second triangle. */
#define BURNISH_EDGE_OPEN UINT32_MAX

enum {
    BURNISH_EDGE_SHARP = 1,    /* the surface has a crease here, also in shading */
    BURNISH_EDGE_MATERIAL = 2, /* the triangles differ in material */
    BURNISH_EDGE_ALIKE = 4,    /* both triangles run along it in the same direction */
    BURNISH_EDGE_TANGENT = 32  /* set by burnish_edges_find_tangents */
};

typedef struct burnish_edge {
    uint32_t ends[2];      /* vertices; the first one at each position */
    uint32_t triangles[2]; /* the first runs from ends[0] to ends[1]; the second may be
                              BURNISH_EDGE_OPEN */
    uint32_t flags;
} burnish_edge;

/* Edges in the order of their lesser end. */
typedef struct burnish_edges {
    burnish_edge *items;
    size_t count;
} burnish_edges;

/* Finds the edges of a mesh.
 *
 * An edge is sharp if the normals of its two triangles differ by more than 8 degrees at one of its
 * ends, by the crease rule or by the file's normals, and the faces differ too. If a crease passes
 * that end, they must differ at both ends. If more than two triangles share an edge, the first one
 * and the one most bent against it represent them.
 *
 * O(n log n) for any input; 20 bytes per edge remain, and 24 bytes per triangle and 12 per vertex
 * are used temporarily. The result does not depend on the number of threads. Errors: MEMORY,
 * CANCELLED; the edges are then empty. Release items with burnish_release. */
burnish_status burnish_edges_find(const burnish_mesh_view *mesh, burnish_tasks *tasks,
                                  burnish_memory *memory, burnish_edges *edges);

/* Marks tangent edges: smooth ones where a bend meets a face without a bend, or a longer one, in
 * lines from edge to edge. Errors: memory->status. */
void burnish_edges_find_tangents(const burnish_mesh_view *mesh, burnish_memory *memory,
                                 burnish_edges *edges);

#endif
