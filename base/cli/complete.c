/* Completions for bash, zsh and fish from the tables of commands and flags. */
#include <stdio.h>
#include <string.h>

#include "base/cli/help.h"
#include "base/cli/program.h"
#include "base/cli/values.h"

/* The program whose completions are printed. */
static const cli_program *described;

/* Called for every command that has a work function; path is "render" or "lobe table". */
typedef void visitor(const cli_command *command);

static void visit(const cli_command *const *commands, visitor *take) {
    for (size_t i = 0; commands[i]; ++i) {
        if (commands[i]->parts) {
            visit(commands[i]->parts, take);
        } else {
            take(commands[i]);
        }
    }
}

static void print_names(const cli_command *const *commands) {
    for (size_t i = 0; commands[i]; ++i) {
        printf("%s%s", i > 0 ? " " : "", cli_short_name(commands[i]));
    }
}

static void print_words(const cli_word *words, const char *separator) {
    for (const cli_word *word = words; word->name; ++word) {
        printf("%s%s", word == words ? "" : separator, word->name);
    }
}

/* "picture camera all"; nothing for a command without topics. */
static void print_topics(const cli_command *command) {
    const char *topic;
    for (size_t i = 0; (topic = cli_topic_at(command, i)) != NULL; ++i) {
        printf("%s%s", i > 0 ? " " : "", topic);
    }
}

/* Inside '...': an apostrophe ends the quotes, is quoted itself and opens them again. */
static void print_quoted(const char *text, const char *escaped) {
    for (; *text; ++text) {
        if (*text == '\'') {
            fputs("'\\''", stdout);
        } else {
            printf("%s%c", strchr(escaped, *text) ? "\\" : "", *text);
        }
    }
}

/* Whether the value is several of the flag's words, between commas. */
static int takes_list(const cli_flag *flag) {
    return cli_type_of(flag) == CLI_TYPE_WORDS;
}

/* ---- bash ---- */

static void print_bash_command(const cli_command *command) {
    printf("    '%s')\n        flags='", command->name);
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        printf("--%s%s ", flag->name, flag->value && !flag->optional ? "=" : "");
    }
    printf("--help'\n        case $previous in\n");
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        if (flag->words) {
            printf("        --%s) %s%swords='", flag->name,
                   flag->optional ? "[[ $joined ]] && " : "", takes_list(flag) ? "list=1 " : "");
            print_words(flag->words, " ");
            printf("' ;;\n");
        }
    }
    if (cli_topic_at(command, 0)) {
        printf("        --help) [[ $joined ]] && words='");
        print_topics(command);
        printf("' ;;\n");
    }
    printf("        esac ;;\n");
}

/* The words after a command with parts, and after help. */
static void print_bash_parts(void) {
    for (size_t i = 0; described->commands[i]; ++i) {
        const cli_command *whole = described->commands[i];
        if (whole->parts) {
            printf("    if [[ $command == %s ]]; then\n"
                   "        ((COMP_CWORD == 2)) && words='",
                   whole->name);
            print_names(whole->parts);
            printf(" --help'\n        command+=\" ${COMP_WORDS[2]}\"\n    fi\n"
                   "    [[ $command == help && $previous == %s ]] && words='",
                   whole->name);
            print_names(whole->parts);
            printf("'\n");
        }
    }
}

/* File names are left to readline, which knows how to quote them. */
static void print_bash(void) {
    printf("# bash completion of burnish; made by burnish help --completion=bash\n"
           "_burnish() {\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
           "    local command=${COMP_WORDS[1]} flags='' words='' list='' prefix='' joined=''\n"
           "    local commands='");
    print_names(described->commands);
    printf("'\n"
           "    COMPREPLY=()\n"
           "    # bash takes = for a word of its own\n"
           "    if [[ $current == = ]]; then\n"
           "        current='' joined=1\n"
           "    elif [[ $previous == = ]]; then\n"
           "        previous=${COMP_WORDS[COMP_CWORD-2]} joined=1\n"
           "    fi\n"
           "    if ((COMP_CWORD == 1)) && [[ $current != -* ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$commands\" -- \"$current\"))\n"
           "        if [[ ${COMPREPLY[*]} ]]; then\n"
           "            list=$(compgen -f -- \"$current\") # not < <(...), which needs /dev/fd\n"
           "            [[ $list ]] && mapfile -t -O ${#COMPREPLY[@]} COMPREPLY <<<\"$list\"\n"
           "            compopt -o filenames\n"
           "        fi\n"
           "        return\n    fi\n"
           "    [[ \" $commands \" == *\" $command \"* ]] || command=render\n"
           "    [[ $command == help && $previous == help ]] && words=$commands\n");
    print_bash_parts();
    printf("    case $command in\n");
    visit(described->commands, print_bash_command);
    printf("    esac\n"
           "    ((COMP_CWORD == 1)) && flags+=' --version'\n"
           "    if [[ $current == -* && ! $joined ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$flags\" -- \"$current\"))\n"
           "        [[ ${COMPREPLY[0]} == *= ]] && compopt -o nospace\n"
           "    elif [[ $words ]]; then\n"
           "        [[ $list && $current == *,* ]] && prefix=${current%%,*},\n"
           "        COMPREPLY=($(compgen -P \"$prefix\" -W \"$words\" -- \"${current##*,}\"))\n"
           "        [[ $list ]] && compopt -o nospace\n"
           "        compopt +o default\n"
           "    fi\n"
           "}\ncomplete -o default -F _burnish burnish\n");
}

/* ---- zsh ---- */

static void print_zsh_command(const cli_command *command) {
    printf("    '%s')\n        _arguments -S \\\n", command->name);
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        printf("            '*--%s%s[", flag->name, flag->optional ? "=-" : flag->value ? "=" : "");
        print_quoted(flag->help, "[]:\\");
        printf("]");
        if (flag->value) {
            printf(flag->optional ? "::" : ":");
            print_quoted(flag->value, "[]:\\");
            if (flag->words) {
                printf(takes_list(flag) ? ":_values -s , word " : ":(");
                print_words(flag->words, " ");
                printf(takes_list(flag) ? "" : ")");
            } else {
                printf(":%s", flag->file ? "_files" : " ");
            }
        }
        printf("' \\\n");
    }
    if (cli_topic_at(command, 0)) {
        printf("            '--help=-[this screen, or a topic]::topic:(");
        print_topics(command);
        printf(")'");
    } else {
        printf("            '--help[this screen]'");
    }
    if (strcmp(command->name, "help") == 0) {
        printf(" '*:command:(");
        print_names(described->commands);
        for (size_t i = 0; described->commands[i]; ++i) {
            if (described->commands[i]->parts) {
                printf(" ");
                print_names(described->commands[i]->parts);
            }
        }
        printf(")' ;;\n");
    } else {
        printf(" '*:file:_files' ;;\n");
    }
}

static void print_zsh(void) {
    printf("#compdef burnish\n# zsh completion of burnish; made by burnish help --completion=zsh\n"
           "_burnish() {\n    local command=$words[2]\n    local -a commands=(");
    print_names(described->commands);
    printf(")\n    if ((CURRENT == 2)) && [[ $command != -* ]]; then\n"
           "        compadd -a commands\n        _files\n        return\n    fi\n"
           "    if ((CURRENT == 2)); then\n        compadd -- --version\n    fi\n"
           "    if ((! $commands[(Ie)$command])); then\n        command=render\n"
           "    else\n        shift words\n        ((CURRENT--))\n    fi\n");
    for (size_t i = 0; described->commands[i]; ++i) {
        const cli_command *whole = described->commands[i];
        if (whole->parts) {
            printf("    if [[ $command == %s ]]; then\n"
                   "        if ((CURRENT == 2)); then\n            compadd -- ",
                   whole->name);
            print_names(whole->parts);
            printf(" --help\n            return\n        fi\n"
                   "        command+=\" $words[2]\"\n        shift words\n"
                   "        ((CURRENT--))\n    fi\n");
        }
    }
    printf("    case $command in\n");
    visit(described->commands, print_zsh_command);
    printf("    esac\n}\n_burnish \"$@\"\n");
}

/* ---- fish ---- */

/* The condition under which a flag of the command is offered: render is implied. */
static void print_fish_condition(const cli_command *command) {
    const char *space = strchr(command->name, ' ');
    printf("complete -c burnish -n '");
    if (command == described->implied) {
        printf("not __fish_seen_subcommand_from");
        for (size_t i = 0; described->commands[i]; ++i) {
            if (described->commands[i] != command) {
                printf(" %s", described->commands[i]->name);
            }
        }
    } else {
        printf("__fish_seen_subcommand_from %.*s",
               space ? (int)(space - command->name) : (int)strlen(command->name), command->name);
    }
    if (space) {
        printf("; and __fish_seen_subcommand_from %s", space + 1);
    }
    printf("'");
}

static void print_fish_command(const cli_command *command) {
    const cli_flag *flag;
    for (size_t i = 0; (flag = cli_flag_at(command, i)) != NULL; ++i) {
        print_fish_condition(command);
        printf(" -l %s", flag->name);
        if (flag->letter) {
            printf(" -s %c", flag->letter);
        }
        if (flag->value && !flag->optional) {
            printf(flag->file ? " -r -F" : " -x");
        }
        if (flag->words) {
            printf(takes_list(flag) ? " -a '(__fish_append , " : " -a '");
            print_words(flag->words, " ");
            printf(takes_list(flag) ? ")'" : "'");
        }
        printf(" -d '");
        for (const char *c = flag->help; *c; ++c) {
            printf("%s%c", *c == '\'' || *c == '\\' ? "\\" : "", *c);
        }
        printf("'\n");
    }
    print_fish_condition(command);
    printf(" -l help -s h -d 'this screen'");
    if (cli_topic_at(command, 0)) {
        printf(" -f -a '");
        print_topics(command);
        printf("'");
    }
    printf("\n");
}

static void print_fish(void) {
    printf("# fish completion of burnish; made by burnish help --completion=fish\n");
    for (size_t i = 0; described->commands[i]; ++i) {
        const cli_command *whole = described->commands[i];
        printf("complete -c burnish -n __fish_use_subcommand -a %s\n", whole->name);
        if (whole->parts) {
            printf("complete -c burnish -n '__fish_seen_subcommand_from %s; and not "
                   "__fish_seen_subcommand_from ",
                   whole->name);
            print_names(whole->parts);
            printf("' -f -a '");
            print_names(whole->parts);
            printf("'\n");
        }
    }
    printf("complete -c burnish -n '__fish_seen_subcommand_from help' -f -a '");
    print_names(described->commands);
    printf("'\n");
    visit(described->commands, print_fish_command);
}

void cli_print_completion(const cli_program *program, const char *shell) {
    described = program;
    if (strcmp(shell, "bash") == 0) {
        print_bash();
    } else if (strcmp(shell, "zsh") == 0) {
        print_zsh();
    } else {
        print_fish();
    }
}
