/* Times the library's kernels next to Schlick's lobe and pow. Usage: bench_kernels [quick]
 *
 * The rows of a table take turns: a round runs each for about a millisecond. Printed are the median
 * time of one element, and the median over the rounds of its ratio to the first row's time in the
 * same round, which other work on the machine disturbs least. No thread is pinned. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bench/kernels/scalar.h"
#include "burnish/kernels.h"

#if defined(__SSE2__)
#include <x86intrin.h>
#endif

enum { POINTS = 2048, EXPONENT = 33, ROWS_MAX = 13, ROUNDS = 41 };

typedef struct row {
    const char *label;
    void (*run)(const struct row *row);
    const burnish_kernels *kernels;
    burnish_lobe_spec lobe;
    burnish_kernels_shader *shader;
    const burnish_bench_scalar *scalar;
    size_t repetitions;
    double nanoseconds[ROUNDS]; /* of one element */
} row;

static int rounds = ROUNDS;
static double round_seconds = 1e-3;
static _Alignas(64) float cosines[POINTS], lit[POINTS], values[POINTS];
static _Alignas(64) float normals[3][POINTS], positions[3][POINTS];
static _Alignas(64) uint8_t rgba[4 * POINTS];

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Of the time-stamp counter; 0 if the machine lacks one. */
static double counter_hertz(void) {
#if defined(__SSE2__)
    const double start = now();
    const unsigned long long first = __rdtsc();
    while (now() - start < 0.02) {
    }
    return (double)(__rdtsc() - first) / (now() - start);
#else
    return 0;
#endif
}

/* Cosines uniform in [0, 1], the same numbers every time, and others inside the lobe; the middle of
 * a sphere. */
static void make_input(void) {
    uint32_t state = 2463534242u;
    for (int i = 0; i < POINTS; ++i) {
        const double x = 0.7 * (i % 256 - 127.5) / 128, y = 0.7 * (i / 256 - 3.5) / 4;
        const double point[3] = {x, y, sqrt(1 - x * x - y * y)};
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        cosines[i] = (float)(state >> 8) * 0x1p-24f;
        lit[i] = 1.0f - 0.09f * cosines[i]; /* zeta is 11 at n = 33 */
        for (int k = 0; k < 3; ++k) {
            positions[k][i] = (float)point[k];
            normals[k][i] = 0.97f * (float)point[k]; /* as if interpolated */
        }
    }
}

/* ---- What is timed ---- */

static void run_lobe(const row *at) {
    (void)burnish_kernels_lobe_of_cosines(at->kernels, &at->lobe, EXPONENT, POINTS, cosines, values,
                                          NULL);
}

static void run_copy(const row *at) {
    (void)at;
    memcpy(values, cosines, sizeof values);
    __asm__ volatile("" ::: "memory");
}

static void run_libm(const row *at) {
    (void)at;
    for (int i = 0; i < POINTS; ++i) {
        values[i] = powf(cosines[i] > 0 ? cosines[i] : 0, EXPONENT);
    }
    __asm__ volatile("" ::: "memory");
}

static void run_shade(const row *at) {
    const burnish_kernels_points points = {.normal = {normals[0], normals[1], normals[2]},
                                           .position = {positions[0], positions[1], positions[2]}};
    (void)burnish_kernels_shade_rgba8(at->kernels, at->shader, &points, POINTS, rgba, NULL);
}

static void run_through(const row *at) {
    (void)at->scalar->through(EXPONENT, POINTS, cosines, values);
}

static void run_chain(const row *at) {
    (void)at->scalar->chain(EXPONENT, POINTS, lit, values);
}

/* ---- Tables ---- */

static double time_row(const row *at, size_t repetitions) {
    const double start = now();
    for (size_t i = 0; i < repetitions; ++i) {
        at->run(at);
    }
    return now() - start;
}

static void calibrate(row *at) {
    double taken = time_row(at, 1); /* warms the caches */
    at->repetitions = 1;
    while ((taken = time_row(at, at->repetitions)) < 0.25 * round_seconds) {
        at->repetitions *= 2;
    }
    const double wanted = (double)at->repetitions * round_seconds / taken;
    at->repetitions = wanted > 1 ? (size_t)wanted : 1;
}

static void take_turns(row *rows, int count) {
    for (int i = 0; i < count; ++i) {
        calibrate(&rows[i]);
    }
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < count; ++i) {
            const double taken = time_row(&rows[i], rows[i].repetitions);
            rows[i].nanoseconds[round] = 1e9 * taken / ((double)rows[i].repetitions * POINTS);
        }
    }
}

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of a row's time divided by that of another row, or by 1 without one. */
static double median(const row *at, const row *over) {
    double sorted[ROUNDS];
    for (int i = 0; i < rounds; ++i) {
        sorted[i] = at->nanoseconds[i] / (over ? over->nanoseconds[i] : 1);
    }
    qsort(sorted, (size_t)rounds, sizeof *sorted, compare_doubles);
    return sorted[rounds / 2];
}

static void print_table(const char *title, row *rows, int count) {
    take_turns(rows, count);
    printf("  %-52s %9s %9s\n", title, "ns", "x first");
    for (int i = 0; i < count; ++i) {
        printf("    %-50s %9.4f %9.2f\n", rows[i].label, median(&rows[i], NULL),
               median(&rows[i], &rows[0]));
        burnish_kernels_shader_destroy(rows[i].shader);
    }
}

static const struct contender {
    const char *label, *lobe;
} CONTENDERS[] = {{"the lobe, energy:2", "energy:2"},
                  {"energy:4", "energy:4"},
                  {"energy:8", "energy:8"},
                  {"composite:3", "composite:3"},
                  {"composite:4", "composite:4"},
                  {"composite:5", "composite:5"},
                  {"composite:6", "composite:6"},
                  {"Schlick", "schlick"},
                  {"pow, the library's with SIMD", "power"}};

enum { CONTENDER_COUNT = sizeof CONTENDERS / sizeof *CONTENDERS };

static void time_lobes(const burnish_kernels *kernels) {
    row rows[ROWS_MAX] = {{0}};
    for (int i = 0; i < CONTENDER_COUNT; ++i) {
        rows[i] = (row){.label = CONTENDERS[i].label, .run = run_lobe, .kernels = kernels};
        (void)burnish_lobe_spec_parse(CONTENDERS[i].lobe, &rows[i].lobe, NULL);
    }
    rows[CONTENDER_COUNT] = (row){.label = "powf of libm", .run = run_libm};
    rows[CONTENDER_COUNT + 1] = (row){.label = "a copy", .run = run_copy};
    print_table("lobes, 2,048 floats in the first cache, n = 33", rows, CONTENDER_COUNT + 2);
}

/* The last row has no highlight. */
static void time_shading(const burnish_kernels *kernels, const char *title, int is_point) {
    static const double light[3] = {-2.0, 2.5, 3.0};
    row rows[ROWS_MAX] = {{0}};
    for (int i = 0; i <= CONTENDER_COUNT; ++i) {
        const int is_none = i == CONTENDER_COUNT;
        burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
        rows[i] = (row){.label = is_none ? "no highlight" : CONTENDERS[i].label,
                        .run = run_shade,
                        .kernels = kernels};
        lighting.material.exponent = EXPONENT;
        if (is_none) {
            memset(lighting.material.specular, 0, sizeof lighting.material.specular);
        } else {
            (void)burnish_lobe_spec_parse(CONTENDERS[i].lobe, &lighting.lobe, NULL);
        }
        if (is_point) {
            lighting.local_viewer = 1;
            lighting.viewer[2] = 4;
            lighting.lights[0].kind = BURNISH_LIGHT_POINT;
            memcpy(lighting.lights[0].vector, light, sizeof light);
        }
        if (burnish_kernels_shader_create(&lighting, NULL, &rows[i].shader, NULL)) {
            fputs("bench_kernels: out of memory\n", stderr);
            exit(EXIT_FAILURE);
        }
    }
    print_table(title, rows, CONTENDER_COUNT + 1);
}

/* The loop alone, the second row, is subtracted from latencies; throughputs hide it. */
static void time_scalars(const char *title, int is_chain, double hertz) {
    const burnish_bench_scalar *list = burnish_bench_paper;
    row rows[ROWS_MAX] = {{0}};
    int count = 0;
    for (; list[count].label; ++count) {
        rows[count] = (row){.label = list[count].label,
                            .run = is_chain ? run_chain : run_through,
                            .scalar = &list[count]};
    }
    take_turns(rows, count);
    const double loop = is_chain ? median(&rows[1], NULL) : 0;
    const double first = median(&rows[0], NULL) - loop;
    printf("  %-52s %9s %9s %9s\n", title, "ns", "cycles", "Schlick /");
    for (int i = 0; i < count; ++i) {
        const double time = median(&rows[i], NULL) - (i == 1 ? 0 : loop);
        printf("    %-50s %9.3f %9.2f %9.2f\n", rows[i].label, time, time * hertz * 1e-9,
               first / time);
    }
}

int main(int count, char **arguments) {
    if (count > 2 || (count == 2 && strcmp(arguments[1], "quick") != 0)) {
        fputs("usage: bench_kernels [quick]\n", stderr);
        return EXIT_FAILURE;
    }
    if (count == 2) {
        rounds = 5;
        round_seconds = 0.1e-3;
    }
    make_input();
    printf("gcc or clang %s; medians of %d rounds, taking turns\n", __VERSION__, rounds);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_kernels *kernels = burnish_kernels_for((burnish_isa)isa);
        if (kernels) {
            printf("\n%s\n", burnish_isa_name((burnish_isa)isa));
            time_lobes(kernels);
            time_shading(kernels, "whole lighting, directional light, distant viewer", 0);
            time_shading(kernels, "whole lighting, point light, local viewer", 1);
        }
    }
    const double hertz = counter_hertz();
    printf("\nscalar code, one value at a time\n");
    time_scalars("the paper's forms: latency", 1, hertz);
    time_scalars("the paper's forms: throughput", 0, hertz);
    return EXIT_SUCCESS;
}
