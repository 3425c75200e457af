/* Statements of an OBJ file: from text to values, whoever takes these. */
#ifndef BURNISH_MESH_READ_OBJ_LINE_H
#define BURNISH_MESH_READ_OBJ_LINE_H

#include "mesh/read/text.h"

typedef enum burnish_obj_keyword {
    BURNISH_OBJ_NOTHING, /* an empty line, a comment */
    BURNISH_OBJ_VERTEX,
    BURNISH_OBJ_NORMAL,
    BURNISH_OBJ_FACE,
    BURNISH_OBJ_MATERIAL, /* usemtl */
    BURNISH_OBJ_LIBRARY,  /* mtllib */
    BURNISH_OBJ_ELEMENT,  /* l or p */
    BURNISH_OBJ_OTHER     /* passed over */
} burnish_obj_keyword;

/* A cursor over statements. Start from all zero but for name, text and error. */
typedef struct burnish_obj_line {
    const char *name; /* of the file, for messages */
    burnish_text text;
    burnish_error *error; /* NULL: nobody wants to know */
    burnish_number_reader numbers;
    uint32_t *corners, *corner_normals; /* of the face read last; a normal may be SOURCE_NONE */
    size_t corner_count, corner_capacity, corner_normal_capacity;
    int has_normals; /* 1: a corner of that face has one */
} burnish_obj_line;

void burnish_obj_line_close(burnish_obj_line *line);

static inline burnish_place burnish_obj_here(const burnish_obj_line *line) {
    return burnish_place_line(line->name, line->text.line);
}

/* Reads the word that a line starts with. */
burnish_obj_keyword burnish_obj_read_keyword(burnish_obj_line *line);

/* What follows the keyword. Errors: FORMAT, MEMORY. */

enum { BURNISH_OBJ_VERTEX_MOST = 7 }; /* x y z [w], or x y z r g b [a] */

/* count: numbers that were there: 3, 4, 6 or 7 */
burnish_status burnish_obj_read_vertex(burnish_obj_line *line,
                                       float values[BURNISH_OBJ_VERTEX_MOST], int *count);

/* The colour of a vertex of 6 or 7 numbers. */
void burnish_obj_color(const float values[BURNISH_OBJ_VERTEX_MOST], uint8_t rgba[4]);

/* Numbers that are not finite become 0. */
burnish_status burnish_obj_read_normal(burnish_obj_line *line, float normal[3]);

/* The corners of a face, possibly fewer than 3, into line->corners and line->corner_normals.
 * positions, normals: how many of them stand before the face. */
burnish_status burnish_obj_read_face(burnish_obj_line *line, size_t positions, size_t normals);

#endif
