/* Finds the input files. */
#include "batch/inputs.h"
#include "base/archive_models.h"
#include "base/cli/platform.h"
#include "batch/batch.h"
#include "batch/types.h"
#include "cli/input.h"
#include "import/importers.h"
#include "import/run.h"

#ifndef _WIN32

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static burnish_status fail_memory(burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the list of inputs");
}

static burnish_status add_item(batch_items *list, const char *input, size_t tree, uint64_t bytes,
                               burnish_error *error) {
    if (list->count == list->capacity) {
        const size_t capacity = list->capacity > 0 ? 2 * list->capacity : 64;
        batch_item *grown = capacity <= UINT32_MAX / sizeof *grown
                                ? realloc(list->items, capacity * sizeof *grown)
                                : NULL;
        if (!grown) {
            return fail_memory(error);
        }
        list->items = grown;
        list->capacity = capacity;
    }
    char *copy = strdup(input);
    if (!copy) {
        return fail_memory(error);
    }
    list->items[list->count++] =
        (batch_item){.input = copy, .tree = tree, .view = -1, .bytes = bytes};
    return BURNISH_STATUS_OK;
}

/* ---- Folders ---- */

typedef enum file_kind {
    FILE_OTHER,
    FILE_MESH, /* the extension of a reader or of an installed importer, with or without .gz, or .zip */
    FILE_PASSED_OVER /* such an extension, but other content */
} file_kind;

/* Whether the directory at an archive's end lists one model. The reader judges again. */
static int holds_one_model(const char *path) {
    static uint8_t end[1 << 20]; /* about 10000 files */
    burnish_archive_models models = {.count = 0};
    char name[BURNISH_ARCHIVE_NAME];
    FILE *file = fopen(path, "rb");
    if (file && fseek(file, -(long)sizeof end, SEEK_END) != 0) {
        rewind(file);
    }
    const size_t size = file ? fread(end, 1, sizeof end, file) : 0;
    for (size_t i = 0; i + 46 < size; ++i) {
        const size_t length = end[i + 28] + 256U * end[i + 29];
        if (memcmp(end + i, "PK\1\2", 4) != 0 || length >= sizeof name || length > size - i - 46) {
            continue;
        }
        snprintf(name, sizeof name, "%.*s", (int)length, (const char *)end + i + 46);
        if (burnish_archive_is_3mf(name)) {
            models = (burnish_archive_models){.count = 1};
            break;
        }
        if (!burnish_archive_hides(name)) {
            burnish_archive_take(&models, name, (int)cli_own_format(name));
        }
    }
    if (file) {
        fclose(file);
    }
    return models.count > 0 && !models.are_several;
}

static file_kind kind_of(const char *name, const char *path) {
    const import_program *importer = import_find(name);
    if (importer && import_is_installed(importer)) {
        return import_may_hold_mesh(path) ? FILE_MESH : FILE_PASSED_OVER;
    }
    const size_t size = strlen(name);
    const int is_archive = size > 4 && burnish_is_same_name(name + size - 4, ".zip");
    if (is_archive) {
        return holds_one_model(path) ? FILE_MESH : FILE_PASSED_OVER;
    }
    return cli_own_format(name) == BURNISH_FORMAT_AUTO ? FILE_OTHER
           : import_may_hold_mesh(path)                ? FILE_MESH
                                                       : FILE_PASSED_OVER;
}

static int is_shown(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

/* alphasort follows the locale. */
static int by_bytes(const struct dirent **a, const struct dirent **b) {
    return strcmp((*a)->d_name, (*b)->d_name);
}

enum { DEPTH_MAX = 64, LIST_MAX = 1 << 28 };

/* A folder of earlier pictures is not an input. */
static int is_output_folder(const batch *b, const struct stat *folder) {
    struct stat state;
    const char *name = b->settings->output_dir;
    return name && stat(name, &state) == 0 && state.st_dev == folder->st_dev &&
           state.st_ino == folder->st_ino;
}

/* Adds the meshes of a folder and, with --recursive, of its subfolders, but not of linked folders.
 */
static burnish_status add_folder(batch *b, const char *folder, size_t tree, int depth,
                                 burnish_error *error) {
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, is_shown, by_bytes);
    burnish_status status = BURNISH_STATUS_OK;
    if (count < 0) {
        return cli_fail(error, cli_errno_status(errno), "%.300s: can't be read: %s", folder,
                        strerror(errno));
    }
    for (int i = 0; i < count; ++i) {
        const char *name = entries[i]->d_name;
        char *path = cli_join_path(folder, name);
        struct stat state, link;
        if (status == BURNISH_STATUS_OK && !path) {
            status = fail_memory(error);
        }
        if (status == BURNISH_STATUS_OK) {
            if (stat(path, &state) != 0 || lstat(path, &link) != 0) {
                /* gone meanwhile */
            } else if (S_ISDIR(link.st_mode) && b->settings->recursive && depth < DEPTH_MAX) {
                status = add_folder(b, path, tree, depth + 1, error);
            } else if (S_ISDIR(link.st_mode)) {
                b->skipped += !is_output_folder(b, &link);
            } else if (S_ISREG(state.st_mode)) {
                const file_kind kind = kind_of(name, path);
                b->passed_over += kind == FILE_PASSED_OVER;
                status = kind == FILE_MESH
                             ? add_item(&b->list, path, tree, (uint64_t)state.st_size, error)
                             : status;
            }
        }
        free(path);
        free(entries[i]);
    }
    free(entries);
    return status;
}

/* ---- Names ---- */

static burnish_status add_name(batch *b, const char *name, burnish_error *error) {
    struct stat state;
    uint64_t bytes = 0;
    if (strcmp(name, "-") == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "a mesh on standard input has no name; give it alone, or --files-from=- "
                        "for a list of names");
    }
    if (*name == ':') {
        return add_item(&b->list, name, 1, 0, error);
    }
    if (stat(name, &state) == 0) {
        if (S_ISDIR(state.st_mode)) {
            size_t tree = strlen(name);
            tree += name[tree - 1] != '/';
            ++b->folders;
            return add_folder(b, name, tree, 0, error);
        }
        bytes = S_ISREG(state.st_mode) && state.st_size > 0 ? (uint64_t)state.st_size : 0;
    }
    return add_item(&b->list, name, (size_t)(cli_base_name(name) - name), bytes, error);
}

/* Reads a whole file: *size bytes and a terminating 0. */
static char *read_list(const char *path, size_t *size, burnish_error *error) {
    uint8_t *bytes;
    burnish_error cause;
    const burnish_status status = cli_read_bytes(path, LIST_MAX, NULL, &bytes, size, &cause);
    if (status == BURNISH_STATUS_LIMIT) {
        cli_fail(error, status, "--files-from: %.300s: larger than 256 MiB", path);
    } else if (status != BURNISH_STATUS_OK) {
        cli_fail(error, status, "--files-from: %s", cause.text);
    }
    return (char *)bytes;
}

/* Names end with a newline or, if the list contains a byte 0, with a 0. */
static burnish_status add_list(batch *b, const char *path, burnish_error *error) {
    size_t size = 0;
    char *text = read_list(path, &size, error);
    if (!text) {
        return error->status;
    }
    const char separator = memchr(text, 0, size) ? 0 : '\n';
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t at = 0; at < size && status == BURNISH_STATUS_OK;) {
        const char *found = memchr(text + at, separator, size - at);
        const size_t end = found ? (size_t)(found - text) : size;
        text[end] = 0;
        if (end > at) {
            status = add_name(b, text + at, error);
        }
        at = end + 1;
    }
    free(text);
    return status;
}

void batch_warn_inputs(const batch *b) {
    if (b->skipped > 0 && !b->settings->render.job.quiet) {
        burnish_error line;
        cli_fail(&line, BURNISH_STATUS_OK,
                 "%zu folder%s in INPUT %s skipped; --recursive searches %s", b->skipped,
                 b->skipped == 1 ? "" : "s", b->skipped == 1 ? "was" : "were",
                 b->skipped == 1 ? "it" : "them");
        cli_warn(line.text);
    }
}

burnish_status batch_collect(batch *b, const cli_call *call, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < call->argument_count && status == BURNISH_STATUS_OK; ++i) {
        if (!call->arguments[i].flag && !*call->arguments[i].text) {
            status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "an INPUT is empty");
        } else if (!call->arguments[i].flag) {
            status = add_name(b, call->arguments[i].text, error);
        }
    }
    if (status == BURNISH_STATUS_OK && b->settings->files_from) {
        status = add_list(b, b->settings->files_from, error);
    }
    if (status == BURNISH_STATUS_OK && call->operand_count == 0 && !b->settings->files_from) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "batch: no INPUT; try \"burnish batch FOLDER --output-dir=thumbs\" or "
                          "\"burnish batch --help\"");
    }
    if (status == BURNISH_STATUS_OK && b->list.count == 0) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "no meshes there%s",
                          b->settings->recursive ? "" : "; --recursive looks into folders below");
    }
    return status;
}

#else

burnish_status batch_collect(batch *b, const cli_call *call, burnish_error *error) {
    (void)b, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "several inputs and folders are not supported on this system; give one file");
}

void batch_warn_inputs(const batch *b) {
    (void)b;
}

#endif
