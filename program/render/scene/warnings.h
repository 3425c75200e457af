/* Lines about what a picture does not show as asked for. */
#ifndef TOOL_RENDER_SCENE_WARNINGS_H
#define TOOL_RENDER_SCENE_WARNINGS_H

#include <stddef.h>

/* Zero-initialised: no lines, and none is printed. */
typedef struct render_warnings {
    void (*print)(const char *line); /* such as cli_warn; NULL: nothing is printed */
    char **lines;                    /* `count` of them, owned */
    size_t count;
} render_warnings;

/* Prints a line if `printed` is 1, and adds it. Without memory it is missing in the list. */
__attribute__((format(printf, 3, 4))) void render_warn(render_warnings *warnings, int printed,
                                                       const char *format, ...);

/* Drops all lines but the first `kept`; with 0 it releases the list. */
void render_drop_warnings(render_warnings *warnings, size_t kept);

#endif
