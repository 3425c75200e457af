/* Joins the items of a scene. Lines, and what is beside the faces of a file, come last. */
#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "core/srgb.h"
#include "core/vec3.h"
#include "mesh/data/material.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/parts.h"
#include "mesh/read/common/splats.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/scene/scene.h"

enum { SEARCHED = 256, MATERIALS_MOST = 65536 };

/* ---- Transforms ---- */

void burnish_scene_place(const double sines[3], const double cosines[3], const double move[3],
                         double transform[12]) {
    const double *s = sines, *c = cosines;
    const double all[12] = {c[2] * c[1],
                            c[2] * s[1] * s[0] - s[2] * c[0],
                            c[2] * s[1] * c[0] + s[2] * s[0],
                            move[0],
                            s[2] * c[1],
                            s[2] * s[1] * s[0] + c[2] * c[0],
                            s[2] * s[1] * c[0] - c[2] * s[0],
                            move[1],
                            -s[1],
                            c[1] * s[0],
                            c[1] * c[0],
                            move[2]};
    memcpy(transform, all, sizeof all);
}

/* The cofactors of the linear part, which turn normals, divided by the largest; negative if the
 * transform mirrors, so that normals stay outside. */
static int find_cofactors(const double m[12], double cofactors[9]) {
    double largest = 0, determinant = 0;
    for (int i = 0; i < 3; ++i) {
        const double *a = m + 4 * ((i + 1) % 3), *b = m + 4 * ((i + 2) % 3);
        for (int k = 0; k < 3; ++k) {
            const int j = (k + 1) % 3, l = (k + 2) % 3;
            const double c = a[j] * b[l] - a[l] * b[j], size = c < 0 ? -c : c;
            cofactors[3 * i + k] = c;
            largest = size > largest ? size : largest;
            determinant += i == 0 ? m[k] * c : 0;
        }
    }
    for (int i = 0; i < 9 && largest > 0; ++i) {
        cofactors[i] /= determinant < 0 ? -largest : largest;
    }
    return determinant < 0;
}

static void turn_vector(const double *m, int stride, const float *from, float *to) {
    double out[3];
    for (int i = 0; i < 3; ++i) {
        const double *r = m + stride * i;
        out[i] = r[0] * (double)from[0] + r[1] * (double)from[1] + r[2] * (double)from[2];
    }
    for (int i = 0; i < 3; ++i) {
        to[i] = (float)out[i];
    }
}

/* ---- Items of streams ---- */

static int move_positions(const burnish_mesh_data *mesh, const double m[12], const double origin[3],
                          float *to) {
    const float *from = burnish_positions(mesh);
    int fits = 1;
    for (size_t i = 0; i < mesh->streams[BURNISH_POSITION].count; ++i) {
        double p[3];
        for (size_t k = 0; k < 3; ++k) {
            p[k] = (double)from[3 * i + k] + mesh->origin[k];
        }
        for (size_t k = 0; k < 3; ++k) {
            const double *r = m + 4 * k;
            fits &= burnish_place(r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3], origin[k],
                                  to + 3 * i + k);
        }
    }
    return fits;
}

/* Whether values are the same in every place. */
static int stays(burnish_attribute attribute, const double m[12]) {
    static const double identity[12] = BURNISH_MATRIX_IDENTITY;
    int is_turned = 0;
    for (int i = 0; i < 12; ++i) {
        is_turned |= i % 4 != 3 && m[i] != identity[i];
    }
    return !is_turned || attribute == BURNISH_COLOR || attribute == BURNISH_TEXCOORD ||
           attribute == BURNISH_TEXCOORD2;
}

static void move_items(const burnish_mesh_data *mesh, burnish_attribute attribute,
                       const double m[12], void *to) {
    const burnish_stream *stream = &mesh->streams[attribute];
    const size_t size = burnish_attribute_size(attribute);
    double cofactors[9];
    const int is_mirrored = find_cofactors(m, cofactors);
    memcpy(to, stream->items, stream->count * size);
    for (size_t i = 0; i < stream->count && !stays(attribute, m); ++i) {
        if (attribute == BURNISH_NORMAL) {
            float *normal = (float *)to + 3 * i;
            turn_vector(cofactors, 3, normal, normal);
            if (mesh->point_count > 0) { /* those of meshes become unit vectors later */
                const burnish_vec3 unit = burnish_vec3_normalize(burnish_vec3_loadf(normal));
                normal[0] = (float)unit.x;
                normal[1] = (float)unit.y;
                normal[2] = (float)unit.z;
            }
        } else if (attribute == BURNISH_TANGENT) {
            float *tangent = (float *)to + 4 * i;
            turn_vector(m, 4, tangent, tangent);
            tangent[3] = is_mirrored ? -tangent[3] : tangent[3];
        } else {
            burnish_splat *splat = (burnish_splat *)to + i;
            for (int k = 0; k < 3; ++k) {
                turn_vector(m, 4, splat->axes[k], splat->axes[k]);
            }
        }
    }
}

/* ---- Joining streams ---- */

static size_t lines_of(const burnish_mesh_data *mesh) {
    return mesh->line_count > 0 && mesh->beside_count == 0 ? mesh->triangle_count
                                                           : mesh->beside_count;
}

typedef struct joining {
    burnish_scene *scene;
    burnish_mesh_data *mesh;
    size_t first[BURNISH_ATTRIBUTE_COUNT]; /* of the item's values */
    size_t triangle;
} joining;

static int is_dropped(const burnish_scene_item *item, int attribute) {
    return item->has_color && attribute == BURNISH_COLOR;
}

static size_t values_of(const burnish_scene_item *item, int attribute) {
    return is_dropped(item, attribute) ? 0 : item->mesh->streams[attribute].count;
}

/* Whether corners of the whole need numbers of their own for an attribute: some item has its own,
 * or other values than one per position. */
static int needs_corners(const joining *j, burnish_attribute attribute) {
    int any = attribute == BURNISH_POSITION;
    for (size_t i = 0; i < j->scene->item_count && !any; ++i) {
        const burnish_scene_item *item = &j->scene->items[i];
        any = item->mesh->streams[attribute].corners ||
              values_of(item, attribute) != values_of(item, BURNISH_POSITION);
    }
    return any;
}

/* Room for everything. */
static burnish_status reserve_streams(joining *j) {
    burnish_scene *scene = j->scene;
    uint64_t counts[BURNISH_ATTRIBUTE_COUNT] = {0}, triangles = 0;
    const uint64_t limit = scene->reader->input->options->max_triangles;
    burnish_memory *memory = &j->mesh->memory;
    for (size_t i = 0; i < scene->item_count; ++i) {
        for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
            counts[a] += values_of(&scene->items[i], a);
        }
        triangles += scene->items[i].mesh->triangle_count;
    }
    if (triangles > limit) {
        return burnish_fail_triangles(scene->reader, NULL);
    }
    burnish_status status = burnish_budget_check(scene->reader, counts[0], triangles);
    for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT && status == BURNISH_STATUS_OK; ++a) {
        if (counts[a] >= BURNISH_VALUE_LIMIT) {
            return burnish_reader_fail(scene->reader, BURNISH_STATUS_LIMIT, NULL,
                                       "more vertices than 2^32; split or simplify the scene");
        }
        j->mesh->streams[a].count = (size_t)counts[a];
        if (counts[a] > 0) {
            status = burnish_mesh_data_reserve(j->mesh, (burnish_attribute)a, (size_t)counts[a]);
        }
        if (counts[a] > 0 && triangles > 0 && status == BURNISH_STATUS_OK &&
            needs_corners(j, (burnish_attribute)a)) {
            status =
                burnish_mesh_data_reserve_corners(j->mesh, (burnish_attribute)a, (size_t)triangles);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        j->mesh->triangle_count = (size_t)triangles;
        j->mesh->triangle_parts = burnish_reserve_discard(
            memory, NULL, &j->mesh->triangle_part_capacity, (size_t)triangles, 2, "parts");
        j->mesh->triangle_materials = burnish_reserve_discard(
            memory, NULL, &j->mesh->triangle_material_capacity, (size_t)triangles, 2, "materials");
        status = memory->status;
    }
    return status;
}

/* Numbers the corners of triangles [from, end) of an item. */
static void write_triangles(joining *j, const burnish_scene_item *item, size_t from, size_t end) {
    const burnish_mesh_data *mesh = item->mesh;
    double unused[9];
    const int is_mirrored = find_cofactors(item->transform, unused);
    for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        uint32_t *to = j->mesh->streams[a].corners;
        const int has_values = values_of(item, a) > 0;
        const uint32_t *own = burnish_stream_corners(mesh, (burnish_attribute)a);
        for (size_t i = 0; to && i < 3 * (end - from); ++i) {
            const size_t k = is_mirrored && i % 3 > 0 ? i / 3 * 3 + 3 - i % 3 : i;
            const uint32_t corner = has_values ? own[3 * from + k] : BURNISH_NONE;
            to[3 * j->triangle + i] =
                corner == BURNISH_NONE ? corner : corner + (uint32_t)j->first[a];
        }
    }
    for (size_t i = from; i < end; ++i, ++j->triangle) {
        const uint32_t part =
            item->first_part + (mesh->triangle_parts ? mesh->triangle_parts[i] : 0);
        const uint32_t material =
            mesh->triangle_materials && !item->has_color ? mesh->triangle_materials[i] : 0;
        j->mesh->triangle_parts[j->triangle] =
            (uint16_t)(part < BURNISH_PARTS_MAX ? part : BURNISH_PARTS_MAX - 1);
        j->mesh->triangle_materials[j->triangle] = (uint16_t)(item->first_material + material);
    }
}

/* Faces of all items, or lines. */
static void write_all_triangles(joining *j, int are_lines) {
    memset(j->first, 0, sizeof j->first);
    for (size_t i = 0; i < j->scene->item_count; ++i) {
        const burnish_scene_item *item = &j->scene->items[i];
        const burnish_mesh_data *mesh = item->mesh;
        const size_t faces = mesh->triangle_count - lines_of(mesh);
        write_triangles(j, item, are_lines ? faces : 0, are_lines ? mesh->triangle_count : faces);
        for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
            j->first[a] += values_of(item, a);
        }
    }
}

static void write_items(const joining *j) {
    for (int a = BURNISH_POSITION + 1; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        uint8_t *to = j->mesh->streams[a].items;
        for (size_t i = 0; i < j->scene->item_count; ++i) {
            const burnish_scene_item *item = &j->scene->items[i];
            if (values_of(item, a) > 0) {
                move_items(item->mesh, (burnish_attribute)a, item->transform, to);
                to += values_of(item, a) * burnish_attribute_size((burnish_attribute)a);
            }
        }
    }
}

static burnish_status write_positions(const joining *j, const double origin[3]) {
    float *to = burnish_positions(j->mesh);
    int fits = 1;
    for (size_t i = 0; i < j->scene->item_count; ++i) {
        const burnish_mesh_data *mesh = j->scene->items[i].mesh;
        fits &= move_positions(mesh, j->scene->items[i].transform, origin, to);
        to += 3 * mesh->streams[BURNISH_POSITION].count;
    }
    memcpy(j->mesh->origin, origin, sizeof j->mesh->origin);
    return fits ? BURNISH_STATUS_OK
                : burnish_reader_fail(j->scene->reader, BURNISH_STATUS_FORMAT, NULL,
                                      "coordinates are too large; scale the scene");
}

/* Far from 0, all positions are written again, less an origin. */
static burnish_status write_near_origin(const joining *j) {
    const double *given = j->scene->reader->input->options->origin;
    double origin[3] = {0, 0, 0};
    burnish_status status = write_positions(j, given ? given : origin);
    for (int i = 0; i < BURNISH_ORIGIN_TIMES && status == BURNISH_STATUS_OK && !given &&
                    burnish_find_origin(j->mesh, origin);
         ++i) {
        status = write_positions(j, origin);
    }
    return status;
}

/* What is framed of lines and clouds. */
static void bound_positions(burnish_mesh_data *mesh) {
    const float *p = burnish_positions(mesh);
    for (size_t i = 0; i < 3 * mesh->streams[BURNISH_POSITION].count; ++i) {
        float *low = &mesh->points_min[i % 3], *high = &mesh->points_max[i % 3];
        *low = i < 3 || p[i] < *low ? p[i] : *low;
        *high = i < 3 || p[i] > *high ? p[i] : *high;
    }
    memcpy(mesh->inner_min, mesh->points_min, sizeof mesh->inner_min);
    memcpy(mesh->inner_max, mesh->points_max, sizeof mesh->inner_max);
}

/* ---- Materials ---- */

/* The colour of a material: burnish's grey with another base. */
static burnish_material colored_material(const uint8_t srgb[4]) {
    burnish_material material = burnish_material_default();
    for (int k = 0; k < 3; ++k) {
        material.ambient[k] = material.diffuse[k] = burnish_srgb_to_linear[srgb[k]];
    }
    material.has_diffuse = 1;
    material.transparency = (float)(255 - srgb[3]) / 255;
    return material;
}

/* Adds a material unless it is among the last ones. Returns its number. */
static uint32_t take_material(burnish_mesh_data *to, const burnish_material *material) {
    for (size_t i = to->material_count, n = 0; i > 0 && n < SEARCHED; --i, ++n) {
        if (memcmp(&to->materials[i - 1], material, sizeof *material) == 0) {
            return (uint32_t)(i - 1);
        }
    }
    to->materials = burnish_reserve(&to->memory, to->materials, &to->material_capacity,
                                    to->material_count + 1, sizeof *material, "materials");
    if (to->memory.status != BURNISH_STATUS_OK) {
        return 0;
    }
    to->materials[to->material_count++] = *material;
    return (uint32_t)(to->material_count - 1);
}

/* Moves the textures of a source, and copies its materials. */
static void take_materials(burnish_mesh_data *to, burnish_scene_source *source) {
    burnish_mesh_data *from = &source->mesh;
    const int first = (int)to->texture_count;
    source->has_materials = 1;
    if (from->material_count <= 1 && from->texture_count == 0) {
        const burnish_material grey = burnish_material_default();
        source->first_material = take_material(to, from->material_count ? from->materials : &grey);
        return;
    }
    to->textures =
        burnish_reserve(&to->memory, to->textures, &to->texture_capacity,
                        to->texture_count + from->texture_count, sizeof *to->textures, "textures");
    to->materials = burnish_reserve(&to->memory, to->materials, &to->material_capacity,
                                    to->material_count + from->material_count,
                                    sizeof *to->materials, "materials");
    if (to->memory.status != BURNISH_STATUS_OK) {
        return;
    }
    source->first_material = (uint32_t)to->material_count;
    for (size_t i = 0; i < from->texture_count; ++i) {
        to->textures[to->texture_count++] = from->textures[i];
    }
    from->texture_count = 0;
    for (size_t i = 0; i < from->material_count; ++i) {
        burnish_material material = from->materials[i];
        for (int k = 0; k < BURNISH_TEXTURE_SLOT_COUNT; ++k) {
            material.textures[k].texture += material.textures[k].texture > 0 ? first : 0;
        }
        to->materials[to->material_count++] = material;
    }
}

static burnish_status join_materials(burnish_scene *scene) {
    burnish_mesh_data *to = scene->reader->mesh;
    for (size_t i = 0; i < scene->item_count; ++i) {
        burnish_scene_item *item = &scene->items[i];
        if (item->has_color) {
            const burnish_material material = colored_material(item->srgb);
            item->first_material = take_material(to, &material);
        } else {
            if (!item->source->has_materials) {
                take_materials(to, item->source);
            }
            item->first_material = item->source->first_material;
        }
        if (to->memory.status != BURNISH_STATUS_OK) {
            return to->memory.status;
        }
        if (to->material_count > MATERIALS_MOST || to->texture_count > BURNISH_TEXTURES_MAX) {
            return burnish_reader_fail(scene->reader, BURNISH_STATUS_LIMIT, NULL,
                                       "more than %d materials or textures; split the scene",
                                       MATERIALS_MOST);
        }
    }
    return BURNISH_STATUS_OK;
}

/* ---- Parts ---- */

/* "ITEM/PART", or the one of both that has a name. */
static void name_part(const burnish_scene_item *item, burnish_part *part) {
    char both[2 * BURNISH_NAME_SIZE];
    snprintf(both, sizeof both, "%s%s%s", item->name, *item->name && *part->name ? "/" : "",
             part->name);
    burnish_part_set_name(part->name, both, strlen(both));
}

/* An item without parts is one. `first` is the number of the first of its file's items. */
static burnish_status join_parts(burnish_scene *scene) {
    burnish_mesh_data *to = scene->reader->mesh;
    uint32_t first = 0;
    for (size_t i = 0; i < scene->item_count; ++i) {
        burnish_scene_item *item = &scene->items[i];
        const burnish_mesh_data *mesh = &item->source->mesh;
        const burnish_part whole = {.triangle_count = mesh->triangle_count,
                                    .transform = BURNISH_MATRIX_IDENTITY};
        const size_t count = mesh->part_count > 0 ? mesh->part_count : 1;
        uint32_t items = 1;
        item->first_part =
            (uint32_t)(to->part_count < BURNISH_PARTS_MAX ? to->part_count : BURNISH_PARTS_MAX - 1);
        for (size_t k = 0; k < count && to->part_count < BURNISH_PARTS_MAX; ++k) {
            to->parts = burnish_reserve(&to->memory, to->parts, &to->part_capacity,
                                        to->part_count + 1, sizeof whole, "parts");
            if (to->memory.status != BURNISH_STATUS_OK) {
                return to->memory.status;
            }
            burnish_part *part = &to->parts[to->part_count++];
            *part = mesh->part_count > 0 ? mesh->parts[k] : whole;
            items = part->item >= items ? part->item + 1 : items;
            part->item += first;
            part->plate = part->filament = 0;
            name_part(item, part);
            burnish_matrix_multiply(item->transform, part->transform, part->transform);
        }
        first += items;
    }
    return BURNISH_STATUS_OK;
}

/* ---- Units ---- */

static double meters_of(const char *unit) {
    static const struct {
        const char *name;
        double meters;
    } units[] = {{"micron", 1e-6}, {"millimeter", 1e-3}, {"centimeter", 1e-2},
                 {"inch", 0.0254}, {"foot", 0.3048},     {"meter", 1}};
    for (size_t i = 0; unit && i < sizeof units / sizeof *units; ++i) {
        if (strcmp(units[i].name, unit) == 0) {
            return units[i].meters;
        }
    }
    return 0;
}

/* Scales items whose files state another unit than the scene's. */
static void match_units(burnish_scene *scene) {
    const char *unit = scene->unit, *other = NULL;
    for (size_t i = 0; i < scene->item_count && !scene->is_robot; ++i) {
        burnish_scene_item *item = &scene->items[i];
        const char *own = item->source->mesh.unit;
        unit = unit ? unit : own;
        const double factor = own && meters_of(unit) > 0 ? meters_of(own) / meters_of(unit) : 1;
        const double scale[12] = {factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, factor, 0};
        if (factor != 1 && factor > 0) {
            burnish_matrix_multiply(item->transform, scale, item->transform);
            other = own;
        }
    }
    if (other) {
        burnish_reader_warn(scene->reader, NULL, "files in the unit %s are scaled to %s", other,
                            unit);
    }
    scene->reader->mesh->unit = unit;
}

/* ---- All ---- */

/* One cloud of several: the radius of its points is their mean. */
static void join_clouds(const burnish_scene *scene, burnish_mesh_data *to) {
    double radius = 0;
    for (size_t i = 0; i < scene->item_count; ++i) {
        const burnish_scene_item *item = &scene->items[i];
        const double *m = item->transform;
        radius +=
            (double)item->source->mesh.point_count * (double)item->source->mesh.point_radius *
            burnish_sqrt((m[0] * m[0] + m[1] * m[1] + m[2] * m[2] + m[4] * m[4] + m[5] * m[5] +
                          m[6] * m[6] + m[8] * m[8] + m[9] * m[9] + m[10] * m[10]) /
                         3);
    }
    to->point_count = to->streams[BURNISH_POSITION].count;
    radius /= (double)to->point_count;
    to->point_radius = (float)(radius > (double)FLT_MIN ? radius : (double)FLT_MIN);
    for (int a = BURNISH_POSITION + 1; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        if (to->streams[a].count != to->point_count) {
            burnish_mesh_data_drop(to, (burnish_attribute)a);
        }
    }
    burnish_release(to->memory.context, to->triangle_parts);
    to->triangle_parts = NULL;
}

/* Leaves out points next to faces, and takes splats next to faces apart. Returns whether all items are
 * clouds. */
static int settle_clouds(burnish_scene *scene, burnish_scene *apart) {
    const size_t count = scene->item_count;
    size_t clouds = 0, points = 0;
    for (size_t i = 0; i < count; ++i) {
        scene->items[i].mesh = &scene->items[i].source->mesh;
        clouds += scene->items[i].mesh->point_count > 0;
    }
    if (clouds == count) {
        return 1;
    }
    apart->items =
        burnish_allocate(&scene->reader->mesh->memory, count, sizeof *apart->items, "splats");
    scene->item_count = 0;
    for (size_t i = 0; i < count && apart->items; ++i) {
        burnish_scene_item item = scene->items[i];
        const int is_cloud = item.mesh->point_count > 0;
        scene->items[scene->item_count] = item;
        scene->item_count += !is_cloud;
        item.mesh = is_cloud ? item.mesh : item.mesh->splats;
        if (item.mesh && item.mesh->streams[BURNISH_SPLAT].count > 0) {
            apart->items[apart->item_count++] = item;
        } else {
            points += is_cloud;
        }
    }
    if (points > 0) {
        burnish_reader_warn(scene->reader, NULL,
                            "point clouds beside meshes are left out: %zu; draw them alone",
                            points);
    }
    return 0;
}

static void add_facts(const burnish_scene *scene, burnish_mesh_data *to) {
    size_t lines = 0, negatives = 0;
    to->is_one_sided = 1;
    for (size_t i = 0; i < scene->item_count; ++i) {
        const burnish_mesh_data *mesh = &scene->items[i].source->mesh;
        to->line_count += mesh->line_count;
        to->is_one_sided &= mesh->is_one_sided;
        to->has_average_normals |= mesh->has_average_normals;
        to->has_normal_textures |= mesh->has_normal_textures;
        lines += lines_of(mesh);
        negatives += mesh->negatives != NULL;
    }
    if (negatives > 0) {
        burnish_reader_warn(scene->reader, NULL,
                            "negative volumes are not subtracted in scenes; draw the file alone");
    }
    to->beside_count = lines < to->triangle_count ? lines : 0;
}

static burnish_status join_streams(joining *j) {
    burnish_status status = reserve_streams(j);
    if (status == BURNISH_STATUS_OK) {
        write_items(j);
        write_all_triangles(j, 0);
        write_all_triangles(j, 1);
    }
    return status;
}

/* The splats of all items next to faces. */
static burnish_status join_splats(burnish_scene *scene, burnish_mesh_data *to) {
    joining j = {.scene = scene, .mesh = burnish_mesh_data_add_splats(to)};
    burnish_status status = to->memory.status;
    if (status == BURNISH_STATUS_OK) {
        status = reserve_streams(&j);
    }
    if (status == BURNISH_STATUS_OK) {
        write_items(&j);
        status = write_positions(&j, to->origin);
    }
    return status == BURNISH_STATUS_OK ? burnish_make_splats_beside(scene->reader) : status;
}

burnish_status burnish_scene_join(burnish_scene *scene) {
    burnish_mesh_data *to = scene->reader->mesh;
    joining j = {.scene = scene, .mesh = to};
    burnish_scene apart = {.reader = scene->reader};
    match_units(scene);
    const int are_clouds = settle_clouds(scene, &apart);
    if (scene->more_warnings > 0) {
        char line[80];
        snprintf(line, sizeof line, "%zu more warnings of files are not listed",
                 scene->more_warnings);
        burnish_mesh_data_list_warning(to, line);
    }
    burnish_status status = to->memory.status;
    if (status == BURNISH_STATUS_OK) {
        status = join_materials(scene);
    }
    if (status == BURNISH_STATUS_OK) {
        status = join_parts(scene);
    }
    if (status == BURNISH_STATUS_OK) {
        status = join_streams(&j);
    }
    if (status == BURNISH_STATUS_OK) {
        status = write_near_origin(&j);
    }
    if (to->up_axis[0] == 0 && to->up_axis[1] == 0 && to->up_axis[2] == 0) {
        memcpy(to->up_axis, scene->items[0].source->mesh.up_axis, sizeof to->up_axis);
    }
    if (status == BURNISH_STATUS_OK) {
        add_facts(scene, to);
        bound_positions(to);
        if (are_clouds) {
            join_clouds(scene, to);
        }
        status = burnish_tasks_check(to->tasks, scene->reader->error);
    }
    if (status == BURNISH_STATUS_OK && apart.item_count > 0) {
        status = join_splats(&apart, to);
    }
    burnish_release(to->memory.context, apart.items);
    return status;
}
