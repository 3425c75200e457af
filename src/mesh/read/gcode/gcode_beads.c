/* Rods along the path: four sides whose normals bend a little toward their edges, so that rods can be
 * told apart, but those below a pixel do not flicker. As wide as the distance at which slicers put
 * them beside each other. */
#include "mesh/read/gcode/gcode.h"

#include "core/vec3.h"

enum { SIDES = 4, CORNERS = 2 * SIDES /* of a ring */, GRAIN = 1 << 12 };

/* Of the width: how far rods go beyond the ends of a path. */
#define BEYOND 0.4

/* A unit normal of a side at its edge: toward it, and in the direction of the side. */
#define BEND 0.28
#define FACING 0.96

#define PI 3.14159265358979324

typedef struct maker {
    const burnish_gcode *gcode;
    double area; /* of the filament */
    double wanted_width;
    float *positions, *normals;
} maker;

static int ends_path(const burnish_gcode *g, size_t i) {
    return i + 1 == g->count || g->points[i + 1].is_start;
}

static burnish_vec3 direction(const burnish_gcode *g, size_t i) {
    return burnish_vec3_normalize(burnish_vec3_sub(burnish_vec3_loadf(g->points[i + 1].position),
                                                   burnish_vec3_loadf(g->points[i].position)));
}

/* The distance of neighbouring rods, of which one ends at the point: w - h (1 - pi / 4). */
static double find_width(const maker *m, const burnish_gcode_point *p) {
    const double h = (double)p->height;
    const double flow = p->length > 0 ? (double)p->filament / (double)p->length : 0;
    const double width = m->wanted_width > 0 ? m->wanted_width
                         : p->width > 0      ? (double)p->width - h * (1 - PI / 4)
                                             : m->area * flow / h;
    const double most = 4 * h > 2 ? 4 * h : 2;
    return width < h / 4 ? h / 4 : width < most || m->wanted_width > 0 ? width : most;
}

/* A ring around a point, across a direction, moved along it. */
static void write_ring(const maker *m, size_t point, burnish_vec3 along, double half,
                       double beyond) {
    static const double signs[SIDES + 1][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    const burnish_gcode_point *p = &m->gcode->points[point];
    const double height = (double)p->height, drawn = height * m->gcode->layer_step;
    const int is_upright = along.z > 0.9 || along.z < -0.9;
    const burnish_vec3 flat = {along.y, -along.x, 0};
    const burnish_vec3 side = is_upright ? (burnish_vec3){1, 0, 0} : burnish_vec3_normalize(flat);
    const burnish_vec3 up = is_upright ? (burnish_vec3){0, 1, 0} : (burnish_vec3){0, 0, 1};
    const burnish_vec3 nozzle = burnish_vec3_loadf(p->position);
    burnish_vec3 center = burnish_vec3_add(nozzle, burnish_vec3_scale(along, beyond));
    center = burnish_vec3_sub(center, burnish_vec3_load(m->gcode->reader->mesh->origin));
    center.z += drawn / 2 - height;
    for (size_t k = 0; k < CORNERS; ++k) { /* two for each side */
        const double *sign = signs[(k + 1) / 2];
        const int is_level = k / 2 % 2 == 0; /* the bottom or the top */
        const burnish_vec3 normal =
            burnish_vec3_add(burnish_vec3_scale(side, sign[0] * (is_level ? BEND : FACING)),
                             burnish_vec3_scale(up, sign[1] * (is_level ? FACING : BEND)));
        const burnish_vec3 at =
            burnish_vec3_add(center, burnish_vec3_add(burnish_vec3_scale(side, half * sign[0]),
                                                      burnish_vec3_scale(up, drawn / 2 * sign[1])));
        float *to = m->positions + 3 * (CORNERS * point + k);
        float *n = m->normals + 3 * (CORNERS * point + k);
        to[0] = (float)at.x;
        to[1] = (float)at.y;
        to[2] = (float)at.z;
        n[0] = (float)normal.x;
        n[1] = (float)normal.y;
        n[2] = (float)normal.z;
    }
}

static void make_rings(void *user_data, size_t first, size_t end) {
    const maker *m = user_data;
    for (size_t i = first; i < end; ++i) {
        const burnish_gcode_point *p = &m->gcode->points[i];
        const int is_end = ends_path(m->gcode, i), is_start = p->is_start;
        const double width = find_width(m, is_start && !is_end ? p + 1 : p), half = width / 2;
        const burnish_vec3 after = is_end ? (burnish_vec3){0} : direction(m->gcode, i);
        const burnish_vec3 before = is_start ? after : direction(m->gcode, i - 1);
        if (is_start || is_end) {
            write_ring(m, i, before, half, is_start ? -BEYOND * width : BEYOND * width);
        } else {
            const burnish_vec3 middle = burnish_vec3_normalize(burnish_vec3_add(before, after));
            const double slant = burnish_vec3_dot(middle, before); /* 0: without directions */
            write_ring(m, i, middle, slant > 0.5 ? half / slant : half, 0);
        }
    }
}

/* Joins the rings of a rod. Returns the triangles after it. */
static size_t join_rings(burnish_mesh_data *mesh, size_t point, size_t triangle,
                         const burnish_gcode_point *p) {
    uint32_t *corners = mesh->streams[BURNISH_POSITION].corners + 3 * triangle;
    const uint32_t to = (uint32_t)(CORNERS * point), from = to - CORNERS;
    const size_t end = triangle + BURNISH_GCODE_TRIANGLES;
    for (uint32_t k = 0; k < CORNERS; k += 2, corners += 6) {
        const uint32_t quad[6] = {from + k, to + k, to + k + 1, from + k, to + k + 1, from + k + 1};
        memcpy(corners, quad, sizeof quad);
    }
    for (size_t i = triangle; i < end; ++i) {
        if (mesh->triangle_materials) {
            mesh->triangle_materials[i] = p->tool;
        }
        if (mesh->triangle_parts) {
            mesh->triangle_parts[i] = p->feature;
        }
    }
    return end;
}

static void bound(burnish_mesh_data *mesh) {
    const float *positions = burnish_positions(mesh);
    for (size_t i = 0; i < 3 * mesh->streams[BURNISH_POSITION].count; ++i) {
        float *low = &mesh->points_min[i % 3], *high = &mesh->points_max[i % 3];
        *low = i < 3 || positions[i] < *low ? positions[i] : *low;
        *high = i < 3 || positions[i] > *high ? positions[i] : *high;
    }
}

burnish_status burnish_gcode_make_beads(burnish_gcode *g) {
    burnish_mesh_data *mesh = g->reader->mesh;
    const size_t vertices = CORNERS * g->count, triangles = BURNISH_GCODE_TRIANGLES * g->count;
    burnish_mesh_data_reserve(mesh, BURNISH_POSITION, vertices);
    burnish_mesh_data_reserve(mesh, BURNISH_NORMAL, vertices);
    burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, triangles);
    if (mesh->material_count > 1) {
        mesh->triangle_materials =
            burnish_reserve(g->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
                            triangles, sizeof *mesh->triangle_materials, "triangle materials");
    }
    if (mesh->part_count > 0) {
        mesh->triangle_parts =
            burnish_reserve(g->memory, mesh->triangle_parts, &mesh->triangle_part_capacity,
                            triangles, sizeof *mesh->triangle_parts, "triangle parts");
    }
    if (g->memory->status != BURNISH_STATUS_OK) {
        return g->memory->status;
    }
    const double d = (double)g->diameter;
    const maker m = {.gcode = g,
                     .area = PI / 4 * d * d,
                     .wanted_width = g->reader->input->options->point_size,
                     .positions = burnish_positions(mesh),
                     .normals = burnish_normals(mesh)};
    mesh->streams[BURNISH_POSITION].count = mesh->streams[BURNISH_NORMAL].count = vertices;
    mesh->line_count = g->line_count;
    burnish_tasks_ranges(mesh->tasks, g->count, GRAIN, make_rings, (void *)(uintptr_t)&m);
    for (size_t i = 0; i < g->count; ++i) {
        if (!g->points[i].is_start) {
            mesh->triangle_count = join_rings(mesh, i, mesh->triangle_count, &g->points[i]);
        }
    }
    bound(mesh);
    return burnish_tasks_check(mesh->tasks, g->reader->error);
}
