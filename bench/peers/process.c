/* Runs a program, its output discarded, and prints the wall-clock milliseconds from fork to exit
 * and the peak of its resident memory in KiB. Exits with 1 unless the program exits with 0. Usage:
 * bench_peers_process CORES COMMAND...     CORES 1: on one core; else on all
 *
 * A program of its own since it stays small: a child's peak starts from its parent's. */
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* The last core that this process may use: the first ones get most interrupts. */
static void bind_to_one_core(void) {
    cpu_set_t set;
    int last = -1;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) != 0) {
        return;
    }
    for (int i = 0; i < CPU_SETSIZE; ++i) {
        last = CPU_ISSET(i, &set) ? i : last;
    }
    CPU_ZERO(&set);
    CPU_SET(last, &set);
    sched_setaffinity(0, sizeof set, &set);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

int main(int count, char **arguments) {
    struct rusage usage;
    int status;
    if (count < 3) {
        fprintf(stderr, "usage: %s CORES COMMAND...\n", arguments[0]);
        return EXIT_FAILURE;
    }
    const double start = now();
    const pid_t pid = fork();
    if (pid == 0) {
        const int null = open("/dev/null", O_RDWR);
        for (int descriptor = 0; descriptor < 3; ++descriptor) {
            dup2(null, descriptor);
        }
        if (strcmp(arguments[1], "1") == 0) {
            bind_to_one_core();
        }
        execvp(arguments[2], arguments + 2);
        _exit(127);
    }
    if (pid < 0 || wait4(pid, &status, 0, &usage) != pid || status != 0) {
        return EXIT_FAILURE;
    }
    printf("%.6f %ld\n", now() - start, usage.ru_maxrss);
    return EXIT_SUCCESS;
}
