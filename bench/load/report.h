/* The line that every loader prints: milliseconds, peak memory in KiB, triangles. */
#ifndef BURNISH_BENCH_LOAD_REPORT_H
#define BURNISH_BENCH_LOAD_REPORT_H

#include <stddef.h>
#include <stdio.h>
#include <sys/resource.h>
#include <time.h>

static inline double load_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e3 * (double)now.tv_sec + 1e-6 * (double)now.tv_nsec;
}

static inline void load_report(double start, size_t triangles) {
    const double milliseconds = load_now() - start;
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("%.3f %ld %zu\n", milliseconds, usage.ru_maxrss, triangles);
}

#endif
