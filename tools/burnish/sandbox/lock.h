/* Locks the calling process in: from then on it can compute, and read and write descriptors that
 * are open, and nothing else. Importers lock
 * themselves in by the same file, which therefore needs nothing of the program's. */
#ifndef TOOL_SANDBOX_LOCK_H
#define TOOL_SANDBOX_LOCK_H

/* 1: this build has seccomp. */
int sandbox_is_built(void);

/* For the calling thread, which has to be the only one; later ones inherit it. Landlock, where the
 * kernel has it, forbids every file, seccomp every system call but those of a list; a call beyond
 * it ends the process by SIGSYS. No core dumps, no descriptors but those below `descriptors`.
 *   pretends  1: there are no files, for libraries that look for theirs: opening one fails; 0: it
 * is beyond the list Returns 0, or an errno: this kernel can't; ENOSYS where this build can't. */
int sandbox_lock(int descriptors, int pretends);

#endif
