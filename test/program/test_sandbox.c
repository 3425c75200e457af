/* The sandbox's lock: hostile calls end the program, and the calls of drawing work. Each wall holds
 * without the others, and a wall that can't be built is an error. */
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sandbox/lock.h"
#include "support.h"

/* ---- Systems that lack something ---- */

/* Controls the functions below, by which the linker replaces the system's for lock.c. */
static struct {
    int landlock_version; /* errno of the query; 0: the kernel's result */
    int landlock_create, landlock_restrict, seccomp, limits, rights, close_range; /* their errno */
    int skips_restrict, skips_seccomp; /* 1: reports success and does nothing */
    int pretends_seccomp;              /* 1: and its check finds the filter */
} faults;

long __real_syscall(long number, ...);
long __wrap_syscall(long number, ...);
int __real_setrlimit64(int what, const struct rlimit *limit);
int __wrap_setrlimit64(int what, const struct rlimit *limit);
int __real_prctl(int what, ...);
int __wrap_prctl(int what, ...);

enum { LANDLOCK_CREATE = 444, LANDLOCK_RESTRICT = 446, LANDLOCK_VERSION = 1 };

static int fail(int code) {
    errno = code;
    return -1;
}

long __wrap_syscall(long number, ...) {
    long a[5];
    va_list arguments;
    va_start(arguments, number);
    for (int i = 0; i < 5; ++i) {
        a[i] = va_arg(arguments, long);
    }
    va_end(arguments);
    const int is_version = number == LANDLOCK_CREATE && a[2] == LANDLOCK_VERSION;
    if (is_version && faults.landlock_version) {
        return fail(faults.landlock_version);
    }
    if (number == LANDLOCK_CREATE && !is_version && faults.landlock_create) {
        return fail(faults.landlock_create);
    }
    if (number == LANDLOCK_RESTRICT && faults.landlock_restrict) {
        return fail(faults.landlock_restrict);
    }
    if (number == LANDLOCK_RESTRICT && faults.skips_restrict) {
        return 0;
    }
    if (number == SYS_seccomp && (faults.seccomp || faults.skips_seccomp)) {
        return faults.seccomp ? fail(faults.seccomp) : 0;
    }
    if (number == SYS_close_range && faults.close_range) {
        return fail(faults.close_range);
    }
    return number == SYS_statx && faults.pretends_seccomp
               ? fail(EPERM)
               : __real_syscall(number, a[0], a[1], a[2], a[3], a[4]);
}

int __wrap_setrlimit64(int what, const struct rlimit *limit) {
    return faults.limits ? fail(faults.limits) : __real_setrlimit64(what, limit);
}

int __wrap_prctl(int what, ...) {
    va_list arguments;
    va_start(arguments, what);
    const unsigned long value = va_arg(arguments, unsigned long);
    va_end(arguments);
    return faults.rights ? fail(faults.rights) : __real_prctl(what, value, 0, 0, 0);
}

/* ---- Hostile calls ---- */

enum {
    HELD = 40, /* a descriptor that is open before the lock */
    REFUSED = 255
};

static int descriptors = STDERR_FILENO + 1; /* allowed by the lock */

static char scratch[] = "/tmp/burnish-sandbox-XXXXXX";
static char victim[64], created[64]; /* files in it; the second does not exist */

/* The result of an attempt: 0 if it was allowed, else its errno. */
static void leave(long result) {
    _exit(result >= 0 ? 0 : errno);
}

#define ATTEMPT(name, call)                                                                        \
    static void name(void) {                                                                       \
        leave(call);                                                                               \
    }
ATTEMPT(open_file, open(victim, O_RDONLY | O_CLOEXEC))
ATTEMPT(write_file, open(created, O_WRONLY | O_CREAT | O_CLOEXEC, 0600))
ATTEMPT(remove_file, unlink(victim))
ATTEMPT(open_socket, socket(AF_INET, SOCK_STREAM, 0))
ATTEMPT(start_program, execl("/bin/true", "true", (char *)NULL))
ATTEMPT(start_process, fork())
ATTEMPT(end_parent, kill(getppid(), 0))
ATTEMPT(end_other, syscall(SYS_tgkill, getppid(), getppid(), 0))

static void run_memory(void) {
    mmap(NULL, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

static void make_code(void) {
    void *page = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mprotect(page, 4096, PROT_READ | PROT_EXEC);
}

static void raise_limit(void) {
    const struct { unsigned long now, most; } files = {8, 8};
    syscall(SYS_prlimit64, 0, 7, &files, NULL);
}

static void *try_file(void *context) {
    open(victim, O_RDONLY | O_CLOEXEC);
    return context;
}

static void open_in_thread(void) {
    pthread_t thread;
    if (pthread_create(&thread, NULL, try_file, NULL) == 0) {
        pthread_join(thread, NULL);
    }
}

/* These fail without ending the program, because the C library makes such calls at harmless
 * moments. */
static void ask_state(void) {
    struct stat state;
    _exit(stat("/etc/passwd", &state) != 0 && errno == EPERM ? 0 : 1);
}

/* Without seccomp: an address of this machine on which no process listens. */
static void connect_tcp(void) {
    const struct sockaddr_in to = {
        .sin_family = AF_INET, .sin_port = htons(9), .sin_addr = {htonl(INADDR_LOOPBACK)}};
    leave(connect(STDIN_FILENO, (const struct sockaddr *)&to, sizeof to));
}

static void bind_tcp(void) {
    const struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr = {htonl(INADDR_LOOPBACK)}};
    leave(bind(STDIN_FILENO, (const struct sockaddr *)&at, sizeof at));
}

/* The other walls, which can be checked without seccomp: the number of a missing one. */
static void ask_walls(void) {
    struct rlimit core, files;
    const int is_limited = getrlimit(RLIMIT_CORE, &core) == 0 && core.rlim_max == 0 &&
                           getrlimit(RLIMIT_NOFILE, &files) == 0 &&
                           files.rlim_max == (rlim_t)descriptors;
    while (dup(STDIN_FILENO) >= 0) { /* until there are no more */
    }
    _exit(!is_limited                                   ? 1
          : errno != EMFILE                             ? 2
          : fcntl(HELD, F_GETFD) >= 0 || errno != EBADF ? 3
          : prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) != 1 ? 4
          : prctl(PR_GET_DUMPABLE, 0, 0, 0, 0) != 0     ? 5
                                                        : 0);
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

/* The needs of drawing: memory, threads, standard output. */
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

/* ---- Processes ---- */

/* How a process ends that locks itself in and then makes a call. Its stdin is a socket. */
static int state_of(void (*action)(void), int pretends) {
    int state = -1;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const char *wall;
        for (int i = STDERR_FILENO + 1; i < HELD; ++i) { /* inherited */
            close(i);
        }
        const int nothing = open("/dev/null", O_RDONLY), tcp = socket(AF_INET, SOCK_STREAM, 0);
        if (dup2(tcp, STDIN_FILENO) < 0 || dup2(nothing, HELD) < 0) {
            _exit(REFUSED);
        }
        close(nothing);
        close(tcp);
        const int code = sandbox_lock(descriptors, pretends, &wall);
        if (code != 0) {
            fprintf(stderr, "%s: %s\n", wall, strerror(code));
            _exit(REFUSED);
        }
        action();
        _exit(0);
    }
    waitpid(child, &state, 0);
    return state;
}

typedef struct attempt {
    const char *name;
    void (*action)(void);
} attempt;

static const attempt hostile[] = {
    {"open", open_file},        {"create", write_file},     {"unlink", remove_file},
    {"socket", open_socket},    {"execve", start_program},  {"fork", start_process},
    {"mmap", run_memory},       {"mprotect", make_code},    {"kill", end_parent},
    {"setrlimit", raise_limit}, {"thread", open_in_thread}, {"tgkill", end_other}};

static int ends_by(const attempt *a, int pretends, int number) {
    const int state = state_of(a->action, pretends);
    return CHECK(WIFSIGNALED(state) && WTERMSIG(state) == number, "%s: state %x", a->name,
                 (unsigned)state);
}

static int exits_with(const attempt *a, int pretends, int code) {
    const int state = state_of(a->action, pretends);
    return CHECK(WIFEXITED(state) && WEXITSTATUS(state) == code, "%s: state %x, not exit code %d",
                 a->name, (unsigned)state, code);
}

/* ---- Cases ---- */

static void test_hostile(void) {
    for (size_t i = 0; i < sizeof hostile / sizeof *hostile; ++i) {
        ends_by(&hostile[i], 0, SIGSYS);
    }
}

static void test_harmless(void) {
    static const attempt harmless[] = {{"draw", draw}, {"stat", ask_state}};
    for (size_t i = 0; i < sizeof harmless / sizeof *harmless; ++i) {
        exits_with(&harmless[i], 0, 0);
    }
    ends_by(&(attempt){"abort", abort}, 0, SIGABRT);
}

/* For libraries that look for files: no files exist, and other calls are forbidden as before. */
static void test_pretending(void) {
    for (size_t i = 0; i < sizeof hostile / sizeof *hostile; ++i) {
        const int opens = hostile[i].action == open_file || hostile[i].action == write_file;
        if (opens) {
            exits_with(&hostile[i], 1, ENOENT);
        } else if (hostile[i].action == open_in_thread) {
            exits_with(&hostile[i], 1, 0);
        } else {
            ends_by(&hostile[i], 1, SIGSYS);
        }
    }
    exits_with(&(attempt){"files", find_files}, 1, 0);
}

/* seccomp alone: a kernel without Landlock, or with one that is switched off. */
static void test_without_landlock(int reason) {
    faults.landlock_version = reason;
    test_hostile();
    test_harmless();
    memset(&faults, 0, sizeof faults);
}

/* Landlock alone denies the calls that the kernel's version of it supports, and the other walls
 * exist. */
static void test_without_seccomp(void) {
    const long version = __real_syscall(LANDLOCK_CREATE, NULL, 0, LANDLOCK_VERSION);
    const struct {
        attempt attempt;
        int spare; /* of descriptors */
        int version, code;
    } refused[] = {
        {{"open", open_file}, 1, 1, EACCES},      {{"create", write_file}, 1, 1, EACCES},
        {{"unlink", remove_file}, 0, 1, EACCES},  {{"execve", start_program}, 0, 1, EACCES},
        {{"connect", connect_tcp}, 0, 4, EACCES}, {{"bind", bind_tcp}, 0, 4, EACCES},
        {{"kill", end_parent}, 0, 6, EPERM},      {{"walls", ask_walls}, 0, 0, 0}};
    if (version < 1) {
        printf("sandbox: SKIPPED: Landlock alone, this kernel has none\n");
    }
    faults.skips_seccomp = faults.pretends_seccomp = 1;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
        descriptors += refused[i].spare;
        if (version >= refused[i].version) {
            exits_with(&refused[i].attempt, 0, refused[i].code);
        }
        descriptors -= refused[i].spare;
    }
    faults.close_range = ENOSYS; /* Linux before 5.9 */
    exits_with(&(attempt){"walls, descriptors one by one", ask_walls}, 0, 0);
    memset(&faults, 0, sizeof faults);
}

/* The output of a process that locks itself in: "wall: errno". */
static void test_refusal(const char *wall, int code) {
    int ends[2], state = -1;
    char text[100] = "", wanted[100];
    if (!CHECK1(pipe(ends) == 0)) {
        return;
    }
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        const char *built = "";
        dup2(ends[1], STDERR_FILENO);
        const int reason = sandbox_lock(STDERR_FILENO + 1, 0, &built);
        const int size = snprintf(text, sizeof text, "%s: %d", built, reason);
        _exit(write(STDERR_FILENO, text, (size_t)size) == size ? 0 : 1);
    }
    close(ends[1]);
    const ssize_t size = read(ends[0], text, sizeof text - 1);
    close(ends[0]);
    waitpid(child, &state, 0);
    snprintf(wanted, sizeof wanted, "%s: %d", wall, code);
    CHECK1(size > 0);
    CHECK_TEXT(text, wanted);
    memset(&faults, 0, sizeof faults);
}

/* A wall that the kernel supports and that can't be built, or has no effect. */
static void test_faults(void) {
    faults.rights = EINVAL;
    test_refusal("no_new_privs", EINVAL);
    faults.limits = EPERM;
    test_refusal("RLIMIT_CORE", EPERM);
    faults.seccomp = EPERM;
    test_refusal("seccomp", EPERM);
    faults.skips_seccomp = 1;
    test_refusal("seccomp", ENOTSUP);
    faults.landlock_version = EPERM;
    test_refusal("Landlock", EPERM);
    if (__real_syscall(LANDLOCK_CREATE, NULL, 0, LANDLOCK_VERSION) >= 1) {
        faults.landlock_create = EMFILE;
        test_refusal("Landlock", EMFILE);
        faults.landlock_restrict = E2BIG;
        test_refusal("Landlock", E2BIG);
        faults.skips_restrict = 1;
        test_refusal("Landlock", ENOTSUP);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    if (!CHECK1(mkdtemp(scratch) != NULL)) {
        return test_end("sandbox");
    }
    snprintf(victim, sizeof victim, "%s/victim", scratch);
    snprintf(created, sizeof created, "%s/created", scratch);
    const int file = open(victim, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    CHECK1(file >= 0);
    close(file);
    RUN(test_hostile());
    RUN(test_harmless());
    RUN(test_pretending());
    CHECK1(sandbox_prepare(0) == 0); /* from here on, processes inherit the filter */
    RUN(test_without_landlock(ENOSYS));
    RUN(test_without_landlock(EOPNOTSUPP));
    RUN(test_without_seccomp());
    RUN(test_faults());
    CHECK1(access(created, F_OK) != 0);
    CHECK1(unlink(victim) == 0);
    CHECK1(rmdir(scratch) == 0);
    return test_end("sandbox");
}
