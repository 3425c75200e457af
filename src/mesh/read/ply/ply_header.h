/* The header of a PLY file. */
#ifndef BURNISH_MESH_READ_PLY_PLY_HEADER_H
#define BURNISH_MESH_READ_PLY_PLY_HEADER_H

#include "mesh/read/io/reader.h"

typedef enum burnish_ply_encoding {
    BURNISH_PLY_ASCII,
    BURNISH_PLY_LITTLE_ENDIAN,
    BURNISH_PLY_BIG_ENDIAN
} burnish_ply_encoding;

typedef enum burnish_ply_type {
    BURNISH_PLY_NONE, /* as count_type: not a list */
    BURNISH_PLY_INT8,
    BURNISH_PLY_UINT8,
    BURNISH_PLY_INT16,
    BURNISH_PLY_UINT16,
    BURNISH_PLY_INT32,
    BURNISH_PLY_UINT32,
    BURNISH_PLY_INT64, /* not of the specification */
    BURNISH_PLY_UINT64,
    BURNISH_PLY_FLOAT32,
    BURNISH_PLY_FLOAT64
} burnish_ply_type;

/* Bytes of one value in a binary body. */
static inline size_t burnish_ply_type_size(burnish_ply_type type) {
    static const uint8_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[type];
}

/* The role of a property. Roles before ROLE_COUNT are columns of a vertex's row. */
typedef enum burnish_ply_role {
    BURNISH_PLY_X,
    BURNISH_PLY_Y,
    BURNISH_PLY_Z,
    BURNISH_PLY_NX,
    BURNISH_PLY_NY,
    BURNISH_PLY_NZ,
    BURNISH_PLY_RED,
    BURNISH_PLY_GREEN,
    BURNISH_PLY_BLUE,
    BURNISH_PLY_ALPHA,
    BURNISH_PLY_S,
    BURNISH_PLY_T,
    BURNISH_PLY_SCALE, /* 3, of splats; then the rest of them as burnish_splat has it */
    BURNISH_PLY_ROTATION = BURNISH_PLY_SCALE + 3,
    BURNISH_PLY_HARMONIC = BURNISH_PLY_ROTATION + 4,
    BURNISH_PLY_OPACITY = BURNISH_PLY_HARMONIC + 3,
    BURNISH_PLY_PACKED, /* of text: red, green and blue in the low bits of one number, or of a float */
    BURNISH_PLY_ROLE_COUNT,
    BURNISH_PLY_CORNERS,   /* vertex_indices of a face or of triangle strips */
    BURNISH_PLY_TEXCOORDS, /* texcoord of a face: u and v of each corner */
    BURNISH_PLY_TEXNUMBER, /* which of the header's textures it shows, from 0 */
    BURNISH_PLY_OTHER      /* ignored */
} burnish_ply_role;

typedef struct burnish_ply_property {
    burnish_ply_type type;       /* of the value, or of a list's items */
    burnish_ply_type count_type; /* NONE: a scalar */
    burnish_ply_role role;
    burnish_token name;
} burnish_ply_property;

typedef enum burnish_ply_kind {
    BURNISH_PLY_ELEMENT_OTHER,
    BURNISH_PLY_ELEMENT_VERTEX,
    BURNISH_PLY_ELEMENT_FACE,
    BURNISH_PLY_ELEMENT_STRIPS
} burnish_ply_kind;

typedef struct burnish_ply_element {
    burnish_token name;
    burnish_ply_kind kind;
    uint64_t count;
    size_t first_property, property_count; /* in the header's list */
    const uint8_t *at;                     /* its line in the header, for messages */
} burnish_ply_element;

/* What the role S of points without colours becomes, if it is not the option's property. */
typedef enum burnish_ply_tint {
    BURNISH_PLY_NO_TINT,
    BURNISH_PLY_GREY,   /* from nearly the least value to nearly the highest */
    BURNISH_PLY_CLASSES /* colours of the classes of LAS, 0 to 31 */
} burnish_ply_tint;

typedef struct burnish_ply_header {
    burnish_ply_encoding encoding;
    burnish_ply_element *elements;
    size_t element_count, element_capacity;
    burnish_ply_property *properties;
    size_t property_count, property_capacity;
    const uint8_t *body;     /* first byte after the line end of end_header */
    burnish_token *textures; /* of "comment TextureFile NAME", in their order */
    size_t texture_count, texture_capacity;
    int has_vertex_colors, has_face_colors; /* red, green and blue */
    int has_face_coordinates;               /* texcoord */

    /* Of readers of other formats, which describe their points as rows of one element. */
    double scale[3], offset[3]; /* of binary coordinates; 0: as they are */
    int is_open;                /* 1: each line is a row, up to the end of the file */
    int may_lack;               /* 1: points that are not finite are missing, no damage */
    burnish_ply_tint tint;
} burnish_ply_header;

/* Textures of one file; larger numbers mean no texture. */
enum { BURNISH_PLY_TEXTURES_MAX = 4096 };

/* Reads the header. The caller destroys it, also on error. Errors: FORMAT, MEMORY. */
burnish_status burnish_ply_read_header(burnish_reader *reader, burnish_ply_header *header);

/* The role of a vertex's property. */
burnish_ply_role burnish_ply_role_of(burnish_token name);

/* Adds an element, or a property to the last one. Errors: MEMORY. */
burnish_status burnish_ply_add_element(burnish_reader *reader, burnish_ply_header *header,
                                       burnish_ply_element element);
burnish_status burnish_ply_add_property(burnish_reader *reader, burnish_ply_header *header,
                                        burnish_ply_property property);

/* If the status is OK, checks a header, which may be another reader's, and reads what it describes;
 * then destroys it. Errors: as burnish_read. */
burnish_status burnish_ply_read_described(burnish_reader *reader, burnish_ply_header *header,
                                          burnish_status status);

/* Checks that there is one vertex element with x, y and z, and that every face element has corners.
 * Errors: FORMAT. */
burnish_status burnish_ply_check_header(burnish_reader *reader, burnish_ply_header *header);
void burnish_ply_destroy_header(const burnish_context *context, burnish_ply_header *header);

#endif
