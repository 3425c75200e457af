/* Embree as a contestant: one ray per pixel in packets of 16, the normal interpolated, shaded by
 * burnish's kernels into RGBA8. The hierarchy is built once and not timed. */
#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/tasks.h"
#include "worker.h"

enum { TILE = 32, TILE_PIXELS = TILE * TILE, LANES = 16, SIDE = 4 };

enum {
    COLUMNS = (BURNISH_PEERS_WIDTH + TILE - 1) / TILE,
    ROWS = (BURNISH_PEERS_HEIGHT + TILE - 1) / TILE
};

typedef struct tracer {
    const burnish_peers_job *job;
    const burnish_mesh_view *mesh;
    RTCDevice device;
    RTCScene scene;
    const burnish_kernels *kernels;
    uint8_t *rgba;
    uint8_t *encoded; /* NULL while frames are timed; 3 per pixel */
    burnish_tasks tasks;
} tracer;

/* The hit points of a tile. */
typedef struct tile_points {
    float normal[3][TILE_PIXELS];
    uint32_t pixel[TILE_PIXELS];
    int count;
} tile_points;

static void build(tracer *t) {
    const burnish_mesh_view *mesh = t->mesh;
    RTCGeometry geometry = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *positions =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof *positions, mesh->vertex_count);
    uint32_t *indices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof *indices, mesh->triangle_count);
    if (positions && indices) {
        memcpy(positions, mesh->positions, 3 * mesh->vertex_count * sizeof *positions);
        memcpy(indices, mesh->indices, 3 * mesh->triangle_count * sizeof *indices);
    }
    t->scene = rtcNewScene(t->device);
    rtcSetSceneBuildQuality(t->scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(t->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(t->scene);
}

static void close_tracer(void *state) {
    tracer *t = state;
    if (t->device) {
        rtcReleaseScene(t->scene);
        rtcReleaseDevice(t->device);
    }
    free(t->rgba);
    free(t);
}

static int open_tracer(void **state, const burnish_peers_job *job, int threads, char *note) {
    tracer *t = calloc(1, sizeof *t);
    if (!t) {
        return 0;
    }
    t->job = job;
    t->mesh = burnish_mesh_get_view(job->scene);
    t->rgba = calloc(BURNISH_PEERS_PIXELS, 4);
    burnish_tasks_begin(&t->tasks, NULL, threads);
    t->kernels = burnish_kernels_best();
    t->device = rtcNewDevice(threads == 1 ? "threads=1" : "threads=2");
    if (t->device) {
        build(t);
    }
    if (!t->device || !t->rgba || rtcGetDeviceError(t->device) != RTC_ERROR_NONE) {
        snprintf(note, BURNISH_PEERS_NOTE, "Embree: the scene can't be built");
        close_tracer(t);
        return 0;
    }
    snprintf(note, BURNISH_PEERS_NOTE, "Embree %s, packets of 16, %d thread%s", RTC_VERSION_STRING,
             threads, threads == 1 ? "" : "s");
    *state = t;
    return 1;
}

/* The rays through the pixels of a square; valid is 0 outside the picture. */
static void aim(const burnish_peers_job *job, int x0, int y0, struct RTCRayHit16 *rays,
                int valid[LANES]) {
    const float far = (float)job->farthest * 2;
    for (int i = 0; i < LANES; ++i) {
        int x = x0 + i % SIDE, y = y0 + i / SIDE;
        float right = (float)(x - BURNISH_PEERS_WIDTH / 2) + 0.5f;
        float up = (float)(BURNISH_PEERS_HEIGHT / 2 - y) - 0.5f;
        const float inverse = 1.0f / (float)job->pixels;
        float direction[3];
        for (int k = 0; k < 3; ++k) {
            direction[k] = (float)job->forward[k] +
                           inverse * (right * (float)job->right[k] + up * (float)job->up[k]);
        }
        rays->ray.org_x[i] = (float)job->eye[0];
        rays->ray.org_y[i] = (float)job->eye[1];
        rays->ray.org_z[i] = (float)job->eye[2];
        rays->ray.dir_x[i] = direction[0];
        rays->ray.dir_y[i] = direction[1];
        rays->ray.dir_z[i] = direction[2];
        rays->ray.tnear[i] = 0;
        rays->ray.tfar[i] = far;
        rays->ray.time[i] = 0;
        rays->ray.mask[i] = UINT32_MAX;
        rays->ray.flags[i] = 0;
        rays->hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = x < BURNISH_PEERS_WIDTH && y < BURNISH_PEERS_HEIGHT ? -1 : 0;
    }
}

static void collect(const tracer *t, const struct RTCRayHit16 *rays, int x0, int y0,
                    tile_points *points) {
    for (int i = 0; i < LANES; ++i) {
        if (rays->hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
            continue;
        }
        const uint32_t *v = t->mesh->indices + 3 * (size_t)rays->hit.primID[i];
        const float *n0 = t->mesh->normals + 3 * (size_t)v[0];
        const float *n1 = t->mesh->normals + 3 * (size_t)v[1];
        const float *n2 = t->mesh->normals + 3 * (size_t)v[2];
        float b1 = rays->hit.u[i], b2 = rays->hit.v[i], b0 = 1 - b1 - b2;
        float away = rays->hit.Ng_x[i] * rays->ray.dir_x[i] +
                     rays->hit.Ng_y[i] * rays->ray.dir_y[i] +
                     rays->hit.Ng_z[i] * rays->ray.dir_z[i];
        float sign = away > 0 ? -1.0f : 1.0f;
        uint32_t pixel = (uint32_t)((y0 + i / SIDE) * BURNISH_PEERS_WIDTH + x0 + i % SIDE);
        for (int k = 0; k < 3; ++k) {
            points->normal[k][points->count] = sign * (b0 * n0[k] + b1 * n1[k] + b2 * n2[k]);
        }
        points->pixel[points->count++] = pixel;
    }
}

static void shade(const tracer *t, const burnish_kernels_shader *shader,
                  const tile_points *points) {
    uint32_t colors[TILE_PIXELS];
    float linear[3][TILE_PIXELS];
    float *const rgb[3] = {linear[0], linear[1], linear[2]};
    const burnish_kernels_points arrays = {
        .normal = {points->normal[0], points->normal[1], points->normal[2]}};
    const size_t count = (size_t)points->count;
    (void)burnish_kernels_shade_rgba8(t->kernels, shader, &arrays, count, (uint8_t *)colors, NULL);
    for (size_t i = 0; i < count; ++i) {
        memcpy(t->rgba + 4 * (size_t)points->pixel[i], &colors[i], 4);
    }
    if (t->encoded) {
        (void)burnish_kernels_shade_float(t->kernels, shader, &arrays, count, rgb, NULL);
        for (size_t i = 0; i < count; ++i) {
            for (size_t k = 0; k < 3; ++k) {
                t->encoded[3 * (size_t)points->pixel[i] + k] =
                    burnish_peers_srgb((double)linear[k][i]);
            }
        }
    }
}

static void draw_tile(const tracer *t, const burnish_kernels_shader *shader, int column, int row) {
    tile_points points;
    struct RTCRayHit16 rays;
    struct RTCIntersectContext context;
    _Alignas(64) int valid[LANES]; /* rtcIntersect16 reads it as a vector */
    points.count = 0;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int y = row * TILE; y < (row + 1) * TILE && y < BURNISH_PEERS_HEIGHT; y += SIDE) {
        for (int x = column * TILE; x < (column + 1) * TILE; x += SIDE) {
            aim(t->job, x, y, &rays, valid);
            rtcIntersect16(valid, t->scene, &context, &rays);
            collect(t, &rays, x, y, &points);
        }
    }
    shade(t, shader, &points);
}

static burnish_kernels_shader *make_shader(const tracer *t, const char *variant) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    const burnish_peers_job *job = t->job;
    for (int k = 0; k < 3; ++k) {
        lighting.material.ambient[k] = job->ambient;
        lighting.material.diffuse[k] = job->diffuse;
        lighting.material.specular[k] = job->specular;
        lighting.viewer[k] = job->viewer[k];
        lighting.lights[0].vector[k] = (double)job->light[k];
        lighting.lights[0].color[k] = 1;
    }
    lighting.material.exponent = job->exponent;
    if (strcmp(variant, "power") == 0) {
        lighting.lobe.kind = BURNISH_LOBE_POWER;
    } else if (strcmp(variant, "family") == 0) {
        lighting.lobe = (burnish_lobe_spec){.fit = BURNISH_FIT_ENERGY, .order = 2};
    } else {
        return NULL;
    }
    burnish_kernels_shader *shader;
    (void)burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
    return shader;
}

typedef struct tile_context {
    const tracer *t;
    const burnish_kernels_shader *shader;
} tile_context;

static void draw_task(void *of, size_t tile, int thread) {
    const tile_context *context = of;
    (void)thread;
    draw_tile(context->t, context->shader, (int)tile % COLUMNS, (int)tile / COLUMNS);
}

static int draw(tracer *t, const char *variant) {
    burnish_kernels_shader *shader = make_shader(t, variant);
    if (!shader) {
        return 0;
    }
    memset(t->rgba, 0, (size_t)BURNISH_PEERS_PIXELS * 4);
    tile_context context = {t, shader};
    burnish_tasks_run(&t->tasks, COLUMNS * ROWS, 1, 0, draw_task, &context);
    burnish_kernels_shader_destroy(shader);
    return 1;
}

static int frame(void *state, const char *variant, double *milliseconds) {
    const tracer *t = state;
    double start = burnish_peers_now(t->job);
    int done = draw(state, variant);
    *milliseconds = burnish_peers_now(t->job) - start;
    return done;
}

static int picture(void *state, const char *variant, uint8_t *rgb) {
    tracer *t = state;
    t->encoded = rgb;
    int done = draw(t, variant);
    t->encoded = NULL;
    return done;
}

int main(int count, char **arguments) {
    const burnish_peers_contestant contestant = {open_tracer, frame, picture, close_tracer};
    return burnish_peers_serve(&contestant, count, arguments);
}
