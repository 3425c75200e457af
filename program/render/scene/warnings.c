#include "render/scene/warnings.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/options.h"

void render_warn(render_warnings *warnings, int printed, const char *format, ...) {
    burnish_error line;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line.text, sizeof line.text, format, arguments);
    va_end(arguments);
    cli_clean(line.text);
    if (printed && warnings->print) {
        warnings->print(line.text);
    }
    char **grown = realloc(warnings->lines, (warnings->count + 1) * sizeof *grown);
    char *copy = strdup(line.text);
    if (grown) {
        warnings->lines = grown;
    }
    if (grown && copy) {
        warnings->lines[warnings->count++] = copy;
    } else {
        free(copy);
    }
}

void render_drop_warnings(render_warnings *warnings, size_t kept) {
    while (warnings->count > kept) {
        free(warnings->lines[--warnings->count]);
    }
    if (kept == 0) {
        free(warnings->lines);
        warnings->lines = NULL;
    }
}
