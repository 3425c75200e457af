/* Colours a mesh by values of its vertices. */
#include <string.h>

#include "base/layout.h"
#include "base/numbers.h"
#include "core/srgb.h"
#include "core/vec3.h"
#include "mesh/data/material.h"
#include "mesh/data/mesh.h"

#define COOKIE BURNISH_COOKIE(0x636f6c31, burnish_coloring)

void burnish_coloring_init(burnish_coloring *coloring, uint64_t layout) {
    const burnish_coloring defaults = {.cookie = COOKIE};
    burnish_layout_init(coloring, layout, BURNISH_LAYOUT(burnish_coloring), &defaults);
}

/* ---- Maps ---- */

static const uint8_t viridis[11][3] = {
    {68, 1, 84},    {72, 37, 118},  {65, 68, 135},  {53, 96, 141},  {42, 120, 142}, {33, 144, 140},
    {34, 168, 132}, {67, 191, 113}, {122, 209, 81}, {187, 223, 39}, {253, 231, 37}};
static const uint8_t coolwarm[9][3] = {{59, 76, 192},   {98, 130, 234},  {141, 176, 254},
                                       {184, 208, 249}, {221, 221, 221}, {245, 196, 173},
                                       {244, 154, 123}, {222, 96, 77},   {180, 4, 38}};
static const uint8_t grey[2][3] = {{0, 0, 0}, {255, 255, 255}};

void burnish_color_map_get(burnish_color_map map, double value, uint8_t srgb[3]) {
    const uint8_t(*values)[3] = map == BURNISH_COLOR_MAP_COOLWARM ? coolwarm
                                : map == BURNISH_COLOR_MAP_GREY   ? grey
                                                                  : viridis;
    const int last = map == BURNISH_COLOR_MAP_COOLWARM ? 8 : map == BURNISH_COLOR_MAP_GREY ? 1 : 10;
    const double at = value > 0 ? (value < 1 ? value * last : last) : 0;
    const int first = (int)at < last ? (int)at : last - 1;
    for (int k = 0; k < 3; ++k) {
        const double low = values[first][k], high = values[first + 1][k];
        srgb[k] = (uint8_t)(low + (high - low) * (at - first) + 0.5);
    }
}

/* ---- Values ---- */

/* What is coloured, and how. */
typedef struct painter {
    burnish_mesh *mesh;
    const burnish_coloring *coloring;
    burnish_vec3 up;
    double base; /* height of the origin */
    double range[2];
} painter;

static double value_of(const painter *p, size_t vertex) {
    const burnish_mesh_view *view = &p->mesh->view;
    return p->coloring->source == BURNISH_COLOR_BY_PROPERTY
               ? (double)view->texture_coordinates[2 * vertex]
               : p->base +
                     burnish_vec3_dot(p->up, burnish_vec3_loadf(view->positions + 3 * vertex));
}

/* Outliers are outside the view's bounds. */
static int is_outlier(const burnish_mesh_view *view, size_t vertex) {
    const float *p = view->positions + 3 * vertex;
    for (int k = 0; k < 3; ++k) {
        if (p[k] < view->bounds_min[k] || p[k] > view->bounds_max[k]) {
            return 1;
        }
    }
    return 0;
}

static void find_range(painter *p) {
    const burnish_mesh_view *view = &p->mesh->view;
    int is_first = 1;
    memcpy(p->range, p->coloring->range, sizeof p->range);
    if (p->range[0] != p->range[1]) {
        return;
    }
    for (size_t i = 0; i < view->vertex_count; ++i) {
        const double value = value_of(p, i);
        if (!is_outlier(view, i)) {
            p->range[0] = is_first || value < p->range[0] ? value : p->range[0];
            p->range[1] = is_first || value > p->range[1] ? value : p->range[1];
            is_first = 0;
        }
    }
}

/* [0, 1] within the range; the middle of a range of one value. */
static double position_of(const painter *p, size_t vertex) {
    const double size = p->range[1] - p->range[0];
    const double at = (value_of(p, vertex) - p->range[0]) / size;
    return size == 0 ? 0.5 : at > 0 ? (at < 1 ? at : 1) : 0;
}

/* ---- Painting ---- */

static burnish_status paint_vertices(painter *p, burnish_memory *memory) {
    burnish_mesh *mesh = p->mesh;
    uint8_t *colors = burnish_allocate(memory, mesh->view.vertex_count, 4, "colours");
    for (size_t i = 0; i < mesh->view.vertex_count && colors; ++i) {
        colors[4 * i + 3] = 255;
        if (p->coloring->source != BURNISH_COLOR_BY_NORMAL) {
            burnish_color_map_get(p->coloring->map, position_of(p, i), colors + 4 * i);
            continue;
        }
        for (size_t k = 0; k < 3; ++k) {
            colors[4 * i + k] =
                (uint8_t)(((double)mesh->view.normals[3 * i + k] + 1) * 127.5 + 0.5);
        }
    }
    if (colors) {
        burnish_release(mesh->context, mesh->attributes[BURNISH_COLOR]);
        mesh->attributes[BURNISH_COLOR] = colors;
    }
    return memory->status;
}

/* Texels of the map; the middles of the first and last one are its ends. */
enum { TEXELS = 256 };

static uint8_t *make_texels(burnish_color_map map, burnish_memory *memory) {
    uint8_t *pixels = burnish_allocate(memory, TEXELS, 4, "a colour map");
    for (int i = 0; i < TEXELS && pixels; ++i) {
        burnish_color_map_get(map, i / (TEXELS - 1.0), pixels + 4 * (size_t)i);
        pixels[4 * i + 3] = 255;
    }
    return pixels;
}

static burnish_status paint_texture(painter *p, burnish_memory *memory) {
    burnish_mesh *mesh = p->mesh;
    const size_t count = mesh->view.vertex_count;
    uint8_t *pixels = make_texels(p->coloring->map, memory);
    burnish_texture *texture = burnish_allocate_zeroed(memory, 1, sizeof *texture, "textures");
    float *coordinates = burnish_allocate(memory, count, 2 * sizeof *coordinates, "a colour map");
    if (memory->status != BURNISH_STATUS_OK) {
        burnish_release(mesh->context, pixels);
        burnish_release(mesh->context, texture);
        burnish_release(mesh->context, coordinates);
        return memory->status;
    }
    for (size_t i = 0; i < count; ++i) {
        coordinates[2 * i] = (float)((position_of(p, i) * (TEXELS - 1) + 0.5) / TEXELS);
        coordinates[2 * i + 1] = 0.5f;
    }
    burnish_textures_release(mesh->context, mesh->textures, mesh->texture_count);
    *texture = (burnish_texture){.width = TEXELS, .height = 1, .pixels = pixels, .is_color = 1};
    mesh->textures = texture;
    mesh->texture_count = 1;
    burnish_release(mesh->context, mesh->attributes[BURNISH_TEXCOORD]);
    mesh->attributes[BURNISH_TEXCOORD] = coordinates;
    burnish_release(mesh->context, mesh->attributes[BURNISH_COLOR]);
    mesh->attributes[BURNISH_COLOR] = NULL;
    return BURNISH_STATUS_OK;
}

/* One material in the colours of the vertices or the texture. */
static void replace_materials(burnish_mesh *mesh, int has_texture) {
    burnish_material material = burnish_material_default();
    for (int k = 0; k < 3 && has_texture; ++k) {
        material.diffuse[k] = material.ambient[k] = 1;
        material.has_diffuse = 1;
    }
    material.textures[BURNISH_TEXTURE_COLOR].texture = has_texture;
    material.textures[BURNISH_TEXTURE_COLOR].wrap[0] = BURNISH_WRAP_CLAMP;
    material.textures[BURNISH_TEXTURE_COLOR].wrap[1] = BURNISH_WRAP_CLAMP;
    mesh->materials[0] = material;
    mesh->material_count = 1;
    burnish_release(mesh->context, mesh->triangle_materials);
    mesh->triangle_materials = NULL;
    burnish_release(mesh->context, mesh->attributes[BURNISH_TANGENT]);
    burnish_release(mesh->context, mesh->attributes[BURNISH_TEXCOORD2]);
    mesh->attributes[BURNISH_TANGENT] = mesh->attributes[BURNISH_TEXCOORD2] = NULL;
}

/* ---- Parts ---- */

void burnish_part_color(size_t number, uint8_t srgb[3]) {
    static const uint8_t colors[8][3] = {{230, 159, 0},   {86, 180, 233}, {0, 158, 115},
                                         {240, 228, 66},  {0, 114, 178},  {213, 94, 0},
                                         {204, 121, 167}, {120, 120, 120}};
    memcpy(srgb, colors[number % 8], 3);
}

/* A material per part or filament, and a grey one. */
static burnish_status paint_parts(burnish_mesh *mesh, int by_part, burnish_memory *memory) {
    const burnish_contents *c = &mesh->contents;
    const size_t count = by_part ? c->part_count : c->filament_count;
    const size_t triangles = mesh->view.triangle_count;
    const uint16_t *from = by_part ? mesh->triangle_parts : mesh->triangle_materials;
    burnish_material *materials =
        burnish_allocate(memory, count + 1, sizeof *materials, "materials");
    uint16_t *numbers = burnish_allocate(memory, triangles, sizeof *numbers, "materials");
    if (memory->status != BURNISH_STATUS_OK) {
        burnish_release(mesh->context, materials);
        burnish_release(mesh->context, numbers);
        return memory->status;
    }
    for (size_t i = 0; i <= count; ++i) {
        uint8_t srgb[3];
        burnish_part_color(i, srgb);
        materials[i] = burnish_material_default();
        materials[i].has_diffuse = i < count;
        for (int k = 0; k < 3 && i < count; ++k) {
            materials[i].ambient[k] = materials[i].diffuse[k] =
                burnish_srgb_to_linear[by_part ? srgb[k] : c->filaments[i].srgb[k]];
        }
    }
    for (size_t i = 0; i < triangles; ++i) {
        numbers[i] = (uint16_t)(!from ? 0 : from[i] < count ? from[i] : count);
    }
    burnish_release(mesh->context, mesh->attributes[BURNISH_COLOR]);
    mesh->attributes[BURNISH_COLOR] = NULL;
    replace_materials(mesh, 0);
    burnish_release(mesh->context, mesh->materials);
    mesh->materials = materials;
    mesh->material_count = count + 1;
    mesh->triangle_materials = numbers;
    return BURNISH_STATUS_OK;
}

static burnish_status check_coloring(const burnish_mesh *mesh, const burnish_coloring *coloring,
                                     burnish_error *error) {
    const double *range = coloring ? coloring->range : NULL;
    if (!mesh || !coloring) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "colours: the %s is NULL; pass one",
                            mesh ? "coloring" : "mesh");
    }
    burnish_status status = burnish_layout_check(coloring, COOKIE, "colours", "coloring", error);
    if (status == BURNISH_STATUS_OK && (coloring->source > BURNISH_COLOR_BY_FILAMENT ||
                                        coloring->map >= BURNISH_COLOR_MAP_COUNT)) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "colours: source %d or map %d does not exist", (int)coloring->source,
                              (int)coloring->map);
    }
    if (status == BURNISH_STATUS_OK &&
        !(range[0] >= -1e30 && range[0] <= 1e30 && range[1] >= -1e30 && range[1] <= 1e30)) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "colours: the range %g to %g is not within 1e30", range[0], range[1]);
    }
    if (status == BURNISH_STATUS_OK && coloring->source == BURNISH_COLOR_BY_PROPERTY &&
        !mesh->view.texture_coordinates) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "colours: the mesh has no scalar property; only PLY, PCD, LAS, XYZ "
                              "and glTF files have them");
    }
    if (status == BURNISH_STATUS_OK &&
        ((coloring->source == BURNISH_COLOR_BY_PART && mesh->contents.part_count == 0) ||
         (coloring->source == BURNISH_COLOR_BY_FILAMENT && mesh->contents.filament_count == 0))) {
        status = burnish_fail(error, BURNISH_STATUS_ARGUMENT, "colours: the mesh has no %s",
                              coloring->source == BURNISH_COLOR_BY_PART
                                  ? "parts; only files that name several objects have them"
                                  : "filaments; only print projects have them");
    }
    return status;
}

burnish_status burnish_mesh_color_by(burnish_mesh *mesh, const burnish_coloring *coloring,
                                     double range[2], burnish_error *error) {
    burnish_status status = check_coloring(mesh, coloring, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_memory memory = burnish_memory_of(mesh->context, error);
    const burnish_vec3 up = burnish_vec3_normalize(burnish_vec3_load(coloring->up));
    painter p = {mesh,
                 coloring,
                 burnish_vec3_dot(up, up) > 0 ? up : burnish_vec3_loadf(mesh->view.up_axis),
                 0,
                 {0, 0}};
    p.base = burnish_vec3_dot(p.up, burnish_vec3_load(mesh->view.origin));
    const int paints_vertices =
        mesh->view.point_radius > 0 || coloring->source == BURNISH_COLOR_BY_NORMAL;
    if (coloring->source >= BURNISH_COLOR_BY_PART) {
        status = paint_parts(mesh, coloring->source == BURNISH_COLOR_BY_PART, &memory);
        burnish_mesh_update_view(mesh);
        return status;
    }
    if (coloring->source != BURNISH_COLOR_BY_NORMAL) {
        find_range(&p);
    }
    status = paints_vertices ? paint_vertices(&p, &memory) : paint_texture(&p, &memory);
    if (status == BURNISH_STATUS_OK) {
        replace_materials(mesh, !paints_vertices);
        burnish_mesh_update_view(mesh);
    }
    if (status == BURNISH_STATUS_OK && mesh->negatives &&
        coloring->source == BURNISH_COLOR_BY_HEIGHT) { /* their walls have the same heights */
        burnish_coloring same = *coloring;
        memcpy(same.range, p.range, sizeof same.range);
        for (int k = 0; k < 3; ++k) {
            same.up[k] = k == 0 ? p.up.x : k == 1 ? p.up.y : p.up.z;
        }
        status = burnish_mesh_color_by(mesh->negatives, &same, NULL, error);
    }
    if (range) {
        memcpy(range, p.range, sizeof p.range);
    }
    return status;
}
