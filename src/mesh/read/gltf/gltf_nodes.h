/* The scene's matrices. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_NODES_H
#define BURNISH_MESH_READ_GLTF_GLTF_NODES_H

#include "mesh/read/gltf/gltf.h"

/* product = a b, of 3 x 4 matrices; it may be one of them. */
void burnish_gltf_multiply(const double a[12], const double b[12], double product[12]);
void burnish_gltf_compose(const double translation[3], const double rotation[4],
                          const double scale[3], double matrix[12]);

/* A file's matrix, column after column of four, as rows of a 3 x 4 one. */
void burnish_gltf_transpose(const double columns[16], double matrix[12]);

/* Fills gltf->nodes: the matrices, and what is drawn. */
void burnish_gltf_place_nodes(burnish_gltf *gltf);

#endif
