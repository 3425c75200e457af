/* For tests: the lines of an SVG's path. */
#ifndef BURNISH_TEST_SVG_PATH_H
#define BURNISH_TEST_SVG_PATH_H

#include "support.h"

/* Points of lines, one after another; a closed line ends where it begins. */
typedef struct svg_path {
    double points[1 << 15][2];
    size_t starts[1 << 13]; /* count of them, and the end */
    size_t count;
} svg_path;

/* Reads what is between the quotes of d="...": M, m, l and z with coordinates of two numbers.
 * strtod takes "1.5.5" apart as a path does. */
static inline void svg_read_path(const char *d, svg_path *path) {
    const size_t most = sizeof path->points / sizeof *path->points;
    double at[2] = {0, 0}, start[2] = {0, 0};
    size_t size = 0;
    char command = 0;
    path->count = 0;
    path->starts[0] = 0;
    while (*d != '"') {
        if (strchr("Mmlz", *d)) {
            command = *d++;
            if (command == 'z') {
                memcpy(at, start, sizeof at);
                memcpy(path->points[size++], at, sizeof at);
            }
            continue;
        }
        for (int k = 0; k < 2; ++k) {
            char *end;
            const double value = strtod(d, &end);
            if (!CHECK(end != d, "no number at \"%.10s\"", d)) {
                exit(1);
            }
            at[k] = command == 'M' ? value : at[k] + value;
            d = end;
        }
        if (command != 'l') {
            memcpy(start, at, sizeof at);
            path->starts[path->count++] = size;
        }
        if (!CHECK(size + 1 < most && path->count < 8191, "a path too long for the test")) {
            exit(1);
        }
        memcpy(path->points[size++], at, sizeof at);
    }
    path->starts[path->count] = size;
}

/* The number or colour of an attribute within a tag. */
static inline const char *attribute(const char *tag, const char *name) {
    char wanted[40];
    snprintf(wanted, sizeof wanted, " %s=\"", name);
    const char *end = strchr(tag, '>'), *found = strstr(tag, wanted);
    return found && found < end ? found + strlen(wanted) : NULL;
}

#endif
