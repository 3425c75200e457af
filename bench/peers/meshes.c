/* burnish against llvmpipe on many meshes: one line each, then means and quartiles, for one and two
 * threads, one sample and four, 1920x1080 and 256x256.
 * Usage: bench_peers_meshes [--short] FOLDER [INPUT...]
 *   FOLDER has the contestants; an input is a file or a scene; without any: all scenes.
 *   --short  one frame each of 256x256, one thread, one sample
 *
 * Both load a file with burnish's reader and draw the same triangles. burnish draws energy:2 in
 * sRGB, llvmpipe pow in linear bytes; four samples are 4x MSAA with its resolve. Both cull back
 * faces unless a scene is open. The contestants take turns of a few frames while the other waits: a
 * busy moment affects both. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "process.h"
#include "scenes.h"

enum { CONTESTANTS = 2, SETUPS = 8, FRAMES = 3, ROUNDS = 3, MOST = 1 + FRAMES * ROUNDS };
enum { LINE = 1024, PATH = 600, NAME = 40 };
static const double SLOW =
    100; /* milliseconds: such a frame is timed once, a third of it in rounds of one */

/* One thread first. */
static const struct setup {
    int threads, samples, width, height;
} setups[SETUPS] = {{1, 1, 1920, 1080}, {1, 4, 1920, 1080}, {1, 1, 256, 256}, {1, 4, 256, 256},
                    {2, 1, 1920, 1080}, {2, 4, 1920, 1080}, {2, 1, 256, 256}, {2, 4, 256, 256}};
enum { SHORT_SETUP = 2 };

typedef struct times {
    double least, median; /* milliseconds; 0: not drawn */
} times;

typedef struct result {
    char name[NAME];
    size_t triangles, drawn[SETUPS], pixels[SETUPS];
    times times[SETUPS][CONTESTANTS];
} result;

typedef struct runner {
    const char *folder;
    int is_short;
    burnish_peers_process processes[2][CONTESTANTS]; /* of one thread, of two */
    result *results;
    size_t count;
} runner;

static const char *const NAMES[CONTESTANTS] = {"burnish", "llvmpipe"};

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int start(runner *r) {
    for (int threads = 1; threads <= (r->is_short ? 1 : 2); ++threads) {
        for (int i = 0; i < CONTESTANTS; ++i) {
            char program[PATH], count[8];
            snprintf(program, sizeof program, "%s/bench_peers_%s", r->folder, NAMES[i]);
            snprintf(count, sizeof count, "%d", threads);
            const char *const arguments[] = {program, count, NULL};
            if (!burnish_peers_start(&r->processes[threads - 1][i], arguments, threads,
                                     threads == 1 ? "LP_NUM_THREADS=0" : "LP_NUM_THREADS=2")) {
                fprintf(stderr, "bench-peers: %s is not built (scripts/install-deps peers)\n",
                        program);
                return 0;
            }
        }
    }
    return 1;
}

/* Adds the answered times to values, of which there are *count. */
static int ask_frames(burnish_peers_process *process, int frames, double values[MOST], int *count) {
    char line[64], answer[LINE];
    int used;
    snprintf(line, sizeof line, "frame scene %d", frames);
    burnish_peers_ask(process, line, answer, sizeof answer);
    if (strncmp(answer, "ok", 2) != 0) {
        return 0;
    }
    for (const char *at = answer + 2;
         *count < MOST && sscanf(at, "%lf%n", &values[*count], &used) == 1; at += used) {
        ++*count;
    }
    return 1;
}

/* Both draw what is open. */
static int time_setup(const runner *r, burnish_peers_process processes[CONTESTANTS],
                      times out[CONTESTANTS]) {
    double values[CONTESTANTS][MOST];
    int counts[CONTESTANTS] = {0};
    for (int round = 0; round <= (r->is_short ? 0 : ROUNDS); ++round) {
        for (int i = 0; i < CONTESTANTS; ++i) {
            const int enough = round > 0 && values[i][0] > SLOW;
            if (!enough && !ask_frames(&processes[i], round && values[i][0] < SLOW / 3 ? FRAMES : 1,
                                       values[i], &counts[i])) {
                return 0;
            }
        }
    }
    for (int i = 0; i < CONTESTANTS; ++i) {
        qsort(values[i], (size_t)counts[i], sizeof values[i][0], compare_doubles);
        out[i] = (times){values[i][0], values[i][counts[i] / 2]};
    }
    return 1;
}

static void run_setup(runner *r, result *to, int setup, const char *input) {
    burnish_peers_process *processes = r->processes[setups[setup].threads - 1];
    char line[LINE], answer[LINE];
    snprintf(line, sizeof line, "open %d %d %d %s", setups[setup].width, setups[setup].height,
             setups[setup].samples, input);
    for (int i = 0; i < CONTESTANTS; ++i) {
        burnish_peers_ask(&processes[i], line, answer, sizeof answer);
        if (strncmp(answer, "ready", 5) != 0) {
            fprintf(stderr, "bench-peers: %s: %s\n", NAMES[i], answer);
            return;
        }
    }
    burnish_peers_ask(&processes[0], "counts", answer, sizeof answer);
    if (sscanf(answer, "ok %zu %zu %zu", &to->triangles, &to->drawn[setup], &to->pixels[setup]) !=
            3 ||
        !time_setup(r, processes, to->times[setup])) {
        fprintf(stderr, "bench-peers: %s can't be drawn\n", input);
    }
}

static void run_input(runner *r, const char *input) {
    const char *slash = strrchr(input, '/');
    result *to = &r->results[r->count++];
    snprintf(to->name, sizeof to->name, "%.*s", NAME - 1, slash ? slash + 1 : input);
    for (int setup = 0; setup < SETUPS; ++setup) {
        if (!r->is_short || setup == SHORT_SETUP) {
            run_setup(r, to, setup, input);
        }
    }
    fprintf(stderr, "%zu %s\n", r->count, to->name);
}

/* ---- Report ---- */

static double ratio_of(const result *from, int setup, int by_least) {
    const times *t = from->times[setup];
    return by_least ? t[1].least / t[0].least : t[1].median / t[0].median;
}

static void print_summary(const runner *r, int setup, int by_least) {
    double *ratios = calloc(r->count, sizeof *ratios);
    double logarithms = 0;
    size_t count = 0, slower = 0;
    for (size_t i = 0; ratios && i < r->count; ++i) {
        if (r->results[i].times[setup][1].least > 0) {
            const double ratio = ratio_of(&r->results[i], setup, by_least);
            logarithms += log(ratio);
            slower += ratio < 1;
            ratios[count++] = ratio;
        }
    }
    if (count > 0) {
        qsort(ratios, count, sizeof *ratios, compare_doubles);
        printf("by %s: geometric mean %.2f, least %.2f, quartiles %.2f %.2f %.2f, most %.2f; %zu "
               "of %zu slower than llvmpipe\n",
               by_least ? "least times" : "medians", exp(logarithms / (double)count), ratios[0],
               ratios[count / 4], ratios[count / 2], ratios[3 * count / 4], ratios[count - 1],
               slower, count);
    }
    free(ratios);
}

static void print_setup(const runner *r, int setup) {
    printf("\n%dx%d, %d sample%s, %d thread%s\n", setups[setup].width, setups[setup].height,
           setups[setup].samples, setups[setup].samples > 1 ? "s" : "", setups[setup].threads,
           setups[setup].threads > 1 ? "s" : "");
    printf("%-40s %9s %8s %8s %9s %9s %6s %9s %9s %6s\n", "medians, then least times; ms",
           "triangles", "drawn", "pixels", "burnish", "llvmpipe", "ratio", "burnish", "llvmpipe",
           "ratio");
    for (size_t i = 0; i < r->count; ++i) {
        const result *from = &r->results[i];
        const times *t = from->times[setup];
        if (t[1].least > 0) {
            printf("%-40s %9zu %8zu %8zu %9.2f %9.2f %6.2f %9.2f %9.2f %6.2f\n", from->name,
                   from->triangles, from->drawn[setup], from->pixels[setup], t[0].median,
                   t[1].median, ratio_of(from, setup, 0), t[0].least, t[1].least,
                   ratio_of(from, setup, 1));
        }
    }
    print_summary(r, setup, 0);
    print_summary(r, setup, 1);
}

int main(int count, char **arguments) {
    runner r = {0};
    int at = 1;
    if (at < count && strcmp(arguments[at], "--short") == 0) {
        r.is_short = 1;
        ++at;
    }
    if (at == count) {
        fprintf(stderr, "usage: %s [--short] FOLDER [INPUT...]\n", arguments[0]);
        return EXIT_FAILURE;
    }
    r.folder = arguments[at++];
    size_t inputs = (size_t)(count - at);
    while (at == count && burnish_scene_name(inputs)) {
        ++inputs;
    }
    r.results = calloc(inputs, sizeof *r.results);
    signal(SIGPIPE, SIG_IGN); /* a contestant that ended is reported as an error */
    if (!r.results || !start(&r)) {
        free(r.results);
        return EXIT_FAILURE;
    }
    for (size_t i = 0; i < inputs; ++i) {
        run_input(&r, at == count ? burnish_scene_name(i) : arguments[(size_t)at + i]);
    }
    for (int threads = 1; threads <= (r.is_short ? 1 : 2); ++threads) {
        for (int i = 0; i < CONTESTANTS; ++i) {
            burnish_peers_stop(&r.processes[threads - 1][i]);
        }
    }
    for (int setup = 0; setup < SETUPS; ++setup) {
        if (!r.is_short || setup == SHORT_SETUP) {
            print_setup(&r, setup);
        }
    }
    for (size_t i = 0; at == count && burnish_scene_name(i); ++i) { /* for the page's table */
        printf("%s%s: %s\n", i ? "" : "\n", burnish_scene_name(i), burnish_scene_text(i));
    }
    free(r.results);
    return EXIT_SUCCESS;
}
