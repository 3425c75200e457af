/* Rows of any kind, one value after another. */
#ifndef BURNISH_MESH_READ_PLY_PLY_ROWS_H
#define BURNISH_MESH_READ_PLY_PLY_ROWS_H

#include <string.h>

#include "mesh/read/ply/ply_header.h"

/* The state of reading the body of a file. */
typedef struct burnish_ply_state {
    burnish_reader *reader;
    burnish_ply_header header;
    const burnish_ply_element *element; /* being read */
    size_t first_row;                   /* rows of it that were read by other means */
    size_t vertex_count;
    burnish_ply_type types[BURNISH_PLY_ROLE_COUNT];      /* of a vertex; NONE: not there */
    burnish_ply_type face_types[BURNISH_PLY_ROLE_COUNT]; /* of a face's colours */
    int ignores_vertex_colors;  /* 1: they are all the same, and faces have colours */
    int takes_face_colors;      /* 1: each triangle appends its face's colour */
    int keeps_coordinates;      /* 1: texture coordinates are wanted */
    int takes_face_coordinates; /* 1: each triangle appends 3 of its face */
    int takes_textures;         /* 1: faces have texture numbers */
    unsigned per_triangle;      /* bits 1 << attribute: what triangles append */
    size_t run_start;           /* triangles from here on show run_texture */
    int run_texture;
    burnish_warning_group few_corners, fields, comments, header_odd;
    int by_lines; /* rows are lines of an ASCII file, whatever they hold */
    int is_odd;   /* 1: a line does not hold a row */
    const burnish_reader_input *with_comments; /* the original input, if replaced by */
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

/* Reads `rows` rows of the current element from *at on, and moves *at past them. */
burnish_status burnish_ply_read_rows(burnish_ply_state *ply, const uint8_t **at, size_t rows);

/* ---- ply_comments.c ---- */

/* Gives the reader an input with blanks in place of comments in the body; *any: 1 if there are
 * some. Errors: MEMORY. */
burnish_status burnish_ply_hide_comments(burnish_ply_state *ply, int *any);

/* Restores the original input, after the body has been read. */
void burnish_ply_show_comments(burnish_ply_state *ply);

/* ---- ply_tint.c ---- */

/* Gives points the colours of the header's tint, if S differs among them. Errors: MEMORY. */
burnish_status burnish_ply_tint_points(const burnish_ply_state *ply);

/* ---- ply_triangles.c ---- */

/* Starts to use texture n of the header at a triangle; BURNISH_PLY_TEXTURES_MAX: no texture. */
burnish_status burnish_ply_use_texture(burnish_ply_state *ply, size_t triangle, int texture);

/* After all triangles: gives them the colours and texture coordinates that were read for them, if
 * every triangle has them. */
burnish_status burnish_ply_settle_triangles(burnish_ply_state *ply);

/* Loads the header's textures, and makes the materials that show them. */
burnish_status burnish_ply_load_textures(burnish_ply_state *ply);

#endif
