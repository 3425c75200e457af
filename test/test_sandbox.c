/* The sandbox's lock: what a hostile program tries ends it, what drawing needs goes on. */
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sandbox/lock.h"
#include "support.h"

static void open_file(void) {
    open("/etc/passwd", O_RDONLY | O_CLOEXEC);
}

static void write_file(void) {
    open("/tmp/burnish-hostile", O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
}

static void remove_file(void) {
    unlink("/tmp/burnish-hostile");
}

static void open_socket(void) {
    socket(AF_INET, SOCK_STREAM, 0);
}

static void start_program(void) {
    execl("/bin/true", "true", (char *)NULL);
}

static void start_process(void) {
    fork();
}

static void run_memory(void) {
    mmap(NULL, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

static void make_code(void) {
    void *page = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mprotect(page, 4096, PROT_READ | PROT_EXEC);
}

static void end_parent(void) {
    kill(getppid(), SIGUSR1);
}

static void raise_limit(void) {
    const struct { unsigned long now, most; } files = {8, 8};
    syscall(SYS_prlimit64, 0, 7, &files, NULL);
}

static void *try_file(void *context) {
    open("/etc/passwd", O_RDONLY | O_CLOEXEC);
    return context;
}

static void open_in_thread(void) {
    pthread_t thread;
    if (pthread_create(&thread, NULL, try_file, NULL) == 0) {
        pthread_join(thread, NULL);
    }
}

/* Not what they ask for, and not the end: the C library asks so at harmless moments. */
static void ask_state(void) {
    struct stat state;
    _exit(stat("/etc/passwd", &state) != 0 && errno == EPERM ? 0 : 1);
}

static void find_files(void) {
    _exit(open("/etc/passwd", O_RDONLY | O_CLOEXEC) < 0 && errno == ENOENT && access("/", F_OK) < 0
              ? 0
              : 1);
}

static void *add(void *context) {
    *(int *)context += 1;
    return NULL;
}

/* Memory, threads, standard output: what drawing needs. */
static void draw(void) {
    pthread_t threads[4];
    int sums[4] = {0}, total = 0;
    char *memory = malloc(50 << 20);
    if (!memory) {
        _exit(2);
    }
    memset(memory, 1, 50 << 20);
    for (int i = 0; i < 4; ++i) {
        if (pthread_create(&threads[i], NULL, add, &sums[i]) != 0) {
            _exit(3);
        }
    }
    for (int i = 0; i < 4; ++i) {
        pthread_join(threads[i], NULL);
        total += sums[i];
    }
    free(memory);
    _exit(total == 4 && write(STDOUT_FILENO, "", 0) == 0 ? 0 : 4);
}

/* What becomes of a process that locks itself in and then does something. */
static int state_of(void (*action)(void), int pretends) {
    int state = -1;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const int code = sandbox_lock(STDERR_FILENO + 1, pretends);
        if (code != 0) {
            fprintf(stderr, "%s\n", strerror(code));
            _exit(99);
        }
        action();
        _exit(0);
    }
    waitpid(child, &state, 0);
    return state;
}

int main(int count, char **arguments) {
    static const struct {
        const char *name;
        void (*action)(void);
    } hostile[] = {{"open", open_file},        {"create", write_file},    {"unlink", remove_file},
                   {"socket", open_socket},    {"execve", start_program}, {"fork", start_process},
                   {"mmap", run_memory},       {"mprotect", make_code},   {"kill", end_parent},
                   {"setrlimit", raise_limit}, {"thread", open_in_thread}},
      harmless[] = {{"draw", draw}, {"stat", ask_state}};
    test_begin(count, arguments, NULL);
    if (!sandbox_is_built()) {
        printf("sandbox: SKIPPED: no libseccomp\n");
        CHECK1(sandbox_lock(0, 0) == ENOSYS);
        return test_end("sandbox");
    }
    for (size_t i = 0; i < sizeof hostile / sizeof *hostile; ++i) {
        const int state = state_of(hostile[i].action, 0);
        CHECK(WIFSIGNALED(state) && WTERMSIG(state) == SIGSYS, "%s: state %x", hostile[i].name,
              (unsigned)state);
    }
    for (size_t i = 0; i < sizeof harmless / sizeof *harmless; ++i) {
        const int state = state_of(harmless[i].action, 0);
        CHECK(WIFEXITED(state) && WEXITSTATUS(state) == 0, "%s: state %x", harmless[i].name,
              (unsigned)state);
    }
    /* For libraries that look for files: there are none, and the rest is forbidden as before. */
    for (size_t i = 0; i < sizeof hostile / sizeof *hostile; ++i) {
        const int state = state_of(hostile[i].action, 1);
        const int opens = i < 2 || hostile[i].action == open_in_thread;
        CHECK(opens ? WIFEXITED(state) : WIFSIGNALED(state) && WTERMSIG(state) == SIGSYS,
              "%s: state %x", hostile[i].name, (unsigned)state);
    }
    const int found = state_of(find_files, 1);
    CHECK(WIFEXITED(found) && WEXITSTATUS(found) == 0, "files: state %x", (unsigned)found);
    CHECK1(access("/tmp/burnish-hostile", F_OK) != 0);
    return test_end("sandbox");
}
