/* What a oracle_source owns: release, and its warnings. */
#include "oracle/source.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { WARNING_LIMIT = 16, WARNING_SIZE = 480 };

void oracle_source_destroy(oracle_source *source) {
    if (!source) {
        return;
    }
    for (size_t i = 0; i < source->warning_count; ++i) {
        free(source->warnings[i]);
    }
    free(source->warnings);
    free(source->materials);
    free(source->triangle_materials);
    free(source->corner_normals);
    free(source->corner_positions);
    free(source->normals);
    free(source->colors);
    free(source->positions);
    *source = (oracle_source){0};
}

void oracle_source_warn(oracle_source *source, const char *format, ...) {
    if (source->warning_count >= WARNING_LIMIT ||
        oracle_legacy_reserve((void **)&source->warnings, &source->warning_capacity,
                              source->warning_count + 1, sizeof *source->warnings, "warnings",
                              NULL) != BURNISH_STATUS_OK) {
        return;
    }
    char line[WARNING_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    for (char *c = line; *c; ++c) {
        if ((unsigned char)*c < 32 || *c == 127) {
            *c = '?';
        }
    }
    char *copy = strdup(line);
    if (copy) {
        source->warnings[source->warning_count++] = copy;
    }
}
