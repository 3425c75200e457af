/* Computes one map of light. */
#ifndef BURNISH_ENVIRONMENT_MAP_FILL_H
#define BURNISH_ENVIRONMENT_MAP_FILL_H

#include "core/memory.h"
#include "environment/maps.h"

typedef struct burnish_map_filler {
    const burnish_light_sources *sources;
    const burnish_kernels *kernels;
    burnish_tasks *tasks; /* NULL: the caller alone */
    burnish_memory *memory;
} burnish_map_filler;

/* Allocates and fills the texels of a map (light_map.h).
 *   alpha  0: the diffuse map
 * Errors: MEMORY (*texels: NULL), CANCELLED. */
burnish_status burnish_light_map_fill(const burnish_map_filler *filler, float alpha, int *size,
                                      float **texels);

#endif
