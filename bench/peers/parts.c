/* Times whole processes: f3d and burnish draw each file to a PNG in turns, on all cores.
 * Usage: bench_peers_parts BURNISH SCRATCH ROUNDS FILE...
 *
 * Prints one line per file and size: the size; milliseconds of f3d, of burnish with f3d's settings
 * (--look=plain --samples=1) and of burnish without flags; the peak memory of each in KiB; the
 * file. Numbers are medians of the rounds, after one that fills the caches. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figures.h"
#include "process.h"
#include "quiet.h"

enum { PATH = 600, PATIENCE = 300 };

static const char *const SIZES[] = {"256,256", "1920,1080"};
enum { F3D, PLAIN, DEFAULT, CONTESTANTS };
static const char *const NAMES[] = {"f3d", "burnish --look=plain", "burnish"};
static const char *const TIMES[] = {"time f3d", "time plain", "time default"};
static const char *const PEAKS[] = {"peak f3d", "peak plain", "peak default"};

typedef struct runner {
    const char *burnish, *scratch, *display;
    int rounds;
    double patience;               /* seconds left to wait for quiet moments */
    burnish_peers_figures figures; /* of one file at one size */
} runner;

static int run_part(runner *r, const char *file, const char *size) {
    char output[PATH];
    snprintf(output, sizeof output, "%s/part.png", r->scratch);
    r->figures.count = 0;
    for (int round = 0; round <= r->rounds; ++round) {
        burnish_peers_wait_until_quiet(&r->patience);
        for (int who = 0; who < CONTESTANTS; ++who) {
            const burnish_peers_picture picture = {file, output, size, who == DEFAULT};
            double milliseconds, kibibytes;
            if (!burnish_peers_draw(&picture, who == F3D ? NULL : r->burnish, 0, r->display,
                                    &milliseconds, &kibibytes)) {
                fprintf(stderr, "bench-peers: %s can't draw %s\n", NAMES[who], file);
                return 0;
            }
            if (round > 0) {
                burnish_peers_add(&r->figures, TIMES[who], milliseconds);
                burnish_peers_add(&r->figures, PEAKS[who], kibibytes);
            }
        }
    }
    printf("%s", size);
    for (int who = 0; who < CONTESTANTS; ++who) {
        printf(" %.2f", burnish_peers_median(&r->figures, TIMES[who]));
    }
    for (int who = 0; who < CONTESTANTS; ++who) {
        printf(" %.0f", burnish_peers_median(&r->figures, PEAKS[who]));
    }
    printf(" %s\n", file);
    fflush(stdout);
    return 1;
}

int main(int count, char **arguments) {
    char display[32] = "";
    runner *r = calloc(1, sizeof *r);
    if (count < 5 || !r) {
        fprintf(stderr, "usage: %s BURNISH SCRATCH ROUNDS FILE...\n", arguments[0]);
        free(r);
        return EXIT_FAILURE;
    }
    r->burnish = arguments[1];
    r->scratch = arguments[2];
    r->display = display;
    r->rounds = atoi(arguments[3]);
    r->patience = r->rounds > 1 ? PATIENCE : 0; /* a single round is a check, not a measurement */
    pid_t x = burnish_peers_installed("f3d") && burnish_peers_installed("Xvfb")
                  ? burnish_peers_start_x(display, sizeof display)
                  : 0;
    int done = x > 0;
    if (!done) {
        fprintf(stderr, "bench-peers: parts need f3d and Xvfb; scripts/install-deps peers\n");
    }
    for (int i = 4; done && i < count; ++i) {
        for (size_t size = 0; done && size < sizeof SIZES / sizeof *SIZES; ++size) {
            done = run_part(r, arguments[i], SIZES[size]);
        }
    }
    if (x > 0) {
        burnish_peers_stop_x(x);
    }
    free(r);
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
