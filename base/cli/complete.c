/* Completions for bash, zsh and fish from the tables of commands and flags. */
#include <stdio.h>
#include <string.h>

#include "base/cli/help.h"
#include "base/cli/program.h"
#include "base/cli/values.h"

/* The program whose completions are printed. */
static const cli_program *described;

typedef void visitor(const cli_command *command);

/* Calls take for every command that this program runs, or that another program runs. */
static void visit(int others, visitor *take) {
    for (size_t i = 0; described->commands[i]; ++i) {
        if (!described->commands[i]->program == !others) {
            take(described->commands[i]);
        }
    }
}

static void print_names(const cli_command *const *commands) {
    for (size_t i = 0; commands[i]; ++i) {
        printf("%s%s", i > 0 ? " " : "", commands[i]->name);
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

/* The name of a shell function for the completions of a program: it has no dashes. */
static const char *function_name(const char *program) {
    static char name[CLI_NAME_MAX];
    snprintf(name, sizeof name, "_%s", program);
    for (char *c = name; *c; ++c) {
        *c = *c == '-' ? '_' : *c;
    }
    return name;
}

/* What follows the name of another program's command is completed by that program's completions. */
static void print_bash_other(const cli_command *command) {
    const char *function = function_name(command->program);
    printf("    if [[ $command == %s ]] && ((COMP_CWORD > 1)); then\n"
           "        declare -F %s >/dev/null || eval \"$(%s help --completion=bash 2>/dev/null)\"\n"
           "        declare -F %s >/dev/null || return\n"
           "        local COMP_WORDS=(\"${COMP_WORDS[@]:1}\") COMP_CWORD=$((COMP_CWORD - 1))\n"
           "        %s\n        return\n    fi\n",
           command->name, function, command->program, function, function);
}

/* File names are left to readline, which knows how to quote them. */
static void print_bash(void) {
    const char *name = described->name;
    printf("# bash completion of %s; made by %s help --completion=bash\n%s() {\n", name, name,
           function_name(name));
    printf("    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
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
           "    [[ \" $commands \" == *\" $command \"* ]] || command=%s\n"
           "    [[ $command == help && $previous == help ]] && words=$commands\n",
           described->implied ? described->implied->name : "''");
    visit(1, print_bash_other);
    printf("    case $command in\n");
    visit(0, print_bash_command);
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
           "}\ncomplete -o default -F %s %s\n",
           function_name(name), name);
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
        printf(")' ;;\n");
    } else {
        printf(" '*:file:_files' ;;\n");
    }
}

static void print_zsh_other(const cli_command *command) {
    printf("    if [[ $command == %s ]]; then\n        words[1]=%s\n        _normal\n"
           "        return\n    fi\n",
           command->name, command->program);
}

static void print_zsh(void) {
    const char *name = described->name, *function = function_name(name);
    printf("#compdef %s\n# zsh completion of %s; made by %s help --completion=zsh\n"
           "%s() {\n    local command=$words[2]\n    local -a commands=(",
           name, name, name, function);
    print_names(described->commands);
    printf(")\n    if ((CURRENT == 2)) && [[ $command != -* ]]; then\n"
           "        compadd -a commands\n        _files\n        return\n    fi\n"
           "    if ((CURRENT == 2)); then\n        compadd -- --version\n    fi\n"
           "    if ((! $commands[(Ie)$command])); then\n        command=%s\n"
           "    else\n        shift words\n        ((CURRENT--))\n    fi\n",
           described->implied ? described->implied->name : "''");
    visit(1, print_zsh_other);
    printf("    case $command in\n");
    visit(0, print_zsh_command);
    printf("    esac\n}\n%s \"$@\"\n", function);
}

/* ---- fish ---- */

/* The condition under which a flag of the command is offered: one command can be implied. */
static void print_fish_condition(const cli_command *command) {
    printf("complete -c %s -n '", described->name);
    if (command == described->implied) {
        printf("not __fish_seen_subcommand_from");
        for (size_t i = 0; described->commands[i]; ++i) {
            if (described->commands[i] != command) {
                printf(" %s", described->commands[i]->name);
            }
        }
    } else {
        printf("__fish_seen_subcommand_from %s", command->name);
    }
    printf("'");
}

static void print_fish_other(const cli_command *command) {
    print_fish_condition(command);
    printf(" -f -a '(complete -C (string join \" \" -- %s (commandline -opc | tail -n +3) "
           "(commandline -ct)))'\n",
           command->program);
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
    const char *name = described->name;
    printf("# fish completion of %s; made by %s help --completion=fish\n", name, name);
    for (size_t i = 0; described->commands[i]; ++i) {
        printf("complete -c %s -n __fish_use_subcommand -a %s\n", name,
               described->commands[i]->name);
    }
    printf("complete -c %s -n '__fish_seen_subcommand_from help' -f -a '", name);
    print_names(described->commands);
    printf("'\n");
    visit(1, print_fish_other);
    visit(0, print_fish_command);
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
