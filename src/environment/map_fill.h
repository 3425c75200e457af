/* The light that arrives around some directions, as maps of light have it: from a dome, an environment
 * and polygons. */
#ifndef BURNISH_ENVIRONMENT_MAP_FILL_H
#define BURNISH_ENVIRONMENT_MAP_FILL_H

#include "base/memory.h"
#include "environment/area_lights.h"
#include "environment/light_maps.h"
#include "shading/polygon.h"

/* The most directions at once; BURNISH_MAP_GROUP in turn should be neighbours. */
enum { BURNISH_MAP_POINTS = 256, BURNISH_MAP_GROUP = 16 };

/* What maps are computed from, as long as they are. */
typedef struct burnish_map_filler {
    burnish_light_sources sources;
    const burnish_kernels *kernels;
} burnish_map_filler;

/* Which directions receive none of a polygon's light, and which all of it. */
typedef struct burnish_map_reach {
    float middle[3], least;                    /* with a smaller cosine: none */
    int edge_count;                            /* 0: not used */
    float edge[BURNISH_POLYGON_VERTEX_MAX][3]; /* unit vectors toward the polygon's side */
    float sine; /* farther from the edges than this: all or, on the other side of one, none; 2
                   without edges */
    float all;
} burnish_map_reach;

/* Light through the sum of some lobes, or on a matt surface. */
typedef struct burnish_map_light {
    const burnish_map_filler *filler;
    burnish_light_lobes lobes; /* count 0: diffuse */
    int has_dome, has_environment;
    int polygon_count;
    burnish_polygon_constants polygons[BURNISH_AREA_LIGHT_MAX];
    burnish_map_reach reaches[BURNISH_AREA_LIGHT_MAX];
    const float *colors[BURNISH_AREA_LIGHT_MAX];
} burnish_map_light;

/* Adds the distant area lights of the filler to light whose filler and lobes are set. */
void burnish_map_light_add_polygons(burnish_map_light *light);

/* Adds the light of `count` unit vectors w, which are normals or the lobes' axes. */
void burnish_map_light_add(const burnish_map_light *light, const float *const w[3], int count,
                           float *const rgb[3]);

/* The radius of a cap with the integral of the lobe. */
float burnish_map_lobe_radius(const burnish_light_lobe *lobe);

/* ---- map_cells.c ---- */

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
