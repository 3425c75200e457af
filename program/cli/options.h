/* One description of a command's flags: the parser, the help screen and the man page read it. */
#ifndef TOOL_CLI_OPTIONS_H
#define TOOL_CLI_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"

/* X(code, text) of every exit code that is no burnish_status. */
#define CLI_EXIT_LIST(X)                                                                           \
    X(1, "ended by a crash or the sandbox")                                                        \
    X(8, "a blank picture")                                                                        \
    X(10, "pictures differ")                                                                       \
    X(11, "some inputs failed")

enum { CLI_EXIT_BLANK = 8, CLI_EXIT_DIFFERENT = 10, CLI_EXIT_SOME_FAILED = 11 };

/* Longest name of a flag or command, without dashes. */
#define CLI_NAME_MAX 48

/* A name that stands for a number; lists end with a NULL name. */
typedef struct cli_word {
    const char *name;
    int value;
} cli_word;

typedef struct cli_flag cli_flag;

/* Reads text (NULL for a switch, and where an optional value is not there) into *target. Messages
 * begin with the flag's name. */
typedef burnish_status cli_handler(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error);

/* One flag. Texts for the man page mark bold as *so* and italics as _so_. */
struct cli_flag {
    const char *group;         /* heading that starts here; NULL: the group goes on */
    const char *topic;         /* with group: --help=TOPIC shows it whole; NULL: no topics */
    const char *name;          /* without dashes */
    char letter;               /* short form; 0: none */
    int common;                /* 1: on the first screen of a command with topics */
    const char *value;         /* what stands for the value in help; NULL: a switch */
    int optional;              /* 1: without =VALUE the handler gets NULL */
    const char *help;          /* text of the help row; the names of `words` follow it */
    const char *default_text;  /* default as the handler reads it; NULL: none */
    const char *default_label; /* default in words, where the text is NULL or unclear */
    const char *manual;        /* text of the man page */
    const char *aliases;       /* what other programs call it, between commas: for hints only */
    cli_handler *handler;
    size_t offset;         /* of the target in the command's settings */
    double low, high;      /* range of a number */
    const cli_word *words; /* the names that the value may be */
    int takes_file;        /* 1: shells complete the value with names of files */
};

/* Fields of a row that every flag has, those of a switch, and the range of a number. The table's
 * file defines TARGET(member) as .offset = offsetof(its settings, member). */
#define CLI_FLAG(flag, form, text, handled_by, member)                                             \
    .name = flag, .value = form, .help = text, .handler = handled_by, TARGET(member)
#define CLI_SWITCH(flag, text, member) CLI_FLAG(flag, NULL, text, cli_flag_switch, member)
#define CLI_RANGE(least, most) .low = least, .high = most

/* One example; also run by the tests. */
typedef struct cli_example {
    const char *command, *what;
} cli_example;

/* What a section of the man page explains: a word and what it means, marked as above. */
typedef struct cli_term {
    const char *tag, *text;
} cli_term;

typedef void cli_take_term(const char *tag, const char *text);

/* A section of the man page that a command brings along. */
typedef struct cli_section {
    const char *heading, *text;
    const cli_term *terms;                   /* the last has a NULL tag; NULL: none */
    void (*each_term)(cli_take_term *print); /* gives terms that are made from a table; or NULL */
    const char *closing;                     /* NULL: none */
} cli_section;

/* A flag and its value, which may be NULL; or, where flag is NULL, an operand. */
typedef struct cli_argument {
    const cli_flag *flag;
    const char *text;
} cli_argument;

/* One call of a command: what parsing leaves besides the settings. */
typedef struct cli_call {
    const char *operands[2]; /* the first ones */
    size_t operand_count;
    cli_argument *arguments; /* receives all in their order, has room for argc; NULL: not wanted */
    size_t argument_count;
    int help;          /* 1: --help was met; the rest is not parsed */
    const char *topic; /* of --help=TOPIC; NULL: none */
    int exit_code;     /* set by the work where success is not 0 */
} cli_call;

/* Which flags of a command were given, by their index. */
typedef struct cli_given {
    uint64_t bits[2];
} cli_given;

/* The work of a command; settings are as the flags left them. */
typedef burnish_status cli_work(void *settings, cli_call *call, burnish_error *error);

typedef struct cli_command cli_command;

/* One subcommand, or a command that consists of such. */
struct cli_command {
    const char *name;         /* as typed: "render", "lobe table" */
    int alone;                /* 1: a program of its own, so no "burnish" stands before the name */
    const char *operand;      /* what stands for the operand; "" when there is none */
    const char *summary;      /* one line */
    const char *operand_help; /* one line for the help screen */
    const char *manual;       /* paragraphs of the man page, separated by newlines */
    size_t operands_max;
    const cli_flag *flags;
    size_t flag_count;
    const cli_command *base; /* one whose flags it takes too, its settings beginning with that
                                one's; or NULL */
    const char *base_topics; /* which: those of these topics, between commas ... */
    const char *base_flags; /* ... and these; a flag of its own comes before one of the same name */
    const cli_example *examples;     /* the last has a NULL command; may be NULL */
    const cli_section *sections;     /* the last has a NULL heading; may be NULL */
    const cli_command *const *parts; /* its subcommands, NULL ends them; or NULL */
    size_t settings_size;            /* bytes, zero before the defaults of the flags */
    size_t given;                    /* where the settings have a cli_given, for at most 128 flags;
                                        0: nowhere */
    cli_work *work;
};

/* Whether a flag that the command has was given; settings are its own, or begin with them. */
int cli_is_given(const cli_command *command, const void *settings, const char *name);

/* The flags of a command, its own first and then its base's; NULL past the last. */
const cli_flag *cli_flag_at(const cli_command *command, size_t index);

/* "burnish lobe table" */
typedef struct cli_command_name {
    char text[64];
} cli_command_name;
cli_command_name cli_full_name(const cli_command *command);

/* Writes one line, control characters replaced, and returns status. */
__attribute__((format(printf, 3, 4))) burnish_status
cli_fail(burnish_error *error, burnish_status status, const char *format, ...);

/* Replaces control characters by '?', so that a message stays one line. */
void cli_clean(char *text);

/* "burnish: warning: TEXT" on standard error. */
void cli_warn(const char *text);

/* Puts every flag's default into settings. */
burnish_status cli_defaults(const cli_command *command, void *settings, burnish_error *error);

/* Reads the arguments: --x=v, --x v, -o v, -ov, switches, `--` before operands. No abbreviations;
 * of a repeated flag the last counts.
 * call->arguments is set before. An unknown flag is answered with the closest known one. Every
 * command has -h, --help and --help=TOPIC. */
burnish_status cli_parse(const cli_command *command, int argc, char **argv, void *settings,
                         cli_call *call, burnish_error *error);

/* Sets one flag by its name, as cli_parse does for "--name=text"; text NULL: no value. */
burnish_status cli_set(const cli_command *command, const char *name, const char *text,
                       void *settings, burnish_error *error);

/* Name number `index` of a list; NULL past its end. */
typedef const char *cli_name_at(const void *list, size_t index);

/* The name nearest to what was typed, NULL where none is near: few edits, the same letters in
 * another order, or a name that has it inside. */
const char *cli_nearest(const char *typed, cli_name_at *name_at, const void *list);

/* ARGUMENT with one line: of the place where it was typed, the unknown name, and the nearest one
 * or, where none is near, the command that lists them.
 *   where  "lobe plot", "--metrics"
 *   kind   "figure" */
burnish_status cli_fail_unknown(burnish_error *error, const char *where, const char *kind,
                                const char *typed, cli_name_at *name_at, const void *list,
                                const char *lister);

#endif
