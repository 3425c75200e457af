/* Describes how a process ended. */
#include "sandbox/process.h"

#ifndef _WIN32

#include <signal.h>
#include <string.h>
#include <sys/wait.h>

#include "base/cli/options.h"

int sandbox_describe_end(int state, burnish_error *line) {
    if (WIFEXITED(state)) {
        return WEXITSTATUS(state);
    }
    const int number = WTERMSIG(state);
    if (number == SIGSYS) {
        cli_fail(line, BURNISH_STATUS_FORMAT,
                 "the sandbox ended the program: it made a system call that drawing does not need; "
                 "report the input, or use --no-sandbox");
    } else if (number == SIGKILL) {
        cli_fail(line, BURNISH_STATUS_MEMORY, "out of memory: the system ended the program");
    } else {
        cli_fail(line, BURNISH_STATUS_FORMAT,
                 "the program ended in its sandbox by signal %d (%s); report the input", number,
                 strsignal(number));
    }
    return number == SIGKILL ? burnish_status_exit_code(BURNISH_STATUS_MEMORY) : 1;
}

#endif
