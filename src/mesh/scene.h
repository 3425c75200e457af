/* The scene as the library holds it, and the checks that every way into it shares. */
#ifndef BURNISH_MESH_SCENE_H
#define BURNISH_MESH_SCENE_H

#include "burnish/mesh.h"
#include "core/error.h"

/* What burnish_load_options_default() and burnish_framing_default() leave in `cookie`: a struct
 * that was not started from them is refused instead of being read as garbage. */
#define BURNISH_LOAD_OPTIONS_COOKIE 0x6c6f6164u
#define BURNISH_FIT_OPTIONS_COOKIE 0x66697474u

/* Corners are numbered in 32 bits, so no mesh has more triangles than this. */
#define BURNISH_TRIANGLE_LIMIT ((UINT32_MAX - 1) / 3)

struct burnish_mesh {
    burnish_mesh_view mesh; /* its pointers are the arrays below */
    float *positions, *normals;
    uint8_t *colors;
    uint32_t *indices;
    uint16_t *triangle_materials;

    burnish_material *materials;
    size_t material_count;

    char **warnings;
    size_t warning_count;

    burnish_format format;
    double seconds_read, seconds_build;
};

/* Errors: ARGUMENT (NULL, not started from burnish_load_options_default(), a field out of range).
 * Every function that takes load options calls it first. */
burnish_status burnish_check_load_options(const burnish_load_options *options,
                                          burnish_error *error);

/* The same for the options of burnish_camera_frame. */
burnish_status burnish_check_fit_options(const burnish_framing *options, burnish_error *error);

#endif
