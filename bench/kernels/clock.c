/* Timing of contenders that take turns. */
#include "bench/kernels/clock.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#if defined(__SSE2__)
#include <x86intrin.h>
#endif

double burnish_bench_now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static double time_job(const burnish_bench_job *job, size_t repetitions) {
    double start = burnish_bench_now();
    for (size_t i = 0; i < repetitions; ++i) {
        job->run(job->context);
    }
    return burnish_bench_now() - start;
}

static void calibrate(burnish_bench_job *job, double seconds) {
    size_t repetitions = 1;
    double taken = time_job(job, 1); /* also warms caches */
    if (taken < seconds) {
        taken = time_job(job, 1);
    }
    while (taken < 0.25 * seconds) {
        repetitions *= 2;
        taken = time_job(job, repetitions);
    }
    double wanted = (double)repetitions * seconds / taken;
    job->repetitions = wanted > 1.0 ? (size_t)wanted : 1;
}

void burnish_bench_take_turns(burnish_bench_job *jobs, int count, int rounds, double seconds) {
    for (int i = 0; i < count; ++i) {
        calibrate(&jobs[i], seconds);
    }
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < count; ++i) {
            double taken = time_job(&jobs[i], jobs[i].repetitions);
            double elements = (double)jobs[i].repetitions * jobs[i].items;
            jobs[i].nanoseconds[round] = 1e9 * taken / elements;
        }
    }
}

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count) {
    qsort(values, (size_t)count, sizeof *values, compare_doubles);
    return values[count / 2];
}

double burnish_bench_median(const burnish_bench_job *job, int rounds) {
    double values[BURNISH_BENCH_ROUNDS_MAX];
    memcpy(values, job->nanoseconds, sizeof values);
    return median(values, rounds);
}

double burnish_bench_median_ratio(const burnish_bench_job *job, const burnish_bench_job *to,
                                  int rounds) {
    double values[BURNISH_BENCH_ROUNDS_MAX];
    for (int i = 0; i < rounds; ++i) {
        values[i] = job->nanoseconds[i] / to->nanoseconds[i];
    }
    return median(values, rounds);
}

#if defined(__SSE2__)
double burnish_bench_tsc_hertz(void) {
    double start = burnish_bench_now(), now;
    unsigned long long first = __rdtsc();
    do {
        now = burnish_bench_now();
    } while (now - start < 0.02);
    return (double)(__rdtsc() - first) / (now - start);
}
#else
double burnish_bench_tsc_hertz(void) {
    return 0;
}
#endif
