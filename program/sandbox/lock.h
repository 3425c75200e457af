/* Sandboxes the calling process: afterwards it can only compute, and read and write open
 * descriptors. Importers include this file too, so it is independent of the rest of the program. */
#ifndef TOOL_SANDBOX_LOCK_H
#define TOOL_SANDBOX_LOCK_H

/* 1: this build has seccomp. */
int sandbox_is_built(void);

/* Builds the filter of system calls, once in this process and for those that it forks. sandbox_lock
 * does it otherwise; its argument must be the same. Returns 0 or an errno. */
int sandbox_prepare(int pretends);

/* Sandboxes the calling thread, the only one; later threads inherit it. After sandbox_prepare:
 *   descriptors    those from `descriptors` on are closed
 *   no_new_privs   and not dumpable: no rights from a program's file, no core file, no debugger
 *   RLIMIT_CORE    0
 *   Landlock       no opening of files or TCP ports, no signals to other processes, as far as the
 *                  kernel's version supports it. A kernel without Landlock is accepted
 *   RLIMIT_NOFILE  no new descriptors
 *   seccomp        a system call outside a list ends the process with SIGSYS
 * Each step is tested or read back.
 *   pretends  1: opening a file fails, for libraries that search for files; 0: it ends the process
 *   wall      receives the name of the last step
 * Returns 0, or the errno of the step that failed; the process must then exit. ENOSYS: this build
 * has no seccomp. */
int sandbox_lock(int descriptors, int pretends, const char **wall);

#endif
