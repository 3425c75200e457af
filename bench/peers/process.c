/* fork, exec, pipes, affinity and resource usage. */
#include "process.h"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* The last core that this process may use: the first ones get most interrupts. */
static void bind_to_one_core(void) {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) != 0) {
        return;
    }
    int last = -1;
    for (int i = 0; i < CPU_SETSIZE; ++i) {
        last = CPU_ISSET(i, &set) ? i : last;
    }
    CPU_ZERO(&set);
    CPU_SET(last, &set);
    sched_setaffinity(0, sizeof set, &set);
}

/* In the child: becomes the program, or ends. */
static void become(const char *const arguments[], int cores, const char *environment) {
    char copy[256];
    signal(SIGPIPE, SIG_DFL);
    if (cores == 1) {
        bind_to_one_core();
    }
    if (environment && strlen(environment) < sizeof copy) {
        strcpy(copy, environment);
        putenv(copy);
    }
    execvp(arguments[0], (char *const *)(uintptr_t)arguments);
    _exit(127);
}

int burnish_peers_start(burnish_peers_process *process, const char *const arguments[], int cores,
                        const char *environment) {
    int to[2], from[2];
    if (access(arguments[0], X_OK) != 0 || pipe2(to, O_CLOEXEC) != 0) {
        return 0;
    }
    if (pipe2(from, O_CLOEXEC) != 0) {
        close(to[0]);
        close(to[1]);
        return 0;
    }
    process->pid = fork();
    if (process->pid == 0) {
        dup2(to[0], STDIN_FILENO);
        dup2(from[1], STDOUT_FILENO);
        become(arguments, cores, environment);
    }
    close(to[0]);
    close(from[1]);
    process->to = fdopen(to[1], "w");
    process->from = fdopen(from[0], "r");
    return process->pid > 0;
}

int burnish_peers_ask(burnish_peers_process *process, const char *line, char *answer, size_t size) {
    if (line) {
        fprintf(process->to, "%s\n", line);
        fflush(process->to);
    }
    if (!fgets(answer, (int)size, process->from)) {
        snprintf(answer, size, "error it ended");
        return 0;
    }
    answer[strcspn(answer, "\n")] = 0;
    return 1;
}

void burnish_peers_stop(burnish_peers_process *process) {
    fclose(process->to);
    fclose(process->from);
    waitpid(process->pid, NULL, 0);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

int burnish_peers_run(const char *const arguments[], int cores, const char *environment,
                      double *milliseconds, double *kibibytes) {
    struct rusage usage;
    int status;
    double start = now();
    pid_t pid = fork();
    if (pid == 0) {
        int null = open("/dev/null", O_RDWR);
        dup2(null, STDIN_FILENO);
        dup2(null, STDOUT_FILENO);
        dup2(null, STDERR_FILENO);
        become(arguments, cores, environment);
    }
    if (pid < 0 || wait4(pid, &status, 0, &usage) != pid) {
        return 0;
    }
    *milliseconds = now() - start;
    *kibibytes = (double)usage.ru_maxrss;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

int burnish_peers_draw(const burnish_peers_picture *picture, const char *burnish, int cores,
                       const char *display, double *milliseconds, double *kibibytes) {
    char resolution[64];
    snprintf(resolution, sizeof resolution, "--resolution=%s", picture->size);
    const char *const f3d[] = {"f3d",      "--dry-run",     "--quiet",  picture->input,
                               "--output", picture->output, resolution, NULL};
    const char *const ours[] = {
        burnish,         "render",   picture->input, "-o",
        picture->output, resolution, "--quiet",      picture->is_default ? NULL : "--samples=1",
        "--look=plain",  NULL};
    usleep(100000);
    return burnish_peers_run(burnish ? ours : f3d, cores, burnish ? NULL : display, milliseconds,
                             kibibytes);
}

pid_t burnish_peers_start_x(char *environment, size_t size) {
    int ready[2];
    char number[16] = "", descriptor[16];
    if (pipe(ready) != 0) {
        return 0;
    }
    snprintf(descriptor, sizeof descriptor, "%d", ready[1]);
    const char *const arguments[] = {"Xvfb",         "-displayfd", descriptor, "-screen", "0",
                                     "1920x1080x24", "-nolisten",  "tcp",      NULL};
    pid_t pid = fork();
    if (pid == 0) {
        int null = open("/dev/null", O_RDWR);
        close(ready[0]);
        dup2(null, STDERR_FILENO);
        become(arguments, 0, NULL);
    }
    close(ready[1]);
    FILE *file = fdopen(ready[0], "r");
    int named = file && fgets(number, sizeof number, file) && number[0] >= '0' && number[0] <= '9';
    if (file) {
        fclose(file);
    }
    if (pid > 0 && !named) {
        burnish_peers_stop_x(pid);
        return 0;
    }
    number[strcspn(number, "\n")] = 0;
    snprintf(environment, size, "DISPLAY=:%s", number);
    return pid;
}

void burnish_peers_stop_x(pid_t pid) {
    kill(pid, SIGTERM);
    waitpid(pid, NULL, 0);
}

int burnish_peers_installed(const char *program) {
    const char *path = getenv("PATH");
    char file[4096];
    while (path && *path) {
        size_t length = strcspn(path, ":");
        int written = snprintf(file, sizeof file, "%.*s/%s", (int)length, path, program);
        if (written > 0 && (size_t)written < sizeof file && access(file, X_OK) == 0) {
            return 1;
        }
        path += length + (path[length] == ':');
    }
    return 0;
}
