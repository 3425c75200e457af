/* Lines and points beside faces: prisms without light, or tetrahedra if they are many. */
#include "mesh/read/common/beside_faces.h"

#include <float.h>

#include "base/elementary.h"
#include "core/vec3.h"
#include "mesh/read/io/budget.h"

enum { VERTICES_MAX = 6, TRIANGLES_MAX = 8, GRAIN = 1 << 10 };

/* The first half of the vertices is at a line's start. */
typedef struct solid {
    size_t vertices, triangles;
    uint8_t corners[3 * TRIANGLES_MAX];
} solid;
static const solid prism = {6, 8, {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4,
                                   2, 0, 3, 2, 3, 5, 0, 2, 1, 3, 4, 5}},
                   tetrahedron = {4, 4, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2}};

typedef struct solids {
    const burnish_mesh_data *ends;
    const burnish_segment *segments;
    double radius;
    burnish_mesh_data *mesh;
    size_t vertex, triangle; /* the first ones */
    const solid *form;
} solids;

/* From the ends of a line to the vertices of its solid. Points are three times as wide as lines. */
static void find_offsets(burnish_vec3 along, double radius, const solid *form,
                         burnish_vec3 offsets[VERTICES_MAX]) {
    const int is_point = !(burnish_vec3_length(along) > 0), sides = (int)form->vertices / 2;
    const double r = is_point ? 3 * radius : radius, h = 0.86602540378443865;
    const burnish_vec3 axis = is_point ? (burnish_vec3){0, 0, 1} : burnish_vec3_normalize(along);
    const double x = axis.x < 0 ? -axis.x : axis.x, y = axis.y < 0 ? -axis.y : axis.y;
    const burnish_vec3 other = x < y ? (burnish_vec3){1, 0, 0} : (burnish_vec3){0, 1, 0};
    const burnish_vec3 u = burnish_vec3_normalize(burnish_vec3_cross(axis, other));
    const burnish_vec3 v = burnish_vec3_cross(axis, u);
    for (int k = 0; k < 2 * sides; ++k) {
        const burnish_vec3 tilted = burnish_vec3_add(burnish_vec3_scale(u, -0.5),
                                                     burnish_vec3_scale(v, k % 3 == 1 ? h : -h));
        const burnish_vec3 spoke = sides == 2
                                       ? burnish_vec3_scale(k < 2 ? u : v, k % 2 == 0 ? 1 : -1)
                                   : k % 3 == 0 ? u
                                                : tilted;
        const double shift = !is_point ? 0 : k < sides ? -0.7 : 0.7;
        offsets[k] =
            burnish_vec3_scale(burnish_vec3_add(spoke, burnish_vec3_scale(axis, shift)), r);
    }
}

static void make_range(void *user_data, size_t first, size_t end) {
    const solids *s = user_data;
    const float *from = burnish_positions(s->ends);
    const uint8_t *colors = burnish_colors(s->ends);
    for (size_t i = first; i < end; ++i) {
        const size_t ends[2] = {s->segments[i].from, s->segments[i].to};
        const burnish_vec3 along = burnish_vec3_sub(burnish_vec3_loadf(from + 3 * ends[1]),
                                                    burnish_vec3_loadf(from + 3 * ends[0]));
        const solid *form = s->form;
        const size_t base = s->vertex + form->vertices * i, half = form->vertices / 2;
        uint32_t *corners =
            s->mesh->streams[BURNISH_POSITION].corners + 3 * (s->triangle + form->triangles * i);
        burnish_vec3 offsets[VERTICES_MAX];
        find_offsets(along, s->radius, form, offsets);
        for (size_t k = 0; k < form->vertices; ++k) {
            float *to = burnish_positions(s->mesh) + 3 * (base + k);
            const float *at = from + 3 * ends[k / half];
            const double sums[3] = {at[0] + offsets[k].x, at[1] + offsets[k].y,
                                    at[2] + offsets[k].z};
            for (int c = 0; c < 3; ++c) { /* at the end of the range, it may be beyond it */
                to[c] = sums[c] > FLT_MAX    ? FLT_MAX
                        : sums[c] < -FLT_MAX ? -FLT_MAX
                                             : (float)sums[c];
            }
            if (colors) {
                memcpy(burnish_colors(s->mesh) + 4 * (base + k), colors + 4 * ends[k / half], 4);
            }
        }
        for (size_t k = 0; k < 3 * form->triangles; ++k) {
            corners[k] = (uint32_t)(base + form->corners[k]);
        }
    }
}

/* The bounds of faces and of the lines' ends. Returns the diagonal. */
static double bound_both(burnish_mesh_data *mesh, const burnish_mesh_data *ends) {
    const burnish_mesh_data *const both[2] = {mesh, ends};
    double squared = 0;
    for (size_t k = 0; k < 3; ++k) {
        float low = burnish_positions(ends)[k], high = low;
        for (int i = 0; i < 2; ++i) {
            const float *p = burnish_positions(both[i]);
            for (size_t v = 0; v < both[i]->streams[BURNISH_POSITION].count; ++v) {
                low = p[3 * v + k] < low ? p[3 * v + k] : low;
                high = p[3 * v + k] > high ? p[3 * v + k] : high;
            }
        }
        mesh->points_min[k] = low;
        mesh->points_max[k] = high;
        squared += ((double)high - low) * ((double)high - low);
    }
    return burnish_sqrt(squared);
}

/* Room for more items, which are 0, or white. */
static void extend_stream(burnish_mesh_data *mesh, burnish_attribute attribute, size_t count) {
    burnish_stream *stream = &mesh->streams[attribute];
    const size_t size = burnish_attribute_size(attribute);
    uint8_t *items = burnish_reserve(&mesh->memory, stream->items, &stream->capacity, count, size,
                                     "vertices of lines");
    stream->items = items;
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        memset(items + stream->count * size, attribute == BURNISH_COLOR ? 255 : 0,
               (count - stream->count) * size);
        stream->count = count;
    }
}

/* One white material without light, and the numbers of materials up to `count` triangles. */
static void extend_materials(burnish_mesh_data *mesh, size_t count) {
    const int has_several = mesh->material_count > 1;
    burnish_material white = burnish_material_default();
    mesh->triangle_materials =
        burnish_reserve(&mesh->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
                        count, sizeof *mesh->triangle_materials, "triangle materials");
    mesh->materials = burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity,
                                      mesh->material_count + 1, sizeof white, "materials");
    if (mesh->memory.status != BURNISH_STATUS_OK) {
        return;
    }
    white.is_unlit = white.has_diffuse = 1;
    for (int k = 0; k < 3; ++k) {
        white.ambient[k] = white.diffuse[k] = 1;
        white.specular[k] = 0;
    }
    for (size_t i = has_several ? mesh->triangle_count : 0; i < count; ++i) {
        mesh->triangle_materials[i] =
            (uint16_t)(i < mesh->triangle_count ? 0 : mesh->material_count);
    }
    mesh->materials[mesh->material_count++] = white;
}

/* Whether solids of a form are within the limits of the triangles and the budget. */
static int has_room(const burnish_reader *reader, const solid *form, uint64_t count) {
    const burnish_mesh_data *mesh = reader->mesh;
    const uint64_t most = burnish_budget_triangles(reader);
    const uint64_t used = mesh->triangle_count + mesh->streams[BURNISH_POSITION].count;
    return used < most && count <= (most - used) / (form->vertices + form->triangles) &&
           used + form->vertices * count < BURNISH_VALUE_LIMIT;
}

int burnish_fits_beside(burnish_reader *reader, uint64_t count) {
    const size_t materials = reader->mesh->material_count;
    if (materials > 0 && materials <= UINT16_MAX && has_room(reader, &tetrahedron, count)) {
        return 1;
    }
    burnish_reader_warn(reader, NULL,
                        "%llu lines and points are not drawn, as they are too many for a file with "
                        "triangles; thin them out, or export them alone",
                        (unsigned long long)count);
    return 0;
}

burnish_status burnish_add_beside(burnish_reader *reader, const burnish_mesh_data *ends,
                                  const burnish_segment *segments, size_t count) {
    burnish_mesh_data *mesh = reader->mesh;
    burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    const double wanted = reader->input->options->point_size, diagonal = bound_both(mesh, ends);
    const solids s = {.ends = ends,
                      .segments = segments,
                      .radius = (wanted > 0     ? wanted
                                 : diagonal > 0 ? diagonal / 400
                                                : 1) /
                                2,
                      .mesh = mesh,
                      .vertex = positions->count,
                      .triangle = mesh->triangle_count,
                      .form = has_room(reader, &prism, count) ? &prism : &tetrahedron};
    const size_t vertices = s.vertex + s.form->vertices * count, made = s.form->triangles * count;
    if (burnish_colors(ends) && mesh->streams[BURNISH_COLOR].count == 0) {
        extend_stream(mesh, BURNISH_COLOR, s.vertex);
    }
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (mesh->streams[i].count > 0) {
            extend_stream(mesh, (burnish_attribute)i, vertices);
        }
    }
    positions->corners =
        burnish_reserve(&mesh->memory, positions->corners, &positions->corner_capacity,
                        s.triangle + made, 3 * sizeof *positions->corners, "triangles");
    extend_materials(mesh, s.triangle + made);
    if (mesh->memory.status != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    burnish_tasks_ranges(mesh->tasks, count, GRAIN, make_range, (void *)(uintptr_t)&s);
    for (size_t i = 0; i < count; ++i) {
        mesh->line_count += segments[i].from != segments[i].to;
    }
    mesh->triangle_count += made;
    mesh->beside_count = made;
    return burnish_tasks_check(mesh->tasks, reader->error);
}
