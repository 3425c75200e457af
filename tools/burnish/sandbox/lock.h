/* Locks the calling process in: from then on it can compute, and read and write descriptors that
 * are open, and nothing else. */
#ifndef TOOL_SANDBOX_LOCK_H
#define TOOL_SANDBOX_LOCK_H

#include "burnish/core.h"

/* 1: this build has seccomp. */
int sandbox_is_built(void);

/* For the calling thread, which has to be the only one; later ones inherit it. Landlock, where the
 * kernel has it, forbids every file, seccomp every system call but those of a list; a call beyond
 * it ends the process by SIGSYS. No core dumps, no descriptors but those below `descriptors`.
 * Errors: ARGUMENT (this build or kernel can't). */
burnish_status sandbox_lock(int descriptors, burnish_error *error);

#endif
