/* Points: their size and normals. Lines: rods of eight sides, with round ends if they are few. */
#include "mesh/read/common/points.h"

#include "mesh/read/common/damage.h"

#include <float.h>

#include "core/vec3.h"
#include "mesh/read/common/cloud.h"
#include "mesh/read/common/splats.h"
#include "mesh/read/io/budget.h"

enum {
    SIDES = 8, /* of a rod */
    RINGS = 6, /* of vertices, of a rod with round ends; without them 2 */
    ROUND_LINES = 20000,
    GRAIN = 1 << 10
};

/* ---- Points ---- */

/* Of randomly sampled surfaces, discs with a radius of so many spacings leave 0.01 % uncovered. */
#define CLOSING 1.2

/* Discs that would have to be larger, in parts of the cloud, do not look like a surface: balls do
 * better. */
#define LARGEST (1.0 / 20)

static int can_close(const burnish_cloud *cloud) {
    return CLOSING * cloud->wide <= LARGEST * burnish_cloud_diagonal(&cloud->inner);
}

/* Discs of points that are close together, in clusters far apart, would vanish: all of the cloud
 * cover at least about 2 % of its square. */
static double choose_radius(const burnish_cloud *cloud, int are_surface) {
    const double diagonal = burnish_cloud_diagonal(&cloud->inner);
    const double radius = are_surface ? CLOSING * cloud->wide : cloud->spacing / 4;
    const double most = are_surface ? diagonal * LARGEST : diagonal / 50;
    const double root = __builtin_sqrt((double)cloud->count), least = diagonal / 4000;
    const double even = root * least > diagonal / 12 ? least : diagonal / 12 / root;
    return !(diagonal > 0)                ? 0.5
           : radius > most || even > most ? most
           : radius < even                ? even
                                          : radius;
}

/* Makes the file's normals unit vectors; those of no direction 0, 0, 0. */
static void normalize_normals(void *user_data, size_t first, size_t end) {
    float *normals = user_data;
    for (size_t i = first; i < end; ++i) {
        const burnish_vec3 n = burnish_vec3_normalize(burnish_vec3_loadf(normals + 3 * i));
        const int is_finite = n.x * n.x + n.y * n.y + n.z * n.z <= 2;
        normals[3 * i] = is_finite ? (float)n.x : 0;
        normals[3 * i + 1] = is_finite ? (float)n.y : 0;
        normals[3 * i + 2] = is_finite ? (float)n.z : 0;
    }
}

static int has_gaps(const burnish_stream *stream) {
    const float *normals = stream->items;
    size_t gaps = 0;
    for (size_t i = 0; i < stream->count; ++i) {
        gaps += burnish_vec3_length(burnish_vec3_loadf(normals + 3 * i)) < 0.5;
    }
    return gaps > stream->count / 100;
}

static burnish_status prepare_normals(burnish_reader *reader, const burnish_cloud *cloud,
                                      int *are_surface) {
    burnish_mesh_data *mesh = reader->mesh;
    const burnish_stream *stream = &mesh->streams[BURNISH_NORMAL];
    const burnish_load_options *options = reader->input->options;
    const int has_some = stream->count == cloud->count && !stream->corners;
    const int are_balls =
        options->normals != BURNISH_NORMALS_FILE && options->point_size == 0 && !can_close(cloud);
    *are_surface = 1;
    if (has_some && options->normals != BURNISH_NORMALS_OWN && !are_balls) {
        burnish_tasks_ranges(mesh->tasks, cloud->count, GRAIN, normalize_normals, stream->items);
        if (options->normals == BURNISH_NORMALS_FILE || !has_gaps(stream)) {
            return burnish_tasks_check(mesh->tasks, reader->error);
        }
        burnish_reader_warn(reader, NULL,
                            "more than 1 %% of the normals are 0 or not numbers, so all are "
                            "estimated; --normals=file keeps them");
    }
    burnish_mesh_data_drop(mesh, BURNISH_NORMAL);
    if (burnish_mesh_data_reserve(mesh, BURNISH_NORMAL, cloud->count) != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    mesh->streams[BURNISH_NORMAL].count = cloud->count;
    if (are_balls || options->normals == BURNISH_NORMALS_FILE) {
        *are_surface = 0;
        memset(burnish_normals(mesh), 0, 3 * cloud->count * sizeof(float));
        return BURNISH_STATUS_OK;
    }
    return burnish_cloud_normals(cloud, burnish_normals(mesh), are_surface, mesh->tasks,
                                 &mesh->memory);
}

/* What is framed around the centres of splats: most of one, but little of the whole. */
static double splat_radius(const burnish_cloud *cloud, double size) {
    const double most = burnish_cloud_diagonal(&cloud->inner) / 10;
    size = most > 0 && 3 * size > most ? most : 3 * size;
    return size < 1e30 ? size : 1e30;
}

/* A length of which sums with coordinates differ. */
static double least_radius(const burnish_cloud *cloud) {
    double least = (double)FLT_MIN;
    for (int k = 0; k < 3; ++k) {
        const double low = (double)cloud->inner.low[k], high = (double)cloud->inner.high[k];
        const double most = (high > -low ? high : -low) * 0x1p-20;
        least = most > least ? most : least;
    }
    return least;
}

static burnish_status zero_normals(burnish_mesh_data *mesh) {
    burnish_stream *stream = &mesh->streams[BURNISH_NORMAL];
    burnish_mesh_data_drop(mesh, BURNISH_COLOR);
    burnish_mesh_data_drop(mesh, BURNISH_NORMAL);
    if (burnish_mesh_data_reserve(mesh, BURNISH_NORMAL, mesh->point_count) == BURNISH_STATUS_OK) {
        stream->count = mesh->point_count;
        memset(stream->items, 0, 3 * stream->count * sizeof(float));
    }
    return mesh->memory.status;
}

/* The bounds of all points are the mesh's; the inner ones are what is framed. */
static void note_outliers(burnish_reader *reader, const burnish_cloud *cloud) {
    burnish_mesh_data *mesh = reader->mesh;
    memcpy(mesh->inner_min, cloud->inner.low, sizeof mesh->inner_min);
    memcpy(mesh->inner_max, cloud->inner.high, sizeof mesh->inner_max);
    if (cloud->outside > 0 && !cloud->are_splats) { /* whose surroundings are usual */
        burnish_mesh_data_warn(mesh,
                               "%s: %zu of %zu points are far from the others, so the picture is "
                               "framed without them; remove them, or set the camera",
                               burnish_show_name(reader->input->name).text, cloud->outside,
                               cloud->count);
    }
}

static burnish_status make_cloud(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    const double wanted = reader->input->options->point_size;
    const size_t count = mesh->streams[BURNISH_POSITION].count;
    int are_surface = 0;
    float *visible = NULL; /* of splats */
    double size = 0;
    burnish_cloud cloud = {.positions = burnish_positions(mesh), .count = count};
    burnish_status status = burnish_check_points(reader, cloud.count, 0);
    if (status == BURNISH_STATUS_OK && mesh->streams[BURNISH_SPLAT].count > 0) {
        status = burnish_visible_splats(mesh, &visible, &cloud.count, &size);
        cloud.positions = visible;
        cloud.are_splats = 1;
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_cloud_measure(&cloud, &mesh->memory);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_release(mesh->memory.context, cloud.order);
        burnish_release(mesh->memory.context, visible);
        return status;
    }
    note_outliers(reader, &cloud);
    if (!reader->input->options->scalar_property) {
        burnish_mesh_data_drop(mesh, BURNISH_TEXCOORD);
    }
    burnish_mesh_data_drop(mesh, BURNISH_TANGENT);
    mesh->point_count = count;
    status = visible ? zero_normals(mesh) : prepare_normals(reader, &cloud, &are_surface);
    burnish_release(mesh->memory.context, cloud.order);
    burnish_release(mesh->memory.context, visible);
    const double radius = visible      ? splat_radius(&cloud, size)
                          : wanted > 0 ? wanted / 2
                                       : choose_radius(&cloud, are_surface);
    const double least = least_radius(&cloud);
    mesh->point_radius = (float)(radius > least ? radius : least);
    return status;
}

/* ---- Lines ---- */

typedef struct maker {
    const float *positions;
    const uint8_t *colors; /* NULL: none */
    const burnish_segment *segments;
    double radius;
    size_t rings;
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

/* Two unit vectors across a line. */
static void find_frame(burnish_vec3 along, burnish_vec3 *u, burnish_vec3 *v) {
    const double x = along.x < 0 ? -along.x : along.x, y = along.y < 0 ? -along.y : along.y;
    const burnish_vec3 other = x < y ? (burnish_vec3){1, 0, 0} : (burnish_vec3){0, 1, 0};
    *u = burnish_vec3_normalize(burnish_vec3_cross(along, other));
    *v = burnish_vec3_cross(along, *u);
}

/* The rings of a rod: their radius, and how far they are beyond their end, in radii of the rod. On a
 * unit sphere, so these are the normals too; the first and the last ring are points. */
static const double profile[RINGS][2] = {{0, -1}, {0.8, -0.6}, {1, 0}, {1, 0}, {0.8, 0.6}, {0, 1}};

static void make_ring(const maker *m, const burnish_vec3 axes[3], size_t ring, size_t vertex,
                      uint32_t point) {
    const double h = 0.70710678118654752;
    const double cosine[SIDES] = {1, h, 0, -h, -1, -h, 0, h};
    const double sine[SIDES] = {0, h, 1, h, 0, -h, -1, -h};
    for (size_t k = 0; k < SIDES; ++k) {
        const burnish_vec3 spoke = burnish_vec3_add(burnish_vec3_scale(axes[1], cosine[k]),
                                                    burnish_vec3_scale(axes[2], sine[k]));
        const burnish_vec3 out = burnish_vec3_add(burnish_vec3_scale(spoke, profile[ring][0]),
                                                  burnish_vec3_scale(axes[0], profile[ring][1]));
        const float normal[3] = {(float)out.x, (float)out.y, (float)out.z};
        write_vertex(m, vertex + k, m->positions + 3 * (size_t)point, normal,
                     burnish_vec3_scale(out, m->radius), point);
    }
}

/* Triangles of a rod; at the points of its ends there is one per side. */
static size_t count_triangles(size_t rings) {
    return 2 * SIDES * (rings - 1) - (rings == RINGS ? 2 * SIDES : 0);
}

/* Joins the rings of a rod, whose vertices start at `base`. */
static void join_rings(size_t rings, size_t base, uint32_t *corners) {
    for (size_t k = 0; k < SIDES * (rings - 1); ++k) {
        const size_t row = k / SIDES, next = row * SIDES + (k + 1) % SIDES;
        const size_t quad[6] = {k, next, SIDES + next, k, SIDES + next, SIDES + k};
        const size_t first = rings == RINGS && row == 0 ? 3 : 0;
        const size_t end = rings == RINGS && row == RINGS - 2 ? 3 : 6;
        for (size_t c = first; c < end; ++c) {
            *corners++ = (uint32_t)(base + quad[c]);
        }
    }
}

static void make_rods(void *user_data, size_t first, size_t end) {
    const maker *m = user_data;
    const size_t skipped = (RINGS - m->rings) / 2;
    for (size_t i = first; i < end; ++i) {
        const uint32_t ends[2] = {m->segments[i].from, m->segments[i].to};
        const burnish_vec3 from = burnish_vec3_loadf(m->positions + 3 * (size_t)ends[0]);
        const burnish_vec3 to = burnish_vec3_loadf(m->positions + 3 * (size_t)ends[1]);
        burnish_vec3 axes[3] = {burnish_vec3_normalize(burnish_vec3_sub(to, from))};
        find_frame(axes[0], &axes[1], &axes[2]);
        const size_t base = SIDES * m->rings * i;
        for (size_t ring = 0; ring < m->rings; ++ring) {
            make_ring(m, axes, skipped + ring, base + SIDES * ring, ends[2 * ring >= m->rings]);
        }
        join_rings(m->rings, base, m->to_corners + 3 * count_triangles(m->rings) * i);
    }
}

/* Replaces the mesh's arrays. */
static burnish_status make_solids(burnish_reader *reader, maker *m, size_t count) {
    const size_t vertices = SIDES * m->rings, triangles = count_triangles(m->rings);
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
        burnish_tasks_ranges(mesh->tasks, count, GRAIN, make_rods, m);
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

/* The bounds of the lines' ends: without the rods around them. */
static void bound_ends(burnish_mesh_data *mesh, const burnish_segment *segments, size_t count) {
    const float *positions = burnish_positions(mesh);
    for (size_t i = 0; i < 2 * count; ++i) {
        const size_t end = i % 2 == 0 ? segments[i / 2].from : segments[i / 2].to;
        for (size_t k = 0; k < 3; ++k) {
            const float value = positions[3 * end + k];
            float *low = &mesh->points_min[k], *high = &mesh->points_max[k];
            *low = i == 0 || value < *low ? value : *low;
            *high = i == 0 || value > *high ? value : *high;
        }
    }
}

static double line_diameter(const burnish_mesh_data *mesh, double wanted) {
    burnish_vec3 low = burnish_vec3_loadf(burnish_positions(mesh)), high = low;
    for (size_t i = 1; i < mesh->streams[BURNISH_POSITION].count; ++i) {
        const burnish_vec3 p = burnish_vec3_loadf(burnish_positions(mesh) + 3 * i);
        low = (burnish_vec3){p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y,
                             p.z < low.z ? p.z : low.z};
        high = (burnish_vec3){p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y,
                              p.z > high.z ? p.z : high.z};
    }
    const double diagonal = burnish_vec3_length(burnish_vec3_sub(high, low));
    return wanted > 0 ? wanted : diagonal > 0 ? diagonal / 300 : 1;
}

burnish_status burnish_check_points(burnish_reader *reader, size_t count, int are_lines) {
    const size_t vertices = are_lines ? 2 * SIDES : 1, triangles = are_lines ? 2 * SIDES : 1;
    const uint64_t limit = reader->input->options->max_triangles;
    if (count > limit / triangles || count > BURNISH_VALUE_LIMIT / vertices) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_LIMIT, NULL,
            are_lines
                ? "%zu lines are too many: each is drawn as 16 triangles; thin them out"
                : "%zu points are too many: each counts as a triangle; raise --max-triangles, "
                  "or thin them out",
            count);
    }
    return burnish_budget_check(reader, (uint64_t)count * vertices, (uint64_t)count * triangles);
}

burnish_status burnish_make_points(burnish_reader *reader, const burnish_segment *segments,
                                   size_t count) {
    burnish_mesh_data *mesh = reader->mesh;
    if (count == 0) {
        burnish_drop_points(reader);
        return mesh->streams[BURNISH_POSITION].count > 0
                   ? make_cloud(reader)
                   : burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                         "no point has finite coordinates; export them again");
    }
    if (reader->damage.count > 0) {
        burnish_fill_positions(mesh);
    }
    const burnish_status status = burnish_check_points(reader, count, 1);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const uint64_t budget = burnish_budget_triangles(reader) / count_triangles(RINGS);
    const size_t most_round = budget < ROUND_LINES ? (size_t)budget : ROUND_LINES;
    maker m = {.positions = burnish_positions(mesh),
               .colors = burnish_colors(mesh),
               .segments = segments,
               .radius = line_diameter(mesh, reader->input->options->point_size) / 2,
               .rings = count <= most_round ? RINGS : 2};
    bound_ends(mesh, segments, count);
    mesh->line_count = count;
    return make_solids(reader, &m, count);
}
