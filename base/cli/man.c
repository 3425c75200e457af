/* The man page in roff (man macros), from the same tables as the help screens. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/cli/help.h"
#include "base/cli/program.h"
#include "base/cli/values.h"

/* 1 for the marks of *bold* and _italics_. A mark opens before and closes after a word, so a mark
 * inside a word, as in burnish_boundary, is a plain character. */
static int is_mark(const char *text, size_t at, size_t length, char open) {
    char c = text[at];
    char before = at > 0 ? text[at - 1] : ' ', after = at + 1 < length ? text[at + 1] : ' ';
    if (c != '*' && c != '_') {
        return 0;
    }
    return open ? c == open && !isalnum((unsigned char)after)
                : !isalnum((unsigned char)before) && after != ' ';
}

/* Prints text for roff: marks as fonts, everything else literally. */
static void print_span(const char *text, size_t length) {
    char open = 0;
    for (size_t i = 0; i < length; ++i) {
        char c = text[i];
        if (is_mark(text, i, length, open)) {
            open = open ? 0 : c;
            fputs(!open ? "\\fR" : c == '*' ? "\\fB" : "\\fI", stdout);
            continue;
        }
        if (i == 0 && (c == '.' || c == '\'')) {
            fputs("\\&", stdout);
        }
        if (c == '\\') {
            fputs("\\e", stdout);
        } else if (c == '^') {
            fputs("\\(ha", stdout);
        } else if (c == '-') {
            fputs("\\-", stdout);
        } else {
            putchar(c);
        }
    }
    putchar('\n');
}

static void print_text(const char *text) {
    print_span(text, strlen(text));
}

/* Paragraphs separated by newlines; the first one continues the preceding text. */
static void print_paragraphs(const char *text) {
    const char *rest = text;
    while (rest) {
        const char *item;
        size_t length = cli_next_item(&rest, '\n', &item);
        if (item != text) {
            printf(".PP\n");
        }
        print_span(item, length);
    }
}

static void print_tagged(const char *tag, const char *text) {
    printf(".TP\n");
    print_text(tag);
    print_paragraphs(text);
}

/* The default in words: "-" and "." are spelled out. */
static const char *default_words(const cli_flag *flag) {
    const char *shown = cli_default_label(flag);
    return strcmp(shown, "-") == 0   ? "standard output (*-*)"
           : strcmp(shown, ".") == 0 ? "the current folder"
                                     : shown;
}

static void print_flag(const cli_flag *flag) {
    char tag[160];
    char letter[48] = "";
    if (flag->letter) {
        snprintf(letter, sizeof letter, flag->value ? "*-%c* _%s_, " : "*-%c*%s, ", flag->letter,
                 flag->value ? flag->value : "");
    }
    if (flag->value) {
        snprintf(tag, sizeof tag, flag->optional ? "%s*--%s*[=_%s_]" : "%s*--%s*=_%s_", letter,
                 flag->name, flag->value);
    } else {
        snprintf(tag, sizeof tag, "%s*--%s*", letter, flag->name);
    }
    printf(".TP\n");
    print_text(tag);
    print_text(flag->manual);
    char values[240] = "";
    const char *shown = default_words(flag);
    if (flag->words) {
        strcpy(values, "Values: ");
        cli_word_list(flag->words, values + strlen(values), sizeof values - strlen(values));
    }
    if (flag->words || *shown) {
        char line[512];
        int length = snprintf(line, sizeof line, "%s%s%s%s", values,
                              flag->words && *shown ? ". " : "", *shown ? "Default: " : "", shown);
        const int has_both = flag->default_label && flag->default_text;
        if (has_both && !strchr(flag->default_text, ',')) {
            length += snprintf(line + length, sizeof line - (size_t)length, " (*%s*)",
                               flag->default_text);
        } else if (has_both) { /* lines can break at the blanks */
            const char *rest = flag->default_text, *item;
            for (const char *before = ": "; rest; before = ", ") {
                int size = (int)cli_next_item(&rest, ',', &item);
                length += snprintf(line + length, sizeof line - (size_t)length, "%s*%.*s*", before,
                                   size, item);
            }
        }
        strcpy(line + length, ".");
        printf(".br\n");
        print_text(line);
    }
}

static void print_upper(const char *text) {
    for (const char *c = text; *c; ++c) {
        putchar(*c >= 'a' && *c <= 'z' ? *c - 'a' + 'A' : *c);
    }
}

/* A command, with a heading. */
static void print_command(const cli_command *command) {
    printf(".SH \"");
    print_upper(command->name);
    printf("\"\n");
    print_paragraphs(command->manual);
    for (size_t i = 0; i < command->flag_count; ++i) {
        if (command->flags[i].group) {
            printf(".SS %s\n", command->flags[i].group);
        }
        print_flag(&command->flags[i]);
    }
}

static void print_synopsis(const cli_command *command) {
    char line[160];
    if (*command->operand) {
        snprintf(line, sizeof line, "*%s* _%s_ [_options_]", cli_full_name(command).text,
                 command->operand);
    } else {
        snprintf(line, sizeof line, "*%s* [_options_]", cli_full_name(command).text);
    }
    print_text(line);
    printf(".br\n");
}

static void print_section(const cli_section *s) {
    printf(".SH \"%s\"\n", s->heading);
    if (s->text) {
        print_text(s->text);
    }
    for (const cli_term *term = s->terms; term && term->tag; ++term) {
        print_tagged(term->tag, term->text);
    }
    if (s->each_term) {
        s->each_term(print_tagged);
    }
    if (s->closing) {
        printf(".PP\n");
        print_text(s->closing);
    }
}

/* Additional sections of commands. */
static void print_sections(const cli_command *command) {
    for (const cli_section *s = command->sections; s && s->heading; ++s) {
        print_section(s);
    }
}

static void print_exit_status(const cli_program *program) {
    printf(".SH \"EXIT STATUS\"\n");
    for (int code = 0; code < CLI_EXIT_END; ++code) {
        const char *text = cli_exit_text(program->exits, code);
        if (text) {
            printf(".TP\n.B %d\n", code);
            print_text(text);
        }
    }
    printf(".PP\n");
    print_text("Every failure prints one line on standard error, \"burnish: ...\", with the file "
               "or flag, the location in it, the fault and a remedy. A failed run leaves no "
               "partial or temporary files, and older files stay unchanged.");
}

static void print_example_list(const cli_example *examples) {
    for (const cli_example *example = examples; example && example->command; ++example) {
        printf(".TP\n.B ");
        print_text(example->command);
        print_text(example->what);
    }
}

void cli_print_man(const cli_program *program) {
    printf(".\\\" Made by %s help --man; do not edit.\n.TH ", program->name);
    print_upper(program->name);
    printf(" 1 \"%s\" \"burnish %s\" \"User Commands\"\n.SH NAME\n%s \\- %s\n.SH SYNOPSIS\n",
           program->man_date, burnish_version(), program->name, program->summary);
    for (size_t i = 0; program->commands[i]; ++i) {
        print_synopsis(program->commands[i]);
    }
    char line[160];
    snprintf(line, sizeof line, "*%s* *--help* | *--version*", program->name);
    print_text(line);
    printf(".br\n");
    snprintf(line, sizeof line, "*%s* _COMMAND_ *--help*[*=*_TOPIC_]", program->name);
    print_text(line);
    printf(".SH DESCRIPTION\n");
    print_paragraphs(program->description);
    for (size_t i = 0; program->commands[i]; ++i) {
        print_command(program->commands[i]);
    }
    print_section(program->values);
    for (size_t i = 0; program->commands[i]; ++i) {
        print_sections(program->commands[i]);
    }
    print_exit_status(program);
    print_section(program->environment);
    printf(".SH EXAMPLES\n");
    print_example_list(program->examples);
    printf(".SH \"SEE ALSO\"\n%s\n", program->see_also);
}
