/* Statements of an OBJ file: from text to values, whoever takes these. */
#ifndef ORACLE_MESH_READ_OBJ_LINE_H
#define ORACLE_MESH_READ_OBJ_LINE_H

#include "oracle/text.h"

typedef enum oracle_obj_keyword {
    ORACLE_OBJ_NOTHING, /* an empty line, a comment */
    ORACLE_OBJ_VERTEX,
    ORACLE_OBJ_NORMAL,
    ORACLE_OBJ_FACE,
    ORACLE_OBJ_MATERIAL, /* usemtl */
    ORACLE_OBJ_LIBRARY,  /* mtllib */
    ORACLE_OBJ_ELEMENT,  /* l or p */
    ORACLE_OBJ_OTHER     /* passed over */
} oracle_obj_keyword;

/* A cursor over statements. Start from all zero but for name, text and error. */
typedef struct oracle_obj_line {
    const char *name; /* of the file, for messages */
    oracle_text text;
    burnish_error *error; /* NULL: nobody wants to know */
    oracle_number_reader numbers;
    uint32_t *corners, *corner_normals; /* of the face read last; a normal may be SOURCE_NONE */
    size_t corner_count, corner_capacity, corner_normal_capacity;
    int has_normals; /* 1: a corner of that face has one */
} oracle_obj_line;

void oracle_obj_line_close(oracle_obj_line *line);

static inline oracle_place oracle_obj_here(const oracle_obj_line *line) {
    return oracle_place_line(line->name, line->text.line);
}

/* Reads the word that a line starts with. */
oracle_obj_keyword oracle_obj_read_keyword(oracle_obj_line *line);

/* What follows the keyword. Errors: FORMAT, MEMORY. */

enum { ORACLE_OBJ_VERTEX_MOST = 7 }; /* x y z [w], or x y z r g b [a] */

/* count: numbers that were there: 3, 4, 6 or 7 */
burnish_status oracle_obj_read_vertex(oracle_obj_line *line, float values[ORACLE_OBJ_VERTEX_MOST],
                                      int *count);

/* The colour of a vertex of 6 or 7 numbers. */
void oracle_obj_color(const float values[ORACLE_OBJ_VERTEX_MOST], uint8_t rgba[4]);

/* Numbers that are not finite become 0. */
burnish_status oracle_obj_read_normal(oracle_obj_line *line, float normal[3]);

/* The corners of a face, possibly fewer than 3, into line->corners and line->corner_normals.
 * positions, normals: how many of them stand before the face. */
burnish_status oracle_obj_read_face(oracle_obj_line *line, size_t positions, size_t normals);

#endif
