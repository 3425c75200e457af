/* The loop that replies to the runner's requests. */
#include "worker.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int reply_frames(const burnish_peers_contestant *contestant, void *state,
                        const char *variant, int count) {
    double milliseconds;
    if (!contestant->frame(state, variant, &milliseconds)) {
        return 0;
    }
    printf("ok");
    for (int i = 0; i < count; ++i) {
        if (!contestant->frame(state, variant, &milliseconds)) {
            return 0;
        }
        printf(" %.4f", milliseconds);
    }
    printf("\n");
    return 1;
}

static int reply_picture(const burnish_peers_contestant *contestant, void *state,
                         const char *variant, const char *path) {
    uint8_t *rgb = calloc(BURNISH_PEERS_PIXELS, 3);
    FILE *file = fopen(path, "wb");
    int done = rgb && file && contestant->picture(state, variant, rgb) &&
               fwrite(rgb, 3, BURNISH_PEERS_PIXELS, file) == BURNISH_PEERS_PIXELS;
    done = file && fclose(file) == 0 && done;
    free(rgb);
    if (done) {
        printf("ok\n");
    }
    return done;
}

static int reply_counts(const burnish_peers_job *job) {
    burnish_render_options options = job->options;
    burnish_render_report report;
    burnish_image image;
    burnish_error error;
    options.counts = BURNISH_COUNTS_ALL;
    if (burnish_render(job->scene, &options, &image, &report, &error) != BURNISH_STATUS_OK) {
        return 0;
    }
    burnish_image_destroy(&image);
    printf("ok %zu %zu %zu\n", report.triangles, report.triangles_drawn, report.covered_pixels);
    return 1;
}

typedef struct server {
    const burnish_peers_contestant *contestant;
    int threads;
    burnish_peers_job job;
    void *state; /* NULL: nothing is open */
} server;

static void close_job(server *s) {
    if (s->state) {
        s->contestant->close(s->state);
        burnish_peers_job_close(&s->job);
        s->state = NULL;
    }
}

/* Always replies. */
static int reply_open(server *s, burnish_peers_view view, const char *input) {
    char note[BURNISH_PEERS_NOTE] = "";
    void *state;
    close_job(s);
    view.threads = s->threads;
    if (!burnish_peers_job_open(&s->job, input, &view)) {
        return 1;
    }
    if (s->contestant->open(&state, &s->job, s->threads, note)) {
        s->state = state;
        printf("ready %s\n", note);
    } else {
        burnish_peers_job_close(&s->job);
        printf("error %s\n", note);
    }
    return 1;
}

static int reply(server *s, const char *line) {
    burnish_peers_view view;
    char variant[32], path[512];
    int count;
    if (sscanf(line, "open %d %d %d %511[^\n]", &view.width, &view.height, &view.samples, path) ==
        4) {
        return reply_open(s, view, path);
    }
    if (!s->state) {
        return 0;
    }
    if (sscanf(line, "frame %31s %d", variant, &count) == 2) {
        return reply_frames(s->contestant, s->state, variant, count);
    }
    if (strncmp(line, "counts", 6) == 0) {
        return reply_counts(&s->job);
    }
    if (sscanf(line, "picture %31s %511s", variant, path) == 2) {
        return reply_picture(s->contestant, s->state, variant, path);
    }
    return 0;
}

int burnish_peers_serve(const burnish_peers_contestant *contestant, int count, char **arguments) {
    static server s;
    char line[1024];
    if (count != 2) {
        fprintf(stderr, "usage: %s THREADS\n", arguments[0]);
        return EXIT_FAILURE;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    s.contestant = contestant;
    s.threads = atoi(arguments[1]);
    while (fgets(line, sizeof line, stdin)) {
        if (!reply(&s, line)) {
            line[strcspn(line, "\n")] = 0;
            printf("error can't do \"%s\"\n", line);
        }
    }
    close_job(&s);
    return EXIT_SUCCESS;
}
