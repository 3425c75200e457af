/* Wall time for reports. */
#ifndef BURNISH_BASE_CLOCK_H
#define BURNISH_BASE_CLOCK_H

#include <time.h>

/* Seconds since some moment, never going back. */
static inline double burnish_seconds_now(void) {
    struct timespec now = {0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

#endif
