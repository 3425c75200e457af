#include "amf.h"

#include <math.h>
#include <string.h>

#include "amf_file.h"

enum {
    INSTANCES = 32, /* of constellations in constellations */
    GREY = 158      /* importer_default_material's, as a code of sRGB */
};
#define TRIANGLES_MAX 33554432 /* of all placed objects together */

static const tint *color_of_material(const amf *a, uint32_t id) {
    static const tint none = {.is_there = 0};
    for (size_t i = 0; i < a->materials.count && id != AMF_NOTHING; ++i) {
        if (a->materials.items[i].id == id) {
            return &a->materials.items[i].color;
        }
    }
    return &none;
}

/* The colour of a triangle if it and its vertices have no colour: the nearest enclosing one. */
static tint color_of_volume(const amf *a, const amf_volume *volume) {
    const tint *object = &a->objects.items[volume->object].color;
    tint grey = {.rgba = {GREY, GREY, GREY, 255}};
    return volume->color.is_there ? volume->color
           : object->is_there     ? *object
           : color_of_material(a, volume->material)->is_there
               ? *color_of_material(a, volume->material)
               : grey;
}

/* Every triangle gets separate vertices, which burnish welds. */
static void put_object(amf *a, amf_object *object, const double matrix[12]) {
    importer_mesh *mesh = a->mesh;
    tint around = {.is_there = 0};
    uint32_t volume = AMF_NOTHING;
    const double determinant = matrix[0] * (matrix[5] * matrix[10] - matrix[6] * matrix[9]) -
                               matrix[1] * (matrix[4] * matrix[10] - matrix[6] * matrix[8]) +
                               matrix[2] * (matrix[4] * matrix[9] - matrix[5] * matrix[8]);
    if (a->is_counting) {
        object->is_placed = 1;
        a->placed += object->triangle_count;
        return;
    }
    for (size_t i = 0; i < object->triangle_count; ++i) {
        const amf_triangle *triangle = &a->triangles.items[object->first_triangle + i];
        if (triangle->volume != volume) {
            volume = triangle->volume;
            around = color_of_volume(a, &a->volumes.items[volume]);
        }
        for (int k = 0; k < 3; ++k) {
            const uint64_t at = 3 * a->placed + (uint64_t)k;
            const amf_vertex *vertex =
                &a->vertices.items[triangle->corners[determinant < 0 && k > 0 ? 3 - k : k]];
            for (int axis = 0; axis < 3; ++axis) {
                const double *row = matrix + 4 * axis;
                const float moved = (float)(row[0] * vertex->xyz[0] + row[1] * vertex->xyz[1] +
                                            row[2] * vertex->xyz[2] + row[3]);
                mesh->positions[3 * at + (uint64_t)axis] = isfinite(moved) ? moved : 0;
            }
            mesh->indices[at] = (uint32_t)at;
            if (mesh->colors) {
                const tint *color = triangle->color.is_there ? &triangle->color
                                    : vertex->color.is_there ? &vertex->color
                                                             : &around;
                memcpy(mesh->colors + 4 * at, color->rgba, 4);
            }
        }
        ++a->placed;
    }
}

static void multiply(const double m[12], const double n[12], double product[12]) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            product[4 * row + column] = m[4 * row] * n[column] + m[4 * row + 1] * n[4 + column] +
                                        m[4 * row + 2] * n[8 + column] +
                                        (column == 3 ? m[4 * row + 3] : 0);
        }
    }
}

/* Also counts the steps, because there may be many empty constellations. */
static void put_constellation(amf *a, const amf_constellation *constellation,
                              const double matrix[12], int depth, uint64_t *steps) {
    if (depth == INSTANCES || (*steps += constellation->count) > TRIANGLES_MAX ||
        a->placed > TRIANGLES_MAX) {
        importer_fail(BURNISH_BMS_LIMIT_ERROR,
                      "constellations are nested more than 32 deep, or have more than 33554432 "
                      "triangles; simplify the file");
    }
    for (size_t i = 0; i < constellation->count; ++i) {
        const amf_instance *instance = &a->instances.items[constellation->first + i];
        double product[12];
        multiply(matrix, instance->matrix, product);
        for (size_t k = 0; k < a->objects.count; ++k) {
            if (a->objects.items[k].id == instance->id) {
                put_object(a, &a->objects.items[k], product);
                break;
            }
        }
        for (size_t k = 0; k < a->constellations.count; ++k) {
            if (a->constellations.items[k].id == instance->id) {
                put_constellation(a, &a->constellations.items[k], product, depth + 1, steps);
                break;
            }
        }
    }
}

/* Constellations and objects that are not part of another constellation. */
static void put_all(amf *a) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    uint64_t steps = 0;
    a->placed = 0;
    for (size_t i = 0; i < a->constellations.count; ++i) {
        if (!a->constellations.items[i].is_placed) {
            put_constellation(a, &a->constellations.items[i], identity, 0, &steps);
        }
    }
    for (size_t i = 0; i < a->objects.count; ++i) {
        if (a->constellations.count == 0 || !a->objects.items[i].is_placed) {
            put_object(a, &a->objects.items[i], identity);
        }
    }
}

static void find_inner(amf *a) {
    for (size_t i = 0; i < a->instances.count; ++i) {
        for (size_t k = 0; k < a->constellations.count; ++k) {
            a->constellations.items[k].is_placed |=
                a->constellations.items[k].id == a->instances.items[i].id;
        }
    }
}

static int has_colors(const amf *a) {
    int any = 0;
    for (size_t i = 0; i < a->vertices.count; ++i) {
        any |= a->vertices.items[i].color.is_there;
    }
    for (size_t i = 0; i < a->triangles.count; ++i) {
        any |= a->triangles.items[i].color.is_there;
    }
    for (size_t i = 0; i < a->volumes.count; ++i) {
        const amf_volume *volume = &a->volumes.items[i];
        any |= volume->color.is_there | a->objects.items[volume->object].color.is_there |
               color_of_material(a, volume->material)->is_there;
    }
    return any;
}

void assimp_read_amf(const importer_input *input, importer_mesh *mesh) {
    static amf a;
    a.mesh = mesh;
    amf_parse(&a, input);
    find_inner(&a);
    a.is_counting = 1;
    put_all(&a);
    mesh->vertex_count = 3 * a.placed;
    mesh->triangle_count = a.placed;
    mesh->parts = has_colors(&a) ? BURNISH_BMS_COLORS : 0;
    mesh->up[2] = 1;
    importer_allocate(mesh);
    a.is_counting = 0;
    put_all(&a);
}
