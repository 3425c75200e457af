/* Morph targets and skins. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_DEFORM_H
#define BURNISH_MESH_READ_GLTF_GLTF_DEFORM_H

#include "mesh/read/gltf/gltf.h"

/* A morph target with the weight that it has. */
typedef struct burnish_gltf_target {
    const burnish_gltf_accessor *position, *normal; /* NULL: it moves none */
    double weight;
} burnish_gltf_target;

/* How the vertices of the current primitive are placed in the world. */
typedef struct burnish_gltf_shape {
    double matrix[12];
    double cofactors[9]; /* for normals, with their side corrected if the matrix mirrors */
    int is_mirrored;
    burnish_gltf_target *targets;
    size_t target_count, target_capacity;
    const burnish_gltf_skin *skin;
    int set_count; /* 0: no skin */
    const burnish_gltf_accessor *joints[BURNISH_GLTF_SETS], *weights[BURNISH_GLTF_SETS];
} burnish_gltf_shape;

/* Sets how a primitive of a node is placed in the world by the matrix of the node or of an
 * instance. */
void burnish_gltf_set_shape(burnish_gltf *gltf, burnish_gltf_shape *shape,
                            const burnish_gltf_node *node, const double matrix[12],
                            const burnish_gltf_primitive *primitive);

/* Moves a vertex by morph targets, and sets the shape's matrices from its joints. Returns 0 on
 * failure. */
int burnish_gltf_move(burnish_gltf *gltf, burnish_gltf_shape *shape, size_t vertex,
                      double position[3], double normal[3]);

#endif
