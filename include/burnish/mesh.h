/* burnish/mesh.h: a mesh from a file, from memory or built in, ready to be drawn.
 *
 * A scene is one indexed triangle mesh with unit normals, optional vertex colours and a table of
 * materials. Loading welds equal vertices, makes missing normals, and turns every triangle so that
 * its winding agrees with its normals. What it does not do: textures, animation, hierarchies.
 *
 * Every reader is safe for untrusted input: memory stays in proportion to the bytes given, all
 * counts are checked, and a malformed file gives one line that names the place.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_MESH_H
#define BURNISH_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"
#include "burnish/shading.h"

#ifdef __cplusplus
extern "C" {
#endif

/* File formats; AUTO looks at the name's ending and the first bytes. */
typedef enum burnish_format {
    BURNISH_FORMAT_AUTO,
    BURNISH_FORMAT_OBJ,
    BURNISH_FORMAT_PLY,
    BURNISH_FORMAT_STL,
    BURNISH_FORMAT_COUNT
} burnish_format;

/* A crease angle by format: 40 degrees for STL, which holds parts with chamfers, 60 for the others,
 * which hold scans and sculptures where they have no normals. */
#define BURNISH_CREASE_AUTO (-1.0)

/* How to load. Start from burnish_load_options_default(). */
typedef struct burnish_load_options {
    uint32_t cookie;          /* set by burnish_load_options_default() */
    burnish_format format;    /* AUTO unless the input has no telling name */
    double crease_angle;      /* degrees, [0, 180]: made normals are smooth across edges whose faces
                                 differ by less; 0 shades every face flat; BURNISH_CREASE_AUTO */
    int tessellation;         /* built-in objects: segments along a patch edge, [1, 256] */
    uint64_t max_input_bytes; /* a larger file is refused with LIMIT */
    uint64_t max_triangles;   /* a mesh with more is refused with LIMIT; at most 2^31 - 1 */
    int threads;              /* [0, 1024]; 0: one a processor. The scene does not depend on it. */
} burnish_load_options;

/* crease auto, tessellation 16, 16 GiB, 2^31 - 1 triangles, a thread a processor. */
BURNISH_API burnish_load_options burnish_load_options_default(void);

/* A mesh as the scene holds it; the pointers live as long as the scene. */
typedef struct burnish_mesh_view {
    size_t vertex_count;                /* [3, 2^32 - 2] */
    size_t triangle_count;              /* [1, 2^31 - 1] */
    const float *positions;             /* 3 a vertex, finite */
    const float *normals;               /* 3 a vertex, unit length */
    const uint8_t *colors;              /* 4 a vertex, sRGB and alpha; NULL: none */
    const uint32_t *indices;            /* 3 a triangle, counter-clockwise seen from its normals */
    const uint16_t *triangle_materials; /* 1 a triangle; NULL: every triangle has material 0 */
    float bounds_min[3], bounds_max[3]; /* of the positions that triangles use */
} burnish_mesh_view;

typedef struct burnish_mesh burnish_mesh;

/* Loads a file, standard input ("-"), or a built-in object (":teapot", ":sphere", ":torus",
 * ":knot"). An OBJ's material library is read from the same folder. *scene is NULL on error.
 * Errors: ARGUMENT, READ, FORMAT, LIMIT, MEMORY. */
BURNISH_API burnish_status burnish_mesh_load(const char *path, const burnish_load_options *options,
                                             burnish_mesh **scene, burnish_error *error);

/* The same from bytes in memory; name stands in messages and tells the format by its ending.
 * Nothing else is read: an OBJ's material library is reported as a warning. */
BURNISH_API burnish_status burnish_mesh_load_memory(const void *bytes, size_t size,
                                                    const char *name,
                                                    const burnish_load_options *options,
                                                    burnish_mesh **scene, burnish_error *error);

/* The caller's own arrays: copied, checked as a file is, welded, normals made where normals is
 * NULL. vertex_count * 3 positions, optional normals (3 a vertex) and sRGB colours (4 a vertex). */
BURNISH_API burnish_status burnish_mesh_create(const float *positions, const float *normals,
                                               const uint8_t *colors, size_t vertex_count,
                                               const uint32_t *indices, size_t triangle_count,
                                               const burnish_load_options *options,
                                               burnish_mesh **scene, burnish_error *error);

/* Releases everything that belongs to the scene; NULL is allowed. */
BURNISH_API void burnish_mesh_destroy(burnish_mesh *scene);

BURNISH_API const burnish_mesh_view *burnish_mesh_get_view(const burnish_mesh *scene);

/* Lines about things that were passed over (a missing material library, triangles without area
 * ...). */
BURNISH_API size_t burnish_mesh_warning_count(const burnish_mesh *scene);
BURNISH_API const char *burnish_mesh_warning(const burnish_mesh *scene, size_t index);

/* At least one material exists. An index out of range gives NULL, or ARGUMENT. */
BURNISH_API size_t burnish_mesh_material_count(const burnish_mesh *scene);
BURNISH_API const burnish_material *burnish_mesh_material(const burnish_mesh *scene, size_t index);
BURNISH_API burnish_status burnish_mesh_set_material(burnish_mesh *scene, size_t index,
                                                     const burnish_material *material,
                                                     burnish_error *error);

/* burnish's grey: what a mesh without materials gets. */
BURNISH_API burnish_material burnish_material_default(void);

/* The format that was read: OBJ, PLY, STL, or AUTO for a built-in object or the caller's arrays. */
BURNISH_API burnish_format burnish_mesh_format(const burnish_mesh *scene);

/* Wall time of loading: reading (opening, parsing) and building (welding, making normals). 0 for a
 * scene from arrays. scene may be NULL. */
BURNISH_API void burnish_mesh_load_seconds(const burnish_mesh *scene, double *read, double *build);

/* Where the picture is taken from. Right-handed world; the picture's up is view_up's projection. */
typedef struct burnish_camera {
    double position[3];
    double focal_point[3]; /* what the middle of the picture shows */
    double view_up[3];     /* not parallel to the direction of view */
    double view_angle;     /* degrees from the lower to the upper edge, (0, 180); perspective */
    double
        orthographic_height; /* 0: perspective; > 0: parallel projection, height in scene units */
} burnish_camera;

/* How burnish_camera_frame chooses a view. Start from burnish_framing_default(). */
typedef struct burnish_framing {
    uint32_t cookie;
    double up[3];        /* the scene's up axis, any length > 0 */
    double direction[3]; /* from the camera into the scene; all 0: the three-quarter view */
    double azimuth;      /* degrees, turns the camera around up, positive to the right */
    double elevation;    /* degrees, lifts the camera, positive upward */
    double view_angle;   /* degrees, (0, 180) */
    double aspect;       /* width / height of the picture */
    double margin;       /* share of the smaller side left free on each side, [0, 0.45] */
    int orthographic;    /* 1: parallel projection */
} burnish_framing;

/* up +Y, three-quarter view, view angle 30 degrees, aspect 1, margin 0.05. */
BURNISH_API burnish_framing burnish_framing_default(void);

/* The camera that shows the whole mesh as large as the margin allows, exactly: it fits the
 * projected vertices, not a bounding sphere. Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_camera_frame(const burnish_mesh *scene,
                                                const burnish_framing *options,
                                                burnish_camera *camera, burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
