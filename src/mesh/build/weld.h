/* Finding equal vertices in time that no input can make quadratic. */
#ifndef BURNISH_MESH_BUILD_WELD_H
#define BURNISH_MESH_BUILD_WELD_H

#include "base/memory.h"
#include "core/tasks.h"

/* Numbers bitwise equal positions alike, in the order of their first appearance.
 *
 * O(n) for real meshes, O(n log n) for any input. The result depends on the positions only.
 *
 * from:   3 floats per position; -0 counts as 0
 * count:  [0, 2^32 - 2]
 * tasks:  threads to share the work
 * remap:  count numbers, written
 * to:     room for count positions, may be `from`: the different ones, by number, are written
 * unique: how many different positions there are, written
 * Errors: MEMORY, LIMIT, CANCELLED. */
burnish_status burnish_weld(const float *from, size_t count, burnish_tasks *tasks,
                            burnish_memory *memory, uint32_t *remap, float *to, size_t *unique);

/* Words that a vertex of one position can differ in: normal, colour, tangent, and two times texture
 * coordinates. */
enum { BURNISH_WELD_KEY_WORDS = 12 };

/* Something to be sorted by words; the value breaks ties, which makes the order total. */
typedef struct burnish_weld_record {
    uint32_t key[BURNISH_WELD_KEY_WORDS];
    uint32_t value;
} burnish_weld_record;

/* Sorts in place, O(n log n) in the worst case, O(n) when the records are sorted already. */
void burnish_weld_sort(burnish_weld_record *records, size_t count);

#endif
