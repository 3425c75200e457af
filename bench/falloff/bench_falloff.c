/* Times e^-x of burnish_exp_falloff3 ... next to exp: arrays with SIMD, and the shaders on a Vulkan
 * device. Usage: bench_falloff FOLDER_OF_SPIRV [ROUNDS]
 *
 * Rows take turns as in bench_kernels. Printed are the median time of one value and the median over
 * the rounds of its ratio to exp's, loops included. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "burnish/lobe.h"
#include "lobe/test/shaders/vulkan.h"

enum { POINTS = 4096, REPETITIONS = 500, INVOCATIONS = 1 << 17, SUMMED = 256, ROUNDS_MAX = 99 };

static float xs[POINTS], values[POINTS];

/* As in falloff_time.comp. */
static inline float exp_by_bits(float x) {
    float t = -1.44269504f * x;
    t = t > -126.0f ? t : -126.0f;
    const float whole = floorf(t), f = t - whole;
    float p = 1.0f + f * (0.69542435f + f * (0.22630768f + f * 0.07826797f));
    int32_t bits;
    memcpy(&bits, &p, sizeof bits);
    bits += (int32_t)whole * (1 << 23);
    memcpy(&p, &bits, sizeof p);
    return p;
}

#define LOOP(name, value)                                                                          \
    static void name(void) {                                                                       \
        for (int i = 0; i < POINTS; ++i) {                                                         \
            const float x = xs[i];                                                                 \
            values[i] = (value);                                                                   \
        }                                                                                          \
        __asm__ volatile("" ::"r"(values) : "memory");                                             \
    }
LOOP(run_exp, expf(-x))
LOOP(run_bits, exp_by_bits(x))
LOOP(run_3, burnish_exp_falloff3(x))
LOOP(run_4, burnish_exp_falloff4(x))
LOOP(run_5, burnish_exp_falloff5(x))

static const struct {
    const char *label, *shader;
    void (*run)(void);
} ROWS[] = {{"exp", "exp", run_exp},
            {"exp by bits and a cubic", "bits", run_bits},
            {"burnish_exp_falloff3", "3", run_3},
            {"burnish_exp_falloff4", "4", run_4},
            {"burnish_exp_falloff5", "5", run_5}};
enum { ROW_COUNT = sizeof ROWS / sizeof *ROWS };

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static int compare_doubles(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *sorted, int count) {
    qsort(sorted, (size_t)count, sizeof *sorted, compare_doubles);
    return sorted[count / 2];
}

static void print_rows(const char *title, double times[ROW_COUNT][ROUNDS_MAX], int rounds) {
    double ratios[ROW_COUNT][ROUNDS_MAX];
    for (int row = 0; row < ROW_COUNT; ++row) {
        for (int round = 0; round < rounds; ++round) {
            ratios[row][round] = times[row][round] / times[0][round];
        }
    }
    printf("%-52s %9s %9s\n", title, "ns", "x exp");
    for (int row = 0; row < ROW_COUNT; ++row) {
        printf("  %-50s %9.4f %9.2f\n", ROWS[row].label, median(times[row], rounds),
               median(ratios[row], rounds));
    }
}

static void time_arrays(int rounds) {
    double times[ROW_COUNT][ROUNDS_MAX];
    for (int i = 0; i < POINTS; ++i) {
        xs[i] = (float)i * (8.0f / POINTS);
    }
    for (int round = 0; round < rounds; ++round) {
        for (int row = 0; row < ROW_COUNT; ++row) {
            const double start = now();
            for (int i = 0; i < REPETITIONS; ++i) {
                ROWS[row].run();
            }
            times[row][round] = (now() - start) / ((double)REPETITIONS * POINTS);
        }
    }
    print_rows("arrays of 4,096 floats from 0 to 8, one thread", times, rounds);
}

static void time_shaders(const char *folder, int rounds) {
    double times[ROW_COUNT][ROUNDS_MAX];
    gpu_device gpu;
    gpu_buffer out;
    gpu_program programs[ROW_COUNT];
    const gpu_buffer *const buffers[] = {&out, &out, &out};
    gpu_open(&gpu);
    gpu_buffer_create(&gpu, INVOCATIONS * sizeof(float), &out);
    for (int row = 0; row < ROW_COUNT; ++row) {
        char path[512];
        snprintf(path, sizeof path, "%s/falloff_%s.spv", folder, ROWS[row].shader);
        gpu_program_create(&gpu, path, &programs[row]);
        gpu_run(&gpu, &programs[row], buffers, NULL, 0, INVOCATIONS);
    }
    for (int round = 0; round < rounds; ++round) {
        for (int row = 0; row < ROW_COUNT; ++row) {
            const double start = now();
            gpu_run(&gpu, &programs[row], buffers, NULL, 0, INVOCATIONS);
            times[row][round] = (now() - start) / ((double)INVOCATIONS * SUMMED);
        }
    }
    print_rows(gpu.name, times, rounds);
    for (int row = 0; row < ROW_COUNT; ++row) {
        gpu_program_destroy(&gpu, &programs[row]);
    }
    gpu_buffer_destroy(&gpu, &out);
    gpu_close(&gpu);
}

int main(int count, char **arguments) {
    const int rounds = count > 2 ? atoi(arguments[2]) : 21;
    if (count < 2 || rounds < 1 || rounds > ROUNDS_MAX) {
        fputs("usage: bench_falloff FOLDER_OF_SPIRV [ROUNDS], at most 99\n", stderr);
        return EXIT_FAILURE;
    }
    time_arrays(rounds);
    time_shaders(arguments[1], rounds);
    return EXIT_SUCCESS;
}
