/* Parts of an OBJ file, and how much each of them holds. */
#ifndef BURNISH_MESH_READ_OBJ_COUNT_H
#define BURNISH_MESH_READ_OBJ_COUNT_H

#include <stddef.h>
#include <stdint.h>

/* usemtl or mtllib. */
typedef struct burnish_obj_event {
    const uint8_t *behind; /* the keyword */
    size_t line;           /* in the part, counted from 1 */
    size_t triangle;       /* triangles of the part before it */
    int is_library;
} burnish_obj_event;

typedef struct burnish_obj_counts {
    size_t vertices, normals, triangles, lines;
} burnish_obj_counts;

typedef struct burnish_obj_part {
    const uint8_t *first, *end;
    burnish_obj_counts before, own;
    int has_values;     /* v, vn */
    int has_statements; /* f, usemtl, mtllib */
    int has_colors;
    burnish_obj_event *events;
    size_t event_count, event_capacity;
} burnish_obj_part;

/* Counts what is in a part, from all zero, without reading a number: its first and last byte are
 * those of lines. What reading finds later must be the same. Returns 0 when the sequential reader
 * should take the file, since it would warn or fail, or lines end by a '\r' alone. */
int burnish_obj_count_part(burnish_obj_part *part);

#endif
