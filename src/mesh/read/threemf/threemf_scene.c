/* 3MF's build: objects placed in it, and in each other. Objects are first counted, each only once,
 * and then written to the mesh. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include <float.h>

#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/matrix.h"
#include "mesh/read/common/textures.h"

enum {
    VOLUMES_SEARCHED = 256, /* of an object by their ids: bounds the time for each component */
    STEP = 1 << 16          /* triangles between checks for cancellation */
};

/* ---- Who is meant ---- */

static void resolve_placement(burnish_threemf *threemf, burnish_threemf_placement *placement,
                              uint32_t part) {
    const burnish_threemf_resource *resource =
        placement->part == BURNISH_THREEMF_NONE
            ? NULL
            : burnish_threemf_find(threemf, placement->part, placement->id, BURNISH_THREEMF_OBJECT);
    placement->object = resource ? resource->index : BURNISH_THREEMF_NONE;
    if (!resource && placement->part != BURNISH_THREEMF_NONE &&
        (part != 0 || !threemf->parts.items[placement->part].is_skipped)) {
        burnish_reader_note(
            threemf->reader, &threemf->missing, NULL, "%s: object %u does not exist and is ignored",
            burnish_threemf_show(threemf, part, placement->line).text, placement->id);
    }
}

/* For a file without a build, draws all objects that are not part of another. */
static void build_all(burnish_threemf *threemf) {
    static const double identity[12] = BURNISH_MATRIX_IDENTITY;
    for (uint32_t i = 0; i < threemf->objects.count; ++i) {
        const burnish_threemf_object *object = &threemf->objects.items[i];
        burnish_threemf_placement *item =
            object->is_component ? NULL : BURNISH_THREEMF_APPEND(threemf, &threemf->items);
        if (item) {
            *item = (burnish_threemf_placement){.part = object->part,
                                                .line = object->line,
                                                .object = i,
                                                .plate = BURNISH_THREEMF_NONE};
            memcpy(item->matrix, identity, sizeof identity);
        }
    }
    burnish_reader_warn(threemf->reader, NULL, "the build is empty; all objects are drawn");
}

static void resolve_all(burnish_threemf *threemf) {
    for (size_t i = 0; i < threemf->objects.count; ++i) {
        const burnish_threemf_object *object = &threemf->objects.items[i];
        for (uint32_t k = 0; k < object->component_count; ++k) {
            burnish_threemf_placement *component =
                &threemf->components.items[object->first_component + k];
            resolve_placement(threemf, component, object->part);
            if (component->object != BURNISH_THREEMF_NONE) {
                threemf->objects.items[component->object].is_component = 1;
            }
        }
    }
    for (size_t i = 0; i < threemf->items.count; ++i) {
        burnish_threemf_placement *item = &threemf->items.items[i];
        resolve_placement(threemf, item, 0);
        if (item->object != BURNISH_THREEMF_NONE) {
            item->plate = burnish_threemf_plate_of(threemf, item->id,
                                                   threemf->objects.items[item->object].items++);
        }
    }
    if (threemf->items.count == 0 && threemf->objects.count > 0) {
        build_all(threemf);
    }
}

/* ---- Drawing ---- */

/* An object on the way down from an item of the build. */
typedef struct scene_place {
    uint32_t object, next;
    const char *name; /* of its own, or of what holds it */
    burnish_part_role role;
    uint32_t filament;
    double matrix[12];
} scene_place;

typedef struct scene_writer {
    burnish_threemf *threemf;
    burnish_mesh_data *mesh;
    uint64_t triangles, vertices; /* of all that is drawn */
    uint64_t negative_triangles, negative_vertices;
    const burnish_threemf_placement *item;
    size_t part; /* which is next, while triangles are written */
    int has_materials;
} scene_writer;

typedef int use_object(scene_writer *writer, const scene_place *place);

static const burnish_threemf_settings *settings_of(const burnish_threemf *threemf,
                                                   const burnish_threemf_object *object) {
    return object->settings ? &threemf->settings.items[object->settings - 1] : NULL;
}

static void enter_volume(scene_place *place, const burnish_threemf_volume *volume) {
    place->role = place->role == BURNISH_PART_SOLID ? volume->role : place->role;
    place->name = *volume->name ? volume->name : place->name;
    place->filament = volume->filament ? volume->filament : place->filament;
}

/* What its own settings say about an object. A slicer's word about a volume counts more than the
 * type of its object, because slicers differ in the type of what is no part. */
static void enter_object(const burnish_threemf *threemf, scene_place *place,
                         const burnish_threemf_volume *volume) {
    const burnish_threemf_object *object = &threemf->objects.items[place->object];
    const burnish_threemf_settings *settings = settings_of(threemf, object);
    const char *own = settings && *settings->name ? settings->name : object->name;
    place->next = 0;
    place->name = *own ? own : place->name;
    place->filament = settings && settings->filament ? settings->filament : place->filament;
    if (!volume && settings && settings->volume_count == 1 && !settings->has_ranges &&
        object->component_count == 0) { /* its own mesh */
        volume = &threemf->volumes.items[settings->first_volume];
    }
    if (volume) {
        enter_volume(place, volume);
    } else if (!object->is_model && place->role == BURNISH_PART_SOLID) {
        place->role = BURNISH_PART_SUPPORT;
    }
}

/* The volume that is component `number` of an object: the one in its position, or the first with
 * its id; NULL if there is none. */
static const burnish_threemf_volume *find_volume(const burnish_threemf *threemf,
                                                 const burnish_threemf_object *object,
                                                 uint32_t number, uint32_t id) {
    const burnish_threemf_settings *settings = settings_of(threemf, object);
    const uint32_t count = settings && !settings->has_ranges ? settings->volume_count : 0;
    const burnish_threemf_volume *volumes =
        count > 0 ? threemf->volumes.items + settings->first_volume : NULL;
    for (uint32_t i = 0; i <= count && i < VOLUMES_SEARCHED; ++i) {
        const uint32_t at = i == 0 ? number : i - 1;
        if (at < count && volumes[at].id == id) {
            return &volumes[at];
        }
    }
    return NULL;
}

/* Goes down to a component of `from`. */
static void enter_component(const burnish_threemf *threemf, const scene_place *from,
                            uint32_t number, scene_place *to) {
    const burnish_threemf_object *object = &threemf->objects.items[from->object];
    const burnish_threemf_placement *component =
        &threemf->components.items[object->first_component + number];
    const burnish_threemf_volume *volume = find_volume(threemf, object, number, component->id);
    *to = *from;
    burnish_matrix_multiply(from->matrix, component->matrix, to->matrix);
    to->object = component->object;
    enter_object(threemf, to, volume);
}

/* Calls `use` for an object of the build and for everything that it contains, at each place.
 * Objects without triangles are skipped, which limits the steps to the visits. Returns 0 on
 * failure. */
static int walk_objects(scene_writer *writer, use_object *use) {
    burnish_threemf *threemf = writer->threemf;
    scene_place stack[BURNISH_THREEMF_NESTING] = {
        {.object = writer->item->object,
         .name = "",
         .role = writer->item->is_unprinted ? BURNISH_PART_UNPRINTED : BURNISH_PART_SOLID}};
    size_t depth = 1;
    memcpy(stack[0].matrix, writer->item->matrix, sizeof stack[0].matrix);
    if (writer->item->plate != BURNISH_THREEMF_NONE) {
        for (int k = 0; k < 2; ++k) {
            stack[0].matrix[4 * k + 3] += threemf->plates.items[writer->item->plate].shift[k];
        }
    }
    enter_object(threemf, &stack[0], NULL);
    while (depth > 0) {
        const burnish_threemf_object *object = &threemf->objects.items[stack[depth - 1].object];
        const uint32_t next = stack[depth - 1].next++;
        if (next == 0 && object->triangle_count > 0 && !use(writer, &stack[depth - 1])) {
            return 0;
        }
        if (next == object->component_count) {
            --depth;
            continue;
        }
        const burnish_threemf_placement *component =
            &threemf->components.items[object->first_component + next];
        if (component->object != BURNISH_THREEMF_NONE &&
            threemf->objects.items[component->object].triangles > 0) {
            enter_component(threemf, &stack[depth - 1], next, &stack[depth]);
            ++depth;
        }
    }
    return 1;
}

static int walk_all(scene_writer *writer, use_object *use) {
    burnish_threemf *threemf = writer->threemf;
    int is_fine = 1;
    for (size_t i = 0; i < threemf->items.count && is_fine; ++i) {
        writer->item = &threemf->items.items[i];
        const uint32_t object = writer->item->object;
        if (object != BURNISH_THREEMF_NONE && threemf->objects.items[object].triangles > 0) {
            is_fine = walk_objects(writer, use);
        }
    }
    return is_fine;
}

/* The part for triangle `source` of a place, and the end of the triangles for which this holds. */
static burnish_part part_at(const scene_writer *writer, const scene_place *place, uint32_t source,
                            uint32_t *end) {
    const burnish_threemf *threemf = writer->threemf;
    const burnish_threemf_object *object = &threemf->objects.items[place->object];
    const burnish_threemf_settings *settings = settings_of(threemf, object);
    const burnish_threemf_volume *volumes =
        settings && settings->has_ranges ? threemf->volumes.items + settings->first_volume : NULL;
    burnish_part part = {.role = place->role};
    const char *name = place->name;
    uint32_t filament = place->filament, first = 0;
    *end = BURNISH_THREEMF_NONE;
    for (uint32_t last = volumes ? settings->volume_count : 0;
         first < last;) { /* the volumes before `first` begin here or before */
        const uint32_t middle = first + (last - first) / 2;
        if (volumes[middle].first <= source) {
            first = middle + 1;
        } else {
            *end = volumes[middle].first;
            last = middle;
        }
    }
    if (first > 0 && source <= volumes[first - 1].last) {
        const burnish_threemf_volume *volume = &volumes[first - 1];
        name = *volume->name ? volume->name : name;
        part.role = part.role == BURNISH_PART_SOLID ? volume->role : part.role;
        filament = volume->filament ? volume->filament : filament;
        *end = volume->last < *end ? volume->last + 1 : *end;
    }
    part.filament = (int)burnish_threemf_filament(threemf, filament);
    burnish_part_set_name(part.name, name, strlen(name));
    return part;
}

/* Names a part that is not drawn, unless one of that name is already listed. */
static void note_not_drawn(burnish_threemf *threemf, const burnish_part *part) {
    const size_t used = strlen(threemf->not_drawn), room = sizeof threemf->not_drawn - used;
    char line[BURNISH_NAME_SIZE + 40];
    const int size = snprintf(line, sizeof line, *part->name ? "%s%s \"%s\"" : "%s%s",
                              used > 0 ? ", " : "", burnish_part_role_name(part->role), part->name);
    ++threemf->not_drawn_count;
    if (strstr(threemf->not_drawn, line + (used > 0 ? 2 : 0))) {
        return;
    }
    if (threemf->has_more || (size_t)size >= room) {
        threemf->has_more = 1;
    } else {
        memcpy(threemf->not_drawn + used, line, (size_t)size + 1);
    }
}

/* Lists a part, the last one in place of all beyond BURNISH_PARTS_MAX. */
static int list_part_of(scene_writer *writer, const scene_place *place, burnish_part *part) {
    burnish_threemf *threemf = writer->threemf;
    burnish_mesh_data *mesh = writer->mesh;
    part->id = writer->item->id;
    part->item = (uint32_t)(writer->item - threemf->items.items);
    part->plate = writer->item->plate == BURNISH_THREEMF_NONE
                      ? 0
                      : threemf->plates.items[writer->item->plate].number;
    memcpy(part->transform, place->matrix, sizeof part->transform);
    if (part->role != BURNISH_PART_SOLID && part->role != BURNISH_PART_NEGATIVE) {
        note_not_drawn(threemf, part);
    }
    if (mesh->part_count == BURNISH_PARTS_MAX) {
        return 1;
    }
    mesh->parts = burnish_reserve(threemf->memory, mesh->parts, &mesh->part_capacity,
                                  mesh->part_count + 1, sizeof *mesh->parts, "parts");
    if (threemf->memory->status == BURNISH_STATUS_OK) {
        mesh->parts[mesh->part_count++] = *part;
    }
    return threemf->memory->status == BURNISH_STATUS_OK;
}

/* Extends the box of an item's plate by an object. */
static void extend_plate(scene_writer *writer, const burnish_threemf_object *object,
                         const double m[12]) {
    burnish_threemf *threemf = writer->threemf;
    if (writer->item->plate == BURNISH_THREEMF_NONE || threemf->plates.count < 2) {
        return;
    }
    double(*box)[2] = threemf->plate_boxes[writer->item->plate];
    for (uint32_t i = 0; i < object->vertex_count; ++i) {
        const float *p = threemf->vertices.items[object->first_vertex + i].xyz;
        for (int k = 0; k < 2; ++k) {
            const double *r = m + 4 * k;
            const double at =
                r[0] * (double)p[0] + r[1] * (double)p[1] + r[2] * (double)p[2] + r[3];
            box[0][k] = at < box[0][k] ? at : box[0][k];
            box[1][k] = at > box[1][k] ? at : box[1][k];
        }
    }
}

/* Lists the parts of an object at a place, and counts what is drawn of it. Resolves the properties
 * of its triangles at the first use. */
static int prepare_object(scene_writer *writer, const scene_place *place) {
    burnish_threemf *threemf = writer->threemf;
    burnish_threemf_object *object = &threemf->objects.items[place->object];
    const burnish_threemf_triangle *triangles = threemf->triangles.items + object->first_triangle;
    uint64_t drawn = 0, negative = 0;
    for (uint32_t i = 0, end; i < object->triangle_count;) {
        const uint32_t first = i;
        burnish_part part = part_at(writer, place, triangles[i].source, &end);
        while (i < object->triangle_count && triangles[i].source < end) {
            ++i;
        }
        part.triangle_count = i - first;
        drawn += part.role == BURNISH_PART_SOLID ? part.triangle_count : 0;
        negative += part.role == BURNISH_PART_NEGATIVE ? part.triangle_count : 0;
        if (!list_part_of(writer, place, &part)) {
            return 0;
        }
    }
    writer->triangles += drawn;
    writer->vertices += drawn > 0 ? object->vertex_count : 0;
    writer->negative_triangles += negative;
    writer->negative_vertices += negative > 0 ? object->vertex_count : 0;
    if (drawn > 0) {
        extend_plate(writer, object, place->matrix);
    }
    if (drawn > 0 && object->state == 2) {
        object->state = 3;
        return burnish_threemf_use_values(threemf, object);
    }
    return 1;
}

static int put_vertices(scene_writer *writer, burnish_mesh_data *mesh,
                        const burnish_threemf_object *object, const double m[12]) {
    burnish_threemf *threemf = writer->threemf;
    burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    float *to = (float *)positions->items + 3 * positions->count;
    for (uint32_t i = 0; i < object->vertex_count; ++i, to += 3) {
        const float *p = threemf->vertices.items[object->first_vertex + i].xyz;
        for (int row = 0; row < 3; ++row) {
            const double *r = m + 4 * row;
            const double moved =
                r[0] * (double)p[0] + r[1] * (double)p[1] + r[2] * (double)p[2] + r[3];
            if (!burnish_place(moved, mesh->origin[row], &to[row])) {
                threemf->status = burnish_reader_fail(
                    threemf->reader, BURNISH_STATUS_FORMAT, NULL,
                    "%s: a position of the object is placed beyond 3.4e38; repair the transforms",
                    burnish_threemf_show(threemf, object->part, object->line).text);
                return 0;
            }
        }
    }
    positions->count += object->vertex_count;
    return 1;
}

/* Mirroring reverses the triangles. */
static int is_mirrored(const double m[12]) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
               m[2] * (m[4] * m[9] - m[5] * m[8]) <
           0;
}

static void put_triangle(const scene_writer *writer, burnish_mesh_data *mesh,
                         const burnish_threemf_triangle *triangle, uint32_t base, int is_turned,
                         uint32_t filament) {
    burnish_threemf *threemf = writer->threemf;
    const int is_drawn = mesh == writer->mesh;
    const uint32_t paint = triangle->paint <= threemf->filaments.count ? triangle->paint : 0;
    const burnish_threemf_group *group = paint || triangle->group >= threemf->groups.count
                                             ? NULL
                                             : &threemf->groups.items[triangle->group];
    const int has_coordinates = group && group->kind == BURNISH_THREEMF_COORDINATES;
    const int has_colors = group && (group->kind == BURNISH_THREEMF_COLORS ||
                                     group->kind == BURNISH_THREEMF_COMPOSITES);
    for (int k = 0; k < 3; ++k) {
        const int from = is_turned && k > 0 ? 3 - k : k;
        const size_t at = 3 * mesh->triangle_count + (size_t)k;
        mesh->streams[BURNISH_POSITION].corners[at] = base + triangle->corners[from];
        if (threemf->uses_colors && is_drawn) { /* the first is white */
            mesh->streams[BURNISH_COLOR].corners[at] =
                has_colors ? group->first + triangle->properties[from] : 0;
        }
        if (threemf->uses_coordinates && is_drawn) {
            mesh->streams[BURNISH_TEXCOORD].corners[at] =
                has_coordinates ? group->first + triangle->properties[from] : BURNISH_NONE;
        }
    }
    if (writer->has_materials && is_drawn) {
        mesh->triangle_materials[mesh->triangle_count] =
            paint || (!group && filament) ? (uint16_t)((paint ? paint : filament) - 1)
                                          : burnish_threemf_material_of(threemf, triangle);
    }
    burnish_threemf_owner *owner = threemf->heights.count > 0 && is_drawn
                                       ? BURNISH_THREEMF_APPEND(threemf, &threemf->owners)
                                       : NULL;
    if (owner) {
        owner->item = (uint32_t)(writer->item - threemf->items.items);
        owner->is_fixed = paint || group || !filament;
    }
    if (mesh->triangle_parts) {
        const size_t last = writer->mesh->part_count - 1;
        mesh->triangle_parts[mesh->triangle_count] =
            (uint16_t)(writer->part < last ? writer->part : last);
    }
}

static int write_object(scene_writer *writer, const scene_place *place) {
    burnish_threemf *threemf = writer->threemf;
    const burnish_threemf_object *object = &threemf->objects.items[place->object];
    const burnish_threemf_triangle *triangles = threemf->triangles.items + object->first_triangle;
    uint32_t bases[2] = {BURNISH_THREEMF_NONE, BURNISH_THREEMF_NONE};
    const int is_turned = is_mirrored(place->matrix);
    for (uint32_t i = 0, end; i < object->triangle_count; ++writer->part) {
        const burnish_part part = part_at(writer, place, triangles[i].source, &end);
        const int is_negative = part.role == BURNISH_PART_NEGATIVE;
        burnish_mesh_data *mesh = is_negative                       ? writer->mesh->negatives
                                  : part.role == BURNISH_PART_SOLID ? writer->mesh
                                                                    : NULL;
        uint32_t *base = &bases[is_negative];
        if (mesh && *base == BURNISH_THREEMF_NONE) {
            *base = (uint32_t)mesh->streams[BURNISH_POSITION].count;
            if (!put_vertices(writer, mesh, object, place->matrix)) {
                return 0;
            }
        }
        for (; i < object->triangle_count && triangles[i].source < end; ++i) {
            if (!mesh) {
                continue;
            }
            put_triangle(writer, mesh, &triangles[i], *base, is_turned, (uint32_t)part.filament);
            if (++mesh->triangle_count % STEP == 0) {
                threemf->status = burnish_tasks_check(mesh->tasks, threemf->reader->error);
                if (threemf->status != BURNISH_STATUS_OK) {
                    return 0;
                }
            }
        }
    }
    return 1;
}

/* ---- The whole ---- */

/* Corners index colours and coordinates, so all placements share the file's values. */
static int copy_values(scene_writer *writer, burnish_attribute attribute, const void *items,
                       size_t count) {
    burnish_mesh_data *mesh = writer->mesh;
    if (burnish_mesh_data_reserve(mesh, attribute, count) == BURNISH_STATUS_OK &&
        burnish_mesh_data_reserve_corners(mesh, attribute, (size_t)writer->triangles) ==
            BURNISH_STATUS_OK) {
        memcpy(mesh->streams[attribute].items, items, count * burnish_attribute_size(attribute));
        mesh->streams[attribute].count = count;
    }
    return mesh->memory.status == BURNISH_STATUS_OK;
}

/* Arrays for the negative volumes, if there are some. */
static void reserve_negatives(scene_writer *writer) {
    burnish_memory *memory = writer->threemf->memory;
    burnish_mesh_data *made =
        writer->negative_triangles > 0
            ? burnish_allocate_zeroed(memory, 1, sizeof *made, "negative volumes")
            : NULL;
    if (made) {
        *made = burnish_mesh_data_begin(memory->context, writer->mesh->tasks, memory->error);
        memcpy(made->origin, writer->mesh->origin, sizeof made->origin);
        made->is_silent = 1;
        writer->mesh->negatives = made;
        burnish_mesh_data_reserve(made, BURNISH_POSITION, (size_t)writer->negative_vertices);
        burnish_mesh_data_reserve_corners(made, BURNISH_POSITION,
                                          (size_t)writer->negative_triangles);
        made->triangle_parts = burnish_reserve_discard(
            &made->memory, NULL, &made->triangle_part_capacity, (size_t)writer->negative_triangles,
            sizeof *made->triangle_parts, "triangle parts");
        memory->status = made->memory.status;
    }
}

static int reserve_arrays(scene_writer *writer) {
    burnish_threemf *threemf = writer->threemf;
    burnish_mesh_data *mesh = writer->mesh;
    threemf->uses_coordinates =
        threemf->uses_coordinates &&
        burnish_reader_keeps_coordinates(threemf->reader, mesh->texture_count > 0);
    writer->has_materials = mesh->material_count > 1;
    if (mesh->part_count > 1) {
        mesh->triangle_parts = burnish_reserve_discard(
            threemf->memory, mesh->triangle_parts, &mesh->triangle_part_capacity,
            (size_t)writer->triangles, sizeof *mesh->triangle_parts, "triangle parts");
    }
    burnish_mesh_data_reserve(mesh, BURNISH_POSITION, (size_t)writer->vertices);
    burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, (size_t)writer->triangles);
    if (threemf->uses_colors) {
        copy_values(writer, BURNISH_COLOR, threemf->colors.items, threemf->colors.count);
    }
    if (threemf->uses_coordinates) {
        copy_values(writer, BURNISH_TEXCOORD, threemf->coordinates.items,
                    threemf->coordinates.count);
    }
    if (writer->has_materials) {
        mesh->triangle_materials = burnish_reserve_discard(
            threemf->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
            (size_t)writer->triangles, sizeof *mesh->triangle_materials, "triangle materials");
    }
    if (threemf->memory->status == BURNISH_STATUS_OK) {
        reserve_negatives(writer);
    }
    threemf->status = threemf->memory->status;
    return threemf->status == BURNISH_STATUS_OK;
}

/* Six times the volume of a part, whose corners are seen from its first one. */
typedef struct part_volume {
    const float *from;
    double volume;
} part_volume;

static void add_volume(part_volume *part, const float *positions, const uint32_t *corners) {
    double p[3][3];
    part->from = part->from ? part->from : positions + 3 * (size_t)corners[0];
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < 3; ++k) {
            p[c][k] = (double)positions[3 * (size_t)corners[c] + (size_t)k] - (double)part->from[k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        part->volume += p[0][k] * (p[1][l] * p[2][m] - p[1][m] * p[2][l]);
    }
}

/* Turns the parts of a mesh that are inside out: what is subtracted, and from what, is between
 * fronts and backs. Returns 0 on failure. */
static int orient_parts(const scene_writer *writer, burnish_mesh_data *mesh) {
    part_volume *volumes = burnish_allocate_zeroed(
        writer->threemf->memory, writer->mesh->part_count, sizeof *volumes, "volumes of parts");
    for (size_t i = 0; volumes && i < mesh->triangle_count; ++i) {
        add_volume(&volumes[mesh->triangle_parts[i]], burnish_positions(mesh),
                   mesh->streams[BURNISH_POSITION].corners + 3 * i);
    }
    for (int k = 0; volumes && k < BURNISH_ATTRIBUTE_COUNT; ++k) {
        uint32_t *corners = mesh->streams[k].corners;
        for (size_t i = 0; corners && i < mesh->triangle_count; ++i) {
            if (volumes[mesh->triangle_parts[i]].volume < 0) {
                const uint32_t second = corners[3 * i + 1];
                corners[3 * i + 1] = corners[3 * i + 2];
                corners[3 * i + 2] = second;
            }
        }
    }
    burnish_release(writer->threemf->memory->context, volumes);
    return volumes != NULL;
}

/* Only negative volumes need to know inside from outside. */
static int orient_volumes(const scene_writer *writer) {
    burnish_mesh_data *negatives = writer->mesh->negatives;
    return !negatives || (orient_parts(writer, negatives) && orient_parts(writer, writer->mesh));
}

int burnish_threemf_write_scene(burnish_threemf *threemf) {
    scene_writer writer = {.threemf = threemf, .mesh = threemf->reader->mesh};
    resolve_all(threemf);
    burnish_threemf_number_objects(threemf);
    for (int i = 0; i < BURNISH_THREEMF_PLATES; ++i) {
        for (int k = 0; k < 2; ++k) {
            threemf->plate_boxes[i][0][k] = DBL_MAX;
            threemf->plate_boxes[i][1][k] = -DBL_MAX;
        }
    }
    if (!burnish_threemf_choose_plates(threemf) || !burnish_threemf_use_filaments(threemf) ||
        !burnish_threemf_count(threemf) || !walk_all(&writer, prepare_object)) {
        return 0;
    }
    burnish_threemf_place_plates(threemf);
    if (writer.triangles == 0) {
        threemf->is_empty = 1;
        threemf->status = burnish_reader_fail(threemf->reader, BURNISH_STATUS_FORMAT, NULL,
                                              "no triangles are built; export the model's meshes");
        return 0;
    }
    if (writer.vertices > BURNISH_VALUE_LIMIT) {
        threemf->status = burnish_reader_fail(threemf->reader, BURNISH_STATUS_LIMIT, NULL,
                                              "more than %zu vertices are built; split the model",
                                              BURNISH_VALUE_LIMIT);
        return 0;
    }
    return reserve_arrays(&writer) && walk_all(&writer, write_object) && orient_volumes(&writer) &&
           burnish_threemf_split_heights(threemf);
}

#endif
