/* From what a reader hands over to a scene: drop, weld, orient, make normals, number vertices.
 *
 * Triangles keep the order of the file. meshoptimizer's vertex cache order is left out on purpose:
 * it helps hardware that transforms a vertex once per use, burnish transforms each once, and its
 * cost is quadratic in the faces around a vertex (a fan of 80,000 takes 5 s, version 0.18). */
#include <string.h>

#include "scene/normals.h"
#include "scene/scene.h"
#include "scene/source.h"
#include "scene/text.h"
#include "scene/weld.h"

/* One vertex of the result while they are collected. */
typedef struct built_vertex {
    uint32_t position; /* number of the welded position */
    float normal[3];
    uint32_t color; /* the four bytes */
} built_vertex;

typedef struct builder {
    burnish_source *source;
    const char *name;
    burnish_error *error;
    burnish_scene *scene;

    size_t position_count;     /* welded positions, at the head of source->positions */
    size_t triangle_count;     /* triangles with area, at the head of the source's arrays */
    uint32_t *corner_vertices; /* 3 a triangle: welded positions */

    uint32_t *first_corner; /* position_count + 1: where a position's corners start in ... */
    uint32_t *corners;      /* ... all corners, by position */
    size_t max_faces;       /* around one position */
    int has_colors;

    built_vertex *vertices;
    size_t vertex_count, vertex_capacity;
} builder;

static burnish_status check_counts(const builder *b, const burnish_load_options *options) {
    size_t count = b->source->triangle_count;
    uint64_t limit = options->max_triangles < BURNISH_TRIANGLE_LIMIT ? options->max_triangles
                                                                     : BURNISH_TRIANGLE_LIMIT;
    if (count > limit) {
        return burnish_fail_at(b->error, BURNISH_STATUS_LIMIT, burnish_place_file(b->name),
                               "%zu triangles are more than the limit of %llu; "
                               "raise the limit or simplify the mesh",
                               count, (unsigned long long)limit);
    }
    return BURNISH_STATUS_OK;
}

/* Moves the different positions to the head of the array; remap gives each old one its new number.
 */
static burnish_status weld_positions(builder *b, uint32_t **remap) {
    burnish_source *source = b->source;
    for (size_t i = 0; i < 3 * source->position_count; ++i) {
        source->positions[i] += 0.0f; /* -0 becomes 0 */
    }
    burnish_status status = burnish_allocate((void **)remap, source->position_count, sizeof **remap,
                                             "welding", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_weld(source->positions, source->position_count, *remap, &b->position_count,
                              b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        size_t next = 0;
        for (size_t i = 0; i < source->position_count; ++i) {
            if ((*remap)[i] == next) {
                memmove(source->positions + 3 * next++, source->positions + 3 * i,
                        3 * sizeof(float));
            }
        }
    }
    return status;
}

/* Moves the triangles with area to the head of the source's arrays and fills corner_vertices. */
static burnish_status keep_triangles(builder *b, const uint32_t *remap) {
    burnish_source *source = b->source;
    size_t kept = 0;
    burnish_status status = burnish_allocate((void **)&b->corner_vertices, source->triangle_count,
                                             3 * sizeof *b->corner_vertices, "triangles", b->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < source->triangle_count; ++i) {
        uint32_t *vertices = b->corner_vertices + 3 * kept;
        for (int k = 0; k < 3; ++k) {
            vertices[k] = remap[source->corner_positions[3 * i + k]];
        }
        burnish_vec3 cross = burnish_face_cross(source->positions, vertices);
        if (cross.x == 0 && cross.y == 0 && cross.z == 0) {
            continue; /* a repeated position makes an edge, and so the product, exactly 0 */
        }
        memmove(source->corner_positions + 3 * kept, source->corner_positions + 3 * i,
                3 * sizeof(uint32_t));
        if (source->corner_normals) {
            memmove(source->corner_normals + 3 * kept, source->corner_normals + 3 * i,
                    3 * sizeof(uint32_t));
        }
        if (source->triangle_materials) {
            source->triangle_materials[kept] = source->triangle_materials[i];
        }
        ++kept;
    }
    if (kept == 0) {
        return burnish_fail_at(b->error, BURNISH_STATUS_FORMAT, burnish_place_file(b->name),
                               "no triangle has any area; %zu triangles were read, and a mesh "
                               "needs at least one whose corners are not on a line",
                               source->triangle_count);
    }
    if (kept < source->triangle_count) {
        burnish_warn_at(source, burnish_place_file(b->name),
                        "%zu of %zu triangles have no area and were left out",
                        source->triangle_count - kept, source->triangle_count);
    }
    b->triangle_count = kept;
    return BURNISH_STATUS_OK;
}

/* Makes the file's normals unit vectors; those without a direction become 0: to be made. */
static void prepare_normals(burnish_source *source) {
    for (size_t i = 0; i < source->normal_count; ++i) {
        burnish_store_unit(burnish_vec3_loadf(source->normals + 3 * i), source->normals + 3 * i);
    }
}

/* The file's normal of a corner, or NULL when one must be made. */
static const float *file_normal(const burnish_source *source, size_t corner) {
    if (!source->corner_normals || source->corner_normals[corner] == BURNISH_SOURCE_NONE) {
        return NULL;
    }
    const float *n = source->normals + 3 * (size_t)source->corner_normals[corner];
    return n[0] != 0 || n[1] != 0 || n[2] != 0 ? n : NULL;
}

static void swap_corners(uint32_t *corners, size_t triangle) {
    if (corners) {
        uint32_t second = corners[3 * triangle + 1];
        corners[3 * triangle + 1] = corners[3 * triangle + 2];
        corners[3 * triangle + 2] = second;
    }
}

/* Turns triangles whose winding contradicts the file's normals. It comes before normals are made,
 * because those follow the winding. */
static void orient(builder *b) {
    burnish_source *source = b->source;
    for (size_t i = 0; source->corner_normals && i < b->triangle_count; ++i) {
        burnish_vec3 sum = {0, 0, 0};
        for (size_t corner = 3 * i; corner < 3 * i + 3; ++corner) {
            const float *normal = file_normal(source, corner);
            if (normal) {
                sum = burnish_vec3_add(sum, burnish_vec3_loadf(normal));
            }
        }
        burnish_vec3 cross = burnish_face_cross(source->positions, b->corner_vertices + 3 * i);
        if (burnish_vec3_dot(cross, sum) < 0) {
            swap_corners(b->corner_vertices, i);
            swap_corners(source->corner_positions, i);
            swap_corners(source->corner_normals, i);
        }
    }
}

/* Lists the corners of every welded position, in the order of the triangles. */
static burnish_status list_corners(builder *b) {
    size_t corner_count = 3 * b->triangle_count;
    burnish_status status = burnish_allocate((void **)&b->first_corner, b->position_count + 2,
                                             sizeof *b->first_corner, "vertices", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&b->corners, corner_count, sizeof *b->corners,
                                  "vertices", b->error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    /* Counting sort with the counts two places on, so that filling leaves the starts in place. */
    memset(b->first_corner, 0, (b->position_count + 2) * sizeof *b->first_corner);
    for (size_t i = 0; i < corner_count; ++i) {
        ++b->first_corner[b->corner_vertices[i] + (size_t)2];
    }
    for (size_t i = 2; i < b->position_count + 2; ++i) {
        if (b->first_corner[i] > b->max_faces) {
            b->max_faces = b->first_corner[i];
        }
        b->first_corner[i] += b->first_corner[i - 1];
    }
    for (size_t i = 0; i < corner_count; ++i) {
        b->corners[b->first_corner[b->corner_vertices[i] + (size_t)1]++] = (uint32_t)i;
    }
    return BURNISH_STATUS_OK;
}

/* Gives each corner of one position its vertex: corners with equal normal and colour share one. */
static burnish_status number_corners(builder *b, uint32_t position, const float *normals,
                                     burnish_weld_record *records) {
    const uint32_t *corners = b->corners + b->first_corner[position];
    size_t count = b->first_corner[position + (size_t)1] - b->first_corner[position];
    for (size_t i = 0; i < count; ++i) {
        records[i] = (burnish_weld_record){{0}, corners[i]};
        memcpy(records[i].key, normals + 3 * i, 3 * sizeof(float));
        if (b->has_colors) {
            memcpy(&records[i].key[3],
                   b->source->colors + 4 * (size_t)b->source->corner_positions[corners[i]], 4);
        }
    }
    burnish_weld_sort(records, count);
    burnish_status status =
        burnish_grow((void **)&b->vertices, &b->vertex_capacity, b->vertex_count + count,
                     sizeof *b->vertices, "vertices", b->error);
    for (size_t i = 0; status == BURNISH_STATUS_OK && i < count; ++i) {
        if (i == 0 || memcmp(records[i].key, records[i - 1].key, sizeof records[i].key) != 0) {
            built_vertex *vertex = &b->vertices[b->vertex_count++];
            vertex->position = position;
            memcpy(vertex->normal, records[i].key, sizeof vertex->normal);
            vertex->color = records[i].key[3];
        }
        b->scene->indices[records[i].value] = (uint32_t)(b->vertex_count - 1);
    }
    return status;
}

/* The normals of one position's corners: the file's, or made ones where it has none. */
static void corner_normals(const builder *b, uint32_t position, burnish_fan *fan, float *normals) {
    const uint32_t *corners = b->corners + b->first_corner[position];
    size_t count = b->first_corner[position + (size_t)1] - b->first_corner[position];
    for (size_t i = 0; i < count; ++i) {
        if (!file_normal(b->source, corners[i])) {
            burnish_fan_normals(fan, b->source->positions, b->corner_vertices, corners, count,
                                normals);
            break;
        }
    }
    for (size_t i = 0; i < count; ++i) {
        const float *given = file_normal(b->source, corners[i]);
        if (given) {
            memcpy(normals + 3 * i, given, 3 * sizeof(float));
        }
    }
}

/* Everything that is kept per corner, once the vertices stand: most of the memory. */
static void release_corners(builder *b) {
    burnish_source *source = b->source;
    free(b->corners);
    free(b->first_corner);
    free(b->corner_vertices);
    b->corners = b->first_corner = b->corner_vertices = NULL;
    free(source->corner_positions);
    free(source->corner_normals);
    free(source->normals);
    free(source->colors);
    source->corner_positions = source->corner_normals = NULL;
    source->normals = NULL;
    source->colors = NULL;
    source->triangle_count = source->corner_capacity = source->corner_normal_capacity = 0;
    source->normal_count = source->normal_capacity = source->color_capacity = 0;
}

static double crease_angle(const burnish_load_options *options, burnish_format format) {
    if (options->crease_angle != BURNISH_CREASE_AUTO) {
        return options->crease_angle;
    }
    return format == BURNISH_FORMAT_STL ? 40 : 60;
}

static burnish_status make_vertices(builder *b, double angle) {
    burnish_fan fan = {0};
    burnish_weld_record *records = NULL;
    float *normals = NULL;
    burnish_status status = burnish_fan_create(&fan, b->max_faces, angle, b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&records, b->max_faces, sizeof *records, "vertices",
                                  b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&normals, b->max_faces, 3 * sizeof *normals, "vertices",
                                  b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&b->scene->indices, b->triangle_count,
                                  3 * sizeof *b->scene->indices, "triangles", b->error);
    }
    for (size_t i = 0; status == BURNISH_STATUS_OK && i < b->position_count; ++i) {
        corner_normals(b, (uint32_t)i, &fan, normals);
        status = number_corners(b, (uint32_t)i, normals, records);
    }
    burnish_fan_destroy(&fan);
    free(records);
    free(normals);
    return status;
}

/* Writes the vertices out in the order in which the triangles first use them. */
static void write_vertices(builder *b, uint32_t *number) {
    burnish_scene *scene = b->scene;
    uint32_t next = 0;
    memset(number, 0xff, b->vertex_count * sizeof *number);
    for (size_t i = 0; i < 3 * b->triangle_count; ++i) {
        uint32_t old = scene->indices[i];
        if (number[old] == UINT32_MAX) {
            const built_vertex *vertex = &b->vertices[old];
            memcpy(scene->positions + 3 * (size_t)next,
                   b->source->positions + 3 * (size_t)vertex->position, 3 * sizeof(float));
            memcpy(scene->normals + 3 * (size_t)next, vertex->normal, 3 * sizeof(float));
            if (scene->colors) {
                memcpy(scene->colors + 4 * (size_t)next, &vertex->color, 4);
            }
            number[old] = next++;
        }
        scene->indices[i] = number[old];
    }
}

static burnish_status finish_vertices(builder *b) {
    burnish_scene *scene = b->scene;
    size_t count = b->vertex_count;
    uint32_t *number = NULL;
    burnish_status status =
        burnish_allocate((void **)&number, count, sizeof *number, "vertices", b->error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&scene->positions, count, 3 * sizeof(float), "vertices",
                                  b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&scene->normals, count, 3 * sizeof(float), "vertices",
                                  b->error);
    }
    if (status == BURNISH_STATUS_OK && b->has_colors) {
        status = burnish_allocate((void **)&scene->colors, count, 4, "vertices", b->error);
    }
    if (status == BURNISH_STATUS_OK) {
        write_vertices(b, number);
    }
    free(number);
    return status;
}

/* Moves the materials to the scene, and their numbers where there is more than one. */
static burnish_status take_materials(builder *b) {
    burnish_source *source = b->source;
    burnish_scene *scene = b->scene;
    if (source->material_count == 0) {
        burnish_status status = burnish_allocate((void **)&scene->materials, 1,
                                                 sizeof *scene->materials, "material", b->error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        scene->materials[0] = burnish_material_default();
        scene->material_count = 1;
    } else {
        scene->materials = source->materials;
        scene->material_count = source->material_count;
        source->materials = NULL;
        source->material_count = source->material_capacity = 0;
    }
    if (scene->material_count > 1 && source->triangle_materials) {
        for (size_t i = 0; i < b->triangle_count; ++i) {
            if (source->triangle_materials[i] >= scene->material_count) {
                return burnish_fail_at(b->error, BURNISH_STATUS_FORMAT, burnish_place_file(b->name),
                                       "triangle %zu has material %d, but there are only %zu", i,
                                       source->triangle_materials[i], scene->material_count);
            }
        }
        scene->triangle_materials = source->triangle_materials;
        source->triangle_materials = NULL;
        source->triangle_material_capacity = 0;
    }
    return BURNISH_STATUS_OK;
}

static void describe_mesh(burnish_scene *scene, size_t vertex_count, size_t triangle_count) {
    burnish_mesh *mesh = &scene->mesh;
    mesh->vertex_count = vertex_count;
    mesh->triangle_count = triangle_count;
    mesh->positions = scene->positions;
    mesh->normals = scene->normals;
    mesh->colors = scene->colors;
    mesh->indices = scene->indices;
    mesh->triangle_materials = scene->triangle_materials;
    memcpy(mesh->bounds_min, scene->positions, sizeof mesh->bounds_min);
    memcpy(mesh->bounds_max, scene->positions, sizeof mesh->bounds_max);
    for (size_t i = 0; i < 3 * vertex_count; ++i) {
        float value = scene->positions[i];
        size_t axis = i % 3;
        if (value < mesh->bounds_min[axis]) {
            mesh->bounds_min[axis] = value;
        }
        if (value > mesh->bounds_max[axis]) {
            mesh->bounds_max[axis] = value;
        }
    }
}

/* The steps in order; on failure what was made so far stays in b and b->scene. */
static burnish_status build(builder *b, const burnish_load_options *options) {
    uint32_t *remap = NULL;
    burnish_status status = check_counts(b, options);
    if (status == BURNISH_STATUS_OK) {
        status = weld_positions(b, &remap);
    }
    if (status == BURNISH_STATUS_OK) {
        status = keep_triangles(b, remap);
    }
    free(remap);
    if (status == BURNISH_STATUS_OK) {
        prepare_normals(b->source);
        orient(b);
        status = list_corners(b);
    }
    if (status == BURNISH_STATUS_OK) {
        status = make_vertices(b, crease_angle(options, b->scene->format));
    }
    if (status == BURNISH_STATUS_OK) {
        release_corners(b);
        status = finish_vertices(b);
    }
    if (status == BURNISH_STATUS_OK) {
        status = take_materials(b);
    }
    return status;
}

burnish_status burnish_scene_build(burnish_source *source, const char *name,
                                   const burnish_load_options *options, burnish_format format,
                                   burnish_scene **scene, burnish_error *error) {
    builder b = {
        .source = source, .name = name, .error = error, .has_colors = source->colors != NULL};
    *scene = NULL;
    burnish_status status = burnish_check_load_options(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&b.scene, 1, sizeof *b.scene, "scene", error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *b.scene = (burnish_scene){.format = format};
    status = build(&b, options);
    release_corners(&b);
    free(b.vertices);
    if (status != BURNISH_STATUS_OK) {
        burnish_scene_destroy(b.scene);
        return status;
    }
    describe_mesh(b.scene, b.vertex_count, b.triangle_count);
    b.scene->warnings = source->warnings;
    b.scene->warning_count = source->warning_count;
    source->warnings = NULL;
    source->warning_count = source->warning_capacity = 0;
    *scene = b.scene;
    return BURNISH_STATUS_OK;
}
