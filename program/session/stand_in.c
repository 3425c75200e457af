/* Functions that the files of `burnish render` need in a program without a command line. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/flags.h"
#include "render/output/report.h"

/* The work of the command, which is never called. */
burnish_status render_work(void *settings, cli_call *call, burnish_error *error) {
    (void)settings, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "render: not available here");
}

/* Prints nothing. Without memory the warning is lost. */
void render_result_warn(render_result *result, int printed, const char *format, ...) {
    burnish_error line;
    va_list arguments;
    (void)printed;
    va_start(arguments, format);
    vsnprintf(line.text, sizeof line.text, format, arguments);
    va_end(arguments);
    cli_clean(line.text);
    char **grown = realloc(result->warnings, (result->warning_count + 1) * sizeof *grown);
    char *copy = strdup(line.text);
    if (grown) {
        result->warnings = grown;
    }
    if (grown && copy) {
        result->warnings[result->warning_count++] = copy;
    } else {
        free(copy);
    }
}
