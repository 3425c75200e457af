/* 3MF (3MF Consortium, "3D Manufacturing Format: Core Specification" 1.3, "Materials and Properties
 * Extension" 1.2, "Production Extension" 1.1): the state of its reader.
 *
 *   zip.h           the archive, whose parts are unpacked piece by piece
 *   threemf_xml     a part's XML, by expat: elements with their parents, and messages
 *   threemf_model   a model part: its elements become the arrays below
 *   threemf_values  colours, coordinates and textures that properties of triangles mean
 *   threemf_scene   objects placed by the build: counted, then written to the mesh
 *   threemf         entry point: finds the parts, and calls the steps in order
 *
 * Nothing recurses, and there are no pointers between items: they refer to each other by number, or
 * by the ids of the file until all parts have been read. */
#ifndef BURNISH_MESH_READ_THREEMF_THREEMF_H
#define BURNISH_MESH_READ_THREEMF_THREEMF_H

#include "mesh/read/io/reader.h"
#include "mesh/read/io/zip.h"

#define BURNISH_THREEMF_NONE UINT32_MAX

/* An array that grows: BURNISH_THREEMF_LIST(burnish_threemf_object) objects; */
#define BURNISH_THREEMF_LIST(type)                                                                 \
    struct {                                                                                       \
        type *items;                                                                               \
        size_t count, capacity;                                                                    \
    }

/* Appends a cleared item: a pointer to it, or NULL if memory is out. */
#define BURNISH_THREEMF_APPEND(threemf, list)                                                      \
    ((list)->items = burnish_reserve((threemf)->memory, (list)->items, &(list)->capacity,          \
                                     (list)->count + 1, sizeof *(list)->items, "3MF"),             \
     (threemf)->memory->status == BURNISH_STATUS_OK                                                \
         ? memset(&(list)->items[(list)->count++], 0, sizeof *(list)->items)                       \
         : NULL)

/* ---- What files hold ---- */

/* A part of the archive that holds a model. */
typedef struct burnish_threemf_part {
    const burnish_zip_part *part;
    char name[84]; /* for messages */
} burnish_threemf_part;

/* As mesh data has them. */
typedef struct burnish_threemf_position {
    float xyz[3];
} burnish_threemf_position;
typedef struct burnish_threemf_coordinate {
    float uv[2];
} burnish_threemf_coordinate;
typedef struct burnish_threemf_color {
    uint8_t rgba[4];
} burnish_threemf_color;

/* The resource of an id. Ids are unique within a part. */
typedef struct burnish_threemf_resource {
    uint32_t part, id;
    enum { BURNISH_THREEMF_OBJECT, BURNISH_THREEMF_GROUP, BURNISH_THREEMF_TEXTURE } kind;
    uint32_t index, line;
} burnish_threemf_resource;

/* A group of properties that triangles name by pid and p1, p2, p3. */
typedef enum burnish_threemf_kind {
    BURNISH_THREEMF_BASES,       /* a material each; values are colours */
    BURNISH_THREEMF_COLORS,      /* a colour of corners each */
    BURNISH_THREEMF_COORDINATES, /* texture coordinates of corners */
    BURNISH_THREEMF_COMPOSITES,  /* mixtures of bases; colours, once they are mixed */
    BURNISH_THREEMF_MULTIPLES    /* one of each of several groups */
} burnish_threemf_kind;

typedef struct burnish_threemf_group {
    burnish_threemf_kind kind;
    uint32_t part;
    uint32_t first, count; /* of colors, coordinates or ranges */
    uint32_t target;       /* COORDINATES: id of the texture; COMPOSITES: of the bases;
                              MULTIPLES, resolved: the group that is drawn */
    uint32_t first_number, number_count; /* COMPOSITES: matindices; MULTIPLES: pids */
    uint32_t layer;                      /* MULTIPLES, resolved: which of the pids that is */
    uint32_t material;                   /* 1 + the first of the mesh; 0: not used yet */
    int is_noted;                        /* 1: a warning says that it is drawn in a simpler way */
} burnish_threemf_group;

/* Numbers of one composite or multi. */
typedef struct burnish_threemf_range {
    uint32_t first, count;
} burnish_threemf_range;

typedef struct burnish_threemf_texture {
    uint32_t part;
    char *path; /* of the archive; owned */
    int wrap[2], is_nearest;
    int number; /* 1 + the mesh's texture; 0: not loaded; -1: not tried yet */
} burnish_threemf_texture;

typedef struct burnish_threemf_triangle {
    uint32_t corners[3]; /* from the object's first vertex */
    uint32_t group;      /* the group's id, 0 for none; resolved: its number or NONE */
    uint32_t properties[3];
} burnish_threemf_triangle;

/* An object placed in the build, or in another object. */
typedef struct burnish_threemf_placement {
    double matrix[12]; /* 3 rows of 4 */
    uint32_t part, id, line;
    uint32_t object; /* resolved: its number or NONE */
} burnish_threemf_placement;

typedef struct burnish_threemf_object {
    uint32_t part, line;
    uint32_t first_vertex, vertex_count;
    uint32_t first_triangle, triangle_count;
    uint32_t first_component, component_count;
    uint32_t group, property; /* for triangles without properties; group 0: none */
    int is_model;             /* 0: a support, or an aid for other programs */
    int is_component;         /* 1: another object holds it */
    int has_beams, has_slices;
    int state;                    /* while all are counted: 0, 1 on the way down, 2 done */
    uint64_t triangles, vertices; /* including its components */
    uint64_t visits;              /* objects visited on the way to these */
} burnish_threemf_object;

/* One reading of one file. */
typedef struct burnish_threemf {
    burnish_reader *reader;
    burnish_memory *memory;
    burnish_status status; /* of the first failure */
    burnish_zip zip;

    BURNISH_THREEMF_LIST(burnish_threemf_part) parts;
    BURNISH_THREEMF_LIST(burnish_threemf_resource) resources; /* sorted, once all are there */
    BURNISH_THREEMF_LIST(burnish_threemf_object) objects;
    BURNISH_THREEMF_LIST(burnish_threemf_placement) components;
    BURNISH_THREEMF_LIST(burnish_threemf_placement) items; /* of the build */
    BURNISH_THREEMF_LIST(burnish_threemf_position) vertices;
    BURNISH_THREEMF_LIST(burnish_threemf_triangle) triangles;
    BURNISH_THREEMF_LIST(burnish_threemf_group) groups;
    BURNISH_THREEMF_LIST(burnish_threemf_color) colors; /* the first is white */
    BURNISH_THREEMF_LIST(burnish_threemf_coordinate) coordinates;
    BURNISH_THREEMF_LIST(burnish_threemf_range) ranges;
    BURNISH_THREEMF_LIST(double) numbers;
    BURNISH_THREEMF_LIST(burnish_threemf_texture) textures;

    uint32_t plain_material, colored_material; /* 1 + number; 0: not used yet */
    size_t invisible_colors;                   /* in use, with alpha 0 */
    int uses_colors, uses_coordinates;

    burnish_warning_group missing, not_drawn, bad_properties, mixed, slices;
} burnish_threemf;

/* The number of the part of a name, which is listed if it is new; NONE after a note if the archive
 * lacks it. */
uint32_t burnish_threemf_add_part(burnish_threemf *threemf, const char *name);

/* A copy of a part's name as archives have it: no slash in front, no "." and "..". NULL on failure.
 */
char *burnish_threemf_copy_name(burnish_threemf *threemf, const char *name);

/* The resource of an id of a part; NULL: not found. For use after all parts have been read. */
const burnish_threemf_resource *burnish_threemf_find(const burnish_threemf *threemf, uint32_t part,
                                                     uint32_t id, int kind);

/* "PART:LINE" of something that was read. */
typedef struct burnish_threemf_place {
    char text[120];
} burnish_threemf_place;
burnish_threemf_place burnish_threemf_show(const burnish_threemf *threemf, uint32_t part,
                                           uint32_t line);

/* ---- threemf_model.c ---- */

/* Reads the model of part `number`. Returns 0 on failure. */
int burnish_threemf_read_model(burnish_threemf *threemf, uint32_t number);

/* ---- threemf_values.c ---- */

/* Mixes composites, and chooses what is drawn of multiple properties. Returns 0 on failure. */
int burnish_threemf_mix(burnish_threemf *threemf);

/* Resolves the group and properties of an object's triangles, and gives the mesh the materials and
 * textures that they use. Returns 0 on failure. */
int burnish_threemf_use_values(burnish_threemf *threemf, const burnish_threemf_object *object);

/* After all triangles: decides whether their plain material is the look's grey, and warns of
 * colours with alpha 0. */
void burnish_threemf_settle_values(burnish_threemf *threemf);

/* The material of a triangle whose group is resolved. */
uint16_t burnish_threemf_material_of(const burnish_threemf *threemf,
                                     const burnish_threemf_triangle *triangle);

/* ---- threemf_scene.c ---- */

/* Writes the objects that are built to the mesh. Returns 0 on failure. */
int burnish_threemf_write_scene(burnish_threemf *threemf);

#endif
