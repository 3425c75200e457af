/* The command `burnish render`: what other files use of it. */
#ifndef TOOL_RENDER_FLAGS_H
#define TOOL_RENDER_FLAGS_H

#include "base/cli/options.h"

/* Commands that inherit the flags, for cli_command.heir: a new flag of render is theirs, too, if it
 * acts in one of their phases (cli_command.base_phases) and does not name them in `not_for`. */
enum {
    HEIR_BATCH = 1,
    HEIR_SERVE = 2,
    HEIR_REQUEST = 4, /* of serve-stdio: without the operator's limits and without files */
    HEIR_COMPARE = 8,
    HEIR_SESSION = 16, /* the bindings */
    HEIR_ONE_PICTURE = HEIR_COMPARE | HEIR_SESSION,
    HEIR_ANY = 31
};

/* Sections of the man page. */
extern const cli_section render_sections[];

#endif
