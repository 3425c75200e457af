/* The common picture's mesh, camera, light and material. */
#include "job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/numbers.h"

#define BUNNY "/usr/share/glmark2/models/bunny.obj" /* Debian's glmark2-data */

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

/* From the upper left. */
static void make_light(burnish_peers_job *job) {
    burnish_light *light = &job->options.lights[0];
    double half[3];
    memset(light, 0, sizeof *light);
    for (int k = 0; k < 3; ++k) {
        light->vector[k] = -0.48 * job->right[k] + 0.6 * job->up[k] - 0.64 * job->forward[k];
        light->color[k] = 1;
    }
    normalize(light->vector);
    for (int k = 0; k < 3; ++k) {
        half[k] = light->vector[k] - job->forward[k];
        job->light[k] = (float)light->vector[k];
        job->viewer[k] = (float)-job->forward[k];
    }
    normalize(half);
    for (int k = 0; k < 3; ++k) {
        job->half[k] = (float)half[k];
    }
    job->options.light_count = 1;
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

/* ---- A finer mesh ---- */

typedef struct corner {
    float position[3], normal[3];
} corner;

static corner middle(const corner *a, const corner *b) {
    corner m;
    double sum[3], squared = 0;
    for (int k = 0; k < 3; ++k) {
        m.position[k] = (a->position[k] + b->position[k]) / 2;
        sum[k] = (double)a->normal[k] + b->normal[k];
        squared += sum[k] * sum[k];
    }
    for (int k = 0; k < 3; ++k) { /* opposite normals: either will do */
        m.normal[k] = squared > 0 ? (float)(sum[k] / sqrt(squared)) : a->normal[k];
    }
    return m;
}

/* Four triangles at the edges' middles for each, `levels` times. */
static void split(const corner v[3], int levels, corner **to) {
    if (levels == 0) {
        memcpy(*to, v, 3 * sizeof *v);
        *to += 3;
        return;
    }
    const corner ab = middle(&v[0], &v[1]), bc = middle(&v[1], &v[2]), ca = middle(&v[2], &v[0]);
    split((corner[3]){v[0], ab, ca}, levels - 1, to);
    split((corner[3]){ab, v[1], bc}, levels - 1, to);
    split((corner[3]){ca, bc, v[2]}, levels - 1, to);
    split((corner[3]){ab, bc, ca}, levels - 1, to);
}

/* The same surface, normals interpolated. Neighbours make equal middles, which are joined. */
static burnish_status subdivide(const burnish_mesh *mesh, int levels, burnish_mesh **finer,
                                burnish_error *error) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_load_options options = burnish_load_options_default();
    const size_t count = view->triangle_count * 3 << 2 * levels;
    corner *corners = calloc(count, sizeof *corners), *to = corners;
    *finer = NULL;
    if (!corners) {
        snprintf(error->text, sizeof error->text, "subdivision: out of memory");
        return BURNISH_STATUS_MEMORY;
    }
    for (size_t i = 0; i < view->triangle_count; ++i) {
        corner v[3];
        for (size_t k = 0; k < 3; ++k) {
            const size_t vertex = view->indices[3 * i + k];
            memcpy(v[k].position, view->positions + 3 * vertex, sizeof v[k].position);
            memcpy(v[k].normal, view->normals + 3 * vertex, sizeof v[k].normal);
        }
        split(v, levels, &to);
    }
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){corners->position, count, sizeof *corners};
    arrays.normals = (burnish_array){corners->normal, count, sizeof *corners};
    const burnish_status status = burnish_mesh_create(&arrays, &options, finer, error);
    free(corners);
    return status;
}

/* bunny16 is the bunny subdivided twice. */
static burnish_status load(const char *input, burnish_mesh **mesh, burnish_error *error) {
    const int is_bunny = strcmp(input, "bunny") == 0, is_fine = strcmp(input, "bunny16") == 0;
    burnish_load_options options = burnish_load_options_default();
    burnish_status status =
        burnish_mesh_load(is_bunny || is_fine ? BUNNY : input, &options, mesh, error);
    if (status == BURNISH_STATUS_OK && is_fine) {
        burnish_mesh *coarse = *mesh;
        status = subdivide(coarse, 2, mesh, error);
        burnish_mesh_destroy(coarse);
    }
    return status;
}

int burnish_peers_job_open(burnish_peers_job *job, const char *input,
                           const burnish_peers_view *view) {
    burnish_error error;
    burnish_framing framing = burnish_framing_default();
    memset(job, 0, sizeof *job);
    job->options = burnish_render_options_default();
    job->options.width = view->width;
    job->options.height = view->height;
    job->options.samples = view->samples;
    job->options.threads = view->threads;
    job->options.local_viewer = 0;
    memset(job->options.background, 0, sizeof job->options.background);
    job->options.cull_back_faces = 1;
    framing.aspect = (double)view->width / view->height;
    burnish_status status = load(input, &job->scene, &error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_camera_frame(job->scene, &framing, &job->options.camera, &error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = make_materials(job, &error);
    }
    if (status != BURNISH_STATUS_OK) {
        printf("error %s\n", error.text);
        burnish_peers_job_close(job);
        return 0;
    }
    make_camera(job);
    make_light(job);
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
