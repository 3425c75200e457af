/* Previews: rows of a file of which one in so many is read, to stay within a memory limit. */
#ifndef BURNISH_MESH_READ_COMMON_PREVIEW_H
#define BURNISH_MESH_READ_COMMON_PREVIEW_H

#include "mesh/read/io/reader.h"

/* What a point, or a triangle, takes from reading to drawing, at most (docs/scale.md). */
enum { BURNISH_POINT_BYTES = 112, BURNISH_FACET_BYTES = 112 };

/* *step: one in so many rows of `bytes` bytes each is to be kept for the option max_memory; 1: all.
 * Errors: LIMIT if the option is too small for a preview. */
burnish_status burnish_preview_step(burnish_reader *reader, uint64_t count, size_t bytes,
                                    size_t *step);

/* Notes and reports that one in `step` of `count` is drawn. what: "points", "triangles". */
void burnish_preview_note(burnish_reader *reader, size_t step, size_t count, const char *what);

/* Reads facets of a binary STL file, 50 bytes each from `offset` on, as points: one in `step`, at
 * the middle and with the normal of its triangle. Errors: FORMAT, LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_preview_facets(burnish_reader *reader, size_t offset, size_t count,
                                      size_t step);

#endif
