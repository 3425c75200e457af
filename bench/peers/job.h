/* The picture that every contestant draws: mesh, camera, light and material, the same for all. */
#ifndef BURNISH_BENCH_PEERS_JOB_H
#define BURNISH_BENCH_PEERS_JOB_H

#include "burnish/render.h"

enum { BURNISH_PEERS_WIDTH = 1920, BURNISH_PEERS_HEIGHT = 1080 };

/* How a picture is taken. */
typedef struct burnish_peers_view {
    int width, height, samples, threads;
} burnish_peers_view;

/* One white directional light, a distant viewer, Blinn's cosine, black
 * background; colour = ambient + diffuse max(0, N.L) + specular lobe(N.H) where N.L > 0, in linear
 * light, and back faces culled or lit from their own side. */
typedef struct burnish_peers_job {
    burnish_mesh *scene;
    burnish_render_options options;
    float ambient, diffuse, specular, exponent; /* grey */
    float zeta;                                 /* of energy:2 for that exponent */
    /* for contestants that have their own camera; world space, unit vectors */
    double eye[3], right[3], up[3], forward[3];
    double pixels; /* a length of 1 at distance 1, in pixels */
    double nearest, farthest;
    float light[3], half[3], viewer[3];
} burnish_peers_job;

/* input: bunny, bunny16, or a file. Prints one line and returns 0 on error. */
int burnish_peers_job_open(burnish_peers_job *job, const char *input,
                           const burnish_peers_view *view);
void burnish_peers_job_close(burnish_peers_job *job);

/* The 8-bit sRGB code of a linear value, by IEC 61966-2-1 in double precision. */
uint8_t burnish_peers_srgb(double linear);

/* Milliseconds since some fixed moment: processor time of this process with one thread, which other
 * programs do not affect, else wall time. */
double burnish_peers_now(const burnish_peers_job *job);

#endif
