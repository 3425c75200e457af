/* `burnish-lobe COMMAND`, which returns its output as a string: the program's tables, claims
 * and boundary memories. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/file.h"
#include "base/cli/output.h"
#include "base/wasm/module.h"
#include "program/lobe.h"

WASM_EXPORT(lobe_command)
const char *run_lobe(const char *arguments, int count);

static char *printed; /* the last output */

burnish_status cli_file_write(const char *path, const void *bytes, size_t size,
                              burnish_error *error) {
    if (strcmp(path, "-") != 0) {
        return cli_fail(error, BURNISH_STATUS_WRITE, "%.200s: files can't be written here; omit -o",
                        path);
    }
    free(printed);
    printed = malloc(size + 1);
    if (!printed) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the output");
    }
    memcpy(printed, bytes, size);
    printed[size] = 0;
    return BURNISH_STATUS_OK;
}

static const cli_command *find(const char *name, burnish_error *error) {
    static const cli_command *const commands[] = {&lobe_table_command, &lobe_claims_command,
                                                  &lobe_choose_command, &lobe_boundary_command};
    for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
        if (strcmp(commands[i]->name, name) == 0) {
            return commands[i];
        }
    }
    cli_fail(error, BURNISH_STATUS_ARGUMENT,
             "\"%.60s\": not available here; use table, claims, choose or boundary", name);
    return NULL;
}

/* words: count zero-terminated strings. */
static burnish_status run(const char *words, int count, burnish_error *error) {
    const cli_command *command =
        count > 0 ? find(words, error)
                  : (cli_fail(error, BURNISH_STATUS_ARGUMENT, "no command"), NULL);
    if (!command) {
        return error->status;
    }
    char **arguments = calloc((size_t)count, sizeof *arguments);
    void *settings = calloc(1, command->settings_size + 1);
    cli_call call = {0};
    burnish_status status = settings && arguments
                                ? cli_defaults(command, settings, error)
                                : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    for (int i = 0; i < count - 1 && arguments; ++i) {
        words += strlen(words) + 1;
        arguments[i] = (char *)words; /* like argv, which the parser does not change */
    }
    if (status == BURNISH_STATUS_OK) {
        status = cli_parse(command, count - 1, arguments, settings, &call, error);
    }
    if (status == BURNISH_STATUS_OK && call.help) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "--help: unknown flag");
    }
    if (status == BURNISH_STATUS_OK) {
        status = command->work(settings, &call, error);
    }
    free(settings);
    free(arguments);
    return status;
}

/* Runs a command of `burnish lobe`, except help.
 *   arguments  count texts, each with its zero: "table", "--lobes=energy:2" ...
 * Returns its output, valid until the next call, or NULL after an error. */
const char *run_lobe(const char *arguments, int count) {
    free(printed);
    printed = NULL;
    const burnish_status status = run(arguments, count, module_error());
    return status == BURNISH_STATUS_OK ? printed : NULL;
}
