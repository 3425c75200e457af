/* PLY: what the header says, for the body to be read by. */
#ifndef ORACLE_MESH_READ_PLY_H
#define ORACLE_MESH_READ_PLY_H

#include "oracle/reader.h"
#include "oracle/text.h"

typedef enum oracle_ply_encoding {
    ORACLE_PLY_ASCII,
    ORACLE_PLY_LITTLE_ENDIAN,
    ORACLE_PLY_BIG_ENDIAN
} oracle_ply_encoding;

typedef enum oracle_ply_type {
    ORACLE_PLY_NONE, /* as count_type: not a list */
    ORACLE_PLY_INT8,
    ORACLE_PLY_UINT8,
    ORACLE_PLY_INT16,
    ORACLE_PLY_UINT16,
    ORACLE_PLY_INT32,
    ORACLE_PLY_UINT32,
    ORACLE_PLY_FLOAT32,
    ORACLE_PLY_FLOAT64
} oracle_ply_type;

/* Bytes of one value in a binary body. */
static inline size_t oracle_ply_type_size(oracle_ply_type type) {
    static const uint8_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

/* What a property is to burnish. Those of a vertex before ROLE_COUNT are columns of a row. */
typedef enum oracle_ply_role {
    ORACLE_PLY_X,
    ORACLE_PLY_Y,
    ORACLE_PLY_Z,
    ORACLE_PLY_NX,
    ORACLE_PLY_NY,
    ORACLE_PLY_NZ,
    ORACLE_PLY_RED,
    ORACLE_PLY_GREEN,
    ORACLE_PLY_BLUE,
    ORACLE_PLY_ALPHA,
    ORACLE_PLY_ROLE_COUNT,
    ORACLE_PLY_CORNERS, /* vertex_indices of a face or of triangle strips */
    ORACLE_PLY_OTHER    /* passed over */
} oracle_ply_role;

typedef struct oracle_ply_property {
    oracle_ply_type type;       /* of the value, or of a list's items */
    oracle_ply_type count_type; /* NONE: a scalar */
    oracle_ply_role role;
} oracle_ply_property;

typedef enum oracle_ply_kind {
    ORACLE_PLY_ELEMENT_OTHER,
    ORACLE_PLY_ELEMENT_VERTEX,
    ORACLE_PLY_ELEMENT_FACE,
    ORACLE_PLY_ELEMENT_STRIPS
} oracle_ply_kind;

typedef struct oracle_ply_element {
    oracle_token name;
    oracle_ply_kind kind;
    uint64_t count;
    size_t first_property, property_count; /* in the header's list */
    size_t line;                           /* of the element, for messages */
} oracle_ply_element;

typedef struct oracle_ply_header {
    oracle_ply_encoding encoding;
    oracle_ply_element *elements;
    size_t element_count, element_capacity;
    oracle_ply_property *properties;
    size_t property_count, property_capacity;
    size_t body_offset; /* first byte behind the line end of end_header */
    size_t body_line;
} oracle_ply_header;

/* Reads the header; one vertex element with x, y and z is there, and every face element has
 * corners. The caller destroys the header, also on error. Errors: FORMAT, LIMIT, MEMORY. */
burnish_status oracle_ply_read_header(const oracle_reader_input *input, oracle_ply_header *header,
                                      burnish_error *error);
void oracle_ply_destroy_header(oracle_ply_header *header);

#endif
