/* Runs a program, its output discarded, and prints the wall-clock milliseconds from fork to exit,
 * the peak of its resident memory in KiB, and the milliseconds of processor time of all its
 * processes. Exits with 1 unless the program exits with 0. Usage: bench_peers_process COMMAND...
 *
 * A program of its own since it stays small: a child's peak starts from its parent's. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

int main(int count, char **arguments) {
    struct rusage usage;
    int status;
    if (count < 2) {
        fprintf(stderr, "usage: %s COMMAND...\n", arguments[0]);
        return EXIT_FAILURE;
    }
    const double start = now();
    const pid_t pid = fork();
    if (pid == 0) {
        const int null = open("/dev/null", O_RDWR);
        for (int descriptor = 0; descriptor < 3; ++descriptor) {
            dup2(null, descriptor);
        }
        execvp(arguments[1], arguments + 1);
        _exit(127);
    }
    if (pid < 0 || wait4(pid, &status, 0, &usage) != pid || status != 0) {
        return EXIT_FAILURE;
    }
    const double passed = now() - start;
    const struct timeval *user = &usage.ru_utime, *system = &usage.ru_stime;
    printf("%.6f %ld %.3f\n", passed, usage.ru_maxrss,
           1e3 * (double)(user->tv_sec + system->tv_sec) +
               1e-3 * (double)(user->tv_usec + system->tv_usec));
    return EXIT_SUCCESS;
}
