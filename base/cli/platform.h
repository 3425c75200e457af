/* Parts of POSIX that some systems lack. */
#ifndef BASE_CLI_PLATFORM_H
#define BASE_CLI_PLATFORM_H

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

/* strtod in the C locale; NaN without memory. */
static inline double cli_strtod(const char *text) {
#ifdef _WIN32
    return strtod(text, NULL); /* the program never leaves the C locale */
#else
    const locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    const double value = c_locale ? strtod_l(text, NULL, c_locale) : NAN;
    if (c_locale) {
        freelocale(c_locale);
    }
    return value;
#endif
}

/* Opens a stream in memory. cli_close_memory sets *text to its *size bytes and a 0, to be freed.
 * NULL without memory. */
static inline FILE *cli_open_memory(char **text, size_t *size) {
#ifdef _WIN32
    *text = NULL;
    *size = 0;
    return tmpfile();
#else
    return open_memstream(text, size);
#endif
}

/* Returns 0, or EOF without memory; free *text in both cases. */
static inline int cli_close_memory(FILE *stream, char **text, size_t *size) {
#ifdef _WIN32
    const long length = ftell(stream);
    *text = length >= 0 && !ferror(stream) ? malloc((size_t)length + 1) : NULL;
    rewind(stream);
    *size = *text ? fread(*text, 1, (size_t)length, stream) : 0;
    if (*text) {
        (*text)[*size] = 0;
    }
    fclose(stream);
    return *text && *size == (size_t)length ? 0 : EOF;
#else
    (void)text, (void)size;
    const int failed = ferror(stream);
    return fclose(stream) != 0 || failed ? EOF : 0;
#endif
}

/* The part of a path after its last slash. */
static inline const char *cli_base_name(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* The name in the folder, to be freed; NULL without memory. */
static inline char *cli_join_path(const char *folder, const char *name) {
    const size_t length = strlen(folder), size = length + strlen(name) + 2;
    char *path = malloc(size);
    if (path) {
        snprintf(path, size, "%s%s%s", folder, length > 0 && folder[length - 1] == '/' ? "" : "/",
                 name);
    }
    return path;
}

/* Whether two names are names of the same regular file. */
static inline int cli_same_file(const char *a, const char *b) {
#ifdef _WIN32
    char whole_a[1024], whole_b[1024]; /* files have no numbers here */
    return _fullpath(whole_a, a, sizeof whole_a) && _fullpath(whole_b, b, sizeof whole_b) &&
           _stricmp(whole_a, whole_b) == 0;
#else
    struct stat a_status, b_status;
    return stat(a, &a_status) == 0 && stat(b, &b_status) == 0 && S_ISREG(a_status.st_mode) &&
           a_status.st_dev == b_status.st_dev && a_status.st_ino == b_status.st_ino;
#endif
}

/* Whether two outputs are the same file, which can be missing: then they have one folder and one last
 * part. - is no file. */
static inline int cli_same_output(const char *a, const char *b) {
    if (strcmp(a, "-") == 0 || strcmp(a, b) == 0 || cli_same_file(a, b)) {
        return strcmp(a, "-") != 0;
    }
#ifdef _WIN32
    return 0; /* cli_same_file compares names there */
#else
    const char *names[2] = {a, b}, *last[2];
    struct stat folders[2];
    for (int i = 0; i < 2; ++i) {
        char folder[4096] = ".";
        const char *slash = strrchr(names[i], '/');
        const size_t length = slash ? (size_t)(slash - names[i]) + 1 : 0;
        if (length >= sizeof folder) {
            return 0;
        }
        if (slash) {
            memcpy(folder, names[i], length);
            folder[length] = 0;
        }
        last[i] = names[i] + length;
        if (stat(folder, &folders[i]) != 0) {
            return 0;
        }
    }
    return strcmp(last[0], last[1]) == 0 && folders[0].st_dev == folders[1].st_dev &&
           folders[0].st_ino == folders[1].st_ino;
#endif
}

/* Whether a name exists, including a dangling link. */
static inline int cli_name_exists(const char *path) {
    struct stat status;
#ifdef _WIN32
    return stat(path, &status) == 0;
#else
    return lstat(path, &status) == 0;
#endif
}

#endif
