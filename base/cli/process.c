#include "base/cli/process.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <process.h>
#include <windows.h>

/* In quotes, for the C library that splits the command line again. Never released: the program
 * ends. */
static char *quote(const char *text) {
    char *const quoted = malloc(2 * strlen(text) + 3), *at = quoted;
    size_t slashes = 0;
    if (!quoted) {
        return NULL;
    }
    for (*at++ = '"'; *text; *at++ = *text++) {
        for (slashes += *text == '"'; *text == '"' && slashes > 0; --slashes) {
            *at++ = '\\';
        }
        slashes = *text == '\\' ? slashes + 1 : 0;
    }
    for (; slashes > 0; --slashes) {
        *at++ = '\\';
    }
    memcpy(at, "\"", 2);
    return quoted;
}

int cli_run_instead(const char *path, char **words) {
    for (char **word = words; *word; ++word) {
        *word = quote(*word);
        if (!*word) {
            return -1;
        }
    }
    fflush(NULL);
    return (int)_spawnv(_P_WAIT, path, (const char *const *)words);
}

int cli_program_folder(char *folder, size_t size) {
    const DWORD length = GetModuleFileNameA(NULL, folder, (DWORD)size);
    if (length == 0 || length >= size) {
        return 0;
    }
    char *slash = strrchr(folder, '\\');
    *(slash ? slash : folder) = 0;
    return 1;
}

#else

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

#include "base/close_descriptors.h"

/* Each one moves above all the others first: the parent may have any of them below. */
static int keep_descriptors(const cli_plan *plan) {
    int held[CLI_KEPT_MAX];
    for (int i = 0; i < plan->count; ++i) {
        const int opened = plan->kept[i] == CLI_NOTHING ? open("/dev/null", O_RDWR) : plan->kept[i];
        held[i] = opened < 0 ? CLI_SAME : fcntl(opened, F_DUPFD_CLOEXEC, 2 * CLI_KEPT_MAX);
        if (held[i] < 0 && plan->kept[i] != CLI_SAME) {
            return 0;
        }
    }
    for (int i = 0; i < plan->count; ++i) {
        if (held[i] >= 0 && dup2(held[i], i) < 0) {
            return 0;
        }
    }
    return plan->count == 0 || burnish_close_descriptors(plan->count) == 0;
}

pid_t cli_fork(const cli_plan *plan) {
    const pid_t parent = getpid();
    fflush(NULL);
    const pid_t child = fork();
    if (child != 0) {
        return child;
    }
#ifdef __linux__
    if (prctl(PR_SET_PDEATHSIG, plan->ended_by) != 0) {
        _exit(1);
    }
#endif
    if (getppid() != parent || !keep_descriptors(plan)) {
        _exit(1);
    }
    return 0;
}

int cli_wait(pid_t process) {
    int state = 0;
    while (waitpid(process, &state, 0) < 0 && errno == EINTR) {
    }
    return state;
}

int cli_channel(int ends[2]) {
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) {
        return 0;
    }
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    return 1;
}

void cli_execute(const char *path, const char *const *arguments) {
    static const int handled[] = {SIGPIPE, SIGXFSZ, SIGHUP, SIGINT, SIGTERM, SIGALRM};
    for (size_t i = 0; i < sizeof handled / sizeof *handled; ++i) {
        signal(handled[i], SIG_DFL);
    }
    execv(path, (char *const *)(uintptr_t)arguments);
    _exit(127);
}

int cli_run_instead(const char *path, char **words) {
    fflush(NULL);
    execv(path, words); /* returns only if it fails */
    return -1;
}

int cli_program_folder(char *folder, size_t size) {
    const ssize_t length = readlink("/proc/self/exe", folder, size);
    if (length <= 0 || (size_t)length == size) {
        return 0;
    }
    folder[length] = 0;
    char *slash = strrchr(folder, '/');
    *(slash ? slash : folder) = 0;
    return 1;
}

int cli_find_program(const char *name, char path[CLI_PATH_SIZE]) {
    const char *found = getenv("PATH"), *folder = found ? found : "/usr/local/bin:/usr/bin:/bin";
    while (*folder) {
        const int length = (int)strcspn(folder, ":");
        if (*folder == '/' &&
            snprintf(path, CLI_PATH_SIZE, "%.*s/%s", length, folder, name) < CLI_PATH_SIZE &&
            access(path, X_OK) == 0) {
            return 1;
        }
        folder += length + (folder[length] == ':');
    }
    return 0;
}

int cli_write_all(int descriptor, const void *bytes, size_t size) {
    const char *next = bytes;
    while (size > 0) {
        const ssize_t count = write(descriptor, next, size);
        if (count < 0 && errno != EINTR) {
            return 0;
        }
        next += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return 1;
}

int cli_unnamed_file(void) {
#ifdef __linux__
    return (int)syscall(SYS_memfd_create, "burnish", MFD_CLOEXEC | MFD_ALLOW_SEALING);
#else
    FILE *file = tmpfile(); /* its descriptor stays open until the process ends */
    return file ? dup(fileno(file)) : -1;
#endif
}

#endif
