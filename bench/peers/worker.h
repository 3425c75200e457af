/* Shared by the contestants: each is a program, started as PROGRAM THREADS, that draws frames on
 * request. It replies to each line of standard input with one line of standard output and ends at the
 * end of its input. After an "error TEXT" the request had no effect.
 *
 *   request                          reply
 *   open WIDTH HEIGHT SAMPLES INPUT  ready TEXT: the contestant, for the report
 *   counts                           ok TRIANGLES DRAWN PIXELS: of burnish's picture
 *   frame VARIANT COUNT              ok MS ...: COUNT frames after one that is not timed
 *   picture VARIANT FILE             ok: 8-bit sRGB, 3 bytes per pixel, rows from the top
 *
 * Files are 1920x1080 pixels. */
#ifndef BURNISH_BENCH_PEERS_WORKER_H
#define BURNISH_BENCH_PEERS_WORKER_H

#include "job.h"

enum {
    BURNISH_PEERS_PIXELS = BURNISH_PEERS_WIDTH * BURNISH_PEERS_HEIGHT,
    BURNISH_PEERS_NOTE = 160 /* bytes of a contestant's description */
};

/* One contestant. Every function returns 0 when it failed or does not know the variant. */
typedef struct burnish_peers_contestant {
    int (*open)(void **state, const burnish_peers_job *job, int threads, char *note);
    int (*frame)(void *state, const char *variant, double *milliseconds);
    int (*picture)(void *state, const char *variant, uint8_t *rgb);
    void (*close)(void *state);
} burnish_peers_contestant;

/* The contestant's main function. */
int burnish_peers_serve(const burnish_peers_contestant *contestant, int count, char **arguments);

#endif
