/* Light of near lights on a grid. Over most of a surface it is so smooth that a quadratic in the
 * pixel's position replaces it: in squares of 16 x 16 or 8 x 8 pixels of a tile, nine points are
 * integrated and give the quadratics. Points whose normal or position is not what the square's
 * quadratics say (edges, other surfaces, bumps) are integrated each. */
#ifndef BURNISH_RENDER_LIGHT_NEAR_CELLS_H
#define BURNISH_RENDER_LIGHT_NEAR_CELLS_H

#include "raster/tile.h"
#include "render/light/area.h"
#include "render/render_ops.h"

enum {
    BURNISH_NEAR_CELL = 8, /* pixels along the edge of the smallest square */
    BURNISH_NEAR_SIDE_BITS = 3,
    BURNISH_NEAR_SIDE = 1 << BURNISH_NEAR_SIDE_BITS,
    BURNISH_NEAR_CELLS = BURNISH_NEAR_SIDE * BURNISH_NEAR_SIDE,
    BURNISH_NEAR_TERMS = 6 /* 1, u, v, u^2, u v, v^2 */
};

_Static_assert((int)BURNISH_NEAR_CELL *(int)BURNISH_NEAR_SIDE == (int)BURNISH_TILE_SIZE,
               "they fill a tile");

/* Of light. Diffuse light is smoother: no point that lacks it has specular light. */
enum { BURNISH_NEAR_CELL_DIFFUSE, BURNISH_NEAR_CELL_SPECULAR, BURNISH_NEAR_CELL_KINDS };

typedef struct burnish_near_cell {
    int material;
    float x, y, scale; /* its centre, as burnish_screen_points counts; u = (x - its x) scale */
    /* squared distances of points for which each kind of light holds */
    float normal_limit[BURNISH_NEAR_CELL_KINDS], position_limit[BURNISH_NEAR_CELL_KINDS];
    float normal[3][BURNISH_NEAR_TERMS], position[3][BURNISH_NEAR_TERMS]; /* a unit vector, / w */
    float light[BURNISH_NEAR_VALUES][BURNISH_NEAR_TERMS];
    int is_grey, has_key; /* 1: the three colours are equal; a light casts a shadow */
} burnish_near_cell;

/* A tile's. */
typedef struct burnish_near_cells {
    float left, top; /* the tile's corner */
    int count;
    int32_t cell[BURNISH_NEAR_CELLS]; /* row by row: number in cells, or -1 */
    burnish_near_cell cells[BURNISH_NEAR_CELLS];
} burnish_near_cells;

/* What cells are made from. */
typedef struct burnish_near_field {
    const burnish_area *area;
    const burnish_kernels *kernels;
    const burnish_render_ops *ops;
    const burnish_rays *rays;
    const burnish_raster_view *view;
    const uint16_t *triangle_materials; /* NULL: all have material 0 */
} burnish_near_field;

/* Makes the cells of a tile that has been rasterised. */
void burnish_near_cells_make(burnish_near_cells *cells, const burnish_near_field *field,
                             const burnish_tile *tile, burnish_near_scratch *scratch);

#endif
