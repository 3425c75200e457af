/* Depth maps of small triangles: straight from vertices to texels, without lists and tiles, for two
 * maps at once.
 *
 * Large triangles, whose depths come from planes (BURNISH_SMALL_EDGE), are left to tiles.
 *
 * A map's texel is the greatest code of the depths of the triangles that cover its centre, so their
 * order does not matter. Coverage and depth have the bits that burnish_tile_draw gives them. */
#ifndef BURNISH_RASTER_MAPS_H
#define BURNISH_RASTER_MAPS_H

#include <stddef.h>
#include <stdint.h>

#include "raster/geometry.h"

/* Depths are stored in 16 bits, [0, BURNISH_MAP_CODES]; 0 where nothing is. */
#define BURNISH_MAP_CODES 65535.0

enum {
    BURNISH_MAPS = 2,       /* that are drawn at once, at most */
    BURNISH_MAPS_SIZE = 256 /* texels along an edge, at most: coordinates fit 16 bits */
};

/* Where a vertex falls in each of the maps: 16 bytes, loaded as one vector. */
typedef struct burnish_map_vertex {
    struct {
        uint32_t at; /* 1/256 texel: packed x and y */
        float depth;
    } in[BURNISH_MAPS];
} burnish_map_vertex;

/* What a mesh's small triangles are drawn from, and into. */
typedef struct burnish_maps {
    int count;                    /* of maps */
    int size;                     /* texels along an edge, a multiple of 16 */
    burnish_map_vertex *vertices; /* one per vertex of the mesh */
    const uint32_t *indices;      /* 3 per triangle */
    size_t triangle_count;
    const uint16_t *transparent;    /* per batch; bit i: triangle i is left out. NULL: none is */
    uint16_t *depths[BURNISH_MAPS]; /* size^2 codes, row after row */
    uint16_t *large[BURNISH_MAPS];  /* receives per batch; bit i: triangle i is large, and may be
                                       seen */
    uint64_t cells[BURNISH_MAPS];   /* what small triangles would add to burnish_geometry.cells is
                                       added */
} burnish_maps;

#endif
