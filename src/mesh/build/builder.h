/* The state of building a mesh. build.c calls the steps in their order. */
#ifndef BURNISH_MESH_BUILD_BUILDER_H
#define BURNISH_MESH_BUILD_BUILDER_H

#include <string.h>

#include "mesh/build/normals/welded.h"
#include "mesh/data/mesh.h"

enum {
    BURNISH_BUILD_GRAIN = 8192,   /* triangles, positions or vertices per thread, at least */
    BURNISH_BUILD_STEP = 1 << 16, /* items of a serial loop between checks for cancellation */
    BURNISH_EXTRA_ATTRIBUTES = BURNISH_NORMAL + 1, /* the first one that is only copied */
    BURNISH_ATTRIBUTE_BYTES = 16,                  /* of the largest attribute's items */
    BURNISH_TRIPLE = 3 * sizeof(uint32_t)          /* bytes of a triangle's corners */
};

/* An attribute other than position and normal, which is only copied. */
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
    burnish_normals_source normals; /* AUTO only for formats whose normals are questioned */
    int measure;                    /* 1: the mesh gets its facts */
    int needs_tangents;             /* 1: a material has directions along the surface */
    int wide;                       /* as burnish_face_width() has it */

    size_t position_count;      /* welded positions, at the head of data's positions */
    size_t triangle_count;      /* triangles with area, at the head of data's arrays */
    uint32_t *corner_positions; /* 3 per triangle: welded positions; may be the corners of data's
                                   positions */
    size_t corner_capacity;     /* triangles that there is memory for, if they are not */
    int has_extras;             /* attributes other than position and normal */
    int has_file_normals;       /* some corner does */
    int normals_replaced;       /* AUTO has dropped them */
    int normals_complete;       /* every corner has a normal from the file */

    uint32_t *order; /* for each triangle of the mesh, its present number; NULL: unchanged */

    uint32_t *first_corner; /* position_count + 1: where a position's corners start in ... */
    uint32_t *corners;      /* ... all corners, by position */
    size_t max_faces;       /* around one position */
    burnish_surface surface;
    burnish_extra extras[BURNISH_ATTRIBUTE_COUNT]; /* from the vertices on */
    int extra_count;
    size_t vertex_count;
} burnish_builder;

/* The file's normal of a corner; NULL if it must be generated. */
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

/* Releases per-corner data, which is most of the memory, except for `extras`, whose corners are
 * needed until they are written. */
void burnish_build_release_corners(burnish_builder *b, int extras);

/* Releases all numbers that corners have; the values, and the order, stay. */
void burnish_build_release_numbers(burnish_builder *b);

/* ---- corners.c ---- */

/* Lists the corners of every position, in the order of the triangles: first_corner, corners and
 * max_faces. Errors: MEMORY, LIMIT (crowded_max), CANCELLED. */
burnish_status burnish_build_list_corners(burnish_builder *b);

/* ---- spatial_order.c ---- */

/* Orders the triangles so neighbours in space are neighbours in memory. The order depends on
 * positions and corners only. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_order(burnish_builder *b);

/* Moves per-triangle data into the order, and releases the order. corners 0: what only corners have
 * stays where it is, since it was used in that order
 * Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_move(burnish_builder *b, int corners);

/* ---- indexed.c ---- */

/* Indices and vertices of a mesh with the file's normals and at most one attribute besides, by
 * their numbers. For other meshes, and if a position has many vertices, *done becomes 0 and no
 * vertex is made. Errors: MEMORY, CANCELLED. */
burnish_status burnish_build_indexed(burnish_builder *b, int *done);

/* ---- tangents.c ---- */

/* Drops textures, coordinates and tangents that the mesh does not need, before it is built. */
void burnish_build_prepare_textures(burnish_builder *b, const burnish_load_options *options);

/* Generates tangents that are needed but missing from the file. Makes them unit vectors at right
 * angles to the normals. Mirrored triangles may get separate vertices. Errors: MEMORY, LIMIT,
 * CANCELLED. */
burnish_status burnish_build_tangents(burnish_builder *b);

#endif
