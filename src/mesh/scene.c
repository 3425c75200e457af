/* What callers see of a scene: options, creation from arrays, access, materials. */
#include "mesh/scene.h"

#include <float.h>
#include <string.h>

#include "core/tasks.h"
#include "mesh/mesh_data.h"

/* burnish's grey, a satin plastic: tune it here and nowhere else. Colours are linear light. */
static const burnish_material DEFAULT_MATERIAL = {
    .ambient = {0.34f, 0.34f, 0.34f},
    .diffuse = {0.34f, 0.34f, 0.34f},
    .specular = {0.5f, 0.5f, 0.5f},
    .exponent = 64,
};

burnish_load_options burnish_load_options_default(void) {
    return (burnish_load_options){.cookie = BURNISH_LOAD_OPTIONS_COOKIE,
                                  .format = BURNISH_FORMAT_AUTO,
                                  .crease_angle = BURNISH_CREASE_AUTO,
                                  .tessellation = 16,
                                  .max_input_bytes = (uint64_t)16 << 30,
                                  .max_triangles = INT32_MAX};
}

burnish_status burnish_check_load_options(const burnish_load_options *options,
                                          burnish_error *error) {
    if (!options) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: NULL; pass burnish_load_options_default()");
    }
    if (options->cookie != BURNISH_LOAD_OPTIONS_COOKIE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: not initialised; start from burnish_load_options_default()");
    }
    if ((int)options->format < 0 || options->format >= BURNISH_FORMAT_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: format %d is unknown; use a BURNISH_FORMAT_ value",
                            (int)options->format);
    }
    if (options->crease_angle != BURNISH_CREASE_AUTO &&
        !(options->crease_angle >= 0 && options->crease_angle <= 180)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "options: crease_angle %g is not in [0, 180] degrees or BURNISH_CREASE_AUTO",
            options->crease_angle);
    }
    if (options->tessellation < 1 || options->tessellation > 256) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: tessellation %d is not in [1, 256]", options->tessellation);
    }
    if (options->max_triangles > INT32_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "options: max_triangles %llu is more than 2147483647",
                            (unsigned long long)options->max_triangles);
    }
    if (options->threads < 0 || options->threads > BURNISH_THREADS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "options: threads %d is not in [0, %d]",
                            options->threads, BURNISH_THREADS_MAX);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_arrays(const float *positions, size_t vertex_count,
                                   const uint32_t *indices, size_t triangle_count,
                                   burnish_error *error) {
    if (!positions || !indices) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL; pass an array",
                            positions ? "indices" : "positions");
    }
    if (vertex_count < 3 || vertex_count > UINT32_MAX - 1) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "vertex_count: %zu is not in [3, 2^32 - 2]", vertex_count);
    }
    if (triangle_count < 1 || triangle_count > INT32_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "triangle_count: %zu is not in [1, 2^31 - 1]", triangle_count);
    }
    for (size_t i = 0; i < 3 * vertex_count; ++i) {
        if (!(positions[i] >= -FLT_MAX && positions[i] <= FLT_MAX)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "positions[%zu]: not finite; coordinates must be numbers", i);
        }
    }
    for (size_t i = 0; i < 3 * triangle_count; ++i) {
        if (indices[i] >= vertex_count) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "indices[%zu]: %u is out of range, there are %zu vertices", i,
                                (unsigned)indices[i], vertex_count);
        }
    }
    return BURNISH_STATUS_OK;
}

/* A copy of an attribute's values; NULL: there are none. */
static void copy_values(burnish_mesh_data *data, burnish_attribute attribute, const void *values,
                        size_t count) {
    burnish_stream *stream = &data->streams[attribute];
    if (values && burnish_mesh_data_reserve(data, attribute, count) == BURNISH_STATUS_OK) {
        memcpy(stream->items, values, count * burnish_attribute_size(attribute));
        stream->count = count;
    }
}

burnish_status burnish_mesh_create(const float *positions, const float *normals,
                                   const uint8_t *colors, size_t vertex_count,
                                   const uint32_t *indices, size_t triangle_count,
                                   const burnish_load_options *options, burnish_mesh **scene,
                                   burnish_error *error) {
    if (!scene) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "scene: NULL; pass where to put it");
    }
    *scene = NULL;
    burnish_status status = burnish_check_load_options(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_arrays(positions, vertex_count, indices, triangle_count, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, options->threads);
    burnish_mesh_data data = burnish_mesh_data_begin(NULL, &tasks, error);
    copy_values(&data, BURNISH_POSITION, positions, vertex_count);
    copy_values(&data, BURNISH_NORMAL, normals, vertex_count);
    copy_values(&data, BURNISH_COLOR, colors, vertex_count);
    status = burnish_mesh_data_reserve_corners(&data, BURNISH_POSITION, triangle_count);
    if (status == BURNISH_STATUS_OK) {
        memcpy(data.streams[BURNISH_POSITION].corners, indices,
               3 * triangle_count * sizeof *indices);
        data.triangle_count = triangle_count;
        status = burnish_mesh_build(&data, "burnish_mesh_create", options, BURNISH_FORMAT_AUTO,
                                    scene, error);
    }
    burnish_mesh_data_destroy(&data);
    return status;
}

void burnish_mesh_destroy(burnish_mesh *scene) {
    if (!scene) {
        return;
    }
    for (size_t i = 0; i < scene->warning_count; ++i) {
        free(scene->warnings[i]);
    }
    free(scene->warnings);
    free(scene->materials);
    free(scene->positions);
    free(scene->normals);
    free(scene->colors);
    free(scene->indices);
    free(scene->triangle_materials);
    free(scene);
}

const burnish_mesh_view *burnish_mesh_get_view(const burnish_mesh *scene) {
    return scene ? &scene->mesh : NULL;
}

size_t burnish_mesh_warning_count(const burnish_mesh *scene) {
    return scene ? scene->warning_count : 0;
}

const char *burnish_mesh_warning(const burnish_mesh *scene, size_t index) {
    return scene && index < scene->warning_count ? scene->warnings[index] : NULL;
}

size_t burnish_mesh_material_count(const burnish_mesh *scene) {
    return scene ? scene->material_count : 0;
}

const burnish_material *burnish_mesh_material(const burnish_mesh *scene, size_t index) {
    return scene && index < scene->material_count ? &scene->materials[index] : NULL;
}

static burnish_status check_coefficients(const float values[3], const char *name,
                                         burnish_error *error) {
    for (int i = 0; i < 3; ++i) {
        if (!(values[i] >= 0 && values[i] <= 1)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "material: %s[%d] is %g, not in [0, 1]", name, i,
                                (double)values[i]);
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_mesh_set_material(burnish_mesh *scene, size_t index,
                                         const burnish_material *material, burnish_error *error) {
    if (!scene || !material) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL",
                            scene ? "material" : "scene");
    }
    if (index >= scene->material_count) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "index: %zu is out of range, the scene has %zu material%s", index,
                            scene->material_count, scene->material_count == 1 ? "" : "s");
    }
    burnish_status status = check_coefficients(material->ambient, "ambient", error);
    if (status == BURNISH_STATUS_OK) {
        status = check_coefficients(material->diffuse, "diffuse", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_coefficients(material->specular, "specular", error);
    }
    if (status == BURNISH_STATUS_OK && !(material->exponent >= 1 && material->exponent <= 65536)) {
        status =
            burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                         "material: exponent is %g, not in [1, 65536]", (double)material->exponent);
    }
    if (status == BURNISH_STATUS_OK) {
        scene->materials[index] = *material;
    }
    return status;
}

burnish_material burnish_material_default(void) {
    return DEFAULT_MATERIAL;
}

burnish_format burnish_mesh_format(const burnish_mesh *scene) {
    return scene ? scene->format : BURNISH_FORMAT_AUTO;
}

void burnish_mesh_load_seconds(const burnish_mesh *scene, double *read, double *build) {
    *read = scene ? scene->seconds_read : 0;
    *build = scene ? scene->seconds_build : 0;
}
