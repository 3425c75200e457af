/* Turns mesh data into a mesh, step by step: weld, orient and drop; order; generate normals and
 * number vertices; tangents; materials and textures. */
#include <assert.h>

#include "base/clock.h"

#include "mesh/build/build.h"
#include "mesh/build/builder.h"
#include "mesh/build/normals/faces.h"
#include "mesh/build/strays.h"
#include "mesh/build/vertices.h"

/* Moves the materials to the mesh, and the triangles' material numbers if there is more than one.
 */
static burnish_status take_materials(burnish_builder *b) {
    burnish_mesh_data *data = b->data;
    burnish_mesh *mesh = b->mesh;
    mesh->cameras = data->cameras;
    mesh->camera_count = data->camera_count;
    data->cameras = NULL;
    data->camera_count = data->camera_capacity = 0;
    mesh->lights = data->lights;
    mesh->light_count = data->light_count;
    data->lights = NULL;
    data->light_count = data->light_capacity = 0;
    mesh->textures = data->textures;
    mesh->texture_count = data->texture_count;
    data->textures = NULL;
    data->texture_count = data->texture_capacity = 0;
    if (data->material_count == 0) {
        mesh->materials = burnish_allocate(b->memory, 1, sizeof *mesh->materials, "materials");
        if (!mesh->materials) {
            return b->memory->status;
        }
        *mesh->materials = burnish_material_default();
        mesh->material_count = 1;
        return BURNISH_STATUS_OK;
    }
    mesh->materials = data->materials;
    mesh->material_count = data->material_count;
    data->materials = NULL;
    data->material_count = data->material_capacity = 0;
    if (mesh->material_count == 1 || !data->triangle_materials) {
        return BURNISH_STATUS_OK;
    }
    mesh->triangle_materials = data->triangle_materials;
    data->triangle_materials = NULL;
    data->triangle_material_capacity = 0;
    return BURNISH_STATUS_OK;
}

static void take_contents(burnish_builder *b) {
    burnish_mesh_data *data = b->data;
    b->mesh->contents =
        (burnish_contents){data->parts,       data->part_count, data->plates,
                           data->plate_count, data->filaments,  data->filament_count};
    b->mesh->triangle_parts = data->triangle_parts;
    data->parts = NULL;
    data->plates = NULL;
    data->filaments = NULL;
    data->triangle_parts = NULL;
}

static void take_texts(burnish_builder *b) {
    b->mesh->variants = b->data->variants;
    b->mesh->variant_count = b->data->variant_count;
    b->data->variants = NULL;
    b->data->variant_count = b->data->variant_capacity = 0;
    b->mesh->warnings = b->data->warnings;
    b->mesh->warning_count = b->data->warning_count;
    b->data->warnings = NULL;
    b->data->warning_count = b->data->warning_capacity = 0;
}

static void describe_mesh(burnish_builder *b) {
    memcpy(b->mesh->view.origin, b->data->origin, sizeof b->data->origin);
    b->mesh->view.point_radius = b->data->point_radius;
    memcpy(b->mesh->inner_min, b->data->inner_min, sizeof b->mesh->inner_min);
    memcpy(b->mesh->inner_max, b->data->inner_max, sizeof b->mesh->inner_max);
    b->mesh->info.point_count = b->data->point_count;
    b->mesh->info.line_count = b->data->line_count;
    b->mesh->info.layer_count = b->data->layer_count;
    b->mesh->has_beside = b->data->beside_count > 0;
    memcpy(b->mesh->points_min, b->data->points_min, sizeof b->mesh->points_min);
    memcpy(b->mesh->points_max, b->data->points_max, sizeof b->mesh->points_max);
    b->mesh->info.unit = b->data->unit;
    b->mesh->info.is_thumbnail = b->data->is_thumbnail;
    b->mesh->info.is_one_sided = b->data->is_one_sided;
    b->mesh->info.animation_seconds = b->data->animation_seconds;
    memcpy(b->mesh->info.imported, b->data->imported, sizeof b->data->imported);
    b->mesh->info.normals = b->has_file_normals ? BURNISH_NORMALS_FILE : BURNISH_NORMALS_OWN;
    b->mesh->info.normals_replaced = b->normals_replaced;
    burnish_mesh_update_view(b->mesh);
}

/* Strays are not framed. */
static void note_strays(burnish_builder *b) {
    float p[3];
    const double *origin = b->data->origin;
    const size_t strays =
        b->data->point_count + b->data->line_count > 0
            ? 0
            : burnish_find_strays(b->mesh, b->data->inner_min, b->data->inner_max, p);
    if (strays > 0) {
        burnish_mesh_data_warn(
            b->data,
            "%s: %zu of %zu triangles are far from the others, near %g, %g, %g, so "
            "%s without them; remove them%s",
            burnish_show_name(b->name).text, strays, b->triangle_count, (double)p[0] + origin[0],
            (double)p[1] + origin[1], (double)p[2] + origin[2],
            b->mesh->has_strays ? "the picture is framed" : "the mesh is drawn",
            b->mesh->has_strays ? ", or set the camera" : "");
    }
}

/* A point cloud needs nothing but its arrays. */
static burnish_status take_points(burnish_builder *b) {
    static const burnish_attribute taken[] = {BURNISH_POSITION, BURNISH_NORMAL, BURNISH_COLOR,
                                              BURNISH_TEXCOORD, BURNISH_SPLAT};
    b->vertex_count = b->data->point_count;
    for (size_t i = 0; i < sizeof taken / sizeof *taken; ++i) {
        burnish_stream *stream = &b->data->streams[taken[i]];
        b->mesh->attributes[taken[i]] = stream->items;
        stream->items = NULL;
        stream->count = stream->capacity = 0;
    }
    return take_materials(b);
}

/* The steps in order, each with its share of the time; on failure b and its mesh keep what was made
 * so far. */
static burnish_status build_steps(burnish_builder *b) {
    static const struct {
        burnish_status (*run)(burnish_builder *b);
        double done;
    } steps[] = {{burnish_build_triangles, 0.4},
                 {burnish_build_order, 0.6},
                 {burnish_build_vertices, 0.9},
                 {burnish_build_tangents, 0.95},
                 {take_materials, 1}};
    burnish_tasks *tasks = b->data->tasks;
    burnish_status status = b->memory->status;
    if (status == BURNISH_STATUS_OK && b->data->point_count > 0) {
        return take_points(b);
    }
    for (size_t i = 0; i < sizeof steps / sizeof *steps && status == BURNISH_STATUS_OK; ++i) {
        status = steps[i].run(b);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_tasks_check(tasks, b->memory->error);
            burnish_tasks_progress(tasks, BURNISH_STAGE_BUILD, steps[i].done);
        }
    }
    return status;
}

static burnish_mesh *allocate_mesh(burnish_mesh_data *data, burnish_format format) {
    burnish_mesh *mesh = burnish_allocate_zeroed(&data->memory, 1, sizeof *mesh, "mesh");
    const float *up = data->up_axis;
    if (mesh) {
        mesh->context = data->memory.context;
        mesh->info.format = format;
        if (up[0] == 0 && up[1] == 0 && up[2] == 0) {
            up = burnish_format_get_info(format)->up_axis;
        }
        memcpy(mesh->view.up_axis, up, sizeof mesh->view.up_axis);
    }
    return mesh;
}

/* Normals that may be averaged across edges are questioned, unless normal textures are relative to
 * them. Other sources state the normals that they mean, and rods for lines have the right ones. */
static burnish_normals_source choose_normals(const burnish_load_options *options,
                                             burnish_format format, const burnish_mesh_data *data) {
    const int is_questioned = data->has_average_normals && !data->has_normal_textures;
    if (data->line_count > 0 && data->beside_count == 0) {
        return BURNISH_NORMALS_FILE;
    }
    if (options->normals != BURNISH_NORMALS_AUTO) {
        return options->normals;
    }
    return format == BURNISH_FORMAT_ARRAYS                ? BURNISH_NORMALS_FILE
           : options->crease_angle != BURNISH_CREASE_AUTO ? BURNISH_NORMALS_OWN
           : is_questioned                                ? BURNISH_NORMALS_AUTO
                                                          : BURNISH_NORMALS_FILE;
}

/* Gathers have signed indices of 32 bits: of corners and of coordinates. */
static int fits_gathers(const burnish_mesh_data *data) {
    return data->triangle_count <= INT32_MAX / 3 &&
           data->streams[BURNISH_POSITION].count <= INT32_MAX / 3;
}

burnish_status burnish_mesh_build(burnish_mesh_data *data, const char *name,
                                  const burnish_load_options *options, burnish_format format,
                                  burnish_mesh **mesh) {
    const double start = burnish_seconds_now();
    burnish_builder b = {.data = data,
                         .memory = &data->memory,
                         .name = name,
                         .mesh = allocate_mesh(data, format),
                         .crease_angle = options->crease_angle,
                         .normals = choose_normals(options, format, data),
                         .measure = options->measure,
                         .wide = fits_gathers(data) ? burnish_face_width() : 0};
    *mesh = NULL;
    burnish_build_prepare_textures(&b, options);
    for (int i = BURNISH_EXTRA_ATTRIBUTES; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        b.has_extras |= data->streams[i].count > 0;
    }
    burnish_status status = build_steps(&b);
    burnish_build_release_corners(&b, 0);
    const int has_area = status != BURNISH_STATUS_FORMAT;
    if ((status == BURNISH_STATUS_OK || !has_area) && data->splats) {
        status = burnish_mesh_build(data->splats, name, options, format, &b.mesh->splats);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_mesh_destroy(b.mesh);
        return status;
    }
    assert(b.triangle_count > 0 || b.mesh->texture_count == 0); /* as the renderer expects */
    b.mesh->view.vertex_count = b.vertex_count;
    b.mesh->view.triangle_count = b.triangle_count;
    if (has_area) {
        note_strays(&b);
    } else {
        burnish_mesh_data_warn(data, "%s: none of %zu triangles has any area; they were left out",
                               burnish_show_name(name).text, data->triangle_count);
    }
    take_contents(&b);
    describe_mesh(&b);
    take_texts(&b);
    if (data->negatives) { /* without area they subtract nothing */
        burnish_error none;
        data->negatives->memory.error = &none;
        status = burnish_mesh_build(data->negatives, name, options, format, &b.mesh->negatives);
        if (status != BURNISH_STATUS_OK && status != BURNISH_STATUS_FORMAT) {
            burnish_mesh_destroy(b.mesh);
            return burnish_fail(data->memory.error, status, "%s", none.text);
        }
    }
    b.mesh->info.read_seconds = start - data->start;
    b.mesh->info.build_seconds = burnish_seconds_now() - start;
    *mesh = b.mesh;
    if (!has_area) {
        burnish_mesh_keep_splats(b.mesh);
    }
    return BURNISH_STATUS_OK;
}
