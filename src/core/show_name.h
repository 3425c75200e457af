/* A file name as messages show it. This is a header because the program links another copy of the
 * library, and both must print the same. */
#ifndef BURNISH_CORE_SHOW_NAME_H
#define BURNISH_CORE_SHOW_NAME_H

#include <stdio.h>
#include <string.h>

/* The whole name, or "..." and its end, to keep the message short. */
typedef struct burnish_shown_name {
    char text[164];
} burnish_shown_name;

static inline burnish_shown_name burnish_show_name(const char *name) {
    burnish_shown_name shown;
    const char *cut = "";
    const size_t most = sizeof shown.text - sizeof "...";
    size_t length = strlen(name);
    if (length > most) {
        name += length - most;
        cut = "...";
        while (((unsigned char)*name & 0xC0) == 0x80) { /* not from the middle of a character */
            ++name;
        }
    }
    snprintf(shown.text, sizeof shown.text, "%s%s", cut, name);
    return shown;
}

#endif
