/* The runner: starts the contestants, times them in turn, compares their pictures, prints a table
 * and writes the ratios as JSON.
 * Usage: bench_peers FOLDER BURNISH SCRATCH JSON [ROUNDS]
 *   FOLDER has the contestants, BURNISH is the program.
 *
 * Contestants of one scene and thread count run at the same time, but only one of them draws at a
 * time: each round asks each for a few frames in turn, so a busy moment affects all alike. A
 * round waits for a quiet moment first; rounds without one are counted. */
#include <cjson/cJSON.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare.h"
#include "figures.h"
#include "process.h"
#include "quiet.h"

enum { FRAMES = 3, CONTESTANTS = 3, VARIANTS = 5, LINE = 2048, PATH = 600, PATIENCE = 300 };

typedef struct contestant {
    const char *name;
    const char *variants[VARIANTS];
    const char *packages;
} contestant;

/* The first of each is the reference of the ratios; family is energy:2, the default. */
static const contestant contestants[CONTESTANTS] = {
    {"burnish", {"family", "family-two-sided", "power", "schlick", "libm"}, ""},
    {"llvmpipe",
     {"power", "power-srgb", "power-two-sided", "family", "schlick"},
     "libegl-dev libgles-dev libegl-mesa0 libgl1-mesa-dri"},
    {"embree", {"family", "power"}, "libembree-dev"},
};

static const struct scene { const char *name; } scenes[] = {{"bunny"}, {"bunny16"}};

enum { SCENES = sizeof scenes / sizeof *scenes };

typedef struct runner {
    const char *folder, *burnish, *scratch, *json;
    int rounds, cores;
    double patience; /* seconds left to wait for quiet moments */
    int all_rounds, busy_rounds;
    burnish_peers_figures figures;
    char skipped[CONTESTANTS + 1][LINE]; /* why; the last one is f3d */
    burnish_peers_comparison comparisons[SCENES][CONTESTANTS];
    int compared[SCENES][CONTESTANTS];
} runner;

/* ---- Frames ---- */

static void skip(runner *r, int which, const char *why) {
    if (!r->skipped[which][0]) {
        snprintf(r->skipped[which], LINE, "%.*s", LINE - 1, why);
    }
}

/* Starts a contestant; on failure returns 0 and notes why. */
static int start(runner *r, int which, const struct scene *scene, int threads,
                 burnish_peers_process *process) {
    char program[PATH], count[8], open[64], answer[LINE], why[LINE + 64];
    snprintf(program, sizeof program, "%s/bench_peers_%s", r->folder, contestants[which].name);
    snprintf(count, sizeof count, "%d", threads);
    const char *const arguments[] = {program, count, NULL};
    if (access(program, X_OK) != 0) {
        snprintf(why, sizeof why, "not built: install %s (scripts/install-deps peers)",
                 contestants[which].packages);
        skip(r, which, why);
        return 0;
    }
    if (!burnish_peers_start(process, arguments, threads,
                             threads == 1 ? "LP_NUM_THREADS=0" : "LP_NUM_THREADS=2")) {
        skip(r, which, "it can't be started");
        return 0;
    }
    snprintf(open, sizeof open, "open 1920 1080 1 %s", scene->name);
    burnish_peers_ask(process, open, answer, sizeof answer);
    if (strncmp(answer, "ready ", 6) != 0) {
        skip(r, which, answer);
        burnish_peers_stop(process);
        return 0;
    }
    printf("  %s\n", answer + 6);
    return 1;
}

static void begin_round(runner *r) {
    ++r->all_rounds;
    r->busy_rounds += !burnish_peers_wait_until_quiet(&r->patience);
}

static void time_variant(runner *r, const char *prefix, int which, const char *variant,
                         burnish_peers_process *process) {
    const char *name = contestants[which].name;
    char line[LINE], answer[LINE], figure[BURNISH_PEERS_NAME];
    int used = 0;
    snprintf(line, sizeof line, "frame %s %d", variant, FRAMES);
    burnish_peers_ask(process, line, answer, sizeof answer);
    if (strncmp(answer, "ok", 2) != 0) {
        char why[LINE + 64];
        snprintf(why, sizeof why, "%s: %s", variant, answer);
        skip(r, which, why);
        return;
    }
    snprintf(figure, sizeof figure, "%s.%s.%s", prefix, name, variant);
    double value;
    for (const char *at = answer + 2; sscanf(at, "%lf%n", &value, &used) == 1; at += used) {
        burnish_peers_add(&r->figures, figure, value);
    }
}

static void time_rounds(runner *r, const char *prefix, const int running[CONTESTANTS],
                        burnish_peers_process processes[CONTESTANTS]) {
    for (int round = 0; round < r->rounds; ++round) {
        begin_round(r);
        for (int i = 0; i < CONTESTANTS; ++i) {
            for (int v = 0; running[i] && v < VARIANTS && contestants[i].variants[v]; ++v) {
                time_variant(r, prefix, i, contestants[i].variants[v], &processes[i]);
                usleep(10000); /* lets spinning threads fall asleep */
            }
        }
    }
}

static int draw_to_file(runner *r, int which, const char *scene, burnish_peers_process *process,
                        char picture[PATH], char triangles[PATH]) {
    char line[LINE], answer[LINE];
    const char *name = contestants[which].name;
    snprintf(picture, PATH, "%s/%s-%s.rgb", r->scratch, scene, name);
    snprintf(triangles, PATH, "%s/%s-%s.triangles", r->scratch, scene, name);
    snprintf(line, sizeof line, "picture power %s", picture);
    if (!burnish_peers_ask(process, line, answer, sizeof answer) || strcmp(answer, "ok") != 0) {
        return 0;
    }
    snprintf(line, sizeof line, "triangles %s", triangles);
    return burnish_peers_ask(process, line, answer, sizeof answer) && strcmp(answer, "ok") == 0;
}

/* Ours against each of the others. */
static void compare_pictures(runner *r, int scene, const int running[CONTESTANTS],
                             burnish_peers_process processes[CONTESTANTS]) {
    char pictures[CONTESTANTS][PATH], triangles[CONTESTANTS][PATH];
    int drawn[CONTESTANTS] = {0};
    for (int i = 0; i < CONTESTANTS; ++i) {
        drawn[i] = running[i] &&
                   draw_to_file(r, i, scenes[scene].name, &processes[i], pictures[i], triangles[i]);
        if (i > 0 && drawn[0] && drawn[i]) {
            const char *const two[2] = {pictures[0], pictures[i]};
            const char *const numbers[2] = {triangles[0], triangles[i]};
            r->compared[scene][i] = burnish_peers_compare(two, numbers, &r->comparisons[scene][i]);
        }
    }
}

static void run_frames(runner *r, int scene, int threads) {
    burnish_peers_process processes[CONTESTANTS];
    int running[CONTESTANTS];
    char prefix[BURNISH_PEERS_NAME / 2];
    printf("%s, %d thread%s:\n", scenes[scene].name, threads, threads == 1 ? "" : "s");
    for (int i = 0; i < CONTESTANTS; ++i) {
        running[i] = start(r, i, &scenes[scene], threads, &processes[i]);
    }
    snprintf(prefix, sizeof prefix, "frame.%s.t%d", scenes[scene].name, threads);
    time_rounds(r, prefix, running, processes);
    if (threads == 1) {
        compare_pictures(r, scene, running, processes);
    }
    for (int i = 0; i < CONTESTANTS; ++i) {
        if (running[i]) {
            burnish_peers_stop(&processes[i]);
        }
    }
}

/* ---- Whole processes ---- */

static const struct picture_size {
    const char *name, *resolution;
} sizes[] = {{"256", "256,256"}, {"1080p", "1920,1080"}};

enum { SIZES = sizeof sizes / sizeof *sizes };

/* counts: 0 for the first run, which fills the caches of files and shaders. */
static void time_process(runner *r, const char *scene, int size, int cores, int is_f3d,
                         const char *display, int counts) {
    char input[PATH], output[PATH], name[2][BURNISH_PEERS_NAME];
    const char *who = is_f3d ? "f3d" : "burnish";
    double milliseconds, kibibytes;
    snprintf(input, sizeof input, "%s/%s.ply", r->scratch, scene);
    snprintf(output, sizeof output, "%s/%s-%s-%s.png", r->scratch, scene, sizes[size].name, who);
    snprintf(name[0], sizeof name[0], "process.%s.%s.t%d.%s", scene, sizes[size].name, cores, who);
    snprintf(name[1], sizeof name[1], "memory.%s.%s.t%d.%s", scene, sizes[size].name, cores, who);
    const burnish_peers_picture picture = {input, output, sizes[size].resolution, 0};
    if (!burnish_peers_draw(&picture, is_f3d ? NULL : r->burnish, cores, display, &milliseconds,
                            &kibibytes)) {
        fprintf(stderr, "bench-peers: %s can't draw %s\n", who, input);
        return;
    }
    if (counts) {
        burnish_peers_add(&r->figures, name[0], milliseconds);
        burnish_peers_add(&r->figures, name[1], kibibytes);
    }
}

static int write_ply(const runner *r, int scene) {
    char program[PATH], output[PATH];
    double milliseconds, kibibytes;
    snprintf(program, sizeof program, "%s/bench_peers_ply", r->folder);
    snprintf(output, sizeof output, "%s/%s.ply", r->scratch, scenes[scene].name);
    const char *const arguments[] = {program, scenes[scene].name, output, NULL};
    return burnish_peers_run(arguments, 0, NULL, &milliseconds, &kibibytes);
}

static void run_processes(runner *r) {
    char display[32] = "";
    pid_t x = 0;
    if (!burnish_peers_installed("f3d") || !burnish_peers_installed("Xvfb")) {
        skip(r, CONTESTANTS, "not found: install f3d xvfb (scripts/install-deps peers)");
    } else if (!(x = burnish_peers_start_x(display, sizeof display))) {
        skip(r, CONTESTANTS, "Xvfb does not start");
    }
    for (int scene = 0; scene < SCENES; ++scene) {
        if (!write_ply(r, scene)) {
            fprintf(stderr, "bench-peers: no PLY of %s\n", scenes[scene].name);
            continue;
        }
        for (int round = 0; round <= r->rounds; ++round) {
            begin_round(r);
            for (int size = 0; size < SIZES; ++size) {
                for (int cores = 1; cores <= (r->cores > 1 ? 2 : 1); ++cores) {
                    if (x) {
                        time_process(r, scenes[scene].name, size, cores, 1, display, round > 0);
                    }
                    time_process(r, scenes[scene].name, size, cores, 0, display, round > 0);
                }
            }
        }
    }
    if (x) {
        burnish_peers_stop_x(x);
    }
}

/* ---- Report ---- */

static void print_table(const runner *r) {
    printf("\n%-44s %9s %9s %9s %9s\n", "ms; KiB of memory", "median", "quarter", "minimum",
           "x ours");
    for (size_t i = 0; i < r->figures.count; ++i) {
        const char *name = r->figures.items[i].name;
        char ours[BURNISH_PEERS_NAME];
        int prefix = 0;
        int is_frame = strncmp(name, "frame.", 6) == 0;
        /* frame.SCENE.THREADS, process.SCENE.SIZE.CORES: the contestant follows */
        for (int dots = 0; name[prefix] && dots < (is_frame ? 3 : 4); ++prefix) {
            dots += name[prefix] == '.';
        }
        snprintf(ours, sizeof ours, "%.*sburnish%s", prefix, name, is_frame ? ".family" : "");
        double median = burnish_peers_median(&r->figures, name);
        printf("%-44s %9.2f %9.2f %9.2f %9.2f\n", name, median,
               burnish_peers_quantile(&r->figures, name, 0.25),
               burnish_peers_quantile(&r->figures, name, 0),
               median / burnish_peers_median(&r->figures, ours));
    }
}

static void print_histogram(const size_t histogram[256]) {
    for (int i = 0; i < 256; ++i) {
        if (histogram[i]) {
            printf(" %d: %zu", i, histogram[i]);
        }
    }
}

static void print_comparisons(const runner *r) {
    printf("\nPictures with cos^n, sRGB bytes, histograms of the difference from burnish:\n");
    for (int scene = 0; scene < SCENES; ++scene) {
        for (int i = 1; i < CONTESTANTS; ++i) {
            const burnish_peers_comparison *c = &r->comparisons[scene][i];
            if (!r->compared[scene][i]) {
                continue;
            }
            printf("  %s, %s: %zu pixels of the same triangle,", scenes[scene].name,
                   contestants[i].name, c->same);
            print_histogram(c->histogram);
            printf("\n    %zu pixels of another triangle,", c->other_triangle);
            print_histogram(c->other_histogram);
            printf("; %zu pixels covered by one only\n", c->coverage);
        }
    }
}

static void add_ratio(const runner *r, cJSON *json, const char *key, const char *theirs,
                      const char *ours) {
    double ratio =
        burnish_peers_median(&r->figures, theirs) / burnish_peers_median(&r->figures, ours);
    if (isfinite(ratio)) {
        cJSON_AddNumberToObject(json, key, round(ratio * 1000) / 1000);
    } else {
        cJSON_AddNullToObject(json, key);
    }
}

static void add_frame_ratios(const runner *r, cJSON *json) {
    static const char *const ratios[][3] = {
        {"llvmpipe", "llvmpipe.power", "family"},
        {"llvmpipe_srgb", "llvmpipe.power-srgb", "family"},
        {"llvmpipe_two_sided", "llvmpipe.power-two-sided", "family-two-sided"},
        {"llvmpipe_family", "llvmpipe.family", "family"},
        {"embree", "embree.family", "family"},
        {"two_sided", "burnish.family-two-sided", "family"},
        {"libm", "burnish.libm", "family"},
        {"vector_pow", "burnish.power", "family"},
        {"schlick", "burnish.schlick", "family"},
    };
    for (int scene = 0; scene < SCENES; ++scene) {
        for (int threads = 1; threads <= 2; ++threads) {
            for (size_t i = 0; i < sizeof ratios / sizeof *ratios; ++i) {
                char prefix[24], key[64], theirs[64], ours[64];
                snprintf(prefix, sizeof prefix, "frame.%s.t%d", scenes[scene].name, threads);
                snprintf(key, sizeof key, "%s.%s_over", prefix, ratios[i][0]);
                snprintf(theirs, sizeof theirs, "%s.%s", prefix, ratios[i][1]);
                snprintf(ours, sizeof ours, "%s.burnish.%s", prefix, ratios[i][2]);
                add_ratio(r, json, key, theirs, ours);
            }
        }
    }
}

/* One core has the plain name. */
static void add_process_ratios(const runner *r, cJSON *json) {
    static const char *const kinds[] = {"process", "memory"};
    for (int kind = 0; kind < 2; ++kind) {
        for (int scene = 0; scene < SCENES; ++scene) {
            for (int size = 0; size < SIZES; ++size) {
                for (int cores = 1; cores <= 2; ++cores) {
                    char prefix[40], key[64], names[2][64];
                    snprintf(prefix, sizeof prefix, "%s.%s.%s", kinds[kind], scenes[scene].name,
                             sizes[size].name);
                    snprintf(key, sizeof key, "%s%s.f3d_over", prefix, cores == 1 ? "" : ".t2");
                    snprintf(names[0], sizeof names[0], "%s.t%d.f3d", prefix, cores);
                    snprintf(names[1], sizeof names[1], "%s.t%d.burnish", prefix, cores);
                    add_ratio(r, json, key, names[0], names[1]);
                }
            }
        }
    }
}

static void add_pictures(const runner *r, cJSON *json) {
    for (int scene = 0; scene < SCENES; ++scene) {
        for (int i = 1; i < CONTESTANTS; ++i) {
            char key[64];
            snprintf(key, sizeof key, "picture.%s.%s_difference", scenes[scene].name,
                     contestants[i].name);
            if (r->compared[scene][i]) {
                cJSON_AddNumberToObject(json, key, r->comparisons[scene][i].largest);
            } else {
                cJSON_AddNullToObject(json, key);
            }
        }
    }
}

static const char *contestant_name(int which) {
    return which < CONTESTANTS ? contestants[which].name : "f3d";
}

static int write_json(const runner *r) {
    cJSON *json = cJSON_CreateObject();
    add_frame_ratios(r, json);
    add_process_ratios(r, json);
    add_pictures(r, json);
    cJSON *skipped = cJSON_AddObjectToObject(json, "skipped");
    for (int i = 0; i <= CONTESTANTS; ++i) {
        if (r->skipped[i][0]) {
            cJSON_AddStringToObject(skipped, contestant_name(i), r->skipped[i]);
        }
    }
    if (r->cores < 2) {
        cJSON_AddStringToObject(skipped, "t2", "this machine offers one core");
    }
    cJSON_AddNumberToObject(json, "busy_rounds", r->busy_rounds);
    cJSON_AddNumberToObject(json, "rounds", r->all_rounds);
    char *ratios = cJSON_Print(json);
    printf("\n%s\n", ratios ? ratios : "{}");
    cJSON_free(ratios);
    cJSON *medians = cJSON_AddObjectToObject(json, "medians");
    for (size_t i = 0; i < r->figures.count; ++i) {
        const char *name = r->figures.items[i].name;
        double median = burnish_peers_median(&r->figures, name);
        cJSON_AddNumberToObject(medians, name, round(median * 1000) / 1000);
    }
    char *text = cJSON_Print(json);
    FILE *file = text ? fopen(r->json, "w") : NULL;
    int done = file && fprintf(file, "%s\n", text) > 0;
    done = file && fclose(file) == 0 && done;
    cJSON_free(text);
    cJSON_Delete(json);
    return done;
}

static void print_machine(const runner *r) {
    double load[1] = {0};
    (void)getloadavg(load, 1);
    printf("%d cores, load %.1f at the start; %d rounds of %d frames, 1920x1080, one sample\n",
           r->cores, load[0], r->rounds, FRAMES);
}

static void run(runner *r) {
    print_machine(r);
    for (int scene = 0; scene < SCENES; ++scene) {
        run_frames(r, scene, 1);
        if (r->cores > 1) {
            run_frames(r, scene, 2);
        }
    }
    run_processes(r);
    print_table(r);
    print_comparisons(r);
    printf("%d of %d rounds began while other programs ran\n", r->busy_rounds, r->all_rounds);
    for (int i = 0; i <= CONTESTANTS; ++i) {
        if (r->skipped[i][0]) {
            printf("skipped: %s: %s\n", contestant_name(i), r->skipped[i]);
        }
    }
}

int main(int count, char **arguments) {
    runner *r = calloc(1, sizeof *r);
    if (count < 5 || count > 6 || !r) {
        fprintf(stderr, "usage: %s FOLDER BURNISH SCRATCH JSON [ROUNDS]\n", arguments[0]);
        free(r);
        return EXIT_FAILURE;
    }
    r->folder = arguments[1];
    r->burnish = arguments[2];
    r->scratch = arguments[3];
    r->json = arguments[4];
    r->rounds = count > 5 ? atoi(arguments[5]) : 11;
    r->patience = r->rounds > 1 ? PATIENCE : 0; /* a single round is a check, not a measurement */
    r->cores = (int)sysconf(_SC_NPROCESSORS_ONLN);
    signal(SIGPIPE, SIG_IGN); /* a contestant that ended is reported as an error */
    setvbuf(stdout, NULL, _IOLBF, 0);
    run(r);
    int done = write_json(r);
    if (!done) {
        fprintf(stderr, "bench-peers: %s can't be written\n", r->json);
    }
    free(r);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
