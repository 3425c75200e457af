/* Names outputs: expands the template and makes the names unique. */
#include <stdlib.h>
#include <string.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/cli/platform.h"
#include "base/inputs.h"
#include "batch/batch.h"
#include "batch/types.h"
#include "cli/input.h"
#include "render/scene/cameras.h"

const char *batch_view_name(const batch *b, const batch_item *item) {
    return render_view_name(b->settings->render.picture.views.items[item->view]);
}

enum { NAME_MAX_BYTES = 4000 };

/* How much of the input's name is in the output's: first what the template names. While two inputs
 * share an output, the extension is added ("part.stl.png"), then all folders, then both. */
enum { LEVEL_PLAIN, LEVEL_EXTENSION, LEVEL_FOLDERS, LEVEL_BOTH, LEVELS };

/* A name under construction; size is NAME_MAX_BYTES if it is too long. */
typedef struct name {
    char text[NAME_MAX_BYTES + 1];
    size_t size;
} name;

static void name_append(name *n, const char *text, size_t size) {
    if (n->size + size >= NAME_MAX_BYTES) {
        n->size = NAME_MAX_BYTES;
        return;
    }
    memcpy(n->text + n->size, text, size);
    n->size += size;
    n->text[n->size] = 0;
}

/* The parts of an input's name. */
typedef struct parts {
    const char *folder, *model, *extension; /* extension: without its dot */
    size_t folder_size, model_size;
} parts;

/* The length of the folders of an item's input; a file in an archive is in the archive's folder, or
 * in the archive's own ones if all folders are named. */
static size_t folder_length(const batch_item *item) {
    const char *input = item->input, *member = burnish_archive_member(input);
    const int is_beside = member && item->level < LEVEL_FOLDERS;
    const char *end = is_beside ? member : cli_base_name(member ? member : input);
    while (is_beside && end > input && end[-1] != '/') {
        --end;
    }
    return (size_t)(end - input);
}

static parts split_path(const batch_item *item) {
    const char *input = item->input;
    const size_t tree = *input == ':' ? 1 : item->level >= LEVEL_FOLDERS ? 0 : item->tree;
    parts p = {.folder = input + tree, .model = cli_model_name(input)};
    p.folder_size = folder_length(item) > tree ? folder_length(item) - tree : 0;
    p.model_size = cli_stem_length(p.model);
    p.extension = p.model[p.model_size] ? p.model + p.model_size + 1 : "";
    return p;
}

static const char placeholders[] = "{model}, {folder}, {extension} and {view}";

static burnish_status expand_one(const batch *b, const batch_item *item, const char *word,
                                 size_t size, name *n, burnish_error *error) {
    const parts p = split_path(item);
    if (size == 5 && memcmp(word, "model", 5) == 0) {
        name_append(n, p.model,
                    item->level == LEVEL_EXTENSION || item->level >= LEVEL_BOTH ? strlen(p.model)
                                                                                : p.model_size);
    } else if (size == 6 && memcmp(word, "folder", 6) == 0) {
        name_append(n, p.folder, p.folder_size);
    } else if (size == 9 && memcmp(word, "extension", 9) == 0) {
        name_append(n, p.extension, strlen(p.extension));
    } else if (size == 4 && memcmp(word, "view", 4) == 0) {
        const char *view = item->view >= 0 ? batch_view_name(b, item) : "view";
        name_append(n, view, strlen(view));
    } else {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--output: \"{%.*s}\" is none of %s",
                        size < 40 ? (int)size : 40, word, placeholders);
    }
    return BURNISH_STATUS_OK;
}

/* Expands the template for an item. */
static burnish_status expand_template(const batch *b, const batch_item *item, name *n,
                                      burnish_error *error) {
    const char *at = b->settings->output;
    n->size = 0;
    n->text[0] = 0;
    if (item->level >= LEVEL_FOLDERS && !strstr(at, "{folder}")) {
        const parts p = split_path(item);
        name_append(n, p.folder, p.folder_size);
    }
    while (*at) {
        const size_t plain = strcspn(at, "{");
        name_append(n, at, plain);
        at += plain;
        const char *end = *at ? strchr(at, '}') : NULL;
        if (*at && !end) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--output: \"%.100s\": a { without }; there are %s",
                            b->settings->output, placeholders);
        }
        if (end) {
            const burnish_status status =
                expand_one(b, item, at + 1, (size_t)(end - at) - 1, n, error);
            if (status != BURNISH_STATUS_OK) {
                return status;
            }
            at = end + 1;
        }
    }
    return BURNISH_STATUS_OK;
}

/* Appends the name to the folder. Empty parts, "." and ".." are dropped to keep the path below the
 * folder. NULL: nothing is left, or the name is too long. */
static char *join_path(const char *folder, const name *n) {
    const size_t length = strlen(folder);
    char *path = malloc(length + n->size + 2);
    size_t used = length, kept = 0;
    if (!path || n->size >= NAME_MAX_BYTES) {
        free(path);
        return NULL;
    }
    memcpy(path, folder, length);
    for (const char *at = n->text; *at;) {
        const size_t size = strcspn(at, "/");
        if (size > 0 && !(size <= 2 && strncmp(at, "..", size) == 0)) {
            if (used > 0 && path[used - 1] != '/') {
                path[used++] = '/';
            }
            memcpy(path + used, at, size);
            used += size;
            ++kept;
        }
        at += size + (at[size] == '/');
    }
    path[used] = 0;
    if (kept == 0 || n->text[n->size - 1] == '/' || strcmp(path, "-") == 0) {
        free(path);
        return NULL;
    }
    return path;
}

static burnish_status name_item(const batch *b, batch_item *item, burnish_error *error) {
    const char *folder = strcmp(b->settings->output_dir, ".") == 0 ? "" : b->settings->output_dir;
    name n;
    const burnish_status status = expand_template(b, item, &n, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    free(item->output);
    item->output = join_path(folder, &n);
    return item->output ? BURNISH_STATUS_OK
                        : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                   "%.200s: --output gives its picture no name that can be used",
                                   item->input);
}

/* ---- Comparing all ---- */

static int compare_inputs(const void *a, const void *b) {
    const batch_item *x = *(batch_item *const *)a, *y = *(batch_item *const *)b;
    const int order = strcmp(x->input, y->input);
    return order ? order : (x > y) - (x < y);
}

static int compare_outputs(const void *a, const void *b) {
    const batch_item *x = *(batch_item *const *)a, *y = *(batch_item *const *)b;
    const int order = strcmp(x->output, y->output);
    return order ? order : (x > y) - (x < y);
}

static void sort_items(const batch *b, batch_item **sorted,
                       int (*compare)(const void *, const void *)) {
    for (size_t i = 0; i < b->list.count; ++i) {
        sorted[i] = &b->list.items[i];
    }
    qsort(sorted, b->list.count, sizeof *sorted, compare);
}

/* Drops repeated inputs; the first one stays. */
static void drop_repeated(batch *b, batch_item **sorted) {
    size_t kept = 0;
    sort_items(b, sorted, compare_inputs);
    for (size_t i = 1; i < b->list.count; ++i) {
        sorted[i]->has_failed = strcmp(sorted[i]->input, sorted[i - 1]->input) == 0;
    }
    for (size_t i = 0; i < b->list.count; ++i) {
        if (b->list.items[i].has_failed) {
            free(b->list.items[i].input);
        } else {
            b->list.items[kept++] = b->list.items[i];
        }
    }
    b->list.count = kept;
}

/* Splits items into one per view if the template contains {view}. */
static burnish_status split_views(batch *b, burnish_error *error) {
    const size_t views = b->settings->render.picture.views.count, count = b->list.count;
    if (!strstr(b->settings->output, "{view}")) {
        return BURNISH_STATUS_OK;
    }
    if (views == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: {view} needs views, such as --views=front,top");
    }
    batch_item *items = calloc(count * views, sizeof *items);
    for (size_t i = 0; items && i < count * views; ++i) {
        items[i] = b->list.items[i / views];
        items[i].view = (int)(i % views);
        items[i].input = strdup(b->list.items[i / views].input);
        if (!items[i].input) {
            for (size_t k = 0; k < i; ++k) {
                free(items[k].input);
            }
            free(items);
            items = NULL;
        }
    }
    if (!items) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the list of pictures");
    }
    for (size_t i = 0; i < count; ++i) {
        free(b->list.items[i].input);
    }
    free(b->list.items);
    b->list = (batch_items){items, count * views, count * views};
    return BURNISH_STATUS_OK;
}

/* One round: items that share an output get longer names. *shared receives one that shared its
 * output, or NULL. */
static burnish_status part_shared(batch *b, batch_item **sorted, batch_item **shared,
                                  burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    *shared = NULL;
    sort_items(b, sorted, compare_outputs);
    for (size_t i = 0; i < b->list.count && status == BURNISH_STATUS_OK;) {
        size_t end = i + 1;
        while (end < b->list.count && strcmp(sorted[end]->output, sorted[i]->output) == 0) {
            ++end;
        }
        for (size_t k = i; end - i > 1 && k < end; ++k) {
            *shared = *shared ? *shared : sorted[k];
            sorted[k]->level += 1;
        }
        i = end;
    }
    for (size_t i = 0; *shared && i < b->list.count && status == BURNISH_STATUS_OK; ++i) {
        status = name_item(b, &b->list.items[i], error);
    }
    return status;
}

static burnish_status check_template(const batch *b, burnish_error *error) {
    const char *text = b->settings->output;
    if (*text == '/' || strncmp(text, "../", 3) == 0 || strstr(text, "/../")) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: \"%.200s\" leads out of --output-dir; name the folder there",
                        text);
    }
    return BURNISH_STATUS_OK;
}

burnish_status batch_name_outputs(batch *b, burnish_error *error) {
    batch_item *shared = NULL;
    burnish_status status = check_template(b, error);
    if (status == BURNISH_STATUS_OK) {
        batch_item **sorted = calloc(b->list.count, sizeof(batch_item *));
        if (!sorted) {
            return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the list of inputs");
        }
        drop_repeated(b, sorted);
        free(sorted);
        status = split_views(b, error);
    }
    batch_item **sorted =
        status == BURNISH_STATUS_OK ? calloc(b->list.count, sizeof(batch_item *)) : NULL;
    for (size_t i = 0; i < b->list.count && sorted && status == BURNISH_STATUS_OK; ++i) {
        status = name_item(b, &b->list.items[i], error);
    }
    for (int round = 0; round < LEVELS && sorted && status == BURNISH_STATUS_OK; ++round) {
        status = part_shared(b, sorted, &shared, error);
    }
    if (status == BURNISH_STATUS_OK && shared) {
        shared->level = LEVEL_PLAIN;
        status = name_item(b, shared, error);
    }
    if (status == BURNISH_STATUS_OK && shared) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--output: \"%.150s\" and another input would both be written to "
                          "\"%.150s\"; put {folder} or {model} into the name",
                          shared->input, shared->output);
    }
    for (size_t i = 0; i < b->list.count && status == BURNISH_STATUS_OK; ++i) {
        batch_item *item = &b->list.items[i];
        item->id =
            XXH64(item->output, strlen(item->output), XXH64(item->input, strlen(item->input), 0));
    }
    free(sorted);
    return status;
}
