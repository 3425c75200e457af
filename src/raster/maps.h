/* Depth maps in pairs: what is seen along a direction, and against it. Both have the same texels,
 * so what a triangle covers, and how deep, is found once. Triangles go straight from vertices to
 * texels, without lists and tiles, for two pairs at once.
 *
 * A texel is the greatest code of the depths of the triangles that cover its centre, so their order
 * does not matter. */
#ifndef BURNISH_RASTER_MAPS_H
#define BURNISH_RASTER_MAPS_H

#include <stddef.h>
#include <stdint.h>

#include "raster/geometry.h"

/* Depths are stored in 16 bits, [0, BURNISH_MAP_CODES]; 0 where nothing is. Against a direction a
 * depth is BURNISH_MAP_CODES less what it is along it. */
#define BURNISH_MAP_CODES 65535.0

enum {
    BURNISH_MAPS = 2,       /* pairs that are drawn at once, at most */
    BURNISH_MAPS_SIZE = 256 /* texels along an edge, at most: coordinates fit 16 bits */
};

/* Where a vertex falls in the maps of each pair: 16 bytes, loaded as one vector. */
typedef struct burnish_map_vertex {
    struct {
        uint32_t at; /* 1/256 texel: packed x and y */
        float depth;
    } in[BURNISH_MAPS];
} burnish_map_vertex;

/* A mesh, and the maps that it is drawn into. */
typedef struct burnish_maps {
    int count;                    /* of pairs */
    int size;                     /* texels along an edge, a multiple of 16 */
    burnish_map_vertex *vertices; /* one per vertex of the mesh */
    const uint32_t *indices;      /* 3 per triangle */
    size_t triangle_count;
    uint16_t *depths[BURNISH_MAPS][2]; /* size^2 codes, row after row: along, against */
    uint64_t cells[BURNISH_MAPS];      /* what burnish_geometry.cells would be is added */
} burnish_maps;

#endif
