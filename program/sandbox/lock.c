#include "sandbox/lock.h"

#include <errno.h>

#if BURNISH_HAS_SECCOMP

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/close_descriptors.h"

int sandbox_is_built(void) {
    return 1;
}

/* ---- Landlock ---- */

/* From linux/landlock.h, which older systems lack. Version 1 of the interface has 13 file rights; 2
 * adds refer, 3 truncate, 4 bind and connect, 5 ioctl, 6 scopes. */
typedef struct landlock_rules {
    uint64_t files, network, scopes;
} landlock_rules;

enum { LANDLOCK_CREATE = 444, LANDLOCK_RESTRICT = 446, LANDLOCK_VERSION = 1 };

/* Drops every right that the kernel's version supports. Returns 0 or an errno; also 0 if the kernel
 * has no Landlock, since seccomp then protects alone. */
static int forbid_files(void) {
    const long version = syscall(LANDLOCK_CREATE, NULL, 0, LANDLOCK_VERSION);
    if (version < 0) {
        return errno == ENOSYS || errno == EOPNOTSUPP ? 0 : errno;
    }
    const landlock_rules rules = {.files = (1U << (version >= 5   ? 16
                                                   : version >= 3 ? 15
                                                   : version == 2 ? 14
                                                                  : 13)) -
                                           1,
                                  .network = version >= 4 ? 3 : 0,
                                  .scopes = version >= 6 ? 3 : 0};
    const size_t size = version >= 6 ? sizeof rules : version >= 4 ? 16 : 8;
    const int file = (int)syscall(LANDLOCK_CREATE, &rules, size, 0);
    if (file < 0) {
        return errno;
    }
    const int code = syscall(LANDLOCK_RESTRICT, file, 0) == 0 ? 0 : errno;
    close(file);
    if (code != 0) {
        return code;
    }
    const int root = open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return root < 0 && errno == EACCES ? 0 : ENOTSUP;
}

/* ---- seccomp ---- */

/* The filter as instructions, which processes that are forked later only have to load. */
static struct sock_filter instructions[512];
static size_t instruction_count;              /* 0: not built */
static const scmp_datum_t OWN_ID = INT32_MAX; /* replaced with the number of the process */

/* System calls that drawing needs after all files are open. */
static const char allowed[] =
    "read pread64 write readv writev close fstat lseek munmap mremap madvise brk futex rseq "
    "set_robust_list rt_sigprocmask rt_sigreturn sigaltstack clock_gettime clock_nanosleep "
    "gettimeofday nanosleep getpid gettid exit exit_group sched_getaffinity sched_yield "
    "restart_syscall getrandom poll ppoll getrusage membarrier sysinfo rt_sigaction _llseek "
    "clock_gettime64 futex_time64 ppoll_time64 clock_nanosleep_time64";

/* Allows a call if its argument matches. Calls that this processor lacks are ignored. */
static int allow_where(scmp_filter_ctx filter, const char *name, struct scmp_arg_cmp argument) {
    const int number = seccomp_syscall_resolve_name(name);
    return number == __NR_SCMP_ERROR
               ? 0
               : seccomp_rule_add(filter, SCMP_ACT_ALLOW, number, 1, argument);
}

/* Adds calls without regard to their arguments. */
static int add_calls(scmp_filter_ctx filter, uint32_t action, const char *names) {
    char name[32];
    int code = 0, length;
    for (; code == 0 && sscanf(names, "%31s%n", name, &length) == 1; names += length) {
        const int number = seccomp_syscall_resolve_name(name);
        code = number == __NR_SCMP_ERROR ? 0 : seccomp_rule_add(filter, action, number, 0);
    }
    return code;
}

static int filter_fill(scmp_filter_ctx filter) {
    const scmp_datum_t execute = PROT_EXEC, thread = 0x00010100; /* CLONE_THREAD | CLONE_VM */
    int code = add_calls(filter, SCMP_ACT_ALLOW, allowed);
    /* no executable memory; threads but no processes; limits can be read, not set */
    code = code ? code : allow_where(filter, "mmap", SCMP_A2(SCMP_CMP_MASKED_EQ, execute, 0));
    code = code ? code : allow_where(filter, "mmap2", SCMP_A2(SCMP_CMP_MASKED_EQ, execute, 0));
    code = code ? code : allow_where(filter, "mprotect", SCMP_A2(SCMP_CMP_MASKED_EQ, execute, 0));
    code = code ? code : allow_where(filter, "clone", SCMP_A0(SCMP_CMP_MASKED_EQ, thread, thread));
    code = code ? code : allow_where(filter, "prlimit64", SCMP_A2(SCMP_CMP_EQ, 0, 0));
    code = code ? code : allow_where(filter, "tgkill", SCMP_A0(SCMP_CMP_EQ, OWN_ID));
    /* whether a descriptor is a terminal; the C library falls back from clone3 to clone, whose
     * flags a filter can see */
    code = code ? code : allow_where(filter, "ioctl", SCMP_A1(SCMP_CMP_EQ, TCGETS, 0));
    /* the C library's fstat passes a path, which a filter can't read; callers avoid it */
    code = code ? code : add_calls(filter, SCMP_ACT_ERRNO(EPERM), "newfstatat statx");
    return code ? code : add_calls(filter, SCMP_ACT_ERRNO(ENOSYS), "clone3");
}

int sandbox_prepare(int pretends) {
    if (instruction_count > 0) {
        return 0;
    }
    scmp_filter_ctx filter = seccomp_init(SCMP_ACT_KILL_PROCESS);
    int ends[2], code = filter ? filter_fill(filter) : -ENOMEM;
    if (code == 0 && pretends) { /* calls that look for files or describe the system only fail */
        code = add_calls(filter, SCMP_ACT_ERRNO(ENOENT),
                         "open openat access faccessat faccessat2 stat lstat statfs readlink "
                         "readlinkat uname getcwd times");
    }
    code = code ? code : pipe(ends) == 0 ? 0 : -errno;
    if (code == 0) {
        code = seccomp_export_bpf(filter, ends[1]);
        close(ends[1]);
        const ssize_t size = code == 0 ? read(ends[0], instructions, sizeof instructions) : 0;
        close(ends[0]);
        if (size > 0 && (size_t)size < sizeof instructions) {
            instruction_count = (size_t)size / sizeof *instructions;
        }
    }
    seccomp_release(filter);
    return instruction_count > 0 ? 0 : code != 0 ? -code : E2BIG;
}

static int forbid_calls(void) {
    for (size_t i = 0; i < instruction_count; ++i) {
        if (instructions[i].code == (BPF_JMP | BPF_JEQ | BPF_K) && instructions[i].k == OWN_ID) {
            instructions[i].k = (uint32_t)getpid(); /* without it, abort ends by SIGSYS */
        }
    }
    const struct sock_fprog filter = {(unsigned short)instruction_count, instructions};
    if (syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, 0, &filter) != 0) {
        return errno;
    }
    const long allowed_call = syscall(SYS_statx, -1, NULL, 0, 0, NULL); /* of no file */
    return allowed_call < 0 && errno == EPERM ? 0 : ENOTSUP;
}

/* ---- The process itself ---- */

/* No setuid programs, no core files and no debuggers. */
static int forbid_rights(void) {
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0) {
        return errno;
    }
    return prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) == 1 && prctl(PR_GET_DUMPABLE, 0, 0, 0, 0) == 0
               ? 0
               : ENOTSUP;
}

static int forbid_more(int what, rlim_t most) {
    const struct rlimit limit = {most, most};
    return setrlimit(what, &limit) == 0 ? 0 : errno;
}

int sandbox_lock(int descriptors, int pretends, const char **wall) {
    *wall = "seccomp";
    int code = sandbox_prepare(pretends);
    code = code ? code : (*wall = "descriptors", burnish_close_descriptors(descriptors));
    code = code ? code : (*wall = "no_new_privs", forbid_rights());
    code = code ? code : (*wall = "RLIMIT_CORE", forbid_more(RLIMIT_CORE, 0));
    code = code ? code : (*wall = "Landlock", forbid_files()); /* takes a descriptor */
    code = code ? code : (*wall = "RLIMIT_NOFILE", forbid_more(RLIMIT_NOFILE, (rlim_t)descriptors));
    code = code ? code : (*wall = "seccomp", forbid_calls()); /* ends the process at those above */
    return code;
}

#else

int sandbox_is_built(void) {
    return 0;
}

int sandbox_prepare(int pretends) {
    (void)pretends;
    return ENOSYS;
}

int sandbox_lock(int descriptors, int pretends, const char **wall) {
    (void)descriptors;
    *wall = "seccomp";
    return sandbox_prepare(pretends);
}

#endif
