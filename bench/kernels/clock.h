/* Timing of contenders that take turns. */
#ifndef BURNISH_BENCH_KERNELS_CLOCK_H
#define BURNISH_BENCH_KERNELS_CLOCK_H

#include <stddef.h>

enum { BURNISH_BENCH_ROUNDS_MAX = 101 };

/* One contender: run(context) handles `items` elements. */
typedef struct burnish_bench_job {
    void (*run)(const void *context);
    const void *context;
    double items;
    size_t repetitions;                           /* found by calibration */
    double nanoseconds[BURNISH_BENCH_ROUNDS_MAX]; /* per element, one for each round */
} burnish_bench_job;

/* Seconds since an arbitrary moment. */
double burnish_bench_now(void);

/* Finds repetitions that take about `seconds` each, then lets the jobs take turns. */
void burnish_bench_take_turns(burnish_bench_job *jobs, int count, int rounds, double seconds);

/* Median of an element's time, and of its ratio to another job's in the same round. */
double burnish_bench_median(const burnish_bench_job *job, int rounds);
double burnish_bench_median_ratio(const burnish_bench_job *job, const burnish_bench_job *to,
                                  int rounds);

/* Hertz of the time-stamp counter, measured over some milliseconds; 0 if the machine lacks one. */
double burnish_bench_tsc_hertz(void);

#endif
