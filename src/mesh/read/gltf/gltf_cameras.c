/* glTF's cameras, each where its node stands: it looks along -z of the node, y is upward. */
#include "core/elementary.h"
#include "core/numbers.h"
#include "mesh/read/gltf/gltf.h"

enum { CAMERAS_MAX = 4096 };

void burnish_gltf_find_middle(const burnish_mesh_data *mesh, double middle[3]) {
    const float *positions = burnish_positions(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        float low = positions[axis], high = positions[axis];
        for (size_t i = 1; i < mesh->streams[BURNISH_POSITION].count; ++i) {
            const float value = positions[3 * i + (size_t)axis];
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        middle[axis] = ((double)low + high) / 2;
    }
}

/* Returns 0 where a node's matrix leaves no direction, or numbers are beyond what is drawn. */
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
    distance = distance > 1e-6 ? distance : 1; /* what it looks at may lie behind it */
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
    burnish_gltf_find_middle(gltf->reader->mesh, middle); /* as far away is the focal point */
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
