/* burnish/mesh.h: a mesh from a file, from memory or built in, ready to be drawn.
 *
 * A mesh is one list of indexed triangles with unit normals, optional vertex colours and texture
 * coordinates, a table of materials, and the textures that these use. Loading welds equal
 * positions, generates missing normals, and turns every triangle so that its winding agrees with
 * its normals.
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
 * What it does not do: hierarchies, which are flattened; animation but for one moment of it.
 *
 * Every reader is safe for untrusted input: memory stays in proportion to the bytes given, all
 * counts are checked, and a malformed file gives one line that names the location. A mesh depends
 * on its input and options only, not on threads, instruction sets or the caller's floating-point
 * environment.
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

/* The formats of files, X(name, word, extensions, x, y, z of the up axis): the one list
 * of them; burnish_format_info says what the columns are. */
#define BURNISH_FORMAT_LIST(X)                                                                     \
    X(GLTF, gltf, ".gltf .glb", 0, 1, 0)                                                           \
    X(OBJ, obj, ".obj", 0, 1, 0)                                                                   \
    X(OFF, off, ".off", 0, 1, 0)                                                                   \
    X(PLY, ply, ".ply", 0, 1, 0)                                                                   \
    X(STL, stl, ".stl", 0, 0, 1)                                                                   \
    X(3MF, 3mf, ".3mf", 0, 0, 1)                                                                   \
    X(BMS, bms, ".bms", 0, 1, 0)

/* Where meshes come from; the formats of files come last. */
typedef enum burnish_format {
    BURNISH_FORMAT_AUTO,    /* in load options: told by the name's ending and the first bytes */
    BURNISH_FORMAT_BUILTIN, /* a built-in object */
    BURNISH_FORMAT_ARRAYS,  /* the caller's arrays */
#define BURNISH_FORMAT_ENUM(name, word, extensions, x, y, z) BURNISH_FORMAT_##name,
    BURNISH_FORMAT_LIST(BURNISH_FORMAT_ENUM)
#undef BURNISH_FORMAT_ENUM
        BURNISH_FORMAT_COUNT
} burnish_format;

/* What is known of a format. */
typedef struct burnish_format_info {
    const char *name; /* "stl": one word for flags and reports */
    const char
        *extensions;  /* of file names, lower case, separated by blanks: ".stl"; "" for none */
    float up_axis[3]; /* unit vector: the direction in which its objects stand */
    int is_file;      /* 1: bytes can be in it, and load options may name it */
} burnish_format_info;

/* The formats of the library that is linked: those below the count. */
BURNISH_API int burnish_format_count(void);

/* NULL for a value outside the list. */
BURNISH_API const burnish_format_info *burnish_format_get_info(burnish_format format);

/* ---- Loading ---- */

/* burnish's grey: what a mesh without materials gets. */
BURNISH_API burnish_material burnish_material_default(void);

/* No angle: each edge is judged by what is around it, in the same way for every format. Edges are
 * smooth up to 20 degrees and sharp from 60 on. Between these an edge is smooth where both faces
 * bend at all their edges, as in scans and what simplification leaves of them, and up to 40 degrees
 * as a step of a curve: the flat faces on both sides are about as wide, and beyond them the surface
 * goes on bending in the same sense. So a cylinder of 12 sides is round, and chamfers, octagons and
 * pockets keep their edges. A flat face with four times the area of the others at a vertex gives
 * its normal to those that share it, so that a fillet does not bend a plane. */
#define BURNISH_CREASE_AUTO (-1.0)

/* No moment of an animation. */
#define BURNISH_AT_REST (-1.0)

/* As many texels as suit the size of the input. */
#define BURNISH_TEXTURE_PIXELS_AUTO UINT64_MAX

/* A mesh never has more triangles: its corners are numbered in 32 bits. (2^32 - 2) / 3 */
#define BURNISH_TRIANGLES_MAX 1431655764u

/* Who loads a file that another one names, such as an OBJ's material library.
 *   load     hands over the whole file as *size bytes at *bytes, which stay until release, or
 *            returns a status with its line in *error. name is what the input says: relative to
 *            the input and not to be trusted. A file of more than max_bytes bytes is refused with
 *            LIMIT. A failure is a warning, not an error: the mesh is loaded without the file.
 *   release  called once per successful load; may be NULL */
typedef struct burnish_file_loader {
    burnish_status (*load)(void *user_data, const char *name, uint64_t max_bytes,
                           const void **bytes, size_t *size, burnish_error *error);
    void (*release)(void *user_data, const void *bytes, size_t size);
    void *user_data;
} burnish_file_loader;

/* Unpacks what files hold in forms that burnish does not decode itself.
 *   decode   called once for a file, with all of its streams of a form; `decoded` must stay until
 *            `release` is called for it. What it holds is checked as a file is. Errors end loading
 *   form     "draco": primitives of glTF's KHR_draco_mesh_compression. docs/importers.md has the
 *            layout of `bytes` and `decoded`
 *   release  may be NULL */
typedef struct burnish_stream_decoder {
    burnish_status (*decode)(void *user_data, const char *form, const void *bytes, size_t size,
                             const uint8_t **decoded, size_t *decoded_size, burnish_error *error);
    void (*release)(void *user_data, const uint8_t *decoded, size_t decoded_size);
    void *user_data;
} burnish_stream_decoder;

/* How to load. Start from burnish_load_options_default(). */
typedef struct burnish_load_options {
    uint32_t cookie;                /* set by burnish_load_options_default() */
    const burnish_context *context; /* outlives the mesh; NULL: the default */
    burnish_format format;          /* AUTO, or a file's format where no name tells it */
    double crease_angle; /* degrees, [0, 180]: generated normals are smooth across all edges whose
                            faces differ by less, weighted by the faces' angles at the vertex; 0
                            shades every face flat; BURNISH_CREASE_AUTO */
    int tessellation;    /* built-in objects: segments along a patch edge, [1, 256] */
    int keep_texture_coordinates; /* 1: vertices carry them, and differ where they do; 0: only
                                     where a material uses a texture */
    int ignore_textures;          /* 1: none is loaded, and materials use none */
    int measure;                  /* 1: the mesh has facts, see burnish_mesh_get_facts; 0: none */
    double point_size; /* diameter of points and lines where a file has no faces, in its units; 0:
                          by their density */
    const double *origin; /* 3 numbers, [-1e30, 1e30]: subtracted from the file's coordinates before
                             they are rounded to floats; 0, 0, 0 leaves them as they are, and that
                             of another mesh puts both into one space. NULL: 0, 0, 0, but near the
                             middle where that is over 32 times as far away as the mesh is large,
                             and the file's coordinates are more than floats */
    int ignore_referenced_files; /* 1: files that the input names are not read, and there is no word of it */
    int strict; /* 1: what would be a warning is an error, FORMAT; 0: what is wrong and does no harm
                   is passed over or mended */
    int threads; /* [0, 1024]: at most so many; 0: one per processor. The mesh does not depend on
                    it. */
    double animation_time; /* seconds, >= 0: the scene is that of this moment of an animation, of a
                              file that has one; BURNISH_AT_REST: as it stands in the file */
    const char *animation; /* its name, or its number from 0; NULL: the first. Without a time, that
                              of its start */
    uint64_t max_input_bytes;    /* a larger file is refused with LIMIT */
    uint64_t max_triangles;      /* more are refused with LIMIT. BURNISH_TRIANGLES_MAX, which is
                                       the largest: as many as vertices and triangles together are 5
                                       for each byte of the input and its companions */
    uint64_t max_texture_pixels; /* of all textures together: those beyond are left out, with a
                                       warning; BURNISH_TEXTURE_PIXELS_AUTO: 32 for each byte of the
                                       input and its companions, at most 2^28. An input of less than
                                       1 MiB counts as 1 MiB in both */
    burnish_file_loader
        referenced_files;           /* files that the input names; load NULL: those of the input's
                                       folder, none for standard input and memory */
    burnish_stream_decoder decoder; /* decode NULL: files that need it are refused, FORMAT */
} burnish_load_options;

/* Crease auto, tessellation 16, no texture coordinates, no facts, not strict, one thread per
 * processor, 16 GiB, BURNISH_TRIANGLES_MAX triangles, texels auto, the default context and loader.
 */
BURNISH_API void burnish_load_options_init(burnish_load_options *options, uint64_t layout);
static inline burnish_load_options burnish_load_options_default(void) {
    burnish_load_options options;
    burnish_load_options_init(&options, BURNISH_LAYOUT(burnish_load_options));
    return options;
}

typedef struct burnish_mesh burnish_mesh;

/* Loads a file, standard input ("-"), or a built-in object (":teapot", ":sphere", ":torus",
 * ":knot"). *mesh is NULL on error.
 * Errors: ARGUMENT, READ, FORMAT, LIMIT, MEMORY, CANCELLED. */
BURNISH_API burnish_status burnish_mesh_load(const char *path, const burnish_load_options *options,
                                             burnish_mesh **mesh, burnish_error *error);

/* The same from an open file or pipe, from where it stands to its end: where a process may open no
 * file. Other files that the input names come from options->referenced_files alone.
 *   descriptor  of POSIX; stays open
 *   name        stands in messages and tells the format by its ending; NULL: "input" */
BURNISH_API burnish_status burnish_mesh_load_descriptor(int descriptor, const char *name,
                                                        const burnish_load_options *options,
                                                        burnish_mesh **mesh, burnish_error *error);

/* The same from bytes in memory, which may go afterwards.
 *   bytes  size of them
 *   name   stands in messages and tells the format by its ending; NULL: "memory" */
BURNISH_API burnish_status burnish_mesh_load_memory(const void *bytes, size_t size,
                                                    const char *name,
                                                    const burnish_load_options *options,
                                                    burnish_mesh **mesh, burnish_error *error);

/* Values of the caller's: item i starts at (const char *)items + i * stride, at any alignment.
 * items NULL: the array is not there. */
typedef struct burnish_array {
    const void *items;
    size_t count;  /* of items */
    size_t stride; /* bytes from item to item, at least an item's size; 0: packed */
} burnish_array;

/* An image that materials use. Texture coordinates: u to the right, v up, (0, 0) the lower left
 * corner. */
typedef struct burnish_texture {
    const char *name;      /* for messages; NULL: none */
    int width, height;     /* texels, [1, BURNISH_TEXTURE_SIZE_MAX] */
    const uint8_t *pixels; /* 4 per texel: red, green, blue, straight alpha; rows from the top */
    int is_color;          /* 1: sRGB; 0: numbers, c / 255 */
} burnish_texture;

#define BURNISH_TEXTURE_SIZE_MAX 16384
#define BURNISH_TEXTURES_MAX 65536

/* Arrays of the caller's that make a mesh. Start from burnish_mesh_description_default(). */
typedef struct burnish_mesh_description {
    uint32_t cookie;                   /* set by burnish_mesh_description_default() */
    const char *name;                  /* stands in messages; NULL: "mesh" */
    burnish_array positions;           /* 3 floats per vertex, finite; [3, 2^32 - 2] of them */
    burnish_array normals;             /* 3 floats per vertex, of any length; 0, 0, 0: to be
                                          generated */
    burnish_array colors;              /* 4 bytes per vertex: sRGB and alpha */
    burnish_array texture_coordinates; /* 2 floats per vertex, finite */
    burnish_array tangents;            /* 4 floats per vertex, finite: burnish_mesh_view */
    burnish_array indices; /* 3 numbers of vertices per triangle, one after another; not there:
                              every three vertices are a triangle */
    int index_size;        /* bytes per index: 4 (uint32_t), 2 (uint16_t) or 1 (uint8_t) */
    burnish_array triangle_materials;  /* 1 uint16_t per triangle; not there: material 0 */
    const burnish_material *materials; /* material_count of them; NULL: burnish's grey */
    size_t material_count;             /* [0, 65536] */
    const burnish_texture *textures;   /* texture_count of them, which are copied */
    size_t texture_count;              /* [0, BURNISH_TEXTURES_MAX] */
    float up_axis[3];                  /* the direction in which the object stands, not 0 */
} burnish_mesh_description;

/* No arrays, index size 4, up +Y. */
BURNISH_API void burnish_mesh_description_init(burnish_mesh_description *description,
                                               uint64_t layout);
static inline burnish_mesh_description burnish_mesh_description_default(void) {
    burnish_mesh_description description;
    burnish_mesh_description_init(&description, BURNISH_LAYOUT(burnish_mesh_description));
    return description;
}

/* A mesh from the caller's arrays, which are copied, checked as a file is, and may go afterwards.
 * Of the options, those about files and built-in objects have no meaning.
 * Errors: ARGUMENT (an array is wrong), FORMAT (no triangle has any area), LIMIT, MEMORY,
 * CANCELLED. */
BURNISH_API burnish_status burnish_mesh_create(const burnish_mesh_description *description,
                                               const burnish_load_options *options,
                                               burnish_mesh **mesh, burnish_error *error);

/* Releases everything that belongs to the mesh; NULL is allowed. */
BURNISH_API void burnish_mesh_destroy(burnish_mesh *mesh);

/* ---- What a mesh holds ---- */

/* What is on the near side of a plane stays: the points p with normal . p <= offset. */
typedef struct burnish_clip_plane {
    double normal[3]; /* toward what is cut away; any length but 0 */
    double offset;    /* in the mesh's units where the normal's length is 1 */
} burnish_clip_plane;

/* Planes that a mesh may be cut by. */
#define BURNISH_CUTS_MAX 6

/* Where the inside of a cut mesh shows its triangles. */
typedef enum burnish_inside {
    BURNISH_INSIDE_UNKNOWN, /* not cut, not measured, or not a solid */
    BURNISH_INSIDE_BACK,    /* from their back: drawing fills the cut */
    BURNISH_INSIDE_FRONT    /* from their front, since the mesh is inside out: it fills it too */
} burnish_inside;

/* The arrays of a mesh, to be read; they live as long as the mesh. */
typedef struct burnish_mesh_view {
    size_t vertex_count;              /* [3, 2^32 - 2] */
    size_t triangle_count;            /* [1, BURNISH_TRIANGLES_MAX] */
    const float *positions;           /* 3 per vertex, finite */
    const float *normals;             /* 3 per vertex, unit length */
    const uint8_t *colors;            /* 4 per vertex, sRGB and alpha; NULL: none */
    int has_transparent_colors;       /* 1: an alpha is below 255 */
    const float *texture_coordinates; /* 2 per vertex; NULL: none, or not needed */
    const float *tangents; /* 4 per vertex: a unit vector at right angles to the normal, along which
                              u grows, and the sign s of the bitangent s cross(normal, tangent),
                              along which v grows. NULL where no material uses a normal texture */
    const uint32_t *indices; /* 3 per triangle, counter-clockwise seen from its normals */
    const uint16_t *triangle_materials; /* 1 per triangle; NULL: every triangle has material 0 */
    float bounds_min[3], bounds_max[3]; /* of the positions that triangles use */
    double origin[3]; /* of all coordinates of the mesh, its cameras and its facts: with it added
                         they are the file's. 0, 0, 0 but as load options say */
    float up_axis[3]; /* the direction in which the object stands, unit length */
    uint64_t serial;  /* of this process' meshes no other one has it, nor this one before a cut;
                         never 0 */
    burnish_clip_plane cuts[BURNISH_CUTS_MAX]; /* cut_count of them: burnish_mesh_clip's */
    int cut_count;
    burnish_inside inside; /* of the mesh before its first cut */
} burnish_mesh_view;

/* NULL for NULL. */
BURNISH_API const burnish_mesh_view *burnish_mesh_get_view(const burnish_mesh *mesh);

/* The box of what the file states: the view's bounds, or, if the file has points or lines instead
 * of faces, the box of their positions without the solids that stand for them. After cuts, what is
 * left of it. Like the view's, coordinates are relative to its origin. NULL gives zeros. */
BURNISH_API void burnish_mesh_get_bounds(const burnish_mesh *mesh, float low[3], float high[3]);

/* How a mesh came to be. */
typedef struct burnish_mesh_info {
    burnish_format format;          /* what was read; not AUTO */
    size_t point_count, line_count; /* of a file without faces: each is a small solid of the mesh */
    double read_seconds;            /* wall time of opening and parsing, or of copying arrays */
    double build_seconds;           /* wall time of welding, normals, order */
    const char *unit;               /* of lengths, as the file says or its format has it: "micron",
                                       "millimeter", "centimeter", "inch", "foot", "meter"; NULL:
                                       nobody says */
} burnish_mesh_info;

/* NULL for NULL. Lives as long as the mesh. */
BURNISH_API const burnish_mesh_info *burnish_mesh_get_info(const burnish_mesh *mesh);

/* What is true of the triangles as they were read: before loading turned those whose winding
 * contradicts their normals and left out those without area. Corners at equal positions, bit for
 * bit but for the sign of 0, are one vertex; is_closed may need more (join_tolerance). Polygons
 * count as the triangles they were cut into.
 *
 * Area, volume and centre come from compensated sums in double precision, in the order of the
 * input: they depend on no thread. Coordinates are the floats of burnish_mesh_view. */
typedef struct burnish_mesh_facts {
    size_t triangle_count;
    size_t degenerate_count; /* of these without area: no mesh or picture has them */
    size_t duplicate_count;  /* of these with the three vertices of an earlier one, in any order */
    size_t vertex_count;     /* different positions of corners */

    /* An edge joins two vertices of a triangle, also of one without area whose vertices differ:
     * such fill T-junctions. */
    size_t edge_count;
    size_t open_edge_count;         /* of one triangle: the border of a hole or of a sheet */
    size_t non_manifold_edge_count; /* of three triangles or more */
    size_t inconsistent_edge_count; /* of an even number of triangles, not half of which run along
                                       it in one direction, half in the other */
    size_t shell_count;             /* parts that no edge joins; those that touch in a vertex are
                                       two */
    size_t flipped_count;      /* the fewest triangles whose turning lets windings agree across all
                                  edges of two triangles, but for those next */
    size_t unorientable_count; /* parts, joined by edges of two triangles, where no turning does: a
                                  Moebius strip */
    int is_closed;         /* 1: an even number of triangles at every edge: there is an inside */
    double join_tolerance; /* > 0: the surface is closed only with vertices of open edges joined
                              that lie within this distance along each axis; all that is said of
                              edges, shells and windings is true of that surface. 0: vertices are
                              joined only if they are equal */
    size_t exact_open_edge_count; /* where join_tolerance is > 0: open edges without joining */
    int is_consistent;            /* 1: no edge is inconsistent */

    double area;
    double volume; /* sum of a . (b x c) / 6 over all triangles a, b, c, measured from the middle of
                      the bounding box. Means something where is_closed and is_consistent are 1;
                      inside out it is negative; cavities that are wound inward are subtracted */
    int is_solid;  /* 1: closed, consistent and not flat: the centre is that of the volume */
    double center_of_mass[3]; /* else that of the surface, every area weighing the same */
} burnish_mesh_facts;

/* NULL if load options did not ask for them, if the file has points or lines instead of faces, and
 * for NULL. They live as long as the mesh. */
BURNISH_API const burnish_mesh_facts *burnish_mesh_get_facts(const burnish_mesh *mesh);

/* Lines about what was passed over (a missing material library, triangles without area ...). The
 * context's log was told each of them. */
BURNISH_API size_t burnish_mesh_get_warning_count(const burnish_mesh *mesh);
BURNISH_API const char *burnish_mesh_get_warning(const burnish_mesh *mesh, size_t index);

/* At least one material exists. An index out of range gives NULL, or ARGUMENT.
 * burnish_mesh_set_material changes the mesh: no other thread may draw, read or change it
 * meanwhile. A renderer that drew the mesh before then draws it with the new material, as a new one
 * would. Errors: ARGUMENT, also for a texture on a mesh without texture coordinates, and for a
 * normal texture on one without tangents; the material is then as it was. */
BURNISH_API size_t burnish_mesh_get_material_count(const burnish_mesh *mesh);
BURNISH_API const burnish_material *burnish_mesh_get_material(const burnish_mesh *mesh,
                                                              size_t index);
BURNISH_API burnish_status burnish_mesh_set_material(burnish_mesh *mesh, size_t index,
                                                     const burnish_material *material,
                                                     burnish_error *error);

/* The textures that materials may use. An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_texture_count(const burnish_mesh *mesh);
BURNISH_API const burnish_texture *burnish_mesh_get_texture(const burnish_mesh *mesh, size_t index);

/* ---- Cuts ---- */

/* Cuts away what is beyond a plane. Triangles across it are cut where their edges meet it, at the
 * same points on both sides of an edge; their normals, colours and texture coordinates are
 * interpolated. Facts stay those of the whole mesh. May be called again for further planes; one
 * that nothing is beyond changes nothing.
 *
 * A solid (burnish_mesh_facts.is_solid, so the mesh must have been loaded with measure 1) is drawn
 * filled: where its inside would show, the plane does, hatched (burnish/render.h).
 *   mesh   as it was on error
 *   plane  a finite one
 * Errors: ARGUMENT (NULL, no plane, nothing is left, more than BURNISH_CUTS_MAX planes), MEMORY,
 * LIMIT. */
BURNISH_API burnish_status burnish_mesh_clip(burnish_mesh *mesh, const burnish_clip_plane *plane,
                                             burnish_error *error);

/* ---- Cameras ---- */

/* What a view angle may be, in degrees: framing and drawing refuse others. */
#define BURNISH_VIEW_ANGLE_MIN 0.001
#define BURNISH_VIEW_ANGLE_MAX 179.0

/* Where the picture is taken from. Right-handed world; the picture's up is view_up's projection. */
typedef struct burnish_camera {
    double position[3];
    double focal_point[3]; /* what the middle of the picture shows */
    double view_up[3];     /* not parallel to the direction of view */
    double view_angle;     /* degrees from the lower to the upper edge, [0.001, 179]; without
                              meaning in a parallel projection */
    double
        orthographic_height; /* 0: perspective; > 0: parallel projection, height in world units */
} burnish_camera;

/* A camera that the file has, where its nodes put it. */
typedef struct burnish_named_camera {
    const char *name; /* "" where it has none */
    burnish_camera camera;
} burnish_named_camera;

/* The cameras of the file, in its order. An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_camera_count(const burnish_mesh *mesh);
BURNISH_API const burnish_named_camera *burnish_mesh_get_camera(const burnish_mesh *mesh,
                                                                size_t index);

/* A light that the file has, in coordinates of the mesh, where its nodes put it. As point lights do
 * not fall off here, a file's light of physical units counts with what arrives at the middle of the
 * bounding box: candela / distance^2 for point lights, lux for directional ones. All of them are
 * then scaled by one factor, so that a white surface there that faces one of them is 1 at most, and
 * one is: sum over lights j of color_j max(0, L_i . L_j) for L_i toward each light i. */
typedef struct burnish_file_light {
    burnish_light light;
    int is_spot; /* 1: in the file it shines in a cone; light is a point light */
} burnish_file_light;

/* The lights of the file, the first BURNISH_LIGHT_MAX in its order.
 * An index out of range gives NULL. */
BURNISH_API size_t burnish_mesh_get_light_count(const burnish_mesh *mesh);
BURNISH_API const burnish_file_light *burnish_mesh_get_light(const burnish_mesh *mesh,
                                                             size_t index);

/* How burnish_camera_frame chooses a view. Start from burnish_framing_default(). */
typedef struct burnish_framing {
    uint32_t cookie;     /* set by burnish_framing_default() */
    double up[3];        /* the direction that shall point up, any length; all 0: the mesh's */
    double direction[3]; /* from the camera to the object; all 0: the three-quarter view */
    double azimuth;      /* degrees, turns the camera around up, positive to the right */
    double elevation;    /* degrees, lifts the camera, positive upward */
    double view_angle;   /* degrees, [BURNISH_VIEW_ANGLE_MIN, BURNISH_VIEW_ANGLE_MAX] */
    double aspect;       /* width / height of the picture, [1e-5, 1e5] */
    double margin;       /* share of the smaller side left free on each side, [0, 0.45] */
    double inset[4];     /* left, right, bottom, top: shares of the smaller side left free besides
                            the margin, for what is drawn around the object, [0, 0.45]; in
                            perspective the picture's middle stays free of them */
    int orthographic;    /* 1: parallel projection */
    double orthographic_height; /* > 0: the picture's height in world units, instead of the one
                                   that fits, and a parallel projection; 0: what fits */
} burnish_framing;

/* The mesh's up axis, three-quarter view, view angle 30 degrees, aspect 1, margin 0.05, no insets,
 * perspective. */
BURNISH_API void burnish_framing_init(burnish_framing *framing, uint64_t layout);
static inline burnish_framing burnish_framing_default(void) {
    burnish_framing framing;
    burnish_framing_init(&framing, BURNISH_LAYOUT(burnish_framing));
    return framing;
}

/* The camera that shows the whole mesh as large as the margin allows, exactly: it fits the
 * projected vertices, not a bounding sphere. Errors: ARGUMENT, MEMORY. */
BURNISH_API burnish_status burnish_camera_frame(const burnish_mesh *mesh,
                                                const burnish_framing *options,
                                                burnish_camera *camera, burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
