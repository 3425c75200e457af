/* The loop that answers the runner's lines. */
#include "worker.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int write_file(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    if (!file) {
        return 0;
    }
    int whole = fwrite(bytes, 1, size, file) == size;
    return fclose(file) == 0 && whole;
}

static int answer_frames(const burnish_peers_contestant *contestant, void *state,
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

static int answer_picture(const burnish_peers_contestant *contestant, void *state,
                          const char *variant, const char *path) {
    uint8_t *rgb = calloc(BURNISH_PEERS_PIXELS, 3);
    int done = rgb && contestant->picture(state, variant, rgb) &&
               write_file(path, rgb, (size_t)BURNISH_PEERS_PIXELS * 3);
    free(rgb);
    if (done) {
        printf("ok\n");
    }
    return done;
}

static int answer_triangles(const burnish_peers_contestant *contestant, void *state,
                            const char *path) {
    uint32_t *numbers = calloc(BURNISH_PEERS_PIXELS, sizeof *numbers);
    int done = numbers && contestant->triangles(state, numbers) &&
               write_file(path, numbers, (size_t)BURNISH_PEERS_PIXELS * sizeof *numbers);
    free(numbers);
    if (done) {
        printf("ok\n");
    }
    return done;
}

static int answer(const burnish_peers_contestant *contestant, void *state, const char *line) {
    char variant[32], path[512];
    int count;
    if (sscanf(line, "frame %31s %d", variant, &count) == 2) {
        return answer_frames(contestant, state, variant, count);
    }
    if (sscanf(line, "picture %31s %511s", variant, path) == 2) {
        return answer_picture(contestant, state, variant, path);
    }
    if (sscanf(line, "triangles %511s", path) == 1) {
        return answer_triangles(contestant, state, path);
    }
    return 0;
}

int burnish_peers_serve(const burnish_peers_contestant *contestant, int count, char **arguments) {
    burnish_peers_job job;
    void *state;
    char note[BURNISH_PEERS_NOTE] = "", line[1024];
    if (count != 3) {
        fprintf(stderr, "usage: %s INPUT THREADS\n", arguments[0]);
        return EXIT_FAILURE;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    const int threads = atoi(arguments[2]);
    const burnish_peers_view view = {BURNISH_PEERS_WIDTH, BURNISH_PEERS_HEIGHT, 1, threads};
    if (!burnish_peers_job_open(&job, arguments[1], &view)) {
        return EXIT_FAILURE;
    }
    if (!contestant->open(&state, &job, threads, note)) {
        printf("error %s\n", note);
        burnish_peers_job_close(&job);
        return EXIT_FAILURE;
    }
    printf("ready %s\n", note);
    while (fgets(line, sizeof line, stdin)) {
        if (!answer(contestant, state, line)) {
            line[strcspn(line, "\n")] = 0;
            printf("error can't do \"%s\"\n", line);
        }
    }
    contestant->close(state);
    burnish_peers_job_close(&job);
    return EXIT_SUCCESS;
}
