/* The state of the glTF 2.0 reader (Khronos, "glTF 2.0 Specification", 2.0.1).
 *
 * gltf.c has the container, the extensions and the order of the steps.
 *
 * The first failure is kept in gltf->status. After it functions return defaults, so a caller can
 * make several calls and check the status once. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_H
#define BURNISH_MESH_READ_GLTF_GLTF_H

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

/* Sets of texture coordinates that a material may choose from: TEXCOORD_0 to TEXCOORD_3. */
enum { BURNISH_GLTF_TEXCOORDS = 4 };

/* A primitive: numbers of accessors; NONE if absent. */
typedef struct burnish_gltf_primitive {
    uint32_t value; /* its JSON value */
    uint32_t position, normal, tangent, color, texcoord, indices;
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
    uint32_t *mesh_primitives; /* of each mesh the first of them; one more for the end */

    int *image_textures; /* two per item of IMAGES, as numbers and as colours: 1 + number of the
                            texture, 0: can't be loaded, -1: not requested yet */
    int damaged_images;  /* damaged images in the file itself */
    struct burnish_gltf_ahead *ahead;
    unsigned texture_set; /* the set of texture coordinates of the current material */
    int has_colors;       /* 1: a primitive has colours of vertices */
    burnish_warning_group odd_values, undrawn, rests, other_sets;
} burnish_gltf;

#endif
