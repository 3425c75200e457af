/* Names of inputs: files in archives ("kit.zip:part.stl"), and their folders in a root. */
#ifndef BURNISH_BASE_INPUTS_H
#define BURNISH_BASE_INPUTS_H

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/platform.h"

enum { BURNISH_INPUT_PATH = 4096 };

/* Whether `size` bytes are the same but for the case of ASCII letters, in every locale. */
static inline int burnish_are_same_letters(const char *a, const char *b, size_t size) {
    int same = 1;
    for (size_t i = 0; i < size && same; ++i) {
        const int is_letter = (a[i] | 32) >= 'a' && (a[i] | 32) <= 'z';
        same = a[i] == b[i] || (is_letter && (a[i] | 32) == (b[i] | 32));
        if (a[i] == 0) {
            return same;
        }
    }
    return same;
}

static inline int burnish_is_same_name(const char *a, const char *b) {
    return burnish_are_same_letters(a, b, strlen(a) + 1);
}

/* The name of the file in the archive; NULL: the name is of a file. */
static inline const char *burnish_archive_member(const char *name) {
    for (; *name; ++name) {
        if (burnish_are_same_letters(name, ".zip:", 5)) {
            return name[5] ? name + 5 : NULL;
        }
    }
    return NULL;
}

/* The extension of a path of `size` bytes, in lower case and without the dot; "": none, or too long.
 * Importers go by it. */
enum { BURNISH_EXTENSION_SIZE = 12 };
static inline void burnish_lower_extension(const char *path, size_t size,
                                           char to[BURNISH_EXTENSION_SIZE]) {
    size_t first = size;
    while (first > 0 && path[first - 1] != '.' && path[first - 1] != '/') {
        --first;
    }
    size = first > 0 && path[first - 1] == '.' ? size - first : 0;
    size = size < BURNISH_EXTENSION_SIZE ? size : 0;
    for (size_t i = 0; i < size; ++i) {
        const char c = path[first + i];
        to[i] = (char)(c >= 'A' && c <= 'Z' ? c | 32 : c);
    }
    to[size] = 0;
}

/* open(), of the archive if the name is of a file in one. */
static inline int burnish_open_input(const char *name, int flags) {
    char path[BURNISH_INPUT_PATH];
    const char *member = burnish_archive_member(name);
    if (member &&
        snprintf(path, sizeof path, "%.*s", (int)(member - name) - 1, name) >= (int)sizeof path) {
        errno = ENAMETOOLONG;
        return -1;
    }
    return open(member ? path : name, flags);
}

/* The path from `root` to the folder of the file `input`: "" or "a/b", links followed. Returns 0, or
 * an errno: EXDEV if the root does not contain it. */
static inline int burnish_folder_below(const char *root, const char *input,
                                       char below[BURNISH_INPUT_PATH]) {
#if defined(_WIN32) || defined(__wasm__)
    (void)root, (void)input, (void)below;
    return ENOSYS;
#else
    char folder[BURNISH_INPUT_PATH], inner[BURNISH_INPUT_PATH], outer[BURNISH_INPUT_PATH];
    const char *slash = strrchr(input, '/');
    snprintf(folder, sizeof folder, "%.*s.", slash ? (int)(slash - input) + 1 : 0, input);
    if (!realpath(folder, inner) || !realpath(root, outer)) {
        return errno;
    }
    size_t shared = strlen(outer);
    shared -= outer[shared - 1] == '/'; /* of "/" */
    if (strncmp(inner, outer, shared) != 0 || (inner[shared] && inner[shared] != '/')) {
        return EXDEV;
    }
    strcpy(below, inner + shared + (inner[shared] == '/'));
    return 0;
#endif
}

/* The reason that a root is refused. */
static inline const char *burnish_root_fault(int code) {
    return code == EXDEV    ? "does not contain the input; name a folder above it"
           : code == ENOSYS ? "is not supported on this system; copy the files next to the input"
                            : "can't be read; name a folder above the input";
}

#endif
