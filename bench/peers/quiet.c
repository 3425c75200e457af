/* Idle time from /proc/stat. */
#include "quiet.h"

#include <stdio.h>
#include <unistd.h>

/* Ticks of all processors since the start: idle ones and all. Returns 0 if unknown. */
static int read_ticks(double *idle, double *all) {
    FILE *file = fopen("/proc/stat", "r");
    double ticks[8] = {0};
    int read = 0;
    if (file) {
        /* user nice system idle iowait irq softirq steal */
        read = fscanf(file, "cpu %lf %lf %lf %lf %lf %lf %lf %lf", &ticks[0], &ticks[1], &ticks[2],
                      &ticks[3], &ticks[4], &ticks[5], &ticks[6], &ticks[7]);
        fclose(file);
    }
    *idle = ticks[3] + ticks[4];
    *all = 0;
    for (int i = 0; i < 8; ++i) {
        *all += ticks[i];
    }
    return read == 8;
}

int burnish_peers_wait_until_quiet(double *budget) {
    const double pause = 0.1, enough = 0.85; /* one tick of a core is a tenth of the pause */
    for (;;) {
        double idle[2], all[2];
        if (!read_ticks(&idle[0], &all[0])) {
            return 1;
        }
        usleep((useconds_t)(pause * 1e6));
        if (!read_ticks(&idle[1], &all[1]) || idle[1] - idle[0] >= enough * (all[1] - all[0])) {
            return 1;
        }
        if (*budget <= 0) {
            return 0;
        }
        *budget -= pause;
    }
}
