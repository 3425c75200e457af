/* Locks the calling process in: from then on it can compute, read and write descriptors that are
 * open, and nothing else. Importers are built with the same file, so it needs no other part of the
 * program. */
#ifndef TOOL_SANDBOX_LOCK_H
#define TOOL_SANDBOX_LOCK_H

/* 1: this build has seccomp. */
int sandbox_is_built(void);

/* Closes all descriptors from `first` on. Returns 0 or an errno. */
int sandbox_close_descriptors(int first);

/* Locks the calling thread, which has to be the only one; later ones inherit it. In this order:
 *   descriptors    those from `descriptors` on are closed
 *   no_new_privs   and not dumpable: no rights from a program's file, no core file, no debugger
 *   RLIMIT_CORE    0
 *   Landlock       no file can be opened, no TCP port, and nothing outside of the lock signalled,
 *                  as far as the kernel's version of Landlock goes. A kernel without is accepted
 *   RLIMIT_NOFILE  no new descriptors
 *   seccomp        a system call that is not in a list ends the process by SIGSYS
 * Each is tried out, or read back, once it is there.
 *   pretends  1: there are no files, for libraries that look for theirs: opening one fails; 0: it
 *             ends the process
 *   wall      receives the name of the last one
 * Returns 0, or the errno of the wall that can't be built; the process is to end. ENOSYS: this
 * build has no seccomp. */
int sandbox_lock(int descriptors, int pretends, const char **wall);

#endif
