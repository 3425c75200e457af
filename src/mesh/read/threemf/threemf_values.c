/* 3MF's properties in a mesh: materials for bases and textures, colours and texture coordinates of
 * corners. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include "core/srgb.h"
#include "mesh/read/common/textures.h"

enum { MATERIAL_LIMIT = 65536 /* what 16 bits a triangle can tell apart */ };

static burnish_threemf_group *find_group(burnish_threemf *threemf, uint32_t part, uint32_t id) {
    const burnish_threemf_resource *resource =
        burnish_threemf_find(threemf, part, id, BURNISH_THREEMF_GROUP);
    return resource ? &threemf->groups.items[resource->index] : NULL;
}

/* Number i of a range as an index; NONE if it is invalid. */
static uint32_t index_at(const burnish_threemf *threemf, size_t first, size_t count, size_t i) {
    const double number = i < count ? threemf->numbers.items[first + i] : -1;
    return number >= 0 && number < BURNISH_THREEMF_NONE ? (uint32_t)number : BURNISH_THREEMF_NONE;
}

/* ---- Mixtures ---- */

/* The mean of the bases' colours in linear light, weighted as the composite says. */
static void mix_one(const burnish_threemf *threemf, const burnish_threemf_group *group,
                    const burnish_threemf_group *bases, burnish_threemf_range range,
                    uint8_t color[4]) {
    double sum[4] = {0, 0, 0, 0}, weights = 0;
    for (size_t i = 0; i < range.count && i < group->number_count; ++i) {
        const uint32_t base = index_at(threemf, group->first_number, group->number_count, i);
        const double weight = threemf->numbers.items[range.first + i];
        if (base < bases->count && weight > 0 && weight <= 1e6) {
            const uint8_t *c = threemf->colors.items[bases->first + base].rgba;
            for (int k = 0; k < 3; ++k) {
                sum[k] += weight * (double)burnish_srgb_to_linear[c[k]];
            }
            sum[3] += weight * c[3];
            weights += weight;
        }
    }
    memset(color, 255, 4);
    for (int k = 0; k < 3 && weights > 0; ++k) {
        color[k] = burnish_linear_to_srgb((float)(sum[k] / weights));
    }
    color[3] = weights > 0 ? (uint8_t)(sum[3] / weights + 0.5) : 255;
}

static void mix_composites(burnish_threemf *threemf, burnish_threemf_group *group) {
    const burnish_threemf_group *bases = find_group(threemf, group->part, group->target);
    const uint32_t first = (uint32_t)threemf->colors.count;
    const int has_bases = bases && bases->kind == BURNISH_THREEMF_BASES;
    for (uint32_t i = 0; has_bases && i < group->count; ++i) {
        burnish_threemf_color color;
        mix_one(threemf, group, bases, threemf->ranges.items[group->first + i], color.rgba);
        burnish_threemf_color *to = BURNISH_THREEMF_APPEND(threemf, &threemf->colors);
        if (!to) {
            return;
        }
        *to = color;
    }
    group->first = first;
    group->count = has_bases ? group->count : 0;
}

/* The layer that hides most of the others: the last texture, else the last colours, else the last
 * bases. */
static void choose_layer(burnish_threemf *threemf, burnish_threemf_group *group) {
    static const int ranks[] = {[BURNISH_THREEMF_BASES] = 1,
                                [BURNISH_THREEMF_COMPOSITES] = 2,
                                [BURNISH_THREEMF_COLORS] = 3,
                                [BURNISH_THREEMF_COORDINATES] = 4,
                                [BURNISH_THREEMF_MULTIPLES] = 0};
    int best = 1;
    group->target = BURNISH_THREEMF_NONE;
    for (uint32_t i = 0; i < group->number_count; ++i) {
        const uint32_t id = index_at(threemf, group->first_number, group->number_count, i);
        const burnish_threemf_group *layer = find_group(threemf, group->part, id);
        if (layer && ranks[layer->kind] >= best) {
            best = ranks[layer->kind];
            group->layer = i;
            group->target = (uint32_t)(layer - threemf->groups.items);
        }
    }
}

int burnish_threemf_mix(burnish_threemf *threemf) {
    for (size_t i = 0; i < threemf->groups.count; ++i) {
        burnish_threemf_group *group = &threemf->groups.items[i];
        if (group->kind == BURNISH_THREEMF_COMPOSITES) {
            mix_composites(threemf, group);
        } else if (group->kind == BURNISH_THREEMF_MULTIPLES) {
            choose_layer(threemf, group);
        }
    }
    return threemf->memory->status == BURNISH_STATUS_OK;
}

/* ---- Materials ---- */

static burnish_material material_of_color(const uint8_t color[4]) {
    burnish_material material = burnish_material_default();
    material.has_diffuse = 1;
    for (int i = 0; i < 3; ++i) {
        material.ambient[i] = material.diffuse[i] = burnish_srgb_to_linear[color[i]];
    }
    material.transparency = 1 - (float)color[3] / 255;
    return material;
}

/* Returns 1 + its number; 0 on failure. */
static uint32_t add_material(burnish_threemf *threemf, burnish_material material) {
    burnish_mesh_data *mesh = threemf->reader->mesh;
    if (mesh->material_count == MATERIAL_LIMIT) {
        threemf->status =
            burnish_reader_fail(threemf->reader, BURNISH_STATUS_LIMIT, NULL,
                                "more than %d materials are in use; merge some", MATERIAL_LIMIT);
        return 0;
    }
    mesh->materials =
        burnish_reserve(threemf->memory, mesh->materials, &mesh->material_capacity,
                        mesh->material_count + 1, sizeof *mesh->materials, "materials");
    if (threemf->memory->status != BURNISH_STATUS_OK) {
        return 0;
    }
    mesh->materials[mesh->material_count++] = material;
    return (uint32_t)mesh->material_count;
}

/* The material of triangles without properties. */
static uint32_t use_plain(burnish_threemf *threemf) {
    if (threemf->plain_material == 0) {
        threemf->plain_material = add_material(threemf, burnish_material_default());
    }
    return threemf->plain_material;
}

/* Vertex colours take the place of its own. */
static uint32_t use_colored(burnish_threemf *threemf) {
    threemf->uses_colors = 1;
    if (threemf->colored_material == 0) {
        threemf->colored_material = add_material(threemf, burnish_material_default());
    }
    return threemf->colored_material;
}

static uint32_t use_bases(burnish_threemf *threemf, const burnish_threemf_group *group) {
    uint32_t first = 0;
    for (uint32_t i = 0; i < group->count && threemf->status == BURNISH_STATUS_OK; ++i) {
        const uint32_t number =
            add_material(threemf, material_of_color(threemf->colors.items[group->first + i].rgba));
        first = first ? first : number;
    }
    return first;
}

/* ---- Filaments ---- */

uint32_t burnish_threemf_filament(const burnish_threemf *threemf, uint32_t number) {
    const size_t count = threemf->filaments.count;
    return number > 0 && number <= count ? number : count > 0;
}

int burnish_threemf_use_filaments(burnish_threemf *threemf) {
    for (size_t i = 0; i < threemf->filaments.count; ++i) {
        if (add_material(threemf, material_of_color(threemf->filaments.items[i].srgb)) == 0) {
            return 0;
        }
    }
    return 1;
}

/* ---- Textures ---- */

/* The texture's number in the mesh, decoded at its first use; 0: it can't be loaded. */
static int texture_number(burnish_threemf *threemf, burnish_threemf_texture *texture) {
    burnish_reader *reader = threemf->reader;
    if (texture->number >= 0 || reader->input->options->ignore_textures) {
        return texture->number > 0 ? texture->number : 0;
    }
    const burnish_zip_part *part = burnish_zip_find(&threemf->zip, texture->path);
    uint8_t *bytes;
    size_t size;
    texture->number = 0;
    if (!part) {
        burnish_reader_note(reader, &threemf->missing, NULL,
                            "texture \"%.80s\" is not in the archive", texture->path);
        return 0;
    }
    threemf->status = burnish_zip_read(&threemf->zip, part, &bytes, &size);
    if (threemf->status == BURNISH_STATUS_OK) {
        texture->number =
            burnish_reader_decode_texture(reader, NULL, texture->path, bytes, size, 1);
    }
    burnish_release(threemf->memory->context, bytes);
    return texture->number;
}

static uint32_t use_texture(burnish_threemf *threemf, const burnish_threemf_group *group) {
    static const uint8_t white[4] = {255, 255, 255, 255};
    const burnish_threemf_resource *resource =
        burnish_threemf_find(threemf, group->part, group->target, BURNISH_THREEMF_TEXTURE);
    burnish_threemf_texture *texture = resource ? &threemf->textures.items[resource->index] : NULL;
    const int number = texture ? texture_number(threemf, texture) : 0;
    threemf->uses_coordinates = 1;
    if (number == 0) {
        return use_plain(threemf);
    }
    burnish_material material = material_of_color(white);
    material.textures[BURNISH_TEXTURE_COLOR] =
        (burnish_texture_use){.texture = number,
                              .wrap = {texture->wrap[0], texture->wrap[1]},
                              .is_nearest = texture->is_nearest};
    return add_material(threemf, material);
}

/* ---- Triangles ---- */

/* SolidWorks writes alpha 00 for opaque parts, and fully transparent parts can't be printed. */
static void make_opaque(burnish_threemf *threemf, const burnish_threemf_group *group) {
    for (uint32_t i = 0; group->kind != BURNISH_THREEMF_COORDINATES && i < group->count; ++i) {
        uint8_t *alpha = &threemf->colors.items[group->first + i].rgba[3];
        threemf->invisible_colors += *alpha == 0;
        *alpha = *alpha == 0 ? 255 : *alpha;
    }
}

/* Gives a group its material. Returns 0 on failure. */
static int use_group(burnish_threemf *threemf, burnish_threemf_group *group) {
    if (group->material == 0) {
        make_opaque(threemf, group);
        group->material = group->kind == BURNISH_THREEMF_BASES         ? use_bases(threemf, group)
                          : group->kind == BURNISH_THREEMF_COORDINATES ? use_texture(threemf, group)
                                                                       : use_colored(threemf);
    }
    return group->material != 0;
}

static void note_mixed(burnish_threemf *threemf, burnish_threemf_group *group) {
    if (!group->is_noted && group->kind == BURNISH_THREEMF_MULTIPLES) {
        burnish_reader_note(threemf->reader, &threemf->mixed, NULL,
                            "only the uppermost texture or colour of multiple properties is drawn");
    }
    group->is_noted = 1;
}

/* Resolves a triangle's group id and properties. group becomes NONE without properties. */
static void resolve_triangle(burnish_threemf *threemf, const burnish_threemf_object *object,
                             burnish_threemf_group *group, burnish_threemf_triangle *triangle) {
    int is_good = group != NULL;
    const int corners = is_good && group->kind == BURNISH_THREEMF_BASES ? 1 : 3;
    for (int i = 0; is_good && i < corners; ++i) {
        is_good = triangle->properties[i] < group->count;
    }
    if (is_good && group->kind == BURNISH_THREEMF_MULTIPLES) {
        note_mixed(threemf, group);
        burnish_threemf_group *layer =
            group->target == BURNISH_THREEMF_NONE ? NULL : &threemf->groups.items[group->target];
        for (int i = 0; i < 3; ++i) {
            const burnish_threemf_range range =
                threemf->ranges.items[group->first + triangle->properties[i]];
            const uint32_t index = index_at(threemf, range.first, range.count, group->layer);
            triangle->properties[i] = group->layer < range.count ? index : 0;
            is_good = is_good && layer && triangle->properties[i] < layer->count;
        }
        group = layer;
    }
    triangle->group = is_good ? (uint32_t)(group - threemf->groups.items) : BURNISH_THREEMF_NONE;
    if (!is_good) {
        burnish_reader_note(
            threemf->reader, &threemf->bad_properties, NULL,
            "%s: a triangle of the object refers to missing properties; it is drawn without them",
            burnish_threemf_show(threemf, object->part, object->line).text);
    }
}

void burnish_threemf_settle_values(burnish_threemf *threemf) {
    burnish_mesh_data *mesh = threemf->reader->mesh;
    if (threemf->plain_material > 0 && threemf->uses_colors) {
        mesh->materials[threemf->plain_material - 1].has_diffuse = 1; /* else white replaces it */
    }
    if (threemf->invisible_colors > 0) {
        burnish_reader_warn(
            threemf->reader, NULL, "%zu colour%s fully transparent (alpha 00) and drawn opaque",
            threemf->invisible_colors, threemf->invisible_colors == 1 ? " is" : "s are");
    }
}

int burnish_threemf_use_values(burnish_threemf *threemf, const burnish_threemf_object *object) {
    uint32_t last = 0;
    burnish_threemf_group *group = NULL;
    int is_fine = 1;
    for (uint32_t i = 0; i < object->triangle_count && is_fine; ++i) {
        burnish_threemf_triangle *triangle = &threemf->triangles.items[object->first_triangle + i];
        if (triangle->group == 0) {
            triangle->group = BURNISH_THREEMF_NONE;
        } else {
            group = triangle->group == last ? group
                                            : find_group(threemf, object->part, triangle->group);
            last = triangle->group;
            resolve_triangle(threemf, object, group, triangle);
        }
        is_fine = triangle->group == BURNISH_THREEMF_NONE
                      ? threemf->filaments.count > 0 || use_plain(threemf) != 0
                      : use_group(threemf, &threemf->groups.items[triangle->group]);
    }
    if (threemf->status == BURNISH_STATUS_OK) {
        threemf->status = threemf->memory->status;
    }
    return threemf->status == BURNISH_STATUS_OK;
}

uint16_t burnish_threemf_material_of(const burnish_threemf *threemf,
                                     const burnish_threemf_triangle *triangle) {
    if (triangle->group == BURNISH_THREEMF_NONE) {
        return (uint16_t)(threemf->plain_material - 1);
    }
    const burnish_threemf_group *group = &threemf->groups.items[triangle->group];
    return (uint16_t)(group->material - 1 +
                      (group->kind == BURNISH_THREEMF_BASES ? triangle->properties[0] : 0));
}

#endif
