#include "render/scene/join_inputs.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/cli/options.h"
#include "base/cli/output.h"
#include "base/inputs.h"

static burnish_status fail_file(const char *input, const char *why, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--scene: %.200s: %s", input, why);
}

static burnish_status check_file(const char *input, const cli_input *load, burnish_error *error) {
    struct stat state;
    if (*input == ':' || strcmp(input, "-") == 0 || burnish_archive_member(input)) {
        return fail_file(input, "is no file; only files can be joined", error);
    }
    if (stat(input, &state) != 0) {
        return cli_fail(error, BURNISH_STATUS_READ, "%.200s: can't be opened: %s", input,
                        strerror(errno));
    }
    return S_ISDIR(state.st_mode) ? fail_file(input, "is a folder; name its files", error)
           : load->format != BURNISH_FORMAT_AUTO
               ? fail_file(input, "not with --input-format; omit it", error)
               : BURNISH_STATUS_OK;
}

/* The deepest folder that contains all inputs, links followed; NULL with errno set. */
static char *find_root(const cli_call *call) {
#if defined(_WIN32) || defined(__wasm__)
    (void)call;
    errno = ENOSYS;
    return NULL;
#else
    static char root[BURNISH_INPUT_PATH + 1];
    int is_first = 1;
    for (size_t i = 0; i < call->argument_count; ++i) {
        if (call->arguments[i].flag) {
            continue;
        }
        char *folder = strdup(call->arguments[i].text),
             *slash = folder ? strrchr(folder, '/') : NULL;
        char path[BURNISH_INPUT_PATH];
        if (slash) {
            slash[1] = 0;
        }
        const char *found = folder ? realpath(slash ? folder : ".", path) : NULL;
        free(folder);
        if (!found) {
            return NULL;
        }
        size_t same = 0, end = 0; /* both end in "/" to be compared */
        snprintf(path + strlen(path), sizeof path - strlen(path), "%s", path[1] ? "/" : "");
        for (; !is_first && root[same] && root[same] == path[same]; ++same) {
            end = path[same] == '/' ? same + 1 : end;
        }
        if (is_first) {
            strcpy(root, path);
        } else {
            root[end] = 0;
        }
        is_first = 0;
    }
    return root;
#endif
}

/* The path from the first input's folder to an input. Returns 0, or an errno. */
static int find_path(const char *root, const char *first, const char *input,
                     char path[2 * BURNISH_INPUT_PATH]) {
    char from[BURNISH_INPUT_PATH], to[BURNISH_INPUT_PATH];
    const char *slash = strrchr(input, '/');
    int code = burnish_folder_below(root, first, from);
    code = code == 0 ? burnish_folder_below(root, input, to) : code;
    if (code != 0) {
        return code;
    }
    size_t used = 0;
    for (const char *c = from; *c && strcmp(from, to) != 0; c += strcspn(c, "/"), c += *c == '/') {
        used += (size_t)snprintf(path + used, 4, "../");
    }
    const char *below = strcmp(from, to) == 0 ? "" : to;
    snprintf(path + used, 2 * BURNISH_INPUT_PATH - used, "%s%s%s", below, *below ? "/" : "",
             slash ? slash + 1 : input);
    return 0;
}

/* {"file": PATH} */
static burnish_status add_item(cJSON *items, const cli_call *call, const char *input,
                               const char *root, burnish_error *error) {
    char path[2 * BURNISH_INPUT_PATH];
    int failed = 0;
    const int code = find_path(root, call->operands[0], input, path);
    if (code != 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--root: %.200s: %s", input,
                        burnish_root_fault(code));
    }
    cJSON *item = cJSON_CreateObject();
    cli_json_add(item, "file", cJSON_CreateString(path), &failed);
    if (!cJSON_AddItemToArray(items, item) || failed) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the inputs");
    }
    return BURNISH_STATUS_OK;
}

burnish_status render_join_inputs(const cli_call *call, cli_input *load, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    cJSON *scene = cJSON_CreateObject(), *items = cJSON_CreateArray();
    int failed = 0;
    cli_json_add(scene, "burnish_scene", cJSON_CreateNumber(1), &failed);
    cli_json_add(scene, "items", items, &failed);
    for (int are_checked = 0; are_checked < 2 && !failed; ++are_checked) {
        for (size_t i = 0; i < call->argument_count && status == BURNISH_STATUS_OK; ++i) {
            const char *input = call->arguments[i].text;
            if (!call->arguments[i].flag) {
                status = are_checked ? add_item(items, call, input, load->root, error)
                                     : check_file(input, load, error);
            }
        }
        if (status == BURNISH_STATUS_OK && !load->root) {
            load->root = find_root(call);
            status = load->root
                         ? status
                         : cli_fail(error, BURNISH_STATUS_READ,
                                    "--scene: the folders of the inputs: %s", strerror(errno));
        }
    }
    load->items = status == BURNISH_STATUS_OK && !failed ? cJSON_PrintUnformatted(scene) : NULL;
    cJSON_Delete(scene);
    return status != BURNISH_STATUS_OK || load->items
               ? status
               : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the inputs");
}

void render_release_inputs(cli_input *load) {
    cJSON_free((void *)(uintptr_t)load->items);
    load->items = NULL;
}
