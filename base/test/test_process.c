/* Processes: what a child keeps of its parent, and when it ends. */
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "base/close_descriptors.h"
#include "support.h"

enum { HIGH = 300 }; /* a descriptor above what closing 3 to 255 would reach */

/* The exit code of a child: bit i is set if its descriptor i is open, bit 6 for HIGH. */
static int open_in_child(const cli_plan *plan) {
    const pid_t child = cli_fork(plan);
    if (child == 0) {
        int open_ones = 0;
        for (int i = 0; i < 6; ++i) {
            open_ones |= (fcntl(i, F_GETFD) >= 0) << i;
        }
        _exit(open_ones | (fcntl(HIGH, F_GETFD) >= 0) << 6);
    }
    const int state = cli_wait(child);
    return WIFEXITED(state) ? WEXITSTATUS(state) : -1;
}

/* Descriptors that are not kept are closed, however high they are. */
static void test_closed(void) {
    int ends[2];
    if (CHECK1(cli_channel(ends)) && CHECK1(dup2(ends[0], HIGH) == HIGH)) {
        const cli_plan all = {.ended_by = SIGKILL};
        const cli_plan four = {{CLI_SAME, CLI_NOTHING, CLI_SAME, ends[1]}, 4, SIGKILL};
        const cli_plan none = {{CLI_NOTHING}, 1, SIGKILL};
        CHECK1((open_in_child(&all) >> 6 & 1) == 1);
        CHECK1(open_in_child(&four) == 0xF);
        CHECK1(open_in_child(&none) == 1);
        close(ends[0]), close(ends[1]), close(HIGH);
    }
}

/* Kept descriptors arrive in their order, also if their numbers in the parent are each other's. */
static void test_order(void) {
    int a[2], b[2];
    char got[2] = "";
    if (!CHECK1(cli_channel(a)) || !CHECK1(cli_channel(b))) {
        return;
    }
    const int from_a = fcntl(a[0], F_DUPFD, 20), from_b = fcntl(b[0], F_DUPFD, 20);
    const int to_a = fcntl(a[1], F_DUPFD, 20), to_b = fcntl(b[1], F_DUPFD, 20);
    CHECK1(dup2(to_a, 3) == 3 && dup2(to_b, 4) == 4);
    const cli_plan swapped = {{CLI_NOTHING, CLI_NOTHING, CLI_NOTHING, 4, 3}, 5, SIGKILL};
    const pid_t child = cli_fork(&swapped);
    if (child == 0) {
        _exit(cli_write_all(3, "b", 1) && cli_write_all(4, "a", 1) ? 0 : 1);
    }
    CHECK1(child > 0 && cli_wait(child) == 0);
    CHECK1(read(from_a, got, 1) == 1 && read(from_b, got + 1, 1) == 1 && memcmp(got, "ab", 2) == 0);
    burnish_close_descriptors(3);
}

/* A child ends with its parent: the end of the pipe that it holds is closed. */
static void test_orphan(void) {
    int ends[2];
    char byte;
    if (!CHECK1(pipe(ends) == 0)) {
        return;
    }
    const cli_plan plan = {{CLI_SAME, CLI_SAME, CLI_SAME, ends[1]}, 4, SIGKILL};
    const pid_t parent = cli_fork(&plan);
    if (parent == 0) {
        const cli_plan same = {.ended_by = SIGKILL};
        const int runs = cli_fork(&same) != 0 || cli_write_all(3, "", 1);
        while (runs) {
            pause();
        }
        _exit(1);
    }
    close(ends[1]);
    CHECK1(read(ends[0], &byte, 1) == 1);
    kill(parent, SIGKILL);
    cli_wait(parent);
    CHECK1(read(ends[0], &byte, 1) == 0); /* hangs if the grandchild lives */
    close(ends[0]);
}

/* PATH is searched in order; relative folders are not. */
static void test_find(void) {
    char path[CLI_PATH_SIZE];
    setenv("PATH", "bin:.::/nowhere:/bin:/usr/bin", 1);
    CHECK1(cli_find_program("sh", path) && strcmp(path, "/bin/sh") == 0);
    CHECK1(!cli_find_program("no-such-program", path));
    setenv("PATH", "", 1);
    CHECK1(!cli_find_program("sh", path));
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    alarm(60); /* ends a test that would hang */
    RUN(test_closed());
    RUN(test_order());
    RUN(test_orphan());
    RUN(test_find());
    return test_end("process");
}
