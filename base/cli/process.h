/* Starts processes. Every child ends with its parent and keeps only the descriptors of its plan. On
 * Windows there are cli_run_instead and cli_program_folder alone. */
#ifndef BASE_CLI_PROCESS_H
#define BASE_CLI_PROCESS_H

#include <stddef.h>
#include <sys/types.h>

enum { CLI_SAME = -1, CLI_NOTHING = -2 }; /* the parent's descriptor; /dev/null */

enum { CLI_KEPT_MAX = 8 };

/* What a child keeps. */
typedef struct cli_plan {
    int kept[CLI_KEPT_MAX]; /* what become its descriptors 0, 1, ...: the parent's, or these two */
    int count;              /* of them; all others are closed; 0: all descriptors stay open */
    int ended_by;           /* the signal that ends it when its parent ends */
} cli_plan;

/* As fork, which returns twice: in the child with 0 and the descriptors of the plan. What the parent has
 * printed is flushed before. -1: no process. */
pid_t cli_fork(const cli_plan *plan);

/* Waits for a process that cli_fork started. Returns its wait status. */
int cli_wait(pid_t process);

/* Two connected sockets that no other program inherits. Returns 1, or 0 and sets errno. */
int cli_channel(int ends[2]);

/* In the child: the signals that programs handle have their default effects again, and the program at
 * `path` takes its place. */
__attribute__((noreturn)) void cli_execute(const char *path, const char *const *arguments);

/* Finds an installed program in PATH. Relative folders are skipped: they could belong to the input.
 * Returns 1, or 0 if there is none. */
enum { CLI_PATH_SIZE = 4096 };
int cli_find_program(const char *name, char path[CLI_PATH_SIZE]);

/* Runs another program instead of this one, with words that end with NULL, the first of which is
 * its name. Returns its exit code on Windows; elsewhere it returns only -1, if that fails, and sets
 * errno. */
int cli_run_instead(const char *path, char **words);

#ifdef _WIN32
#define CLI_PROGRAM_EXTENSION ".exe"
#else
#define CLI_PROGRAM_EXTENSION ""
#endif

/* The folder of this program's file, or 0 if it is unknown or longer than that. */
int cli_program_folder(char *folder, size_t size);

/* Writes all bytes, also after interrupted calls. Returns 1, or 0 if writing fails. */
int cli_write_all(int descriptor, const void *bytes, size_t size);

/* A descriptor of an empty unnamed file; -1: failed. */
int cli_unnamed_file(void);

#endif
