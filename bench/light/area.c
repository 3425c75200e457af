/* Area lights: frame times of rigs in turns, and how far maps of distant lights are off the integral
 * for each pixel. Usage: area INPUT [INPUT ...]
 * 1920x1080, 4 samples per pixel, one thread. A kept renderer has its maps; a new one makes them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "burnish/render.h"

enum { ROUNDS = 9, WIDTH = 1920, HEIGHT = 1080, SIDE = 256, RIGS = 5 };

/* As far away, and as large, as if it were distant. */
#define FAR_AWAY 1e5

static const char *const RIG_NAMES[RIGS] = {"3 directional lights", "3 point lights",
                                            "3 distant softboxes", "the same, a new renderer",
                                            "3 near softboxes"};

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void fail(const burnish_error *error) {
    fprintf(stderr, "area: %s\n", error->text);
    exit(EXIT_FAILURE);
}

static void set_softbox(burnish_area_light *light, const double center[3], double scale) {
    *light = (burnish_area_light){.is_two_sided = 1, .follows_camera = 1};
    for (int k = 0; k < 3; ++k) {
        light->center[k] = center[k] * scale;
        light->color[k] = 4;
    }
    light->half_u[0] = 0.3 * scale;
    light->half_v[1] = 0.3 * scale;
    light->half_v[2] = 0.1 * scale;
}

/* The key, fill and rim light of the plain look as another kind of light. */
static void set_rig(burnish_render_options *options, int rig) {
    const int count = options->light_count;
    for (int i = 0; i < count; ++i) {
        const double *toward = options->lights[i].vector;
        const double near_center[3] = {toward[0] / 2, toward[1] / 2, toward[2] / 2 - 1};
        set_softbox(&options->area_lights[i], rig == 4 ? near_center : toward, 1);
        options->area_lights[i].is_distant = rig != 4;
        if (rig == 1) {
            options->lights[i].kind = BURNISH_LIGHT_POINT;
        }
    }
    if (rig >= 2) {
        options->light_count = 0;
        options->area_light_count = count;
    }
}

static burnish_render_options make_options(const burnish_mesh *mesh, int width, int height) {
    burnish_error error;
    burnish_framing framing = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    options.width = width;
    options.height = height;
    options.threads = 1;
    framing.aspect = (double)width / height;
    if (burnish_camera_frame(mesh, &framing, &options.camera, &error) != BURNISH_STATUS_OK) {
        fail(&error);
    }
    return options;
}

static void bench_rigs(const burnish_mesh *mesh, const char *name) {
    burnish_renderer *renderers[RIGS] = {NULL};
    burnish_image image = {0};
    burnish_error error;
    double least[RIGS];
    for (int i = 0; i < RIGS * (ROUNDS + 1); ++i) {
        const int rig = i % RIGS;
        burnish_render_options options = make_options(mesh, WIDTH, HEIGHT);
        set_rig(&options, rig);
        if (!renderers[rig] && burnish_renderer_create(NULL, &renderers[rig], &error)) {
            fail(&error);
        }
        const double start = now();
        if (burnish_renderer_draw(renderers[rig], mesh, &options, &image, NULL, &error)) {
            fail(&error);
        }
        const double seconds = now() - start;
        least[rig] = i < 2 * RIGS || seconds < least[rig] ? seconds : least[rig];
        if (rig == 3) {
            burnish_renderer_destroy(renderers[rig]);
            renderers[rig] = NULL;
        }
    }
    printf("%s, ms per frame, least of %d in turns\n", name, ROUNDS);
    for (int rig = 0; rig < RIGS; ++rig) {
        printf("  %-26s %8.2f  %5.2f of point lights\n", RIG_NAMES[rig], 1e3 * least[rig],
               least[rig] / least[1]);
        burnish_renderer_destroy(renderers[rig]);
    }
    burnish_image_destroy(&image);
}

/* The light of one softbox of radiance 1 as linear floats. */
static void draw_softbox(const burnish_mesh *mesh, int is_distant, float *rgba) {
    const double center[3] = {-0.55, 0.75, 0.85};
    burnish_render_options options = make_options(mesh, SIDE, SIDE);
    burnish_target target = burnish_target_default();
    burnish_renderer *renderer;
    burnish_error error;
    set_softbox(&options.area_lights[0], center, is_distant ? 1 : FAR_AWAY);
    options.area_lights[0].is_distant = is_distant;
    for (int k = 0; k < 3; ++k) {
        options.area_lights[0].color[k] = 1;
        options.ambient_light[k] = 0;
        options.background[k] = 0;
    }
    options.light_count = 0;
    options.area_light_count = options.samples = 1;
    target.pixels = (burnish_pixels){.pixels = (uint8_t *)rgba,
                                     .width = SIDE,
                                     .height = SIDE,
                                     .stride = 4 * SIDE * sizeof *rgba,
                                     .format = BURNISH_PIXELS_RGBA_FLOAT};
    if (burnish_renderer_create(NULL, &renderer, &error) ||
        burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error)) {
        fail(&error);
    }
    burnish_renderer_destroy(renderer);
}

static void compare_maps(burnish_mesh *mesh) {
    static float maps[4 * SIDE * SIDE], exact[4 * SIDE * SIDE];
    /* Phong materials: metallic-roughness has other lobes under near lights */
    printf("maps against the integral for each pixel, one softbox, of the largest value\n"
           "  roughness   root of mean square       largest\n");
    for (int i = 0; i <= 9; ++i) {
        const double alpha = i * i / 100.0, n = i > 0 ? 2 / (alpha * alpha) - 2 : 1;
        burnish_material material = burnish_material_default();
        double sum = 0, most = 0, largest = 0;
        size_t count = 0;
        material.has_diffuse = 1;
        material.exponent = (float)n;
        for (int k = 0; k < 3; ++k) { /* row 0: a matt surface, whose light is diffuse */
            material.diffuse[k] = i == 0;
            material.specular[k] = i > 0;
        }
        burnish_mesh_set_material(mesh, 0, &material, NULL);
        draw_softbox(mesh, 1, maps);
        draw_softbox(mesh, 0, exact);
        for (size_t p = 0; p < 4 * SIDE * SIDE; p += 4) {
            const double difference = fabs((double)maps[p] - (double)exact[p]);
            count += exact[p] > 0;
            largest = (double)exact[p] > largest ? (double)exact[p] : largest;
            sum += difference * difference;
            most = difference > most ? difference : most;
        }
        char name[20] = "matt";
        if (i > 0) {
            snprintf(name, sizeof name, "%.1f", i / 10.0);
        }
        printf("  %9s   %19.5f  %12.5f\n", name, sqrt(sum / (double)count) / largest,
               most / largest);
    }
}

int main(int count, char **inputs) {
    burnish_load_options load = burnish_load_options_default();
    for (int i = 1; i < count; ++i) {
        burnish_mesh *mesh;
        burnish_error error;
        if (burnish_mesh_load(inputs[i], &load, &mesh, &error) != BURNISH_STATUS_OK) {
            fail(&error);
        }
        bench_rigs(mesh, inputs[i]);
        compare_maps(mesh);
        burnish_mesh_destroy(mesh);
    }
    return EXIT_SUCCESS;
}
