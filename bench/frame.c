/* Frame times: median, minimum and maximum over several frames, one row per mesh, lobe and thread
 * count. Usage: frame INPUT [INPUT ...]
 * 1920x1080, one sample per pixel, the default view and rig. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/render.h"

enum { FRAMES = 15 };

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int bench_lobe(const burnish_mesh *scene, const char *name, const char *lobe, int threads) {
    burnish_error error;
    burnish_framing fit = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    burnish_renderer *renderer;
    burnish_image image = {0};
    double milliseconds[FRAMES];
    size_t covered = 0;
    options.width = 1920;
    options.height = 1080;
    options.samples = 1;
    options.threads = threads;
    fit.aspect = 1920.0 / 1080;
    if (burnish_lobe_spec_parse(lobe, &options.lobe, &error) != BURNISH_STATUS_OK ||
        burnish_camera_frame(scene, &fit, &options.camera, &error) != BURNISH_STATUS_OK ||
        burnish_renderer_create(NULL, &renderer, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "frame: %s\n", error.text);
        return EXIT_FAILURE;
    }
    for (int i = 0; i < FRAMES; ++i) {
        burnish_render_report report;
        if (burnish_renderer_draw(renderer, scene, &options, &image, &report, &error) !=
            BURNISH_STATUS_OK) {
            burnish_renderer_destroy(renderer);
            fprintf(stderr, "frame: %s\n", error.text);
            return EXIT_FAILURE;
        }
        milliseconds[i] = (report.seconds_transform + report.seconds_draw) * 1e3;
        covered = report.covered_pixels;
    }
    burnish_image_destroy(&image);
    burnish_renderer_destroy(renderer);
    qsort(milliseconds, FRAMES, sizeof *milliseconds, compare_doubles);
    printf("%-28s %9zu %8zu  %-10s %7d %8.2f %8.2f %8.2f\n", name,
           burnish_mesh_get_view(scene)->triangle_count, covered, lobe, threads,
           milliseconds[FRAMES / 2], milliseconds[0], milliseconds[FRAMES - 1]);
    return EXIT_SUCCESS;
}

int main(int count, char **inputs) {
    static const char *const LOBES[] = {"taylor:2", "energy:2", "schlick", "power"};
    burnish_load_options load = burnish_load_options_default();
    printf("%-28s %9s %8s  %-10s %7s %8s %8s %8s\n", "1920x1080, ms per frame", "triangles",
           "pixels", "lobe", "threads", "median", "minimum", "maximum");
    for (int i = 1; i < count; ++i) {
        burnish_mesh *scene;
        burnish_error error;
        if (burnish_mesh_load(inputs[i], &load, &scene, &error) != BURNISH_STATUS_OK) {
            fprintf(stderr, "frame: %s\n", error.text);
            return EXIT_FAILURE;
        }
        const char *slash = strrchr(inputs[i], '/');
        for (int lobe = 0; lobe < 4; ++lobe) {
            for (int threads = 1; threads <= 2; ++threads) {
                if (bench_lobe(scene, slash ? slash + 1 : inputs[i], LOBES[lobe], threads)) {
                    burnish_mesh_destroy(scene);
                    return EXIT_FAILURE;
                }
            }
        }
        burnish_mesh_destroy(scene);
    }
    return EXIT_SUCCESS;
}
