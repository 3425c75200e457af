#include "render/light/near_cells.h"

#include <string.h>

#include "raster/tile_layout.h"
#include "render/render_ops.h"

enum {
    NODES = 9,   /* 3 x 3 */
    MISSING = 3, /* most that need not be there */
    TERMS = BURNISH_NEAR_TERMS,
    VALUES = BURNISH_NEAR_VALUES,
    SIDE = BURNISH_NEAR_SIDE,
    GROUP = BURNISH_NEAR_BATCH / NODES, /* cells that are made at once */
    LARGE = 2 * BURNISH_NEAR_CELL
};

/* A cell may turn a lobe, from its middle to its edge, by this share of the lobe's width, and its
 * points may be off its quadratics by that share. */
#define MOST_TURN 2.0f
#define MOST_DEVIATION 0.05f

/* More than a lobe turns where points are off the quadratics of a cell's diffuse light. */
#define MARGIN (2 * MOST_DEVIATION)

/* Its quadratics may miss a node's light by so much, and by a part of the light. */
#define MOST_ERROR 0.002f
#define MOST_PART 0.008f

/* A square of pixels of a tile, and its nodes. */
typedef struct near_square {
    int x, y, size;
    int first; /* node in the arrays of points */
    int material;
    uint8_t is_there[NODES];
    float u[NODES], v[NODES];
    float fit[NODES][TERMS]; /* the coefficients that a value of 1 at a node gives */
    float turn;              /* of a lobe, from its middle to its edge */
    burnish_near_cell cell;
} near_square;

/* What is done at once. */
typedef struct near_squares {
    int count;
    near_square squares[GROUP];
    float x[BURNISH_NEAR_BATCH], y[BURNISH_NEAR_BATCH], depth[BURNISH_NEAR_BATCH];
    float normal[3][BURNISH_NEAR_BATCH]; /* unit vectors */
    float position[3][BURNISH_NEAR_BATCH], w[BURNISH_NEAR_BATCH];
} near_squares;

/* ---- Nodes ---- */

/* The material of a simple pixel, or -1. */
static int material_at(const burnish_near_field *field, const burnish_tile *tile, int x, int y) {
    const int samples = tile->options.samples, pixel = burnish_pixel_index(x, y);
    const int block = pixel / BURNISH_BLOCK_PIXELS, row = block / BURNISH_TILE_BLOCKS;
    if (x >= tile->width || y >= tile->height ||
        !(tile->buffer.dirty_blocks[row] >> block % BURNISH_TILE_BLOCKS & 1)) {
        return -1;
    }
    if (samples == 1) {
        if (!(tile->buffer.depths[pixel] > BURNISH_FARTHEST)) {
            return -1;
        }
        return field->triangle_materials
                   ? field->triangle_materials[(uint32_t)tile->buffer.ids[pixel] >> 1]
                   : 0;
    }
    const int32_t *ids =
        tile->buffer.ids + block * samples * BURNISH_BLOCK_PIXELS + pixel % BURNISH_BLOCK_PIXELS;
    for (int s = 1; s < samples; ++s) {
        if (ids[s * BURNISH_BLOCK_PIXELS] != ids[0]) {
            return -1;
        }
    }
    if (ids[0] < 0) {
        return -1;
    }
    return field->triangle_materials
               ? field->triangle_materials[tile->primitives.primitives[ids[0]].id_and_facing >> 1]
               : 0;
}

/* The first simple pixel next to (*x, *y); returns its material or -1. */
static int find_node(const burnish_near_field *field, const burnish_tile *tile, int *x, int *y) {
    static const int8_t steps[9][2] = {{0, 0}, {1, 0},  {-1, 0}, {0, 1},  {0, -1},
                                       {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    for (int i = 0; i < 9; ++i) {
        const int material = material_at(field, tile, *x + steps[i][0], *y + steps[i][1]);
        if (material >= 0) {
            *x += steps[i][0];
            *y += steps[i][1];
            return material;
        }
    }
    return -1;
}

static void set_node(const burnish_tile *tile, near_squares *squares, int node, int x, int y) {
    near_square *square = &squares->squares[squares->count];
    const float middle = 0.5f * (float)(square->size - 1), scale = 2 / (float)square->size;
    const int i = square->first + node, pixel = burnish_pixel_index(x, y);
    square->u[node] = ((float)(x - square->x) - middle) * scale;
    square->v[node] = (middle - (float)(y - square->y)) * scale;
    squares->x[i] = (float)x;
    squares->y[i] = (float)-y;
    squares->depth[i] = tile->buffer.center_depths[pixel];
    for (int k = 0; k < 3; ++k) {
        squares->normal[k][i] = tile->buffer.planes[BURNISH_PLANE_X + k][pixel];
    }
}

/* Finds a square's nodes: pixels of one material, whose points are added. A missing one becomes
 * another node again. Returns 0 where too many are missing. */
static int add_nodes(const burnish_near_field *field, const burnish_tile *tile,
                     near_squares *squares) {
    near_square *square = &squares->squares[squares->count];
    const int at[3] = {1, square->size / 2, square->size - 2};
    int found[2] = {0, 0}, missing = 0;
    square->first = squares->count * NODES;
    square->material = -1;
    for (int node = NODES - 1; node >= 0; --node) {
        int x = square->x + at[node % 3], y = square->y + at[node / 3];
        const int material = find_node(field, tile, &x, &y);
        square->is_there[node] =
            material >= 0 && (square->material < 0 || material == square->material);
        if (square->is_there[node]) {
            square->material = material;
            found[0] = x;
            found[1] = y;
        } else if (++missing > MISSING || square->material < 0) {
            return 0;
        }
        set_node(tile, squares, node, found[0], found[1]);
    }
    return 1;
}

/* ---- Quadratics ---- */

/* Makes square->fit by least squares; returns 0 where the nodes are too close to a conic. */
static int make_fit(near_square *square) {
    float a[TERMS][TERMS] = {{0}}, basis[NODES][TERMS];
    for (int node = 0; node < NODES; ++node) {
        const float u = square->u[node], v = square->v[node];
        const float terms[TERMS] = {1, u, v, u * u, u * v, v * v};
        memcpy(basis[node], terms, sizeof terms);
        for (int i = 0; i < TERMS && square->is_there[node]; ++i) {
            for (int j = 0; j <= i; ++j) {
                a[i][j] += terms[i] * terms[j];
            }
        }
    }
    for (int i = 0; i < TERMS; ++i) { /* a becomes L D L^T */
        for (int j = 0; j <= i; ++j) {
            for (int k = 0; k < j; ++k) {
                a[i][j] -= a[i][k] * a[j][k] * a[k][k];
            }
            a[i][j] /= j < i ? a[j][j] : 1;
        }
        if (!(a[i][i] > 0.02f)) {
            return 0;
        }
    }
    for (int node = 0; node < NODES; ++node) {
        float *x = square->fit[node];
        memset(x, 0, sizeof basis[node]);
        if (!square->is_there[node]) {
            continue;
        }
        memcpy(x, basis[node], sizeof basis[node]);
        for (int i = 0; i < TERMS; ++i) {
            for (int k = 0; k < i; ++k) {
                x[i] -= a[i][k] * x[k];
            }
        }
        for (int i = TERMS - 1; i >= 0; --i) {
            x[i] /= a[i][i];
            for (int k = i + 1; k < TERMS; ++k) {
                x[i] -= a[k][i] * x[k];
            }
        }
    }
    return 1;
}

/* Fits a quadratic to values at the nodes. */
static void fit_values(const near_square *square, const float *values, float out[TERMS]) {
    for (int k = 0; k < TERMS; ++k) {
        out[k] = square->fit[0][k] * values[0];
    }
    for (int node = 1; node < NODES; ++node) {
        for (int k = 0; k < TERMS; ++k) {
            out[k] += square->fit[node][k] * values[node];
        }
    }
}

/* What a quadratic says at the nodes. */
static void evaluate_quadratic(const near_square *square, const float c[TERMS], float out[NODES]) {
    const float *u = square->u, *v = square->v;
    for (int i = 0; i < NODES; ++i) {
        out[i] = c[0] + (u[i] * (c[1] + (u[i] * c[3] + v[i] * c[4])) + v[i] * (c[2] + v[i] * c[5]));
    }
}

/* The largest squared distance of a node from what its quadratics say. */
static float largest_miss(const near_square *square, float (*const c)[TERMS],
                          float (*points)[BURNISH_NEAR_BATCH]) {
    float squared[NODES] = {0}, at[NODES], largest = 0;
    for (int k = 0; k < 3; ++k) {
        const float *own = points[k] + square->first;
        evaluate_quadratic(square, c[k], at);
        for (int i = 0; i < NODES; ++i) {
            squared[i] += (own[i] - at[i]) * (own[i] - at[i]);
        }
    }
    for (int i = 0; i < NODES; ++i) {
        largest = squared[i] > largest ? squared[i] : largest;
    }
    return largest;
}

/* ---- Limits ---- */

/* The least cosine between a square's normals and the directions to the viewer. */
static float least_facing(const burnish_area *area, const near_square *square,
                          const near_squares *all) {
    float least = 1;
    for (int i = square->first; i < square->first + NODES; ++i) {
        float cosine = 0, squared = 0;
        for (int k = 0; k < 3; ++k) {
            const float v = area->constants.viewer[k] -
                            (area->constants.local_viewer ? all->position[k][i] : 0);
            cosine += v * all->normal[k][i];
            squared += v * v;
        }
        cosine /= __builtin_sqrtf(squared);
        least = cosine < least ? cosine : least;
    }
    return least > 0 ? least : 0;
}

/* The squared width of the narrowest lobe with which a square reflects the lights. GGX's are narrower
 * near the horizon (environment_lean()). */
static float narrowest_lobe(const burnish_area *area, const burnish_area_material *material,
                            const near_square *square, const near_squares *all) {
    const burnish_near_lights *lights = &area->near_lights;
    const burnish_reflecting_material *reflecting = &material->reflecting;
    const int row = burnish_near_lights_row(lights, material->alpha, reflecting->is_metallic);
    float squared = 1;
    if (!reflecting->reflects) {
        return squared;
    }
    for (int l = 0; l < lights->count; ++l) {
        const burnish_polygon_constants *polygon = &lights->polygons[row + l];
        for (int j = 0; j < polygon->lobe_count; ++j) {
            const burnish_polygon_lobe *lobe = &polygon->lobes[j];
            const float own = 1 / (lobe->zeta * (float)(1 << lobe->squarings));
            squared = own < squared ? own : squared;
        }
    }
    if (reflecting->is_metallic) {
        const float r = reflecting->roughness, wider = 1.5f * r * r * __builtin_sqrtf(r);
        const float x = least_facing(area, square, all), near_edge = x > 0.03f ? x : 0.03f;
        const float width = near_edge + (1 - near_edge) * wider;
        squared *= width < 1 ? 0.5f * width * width : 0.5f;
    }
    return squared;
}

/* How much directions turn per distance that a point moves: 1 / the distance to the nearest light,
 * and to the viewer. */
static float turn_rate(const burnish_area *area, const float p[3]) {
    const burnish_near_lights *lights = &area->near_lights;
    float rate = 0;
    for (int l = 0; l < lights->count; ++l) {
        const burnish_polygon_constants *polygon = &lights->polygons[l];
        const int is_tube = polygon->shape == BURNISH_POLYGON_TUBE;
        const float size = is_tube ? polygon->thickness : polygon->radius;
        float squared = 0, height = -polygon->offset, along = 0;
        for (int k = 0; k < 3 && is_tube; ++k) {
            along += polygon->axis[k] * (polygon->center[k] - p[k]);
        }
        const float end = polygon->half_length; /* to the nearest point of the axis */
        along = along > end ? end : along < -end ? -end : along;
        for (int k = 0; k < 3; ++k) {
            const float d = polygon->center[k] - p[k] - along * polygon->axis[k];
            squared += d * d;
            height += polygon->normal[k] * p[k];
        }
        const float outside = __builtin_sqrtf(squared) - size;
        height = height < 0 ? -height : height;
        const float distance = height > outside ? height : outside;
        const float own = polygon->is_distant ? 0 : 1 / (distance > 1e-20f ? distance : 1e-20f);
        rate = own > rate ? own : rate;
    }
    const float squared = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    return rate + (area->constants.local_viewer ? 1 / __builtin_sqrtf(squared) : 0);
}

/* How far three quadratics lead from the middle of a square to its edge. */
static float reach_of(float (*const c)[TERMS]) {
    float sum = 0;
    for (int term = 1; term < TERMS; ++term) {
        float squared = 0;
        for (int k = 0; k < 3; ++k) {
            squared += c[k][term] * c[k][term];
        }
        sum += term < 3 ? 0.5f * squared : squared;
    }
    return __builtin_sqrtf(2 * sum);
}

/* ---- Cells ---- */

/* Whether quadratics are near enough to normals and positions for lobes of a squared width; limits of
 * the points that they hold for. */
static int is_smooth(const near_square *square, near_squares *all, burnish_near_cell *cell,
                     int kind, float rate, float width_squared) {
    const float limit = MOST_DEVIATION * MOST_DEVIATION * width_squared;
    cell->normal_limit[kind] = 0.25f * limit;
    cell->position_limit[kind] = limit / (rate * rate + 1e-20f);
    return square->turn * square->turn < MOST_TURN * MOST_TURN * width_squared &&
           largest_miss(square, cell->normal, all->normal) < cell->normal_limit[kind] &&
           largest_miss(square, cell->position, all->position) < cell->position_limit[kind];
}

static void drop_square(burnish_near_cell *cell, int kind) {
    cell->normal_limit[kind] = cell->position_limit[kind] = -1;
}

/* Fills a cell but its light; returns 0 where it is not smooth, or smaller ones might have smooth
 * specular light. */
static int shape_cell(const burnish_near_field *field, near_square *square, near_squares *all) {
    const burnish_area_material *material = &field->area->materials[square->material];
    burnish_near_cell *cell = &square->cell;
    float middle[3];
    for (int k = 0; k < 3; ++k) {
        fit_values(square, all->normal[k] + square->first, cell->normal[k]);
        fit_values(square, all->position[k] + square->first, cell->position[k]);
        middle[k] = cell->position[k][0];
    }
    const float rate = turn_rate(field->area, middle);
    const float width_squared = narrowest_lobe(field->area, material, square, all);
    square->turn = 2 * reach_of(cell->normal) + rate * reach_of(cell->position);
    if (!is_smooth(square, all, cell, BURNISH_NEAR_CELL_SPECULAR, rate, width_squared)) {
        drop_square(cell, BURNISH_NEAR_CELL_SPECULAR);
        if (square->size > BURNISH_NEAR_CELL &&
            square->turn * square->turn < 4 * MOST_TURN * MOST_TURN * width_squared) {
            return 0;
        }
    }
    return is_smooth(square, all, cell, BURNISH_NEAR_CELL_DIFFUSE, rate, 1);
}

/* Whether no lobe of a square reaches a light: as polygon_touches(), with the square's turn. Nodes are
 * points `at` and following of the scratch. */
static int is_dark(const burnish_area *area, const near_square *square, int at,
                   const burnish_near_scratch *scratch) {
    const burnish_area_material *material = &area->materials[square->material];
    const burnish_near_lights *lights = &area->near_lights;
    const int is_metallic = material->reflecting.is_metallic;
    const int row = burnish_near_lights_row(lights, material->alpha, is_metallic);
    for (int i = 0; i < lights->count * NODES; ++i) {
        const burnish_polygon_constants *polygon = &lights->polygons[row + i / NODES];
        const int point = at + i % NODES, leans = is_metallic && !polygon->is_distant;
        float d[3], axis[3], factor = 0, wide = 1, squared = 0, along = 0;
        for (int k = 0; k < 3; ++k) {
            const float p = polygon->is_distant ? 0 : scratch->rest[3 + k][point];
            d[k] = polygon->center[k] - p;
            axis[k] = leans ? scratch->leaned[k][point] : scratch->axis[k][point];
            if (leans) {
                factor += scratch->leaned[3 + k][point] * d[k];
                wide += scratch->leaned[3 + k][point] * scratch->leaned[3 + k][point];
            }
        }
        for (int k = 0; k < 3; ++k) {
            d[k] += leans ? scratch->leaned[3 + k][point] * factor : 0;
            squared += d[k] * d[k];
            along += axis[k] * d[k];
        }
        /* sines and cosines of the lobe, the light and the turn */
        const float size = polygon->radius * wide, turn = (square->turn + MARGIN) * wide;
        const float sine = size / __builtin_sqrtf(squared + 1e-30f);
        if (!(sine < 1 && turn < 0.9f && polygon->reach_cosine > 0)) {
            return 0;
        }
        const float cosine = __builtin_sqrtf(1 - sine * sine);
        const float both = polygon->reach_cosine * cosine - polygon->reach_sine * sine;
        const float across = polygon->reach_sine * cosine + polygon->reach_cosine * sine;
        const float all = both * __builtin_sqrtf(1 - turn * turn) - across * turn;
        if (!(both > 0 && along < all * __builtin_sqrtf(squared))) {
            return 0;
        }
    }
    return 1;
}

/* Fits four of the values at nodes, three colours and the key; returns 0 where it is not smooth. */
static int fit_light(const near_square *square, float (*const values)[BURNISH_NEAR_BATCH], int at,
                     const int *numbers, burnish_near_cell *cell) {
    for (int i = 0; i < 4; ++i) {
        const int k = numbers[i], first = numbers[0];
        const float *own = values[k] + at;
        if (i == 3 && !cell->has_key) {
            memset(cell->light[k], 0, sizeof cell->light[k]);
            continue;
        }
        if (i == 1 || i == 2) {
            if (memcmp(own, values[first] + at, NODES * sizeof *own) == 0) {
                memcpy(cell->light[k], cell->light[first], sizeof cell->light[k]);
                continue;
            }
            cell->is_grey = 0;
        }
        float largest = 0, miss[NODES];
        int misses = 0;
        fit_values(square, own, cell->light[k]);
        evaluate_quadratic(square, cell->light[k], miss);
        for (int node = 0; node < NODES; ++node) {
            largest = own[node] > largest ? own[node] : largest;
        }
        const float most = MOST_ERROR + MOST_PART * largest;
        for (int node = 0; node < NODES; ++node) {
            misses |= !(miss[node] - own[node] < most) | !(own[node] - miss[node] < most);
        }
        if (misses) {
            return 0;
        }
    }
    return 1;
}

/* Fits a cell's light, its values at nodes from `at` on; returns 0 where not even diffuse light is
 * smooth, or smaller cells might have smooth specular light. */
static int light_cell(const burnish_area *area, near_square *square, int at,
                      burnish_near_scratch *scratch) {
    static const int diffuse[4] = {BURNISH_NEAR_DIFFUSE, BURNISH_NEAR_DIFFUSE + 1,
                                   BURNISH_NEAR_DIFFUSE + 2, BURNISH_NEAR_KEY_DIFFUSE};
    static const int specular[4] = {BURNISH_NEAR_SPECULAR, BURNISH_NEAR_SPECULAR + 1,
                                    BURNISH_NEAR_SPECULAR + 2, BURNISH_NEAR_KEY_SPECULAR};
    burnish_near_cell *cell = &square->cell;
    const int is_smooth = cell->normal_limit[BURNISH_NEAR_CELL_SPECULAR] > 0;
    const int reflects = area->materials[square->material].reflecting.reflects;
    if (!reflects || (!is_smooth && is_dark(area, square, at, scratch))) {
        memset(cell->light[BURNISH_NEAR_SPECULAR], 0, 3 * sizeof *cell->light);
        memset(cell->light[BURNISH_NEAR_KEY_SPECULAR], 0, sizeof *cell->light);
        cell->normal_limit[BURNISH_NEAR_CELL_SPECULAR] =
            cell->normal_limit[BURNISH_NEAR_CELL_DIFFUSE];
        cell->position_limit[BURNISH_NEAR_CELL_SPECULAR] =
            cell->position_limit[BURNISH_NEAR_CELL_DIFFUSE];
    } else if (is_smooth && !fit_light(square, scratch->rest_values, at, specular, cell)) {
        drop_square(cell, BURNISH_NEAR_CELL_SPECULAR);
        if (square->size > BURNISH_NEAR_CELL) {
            return 0;
        }
    }
    return fit_light(square, scratch->rest_values, at, diffuse, cell);
}

/* Unit normals, and positions themselves. */
static void locate_points(const burnish_near_field *field, const burnish_near_cells *cells,
                          near_squares *squares) {
    const size_t count = (size_t)squares->count * NODES;
    const size_t rest = (BURNISH_NEAR_BATCH - count) * sizeof *squares->x;
    const burnish_screen_points screen = {cells->left + 0.5f, cells->top - 0.5f, squares->x,
                                          squares->y, squares->depth};
    float *const position[3] = {squares->position[0], squares->position[1], squares->position[2]};
    float *const normal[3] = {squares->normal[0], squares->normal[1], squares->normal[2]};
    const float *const from[3] = {normal[0], normal[1], normal[2]};
    float *const arrays[6] = {squares->x, squares->y, squares->depth,
                              normal[0],  normal[1],  normal[2]};
    for (int k = 0; k < 6; ++k) {
        memset(arrays[k] + count, 0, rest);
    }
    field->ops->normalize_array(count, from, normal);
    field->ops->position_from_depth(field->rays, &screen, count, position, squares->w);
    for (size_t i = 0; i < count; ++i) {
        const float inverse = 1 / squares->w[i];
        for (int k = 0; k < 3; ++k) {
            position[k][i] *= inverse;
        }
    }
}

static void install_square(burnish_near_cells *cells, const near_square *square) {
    for (int y = square->y; y < square->y + square->size; y += BURNISH_NEAR_CELL) {
        for (int x = square->x; x < square->x + square->size; x += BURNISH_NEAR_CELL) {
            cells->cell[y / BURNISH_NEAR_CELL * SIDE + x / BURNISH_NEAR_CELL] = cells->count;
        }
    }
    cells->cells[cells->count++] = square->cell;
}

/* Lights the cells of shaped squares, which have one material, and installs them. */
static void light_cells(const burnish_near_field *field, near_squares *squares, const int *shaped,
                        int count, burnish_near_cells *cells, burnish_near_scratch *scratch) {
    const int material = squares->squares[shaped[0]].material;
    const float *from[6] = {squares->normal[0],   squares->normal[1],   squares->normal[2],
                            squares->position[0], squares->position[1], squares->position[2]};
    burnish_kernels_points points = {.w = NULL};
    memset(scratch->rest, 0, sizeof scratch->rest);
    for (int k = 0; k < 6; ++k) {
        for (int i = 0; i < count; ++i) {
            memcpy(scratch->rest[k] + i * NODES, from[k] + squares->squares[shaped[i]].first,
                   NODES * sizeof(float));
        }
    }
    for (int k = 0; k < 3; ++k) {
        points.normal[k] = scratch->rest[k];
        points.position[k] = scratch->rest[3 + k];
    }
    const burnish_area_points nodes = {&points, material, count * NODES, 0, NULL, NULL};
    burnish_area_integrate(field->area, field->kernels, &nodes, scratch, scratch->rest_values);
    for (int i = 0; i < count; ++i) {
        near_square *square = &squares->squares[shaped[i]];
        const float half = 0.5f * (float)square->size;
        square->cell.material = material;
        square->cell.x = cells->left + (float)square->x + half;
        square->cell.y = cells->top - (float)square->y - half;
        square->cell.scale = 1 / half;
        square->cell.is_grey = 1;
        square->cell.has_key = field->area->near_lights.key >= 0;
        if (light_cell(field->area, square, i * NODES, scratch)) {
            install_square(cells, square);
        }
    }
}

/* Makes cells of the squares that are smooth. */
static void make_cells(const burnish_near_field *field, near_squares *squares,
                       burnish_near_cells *cells, burnish_near_scratch *scratch) {
    int shaped[GROUP], count = 0, first = 0;
    locate_points(field, cells, squares);
    for (int i = 0; i < squares->count; ++i) {
        near_square *square = &squares->squares[i];
        if (make_fit(square) && shape_cell(field, square, squares)) {
            shaped[count++] = i;
        }
    }
    for (int i = 1; i <= count; ++i) {
        if (i == count ||
            squares->squares[shaped[i]].material != squares->squares[shaped[first]].material) {
            light_cells(field, squares, shaped + first, i - first, cells, scratch);
            first = i;
        }
    }
    squares->count = 0;
}

/* Squares of a size that are not in cells. */
static void make_size(const burnish_near_field *field, const burnish_tile *tile, int size,
                      burnish_near_cells *cells, burnish_near_scratch *scratch) {
    near_squares squares;
    squares.count = 0;
    for (int y = 0; y < tile->height; y += size) {
        for (int x = 0; x < tile->width; x += size) {
            if (cells->cell[y / BURNISH_NEAR_CELL * SIDE + x / BURNISH_NEAR_CELL] >= 0) {
                continue;
            }
            near_square *square = &squares.squares[squares.count];
            square->x = x;
            square->y = y;
            square->size = size;
            if (add_nodes(field, tile, &squares) &&
                !field->area->materials[square->material].reflecting.has_levels &&
                ++squares.count == GROUP) {
                make_cells(field, &squares, cells, scratch);
            }
        }
    }
    if (squares.count > 0) {
        make_cells(field, &squares, cells, scratch);
    }
}

void burnish_near_cells_make(burnish_near_cells *cells, const burnish_near_field *field,
                             const burnish_tile *tile, burnish_near_scratch *scratch) {
    cells->left = (float)(2 * tile->x - field->view->width) * 0.5f;
    cells->top = (float)(field->view->height - 2 * tile->y) * 0.5f;
    cells->count = 0;
    memset(cells->cell, 0xff, sizeof cells->cell);
    make_size(field, tile, LARGE, cells, scratch);
    make_size(field, tile, BURNISH_NEAR_CELL, cells, scratch);
}
