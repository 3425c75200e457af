/* One map of light, whose texels are computed when they are looked up: pictures of flat faces or of
 * few pixels meet few directions. */
#ifndef BURNISH_ENVIRONMENT_MAP_CELLS_H
#define BURNISH_ENVIRONMENT_MAP_CELLS_H

#include "base/memory.h"
#include "environment/map_fill.h"

typedef struct burnish_map_cells burnish_map_cells;

/* filler: must outlive the cells.
 *   alpha  0: the diffuse map
 * *cells: NULL on error. Errors: MEMORY. */
burnish_status burnish_map_cells_create(const burnish_map_filler *filler, float alpha,
                                        burnish_memory *memory, burnish_map_cells **cells);

/* NULL is allowed. */
void burnish_map_cells_destroy(burnish_map_cells *cells, const burnish_context *context);

burnish_light_map burnish_map_cells_map(burnish_map_cells *cells);

#endif
