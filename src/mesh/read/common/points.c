/* Points and lines as solids: an icosahedron each for up to POINTS_ROUND points, octahedra for
 * more, six-sided prisms for lines. */
#include "mesh/read/common/points.h"

#include <float.h>
#include <stdlib.h>

#include "core/vector.h"
#include "mesh/read/io/budget.h"

enum {
    POINTS_ROUND = 100000,
    SAMPLES = 1024,       /* points whose nearest neighbour is searched */
    CELLS_MOST = 1 << 22, /* of the grid that finds it */
    PER_CELL = 2048,      /* points of a cell that are examined: more are at one position */
    SIDES = 6,            /* of a prism */
    GRAIN = 1 << 10
};

/* ---- Density ---- */

typedef struct box {
    double low[3], size[3];
} box;

static box bounds_of(const float *positions, size_t count) {
    box bounds;
    for (int k = 0; k < 3; ++k) {
        float low = positions[k], high = positions[k];
        for (size_t i = 1; i < count; ++i) {
            const float value = positions[3 * i + (size_t)k];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        bounds.low[k] = low;
        bounds.size[k] = (double)high - low;
    }
    return bounds;
}

/* Points sorted by cell: cell c has order[first[c]] to order[first[c + 1]]. */
typedef struct grid {
    const float *positions;
    box bounds;
    size_t cells[3];
    double scale; /* cells per unit */
    uint32_t *first, *order;
} grid;

static size_t cell_along(const grid *g, size_t axis, double value) {
    const double at = (value - g->bounds.low[axis]) * g->scale;
    const size_t last = g->cells[axis] - 1;
    return at <= 0 ? 0 : at >= (double)last ? last : (size_t)at;
}

static size_t cell_of(const grid *g, const float *p) {
    return (cell_along(g, 2, p[2]) * g->cells[1] + cell_along(g, 1, p[1])) * g->cells[0] +
           cell_along(g, 0, p[0]);
}

/* About as many cells as points, all cubes of one size. */
static void size_grid(grid *g, size_t count) {
    const double most = count < CELLS_MOST ? (double)count : CELLS_MOST;
    double longest = g->bounds.size[0];
    for (int k = 1; k < 3; ++k) {
        longest = g->bounds.size[k] > longest ? g->bounds.size[k] : longest;
    }
    double along = 1; /* cells along the longest side: doubled while there are few enough */
    for (;; along *= 2) {
        double cells = 1;
        for (int k = 0; k < 3; ++k) {
            const double n = g->bounds.size[k] / longest * 2 * along;
            cells *= n < 1 ? 1 : n + 1;
        }
        if (!(cells <= 2 * most) || along > 1 << 20) {
            break;
        }
    }
    g->scale = along / longest;
    for (int k = 0; k < 3; ++k) {
        g->cells[k] = (size_t)(g->bounds.size[k] * g->scale) + 1;
    }
}

static burnish_status fill_grid(grid *g, size_t count, burnish_memory *memory) {
    const size_t cells = g->cells[0] * g->cells[1] * g->cells[2];
    g->first = burnish_allocate_zeroed(memory, cells + 2, sizeof *g->first, "a grid of points");
    g->order = burnish_allocate(memory, count, sizeof *g->order, "a grid of points");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    for (size_t i = 0; i < count; ++i) {
        ++g->first[cell_of(g, g->positions + 3 * i) + 2];
    }
    for (size_t c = 2; c < cells + 2; ++c) {
        g->first[c] += g->first[c - 1];
    }
    for (size_t i = 0; i < count; ++i) { /* moves each start to its end, which is the next one's */
        g->order[g->first[cell_of(g, g->positions + 3 * i) + 1]++] = (uint32_t)i;
    }
    return BURNISH_STATUS_OK;
}

static double square_distance(const float *a, const float *b) {
    const burnish_vec3 d = burnish_vec3_sub(burnish_vec3_loadf(a), burnish_vec3_loadf(b));
    return burnish_vec3_dot(d, d);
}

/* The square of the distance to the nearest other position in the 27 cells around a point; 0 if
 * there is none. */
static double nearest(const grid *g, const float *p) {
    size_t low[3], high[3];
    double best = 0;
    for (size_t k = 0; k < 3; ++k) {
        const size_t at = cell_along(g, k, p[k]);
        low[k] = at > 0 ? at - 1 : 0;
        high[k] = at + 1 < g->cells[k] ? at + 1 : at;
    }
    for (size_t z = low[2]; z <= high[2]; ++z) {
        for (size_t y = low[1]; y <= high[1]; ++y) {
            for (size_t x = low[0]; x <= high[0]; ++x) {
                const size_t cell = (z * g->cells[1] + y) * g->cells[0] + x;
                const size_t end = g->first[cell + 1] - g->first[cell] < PER_CELL
                                       ? g->first[cell + 1]
                                       : g->first[cell] + PER_CELL;
                for (size_t i = g->first[cell]; i < end; ++i) {
                    const double d = square_distance(p, g->positions + 3 * (size_t)g->order[i]);
                    best = d > 0 && (best == 0 || d < best) ? d : best;
                }
            }
        }
    }
    return best;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median distance of some points to their nearest neighbours; 0 if all are isolated. */
static double median_distance(const box *bounds, const float *positions, size_t count,
                              burnish_memory *memory) {
    grid g = {.positions = positions, .bounds = *bounds};
    double found[SAMPLES], median = 0;
    size_t samples = 0;
    size_grid(&g, count);
    if (fill_grid(&g, count, memory) == BURNISH_STATUS_OK) {
        const size_t step = count / SAMPLES + 1;
        for (size_t i = 0; i < count && samples < SAMPLES; i += step) {
            const double d = nearest(&g, positions + 3 * i);
            found[samples] = d;
            samples += d > 0;
        }
        qsort(found, samples, sizeof *found, compare_doubles);
        median = samples > 0 ? __builtin_sqrt(found[samples / 2]) : 0;
    }
    burnish_release(memory->context, g.first);
    burnish_release(memory->context, g.order);
    return median;
}

static double diameter_of(burnish_mesh_data *mesh, size_t segments, double wanted) {
    const box bounds = bounds_of(burnish_positions(mesh), mesh->streams[BURNISH_POSITION].count);
    const double diagonal = burnish_vec3_length(burnish_vec3_load(bounds.size));
    if (wanted > 0 || !(diagonal > 0)) {
        return wanted > 0 ? wanted : 1;
    }
    const double size =
        segments > 0 ? diagonal / 300
                     : 2 * median_distance(&bounds, burnish_positions(mesh),
                                           mesh->streams[BURNISH_POSITION].count, &mesh->memory);
    return size > diagonal / 25 ? diagonal / 25 : size < diagonal / 2000 ? diagonal / 2000 : size;
}

/* ---- Solids ---- */

/* Unit directions of a solid's vertices, and its triangles, wound outward. */
typedef struct solid {
    int vertex_count, triangle_count;
    const float (*directions)[3];
    const uint8_t (*triangles)[3];
} solid;

static const float octahedron_directions[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                                  {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
static const uint8_t octahedron_triangles[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                   {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

/* (0, +-1, +-phi) / |(1, phi)| and its turns, phi the golden ratio */
#define ICO_A 0.525731112f
#define ICO_B 0.850650808f
static const float icosahedron_directions[12][3] = {
    {-ICO_A, ICO_B, 0}, {ICO_A, ICO_B, 0}, {-ICO_A, -ICO_B, 0}, {ICO_A, -ICO_B, 0},
    {0, -ICO_A, ICO_B}, {0, ICO_A, ICO_B}, {0, -ICO_A, -ICO_B}, {0, ICO_A, -ICO_B},
    {ICO_B, 0, -ICO_A}, {ICO_B, 0, ICO_A}, {-ICO_B, 0, -ICO_A}, {-ICO_B, 0, ICO_A}};
static const uint8_t icosahedron_triangles[20][3] = {
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};

static const solid octahedron = {6, 8, octahedron_directions, octahedron_triangles};
static const solid icosahedron = {12, 20, icosahedron_directions, icosahedron_triangles};

typedef struct maker {
    const float *positions, *normals; /* the points'; NULL: a ball's */
    const uint8_t *colors;            /* NULL: none */
    const burnish_segment *segments;
    const solid *shape;
    double radius;
    float *to_positions, *to_normals;
    uint8_t *to_colors;
    uint32_t *to_corners;
} maker;

static void write_vertex(const maker *m, size_t vertex, const float *center, const float *normal,
                         burnish_vec3 offset, size_t point) {
    const double offsets[3] = {offset.x, offset.y, offset.z};
    for (size_t k = 0; k < 3; ++k) {
        const double at =
            center[k] + offsets[k]; /* of a point at the end of the range, beyond it */
        m->to_positions[3 * vertex + k] = (float)(at > FLT_MAX    ? FLT_MAX
                                                  : at < -FLT_MAX ? -FLT_MAX
                                                                  : at);
        m->to_normals[3 * vertex + k] = normal[k];
    }
    if (m->colors) {
        memcpy(m->to_colors + 4 * vertex, m->colors + 4 * point, 4);
    }
}

static void make_balls(void *user_data, size_t first, size_t end) {
    const maker *m = user_data;
    const size_t vertices = (size_t)m->shape->vertex_count;
    const size_t triangles = (size_t)m->shape->triangle_count;
    for (size_t i = first; i < end; ++i) {
        for (size_t k = 0; k < vertices; ++k) {
            const float *direction = m->shape->directions[k];
            const float *normal = m->normals ? m->normals + 3 * i : direction;
            write_vertex(m, vertices * i + k, m->positions + 3 * i, normal,
                         burnish_vec3_scale(burnish_vec3_loadf(direction), m->radius), i);
        }
        for (size_t k = 0; k < 3 * triangles; ++k) {
            m->to_corners[3 * triangles * i + k] =
                (uint32_t)(vertices * i + m->shape->triangles[k / 3][k % 3]);
        }
    }
}

/* Two unit vectors across a line. */
static void find_frame(burnish_vec3 along, burnish_vec3 *u, burnish_vec3 *v) {
    const double x = along.x < 0 ? -along.x : along.x, y = along.y < 0 ? -along.y : along.y;
    const burnish_vec3 other = x < y ? (burnish_vec3){1, 0, 0} : (burnish_vec3){0, 1, 0};
    *u = burnish_vec3_normalize(burnish_vec3_cross(along, other));
    *v = burnish_vec3_cross(along, *u);
}

static void make_prisms(void *user_data, size_t first, size_t end) {
    static const double cosine[SIDES] = {1, 0.5, -0.5, -1, -0.5, 0.5};
    const double s = 0.86602540378443865;
    const double sine[SIDES] = {0, s, s, 0, -s, -s};
    const maker *m = user_data;
    for (size_t i = first; i < end; ++i) {
        const uint32_t ends[2] = {m->segments[i].from, m->segments[i].to};
        const burnish_vec3 from = burnish_vec3_loadf(m->positions + 3 * (size_t)ends[0]);
        const burnish_vec3 to = burnish_vec3_loadf(m->positions + 3 * (size_t)ends[1]);
        const burnish_vec3 along = burnish_vec3_normalize(burnish_vec3_sub(to, from));
        burnish_vec3 u, v;
        find_frame(along, &u, &v);
        const size_t base = 2 * SIDES * i;
        for (size_t k = 0; k < 2 * SIDES; ++k) {
            const size_t side = k % SIDES, point = ends[k / SIDES];
            const burnish_vec3 spoke = burnish_vec3_add(burnish_vec3_scale(u, cosine[side]),
                                                        burnish_vec3_scale(v, sine[side]));
            const float normal[3] = {(float)spoke.x, (float)spoke.y, (float)spoke.z};
            write_vertex(m, base + k, m->positions + 3 * point, normal,
                         burnish_vec3_scale(spoke, m->radius), point);
        }
        for (size_t k = 0; k < SIDES; ++k) {
            const size_t next = (k + 1) % SIDES;
            const size_t quad[6] = {k, next, SIDES + next, k, SIDES + next, SIDES + k};
            for (size_t c = 0; c < 6; ++c) {
                m->to_corners[6 * (SIDES * i + k) + c] = (uint32_t)(base + quad[c]);
            }
        }
    }
}

static const float *normals_of(const burnish_mesh_data *mesh) {
    const burnish_stream *normals = &mesh->streams[BURNISH_NORMAL];
    return normals->count == mesh->streams[BURNISH_POSITION].count && !normals->corners
               ? normals->items
               : NULL;
}

/* Replaces the mesh's arrays. */
static burnish_status make(burnish_reader *reader, maker *m, size_t count, size_t vertices,
                           size_t triangles) {
    burnish_mesh_data *mesh = reader->mesh;
    burnish_mesh_data made = {.memory = mesh->memory, .tasks = mesh->tasks};
    burnish_mesh_data_reserve(&made, BURNISH_POSITION, vertices * count);
    burnish_mesh_data_reserve(&made, BURNISH_NORMAL, vertices * count);
    burnish_mesh_data_reserve_corners(&made, BURNISH_POSITION, triangles * count);
    if (m->colors) {
        burnish_mesh_data_reserve(&made, BURNISH_COLOR, vertices * count);
    }
    if (made.memory.status == BURNISH_STATUS_OK) {
        m->to_positions = burnish_positions(&made);
        m->to_normals = burnish_normals(&made);
        m->to_colors = burnish_colors(&made);
        m->to_corners = made.streams[BURNISH_POSITION].corners;
        burnish_tasks_ranges(mesh->tasks, count, GRAIN, m->segments ? make_prisms : make_balls, m);
    }
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_mesh_data_drop(mesh, (burnish_attribute)i);
        mesh->streams[i] = made.streams[i];
        mesh->streams[i].count = made.streams[i].items ? vertices * count : 0;
    }
    mesh->triangle_count = triangles * count;
    mesh->memory.status = made.memory.status;
    return made.memory.status == BURNISH_STATUS_OK ? burnish_tasks_check(mesh->tasks, reader->error)
                                                   : made.memory.status;
}

/* The bounds of all points, or of the lines' ends: without the solids around them. */
static void bound_points(burnish_mesh_data *mesh, const burnish_segment *segments, size_t count) {
    const float *positions = burnish_positions(mesh);
    const size_t points = count > 0 ? 2 * count : mesh->streams[BURNISH_POSITION].count;
    for (size_t i = 0; i < points; ++i) {
        const size_t end = count == 0 ? i : i % 2 == 0 ? segments[i / 2].from : segments[i / 2].to;
        for (size_t k = 0; k < 3; ++k) {
            const float value = positions[3 * end + k];
            float *low = &mesh->points_min[k], *high = &mesh->points_max[k];
            *low = i == 0 || value < *low ? value : *low;
            *high = i == 0 || value > *high ? value : *high;
        }
    }
}

/* The solid of a point; lines become prisms. */
static const solid *shape_of(const burnish_reader *reader, size_t points) {
    return points <= POINTS_ROUND && points * 20 <= reader->input->options->max_triangles
               ? &icosahedron
               : &octahedron;
}

burnish_status burnish_check_points(burnish_reader *reader, size_t count, int are_lines) {
    const solid *shape = shape_of(reader, count);
    const size_t vertices = are_lines ? 2 * SIDES : (size_t)shape->vertex_count;
    const size_t triangles = are_lines ? 2 * SIDES : (size_t)shape->triangle_count;
    const uint64_t limit = reader->input->options->max_triangles;
    if (count > limit / triangles || count > BURNISH_VALUE_LIMIT / vertices) {
        return burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, NULL,
                                   "%zu %s are too many: each is drawn as %zu triangles; thin them "
                                   "out",
                                   count, are_lines ? "lines" : "points", triangles);
    }
    return burnish_budget_check(reader, (uint64_t)count * vertices, (uint64_t)count * triangles);
}

burnish_status burnish_make_points(burnish_reader *reader, const burnish_segment *segments,
                                   size_t count) {
    burnish_mesh_data *mesh = reader->mesh;
    const size_t points = mesh->streams[BURNISH_POSITION].count;
    const solid *shape = shape_of(reader, points);
    const size_t items = count > 0 ? count : points;
    const size_t vertices = count > 0 ? 2 * SIDES : (size_t)shape->vertex_count;
    const size_t triangles = count > 0 ? 2 * SIDES : (size_t)shape->triangle_count;
    const burnish_status status = burnish_check_points(reader, items, count > 0);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    maker m = {.positions = burnish_positions(mesh),
               .normals = count > 0 ? NULL : normals_of(mesh),
               .colors = burnish_colors(mesh),
               .segments = count > 0 ? segments : NULL,
               .shape = shape,
               .radius = diameter_of(mesh, count, reader->input->options->point_size) / 2};
    if (mesh->memory.status != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    bound_points(mesh, segments, count);
    mesh->point_count = count > 0 ? 0 : points;
    mesh->line_count = count;
    return make(reader, &m, items, vertices, triangles);
}
