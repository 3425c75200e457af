/* PLY: what the header says, for the body to be read by; values and rows of binary files. */
#ifndef BURNISH_MESH_READ_PLY_PLY_H
#define BURNISH_MESH_READ_PLY_PLY_H

#include <stdatomic.h>
#include <string.h>

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
    BURNISH_PLY_FLOAT32,
    BURNISH_PLY_FLOAT64
} burnish_ply_type;

/* Bytes of one value in a binary body. */
static inline size_t burnish_ply_type_size(burnish_ply_type type) {
    static const uint8_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

/* What a property is to burnish. Those of a vertex before ROLE_COUNT are columns of a row. */
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
    BURNISH_PLY_ROLE_COUNT,
    BURNISH_PLY_CORNERS,   /* vertex_indices of a face or of triangle strips */
    BURNISH_PLY_TEXCOORDS, /* texcoord of a face: u and v of each corner */
    BURNISH_PLY_TEXNUMBER, /* which of the header's textures it shows, from 0 */
    BURNISH_PLY_OTHER      /* passed over */
} burnish_ply_role;

typedef struct burnish_ply_property {
    burnish_ply_type type;       /* of the value, or of a list's items */
    burnish_ply_type count_type; /* NONE: a scalar */
    burnish_ply_role role;
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
} burnish_ply_header;

/* Textures of one file: numbers of faces beyond show none. */
enum { BURNISH_PLY_TEXTURES_MAX = 4096 };

/* ---- ply_header.c ---- */

/* Reads the header; one vertex element with x, y and z is there, and every face element has
 * corners. The caller destroys the header, also on error. Errors: FORMAT, MEMORY. */
burnish_status burnish_ply_read_header(burnish_reader *reader, burnish_ply_header *header);
void burnish_ply_destroy_header(const burnish_context *context, burnish_ply_header *header);

/* ---- ply_binary.c: rows that all have one size ---- */

/* Where a value stands in a row. */
typedef struct burnish_ply_column {
    size_t offset;
    burnish_ply_type type; /* NONE: absent */
} burnish_ply_column;

typedef struct burnish_ply_rows {
    size_t row_size;
    int big_endian;
    burnish_ply_column columns[BURNISH_PLY_ROLE_COUNT];
    burnish_ply_column length, corners; /* of the one list, which has 3 items */
    size_t first_triangle, vertex_count;
    const burnish_mesh_data *mesh;
    atomic_size_t odd; /* the first row that is not as expected */
} burnish_ply_rows;

/* Rows [first, end) of vertices or triangles, the first at `bytes`, into the streams, which have
 * room for them: as burnish_rows_task. The first row that is not as expected goes to rows->odd.
 * user_data: the burnish_ply_rows. */
void burnish_ply_convert_vertices(void *user_data, const uint8_t *bytes, size_t first, size_t end);
void burnish_ply_convert_triangles(void *user_data, const uint8_t *bytes, size_t first, size_t end);

/* The colours of triangles that have been converted, one each. */
void burnish_ply_convert_face_colors(void *user_data, const uint8_t *bytes, size_t first,
                                     size_t end);

/* ---- ply_rows.c ---- */

/* What is known of the file while its body is read. */
typedef struct burnish_ply_state {
    burnish_reader *reader;
    burnish_ply_header header;
    const burnish_ply_element *element; /* being read */
    size_t first_row;                   /* rows of it that were read by other means */
    size_t vertex_count;
    burnish_ply_type types[BURNISH_PLY_ROLE_COUNT];      /* of a vertex; NONE: not there */
    burnish_ply_type face_types[BURNISH_PLY_ROLE_COUNT]; /* of a face's colours */
    int takes_face_colors;      /* 1: each triangle appends its face's colour */
    int keeps_coordinates;      /* 1: texture coordinates are wanted */
    int takes_face_coordinates; /* 1: each triangle appends 3 of its face */
    int takes_textures;         /* 1: faces tell which texture they show */
    unsigned per_triangle;      /* bits 1 << attribute: what triangles append */
    size_t run_start;           /* triangles from here on show run_texture */
    int run_texture;
    burnish_warning_group few_corners, fields, comments;
    int by_lines; /* rows are lines of an ASCII file, whatever they hold */
    int is_odd;   /* 1: a line does not hold a row */
    const burnish_reader_input *with_comments; /* the reader's own input, where it has been given */
    burnish_reader_input without;              /* this one */
} burnish_ply_state;

static inline int burnish_ply_has_roles(const burnish_ply_state *ply, int first, int last) {
    for (int role = first; role <= last; ++role) {
        if (ply->types[role] == BURNISH_PLY_NONE) {
            return 0;
        }
    }
    return 1;
}

/* The first line end from a byte on. */
static inline const uint8_t *burnish_ply_line_end(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = memchr(from, '\n', (size_t)(end - from));
    const uint8_t *last = newline ? newline : end;
    const uint8_t *other = memchr(from, '\r', (size_t)(last - from));
    return other ? other : last;
}

/* `rows` rows of the element at hand from *at on, which moves past them. */
burnish_status burnish_ply_read_rows(burnish_ply_state *ply, const uint8_t **at, size_t rows);

/* ---- ply_comments.c: lines in an ASCII body which are none of the header's ---- */

/* Gives the reader an input whose body has blanks where it had comments; *any: 1 where there are
 * some. Errors: MEMORY. */
burnish_status burnish_ply_hide_comments(burnish_ply_state *ply, int *any);

/* Gives it its own input back, once the body has been read. */
void burnish_ply_show_comments(burnish_ply_state *ply);

/* ---- ply_triangles.c: what triangles have that vertices have not ---- */

/* From a triangle on, texture n of the header is shown; BURNISH_PLY_TEXTURES_MAX: none. */
burnish_status burnish_ply_use_texture(burnish_ply_state *ply, size_t triangle, int texture);

/* Once all triangles are there: gives them the colours and texture coordinates that were read for
 * them, where all have some. */
burnish_status burnish_ply_settle_triangles(burnish_ply_state *ply);

/* Loads the header's textures, and makes the materials that show them. */
burnish_status burnish_ply_load_textures(burnish_ply_state *ply);

/* ---- Binary values ---- */

static inline uint64_t load_bits(const uint8_t *p, size_t size, int big_endian) {
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i) {
        bits = bits << 8 | p[big_endian ? i : size - 1 - i];
    }
    return bits;
}

static inline double burnish_ply_load(const uint8_t *p, burnish_ply_type type, int big_endian) {
    const uint64_t bits = load_bits(p, burnish_ply_type_size(type), big_endian);
    const uint32_t low = (uint32_t)bits;
    float single;
    double wide;
    switch (type) {
    case BURNISH_PLY_INT8:
        return (double)low - (low & 0x80u ? 256.0 : 0.0);
    case BURNISH_PLY_INT16:
        return (double)low - (low & 0x8000u ? 65536.0 : 0.0);
    case BURNISH_PLY_INT32:
        return (double)low - (low & 0x80000000u ? 4294967296.0 : 0.0);
    case BURNISH_PLY_FLOAT32:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case BURNISH_PLY_FLOAT64:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default:
        return (double)low;
    }
}

/* floats count from 0 to 1, 16 bits to 65535, anything else to 255 */
static inline uint8_t burnish_ply_to_color(double value, burnish_ply_type type) {
    if (type == BURNISH_PLY_FLOAT32 || type == BURNISH_PLY_FLOAT64) {
        value *= 255;
    } else if (type == BURNISH_PLY_UINT16) {
        value /= 257;
    }
    return (uint8_t)(value > 0 ? (value < 255 ? value + 0.5 : 255) : 0);
}

/* A value that is not negative; UINT32_MAX for one that is. */
static inline uint32_t burnish_ply_load_count(const uint8_t *from, burnish_ply_type type,
                                              int big_endian) {
    const double value = burnish_ply_load(from, type, big_endian);
    return value >= 0 ? (uint32_t)value : UINT32_MAX;
}

#endif
