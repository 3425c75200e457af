/* The state of the glTF 2.0 reader (Khronos, "glTF 2.0 Specification", 2.0.1).
 *
 * gltf.c has the container, the extensions and the order of the steps.
 *
 * The first failure is kept in gltf->status. After it functions return defaults, so a caller can
 * make several calls and check the status once. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_H
#define BURNISH_MESH_READ_GLTF_GLTF_H

#include "base/bytes.h"
#include "mesh/read/common/matrix.h"
#include "mesh/read/io/json.h"

/* The most items of one top-level array. */
#define BURNISH_GLTF_LIST_MAX ((size_t)1 << 22)

#define BURNISH_GLTF_NONE UINT32_MAX

/* The top-level arrays, X(name, key). */
#define BURNISH_GLTF_LISTS(X)                                                                      \
    X(ACCESSORS, "accessors")                                                                      \
    X(ANIMATIONS, "animations")                                                                    \
    X(BUFFERS, "buffers")                                                                          \
    X(CAMERAS, "cameras")                                                                          \
    X(IMAGES, "images")                                                                            \
    X(VIEWS, "bufferViews")                                                                        \
    X(MATERIALS, "materials")                                                                      \
    X(MESHES, "meshes")                                                                            \
    X(NODES, "nodes")                                                                              \
    X(SAMPLERS, "samplers")                                                                        \
    X(SCENES, "scenes")                                                                            \
    X(SKINS, "skins")                                                                              \
    X(TEXTURES, "textures")

typedef enum burnish_gltf_list {
#define BURNISH_GLTF_ENUM(name, key) BURNISH_GLTF_##name,
    BURNISH_GLTF_LISTS(BURNISH_GLTF_ENUM)
#undef BURNISH_GLTF_ENUM
        BURNISH_GLTF_LIST_COUNT
} burnish_gltf_list;

/* Some bytes of a file. */
typedef struct burnish_gltf_bytes {
    const uint8_t *bytes;
    size_t size;
} burnish_gltf_bytes;

/* A buffer, loaded when it is first asked for. */
typedef struct burnish_gltf_buffer {
    burnish_gltf_bytes bytes;
    int is_loaded;
    void *owned;                  /* decoded from a data URI; NULL: not */
    burnish_gltf_bytes companion; /* of a file next to the input */
} burnish_gltf_buffer;

/* The values of component_type: OpenGL's. */
typedef enum burnish_gltf_component {
    BURNISH_GLTF_BYTE = 5120,
    BURNISH_GLTF_UNSIGNED_BYTE = 5121,
    BURNISH_GLTF_SHORT = 5122,
    BURNISH_GLTF_UNSIGNED_SHORT = 5123,
    BURNISH_GLTF_UNSIGNED_INT = 5125,
    BURNISH_GLTF_FLOAT = 5126
} burnish_gltf_component;

/* An accessor whose bounds were checked: element i, of `width` components, is at bytes +
 * i * stride. */
typedef struct burnish_gltf_accessor {
    const uint8_t *bytes; /* NULL: not resolved yet */
    size_t count, stride;
    int component; /* burnish_gltf_component */
    int width;     /* components of an element: 1, 2, 3, 4 or 16 */
    int is_normalized;
    uint32_t value; /* its JSON value */
    void *owned;    /* with sparse values filled in; NULL: bytes are a buffer's */
} burnish_gltf_accessor;

/* A node of the scene. */
typedef struct burnish_gltf_node {
    double matrix[12];                 /* to the world: rows x, y, z of a 3 x 4 matrix */
    uint32_t parent;                   /* NONE: a root */
    uint32_t mesh;                     /* NONE: it draws nothing */
    uint32_t skin;                     /* NONE: the mesh follows the node */
    size_t first_weight, weight_count; /* of the animation, in gltf->weights */
    int is_drawn;                      /* of the scene, and visible */
} burnish_gltf_node;

/* The pose that an animation gives a node at a given time. */
typedef struct burnish_gltf_pose {
    int has_translation, has_rotation, has_scale;
    double translation[3], rotation[4], scale[3];
} burnish_gltf_pose;

/* Sets of four joints and weights that are read of a vertex. */
#define BURNISH_GLTF_SETS 2

/* Sets of texture coordinates that textures may choose from: TEXCOORD_0 to TEXCOORD_7. */
enum { BURNISH_GLTF_TEXCOORDS = 8 };

/* A primitive: numbers of accessors; NONE if absent. */
typedef struct burnish_gltf_primitive {
    uint32_t value; /* its JSON value */
    uint32_t position, normal, tangent, color, indices;
    uint32_t texcoords[2]; /* of the material's first and second set */
    uint32_t splats[4]; /* of KHR_gaussian_splatting: scale, without which there are none, rotation,
                              opacity, spherical harmonic */
    uint32_t joints[BURNISH_GLTF_SETS], weights[BURNISH_GLTF_SETS];
    uint32_t targets; /* the JSON array of morph targets, or NONE */
    uint32_t material;
    int mode;             /* OpenGL's: 0 points, 1 lines, 2 loop, 3 strip, 4 triangles, 5 strip,
                             6 fan */
    size_t corner_count;  /* indices, or vertices if there are no indices */
    size_t element_count; /* 0: it is not drawn */
} burnish_gltf_primitive;

/* A skin's joints: the matrices for vertices bound to each. */
typedef struct burnish_gltf_skin {
    double *matrices; /* 12 per joint; NULL: not made yet */
    size_t count;
} burnish_gltf_skin;

typedef struct burnish_gltf {
    burnish_reader *reader;
    burnish_memory *memory; /* the mesh data's */
    burnish_status status;
    burnish_json json;
    uint32_t *lists[BURNISH_GLTF_LIST_COUNT]; /* the JSON values of their items */
    size_t counts[BURNISH_GLTF_LIST_COUNT];
    burnish_gltf_bytes binary; /* the GLB's chunk */
    int is_glb;
    int is_lenient; /* 1: an error becomes a note, and the default is used */

    burnish_gltf_buffer *buffers; /* one per item of BUFFERS */
    void **decoded;               /* one per item of VIEWS: what was compressed; NULL: nothing */
    burnish_gltf_accessor *accessors; /* one per item of ACCESSORS */
    uint64_t bytes_left;              /* that files next to the input may have in total */
    burnish_gltf_bytes draco;         /* what the decoder has unpacked */
    burnish_gltf_node *nodes;         /* one per item of NODES */
    uint32_t *node_order;             /* parents before children */
    burnish_gltf_pose *poses;         /* one per node; NULL: all are at rest */
    burnish_gltf_skin *skins;         /* one per item of SKINS */
    double *weights;                  /* of morph targets, from an animation */
    size_t weight_count, weight_capacity;
    uint64_t work;                      /* values that morph targets have added up */
    burnish_gltf_primitive *primitives; /* of all meshes, mesh after mesh */
    size_t primitive_count, primitive_capacity;
    int has_plain;             /* 1: a primitive has no material */
    uint64_t variant;          /* number of the chosen variant; UINT64_MAX: none */
    uint32_t *mesh_primitives; /* of each mesh the first of them; one more for the end */

    int *image_textures; /* BURNISH_GLTF_IMAGE_KINDS per item of IMAGES: 1 + number of the texture,
                            0: can't be loaded, -1: not requested yet */
    int damaged_images;  /* damaged images in the file itself */
    struct burnish_gltf_ahead *ahead;
    unsigned texture_sets[2]; /* of the current material */
    int has_colors;           /* 1: a primitive has colours of vertices */
    burnish_warning_group odd_values, undrawn, rests, other_sets;
} burnish_gltf;

/* ---- gltf_buffers.c ---- */

/* The bytes of a buffer view, and the stride that it states, 0 for none. Returns 0 on failure. */
int burnish_gltf_view(burnish_gltf *gltf, uint32_t view, burnish_gltf_bytes *bytes, size_t *stride);

/* Counts bytes that the file unpacks to. Fails and returns 0 if they are too many.
 *   what  what they are, for messages */
int burnish_gltf_fill(burnish_gltf *gltf, uint32_t value, uint64_t bytes, const char *what);

/* Resolves a URI: the bytes of a data URI go to *data, otherwise *name is the name of a file, to be
 * released by the caller, or "" if no file can have this name. Returns 0 on failure. */
int burnish_gltf_open_uri(burnish_gltf *gltf, uint32_t uri, burnish_gltf_buffer *data, char **name);
void burnish_gltf_release_buffer(burnish_gltf *gltf, burnish_gltf_buffer *buffer);

/* ---- gltf_values.c ---- */

/* Fails with "NAME:LINE: PATH: ..."; value NONE: without a location. The first failure is kept. If
 * the file is read leniently, anything but a limit becomes a note, and the status is unchanged.
 * Returns 0. */
__attribute__((format(printf, 4, 5))) int burnish_gltf_fail(burnish_gltf *gltf,
                                                            burnish_status status, uint32_t value,
                                                            const char *format, ...);

/* Notes what was ignored, in the same form. */
__attribute__((format(printf, 4, 5))) void burnish_gltf_note(burnish_gltf *gltf,
                                                             burnish_warning_group *group,
                                                             uint32_t value, const char *format,
                                                             ...);

/* Adopts a failure of the memory. Returns 1 if nothing has failed. */
int burnish_gltf_is_fine(burnish_gltf *gltf);

/* The member of an object; NONE if it is missing. A member of another kind fails. */
uint32_t burnish_gltf_object(burnish_gltf *gltf, uint32_t object, const char *key);
uint32_t burnish_gltf_array(burnish_gltf *gltf, uint32_t object, const char *key);

/* object.extensions.NAME */
uint32_t burnish_gltf_extension(burnish_gltf *gltf, uint32_t object, const char *name);

/* A whole number of [0, most]. */
uint64_t burnish_gltf_whole(burnish_gltf *gltf, uint32_t object, const char *key,
                            uint64_t otherwise, uint64_t most);
double burnish_gltf_number(burnish_gltf *gltf, uint32_t object, const char *key, double otherwise);

/* `count` numbers, unchanged if the member is missing. Returns whether it is present. */
int burnish_gltf_numbers(burnish_gltf *gltf, uint32_t object, const char *key, int count,
                         double *numbers);
int burnish_gltf_flag(burnish_gltf *gltf, uint32_t object, const char *key, int otherwise);

/* The number of an item of a list; NONE if the member is missing, or on failure. */
uint32_t burnish_gltf_reference(burnish_gltf *gltf, uint32_t object, const char *key,
                                burnish_gltf_list list);

/* The same of a value that must be one. */
uint32_t burnish_gltf_item(burnish_gltf *gltf, uint32_t value, burnish_gltf_list list);

/* The JSON values of an array's items, `count` of them; NULL for none, and on failure. */
uint32_t *burnish_gltf_items(burnish_gltf *gltf, uint32_t array, size_t *count);

/* ---- gltf_accessors.c ---- */

/* An accessor with its bounds checked and its sparse values in place. NULL on failure. user what
 * requests it, for messages widths bits 1 << width: permitted widths */
const burnish_gltf_accessor *burnish_gltf_resolve(burnish_gltf *gltf, uint32_t accessor,
                                                  uint32_t user, unsigned widths);

/* Sets the bytes, count, component and width of an accessor that has no values yet; fails if they
 * do not match its description. Scalars may have another component. */
void burnish_gltf_give(burnish_gltf *gltf, uint32_t number, uint32_t user,
                       const burnish_gltf_accessor *values);

/* Bytes of a burnish_gltf_component; 0 if it is invalid. */
size_t burnish_gltf_component_size(int component);

/* The components of element i; normalised components are in [-1, 1] or [0, 1]. */
void burnish_gltf_element(const burnish_gltf_accessor *accessor, size_t i, double *components);

/* A component of element i of an accessor of integers, not normalised. */
static inline uint32_t burnish_gltf_integer(const burnish_gltf_accessor *accessor, size_t i,
                                            int component) {
    const uint8_t *p = accessor->bytes + i * accessor->stride;
    switch (accessor->component) {
    case BURNISH_GLTF_UNSIGNED_BYTE:
        return p[component];
    case BURNISH_GLTF_UNSIGNED_SHORT:
        return burnish_load16(p + (size_t)2 * (size_t)component);
    case BURNISH_GLTF_UNSIGNED_INT:
        return burnish_load32(p + (size_t)4 * (size_t)component);
    default:
        return UINT32_MAX;
    }
}

/* ---- gltf_nodes.c ---- */

void burnish_gltf_compose(const double translation[3], const double rotation[4],
                          const double scale[3], double matrix[12]);

/* A file's matrix, column after column of four, as rows of a 3 x 4 one. */
void burnish_gltf_transpose(const double columns[16], double matrix[12]);

/* The part that a node with a mesh is. */
burnish_part burnish_gltf_part_of(burnish_gltf *gltf, uint32_t node);

/* Fills gltf->nodes: the matrices, and what is drawn. */
void burnish_gltf_place_nodes(burnish_gltf *gltf);

/* ---- gltf_animation.c ---- */

/* Fills gltf->poses and gltf->weights, if the options name a time or an animation. */
void burnish_gltf_animate(burnish_gltf *gltf);

/* ---- gltf_deform.c ---- */

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

/* ---- gltf_primitives.c ---- */

/* The elements of a primitive. */
typedef enum burnish_gltf_kind {
    BURNISH_GLTF_POINTS,
    BURNISH_GLTF_LINES,
    BURNISH_GLTF_TRIANGLES
} burnish_gltf_kind;

/* Fills gltf->primitives, with the accessors that they name resolved. */
void burnish_gltf_read_primitives(burnish_gltf *gltf);

burnish_gltf_kind burnish_gltf_kind_of(const burnish_gltf_primitive *primitive);

/* Morph targets of a mesh: all its primitives have as many. */
size_t burnish_gltf_target_count(burnish_gltf *gltf, uint32_t mesh);

/* ---- gltf_draco.c ---- */

/* The first bytes of a decoder's answer. */
#define BURNISH_DRACO_MAGIC                                                                        \
    "\x89"                                                                                         \
    "BDA\r\n\x1a\n"

/* Gives the accessors of compressed primitives their values; the second function releases them. */
void burnish_gltf_decode_draco(burnish_gltf *gltf);
void burnish_gltf_release_draco(burnish_gltf *gltf);

/* The extension of a primitive that must be unpacked; NONE: it is not compressed. */
uint32_t burnish_gltf_draco(burnish_gltf *gltf, uint32_t primitive);

/* ---- gltf_geometry.c ---- */

/* Fills the mesh's streams from the nodes that are drawn. */
void burnish_gltf_read_geometry(burnish_gltf *gltf);

/* ---- gltf_materials.c ---- */

/* Fills the mesh's materials: one per item of MATERIALS, and one more if there are primitives
 * without a material. */
void burnish_gltf_read_materials(burnish_gltf *gltf);

/* ---- gltf_textures.c ---- */

/* The two sets of texture coordinates of a material's vertices. The first is the normal texture's,
 * as tangents belong to it; without one, the set that most textures use, or the base colour's in a
 * tie. The second is the one that most other textures use; BURNISH_GLTF_TEXCOORDS: there is none. */
void burnish_gltf_texture_sets(const burnish_gltf *gltf, uint32_t material, unsigned sets[2]);

/* What an image holds: numbers, colours (sRGB), or a number in its alpha. */
typedef enum burnish_gltf_image_kind {
    BURNISH_GLTF_NUMBERS,
    BURNISH_GLTF_COLORS,
    BURNISH_GLTF_ALPHA,
    BURNISH_GLTF_IMAGE_KINDS
} burnish_gltf_image_kind;

/* How a material uses the texture that `object` names under a key; all 0 if it names no texture, or
 * the texture can't be loaded.
 *   strength  the member that scales it; NULL: not scaled */
burnish_texture_use burnish_gltf_read_texture(burnish_gltf *gltf, uint32_t object, const char *key,
                                              burnish_gltf_image_kind kind, const char *strength);

/* The name of an image in messages. */
typedef struct burnish_gltf_name {
    char text[120];
} burnish_gltf_name;
burnish_gltf_name burnish_gltf_image_name(const burnish_gltf *gltf, uint32_t image);

/* Decodes the pictures of the materials ahead; the second function releases those not used. This
 * affects only the time. */
void burnish_gltf_decode_ahead(burnish_gltf *gltf);
void burnish_gltf_drop_ahead(burnish_gltf *gltf);

/* ---- gltf_scene.c ---- */

/* Fills the mesh's cameras, from the nodes that have one. */
void burnish_gltf_read_cameras(burnish_gltf *gltf);

/* Fills the mesh's lights, from the nodes that have one (KHR_lights_punctual). */
void burnish_gltf_read_lights(burnish_gltf *gltf);

#endif
