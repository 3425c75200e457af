/* Cameras and lights (KHR_lights_punctual). Both look along -z of their node; y is up. */
#include "mesh/read/gltf/gltf.h"

#include "base/elementary.h"
#include "base/numbers.h"

/* ---- Cameras ---- */

enum { CAMERAS_MAX = 4096 };

/* The middle of the box around the positions. Returns half its diagonal. */
static double find_middle(const burnish_mesh_data *mesh, double middle[3]) {
    const float *positions = burnish_positions(mesh);
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
        float low = positions[axis], high = positions[axis];
        for (size_t i = 1; i < mesh->streams[BURNISH_POSITION].count; ++i) {
            const float value = positions[3 * i + (size_t)axis];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        middle[axis] = ((double)low + high) / 2;
        squared += ((double)high - low) * ((double)high - low);
    }
    return burnish_sqrt(squared) / 2;
}

/* Returns 0 if a node's matrix leaves no direction, or numbers exceed the range that is drawn. */
static int place_camera(const double matrix[12], const double origin[3], const double middle[3],
                        burnish_camera *camera) {
    double lengths[2] = {0, 0}, distance = 0;
    for (int row = 0; row < 3; ++row) {
        const double *m = matrix + 4 * row;
        camera->position[row] = m[3] - origin[row];
        camera->view_up[row] = m[1];
        lengths[0] += m[1] * m[1];
        lengths[1] += m[2] * m[2];
        if (!(m[3] > -1e30 && m[3] < 1e30)) {
            return 0;
        }
    }
    if (!(lengths[0] > 1e-60 && lengths[0] < 1e60 && lengths[1] > 1e-60 && lengths[1] < 1e60)) {
        return 0;
    }
    const double forward = -1 / burnish_sqrt(lengths[1]);
    for (int row = 0; row < 3; ++row) {
        distance += forward * matrix[4 * row + 2] * (middle[row] - camera->position[row]);
    }
    distance = distance > 1e-6 ? distance : 1; /* the object may be behind the camera */
    for (int row = 0; row < 3; ++row) {
        camera->focal_point[row] = camera->position[row] + distance * forward * matrix[4 * row + 2];
    }
    return 1;
}

static void read_lens(burnish_gltf *gltf, uint32_t value, burnish_camera *camera) {
    const uint32_t parallel = burnish_gltf_object(gltf, value, "orthographic");
    const uint32_t perspective = burnish_gltf_object(gltf, value, "perspective");
    const double angle = 1 / BURNISH_DEGREE * burnish_gltf_number(gltf, perspective, "yfov", 0.8);
    const double height = 2 * burnish_gltf_number(gltf, parallel, "ymag", 0);
    camera->view_angle = angle > BURNISH_VIEW_ANGLE_MIN
                             ? (angle < BURNISH_VIEW_ANGLE_MAX ? angle : BURNISH_VIEW_ANGLE_MAX)
                             : BURNISH_VIEW_ANGLE_MIN;
    camera->orthographic_height = height > 1e-30 && height < 1e30 ? height : 0;
}

static void add_camera(burnish_gltf *gltf, uint32_t node, uint32_t value, burnish_camera camera) {
    burnish_mesh_data *mesh = gltf->reader->mesh;
    char text[128];
    if (burnish_json_text(&gltf->json, burnish_json_member(&gltf->json, node, "name"), text,
                          sizeof text) == 0) {
        burnish_json_text(&gltf->json, burnish_json_member(&gltf->json, value, "name"), text,
                          sizeof text);
    }
    char *name = burnish_allocate(gltf->memory, strlen(text) + 1, 1, "cameras");
    mesh->cameras = burnish_reserve(gltf->memory, mesh->cameras, &mesh->camera_capacity,
                                    mesh->camera_count + 1, sizeof *mesh->cameras, "cameras");
    if (!burnish_gltf_is_fine(gltf)) {
        burnish_release(gltf->memory->context, name);
        return;
    }
    strcpy(name, text);
    mesh->cameras[mesh->camera_count++] = (burnish_named_camera){.name = name, .camera = camera};
}

void burnish_gltf_read_cameras(burnish_gltf *gltf) {
    double middle[3];
    if (gltf->counts[BURNISH_GLTF_CAMERAS] == 0) {
        return;
    }
    find_middle(gltf->reader->mesh, middle); /* as far away is the focal point */
    gltf->is_lenient = 1;
    for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_NODES] && gltf->status == BURNISH_STATUS_OK &&
                       gltf->reader->mesh->camera_count < CAMERAS_MAX;
         ++i) {
        const uint32_t node = gltf->lists[BURNISH_GLTF_NODES][i];
        const uint32_t number = burnish_gltf_reference(gltf, node, "camera", BURNISH_GLTF_CAMERAS);
        burnish_camera camera = {.orthographic_height = 0};
        if (number != BURNISH_GLTF_NONE && gltf->nodes[i].is_drawn &&
            place_camera(gltf->nodes[i].matrix, gltf->reader->mesh->origin, middle, &camera)) {
            const uint32_t value = gltf->lists[BURNISH_GLTF_CAMERAS][number];
            read_lens(gltf, value, &camera);
            add_camera(gltf, node, value, camera);
        }
    }
    gltf->is_lenient = 0;
}

/* ---- Lights ---- */

/* Intensities outside this range are not intended, and would make other lights vanish. */
#define INTENSITY_MIN 1e-30
#define INTENSITY_MAX 1e30

typedef struct gltf_lights {
    burnish_light items[BURNISH_LIGHT_MAX];
    double colors[BURNISH_LIGHT_MAX][3]; /* what arrives at the middle: lux, any of three */
    double middle[3], radius;            /* of the box */
    double toward[BURNISH_LIGHT_MAX][3]; /* unit, from the middle */
    size_t count;
} gltf_lights;

/* Returns the length; 0 without a direction, or if numbers exceed the range that is drawn. */
static double normalize_direction(double direction[3]) {
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

/* The position of a light relative to the middle, and where a point light has its colour: at the
 * middle, or half the radius away if it is nearer. Returns 0 if it can't be used. */
static int place_light(const double matrix[12], const double origin[3], const gltf_lights *lights,
                       burnish_light *light, double toward[3]) {
    for (int row = 0; row < 3; ++row) {
        const double *m = matrix + 4 * row;
        if (light->kind == BURNISH_LIGHT_DIRECTIONAL) {
            light->vector[row] = toward[row] = m[2];
        } else {
            light->vector[row] = m[3] - origin[row];
            toward[row] = light->vector[row] - lights->middle[row];
        }
    }
    const double distance = normalize_direction(toward);
    if (light->kind == BURNISH_LIGHT_DIRECTIONAL) {
        memcpy(light->vector, toward, sizeof light->vector);
    } else {
        light->distance = distance > lights->radius / 2 ? distance : lights->radius / 2;
        return light->distance > 1e-30 && light->vector[0] > -1e30 && light->vector[0] < 1e30 &&
               light->vector[1] > -1e30 && light->vector[1] < 1e30 && light->vector[2] > -1e30 &&
               light->vector[2] < 1e30;
    }
    return distance > 0;
}

/* The cone of a spot light, which shines along -z of its node. */
static void read_cone(burnish_gltf *gltf, uint32_t spot, const double matrix[12],
                      burnish_light *light) {
    static const char *const names[2] = {"innerConeAngle", "outerConeAngle"};
    for (int i = 1; i >= 0; --i) {
        const double angle = burnish_gltf_number(gltf, spot, names[i], i * BURNISH_DEGREE * 45);
        double sine;
        burnish_sincos(angle > 0 && angle < 90 * BURNISH_DEGREE ? angle
                       : angle > 0                              ? 90 * BURNISH_DEGREE
                                                                : 0,
                       &sine, &light->cone[i]);
    }
    light->cone[0] = light->cone[0] > light->cone[1] ? light->cone[0] : light->cone[1];
    for (int row = 0; row < 3; ++row) {
        light->axis[row] = -matrix[4 * row + 2];
    }
    normalize_direction(light->axis);
}

static void add_light(burnish_gltf *gltf, const burnish_gltf_node *node, uint32_t value,
                      gltf_lights *lights) {
    const uint32_t type = burnish_json_member(&gltf->json, value, "type");
    const int is_directional = burnish_json_is_text(&gltf->json, type, "directional");
    const int is_spot = burnish_json_is_text(&gltf->json, type, "spot");
    const size_t at = lights->count;
    burnish_light *item = &lights->items[at];
    double color[3] = {1, 1, 1}, brightest = 0;
    const double intensity = burnish_gltf_number(gltf, value, "intensity", 1);
    burnish_gltf_numbers(gltf, value, "color", 3, color);
    *item =
        (burnish_light){.kind = is_directional ? BURNISH_LIGHT_DIRECTIONAL : BURNISH_LIGHT_POINT};
    if (!is_directional && !is_spot && !burnish_json_is_text(&gltf->json, type, "point")) {
        return;
    }
    if (!place_light(node->matrix, gltf->reader->mesh->origin, lights, item, lights->toward[at])) {
        return;
    }
    if (is_spot) {
        read_cone(gltf, burnish_gltf_object(gltf, value, "spot"), node->matrix, item);
    }
    const double range = is_directional ? 0 : burnish_gltf_number(gltf, value, "range", 0);
    const double fall_off = is_directional ? 1 : 1 / (item->distance * item->distance);
    item->range = range > 0 && range < 1e30 ? range : 0;
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
            lights->items[i].color[k] = (float)(lights->colors[i][k] / most);
        }
    }
    memcpy(mesh->lights, lights->items, lights->count * sizeof *mesh->lights);
    mesh->light_count = lights->count;
}

void burnish_gltf_read_lights(burnish_gltf *gltf) {
    gltf_lights lights = {.count = 0};
    size_t count;
    const uint32_t extension = burnish_gltf_extension(gltf, 0, "KHR_lights_punctual");
    if (extension == BURNISH_JSON_NONE) {
        return;
    }
    gltf->is_lenient = 1;
    const uint32_t array = burnish_gltf_array(gltf, extension, "lights");
    uint32_t *values = burnish_gltf_items(gltf, array, &count);
    if (values) {
        lights.radius = find_middle(gltf->reader->mesh, lights.middle);
    }
    for (size_t i = 0; values && i < gltf->counts[BURNISH_GLTF_NODES] &&
                       gltf->status == BURNISH_STATUS_OK && lights.count < BURNISH_LIGHT_MAX;
         ++i) {
        const uint32_t own =
            burnish_gltf_extension(gltf, gltf->lists[BURNISH_GLTF_NODES][i], "KHR_lights_punctual");
        const uint64_t number = burnish_gltf_whole(gltf, own, "light", UINT64_MAX, UINT32_MAX);
        if (gltf->nodes[i].is_drawn && number < count) {
            add_light(gltf, &gltf->nodes[i], values[number], &lights);
        }
    }
    if (gltf->status == BURNISH_STATUS_OK && lights.count > 0) {
        keep_lights(gltf, &lights);
    }
    burnish_release(gltf->memory->context, values);
    gltf->is_lenient = 0;
}
