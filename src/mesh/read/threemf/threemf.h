/* 3MF (3MF Consortium, "3D Manufacturing Format: Core Specification" 1.3, "Materials and Properties
 * Extension" 1.2, "Production Extension" 1.1): the state of its reader.
 *
 *   zip.h           the archive, whose parts are unpacked piece by piece
 *   threemf_xml     a part's XML, by expat: elements with their parents, and messages
 *   threemf_model   a model part: its elements become the arrays below
 *   threemf_values  colours, coordinates and textures that properties of triangles mean
 *   threemf_paint   triangles that slicers have painted
 *   threemf_beams   beam lattices, which become triangles
 *   threemf_project what slicers add: volumes, plates, filaments
 *   threemf_plates  where several plates are drawn
 *   threemf_heights  ... and filaments that change with the height
 *   threemf_count   objects placed by the build: counted
 *   threemf_scene   ... and written to the mesh
 *   threemf_thumbnail  the package's own picture, if there is nothing else
 *   threemf         entry point: finds the parts, and calls the steps in order
 *
 * Nothing recurses, and there are no pointers between items: they refer to each other by number, or
 * by the ids of the file until all parts have been read. */
#ifndef BURNISH_MESH_READ_THREEMF_THREEMF_H
#define BURNISH_MESH_READ_THREEMF_THREEMF_H

#include "mesh/read/common/parts.h"
#include "mesh/read/io/reader.h"
#include "mesh/read/io/zip.h"

#define BURNISH_THREEMF_NONE UINT32_MAX
#define BURNISH_THREEMF_NESTING 64 /* objects in objects */
#define BURNISH_THREEMF_PLATES 256 /* slicers permit 36 */

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
    char name[84];  /* for messages */
    int is_skipped; /* 1: the wanted plate does not need it */
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

/* Of a slicer: a volume of an object. */
typedef struct burnish_threemf_volume {
    char name[BURNISH_NAME_SIZE];
    burnish_part_role role;
    int has_type;         /* 1: role is stated by the key that goes first */
    uint32_t id;          /* of the object that is its mesh, for a component */
    uint32_t first, last; /* triangles of the object; last NONE: not stated */
    uint32_t filament;    /* from 1; 0: that of the object */
} burnish_threemf_volume;

/* Of a slicer: an object of the first part. */
typedef struct burnish_threemf_settings {
    char name[BURNISH_NAME_SIZE];
    uint32_t id, filament;
    uint32_t first_volume, volume_count;
    int has_ranges; /* 1: volumes are ranges of triangles, sorted; 0: components */
} burnish_threemf_settings;

/* Of a slicer: the plate of an item of the build. */
typedef struct burnish_threemf_instance {
    uint32_t object, number; /* the object's id; which of its items, from 0 */
    uint32_t plate;          /* index */
} burnish_threemf_instance;

/* Of a slicer: where filament `to` is used in place of filament `from`; 0: of any. */
typedef struct burnish_threemf_height {
    uint32_t object, plate; /* one of these, from 1, or both 0 for all; an object by its order */
    double low, high;       /* above the object's lowest point, or above the plate */
    uint32_t from, to;
} burnish_threemf_height;

/* Of a triangle of the mesh, if there are heights. */
typedef struct burnish_threemf_owner {
    uint32_t item;
    int is_fixed; /* 1: its colour is no filament of a part */
} burnish_threemf_owner;

typedef struct burnish_threemf_triangle {
    uint32_t corners[3]; /* from the object's first vertex */
    uint32_t source;     /* which of the object's triangles in the file it is, or a piece of */
    uint32_t paint;      /* filament it is painted with; 0: that of its part */
    uint32_t group;      /* the group's id, 0 for none; resolved: its number or NONE */
    uint32_t properties[3];
} burnish_threemf_triangle;

/* The vertex in the middle of a split edge. */
typedef struct burnish_threemf_middle {
    uint32_t ends[2], vertex; /* from the object's first vertex; vertex 0: an empty slot */
} burnish_threemf_middle;

/* A beam between two vertices of a lattice, or a ball around one, which is both ends. */
typedef struct burnish_threemf_rod {
    uint32_t ends[2]; /* from the object's first vertex */
    float radii[2];
    int is_round[2]; /* 0: a flat end */
    uint32_t group, properties[2];
} burnish_threemf_rod;

/* What a lattice states for all its rods and balls. */
typedef struct burnish_threemf_lattice {
    burnish_threemf_rod usual;
    float ball_radius, least; /* rods shorter than that are left out */
    int balls;                /* 0: none; 1: those that are listed; 2: at all ends */
} burnish_threemf_lattice;

/* An object placed in the build, or in another object. */
typedef struct burnish_threemf_placement {
    double matrix[12]; /* 3 rows of 4 */
    uint32_t part, id, line;
    uint32_t object; /* resolved: its number or NONE */
    uint32_t plate;  /* of an item: index or NONE */
    int is_unprinted;
} burnish_threemf_placement;

typedef struct burnish_threemf_object {
    uint32_t part, line;
    uint32_t first_vertex, vertex_count;
    uint32_t first_triangle, triangle_count;
    uint32_t first_component, component_count;
    uint32_t group, property; /* for triangles without properties; group 0: none */
    uint32_t settings;        /* 1 + number; 0: none */
    uint32_t items;           /* of the build, so far */
    uint32_t order;           /* of the project's objects, from 1; 0: not numbered */
    char name[BURNISH_NAME_SIZE];
    int is_model;     /* 0: a support, or an aid for other programs */
    int is_component; /* 1: another object holds it */
    int has_slices;
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
    const burnish_zip_part *thumbnail; /* NULL: no relationship names one */
    int is_empty;                      /* 1: nothing is built */
    int needs_all_parts;               /* 1: no part may be skipped */
    int shares_paths;                  /* 1: a project owns those of textures */

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
    BURNISH_THREEMF_LIST(burnish_threemf_rod) rods; /* of the current object */
    burnish_threemf_lattice lattice;                /* the same */
    BURNISH_THREEMF_LIST(burnish_threemf_settings) settings;
    BURNISH_THREEMF_LIST(burnish_threemf_volume) volumes;
    BURNISH_THREEMF_LIST(burnish_threemf_instance) instances; /* sorted, once all are there */
    BURNISH_THREEMF_LIST(burnish_plate) plates;
    BURNISH_THREEMF_LIST(burnish_filament) filaments;
    BURNISH_THREEMF_LIST(burnish_threemf_height) heights;
    BURNISH_THREEMF_LIST(burnish_threemf_owner) owners; /* of the mesh's triangles */
    double layer_height;                                /* of all layers but the first */
    burnish_threemf_middle *middles; /* of the current object, hashed by their ends */
    size_t middle_count, middle_room;
    double plate_boxes[BURNISH_THREEMF_PLATES][2][2]; /* low and high of what is drawn */
    uint32_t paint_most;                              /* filament that something is painted with */
    float bed[2][2]; /* area of the first plate: low, high; empty: unknown */
    int has_beds;    /* 1: items are on beds of PrusaSlicer, which no file lists */

    uint32_t plain_material, colored_material; /* 1 + number; 0: not used yet */
    size_t invisible_colors;                   /* in use, with alpha 0 */
    int uses_colors, uses_coordinates;

    char not_drawn[360]; /* names of parts that are not drawn */
    size_t not_drawn_count;
    int has_more; /* 1: than these names */
    burnish_warning_group missing, bad_paint, bad_properties, mixed, slices;
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

/* "#RRGGBB" or "#RRGGBBAA", which is white for anything else. */
void burnish_threemf_read_color(const char *text, uint8_t color[4]);

/* The value of a hexadecimal digit; -1 for another character. */
int burnish_threemf_digit(char c);

/* ---- threemf_paint.c ---- */

/* Appends a triangle to an object that is being read. Returns 0 on failure. */
int burnish_threemf_add_triangle(burnish_threemf *threemf, burnish_threemf_object *object,
                                 const burnish_threemf_triangle *triangle);

/* Whether a code of painting is complete, and not too deep. */
int burnish_threemf_is_paint(const char *code);

/* Appends the pieces of a painted triangle, whose code is complete. Returns 0 on failure. */
int burnish_threemf_paint(burnish_threemf *threemf, burnish_threemf_object *object,
                          const burnish_threemf_triangle *triangle, const char *code);

/* After an object's last triangle: splits its triangles where their neighbours are split. Returns 0
 * on failure. */
int burnish_threemf_join_paint(burnish_threemf *threemf, burnish_threemf_object *object);

/* ---- threemf_beams.c ---- */

struct burnish_threemf_xml;

/* Begins the lattice of an object, and adds a beam or ball to it. */
void burnish_threemf_begin_lattice(struct burnish_threemf_xml *xml, burnish_threemf_object *object,
                                   const char *const *attributes);
void burnish_threemf_add_rod(struct burnish_threemf_xml *xml, const burnish_threemf_object *object,
                             const char *const *attributes, int is_ball);

/* Appends the triangles of the lattice to its object. Returns 0 on failure. */
int burnish_threemf_put_lattice(burnish_threemf *threemf, burnish_threemf_object *object);

/* ---- threemf_project.c ---- */

/* Reads the files of slicers. */
void burnish_threemf_read_project(burnish_threemf *threemf);

/* Gives the objects their settings, once all parts have been read. */
void burnish_threemf_place_project(burnish_threemf *threemf);

/* The filament of a part that states this one: the first for a number that does not exist; 0
 * without filaments. */
uint32_t burnish_threemf_filament(const burnish_threemf *threemf, uint32_t number);

/* The plate of an item, by the id of its object and its number among these; NONE: not stated. */
uint32_t burnish_threemf_plate_of(const burnish_threemf *threemf, uint32_t object, uint32_t number);

/* The number of the filament of a colour, which becomes one behind the first `least`. */
uint32_t burnish_threemf_add_filament(burnish_threemf *threemf, uint32_t least, const char *color);

/* ---- threemf_heights.c ---- */

/* Reads a file of heights; text ends with a 0 at `size`. */
void burnish_threemf_read_heights(burnish_threemf *threemf, const char *text, size_t size);

/* Numbers the objects in the order of the build. */
void burnish_threemf_number_objects(burnish_threemf *threemf);

/* Splits the mesh's triangles. Returns 0 on failure. */
int burnish_threemf_split_heights(burnish_threemf *threemf);

/* ---- threemf_thumbnail.c ---- */

/* Makes a sheet with the package's picture instead of a model. why: for the warning, "it is ..."
 * Errors: FORMAT (there is none), LIMIT, MEMORY. */
burnish_status burnish_threemf_draw_thumbnail(burnish_threemf *threemf, const char *why);

/* ---- threemf_plates.c ---- */

/* Gives each item of the build its plate, and leaves out those of other plates than the caller's.
 * Returns 0 on failure. */
int burnish_threemf_choose_plates(burnish_threemf *threemf);

/* Moves plates close together, from the boxes of what is drawn on them. */
void burnish_threemf_place_plates(burnish_threemf *threemf);

/* ---- threemf_values.c ---- */

/* Mixes composites, and chooses what is drawn of multiple properties. Returns 0 on failure. */
int burnish_threemf_mix(burnish_threemf *threemf);

/* Gives the mesh a material for each filament, before any other. Returns 0 on failure. */
int burnish_threemf_use_filaments(burnish_threemf *threemf);

/* Resolves the group and properties of an object's triangles, and gives the mesh the materials and
 * textures that they use. Returns 0 on failure. */
int burnish_threemf_use_values(burnish_threemf *threemf, const burnish_threemf_object *object);

/* After all triangles: decides whether their plain material is the look's grey, and warns of
 * colours with alpha 0. */
void burnish_threemf_settle_values(burnish_threemf *threemf);

/* The material of a triangle whose group is resolved. */
uint16_t burnish_threemf_material_of(const burnish_threemf *threemf,
                                     const burnish_threemf_triangle *triangle);

/* ---- threemf_count.c ---- */

/* Counts what the build places, with the parts that are not drawn. Returns 0 on failure. */
int burnish_threemf_count(burnish_threemf *threemf);

/* ---- threemf_scene.c ---- */

/* Writes the objects that are built to the mesh. Returns 0 on failure. */
int burnish_threemf_write_scene(burnish_threemf *threemf);

#endif
