/* A mesh inside the library, and the checks shared by all ways to make one. */
#ifndef BURNISH_MESH_DATA_MESH_H
#define BURNISH_MESH_DATA_MESH_H

#include "mesh/data/data.h"

struct burnish_mesh {
    burnish_mesh_view view; /* its pointers are the arrays below */
    burnish_mesh_info info;
    burnish_mesh_facts facts;
    int has_facts;
    int has_strays;                     /* 1: the inner box is framed, as of points */
    float inner_min[3], inner_max[3];   /* as in burnish_mesh_data */
    int has_beside;                     /* 1: lines or points beside faces */
    float points_min[3], points_max[3]; /* the same; of a point cloud, of what a cut has left */
    float faces_min[3], faces_max[3];   /* with splats: the bounds without them */
    const burnish_context *context;     /* allocates all arrays */

    void *attributes[BURNISH_ATTRIBUTE_COUNT]; /* vertex_count items each; NULL: none */
    uint32_t *indices;
    uint16_t *triangle_materials, *triangle_parts;
    burnish_contents contents; /* its arrays are owned */
    burnish_mesh *negatives;   /* NULL: none */
    burnish_mesh *splats;      /* NULL: none; only of a mesh with triangles */

    burnish_material *materials;
    size_t material_count;

    burnish_texture *textures; /* with their names and pixels, which are owned */
    size_t texture_count;

    burnish_named_camera *cameras; /* with their names */
    size_t camera_count;

    burnish_light *lights;
    size_t light_count;

    char **variants;
    size_t variant_count;

    char **warnings;
    size_t warning_count;
};

/* The box around `count` > 0 positions. */
void burnish_bound_positions(const float *positions, size_t count, float low[3], float high[3]);

/* Updates the view of the mesh's arrays, except for counts, and gives it a new serial number. */
void burnish_mesh_update_view(burnish_mesh *mesh);

/* Leaves out all triangles: the mesh becomes its splats. */
void burnish_mesh_keep_splats(burnish_mesh *mesh);

/* ---- Checks ---- */

/* Checks the arguments of every public function that loads. *mesh becomes NULL.
 * Errors: ARGUMENT (NULL, not started from burnish_load_options_default(), a field out of range).
 */
burnish_status burnish_check_load(const burnish_load_options *options, burnish_mesh **mesh,
                                  burnish_error *error);

/* Fails with LIMIT if `count` triangles exceed the options. The message starts with `where`: the
 * name of the input and a location in it. */
burnish_status burnish_check_triangle_count(const burnish_load_options *options, const char *where,
                                            uint64_t count, burnish_error *error);

#endif
