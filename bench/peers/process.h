/* Programs started and timed from outside. */
#ifndef BURNISH_BENCH_PEERS_PROCESS_H
#define BURNISH_BENCH_PEERS_PROCESS_H

#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

/* A program that answers lines; see worker.h. */
typedef struct burnish_peers_process {
    pid_t pid;
    FILE *to, *from;
} burnish_peers_process;

/* Starts a program with pipes to it. cores: 1 binds it to one core, any other number does not.
 * environment: "NAME=VALUE" added for it, or NULL. Returns 0 if the program is not found. */
int burnish_peers_start(burnish_peers_process *process, const char *const arguments[], int cores,
                        const char *environment);

/* Sends a line unless it is NULL and reads one line, without its end. Returns 0 if the program
 * has ended. */
int burnish_peers_ask(burnish_peers_process *process, const char *line, char *answer, size_t size);

/* Ends its input and waits for it. */
void burnish_peers_stop(burnish_peers_process *process);

/* Runs a program, its output discarded. Measures wall-clock milliseconds from fork to exit and the
 * peak of its resident memory in KiB. Returns 0 unless it exits with 0. */
int burnish_peers_run(const char *const arguments[], int cores, const char *environment,
                      double *milliseconds, double *kibibytes);

typedef struct burnish_peers_picture {
    const char *input, *output; /* mesh and PNG */
    const char *size;           /* "W,H" */
    int is_default;             /* 1: burnish without flags; 0: --look=plain --samples=1, as f3d */
} burnish_peers_picture;

/* Draws with the program burnish, or with f3d if that is NULL, on this X display. f3d takes one
 * sample per pixel, without ambient occlusion. Otherwise as burnish_peers_run; first waits for the
 * X server to clean up, a tenth of a second after f3d. */
int burnish_peers_draw(const burnish_peers_picture *picture, const char *burnish, int cores,
                       const char *display, double *milliseconds, double *kibibytes);

/* Starts Xvfb on a display of its own choice, "DISPLAY=:N" into environment. Returns its process
 * or 0. */
pid_t burnish_peers_start_x(char *environment, size_t size);
void burnish_peers_stop_x(pid_t pid);

/* Whether the search path has a program of this name. */
int burnish_peers_installed(const char *program);

#endif
