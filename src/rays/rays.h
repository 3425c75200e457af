/* Rays against the triangles of a mesh: a tree of boxes, and what is hit. Points are in
 * the raster's space (render/space.h): the mesh is within the unit sphere. */
#ifndef BURNISH_RAYS_RAYS_H
#define BURNISH_RAYS_RAYS_H

#include "base/memory.h"
#include "burnish/mesh.h"
#include "core/tasks.h"
#include "simd/isa.h"

/* Two boxes and what they hold: `count` triangles from `child` on, or with 0 the node `child`. */
typedef struct burnish_ray_node {
    float low[2][3], high[2][3];
    uint32_t child[2], count[2];
} burnish_ray_node;

/* No path from the root is longer: splits by area for the first part of it, halves after that. */
enum { BURNISH_RAY_SPLITS = 40, BURNISH_RAY_DEPTH = BURNISH_RAY_SPLITS + 32 };

/* A tree. Owned; all zero before the first update. It takes 40 bytes per triangle and 64 per node,
 * of which there are about half as many: 75 bytes per triangle, and 175 while it is built. */
typedef struct burnish_ray_tree {
    burnish_ray_node *nodes; /* the root first */
    float (*triangles)[9];   /* corners, in the order of the leaves */
    uint32_t *numbers;       /* of these, in the mesh */
    size_t node_count, triangle_count, node_capacity, triangle_capacity, number_capacity;
    uint64_t mesh; /* whose it is, burnish_mesh_view.serial; 0: nobody's */
    double work;   /* triangles that a ray from anywhere is tested against, on average */
} burnish_ray_tree;

/* Which triangles, and where they lie. */
typedef struct burnish_ray_mesh {
    const burnish_mesh_view *view;
    const uint16_t *left_out; /* bit i % 16 of i / 16: triangle i is; NULL: none */
    float center[3], scale;   /* (position - center) scale is in the space of rays */
    double most_work;         /* beyond it, the tree is refused */
} burnish_ray_mesh;

/* Builds the tree unless it is there. Triangles of the same three corners are one. Errors: MEMORY,
 * CANCELLED, after which the tree is nobody's; LIMIT, after which it is kept but not used. */
burnish_status burnish_ray_tree_update(burnish_ray_tree *tree, const burnish_ray_mesh *mesh,
                                       burnish_tasks *tasks, burnish_memory *memory);
void burnish_ray_tree_destroy(burnish_ray_tree *tree, const burnish_context *context);

/* Rays from origins along unit vectors, up to `reach` away. Arrays are read up to the next multiple
 * of 16. */
typedef struct burnish_ray_batch {
    const float *origin[3], *direction[3], *reach;
    size_t count;
} burnish_ray_batch;

/* The kernels, compiled once per instruction set (rays_isa.c). */
typedef struct burnish_ray_ops {
    /* 1 for each ray that hits a triangle, from either side, else 0. A ray along an edge hits its
     * triangles; between triangles that share corners none passes. Writes whole vectors.
     *   distances, places  of the nearest that each hits: how far it is, and its place in the tree;
     *                      NULL: not wanted */
    void (*find_hits)(const burnish_ray_tree *tree, const burnish_ray_batch *rays, float *hits,
                      float *distances, int32_t *places);
} burnish_ray_ops;

const burnish_ray_ops *burnish_ray_ops_for(burnish_isa isa);

#endif
