/* G-code of slicers for printing with filament: the state of its reader.
 *
 *   gcode_moves  lines: what the machine does, and what slicers note in comments
 *   gcode_path   the path of the nozzle where filament comes out, with few points
 *   gcode_beads  ... as rods
 *   gcode        entry point: recognises files, and colours the rods; thumbnails; binary G-code
 *
 * Moves without filament leave no trace. Lengths are in millimetres. */
#ifndef BURNISH_MESH_READ_GCODE_GCODE_H
#define BURNISH_MESH_READ_GCODE_GCODE_H

#include "mesh/read/io/reader.h"

enum {
    BURNISH_GCODE_TOOLS = 64, /* by number; others are commands of a printer's own */
    BURNISH_GCODE_FEATURES = 32,
    BURNISH_GCODE_LINE = 1 << 12,  /* bytes of a line; more are ignored */
    BURNISH_GCODE_POINTS = 700000, /* of the path that are drawn, at most */
    BURNISH_GCODE_TRIANGLES = 8    /* of a rod */
};

/* The feature of what is printed before the file names one. */
#define BURNISH_GCODE_OTHER "other"

/* The end of a rod that begins at the point before it, unless it starts a path. */
typedef struct burnish_gcode_point {
    float position[3]; /* of the nozzle, at the top of the filament */
    float width;       /* as the file states it; 0: from the flow */
    float height;
    float filament, length; /* filament used on the way from the point before, and its length */
    uint32_t layer;         /* from 0, a step up each */
    uint8_t feature, tool, is_start;
} burnish_gcode_point;

/* The picture that the file holds of itself: where in the file. */
typedef struct burnish_gcode_picture {
    size_t first, end; /* 0: none */
    uint64_t area;
} burnish_gcode_picture;

typedef struct burnish_gcode {
    burnish_reader *reader;
    burnish_memory *memory;

    burnish_gcode_point *points;
    size_t count, capacity;
    burnish_gcode_point pending; /* the end of a rod that may still become longer */
    int has_pending;
    double bend; /* how far moves before it may be from the rod */
    double tolerance;
    size_t room;         /* append fewer points */
    uint32_t layer_step; /* one in so many layers is kept */

    double at[3], shift[3]; /* a coordinate is unit * the word + shift */
    double unit, filament;  /* the last absolute E */
    int is_relative, is_filament_relative;
    int is_apart;   /* the next rod starts a path */
    int has_begun;  /* a layer was marked */
    int has_height; /* the file states the height of layers */
    float width, height, layer_z;
    uint32_t layer;
    uint8_t feature, tool;

    size_t layer_marks, line_count;
    char features[BURNISH_GCODE_FEATURES][BURNISH_NAME_SIZE];
    uint8_t feature_count;
    uint8_t colors[BURNISH_GCODE_TOOLS][4]; /* alpha 0: none */
    double lengths[BURNISH_GCODE_TOOLS];    /* of filament */
    float diameter;                         /* of filament */
    burnish_warning_group odd;              /* words of moves */
    burnish_gcode_picture picture, in_picture;
    int has_odd_picture; /* in a format that can't be read */
    int is_over;         /* 1: the rest of the file is not needed */
    burnish_status status;
} burnish_gcode;

/* ---- gcode_moves.c ---- */

/* Reads whole lines; the last one may lack its end. offset: of the text in the file */
void burnish_gcode_read_lines(burnish_gcode *gcode, const uint8_t *text, size_t size,
                              size_t offset);

/* A decimal number without an exponent, below 1e7, at the start of a text: how many bytes it has, 0
 * for anything else. */
size_t burnish_gcode_number(const uint8_t *text, const uint8_t *end, double *value);

/* ---- gcode_path.c ---- */

/* Appends a point, or moves the last one if all moves from the point before it stay within
 * gcode->tolerance. */
void burnish_gcode_add(burnish_gcode *gcode, const burnish_gcode_point *point);
void burnish_gcode_flush(burnish_gcode *gcode);

/* Reduces the path to at most `most` points, by a tolerance of up to 1/2000 of its size, then by
 * leaving out layers, and at last by more tolerance. Errors: MEMORY, LIMIT. */
burnish_status burnish_gcode_reduce(burnish_gcode *gcode, size_t most);

/* ---- gcode_beads.c ---- */

/* Fills the mesh with rods. Errors: MEMORY, CANCELLED. */
burnish_status burnish_gcode_make_beads(burnish_gcode *gcode);

#endif
