/* Wall time, for reports, progress and limits. */
#ifndef TOOL_CLI_CLOCK_H
#define TOOL_CLI_CLOCK_H

#include <time.h>

/* Seconds on a monotonic clock. */
static inline double cli_seconds_now(void) {
    struct timespec now = {0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
