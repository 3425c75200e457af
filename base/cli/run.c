/* Running a command. */
#include "base/cli/run.h"
#include "base/cli/help.h"
#include "base/cli/platform.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#ifdef _WIN32
void cli_handle_signals(void) {}
#else
/* Ends the program as the signal would have. */
static void end(int number) {
    burnish_file_remove_temporaries();
    raise(number); /* waits until the handler returns, then has its default effect */
}

void cli_handle_signals(void) {
    static const int ending[] = {SIGHUP, SIGINT, SIGTERM};
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    for (size_t i = 0; i < sizeof ending / sizeof *ending; ++i) {
        struct sigaction before, action = {.sa_handler = end, .sa_flags = SA_RESETHAND};
        if (sigaction(ending[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL) {
            sigaction(ending[i], &action, NULL); /* a signal that nohup ignores stays ignored */
        }
    }
}
#endif

burnish_status cli_finish_output(burnish_error *error) {
    if (fflush(stdout) != 0 || ferror(stdout)) {
        return cli_fail(error, BURNISH_STATUS_WRITE, "standard output: %s", strerror(errno));
    }
    return BURNISH_STATUS_OK;
}

int cli_exit_code(burnish_status status, const burnish_error *error) {
    if (status == BURNISH_STATUS_OK) {
        return EXIT_SUCCESS;
    }
    fprintf(stderr, "burnish: %s\n", error->text);
    return burnish_status_exit_code(status);
}

static const char *name_at(const void *list, size_t index) {
    const cli_command *const *commands = list;
    return commands[index] ? commands[index]->name : NULL;
}

const cli_command *cli_find_command(const cli_command *const *commands, const char *name,
                                    burnish_error *error) {
    for (size_t i = 0; commands[i]; ++i) {
        if (strcmp(commands[i]->name, name) == 0) {
            return commands[i];
        }
    }
    const char *nearest = cli_nearest(name, name_at, commands);
    for (size_t i = 0; commands[i]; ++i) {
        nearest =
            cli_in_list(commands[i]->aliases, name, strlen(name)) ? commands[i]->name : nearest;
    }
    if (nearest) {
        cli_fail(error, BURNISH_STATUS_ARGUMENT, "\"%.60s\": unknown command; did you mean %s?",
                 name, nearest);
    } else {
        cli_fail(error, BURNISH_STATUS_ARGUMENT,
                 "\"%.60s\": unknown command; \"%s --help\" lists the commands", name,
                 cli_program_name);
    }
    return NULL;
}

/* The file that an argument names; NULL: none. A value can begin with the name of what it writes. */
static const char *file_of(const cli_argument *argument, const char **flag) {
    const cli_flag *from = argument->flag;
    const char *colon = from && from->value && argument->text && strchr(from->value, ':')
                            ? strchr(argument->text, ':')
                            : NULL;
    *flag = from ? from->name : NULL;
    return from && from->file == CLI_NO_FILE ? NULL : colon ? colon + 1 : argument->text;
}

static int is_written(const cli_argument *argument) {
    return argument->flag && argument->flag->file > CLI_READS;
}

static int is_mesh_name(const char *name) {
    return cli_is_input_name && cli_is_input_name(name);
}

/* Whether writing to this name would replace a mesh, since the file is where links lead. */
static int is_link_to_mesh(const char *path) {
#ifdef _WIN32
    (void)path;
    return 0;
#else
    struct stat state;
    char *target = stat(path, &state) == 0 && S_ISREG(state.st_mode) ? realpath(path, NULL) : NULL;
    const int is_mesh = target && !is_mesh_name(path) && is_mesh_name(target);
    free(target);
    return is_mesh;
#endif
}

burnish_status cli_check_output(const char *flag, const char *path, int is_text,
                                burnish_error *error) {
    if (is_link_to_mesh(path)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.200s\" is a link to a mesh; name another file", flag, path);
    }
    return is_text && is_mesh_name(path)
               ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: \"%.200s\" has the extension of a mesh, which this file is not; "
                          "end the name otherwise",
                          flag, path)
               : BURNISH_STATUS_OK;
}

/* No output replaces a file that the same run reads, or a mesh behind a link, and no report a mesh. */
static burnish_status check_files(const cli_call *call, burnish_error *error) {
    for (size_t i = 0; i < call->argument_count; ++i) {
        const char *flag, *other, *path = file_of(&call->arguments[i], &flag);
        if (!path || !is_written(&call->arguments[i])) {
            continue;
        }
        for (size_t k = 0; k < call->argument_count; ++k) {
            const char *read = file_of(&call->arguments[k], &other);
            if (read && !is_written(&call->arguments[k]) && cli_same_file(path, read)) {
                return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                "--%s: \"%.200s\" is an input; name another file", flag, path);
            }
        }
        const burnish_status status =
            cli_check_output(flag, path, call->arguments[i].flag->file == CLI_REPORTS, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}

int cli_run(const cli_command *command, cli_work *work, int argc, char **argv) {
    burnish_error error;
    cli_call call = {0};
    void *settings = calloc(1, command->settings_size + 1); /* + 1: never 0 bytes */
    call.arguments = calloc((size_t)argc + 1, sizeof *call.arguments);
    burnish_status status = settings && call.arguments ? cli_defaults(command, settings, &error)
                                                       : cli_fail(&error, BURNISH_STATUS_MEMORY,
                                                                  "out of memory for the settings");
    if (status == BURNISH_STATUS_OK) {
        status = cli_parse(command, argc, argv, settings, &call, &error);
    }
    if (status == BURNISH_STATUS_OK && !call.help) {
        status = check_files(&call, &error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = call.help ? cli_print_help(command, call.topic, &error)
                           : (work ? work : command->work)(settings, &call, &error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = cli_finish_output(&error);
    }
    free(settings);
    free(call.arguments);
    return status == BURNISH_STATUS_OK ? call.exit_code : cli_exit_code(status, &error);
}
