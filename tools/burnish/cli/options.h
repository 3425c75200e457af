/* One description of a command's flags: the parser, the help screen and the man page read it. */
#ifndef TOOL_CLI_OPTIONS_H
#define TOOL_CLI_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"

/* Longest name of a flag or command, without dashes. */
#define CLI_NAME_MAX 48

/* A name that stands for a number; lists end with a NULL name. */
typedef struct cli_word {
    const char *name;
    int value;
} cli_word;

typedef struct cli_flag cli_flag;

/* Reads text (NULL for a switch) into *target. Messages begin with the flag's name. */
typedef burnish_status cli_handler(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error);

/* One flag. Texts for the man page mark bold as *so* and italics as _so_. */
struct cli_flag {
    const char *group;   /* heading that starts here; NULL: the group goes on */
    const char *name;    /* without dashes */
    char letter;         /* short form; 0: none */
    const char *value;   /* what stands for the value in help; NULL: a switch */
    const char *help;    /* text of the help row; NULL: the flag shares the row above. Where words
                            are given, their names are appended */
    const char *initial; /* default as the handler reads it; NULL: none */
    const char *shown;   /* default in words, where initial is NULL or unclear */
    const char *manual;  /* text of the man page */
    cli_handler *handler;
    size_t offset;         /* of the target in the command's settings */
    double low, high;      /* range of a number */
    const cli_word *words; /* the names that the value may be */
};

/* One example; also run by the tests. */
typedef struct cli_example {
    const char *command, *what;
} cli_example;

typedef struct cli_command cli_command;

/* One subcommand, or a command that consists of such. */
struct cli_command {
    const char *name;         /* as typed: "render", "lobe table" */
    const char *operand;      /* what stands for the operand; "" when there is none */
    const char *summary;      /* one line */
    const char *operand_help; /* one line for the help screen */
    const char *manual;       /* paragraphs of the man page, separated by newlines */
    size_t operands_max;
    const cli_flag *flags;
    size_t flag_count;
    const cli_example *examples;       /* the last has a NULL command; may be NULL */
    const cli_command *const *parts;   /* its subcommands, NULL ends them; or NULL */
    int (*run)(int argc, char **argv); /* argv[0] is the first argument after the command */
};

/* What parsing leaves besides the settings. */
typedef struct cli_operands {
    const char *items[2];
    size_t count;
    int help; /* 1: --help was met; the rest is not parsed */
} cli_operands;

/* Writes one line, control characters replaced, and returns status. */
__attribute__((format(printf, 3, 4))) burnish_status
cli_fail(burnish_error *error, burnish_status status, const char *format, ...);

/* "burnish: TEXT" on standard error; returns the exit code of error's status. */
int cli_report_error(const burnish_error *error);

/* Replaces control characters by '?', so that a message stays one line. */
void cli_clean(char *text);

/* "burnish: warning: TEXT" on standard error. */
void cli_warn(const char *text);

/* Puts every flag's initial text into settings. */
burnish_status cli_defaults(const cli_command *command, void *settings, burnish_error *error);

/* Reads the arguments: --x=v, --x v, -o v, -ov, switches, `--` before operands. No abbreviations;
 * of a repeated flag the last counts. An unknown flag is answered with the closest known one. */
burnish_status cli_parse(const cli_command *command, int argc, char **argv, void *settings,
                         cli_operands *operands, burnish_error *error);

/* 1 when candidate is a better guess at what `name` should have been than *best edits; updates it.
 * A name that stands whole inside a candidate counts as close. Start with CLI_NAME_MAX. */
int cli_closer(const char *name, const char *candidate, size_t *best);

/* 1 when so many edits still make a sensible hint for name. */
int cli_close_enough(const char *name, size_t edits);

#endif
