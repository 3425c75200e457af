/* Latency of single pictures: one process each, and requests to burnish serve-stdio.
 * Usage: bench_serve BURNISH FOLDER [ROUNDS]
 *   FOLDER  for a mesh of 5,000 triangles and a picture
 * Prints a table: wall time of ROUNDS pictures of 256 x 256, in turns, after 5 untimed ones. */
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "torus.h"

extern char **environ;

enum { GRID = 50, FIRST = 5, WAYS = 3, LOOKS = 2, PATH_MAX_BYTES = 1024 };

static const char *const look_flags[LOOKS] = {"--look=studio", "--look=plain"};
static const char *const look_names[LOOKS] = {"the default look", "`--look=plain`"};
static const char *const way_names[WAYS] = {"`burnish render`, a process each",
                                            "`burnish render --sandbox`, two processes each",
                                            "`burnish serve-stdio`, which locks each request in"};

typedef struct server {
    FILE *requests, *answers;
    pid_t process;
} server;

__attribute__((noreturn)) static void fail(const char *what) {
    fprintf(stderr, "bench_serve: %s\n", what);
    exit(1);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static server start(const char *burnish, const char *look) {
    char *arguments[] = {(char *)burnish, "serve-stdio", "--size=256", (char *)look, NULL};
    int in[2], out[2];
    posix_spawn_file_actions_t actions;
    server s = {0};
    if (pipe(in) != 0 || pipe(out) != 0 || posix_spawn_file_actions_init(&actions) != 0) {
        fail("no pipes");
    }
    posix_spawn_file_actions_adddup2(&actions, in[0], 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], 1);
    posix_spawn_file_actions_addclose(&actions, in[1]);
    posix_spawn_file_actions_addclose(&actions, out[0]);
    if (posix_spawn(&s.process, burnish, &actions, NULL, arguments, environ) != 0) {
        fail("burnish can't be started");
    }
    posix_spawn_file_actions_destroy(&actions);
    close(in[0]);
    close(out[1]);
    s.requests = fdopen(in[1], "wb");
    s.answers = fdopen(out[0], "rb");
    return s;
}

static void ask(server *s, const bytes *mesh) {
    static const char line[] = "{\"name\": \"torus.stl\"}\n";
    static char answer[1 << 22];
    uint32_t head[2] = {(uint32_t)(sizeof line - 1 + mesh->size), 1}; /* little-endian machines */
    fwrite(head, sizeof head, 1, s->requests);
    fwrite(line, sizeof line - 1, 1, s->requests);
    fwrite(mesh->data, mesh->size, 1, s->requests);
    if (fflush(s->requests) != 0 || fread(head, sizeof head, 1, s->answers) != 1 ||
        head[0] > sizeof answer || fread(answer, head[0], 1, s->answers) != 1 ||
        strncmp(answer, "{\"code\":0,", 10) != 0) {
        fail("serve-stdio did not draw");
    }
}

static void run(const char *burnish, const char *look, const char *mesh, const char *picture,
                int is_locked) {
    char *arguments[] = {(char *)burnish,
                         "render",
                         (char *)mesh,
                         "--size=256",
                         "--threads=1",
                         "-o",
                         (char *)picture,
                         (char *)look,
                         is_locked ? "--sandbox" : NULL,
                         NULL};
    pid_t process;
    int state;
    if (posix_spawn(&process, burnish, NULL, NULL, arguments, environ) != 0 ||
        waitpid(process, &state, 0) != process || state != 0) {
        fail("burnish render did not draw");
    }
}

/* `times`: WAYS times so many. */
static void print_look(int look, double *times, size_t count) {
    double base = 0;
    for (size_t way = 0; way < WAYS; ++way) {
        double *own = times + way * count;
        qsort(own, count, sizeof *own, compare);
        base = way == 0 ? own[count / 2] : base;
        printf("| %s | %s | %.1f | %.1f | %.2f |\n", look_names[look], way_names[way],
               own[count / 2], own[count * 95 / 100], own[count / 2] / base);
    }
}

/* Wall times of all ways, measured in turns. */
static void time_look(const char *burnish, int look, const char *mesh, const char *picture,
                      const bytes *file, double *times, size_t rounds) {
    server s = start(burnish, look_flags[look]);
    for (size_t i = 0; i < FIRST + rounds; ++i) {
        double clock[WAYS + 1] = {now()};
        run(burnish, look_flags[look], mesh, picture, 0);
        clock[1] = now();
        run(burnish, look_flags[look], mesh, picture, 1);
        clock[2] = now();
        ask(&s, file);
        clock[3] = now();
        for (size_t way = 0; way < WAYS && i >= FIRST; ++way) {
            times[way * rounds + i - FIRST] = clock[way + 1] - clock[way];
        }
    }
    fclose(s.requests);
    fclose(s.answers);
    waitpid(s.process, NULL, 0);
}

int main(int argc, char **argv) {
    const size_t rounds = argc > 3 ? (size_t)atoi(argv[3]) : 200;
    char mesh[PATH_MAX_BYTES], picture[PATH_MAX_BYTES];
    if (argc < 3 || rounds < 1) {
        fail("usage: bench_serve BURNISH FOLDER [ROUNDS]");
    }
    snprintf(mesh, sizeof mesh, "%s/torus.stl", argv[2]);
    snprintf(picture, sizeof picture, "%s/torus.png", argv[2]);
    torus t = make_torus(GRID);
    bytes file = write_stl(&t, 0);
    FILE *stream = fopen(mesh, "wb");
    if (!stream || fwrite(file.data, file.size, 1, stream) != 1 || fclose(stream) != 0) {
        fail("the folder can't be written");
    }
    double *times = malloc(WAYS * rounds * sizeof *times);
    printf("| | | median, ms | 95 %% are below, ms | of a process each |\n"
           "| --- | --- | ---: | ---: | ---: |\n");
    for (int look = 0; look < LOOKS && times; ++look) {
        time_look(argv[1], look, mesh, picture, &file, times, rounds);
        print_look(look, times, rounds);
    }
    free(times);
    free(file.data);
    torus_destroy(&t);
    return 0;
}
