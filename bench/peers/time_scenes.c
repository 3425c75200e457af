/* burnish alone, scene by scene: least and median milliseconds per frame.
 * Usage: bench_scenes [--only NAME] [--threads N] [--samples N] [--size W,H] [--frames N]
 *                     [--pictures FOLDER] [FILE...]
 * Without files: all scenes of scenes.h, or with --only the ones whose names start with NAME. Draws
 * frames for about half a second, at least --frames (9) of them. To compare two builds, run their
 * programs in turn. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/image.h"
#include "job.h"
#include "scenes.h"

enum { FRAMES_MOST = 1000 };
static const double BUDGET = 500; /* milliseconds per scene */

typedef struct settings {
    burnish_peers_view view;
    const char *only, *pictures;
    int frames;
} settings;

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static const char *base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static int write_picture(const settings *s, const char *name, const burnish_image *image) {
    char path[600];
    burnish_error error;
    snprintf(path, sizeof path, "%s/%s.png", s->pictures, name);
    if (burnish_image_write_png(image, path, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "bench_scenes: %s\n", error.text);
        return 0;
    }
    return 1;
}

/* One line: what is drawn and how long a frame takes. */
static int time_job(const settings *s, const char *name, burnish_peers_job *job) {
    static double times[FRAMES_MOST];
    burnish_renderer *renderer;
    burnish_image image = {0};
    burnish_render_report report;
    burnish_error error;
    double sum = 0;
    int count = 0, done = 1;
    if (burnish_renderer_create(NULL, &renderer, &error) != BURNISH_STATUS_OK) {
        return 0;
    }
    job->options.counts = BURNISH_COUNTS_ALL;
    done = burnish_renderer_draw(renderer, job->scene, &job->options, &image, &report, &error) ==
           BURNISH_STATUS_OK;
    if (done && s->pictures) {
        done = write_picture(s, name, &image);
    }
    while (done && count < FRAMES_MOST && (count < s->frames || sum < BUDGET)) {
        const double start = burnish_peers_now(job);
        done = burnish_renderer_draw(renderer, job->scene, &job->options, &image, NULL, &error) ==
               BURNISH_STATUS_OK;
        times[count] = burnish_peers_now(job) - start;
        sum += times[count++];
    }
    if (done) {
        qsort(times, (size_t)count, sizeof *times, compare_doubles);
        printf("%-24s %9zu %9zu %9zu %9.3f %9.3f\n", name, report.triangles, report.triangles_drawn,
               report.covered_pixels, times[0], times[count / 2]);
    } else {
        fprintf(stderr, "bench_scenes: %s: %s\n", name, error.text);
    }
    burnish_renderer_destroy(renderer);
    burnish_image_destroy(&image);
    return done;
}

static int time_input(const settings *s, const char *input) {
    burnish_peers_job job;
    if (!burnish_peers_job_open(&job, input, &s->view)) {
        return 0;
    }
    const int done = time_job(s, base_name(input), &job);
    burnish_peers_job_close(&job);
    return done;
}

/* Returns the number of arguments read, 0 for a wrong one. */
static int read_flag(settings *s, int count, char **arguments) {
    const char *value = count > 1 ? arguments[1] : "";
    if (strcmp(arguments[0], "--only") == 0) {
        s->only = value;
    } else if (strcmp(arguments[0], "--pictures") == 0) {
        s->pictures = value;
    } else if (strcmp(arguments[0], "--threads") == 0) {
        s->view.threads = atoi(value);
    } else if (strcmp(arguments[0], "--samples") == 0) {
        s->view.samples = atoi(value);
    } else if (strcmp(arguments[0], "--frames") == 0) {
        s->frames = atoi(value);
    } else if (strcmp(arguments[0], "--size") != 0 ||
               sscanf(value, "%d,%d", &s->view.width, &s->view.height) != 2) {
        return 0;
    }
    return count > 1 ? 2 : 0;
}

int main(int count, char **arguments) {
    settings s = {{BURNISH_PEERS_WIDTH, BURNISH_PEERS_HEIGHT, 1, 1}, "", NULL, 9};
    int at = 1, used = 1, failures = 0;
    while (at < count && strncmp(arguments[at], "--", 2) == 0 && used) {
        used = read_flag(&s, count - at, arguments + at);
        at += used;
    }
    if (!used || s.view.width < 1 || s.view.height < 1 || s.frames > FRAMES_MOST) {
        fprintf(stderr,
                "usage: bench_scenes [--only NAME] [--threads N] [--samples N] [--size W,H] "
                "[--frames N] [--pictures FOLDER] [FILE...]\n");
        return EXIT_FAILURE;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    printf("%-24s %9s %9s %9s %9s %9s\n", "ms per frame", "triangles", "drawn", "pixels", "least",
           "median");
    for (int i = at; i < count; ++i) {
        failures += !time_input(&s, arguments[i]);
    }
    for (size_t i = 0; at == count && burnish_scene_name(i); ++i) {
        if (strncmp(burnish_scene_name(i), s.only, strlen(s.only)) == 0) {
            failures += !time_input(&s, burnish_scene_name(i));
        }
    }
    return failures ? EXIT_FAILURE : EXIT_SUCCESS;
}
