/* What the files of `burnish render` call in a program that has no command line. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/output/report.h"
#include "render/render.h"

/* The command's own work, which nothing calls. */
burnish_status render_work(void *settings, cli_call *call, burnish_error *error) {
    (void)settings, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "render: not here");
}

/* Nothing is printed. A warning for which there is no memory is lost. */
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
