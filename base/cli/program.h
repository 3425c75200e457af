/* A program as its man page, completions and parser see it. */
#ifndef BASE_CLI_PROGRAM_H
#define BASE_CLI_PROGRAM_H

#include "base/cli/options.h"

typedef struct cli_program {
    const char *name, *summary;         /* of the man page: "burnish", "renders ..." */
    const char *man_date;               /* of the last change to its text */
    const char *usage, *advice;         /* of the first screen; of an empty command line */
    const char *description;            /* paragraphs of the man page */
    const cli_command *const *commands; /* the last ones are cli_help_command and NULL */
    const cli_command *implied;         /* the command of a line that names none; NULL: none */
    const cli_command *options;         /* its flags are the options of the bindings; NULL: none */
    cli_work *implied_work;             /* its work; NULL: the one in its table */
    int (*implies)(const char *first);  /* whether the first argument begins such a line */
    /* Runs the program of a command that has its own. Returns the exit code. */
    int (*start)(const cli_command *command, int argc, char **argv);
    const cli_word *exits;          /* its exit codes that are not from a burnish_status */
    const cli_example *examples;    /* of the first screen; the last has a NULL command */
    const cli_section *values;      /* of the man page: values of several commands */
    const cli_section *environment; /* of the man page */
    const char *see_also;           /* of the man page, in roff */
} cli_program;

/* `help`, which prints screens, the man page and completions of the program that runs. */
extern const cli_command cli_help_command;

/* Runs a program. Returns the exit code. */
int cli_run_program(const cli_program *program, int argc, char **argv);

/* Prints the man page in roff on standard output. */
void cli_print_man(const cli_program *program);

/* The flags of a command as a JSON array; release with free. NULL: out of memory. */
char *cli_describe_flags(const cli_command *command);

/* Prints all commands and flags as JSON on standard output. Errors: MEMORY. */
burnish_status cli_print_json(const cli_program *program, burnish_error *error);

/* Prints completions on standard output, for "bash", "zsh" or "fish". */
void cli_print_completion(const cli_program *program, const char *shell);

#endif
