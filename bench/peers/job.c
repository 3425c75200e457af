/* The common picture's mesh, camera, light and material. */
#include "job.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "core/numbers.h"
#include "scenes.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; ++k) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static void normalize(double v[3]) {
    double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; ++k) {
        v[k] /= length;
    }
}

/* Depths of the nearest and farthest vertex, and a little more. */
static void find_range(burnish_peers_job *job) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(job->scene);
    job->nearest = INFINITY;
    job->farthest = 0;
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        double from_eye[3];
        for (size_t k = 0; k < 3; ++k) {
            from_eye[k] = mesh->positions[3 * i + k] - job->eye[k];
        }
        double depth = dot(from_eye, job->forward);
        job->nearest = fmin(job->nearest, depth);
        job->farthest = fmax(job->farthest, depth);
    }
    job->nearest = fmax(0.99 * job->nearest, 1e-4 * job->farthest); /* the eye may be inside */
    job->farthest *= 1.01;
}

static void make_camera(burnish_peers_job *job) {
    const burnish_camera *camera = &job->options.camera;
    for (int k = 0; k < 3; ++k) {
        job->eye[k] = camera->position[k];
        job->forward[k] = camera->focal_point[k] - camera->position[k];
    }
    normalize(job->forward);
    cross(job->forward, camera->view_up, job->right);
    normalize(job->right);
    cross(job->right, job->forward, job->up);
    job->pixels = job->options.height / 2.0 / tan(camera->view_angle * BURNISH_PI / 360);
    find_range(job);
}

/* Light i of a scene: the first from the upper left, the others on a spiral around the camera's
 * axis. Toward it, in camera space. */
static void light_direction(const burnish_peers_job *job, int i, double toward[3]) {
    const double turn = 2.4 * i, out = i ? 0.2 + 0.05 * i : 0;
    const double x = -0.48 * !i + out * cos(turn), y = 0.6 * !i + out * sin(turn);
    const double z = i ? -0.8 : -0.64;
    for (int k = 0; k < 3; ++k) {
        toward[k] = x * job->right[k] + y * job->up[k] + z * job->forward[k];
    }
    normalize(toward);
}

static void make_lights(burnish_peers_job *job, burnish_scene_lights lights) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(job->scene);
    double half[3], diagonal = 0;
    for (int k = 0; k < 3; ++k) {
        diagonal = hypot(diagonal, (double)mesh->bounds_max[k] - (double)mesh->bounds_min[k]);
    }
    for (int i = 0; i < lights.count; ++i) {
        burnish_light *light = &job->options.lights[i];
        memset(light, 0, sizeof *light);
        light->kind = lights.near ? BURNISH_LIGHT_POINT : BURNISH_LIGHT_DIRECTIONAL;
        light_direction(job, i, light->vector);
        for (int k = 0; k < 3; ++k) {
            light->color[k] = 1.0f / (float)lights.count;
            if (i == 0) {
                job->light[k] = (float)light->vector[k];
                half[k] = light->vector[k] - job->forward[k];
            }
            if (lights.near) { /* one diagonal from the middle of the object */
                const double middle =
                    ((double)mesh->bounds_min[k] + (double)mesh->bounds_max[k]) / 2;
                light->vector[k] = middle + diagonal * light->vector[k];
            }
        }
    }
    normalize(half);
    for (int k = 0; k < 3; ++k) {
        job->half[k] = (float)half[k];
        job->viewer[k] = (float)-job->forward[k];
    }
    job->options.light_count = lights.count;
}

/* Sets the same ambient, specular and exponent in all materials, and the diffuse colour if there is
 * only one material. */
static burnish_status make_materials(burnish_peers_job *job, burnish_error *error) {
    const size_t count = burnish_mesh_get_material_count(job->scene);
    burnish_status status = BURNISH_STATUS_OK;
    burnish_lobe lobe;
    job->ambient = 0.05f;
    job->diffuse = 0.6f;
    job->specular = 0.35f;
    job->exponent = 32;
    burnish_lobe_create(&lobe, BURNISH_FIT_ENERGY, 2, job->exponent);
    job->zeta = (float)lobe.zeta;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_material material = *burnish_mesh_get_material(job->scene, i);
        for (int k = 0; k < 3; ++k) {
            material.ambient[k] = job->ambient;
            material.diffuse[k] = count == 1 ? job->diffuse : material.diffuse[k];
            material.specular[k] = job->specular;
            job->options.ambient_light[k] = 1;
        }
        material.exponent = job->exponent;
        material.has_diffuse = 1;
        status = burnish_mesh_set_material(job->scene, i, &material, error);
    }
    return status;
}

static burnish_status load_file(const char *path, double aspect, burnish_scene *scene,
                                burnish_error *error) {
    burnish_load_options load = burnish_load_options_default();
    burnish_framing framing = burnish_framing_default();
    framing.aspect = aspect;
    *scene = (burnish_scene){.lights = {1, 0}, .cull_back_faces = 1};
    burnish_status status = burnish_mesh_load(path, &load, &scene->mesh, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_camera_frame(scene->mesh, &framing, &scene->camera, error);
    }
    return status;
}

static int is_scene(const char *name) {
    for (size_t i = 0; burnish_scene_name(i); ++i) {
        if (strcmp(burnish_scene_name(i), name) == 0) {
            return 1;
        }
    }
    return 0;
}

int burnish_peers_job_open(burnish_peers_job *job, const char *input,
                           const burnish_peers_view *view) {
    burnish_error error;
    burnish_scene scene;
    const double aspect = (double)view->width / view->height;
    memset(job, 0, sizeof *job);
    job->options = burnish_render_options_default();
    job->options.width = view->width;
    job->options.height = view->height;
    job->options.samples = view->samples;
    job->options.threads = view->threads;
    job->options.local_viewer = 0;
    memset(job->options.background, 0, sizeof job->options.background);
    burnish_status status = is_scene(input) ? burnish_scene_make(input, aspect, &scene, &error)
                                            : load_file(input, aspect, &scene, &error);
    job->scene = scene.mesh;
    job->options.camera = scene.camera;
    job->options.cull_back_faces = scene.cull_back_faces;
    if (status == BURNISH_STATUS_OK) {
        status = make_materials(job, &error);
    }
    if (status != BURNISH_STATUS_OK) {
        printf("error %s\n", error.text);
        burnish_peers_job_close(job);
        return 0;
    }
    make_camera(job);
    make_lights(job, scene.lights);
    return 1;
}

void burnish_peers_job_close(burnish_peers_job *job) {
    burnish_mesh_destroy(job->scene);
    job->scene = NULL;
}

uint8_t burnish_peers_srgb(double linear) {
    double x = fmin(fmax(linear, 0), 1);
    double code = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    return (uint8_t)lrint(255 * code);
}

double burnish_peers_now(const burnish_peers_job *job) {
    struct timespec now;
    clock_gettime(job->options.threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}
