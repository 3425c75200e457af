/* Light from far away as a table over directions. */
#ifndef BURNISH_SHADING_LIGHT_MAP_H
#define BURNISH_SHADING_LIGHT_MAP_H

#include <stdatomic.h>

/* Two squares, one for each half of the sphere (dual paraboloid map). For a unit vector w:
 *   d = 1 / (1 + abs(w.z))
 *   column = w.x d size / 2 + (size + 1) / 2
 *   row    = w.y d size / 2 + (size + 1) / 2, and size + 2 more if w.z < 0
 * Whole numbers are texels. Each square has size + 2 rows and columns and goes beyond its half by a
 * border, so the four texels of a bilinear look-up are in one square. The mapping is smooth: the
 * error of the look-up is of second order in 1 / size. An octahedral map, which has edges, has an
 * error of first order there.
 *
 * Texels are computed when they are first looked up, in cells of BURNISH_LIGHT_CELL rows and columns. */
typedef struct burnish_light_map {
    int size;            /* texels per side without the border */
    const float *texels; /* red, green, blue and 0 of each; 2 (size + 2) rows of size + 2 */
    atomic_uint *states; /* burnish_light_state of each cell, row by row; NULL: all are ready */
    void (*fill)(void *cells, int number); /* makes a cell ready */
    void *cells;
} burnish_light_map;

enum { BURNISH_LIGHT_CELL_BITS = 2, BURNISH_LIGHT_CELL = 1 << BURNISH_LIGHT_CELL_BITS };

/* FILLED: its texels are there. READY: those of the cells to the right and below are there, too, so
 * look-ups that begin in the cell need no more. */
enum { BURNISH_LIGHT_EMPTY, BURNISH_LIGHT_BUSY, BURNISH_LIGHT_FILLED, BURNISH_LIGHT_READY };

/* Cells per row of cells. */
static inline int burnish_light_cells_across(int size) {
    return (size + 2 + BURNISH_LIGHT_CELL - 1) >> BURNISH_LIGHT_CELL_BITS;
}

/* Makes the texels ready that a look-up reads whose first one has this row and column. */
static inline void burnish_light_map_need(const burnish_light_map *map, int row, int column) {
    const int across = burnish_light_cells_across(map->size);
    const int cell =
        (row >> BURNISH_LIGHT_CELL_BITS) * across + (column >> BURNISH_LIGHT_CELL_BITS);
    if (atomic_load_explicit(&map->states[cell], memory_order_acquire) != BURNISH_LIGHT_READY) {
        map->fill(map->cells, cell);
    }
}

/* Maps of specular light at roughness k / (BURNISH_LIGHT_LEVELS - 1), alpha being its square.
 * Interpolate linearly in roughness. */
enum { BURNISH_LIGHT_LEVELS = 9 };

#endif
