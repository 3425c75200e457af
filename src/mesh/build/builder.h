/* What the steps of building a mesh share; build.c calls them in their order. */
#ifndef BURNISH_MESH_BUILD_BUILDER_H
#define BURNISH_MESH_BUILD_BUILDER_H

#include <string.h>

#include "core/vector.h"
#include "mesh/mesh.h"

enum {
    BURNISH_BUILD_GRAIN = 8192,                   /* triangles, positions or vertices that are
                                                     worth a thread */
    BURNISH_EXTRA_ATTRIBUTES = BURNISH_NORMAL + 1 /* the first one that is only passed on */
};

/* An attribute besides position and normal: only passed on. */
typedef struct burnish_extra {
    burnish_attribute attribute;
    const uint32_t *corners; /* BURNISH_NONE: white, or 0 */
    const uint8_t *items;
} burnish_extra;

typedef struct burnish_builder {
    burnish_mesh_data *data;
    burnish_memory *memory; /* the data's */
    const char *name;       /* of the input */
    burnish_mesh *mesh;     /* the result */
    double crease_angle;

    size_t position_count;      /* welded positions, at the head of data's positions */
    size_t triangle_count;      /* triangles with area, at the head of data's arrays */
    uint32_t *corner_positions; /* 3 per triangle: welded positions */
    int has_extras;             /* attributes besides position and normal */
    int normals_complete;       /* every corner has a normal of the file's */

    uint32_t *first_corner; /* position_count + 1: where a position's corners start in ... */
    uint32_t *corners;      /* ... all corners, by position */
    size_t max_faces;       /* around one position */
    burnish_extra extras[BURNISH_ATTRIBUTE_COUNT]; /* from the vertices on */
    int extra_count;
    size_t vertex_count;
} burnish_builder;

/* The file's normal of a corner, or NULL where one must be generated. */
static inline const float *burnish_file_normal(const burnish_mesh_data *data, size_t corner) {
    const uint32_t number = data->streams[BURNISH_NORMAL].count > 0
                                ? burnish_stream_corners(data, BURNISH_NORMAL)[corner]
                                : BURNISH_NONE;
    const float *n = number == BURNISH_NONE ? NULL : burnish_normals(data) + 3 * (size_t)number;
    return n && (n[0] != 0 || n[1] != 0 || n[2] != 0) ? n : NULL;
}

/* ---- triangles.c ---- */

/* Moves the different positions to the head of their array, keeps the triangles with area and fills
 * corner_positions; triangles whose winding contradicts the file's normals are turned. Makes the
 * file's normals unit vectors. Errors: FORMAT (nothing is left), MEMORY, CANCELLED. */
burnish_status burnish_build_triangles(burnish_builder *b);

/* Orders the triangles in space. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_order(burnish_builder *b);

/* Releases what is kept per corner but for `extras`, whose corners are needed until they are
 * written: most of the memory. */
void burnish_build_release_corners(burnish_builder *b, int extras);

/* ---- index_file_normals.c, vertices.c ---- */

/* Makes the vertices and the mesh's indices where every corner has a normal of the file's and
 * nothing else; finds what burnish_build_vertices would find. *done becomes 0 where it can't be
 * used. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_index_file_normals(burnish_builder *b, int *done);

/* The same for any mesh: generates normals where the file has none. */
burnish_status burnish_build_vertices(burnish_builder *b);

/* The mesh's arrays of vertex_count vertices. Errors: MEMORY. */
burnish_status burnish_build_allocate(burnish_builder *b);

#endif
