/* Parts that a file names one after the other, with the triangles that follow each name. */
#ifndef BURNISH_MESH_READ_COMMON_PARTS_H
#define BURNISH_MESH_READ_COMMON_PARTS_H

#include "mesh/data/data.h"

/* Triangles from first_triangle on are of this part. */
typedef struct burnish_part_run {
    size_t first_triangle;
    size_t part;
} burnish_part_run;

/* Which parts are one. */
typedef enum burnish_part_join {
    BURNISH_JOIN_NONE,
    BURNISH_JOIN_NAMES, /* those of equal names */
    BURNISH_JOIN_IDS
} burnish_part_join;

/* Start from all zero but for memory, join and, if triangles can come before the first name, next. */
typedef struct burnish_part_list {
    burnish_memory *memory; /* the mesh data's */
    burnish_part_join join;
    burnish_part *parts;
    size_t part_count, part_capacity;
    burnish_part_run *runs;
    size_t run_count, run_capacity;
    uint32_t *slots; /* 1 + a part, by the hash of its name or id; a power of two */
    size_t slot_count;
    burnish_part next; /* listed when a triangle follows */
    size_t next_triangle;
} burnish_part_list;

/* Copies a name, cut to whole characters of UTF-8. */
void burnish_part_set_name(char to[BURNISH_NAME_SIZE], const char *name, size_t size);

/* A part of that name in the file's coordinates. */
burnish_part burnish_part_of(const char *name, size_t size);

/* Begins a part: triangles from `triangle` on, which never decreases, are its own. Parts without
 * triangles are not listed; the last one of BURNISH_PARTS_MAX takes all further ones. Errors: the
 * memory's. */
void burnish_parts_begin(burnish_part_list *list, const burnish_part *part, size_t triangle);

/* The number of parts among the first `triangles` triangles. */
size_t burnish_parts_count(burnish_part_list *list, size_t triangles);

/* Gives the mesh the parts, and releases the list. Less than `least` > 0 parts are none, and neither
 * is a single one without a name. Errors: the memory's. */
burnish_status burnish_parts_finish(burnish_part_list *list, burnish_mesh_data *mesh, size_t least);

void burnish_parts_release(burnish_part_list *list);

#endif
