/* Describes a command's flags for the parser, the help screen and the man page. */
#ifndef BASE_CLI_OPTIONS_H
#define BASE_CLI_OPTIONS_H

#include <errno.h>
#include <stddef.h>
#include <stdint.h>

#include "burnish/core.h"

/* Longest name of a flag or command, without dashes. */
#define CLI_NAME_MAX 48

/* A name and its value; lists end with a NULL name. */
typedef struct cli_word {
    const char *name;
    int value;
} cli_word;

/* The file that a flag's value names, if any. Shells complete its name. */
typedef enum cli_file {
    CLI_NO_FILE,
    CLI_FOLDER,
    CLI_READS,  /* a batch compares its bytes with those of the last run */
    CLI_WRITES, /* a picture: the command checks its extension */
    CLI_REPORTS /* text: not under the name of a mesh */
} cli_file;

/* When a flag acts. A flag of PROCESS changes how or whether a result is made, not the result. */
typedef enum cli_phase {
    CLI_PHASE_LOAD = 1,
    CLI_PHASE_DRAW = 2,
    CLI_PHASE_FILE = 4,
    CLI_PHASE_PROCESS = 8
} cli_phase;

/* X(constant, word in JSON) of every type of a value. */
#define CLI_TYPE_LIST(X)                                                                           \
    X(CLI_TYPE_AUTO, "auto") /* that of the handler (cli_type_of) */                               \
    X(CLI_TYPE_SWITCH, "switch")                                                                   \
    X(CLI_TYPE_INTEGER, "integer")                                                                 \
    X(CLI_TYPE_NUMBER, "number")                                                                   \
    X(CLI_TYPE_BYTES, "bytes")   /* an integer, which can end in K, M or G */                      \
    X(CLI_TYPE_SIZE, "size")     /* an integer, or two */                                          \
    X(CLI_TYPE_VECTOR, "vector") /* several numbers */                                             \
    X(CLI_TYPE_COLOR, "color")                                                                     \
    X(CLI_TYPE_LIGHT, "number or color")                                                           \
    X(CLI_TYPE_WORD, "word")   /* one of the flag's words */                                       \
    X(CLI_TYPE_WORDS, "words") /* several, between commas */                                       \
    X(CLI_TYPE_TEXT, "text")                                                                       \
    X(CLI_TYPE_NAME, "name") /* a text, or a number */
#define CLI_TYPE_CONSTANT(constant, word) constant,
typedef enum cli_type { CLI_TYPE_LIST(CLI_TYPE_CONSTANT) } cli_type;
#undef CLI_TYPE_CONSTANT

/* What a picture of lines does with a flag. */
typedef enum cli_svg {
    CLI_SVG_DRAWN,
    CLI_SVG_SAME,   /* it is accepted, and no line changes */
    CLI_SVG_REFUSED /* it is an error */
} cli_svg;

typedef struct cli_flag cli_flag;

/* Reads text (NULL for a switch or a missing optional value) into *target. Messages begin with the
 * flag's name. */
typedef burnish_status cli_handler(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error);

/* One flag. Texts for the man page mark bold as *so* and italics as _so_. */
struct cli_flag {
    const char *group;         /* heading of a group that starts here; NULL: same group */
    const char *topic;         /* with group: --help=TOPIC shows it whole; NULL: no topics */
    const char *name;          /* without dashes */
    char letter;               /* short form; 0: none */
    int common;                /* 1: on the first screen of a command with topics */
    const char *value;         /* placeholder of the value in help; NULL: a switch */
    int optional;              /* 1: without =VALUE the handler gets NULL */
    const char *help;          /* text of the help row, before the names of `words` */
    const char *default_text;  /* default as the handler reads it; NULL: none */
    const char *default_label; /* default in words, if the text is NULL or unclear */
    const char *manual;        /* text of the man page */
    const char *also;          /* other accepted names, between commas; NULL: none */
    const char *aliases;       /* names in other programs, between commas: only for hints */
    const char *off;           /* value that turns it off; NULL: none */
    int repeats;               /* 1: repeated values add up; otherwise the last one counts */
    cli_handler *handler;
    size_t offset;         /* of the target in the command's settings */
    double low, high;      /* range of a number */
    const cli_word *words; /* the valid values */
    cli_file file;         /* whether the value names a file */
    cli_type value_type;   /* if cli_type_of can not derive it */
    unsigned phases;       /* sum of cli_phase */
    unsigned not_for;      /* sum of the `heir` of commands that do not inherit it */
    cli_svg svg;
};

/* The fields that every row has, the fields of a switch, and the range of a number. The file of a
 * table defines TARGET(member) as .offset = offsetof(its settings, member). */
#define CLI_FLAG(flag, form, text, handled_by, member)                                             \
    .name = flag, .value = form, .help = text, .handler = handled_by, TARGET(member)
#define CLI_SWITCH(flag, text, member) CLI_FLAG(flag, NULL, text, cli_flag_switch, member)
#define CLI_RANGE(least, most) .low = least, .high = most

/* An example, which the tests run. */
typedef struct cli_example {
    const char *command, *what;
} cli_example;

/* A term of a section of the man page, with marks as above. */
typedef struct cli_term {
    const char *tag, *text;
} cli_term;

typedef void cli_take_term(const char *tag, const char *text);

/* An additional section of the man page. */
typedef struct cli_section {
    const char *heading, *text;
    const cli_term *terms;                   /* the last has a NULL tag; NULL: none */
    void (*each_term)(cli_take_term *print); /* prints terms from a table; or NULL */
    const char *closing;                     /* NULL: none */
} cli_section;

/* A flag and its value, which can be NULL; or an operand, with a NULL flag. */
typedef struct cli_argument {
    const cli_flag *flag;
    const char *text;
} cli_argument;

/* One call of a command: the result of parsing, in addition to the settings. */
typedef struct cli_call {
    const char *operands[2]; /* the first ones */
    size_t operand_count;
    cli_argument
        *arguments; /* receives all arguments in order, has room for argc; NULL: not wanted */
    size_t argument_count;
    int help;          /* 1: --help was found; the rest is not parsed */
    const char *topic; /* of --help=TOPIC; NULL: none */
    int exit_code;     /* set by the work if success is not 0 */
} cli_call;

/* Which flags of a command were given, by their index. */
typedef struct cli_given {
    uint64_t bits[2];
} cli_given;

/* The work of a command, with the settings of its flags. */
typedef burnish_status cli_work(void *settings, cli_call *call, burnish_error *error);

typedef struct cli_command cli_command;

/* A subcommand. */
struct cli_command {
    const char *name;         /* as typed: "render" */
    const char *aliases;      /* names in other programs, between commas: only for hints */
    const char *program;      /* the program that runs it, "burnish-lobe"; NULL: this one */
    const char *operand;      /* placeholder of the operand; "" for none */
    const char *summary;      /* one line */
    const char *operand_help; /* one line for the help screen */
    const char *manual;       /* paragraphs of the man page, separated by newlines */
    size_t operands_max;
    const cli_flag *flags;
    size_t flag_count;
    const cli_command
        *base; /* a command whose flags it inherits and whose settings are the first member of its
                 own; or NULL */
    unsigned base_phases;        /* inherits flags of one of these phases, ... */
    unsigned heir;               /* ... without this bit in not_for, and not named as its own */
    const cli_example *examples; /* the last has a NULL command; may be NULL */
    const cli_section *sections; /* the last has a NULL heading; may be NULL */
    size_t settings_size;        /* bytes, zero before the defaults of the flags */
    size_t given; /* offset of a cli_given in the settings, for at most 128 flags; 0: none */
    cli_work *work;
};

/* Whether a file's name is one of the program's inputs: a mesh. No report gets such a name, and it is
 * no short flag. The program sets it before it parses; NULL: there are no such names. */
extern int (*cli_is_input_name)(const char *name);

/* Whether the name is an item of a list with commas; the list can be NULL. */
int cli_in_list(const char *list, const char *name, size_t length);

/* Whether a flag of the command was given; settings are the command's, or begin with them. */
int cli_is_given(const cli_command *command, const void *settings, const char *name);

/* A condition under which flags have an effect. */
typedef struct cli_need {
    const char *flags; /* between commas; text after = is only shown: "light=file" */
    int is_met;
    const char *why; /* what is missing; what to do about it */
} cli_need;

/* Writes the warning about flag number *at or a later one that was given although its need is not
 * met, and moves *at behind it. Returns 0 if there is none. *at begins with 0. */
int cli_next_useless(const cli_command *command, const void *settings, const cli_need *needs,
                     size_t count, size_t *at, burnish_error *line);

/* Prints these warnings unless `quiet` is 1. With `strict` the first one is an error: ARGUMENT. */
burnish_status cli_check_needs(const cli_command *command, const void *settings,
                               const cli_need *needs, size_t count, int strict, int quiet,
                               burnish_error *error);

/* The flags of a command, its own first and then its base's; NULL past the last. */
const cli_flag *cli_flag_at(const cli_command *command, size_t index);

/* The row that begins a flag's group, with its heading and topic. */
const cli_flag *cli_group_of(const cli_command *command, const cli_flag *flag);

/* The flag of a command with this name, or with it among its other names; NULL: none. */
const cli_flag *cli_find_flag(const cli_command *command, const char *name, size_t length);

/* "burnish render", with the name of the program that runs; by default burnish. */
extern const char *cli_program_name;
typedef struct cli_command_name {
    char text[64];
} cli_command_name;
cli_command_name cli_full_name(const cli_command *command);

/* Writes one line, cleaned, and returns status. */
__attribute__((format(printf, 3, 4))) burnish_status
cli_fail(burnish_error *error, burnish_status status, const char *format, ...);

/* What an errno of a file that can't be opened or read is: fopen, too, needs memory. */
static inline burnish_status cli_errno_status(int code) {
    return code == ENOMEM ? BURNISH_STATUS_MEMORY : BURNISH_STATUS_READ;
}

/* The reason of an errno of a file that can't be opened: the system's, or what its name shows. */
const char *cli_open_reason(const char *path, int code);

/* Replaces by '?' what is not UTF-8 or controls a terminal (base/show_text.h), such as ends of lines. */
void cli_clean(char *text);

/* "burnish: warning: TEXT" on standard error, for every program. */
void cli_warn(const char *text);

/* Sets all flags to their defaults. */
burnish_status cli_defaults(const cli_command *command, void *settings, burnish_error *error);

/* Reads the arguments: --x=v, --x v, -o v, -ov, switches, `--` before operands. Flags can't be
 * abbreviated; of a repeated flag the last one counts. The caller sets call->arguments. The error
 * for an unknown flag names the most similar one. Every command has -h, --help and --help=TOPIC. */
burnish_status cli_parse(const cli_command *command, int argc, char **argv, void *settings,
                         cli_call *call, burnish_error *error);

/* Sets one flag by its name, as cli_parse does for "--name=text"; text NULL: no value. */
burnish_status cli_set(const cli_command *command, const char *name, const char *text,
                       void *settings, burnish_error *error);

/* Name number `index` of a list; NULL past its end. */
typedef const char *cli_name_at(const void *list, size_t index);

/* The name most similar to what was typed, or NULL: with few edits, with the same letters in
 * another order, or with the typed text inside. */
const char *cli_nearest(const char *typed, cli_name_at *name_at, const void *list);

/* ARGUMENT with one line: where the name was typed, the unknown name, and the most similar name or
 * the command that lists all names.
 *   where  "claims", "--metrics"
 *   kind   "figure" */
burnish_status cli_fail_unknown(burnish_error *error, const char *where, const char *kind,
                                const char *typed, cli_name_at *name_at, const void *list,
                                const char *lister);

#endif
