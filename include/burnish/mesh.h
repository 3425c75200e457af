/* burnish/mesh.h: meshes from files, memory, arrays or built-in objects, and cameras.
 *
 * A mesh is one list of indexed triangles with unit normals, optional vertex colours and texture
 * coordinates, materials and textures. Loading welds equal positions, generates missing normals,
 * and orients each triangle to match its normals.
 *
 *     burnish_load_options options = burnish_load_options_default();
 *     burnish_mesh *mesh;
 *     if (burnish_mesh_load("part.stl", &options, &mesh, &error) == BURNISH_STATUS_OK) {
 *         burnish_framing framing = burnish_framing_default();
 *         burnish_camera_frame(mesh, &framing, &camera, &error);
 *         ... burnish/render.h draws it ...
 *         burnish_mesh_destroy(mesh);
 *     }
 *
 * Hierarchies are flattened, and an animation is reduced to one moment of it.
 *
 * All readers are safe for untrusted input: memory is proportional to the size of the input, all
 * counts are checked, and a malformed file produces a one-line error with the location. A mesh
 * depends only on its input and options, not on threads, instruction sets or the floating-point
 * environment.
 *
 * Threads. Any number of threads may read and draw a mesh at once. burnish_mesh_set_material() and
 * burnish_mesh_clip() change it: during these calls no other thread may use the mesh.
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

/* ---- Formats ---- */

/* All file formats: X(name, word, extensions, x, y, z of the up axis), as in
 * burnish_format_info. */
#define BURNISH_FORMAT_LIST(X)                                                                     \
    X(GLTF, gltf, ".gltf .glb", 0, 1, 0)                                                           \
    X(OBJ, obj, ".obj", 0, 1, 0)                                                                   \
    X(OFF, off, ".off", 0, 1, 0)                                                                   \
    X(PLY, ply, ".ply", 0, 1, 0)                                                                   \
    X(STL, stl, ".stl", 0, 0, 1)                                                                   \
    X(3MF, 3mf, ".3mf", 0, 0, 1)                                                                   \
    X(GCODE, gcode, ".gcode .gco .bgcode", 0, 0, 1)                                                \
    X(SPLAT, splat, ".splat", 0, 1, 0)                                                             \
    X(SPZ, spz, ".spz", 0, 1, 0)                                                                   \
    X(BMS, bms, ".bms", 0, 1, 0)                                                                   \
    X(SCENE, scene, ".scene.json", 0, 0, 1)                                                        \
    X(URDF, urdf, ".urdf", 0, 0, 1)                                                                \
    X(PCD, pcd, ".pcd", 0, 1, 0)                                                                   \
    X(LAS, las, ".las", 0, 0, 1)                                                                   \
    X(XYZ, xyz, ".xyz .pts", 0, 0, 1)

/* The sources of meshes. File formats come last. */
typedef enum burnish_format {
    BURNISH_FORMAT_AUTO,    /* in load options: by file extension and first bytes */
    BURNISH_FORMAT_BUILTIN, /* a built-in object */
    BURNISH_FORMAT_ARRAYS,  /* the caller's arrays */
#define BURNISH_FORMAT_ENUM(name, word, extensions, x, y, z) BURNISH_FORMAT_##name,
    BURNISH_FORMAT_LIST(BURNISH_FORMAT_ENUM)
#undef BURNISH_FORMAT_ENUM
        BURNISH_FORMAT_COUNT
} burnish_format;

/* The properties of a format. */
typedef struct burnish_format_info {
    const char *name;       /* such as "stl" */
    const char *extensions; /* lower case, separated by spaces: ".stl"; "" if there are none */
    float up_axis[3];       /* unit vector: the usual up axis */
    int is_file;            /* 1: a file format, valid in load options */
} burnish_format_info;

/* The number of formats in the library, which are numbered from 0. */
BURNISH_API int burnish_format_count(void);

/* NULL for a value outside the list. */
BURNISH_API const burnish_format_info *burnish_format_get_info(burnish_format format);

/* ---- Loading ---- */

/* The grey material of a mesh without materials. */
BURNISH_API burnish_material burnish_material_default(void);

/* Chooses for each edge whether it is smooth, from the surface around it, in the same way for all
 * formats. Edges are smooth up to 20 degrees and sharp from 60 degrees on. Between these, an edge
 * is smooth in two cases: both faces bend at all their edges, as in scans and simplified meshes;
 * or, up to 40 degrees, the edge is a step of a curve, with flat faces of similar width on both
 * sides and further bending in the same sense. So a cylinder of 12 sides is round, and chamfers,
 * octagons and pockets keep their edges. In an organic surface, such as a scan, which has hardly
 * any neighbours in one plane, edges up to 160 degrees are smooth among edges that bend gently. A
 * flat face with four times the area of the others at a vertex sets the normal there, so a fillet
 * does not bend a plane. */
#define BURNISH_CREASE_AUTO (-1.0)

/* Which normals a mesh gets. */
typedef enum burnish_normals_source {
    BURNISH_NORMALS_AUTO, /* FILE for arrays. OWN for others if crease_angle is given. Otherwise
                             FILE, except that an OBJ, PLY or OFF file, or a glTF file without
                             normal textures, gets OWN, with a warning, if its normals smooth
                             the sharp edges of flat faces on more than 10 % of the area: at a
                             corner the normal is over 35 degrees off the face, and an edge of
                             60 degrees or more has this normal on both sides */
    BURNISH_NORMALS_FILE, /* those of the input; missing ones are generated */
    BURNISH_NORMALS_OWN   /* all are generated; triangles keep their winding */
    /* A point cloud takes those of the file for AUTO and FILE, if there are some. Otherwise AUTO
       and OWN estimate them from neighbouring points, if two thirds of these are like a surface,
       and FILE draws balls. */
} burnish_normals_source;

/* Whether the picture that a 3MF package or G-code holds of itself is drawn, on a sheet that faces the
 * viewer. It is no geometry: burnish_mesh_info.is_thumbnail. */
typedef enum burnish_thumbnail {
    BURNISH_THUMBNAIL_AUTO, /* if it has no mesh (sliced), no path that can be read (binary G-code),
                                or is encrypted, with a warning */
    BURNISH_THUMBNAIL_NEVER, /* such a file fails with FORMAT */
    BURNISH_THUMBNAIL_ONLY   /* always; other formats ignore it */
} burnish_thumbnail;

/* No animation: the scene as stored in the file. */
#define BURNISH_AT_REST (-1.0)

/* A limit of texels that depends on the size of the input. */
#define BURNISH_TEXTURE_PIXELS_AUTO UINT64_MAX

/* The most triangles of a mesh: (2^32 - 2) / 3, since corners are numbered in 32 bits. */
#define BURNISH_TRIANGLES_MAX 1431655764u

/* Loads files that the input references, such as the material library of an OBJ file.
 *   load       returns the whole file in *bytes and *size, valid until release; or a status and a
 *              message. name comes from the input: relative to it, and not to be trusted. A file
 *              above max_bytes fails with LIMIT. A failure becomes a warning, and the mesh is
 *              loaded without the file
 *   release    called once per successful load; may be NULL
 *   user_data  passed to both */
typedef struct burnish_file_loader {
    burnish_status (*load)(void *user_data, const char *name, uint64_t max_bytes,
                           const void **bytes, size_t *size, burnish_error *error);
    void (*release)(void *user_data, const void *bytes, size_t size);
    void *user_data;
} burnish_file_loader;

/* Decodes compressed data, and files, that burnish does not decode itself.
 *   decode     called once per file with all streams of a form. The result stays valid until
 *              release. It is checked like a file. An error ends loading
 *     form     "draco": primitives of KHR_draco_mesh_compression in glTF. docs/importers.md
 *              describes the layout of bytes and decoded. Another: the extension of a file that a
 *              scene names, such as "dae", of which `bytes` is the whole; decoded is a mesh stream
 *   release    may be NULL
 *   user_data  passed to both */
typedef struct burnish_stream_decoder {
    burnish_status (*decode)(void *user_data, const char *form, const void *bytes, size_t size,
                             const uint8_t **decoded, size_t *decoded_size, burnish_error *error);
    void (*release)(void *user_data, const uint8_t *decoded, size_t decoded_size);
    void *user_data;
} burnish_stream_decoder;

/* The position of a robot's joint: radians, or metres of a prismatic one. */
typedef struct burnish_joint {
    char name[128];
    double value; /* [-1e6, 1e6] */
} burnish_joint;

/* Options for loading. Start from burnish_load_options_default(). */
typedef struct burnish_load_options {
    uint32_t cookie;                /* set by burnish_load_options_default() */
    const burnish_context *context; /* must outlive the mesh; NULL: the default */
    burnish_format format;          /* AUTO, or a file format */
    double crease_angle; /* degrees, [0, 180]: generated normals are smooth across edges with a
                            smaller angle, weighted by the angles of the faces at the vertex. 0:
                            flat faces. Or BURNISH_CREASE_AUTO */
    burnish_normals_source normals; /* AUTO, FILE or OWN */
    int tessellation;               /* of built-in objects: segments per patch edge, [1, 256] */
    int keep_texture_coordinates;   /* 1: always; 0: only if a material uses a texture. Vertices
                                     with different coordinates are not welded */
    int ignore_textures;            /* 1: no texture is loaded or used */
    int measure;                    /* 1: compute the facts that burnish_mesh_get_facts() returns */
    double point_size; /* diameter of points and lines in a file without faces, in its units. 0:
                          the radius of points closes a sampled surface (docs/formats.md),
                          but their diameter between 1/2000 and 1/25 of the bounds' diagonal; the
                          diameter of lines is 1/300 of the diagonal */
    const char *scalar_property; /* NULL, or the name of a scalar property of the vertices of a PLY
                             file or a cloud, or of a scalar attribute of glTF such as "_HEAT". It replaces
                             the texture coordinates: u (and in PLY v) is its value. Use it with
                             keep_texture_coordinates. A file without it fails with FORMAT; other
                             formats ignore it */
    const double *origin; /* 3 numbers in [-1e30, 1e30], subtracted from the coordinates of the file
                             before they are rounded to float. The origin of another mesh puts both
                             into one space. NULL: 0, 0, 0; or a point near the middle, if the mesh
                             is over 32 times its size away and the file has more precision than
                             float */
    int ignore_referenced_files; /* 1: do not read referenced files, without a warning */
    int strict;  /* 1: warnings are errors, FORMAT; 0: harmless errors in a file are ignored or
                   repaired, with a warning */
    int threads; /* the most threads, [0, 1024]; 0: one per processor. Does not affect the mesh */
    double animation_time; /* seconds, >= 0: the moment of the animation; or BURNISH_AT_REST */
    const char *animation; /* its name, or its number from 0; NULL: the first. Without a time, the
                              scene at its start */
    const char *variant;   /* the material variant of a glTF file, by name; NULL: the file's own
                              materials. A name that the file lacks fails with ARGUMENT; a file
                              without variants ignores it */
    int plate; /* of a print project (3MF), by number from 1; 0: all of them, moved close
                              together. A number that the project lacks fails with ARGUMENT; a file
                              without plates ignores it */
    struct burnish_project **project; /* NULL, or for loads of one file that differ only in plate,
                                         plate 0 first: what that load has parsed, which the others
                                         take. *project NULL at first; burnish_project_destroy() */
    burnish_thumbnail thumbnail;      /* AUTO, NEVER or ONLY */
    const char *hidden_parts; /* names of burnish_contents.parts to leave out, between commas: *
                                 is any text in them, ? any byte, and #1 the first part. A name that
                                 no part has is a warning. NULL: none; no parts: not used */
    const char *only_parts;   /* the same of the parts to keep. NULL: all. If no part has one of the
                                 names, or nothing is left, loading fails with ARGUMENT. A negative
                                 volume is kept with the solids that it is subtracted from */
    double explode; /* [0, 1000]: each part is moved by this times the vector from the middle of all
                       to its own, both of bounding boxes. Parts with a common negative volume are
                       moved together, and parts in the middle stay. 0: none */
    uint64_t max_memory; /* bytes for loading and drawing, 0: no limit. By an estimate, for pictures
                            of up to 2048 x 2048 pixels, G-code that needs more is drawn in fewer
                            layers. Other formats ignore it: let the context's allocator fail */
    uint64_t max_input_bytes;    /* a larger file fails with LIMIT */
    uint64_t max_triangles;      /* more fail with LIMIT. BURNISH_TRIANGLES_MAX: as many as give 5
                                       vertices and triangles per byte of the input and its
                                       referenced files */
    uint64_t max_texture_pixels; /* of all textures together; others are skipped with a warning.
                                       BURNISH_TEXTURE_PIXELS_AUTO: 32 per byte of the input and its
                                       referenced files, at most 2^28. Less than 1 MiB counts as
                                       1 MiB in both limits */
    burnish_file_loader referenced_files; /* load NULL: files in the folder of the input; none
                                              for standard input and memory */
    const char *root; /* a folder that contains the input, by its path: the input may refer to all
                           files in it. Textures that are elsewhere are then also searched in the usual
                           folders next to the input's, such as ../textures. A folder that does not
                           contain the input fails with ARGUMENT. NULL: the input's folder */
    const char
        *folder; /* with referenced_files.load: the folder of the input in the loader's names,
                           such as "models/chair", from which ".." leads up. NULL: the loader
                           has no files above the input's folder */
    burnish_stream_decoder decoder; /* decode NULL: files that need it fail with FORMAT */
    const burnish_joint
        *joints; /* joint_count joints of a robot (URDF) that are not at 0. A name that
                                    no robot has fails with ARGUMENT; other formats ignore it */
    size_t joint_count;
} burnish_load_options;

/* BURNISH_CREASE_AUTO, BURNISH_NORMALS_AUTO, tessellation 16, no extra texture coordinates, no
 * facts, not strict, one thread per processor, 16 GiB, BURNISH_TRIANGLES_MAX triangles,
 * BURNISH_TEXTURE_PIXELS_AUTO, the default context and loader. */
BURNISH_API void burnish_load_options_init(burnish_load_options *options, uint64_t layout);
static inline burnish_load_options burnish_load_options_default(void) {
    burnish_load_options options;
    burnish_load_options_init(&options, BURNISH_LAYOUT(burnish_load_options));
    return options;
}

/* What is kept of a print project between loads of its plates. */
typedef struct burnish_project burnish_project;

/* Releases it; NULL is permitted. */
BURNISH_API void burnish_project_destroy(burnish_project *project);

/* A mesh. */
typedef struct burnish_mesh burnish_mesh;

/* Loads a mesh from a file.
 *   path     a file; "-": standard input; ":teapot", ":sphere", ":torus" or ":knot": a built-in
 *            object
 *   options  from burnish_load_options_default()
 *   mesh     receives the mesh, NULL on error; release it with burnish_mesh_destroy()
 *   error    receives the message; may be NULL
 * Errors: ARGUMENT, READ, FORMAT, LIMIT, MEMORY, CANCELLED. */
BURNISH_API burnish_status burnish_mesh_load(const char *path, const burnish_load_options *options,
                                             burnish_mesh **mesh, burnish_error *error);

/* Loads a mesh from an open file or pipe, from its current position to its end, in a process that
 * can not open files. Referenced files come only from options->referenced_files.
 *   descriptor  a POSIX file descriptor; stays open
 *   name        used in messages, and its extension for the format; NULL: "input"
 * Other parameters and errors as for burnish_mesh_load(). */
BURNISH_API burnish_status burnish_mesh_load_descriptor(int descriptor, const char *name,
                                                        const burnish_load_options *options,
                                                        burnish_mesh **mesh, burnish_error *error);

/* Loads a mesh from memory.
 *   bytes  the file; not used after the call
 *   size   in bytes
 *   name   used in messages, and its extension for the format; NULL: "memory"
 * Other parameters and errors as for burnish_mesh_load(). */
BURNISH_API burnish_status burnish_mesh_load_memory(const void *bytes, size_t size,
                                                    const char *name,
                                                    const burnish_load_options *options,
                                                    burnish_mesh **mesh, burnish_error *error);

/* An array of the caller: item i starts at (const char *)items + i * stride, at any alignment.
 * items NULL: no array. */
typedef struct burnish_array {
    const void *items;
    size_t count;  /* of items */
    size_t stride; /* bytes from item to item, at least the size of an item; 0: packed */
} burnish_array;

/* A texture. Coordinates: u to the right, v up, (0, 0) is the lower left corner. */
typedef struct burnish_texture {
    const char *name;      /* for messages; may be NULL */
    int width, height;     /* texels, [1, BURNISH_TEXTURE_SIZE_MAX] */
    const uint8_t *pixels; /* 4 per texel: red, green, blue, straight alpha; rows from the top */
    int is_color;          /* 1: sRGB; 0: numbers, c / 255 */
} burnish_texture;

#define BURNISH_TEXTURE_SIZE_MAX 16384
#define BURNISH_TEXTURES_MAX 65536

/* The arrays of a new mesh. Start from burnish_mesh_description_default(). */
typedef struct burnish_mesh_description {
    uint32_t cookie;                   /* set by burnish_mesh_description_default() */
    const char *name;                  /* for messages; NULL: "mesh" */
    burnish_array positions;           /* 3 floats per vertex, finite; [3, 2^32 - 2] of them */
    burnish_array normals;             /* 3 floats per vertex, of any length; 0, 0, 0 is
                                          generated */
    burnish_array colors;              /* 4 bytes per vertex: sRGB and alpha */
    burnish_array texture_coordinates; /* 2 floats per vertex, finite */
    burnish_array second_coordinates;  /* the same, for textures with coordinates 1 */
    burnish_array tangents;            /* 4 floats per vertex, finite: burnish_mesh_view */
    burnish_array indices; /* 3 vertex numbers per triangle, one after another; none: every three
                              vertices are a triangle */
    int index_size;        /* bytes per index: 4 (uint32_t), 2 (uint16_t) or 1 (uint8_t) */
    burnish_array triangle_materials;  /* 1 uint16_t per triangle; none: material 0 */
    const burnish_material *materials; /* material_count; NULL: burnish_material_default() */
    size_t material_count;             /* [0, 65536] */
    const burnish_texture *textures;   /* texture_count; copied */
    size_t texture_count;              /* [0, BURNISH_TEXTURES_MAX] */
    float up_axis[3];                  /* not 0, 0, 0 */
} burnish_mesh_description;

/* No arrays, index size 4, up +Y. */
BURNISH_API void burnish_mesh_description_init(burnish_mesh_description *description,
                                               uint64_t layout);
static inline burnish_mesh_description burnish_mesh_description_default(void) {
    burnish_mesh_description description;
    burnish_mesh_description_init(&description, BURNISH_LAYOUT(burnish_mesh_description));
    return description;
}

/* Creates a mesh from arrays, which are checked and copied.
 *   description  from burnish_mesh_description_default()
 *   options      from burnish_load_options_default(); those about files are ignored
 *   mesh         receives the mesh, NULL on error; release it with burnish_mesh_destroy()
 *   error        receives the message; may be NULL
 * Errors: ARGUMENT (an array is wrong), FORMAT (no triangle has an area), LIMIT, MEMORY,
 * CANCELLED. */
BURNISH_API burnish_status burnish_mesh_create(const burnish_mesh_description *description,
                                               const burnish_load_options *options,
                                               burnish_mesh **mesh, burnish_error *error);

/* Releases a mesh and all its arrays. NULL is allowed. */
BURNISH_API void burnish_mesh_destroy(burnish_mesh *mesh);

/* ---- Contents of a mesh ---- */

/* A plane that keeps the points p with normal . p <= offset. */
typedef struct burnish_clip_plane {
    double normal[3]; /* toward the part that is cut away; any length but 0 */
    double offset;    /* in units of the mesh if the normal has length 1 */
} burnish_clip_plane;

/* The most planes that cut a mesh. */
#define BURNISH_CUTS_MAX 6

/* Which side of the triangles faces the inside of a cut mesh. */
typedef enum burnish_inside {
    BURNISH_INSIDE_UNKNOWN, /* not cut, not measured, or not a solid */
    BURNISH_INSIDE_BACK,    /* the back: drawing fills the cut */
    BURNISH_INSIDE_FRONT    /* the front, since the mesh is inside out: drawing fills the cut */
} burnish_inside;

/* The Gaussian of a splat around its position. Its colour is of sRGB values, not of linear light,
 * and is blended as such: what training of splats does, and every viewer. */
typedef struct burnish_splat {
    float axes[3][3]; /* a standard deviation along each; in any direction */
    float color[3];   /* sRGB, about [0, 1] */
    float opacity;    /* in the middle, [0, 1] */
} burnish_splat;

/* The arrays of a mesh, only to be read. Valid until the mesh is destroyed or cut. */
typedef struct burnish_mesh_view {
    size_t vertex_count;         /* [1, 2^32 - 2] */
    size_t triangle_count;       /* [0, BURNISH_TRIANGLES_MAX]; 0: a point cloud */
    float point_radius;          /* > 0: a point cloud. Each vertex is drawn as a sphere of
                              this radius: a disc that faces the viewer, with the depth of the
                              sphere in each pixel. 0: triangles */
    const float *positions;      /* 3 per vertex, finite */
    const burnish_splat *splats; /* 1 per vertex of a point cloud, which is then drawn as splats
                              without light: behind one another by depth, each at pixel centres the
                              more opaque the nearer, as opacity e^-d with d half the squared distance
                              in standard deviations (burnish_exp_falloff5), widened by a variance of
                              0.3 pixel. `colors`, if any, replace their own. NULL: none */
    const float *normals;        /* 3 per vertex, unit length. Of a point cloud of either
                              direction, turned toward the viewer; or 0, 0, 0: the sphere's own */
    const uint8_t *colors;       /* 4 per vertex, sRGB and alpha; NULL: none */
    int has_transparent_colors;  /* 1: an alpha value is below 255 */
    const float *texture_coordinates; /* 2 per vertex; NULL: none */
    const float *second_coordinates;  /* the same; NULL unless a texture has coordinates 1 */
    const float *tangents;            /* 4 per vertex: a unit vector perpendicular to the normal, in
                              direction of u, and the sign s of the bitangent
                              s cross(normal, tangent), in direction of v. NULL unless a
                              material uses a normal texture */
    const uint32_t *indices;          /* 3 per triangle, counter-clockwise as seen from the front;
                              NULL: no triangles */
    const uint16_t *triangle_materials; /* 1 per triangle; NULL: all have material 0 */
    const uint16_t *triangle_parts; /* 1 per triangle: a number of burnish_contents.parts; NULL: all
                              are of part 0, or there are no parts */
    float bounds_min[3], bounds_max[3]; /* of the positions that triangles use; of the spheres of a
                              point cloud without outliers (burnish_mesh_get_bounds) */
    double origin[3]; /* add it to coordinates of the mesh, its cameras and its facts to get
                         coordinates of the file; see burnish_load_options.origin */
    float up_axis[3]; /* unit vector */
    uint64_t serial;  /* unique in this process, changed by each cut; never 0 */
    burnish_clip_plane cuts[BURNISH_CUTS_MAX]; /* cut_count planes of burnish_mesh_clip() */
    int cut_count;
    burnish_inside inside; /* before the first cut */
} burnish_mesh_view;

/* The arrays of a mesh; NULL for NULL. */
BURNISH_API const burnish_mesh_view *burnish_mesh_get_view(const burnish_mesh *mesh);

/* The bounding box of the content of the file: the bounds of the view or, for points and lines, the
 * bounds of all their positions without the spheres and prisms that represent them; after cuts, the
 * remaining part. Relative to the origin of the view. All 0 for NULL.
 *
 * Outliers of a point cloud count here, but not in the bounds of the view, which cameras frame: if
 * a cloud has 8 points or more, let T be the box of all points but the most extreme 1/1000, at
 * least one, at either end of each axis, widened on all sides by half its longest side. If this
 * bounding box is more than 4 times as long, along its diagonal, as the box of the points in T,
 * points outside T are outliers, and a warning counts them. */
BURNISH_API void burnish_mesh_get_bounds(const burnish_mesh *mesh, float low[3], float high[3]);

/* How a mesh was made. */
typedef struct burnish_mesh_info {
    burnish_format format;          /* not AUTO */
    size_t point_count, line_count; /* in a file without faces: drawn as spheres and prisms */
    size_t layer_count;             /* of G-code; its lines are the moves with filament */
    double read_seconds;            /* wall-clock time of opening and parsing, or copying arrays */
    double build_seconds;           /* wall-clock time of welding, normals, order */
    const char *unit;               /* of length, from the file or format: "micron",
                                       "millimeter", "centimeter", "inch", "foot", "meter";
                                       NULL: unknown */
    burnish_normals_source normals; /* FILE: those of the input, and generated ones where they are
                                       missing; OWN: all are generated */
    int is_thumbnail;               /* 1: a picture, no geometry; there are no facts */
    int normals_replaced;           /* 1: OWN, since AUTO rejected those of the input */
    int is_one_sided; /* 1: glTF, or a scene of it; four fifths of the area at least are faces with one side */
    double animation_seconds; /* length of the animation that the options name; else 0 */
    char imported[12];        /* extension of a model in an archive that options.decoder has read */
} burnish_mesh_info;

/* Information about a mesh, valid as long as the mesh; NULL for NULL. */
BURNISH_API const burnish_mesh_info *burnish_mesh_get_info(const burnish_mesh *mesh);

/* Properties of the triangles as read, before loading reorients triangles and removes those without
 * area. Corners at equal positions, bit for bit except for the sign of 0, are one vertex; is_closed
 * can join more (join_tolerance). A polygon counts as its triangles.
 *
 * Area, volume and centre are compensated sums in double precision in the order of the input, the
 * same for any number of threads. Coordinates are the floats of burnish_mesh_view. */
typedef struct burnish_mesh_facts {
    size_t triangle_count;
    size_t degenerate_count; /* triangles without area, which are removed */
    size_t duplicate_count;  /* triangles with the vertices of an earlier triangle, in any order */
    size_t vertex_count;     /* different positions */

    /* Edges of triangles. Triangles without area whose vertices differ count: they fill
     * T-junctions. */
    size_t edge_count;
    size_t open_edge_count;         /* edges of one triangle: borders of holes and sheets */
    size_t non_manifold_edge_count; /* edges of three or more triangles */
    size_t inconsistent_edge_count; /* edges of an even number of triangles that do not run in
                                       opposite directions in equal numbers */
    size_t shell_count;             /* parts that are not joined by an edge; a common vertex does
                                       not join them */
    size_t flipped_count;           /* the fewest triangles to flip for a consistent winding across
                                  edges of two triangles, without unorientable parts */
    size_t unorientable_count;      /* parts without a consistent winding, as a Moebius strip */
    int is_closed;                  /* 1: every edge has an even number of triangles */
    double join_tolerance; /* > 0: the surface is closed only if vertices of open edges within this
                              distance along each axis are joined; edges, shells and windings are
                              counted after that. 0: only equal vertices are joined */
    size_t exact_open_edge_count; /* if join_tolerance > 0: open edges before joining */
    int is_consistent;            /* 1: inconsistent_edge_count is 0 */

    double area;
    double volume; /* sum of a . (b x c) / 6 over all triangles a, b, c, from the middle of the
                      bounding box. Valid if is_closed and is_consistent are 1. Negative if the
                      mesh is inside out; cavities are subtracted */
    int is_solid;  /* 1: closed, consistent and not flat */
    double center_of_mass[3]; /* of the volume of a solid, else of the surface */
} burnish_mesh_facts;

/* The facts of a mesh, valid as long as the mesh. NULL without burnish_load_options.measure, for a
 * file of points or lines, and for NULL. */
BURNISH_API const burnish_mesh_facts *burnish_mesh_get_facts(const burnish_mesh *mesh);

/* The warnings of loading, such as a missing material library. The log of the context received each
 * of them. An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_warning_count(const burnish_mesh *mesh);
BURNISH_API const char *burnish_mesh_get_warning(const burnish_mesh *mesh, size_t index);

/* The materials of a mesh, at least one. An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_material_count(const burnish_mesh *mesh);
BURNISH_API const burnish_material *burnish_mesh_get_material(const burnish_mesh *mesh,
                                                              size_t index);

/* Changes a material. No other thread may read, draw or change the mesh during the call. Renderers
 * that drew the mesh before draw the new material, as a new renderer would.
 *   material  copied
 * Errors: ARGUMENT (an index or value out of range, a texture on a mesh without texture
 * coordinates, a normal texture on a mesh without tangents); the material is then unchanged. */
BURNISH_API burnish_status burnish_mesh_set_material(burnish_mesh *mesh, size_t index,
                                                     const burnish_material *material,
                                                     burnish_error *error);

/* The textures of a mesh. An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_texture_count(const burnish_mesh *mesh);
BURNISH_API const burnish_texture *burnish_mesh_get_texture(const burnish_mesh *mesh, size_t index);

/* ---- Parts ---- */

/* What a part is for. Only solids are drawn. */
typedef enum burnish_part_role {
    BURNISH_PART_SOLID,
    BURNISH_PART_NEGATIVE,  /* to be subtracted from the solids of its object */
    BURNISH_PART_MODIFIER,  /* changes settings of a slicer inside it */
    BURNISH_PART_BLOCKER,   /* keeps supports away */
    BURNISH_PART_ENFORCER,  /* demands supports */
    BURNISH_PART_SUPPORT,   /* a support, or another aid: an object that is no model */
    BURNISH_PART_UNPRINTED, /* placed, but not to be printed */
    BURNISH_PART_HIDDEN,    /* left out by burnish_load_options.hidden_parts or only_parts */
    BURNISH_PART_ROLE_COUNT
} burnish_part_role;

/* The name of a role, such as "support blocker"; NULL for a value outside the list. */
BURNISH_API const char *burnish_part_role_name(burnish_part_role role);

/* Bytes of a name in burnish_contents, with the 0 at its end; longer names are cut. */
#define BURNISH_NAME_SIZE 64

/* The most parts that are told apart; the last one stands for all further ones. */
#define BURNISH_PARTS_MAX 65535

/* A part of a mesh: of 3MF an object or one of its volumes, at one of its places; a node of glTF with
 * a mesh; of OBJ what has one name (o, or g if less than two are named by o); a solid of an STL file
 * with several; what an importer names. */
typedef struct burnish_part {
    char name[BURNISH_NAME_SIZE]; /* may be "" */
    uint32_t id;                  /* of the object in the file, or its number from 0 */
    uint32_t item; /* of the file, that placed it: negative volumes are subtracted from solids of
                      the same item. Of a scene: its item, from 0, if the item's file has no parts */
    burnish_part_role role;
    int plate;             /* its number; 0: none */
    int filament;          /* from 1; 0: none */
    size_t triangle_count; /* in the file */
    double transform[12];  /* 3 rows of 4: from the object to the file's coordinates */
} burnish_part;

/* A plate of a print project. */
typedef struct burnish_plate {
    char name[BURNISH_NAME_SIZE]; /* may be "" */
    int number;                   /* from 1 */
    double shift[3]; /* added to the file's coordinates, to draw several plates side by side */
} burnish_plate;

/* A filament of a print project. Filament i colours material i of the mesh. */
typedef struct burnish_filament {
    uint8_t srgb[4]; /* with alpha */
    double length;   /* that G-code uses, in millimetres; 0: unknown */
} burnish_filament;

/* What a file consists of. Empty for formats without parts. */
typedef struct burnish_contents {
    const burnish_part *parts;
    size_t part_count;
    const burnish_plate *plates;
    size_t plate_count;
    const burnish_filament *filaments;
    size_t filament_count;
} burnish_contents;

/* The contents of a mesh, valid as long as the mesh; NULL for NULL. */
BURNISH_API const burnish_contents *burnish_mesh_get_contents(const burnish_mesh *mesh);

/* The negative volumes of a mesh, which are no part of it: a mesh whose triangle_parts are numbers of
 * the first mesh's parts, in the same coordinates. Cuts of the first mesh do not change it. Pictures
 * have them subtracted; facts, bounds, edges, shadows and occlusion are those without them. NULL:
 * there are none. */
BURNISH_API const burnish_mesh *burnish_mesh_get_negatives(const burnish_mesh *mesh);

/* The splats of a mesh: itself, or a point cloud next to its triangles, in the same coordinates.
 * Pictures show both: a pixel's opaque triangle hides splats whose centres are not nearer, and splats
 * cover transparent triangles. Splats are not parts, have no edges, and cast no shadow. Cameras frame
 * both, bounds contain both, and cuts change both. NULL: there are none. */
BURNISH_API const burnish_mesh *burnish_mesh_get_splats(const burnish_mesh *mesh);

/* A box; low is above high if it is empty. */
typedef struct burnish_box {
    float low[3], high[3];
} burnish_box;

/* The bounds of each part's triangles in coordinates of the mesh.
 *   boxes  receives one per part */
BURNISH_API void burnish_mesh_bound_parts(const burnish_mesh *mesh, burnish_box *boxes);

/* ---- Cuts ---- */

/* Cuts away the part of a mesh beyond a plane. Triangles across the plane are split without gaps;
 * their normals, colours and texture coordinates are interpolated. The facts still describe the
 * whole mesh. Call it once per plane. No other thread may use the mesh during the
 * call.
 *
 * The cut of a solid is drawn filled and hatched (render.h). That needs
 * burnish_mesh_facts.is_solid, so load the mesh with measure 1.
 *   mesh   unchanged on error
 *   plane  finite
 * Errors: ARGUMENT (NULL, an invalid plane, nothing left, more than BURNISH_CUTS_MAX planes),
 * MEMORY, LIMIT. */
BURNISH_API burnish_status burnish_mesh_clip(burnish_mesh *mesh, const burnish_clip_plane *plane,
                                             burnish_error *error);

/* ---- Colours ---- */

/* Maps from [0, 1] to colours, piecewise linear in sRGB between published values. */
typedef enum burnish_color_map {
    BURNISH_COLOR_MAP_VIRIDIS,  /* matplotlib's (S. van der Walt, N. Smith; CC0), at each tenth */
    BURNISH_COLOR_MAP_COOLWARM, /* K. Moreland, "Diverging Color Maps for Scientific Visualization",
                                   2009, at each eighth */
    BURNISH_COLOR_MAP_GREY,     /* black to white */
    BURNISH_COLOR_MAP_COUNT
} burnish_color_map;

/* The sRGB colour of a value, which is clamped to [0, 1]; NaN counts as 0. */
BURNISH_API void burnish_color_map_get(burnish_color_map map, double value, uint8_t srgb[3]);

/* What a mesh is coloured by. */
typedef enum burnish_color_source {
    BURNISH_COLOR_BY_HEIGHT,   /* along the up axis, in coordinates of the file */
    BURNISH_COLOR_BY_NORMAL,   /* red, green and blue are (1 + x, y, z of the normal) / 2 */
    BURNISH_COLOR_BY_PROPERTY, /* burnish_load_options.scalar_property */
    BURNISH_COLOR_BY_PART,     /* burnish_part_color() of burnish_mesh_view.triangle_parts */
    BURNISH_COLOR_BY_FILAMENT  /* burnish_contents.filaments; grey elsewhere */
} burnish_color_source;

/* The colour of a part, or of a filament that has none: eight colours in turn that most of the
 * colour-blind can tell apart (M. Okabe, K. Ito, "Color Universal Design", 2008). */
BURNISH_API void burnish_part_color(size_t number, uint8_t srgb[3]);

/* Start from burnish_coloring_default(). */
typedef struct burnish_coloring {
    uint32_t cookie; /* set by burnish_coloring_default() */
    burnish_color_source source;
    burnish_color_map map;
    double up[3];    /* of any length; all 0: the up axis of the mesh */
    double range[2]; /* values with the first and the last colour; equal: the least and greatest
                        value, without outliers of a point cloud */
} burnish_coloring;

/* Height, viridis, the range of the mesh. */
BURNISH_API void burnish_coloring_init(burnish_coloring *coloring, uint64_t layout);
static inline burnish_coloring burnish_coloring_default(void) {
    burnish_coloring coloring;
    burnish_coloring_init(&coloring, BURNISH_LAYOUT(burnish_coloring));
    return coloring;
}

/* Colours a mesh by values of its vertices. Values are interpolated over triangles, then mapped: a
 * mesh gets a texture of the map, and all its materials and textures are replaced. Points and
 * normals become vertex colours, parts and filaments materials. No other thread may use the mesh during the call.
 *   coloring  from burnish_coloring_default()
 *   range     receives the range that is used; may be NULL
 * Errors: ARGUMENT (a mesh without the property, parts or filaments, a value out of range), MEMORY. */
BURNISH_API burnish_status burnish_mesh_color_by(burnish_mesh *mesh,
                                                 const burnish_coloring *coloring, double range[2],
                                                 burnish_error *error);

/* ---- Cameras ---- */

/* The range of view angles, in degrees. */
#define BURNISH_VIEW_ANGLE_MIN 0.001
#define BURNISH_VIEW_ANGLE_MAX 179.0

/* A camera in right-handed coordinates. */
typedef struct burnish_camera {
    double position[3];
    double focal_point[3]; /* the point in the middle of the image */
    double view_up[3];     /* projected, the up direction of the image; not parallel to the view */
    double view_angle;     /* vertical, degrees, [0.001, 179]; for perspective */
    double orthographic_height; /* 0: perspective; > 0: parallel projection, the height of the image
                                   in world units */
} burnish_camera;

/* A camera of the file. */
typedef struct burnish_named_camera {
    const char *name; /* may be "" */
    burnish_camera camera;
} burnish_named_camera;

/* The cameras of the file in its order. An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_camera_count(const burnish_mesh *mesh);
BURNISH_API const burnish_named_camera *burnish_mesh_get_camera(const burnish_mesh *mesh,
                                                                size_t index);

/* The names of the file's material variants (KHR_materials_variants). An index out of range gives
 * NULL. */
BURNISH_API size_t burnish_mesh_get_variant_count(const burnish_mesh *mesh);
BURNISH_API const char *burnish_mesh_get_variant(const burnish_mesh *mesh, size_t index);

/* The lights of the file in its order, at most BURNISH_LIGHT_MAX, in coordinates of the mesh. An
 * index out of range gives NULL. The color of a light in physical units is its strength at the
 * middle of the bounding box: lux for directional lights, candela / distance^2 for point lights,
 * with a distance of at least a quarter of the box's diagonal, and without regard to range and cone.
 * All lights are then scaled by one factor. With it, the brightest white surface there that faces a
 * light is 1: the largest sum over lights j of color_j max(0, L_i . L_j) for L_i toward a light i. */
BURNISH_API size_t burnish_mesh_get_light_count(const burnish_mesh *mesh);
BURNISH_API const burnish_light *burnish_mesh_get_light(const burnish_mesh *mesh, size_t index);

/* Options for burnish_camera_frame(). Start from burnish_framing_default(). */
typedef struct burnish_framing {
    uint32_t cookie;     /* set by burnish_framing_default() */
    double up[3];        /* up direction, of any length; all 0: the up axis of the mesh */
    double direction[3]; /* from the camera to the object; all 0: the three-quarter view */
    double azimuth;      /* degrees around up, positive to the right */
    double elevation;    /* degrees, positive upward */
    double view_angle;   /* degrees, [BURNISH_VIEW_ANGLE_MIN, BURNISH_VIEW_ANGLE_MAX] */
    double aspect;       /* width / height of the image, [1e-5, 1e5] */
    double margin;       /* free space on each side, as a share of the smaller side, [0, 0.45] */
    double inset[4];     /* left, right, bottom, top: more free space for annotations, as shares of
                            the smaller side, [0, 0.45]. In perspective, the middle of the image
                            must remain in the rest */
    int orthographic;    /* 1: parallel projection */
    double orthographic_height; /* > 0: a parallel projection with this height in world units;
                                   0: the height that fits */
} burnish_framing;

/* The up axis of the mesh, three-quarter view, view angle 30 degrees, aspect 1, margin 0.05, no
 * insets, perspective. */
BURNISH_API void burnish_framing_init(burnish_framing *framing, uint64_t layout);
static inline burnish_framing burnish_framing_default(void) {
    burnish_framing framing;
    burnish_framing_init(&framing, BURNISH_LAYOUT(burnish_framing));
    return framing;
}

/* Computes the camera that shows the whole mesh as large as possible. It fits the projected
 * vertices, not a bounding sphere.
 *   options  from burnish_framing_default()
 *   camera   receives the camera
 * Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_camera_frame(const burnish_mesh *mesh,
                                                const burnish_framing *options,
                                                burnish_camera *camera, burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
