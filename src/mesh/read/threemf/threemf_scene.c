/* 3MF's build: objects placed in it, and in each other. Objects are first counted, each only once,
 * and then written to the mesh. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/textures.h"
#include "mesh/read/io/budget.h"

enum {
    NESTING_MOST = 64,     /* objects in objects */
    VISITS_MOST = 1 << 22, /* objects that are placed, including those that only contain others */
    STEP = 1 << 16         /* triangles between checks for cancellation */
};

static int scene_fail(burnish_threemf *threemf, burnish_status status,
                      const burnish_threemf_placement *placement, uint32_t part, const char *what) {
    threemf->status =
        burnish_reader_fail(threemf->reader, status, NULL, "%s: %s",
                            burnish_threemf_show(threemf, part, placement->line).text, what);
    return 0;
}

/* ---- Who is meant ---- */

static void resolve_placement(burnish_threemf *threemf, burnish_threemf_placement *placement,
                              uint32_t part) {
    const burnish_threemf_resource *resource =
        placement->part == BURNISH_THREEMF_NONE
            ? NULL
            : burnish_threemf_find(threemf, placement->part, placement->id, BURNISH_THREEMF_OBJECT);
    placement->object = resource ? resource->index : BURNISH_THREEMF_NONE;
    if (!resource && placement->part != BURNISH_THREEMF_NONE) {
        burnish_reader_note(
            threemf->reader, &threemf->missing, NULL, "%s: object %u does not exist and is ignored",
            burnish_threemf_show(threemf, part, placement->line).text, placement->id);
    }
}

/* For a file without a build, draws all objects that are not part of another. */
static void build_all(burnish_threemf *threemf) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    for (uint32_t i = 0; i < threemf->objects.count; ++i) {
        const burnish_threemf_object *object = &threemf->objects.items[i];
        burnish_threemf_placement *item =
            object->is_component ? NULL : BURNISH_THREEMF_APPEND(threemf, &threemf->items);
        if (item) {
            *item = (burnish_threemf_placement){
                .part = object->part, .line = object->line, .object = i};
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
        resolve_placement(threemf, &threemf->items.items[i], 0);
    }
    if (threemf->items.count == 0 && threemf->objects.count > 0) {
        build_all(threemf);
    }
}

/* ---- Counting ---- */

static uint64_t add_saturated(uint64_t a, uint64_t b) {
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/* Objects that can't be drawn, or need a warning. */
static int check_object(burnish_threemf *threemf, const burnish_threemf_object *object) {
    if (object->has_beams) {
        threemf->status = burnish_reader_fail(
            threemf->reader, BURNISH_STATUS_FORMAT, NULL,
            "%s: an object is made of beams (beam lattice), which are not drawn; export its mesh",
            burnish_threemf_show(threemf, object->part, object->line).text);
    }
    if (object->has_slices) {
        burnish_reader_note(threemf->reader, &threemf->slices, NULL,
                            "%s: slices are not drawn, the object's mesh is",
                            burnish_threemf_show(threemf, object->part, object->line).text);
    }
    return threemf->status == BURNISH_STATUS_OK;
}

/* Adds up triangles and visits of an object after its components. */
static void sum_object(burnish_threemf *threemf, burnish_threemf_object *object) {
    object->triangles = object->triangle_count;
    object->vertices = object->triangle_count > 0 ? object->vertex_count : 0;
    object->visits = 1;
    for (uint32_t k = 0; k < object->component_count; ++k) {
        const uint32_t number = threemf->components.items[object->first_component + k].object;
        const burnish_threemf_object *part =
            number == BURNISH_THREEMF_NONE ? NULL : &threemf->objects.items[number];
        if (part && part->triangles > 0) {
            object->triangles = add_saturated(object->triangles, part->triangles);
            object->vertices = add_saturated(object->vertices, part->vertices);
            object->visits = add_saturated(object->visits, part->visits);
        }
    }
    object->state = 2;
}

/* Counts an object and its components, which come first, each once. */
static int count_object(burnish_threemf *threemf, const burnish_threemf_placement *item) {
    struct {
        uint32_t object, next;
    } stack[NESTING_MOST];
    size_t depth = 0;
    if (threemf->objects.items[item->object].state == 2) {
        return 1;
    }
    stack[depth].object = item->object;
    stack[depth++].next = 0;
    while (depth > 0) {
        burnish_threemf_object *object = &threemf->objects.items[stack[depth - 1].object];
        const uint32_t next = stack[depth - 1].next++;
        if (object->state == 0 && !check_object(threemf, object)) {
            return 0;
        }
        object->state = 1;
        if (next == object->component_count) {
            sum_object(threemf, object);
            --depth;
            continue;
        }
        const burnish_threemf_placement *component =
            &threemf->components.items[object->first_component + next];
        const int state = component->object == BURNISH_THREEMF_NONE
                              ? 2
                              : threemf->objects.items[component->object].state;
        if (state == 1) {
            return scene_fail(threemf, BURNISH_STATUS_FORMAT, component, object->part,
                              "an object holds itself; repair the file");
        }
        if (state == 0 && depth == NESTING_MOST) {
            return scene_fail(threemf, BURNISH_STATUS_LIMIT, component, object->part,
                              "objects are nested more than 64 deep; export them flat");
        }
        if (state == 0) {
            stack[depth].object = component->object;
            stack[depth++].next = 0;
        }
    }
    return 1;
}

/* ---- Drawing ---- */

/* Matrices of objects in objects, down to the one that is drawn. */
typedef struct scene_writer {
    burnish_threemf *threemf;
    burnish_mesh_data *mesh;
    uint64_t triangles, vertices; /* of all that is drawn */
    int has_materials;
} scene_writer;

typedef int use_object(scene_writer *writer, burnish_threemf_object *object,
                       const double matrix[12]);

static void multiply_matrices(const double a[12], const double b[12], double product[12]) {
    for (int row = 0; row < 3; ++row) {
        const double *r = a + 4 * row;
        for (int k = 0; k < 4; ++k) {
            product[4 * row + k] = r[0] * b[k] + r[1] * b[4 + k] + r[2] * b[8 + k];
        }
        product[4 * row + 3] += r[3];
    }
}

/* Calls `use` for an object of the build and for everything that it contains, at each place.
 * Objects without triangles are skipped, which limits the steps to the visits. Returns 0 on
 * failure. */
static int walk_objects(scene_writer *writer, const burnish_threemf_placement *item,
                        use_object *use) {
    burnish_threemf *threemf = writer->threemf;
    struct {
        uint32_t object, next;
        double matrix[12];
    } stack[NESTING_MOST];
    size_t depth = 1;
    stack[0].object = item->object;
    stack[0].next = 0;
    memcpy(stack[0].matrix, item->matrix, sizeof item->matrix);
    while (depth > 0) {
        burnish_threemf_object *object = &threemf->objects.items[stack[depth - 1].object];
        const uint32_t next = stack[depth - 1].next++;
        if (next == 0 && object->triangle_count > 0 &&
            !use(writer, object, stack[depth - 1].matrix)) {
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
            multiply_matrices(stack[depth - 1].matrix, component->matrix, stack[depth].matrix);
            stack[depth].object = component->object;
            stack[depth++].next = 0;
        }
    }
    return 1;
}

static int walk_all(scene_writer *writer, use_object *use) {
    burnish_threemf *threemf = writer->threemf;
    int is_fine = 1;
    for (size_t i = 0; i < threemf->items.count && is_fine; ++i) {
        const burnish_threemf_placement *item = &threemf->items.items[i];
        const burnish_threemf_object *object =
            item->object == BURNISH_THREEMF_NONE ? NULL : &threemf->objects.items[item->object];
        if (object && object->triangles > 0) {
            is_fine = walk_objects(writer, item, use);
        }
    }
    return is_fine;
}

/* Resolves the properties of an object's triangles at its first use, and counts its vertices. */
static int prepare_object(scene_writer *writer, burnish_threemf_object *object,
                          const double matrix[12]) {
    (void)matrix;
    writer->vertices += object->vertex_count;
    if (object->state == 2) {
        object->state = 3;
        return burnish_threemf_use_values(writer->threemf, object);
    }
    return 1;
}

static int put_vertices(scene_writer *writer, const burnish_threemf_object *object,
                        const double m[12]) {
    burnish_threemf *threemf = writer->threemf;
    burnish_stream *positions = &writer->mesh->streams[BURNISH_POSITION];
    float *to = (float *)positions->items + 3 * positions->count;
    for (uint32_t i = 0; i < object->vertex_count; ++i, to += 3) {
        const float *p = threemf->vertices.items[object->first_vertex + i].xyz;
        for (int row = 0; row < 3; ++row) {
            const double *r = m + 4 * row;
            const double moved =
                r[0] * (double)p[0] + r[1] * (double)p[1] + r[2] * (double)p[2] + r[3];
            if (!burnish_place(moved, writer->mesh->origin[row], &to[row])) {
                threemf->status = burnish_reader_fail(
                    threemf->reader, BURNISH_STATUS_FORMAT, NULL,
                    "%s: a position of the object is placed beyond 3.4e38; repair the transforms",
                    burnish_threemf_show(threemf, object->part, object->line).text);
                return 0;
            }
        }
    }
    return 1;
}

/* Mirroring reverses the triangles. */
static int is_mirrored(const double m[12]) {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
               m[2] * (m[4] * m[9] - m[5] * m[8]) <
           0;
}

static void put_triangle(const scene_writer *writer, const burnish_threemf_triangle *triangle,
                         uint32_t base, int is_turned) {
    const burnish_threemf *threemf = writer->threemf;
    burnish_mesh_data *mesh = writer->mesh;
    const burnish_threemf_group *group =
        triangle->group == BURNISH_THREEMF_NONE ? NULL : &threemf->groups.items[triangle->group];
    const int has_coordinates = group && group->kind == BURNISH_THREEMF_COORDINATES;
    const int has_colors = group && (group->kind == BURNISH_THREEMF_COLORS ||
                                     group->kind == BURNISH_THREEMF_COMPOSITES);
    for (int k = 0; k < 3; ++k) {
        const int from = is_turned && k > 0 ? 3 - k : k;
        const size_t at = 3 * mesh->triangle_count + (size_t)k;
        mesh->streams[BURNISH_POSITION].corners[at] = base + triangle->corners[from];
        if (threemf->uses_colors) { /* the first is white */
            mesh->streams[BURNISH_COLOR].corners[at] =
                has_colors ? group->first + triangle->properties[from] : 0;
        }
        if (threemf->uses_coordinates) {
            mesh->streams[BURNISH_TEXCOORD].corners[at] =
                has_coordinates ? group->first + triangle->properties[from] : BURNISH_NONE;
        }
    }
    if (writer->has_materials) {
        mesh->triangle_materials[mesh->triangle_count] =
            burnish_threemf_material_of(threemf, triangle);
    }
}

static int write_object(scene_writer *writer, burnish_threemf_object *object,
                        const double matrix[12]) {
    burnish_threemf *threemf = writer->threemf;
    burnish_mesh_data *mesh = writer->mesh;
    const uint32_t base = (uint32_t)mesh->streams[BURNISH_POSITION].count;
    const int is_turned = is_mirrored(matrix);
    if (!put_vertices(writer, object, matrix)) {
        return 0;
    }
    mesh->streams[BURNISH_POSITION].count += object->vertex_count;
    for (uint32_t i = 0; i < object->triangle_count; ++i) {
        put_triangle(writer, &threemf->triangles.items[object->first_triangle + i], base,
                     is_turned);
        if (++mesh->triangle_count % STEP == 0) {
            threemf->status = burnish_tasks_check(mesh->tasks, threemf->reader->error);
            if (threemf->status != BURNISH_STATUS_OK) {
                return 0;
            }
        }
    }
    return 1;
}

/* ---- The whole ---- */

static int count_all(scene_writer *writer) {
    burnish_threemf *threemf = writer->threemf;
    uint64_t visits = 0, vertices = 0;
    for (size_t i = 0; i < threemf->items.count; ++i) {
        burnish_threemf_placement *item = &threemf->items.items[i];
        if (item->object == BURNISH_THREEMF_NONE) {
            continue;
        }
        const burnish_threemf_object *object = &threemf->objects.items[item->object];
        if (!object->is_model) {
            burnish_reader_note(
                threemf->reader, &threemf->not_drawn, NULL,
                "%s: an object that is not a model (a support, for example) is not drawn",
                burnish_threemf_show(threemf, object->part, object->line).text);
            item->object = BURNISH_THREEMF_NONE;
            continue;
        }
        if (!count_object(threemf, item)) {
            return 0;
        }
        writer->triangles = add_saturated(writer->triangles, object->triangles);
        vertices = add_saturated(vertices, object->vertices);
        visits = add_saturated(visits, object->visits);
    }
    const burnish_load_options *options = threemf->reader->input->options;
    threemf->status = burnish_budget_check(threemf->reader, vertices, writer->triangles);
    if (threemf->status != BURNISH_STATUS_OK) {
        return 0;
    }
    if (writer->triangles > options->max_triangles) {
        threemf->status = burnish_fail_triangles(threemf->reader, NULL);
    } else if (visits > VISITS_MOST) {
        threemf->status = burnish_reader_fail(
            threemf->reader, BURNISH_STATUS_LIMIT, NULL,
            "its build places more than %d objects; export it flat", VISITS_MOST);
    } else if (writer->triangles == 0) {
        threemf->status = burnish_reader_fail(threemf->reader, BURNISH_STATUS_FORMAT, NULL,
                                              "no triangles are built; export the model's meshes");
    }
    return threemf->status == BURNISH_STATUS_OK;
}

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

static int reserve_arrays(scene_writer *writer) {
    burnish_threemf *threemf = writer->threemf;
    burnish_mesh_data *mesh = writer->mesh;
    threemf->uses_coordinates =
        threemf->uses_coordinates &&
        burnish_reader_keeps_coordinates(threemf->reader, mesh->texture_count > 0);
    writer->has_materials = mesh->material_count > 1;
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
    threemf->status = threemf->memory->status;
    return threemf->status == BURNISH_STATUS_OK;
}

int burnish_threemf_write_scene(burnish_threemf *threemf) {
    scene_writer writer = {.threemf = threemf, .mesh = threemf->reader->mesh};
    resolve_all(threemf);
    if (!count_all(&writer) || !walk_all(&writer, prepare_object)) {
        return 0;
    }
    if (writer.vertices > BURNISH_VALUE_LIMIT) {
        threemf->status = burnish_reader_fail(threemf->reader, BURNISH_STATUS_LIMIT, NULL,
                                              "more than %zu vertices are built; split the model",
                                              BURNISH_VALUE_LIMIT);
        return 0;
    }
    return reserve_arrays(&writer) && walk_all(&writer, write_object);
}

#endif
