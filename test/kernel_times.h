/* The times of every variant, for test_kernels --bench; part of test_kernels.c, whose inputs it
 * uses. */
#include <time.h>

static double nanoseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

enum { BENCH_POINTS = 2048, BENCH_CALLS = 200, BENCH_ROUNDS = 11 };

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Nanoseconds a point: the median of some rounds. */
static double time_variant(const burnish_kernels *batch, burnish_lobe_kind kind, int shading) {
    static point_arrays arrays;
    static float cosines[BENCH_POINTS], values[BENCH_POINTS];
    static uint8_t pixels[4 * BENCH_POINTS];
    double times[BENCH_ROUNDS];
    uint64_t state = 3;
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_kernels_shader *shader;
    lighting.lobe = make(kind, 2, 32).spec;
    burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
    make_points(&arrays, BENCH_POINTS, 1, &state);
    for (int i = 0; i < BENCH_POINTS; ++i) {
        cosines[i] = test_uniform_float(&state, 0.1f, 1);
    }
    burnish_kernels_points points = points_at(&arrays, 0, 0, 0);
    for (int round = 0; round < BENCH_ROUNDS; ++round) {
        double start = nanoseconds();
        for (int call = 0; call < BENCH_CALLS; ++call) {
            if (shading) {
                burnish_kernels_shade_rgba8(batch, shader, &points, BENCH_POINTS, pixels, NULL);
            } else {
                burnish_kernels_lobe_of_cosines(batch, &lighting.lobe, 32, BENCH_POINTS, cosines,
                                                values, NULL);
            }
        }
        times[round] = (nanoseconds() - start) / ((double)BENCH_CALLS * BENCH_POINTS);
    }
    burnish_kernels_shader_destroy(shader);
    qsort(times, BENCH_ROUNDS, sizeof *times, compare_doubles);
    return times[BENCH_ROUNDS / 2];
}

static void print_times(void) {
    static const char *const names[] = {"family:2", "power",    "whole power", "schlick",
                                        "gaussian", "gamecube", "lyon:2"};
    printf("\n%-12s %-8s %10s %10s   ns a point\n", "lobe", "isa", "lobe", "lighting");
    for (int k = 0; k < KIND_COUNT; ++k) {
        for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
            const burnish_kernels *batch = burnish_kernels_for((burnish_isa)isa);
            if (batch) {
                printf("%-12s %-8s %10.3f %10.3f\n", names[k], burnish_isa_name((burnish_isa)isa),
                       time_variant(batch, KINDS[k], 0), time_variant(batch, KINDS[k], 1));
            }
        }
    }
}
