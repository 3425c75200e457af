/* A cursor over the body of a PLY file: ASCII, little-endian or big-endian, read value by value as
 * the header says.
 *
 * ASCII values may be spread over lines in any way. Counts are held against the bytes that are left
 * before memory is taken for them. */
#ifndef ORACLE_MESH_READ_PLY_CURSOR_H
#define ORACLE_MESH_READ_PLY_CURSOR_H

#include "oracle/ply.h"

/* Start from all zero but for input, header, error, text and vertex_count. */
typedef struct oracle_ply_cursor {
    const oracle_reader_input *input;
    const oracle_ply_header *header;
    burnish_error *error;       /* NULL: nobody wants to know */
    oracle_text text;           /* of both encodings; lines count in ASCII only */
    const uint8_t *value_start; /* of the value read last, for messages */
    oracle_number_reader numbers;

    const oracle_ply_element *element; /* being read */
    uint64_t row;
    size_t vertex_count;

    /* The row read last. */
    double values[ORACLE_PLY_ROLE_COUNT];         /* of a vertex */
    oracle_ply_type types[ORACLE_PLY_ROLE_COUNT]; /* of these; NONE: not there */
    uint32_t *corners;                            /* of a face or of strips */
    size_t corner_count, corner_capacity;
} oracle_ply_cursor;

void oracle_ply_close(oracle_ply_cursor *ply);

static inline int oracle_ply_is_ascii(const oracle_ply_cursor *ply) {
    return ply->header->encoding == ORACLE_PLY_ASCII;
}

oracle_place oracle_ply_here(const oracle_ply_cursor *ply);

/* How many values of a type may still follow: in ASCII each takes a character and a blank. */
uint64_t oracle_ply_room(const oracle_ply_cursor *ply, size_t binary_size);

/* Reads or passes over one row of the element. Errors: FORMAT, MEMORY. */
burnish_status oracle_ply_read_row(oracle_ply_cursor *ply);
burnish_status oracle_ply_skip_row(oracle_ply_cursor *ply);

/* What a vertex element has, from its types: all three of it. */
int oracle_ply_has_normals(const oracle_ply_cursor *ply);
int oracle_ply_has_colors(const oracle_ply_cursor *ply);

/* The vertex read last. A normal that is not finite has zeros, and build makes one. */
void oracle_ply_get_position(const oracle_ply_cursor *ply, float position[3]);
void oracle_ply_get_normal(const oracle_ply_cursor *ply, float normal[3]);
void oracle_ply_get_color(const oracle_ply_cursor *ply, uint8_t rgba[4]);

#endif
