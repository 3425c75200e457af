/* Previews: of a file that needs more memory than the option max_memory, one in so many points or
 * triangles is kept. */
#ifndef BURNISH_MESH_READ_IO_THINNING_H
#define BURNISH_MESH_READ_IO_THINNING_H

#include "mesh/read/io/chunk.h"

/* What a point, or a triangle with its vertices, takes from reading to drawing, at most. */
enum { BURNISH_ROW_BYTES = 112 };

/* How many points or triangles max_memory has room for; UINT64_MAX: no limit. */
uint64_t burnish_thinning_room(const burnish_reader_input *input);

/* *step: one in so many of `count` rows is to be kept, if `needed` points or triangles are more than
 * there is room for; 1: all. Errors: LIMIT if there is no room for a preview. */
burnish_status burnish_thinning_step(burnish_reader *reader, uint64_t needed, uint64_t count,
                                     size_t *step);

/* Notes and reports that one in mesh->thinning of `count` is drawn.
 *   what  "points", "vertices" or "triangles" */
void burnish_thinning_note(burnish_reader *reader, size_t count, const char *what);

/* The middle of a triangle and its unit normal. */
void burnish_thinning_facet(const float corners[9], float position[3], float normal[3]);

/* Rows of text, of which 0, step, 2 step ... are kept: positions with the values that are numbered
 * as they are, or facets, as points. The step doubles when more than `most` are kept. Without a
 * step, all of the mesh is kept. */
typedef struct burnish_thinning {
    size_t step, most;
    int are_facets;   /* positions are corners of triangles, 3 each */
    unsigned indexed; /* of burnish_grammar: these are dropped */
} burnish_thinning;

/* Drops from a mesh of `rows` rows what a preview lacks, and all rows but one in thinning->step.
 * Errors: MEMORY. */
burnish_status burnish_thinning_begin(const burnish_thinning *thinning, burnish_mesh_data *mesh,
                                      size_t rows);

/* Makes room for what chunks add to the first `before` rows, so there are `rows`. Errors: MEMORY. */
burnish_status burnish_thinning_reserve(burnish_thinning *thinning, burnish_mesh_data *mesh,
                                        const burnish_chunk *chunks, size_t count, size_t before,
                                        size_t rows);

/* Copies a chunk's rows. */
void burnish_thinning_append(const burnish_thinning *thinning, burnish_mesh_data *mesh,
                             const burnish_chunk *chunk);

/* Leaves a mesh of points only. */
void burnish_thinning_end(const burnish_thinning *thinning, burnish_mesh_data *mesh, size_t rows);

#endif
