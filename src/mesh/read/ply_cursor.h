/* A cursor over the body of a PLY file: ASCII, little-endian or big-endian, read value by value as
 * the header says.
 *
 * ASCII values may be spread over lines in any way. Counts are held against the bytes that are left
 * before memory is taken for them. */
#ifndef BURNISH_MESH_READ_PLY_CURSOR_H
#define BURNISH_MESH_READ_PLY_CURSOR_H

#include "mesh/read/ply.h"

/* Start from all zero but for input, header, error, text and vertex_count. */
typedef struct burnish_ply_cursor {
    const burnish_reader_input *input;
    const burnish_ply_header *header;
    burnish_error *error;       /* NULL: nobody wants to know */
    burnish_text text;          /* of both encodings; lines count in ASCII only */
    const uint8_t *value_start; /* of the value read last, for messages */
    burnish_number_reader numbers;

    const burnish_ply_element *element; /* being read */
    uint64_t row;
    size_t vertex_count;

    /* The row read last. */
    double values[BURNISH_PLY_ROLE_COUNT];          /* of a vertex */
    burnish_ply_type types[BURNISH_PLY_ROLE_COUNT]; /* of these; NONE: not there */
    uint32_t *corners;                              /* of a face or of strips */
    size_t corner_count, corner_capacity;
} burnish_ply_cursor;

void burnish_ply_close(burnish_ply_cursor *ply);

static inline int burnish_ply_is_ascii(const burnish_ply_cursor *ply) {
    return ply->header->encoding == BURNISH_PLY_ASCII;
}

burnish_place burnish_ply_here(const burnish_ply_cursor *ply);

/* How many values of a type may still follow: in ASCII each takes a character and a blank. */
uint64_t burnish_ply_room(const burnish_ply_cursor *ply, size_t binary_size);

/* Reads or passes over one row of the element. Errors: FORMAT, MEMORY. */
burnish_status burnish_ply_read_row(burnish_ply_cursor *ply);
burnish_status burnish_ply_skip_row(burnish_ply_cursor *ply);

/* What a vertex element has, from its types: all three of it. */
int burnish_ply_has_normals(const burnish_ply_cursor *ply);
int burnish_ply_has_colors(const burnish_ply_cursor *ply);

/* The vertex read last. A normal that is not finite has zeros, and build makes one. */
void burnish_ply_get_position(const burnish_ply_cursor *ply, float position[3]);
void burnish_ply_get_normal(const burnish_ply_cursor *ply, float normal[3]);
void burnish_ply_get_color(const burnish_ply_cursor *ply, uint8_t rgba[4]);

#endif
