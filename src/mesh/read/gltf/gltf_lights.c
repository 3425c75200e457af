/* glTF's lights (KHR_lights_punctual): each shines along -z of its node. */
#include "core/elementary.h"
#include "mesh/read/gltf/gltf.h"

/* Intensities outside are none of a light that anyone means, and would lose the others. */
#define INTENSITY_MIN 1e-30
#define INTENSITY_MAX 1e30

typedef struct gltf_lights {
    burnish_file_light items[BURNISH_LIGHT_MAX];
    double colors[BURNISH_LIGHT_MAX][3]; /* what arrives at the middle: lux, any of three */
    double toward[BURNISH_LIGHT_MAX][3]; /* unit, from the middle */
    size_t count;
} gltf_lights;

/* Returns the length; 0 where there is no direction, or numbers are beyond what is drawn. */
static double normalize(double direction[3]) {
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        square += direction[i] * direction[i];
    }
    const double length = square > 1e-60 && square < 1e60 ? burnish_sqrt(square) : 0;
    for (int i = 0; i < 3 && length > 0; ++i) {
        direction[i] /= length;
    }
    return length;
}

/* Where a light stands, as seen from the middle. Returns 0 where it can't be used. */
static int place_light(const double matrix[12], const double origin[3], const double middle[3],
                       burnish_light *light, double toward[3], double *fall_off) {
    for (int row = 0; row < 3; ++row) {
        const double *m = matrix + 4 * row;
        if (light->kind == BURNISH_LIGHT_DIRECTIONAL) {
            light->vector[row] = toward[row] = m[2];
        } else {
            light->vector[row] = m[3] - origin[row];
            toward[row] = light->vector[row] - middle[row];
        }
    }
    const double distance = normalize(toward);
    if (light->kind == BURNISH_LIGHT_DIRECTIONAL) {
        memcpy(light->vector, toward, sizeof light->vector);
        *fall_off = 1;
    } else { /* one in the very middle of the object lights it without falling off */
        *fall_off = distance > 0 ? 1 / (distance * distance) : 1;
        return light->vector[0] > -1e30 && light->vector[0] < 1e30 && light->vector[1] > -1e30 &&
               light->vector[1] < 1e30 && light->vector[2] > -1e30 && light->vector[2] < 1e30;
    }
    return distance > 0;
}

static void add_light(burnish_gltf *gltf, const burnish_gltf_node *node, uint32_t value,
                      const double middle[3], gltf_lights *lights) {
    const uint32_t type = burnish_json_member(&gltf->json, value, "type");
    const int is_directional = burnish_json_is_text(&gltf->json, type, "directional");
    const int is_spot = burnish_json_is_text(&gltf->json, type, "spot");
    const size_t at = lights->count;
    burnish_file_light *item = &lights->items[at];
    double color[3] = {1, 1, 1}, fall_off, brightest = 0;
    const double intensity = burnish_gltf_number(gltf, value, "intensity", 1);
    burnish_gltf_numbers(gltf, value, "color", 3, color);
    *item = (burnish_file_light){.light.kind = is_directional ? BURNISH_LIGHT_DIRECTIONAL
                                                              : BURNISH_LIGHT_POINT,
                                 .is_spot = is_spot};
    if (!is_directional && !is_spot && !burnish_json_is_text(&gltf->json, type, "point")) {
        return;
    }
    if (!place_light(node->matrix, gltf->reader->mesh->origin, middle, &item->light,
                     lights->toward[at], &fall_off)) {
        return;
    }
    for (int i = 0; i < 3; ++i) {
        lights->colors[at][i] = color[i] > 0 ? color[i] * intensity * fall_off : 0;
        brightest = lights->colors[at][i] > brightest ? lights->colors[at][i] : brightest;
    }
    lights->count += brightest > INTENSITY_MIN && brightest < INTENSITY_MAX;
}

/* The most that arrives at a surface in the middle that faces one of the lights. */
static double find_brightest(const gltf_lights *lights) {
    double most = 0;
    for (size_t i = 0; i < lights->count; ++i) {
        double sum[3] = {0, 0, 0};
        for (size_t j = 0; j < lights->count; ++j) {
            const double *a = lights->toward[i], *b = lights->toward[j];
            const double cosine = i == j ? 1 : a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            for (int k = 0; k < 3; ++k) {
                sum[k] += cosine > 0 ? cosine * lights->colors[j][k] : 0;
                most = sum[k] > most ? sum[k] : most;
            }
        }
    }
    return most;
}

static void keep_lights(burnish_gltf *gltf, gltf_lights *lights) {
    burnish_mesh_data *mesh = gltf->reader->mesh;
    const double most = find_brightest(lights);
    mesh->lights = burnish_reserve(gltf->memory, mesh->lights, &mesh->light_capacity, lights->count,
                                   sizeof *mesh->lights, "lights");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    for (size_t i = 0; i < lights->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            lights->items[i].light.color[k] = (float)(lights->colors[i][k] / most);
        }
    }
    memcpy(mesh->lights, lights->items, lights->count * sizeof *mesh->lights);
    mesh->light_count = lights->count;
}

void burnish_gltf_read_lights(burnish_gltf *gltf) {
    gltf_lights lights = {.count = 0};
    double middle[3];
    size_t count;
    const uint32_t extension = burnish_gltf_extension(gltf, 0, "KHR_lights_punctual");
    if (extension == BURNISH_JSON_NONE) {
        return;
    }
    gltf->is_lenient = 1;
    const uint32_t array = burnish_gltf_array(gltf, extension, "lights");
    uint32_t *values = burnish_gltf_items(gltf, array, &count);
    if (values) {
        burnish_gltf_find_middle(gltf->reader->mesh, middle);
    }
    for (size_t i = 0; values && i < gltf->counts[BURNISH_GLTF_NODES] &&
                       gltf->status == BURNISH_STATUS_OK && lights.count < BURNISH_LIGHT_MAX;
         ++i) {
        const uint32_t own =
            burnish_gltf_extension(gltf, gltf->lists[BURNISH_GLTF_NODES][i], "KHR_lights_punctual");
        const uint64_t number = burnish_gltf_whole(gltf, own, "light", UINT64_MAX, UINT32_MAX);
        if (gltf->nodes[i].is_drawn && number < count) {
            add_light(gltf, &gltf->nodes[i], values[number], middle, &lights);
        }
    }
    if (gltf->status == BURNISH_STATUS_OK && lights.count > 0) {
        keep_lights(gltf, &lights);
    }
    burnish_release(gltf->memory->context, values);
    gltf->is_lenient = 0;
}
