#include "mesh/read/io/companions.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static int is_absolute(const char *name) {
    return *name == '/' || (*name && name[1] == ':');
}

static int is_up(const char *part, size_t size) {
    return size == 2 && part[0] == '.' && part[1] == '.';
}

/* Appends the parts of `name`, "." and empty ones left out, and goes back by "..". Returns NULL if
 * that leads above the start. */
static char *append_parts(char *start, char *to, const char *name) {
    while (*name) {
        const size_t size = strcspn(name, "/");
        if (is_up(name, size)) {
            if (to == start) {
                return NULL;
            }
            while (to > start && *--to != '/') {
            }
        } else if (size > 0 && !(size == 1 && *name == '.')) {
            if (to > start) {
                *to++ = '/';
            }
            memcpy(to, name, size);
            to += size;
        }
        name += size + (name[size] != 0);
    }
    return to;
}

int burnish_companion_path(const burnish_reader_input *input, const char *name,
                           char path[BURNISH_COMPANION_SIZE]) {
    const char *folder = input->folder ? input->folder : "";
    if (!*name || is_absolute(name) || strlen(folder) + strlen(name) + 2 > BURNISH_COMPANION_SIZE) {
        return 0;
    }
    if (!*folder && !strstr(name, "..")) {
        strcpy(path, name); /* as the caller's loader may know it */
        return 1;
    }
    char *to = append_parts(path, path, folder);
    to = to ? append_parts(path, to, name) : NULL;
    if (to) {
        *to = 0;
    }
    return to && to > path;
}

burnish_status burnish_companion_outside(const burnish_reader_input *input, const char *name,
                                         burnish_error *error) {
    enum { SHOWN = 200, STEPS_MAX = 16 }; /* names of inputs may be longer, and are cut then */
    const char *slash = strrchr(input->name, '/');
    const size_t size = slash ? (size_t)(slash - input->name) + 1 : 0;
    int steps = 0, depth = 0;
    for (size_t part; *name && !is_absolute(name); name += part + (name[part] != 0)) {
        part = strcspn(name, "/");
        depth += is_up(name, part) ? -1 : part > 1 || (part == 1 && *name != '.');
        steps = -depth > steps ? -depth : steps;
    }
    if (input->folder || size >= SHOWN || steps == 0 || steps > STEPS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_READ, "it is outside the %s",
                            input->folder ? "root" : "folder of the file");
    }
    return burnish_fail(error, BURNISH_STATUS_READ,
                        "it is outside the folder of the file; --root=%.*s%.*s allows it",
                        (int)size, input->name, 3 * steps - 1,
                        "../../../../../../../../../../../../../../../..");
}

void burnish_companion_missing(const burnish_reader_input *input, burnish_error *error) {
    const burnish_reason reason = burnish_errno_reason(ENOENT);
    const char *slash = strrchr(input->name, '/');
    const size_t size = strlen(error->text), end = strlen(reason.text);
    if (!input->folder && size >= end && strcmp(error->text + size - end, reason.text) == 0) {
        snprintf(error->text + size, sizeof error->text - size, "; --root=%.*s.. searches there",
                 slash && slash - input->name < 200 ? (int)(slash - input->name) + 1 : 0,
                 input->name);
    }
}
