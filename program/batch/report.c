/* The report: JSON lines, from which the next run detects unchanged items. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#ifndef _WIN32
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include "base/cli/file.h"
#include "base/cli/output.h"
#include "base/cli/platform.h"
#include "batch/batch.h"
#include "batch/types.h"
#include "cli/input.h"
#include "render/output/result.h"

/* ---- Reading ---- */

static int compare_lines(const void *a, const void *b) {
    const struct batch_past_line *x = a, *y = b;
    return x->id != y->id ? (x->id > y->id) - (x->id < y->id)
                          : (x->number > y->number) - (x->number < y->number);
}

const struct batch_past_line *batch_past_line(const batch_past *past, uint64_t id) {
    size_t low = 0, high = past->count;
    while (low < high) { /* the first line beyond id; the last line of an id counts */
        const size_t middle = low + (high - low) / 2;
        if (past->lines[middle].id <= id) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low > 0 && past->lines[low - 1].id == id ? &past->lines[low - 1] : NULL;
}

const char *batch_text(const cJSON *line, const char *key) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(line, key);
    return cJSON_IsString(item) ? item->valuestring : "";
}

double batch_number(const cJSON *line, const char *key) {
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(line, key);
    return cJSON_IsNumber(item) ? item->valuedouble : 0;
}

static burnish_status fail_memory(burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the report");
}

static int add_line(batch_past *past, uint64_t id, const char *line, int is_same) {
    if (past->count == past->capacity) {
        const size_t capacity = past->capacity > 0 ? 2 * past->capacity : 1024;
        struct batch_past_line *grown = capacity <= UINT32_MAX / sizeof *grown
                                            ? realloc(past->lines, capacity * sizeof *grown)
                                            : NULL;
        if (!grown) {
            return 0;
        }
        past->lines = grown;
        past->capacity = capacity;
    }
    const uint32_t number = (uint32_t)past->count;
    past->lines[past->count++] = (struct batch_past_line){id, line, number, is_same};
    return 1;
}

/* Whether a line begins a report with the same flags and version. The number of ignored files may
 * follow them. */
static int is_head(const char *line, const char *head) {
    const size_t size = strlen(head) - 1; /* without the brace */
    return strncmp(line, head, size) == 0 &&
           (strcmp(line + size, "}") == 0 || strncmp(line + size, ",\"passed_over\":", 15) == 0);
}

/* Lists the lines of a text, except an incomplete last one. */
static int list_lines(batch_past *past, char *text, const char *head) {
    int is_same = 0;
    for (char *line = text; line;) {
        char *end = strchr(line, '\n');
        unsigned long long id;
        if (end) {
            *end = 0;
        }
        if (end && sscanf(line, "{\"id\":\"%16llx\"", &id) == 1) {
            if (!add_line(past, id, line, is_same)) {
                return 0;
            }
        } else if (end) {
            is_same = is_head(line, head);
        }
        line = end ? end + 1 : NULL;
    }
    return 1;
}

/* Takes ownership of the path. A missing file is not an error. */
static burnish_status read_report(batch *b, char *path, const char *head, burnish_error *error) {
    batch_past *past = &b->past;
    uint8_t *bytes;
    size_t size;
    burnish_error unread;
    cli_read_bytes(path ? path : b->report, UINT64_MAX, NULL, &bytes, &size, &unread);
    char *text = (char *)bytes;
    if (text && *text && strncmp(text, "{\"burnish\":", 11) != 0) {
        const int is_own = path == NULL;
        free(text);
        free(path);
        return is_own ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                 "--report: \"%.300s\" exists but is not a report of burnish "
                                 "batch; name another file",
                                 b->report)
                      : BURNISH_STATUS_OK;
    }
    past->texts[past->text_count] = text;
    past->paths[past->text_count++] = path;
    return !text || list_lines(past, text, head) ? BURNISH_STATUS_OK : fail_memory(error);
}

/* ---- Reports of parts ---- */

#ifdef _WIN32

burnish_status batch_read_past(batch *b, burnish_error *error) {
    (void)b;
    return fail_memory(error);
}

#else

/* A report; path NULL: the one that this run will write. */
typedef struct found {
    char *path;
    struct timespec changed;
} found;

static int compare_ages(const void *a, const void *b) {
    const found *x = a, *y = b;
    return x->changed.tv_sec != y->changed.tv_sec
               ? (x->changed.tv_sec > y->changed.tv_sec) - (x->changed.tv_sec < y->changed.tv_sec)
               : (x->changed.tv_nsec > y->changed.tv_nsec) -
                     (x->changed.tv_nsec < y->changed.tv_nsec);
}

static int is_whole(const struct dirent *entry) {
    return strcmp(entry->d_name, "burnish-batch.jsonl") == 0;
}

static int is_part_or_whole(const struct dirent *entry) {
    int index, count, end = 0;
    const char *name = entry->d_name;
    return is_whole(entry) ||
           (sscanf(name, "burnish-batch-%d-of-%d.jsonl%n", &index, &count, &end) == 2 && end > 0 &&
            name[end] == 0);
}

/* Finds reports in the output folder, oldest first: the main report and, unless this run is a part,
 * the reports of parts. --report disables the search. NULL: out of memory. */
static found *find_reports(const batch *b, size_t *count) {
    struct dirent **entries = NULL;
    const char *folder = b->settings->output_dir, *own = cli_base_name(b->report);
    const int entry_count =
        b->settings->report
            ? 0
            : scandir(folder, &entries, b->settings->part.count > 0 ? is_whole : is_part_or_whole,
                      NULL);
    found *reports = calloc((size_t)(entry_count > 0 ? entry_count : 0) + 1, sizeof *reports);
    *count = 0;
    for (int i = 0; i < entry_count; ++i) {
        char *path = reports && strcmp(entries[i]->d_name, own) != 0
                         ? cli_join_path(folder, entries[i]->d_name)
                         : NULL;
        struct stat state;
        if (path && stat(path, &state) == 0) {
            reports[(*count)++] = (found){path, state.st_mtim};
        } else {
            free(path);
        }
        free(entries[i]);
    }
    free(entries);
    if (reports) {
        struct stat state = {0};
        stat(b->report, &state);
        reports[(*count)++] = (found){NULL, state.st_mtim};
        qsort(reports, *count, sizeof *reports, compare_ages);
    }
    return reports;
}

burnish_status batch_read_past(batch *b, burnish_error *error) {
    batch_past *past = &b->past;
    size_t count = 0;
    if (!b->report || b->settings->is_render || strcmp(b->report, "-") == 0) {
        return BURNISH_STATUS_OK;
    }
    char *head = batch_head_line(b);
    found *reports = head ? find_reports(b, &count) : NULL;
    past->texts = reports ? calloc(count, sizeof *past->texts) : NULL;
    past->paths = reports ? calloc(count, sizeof *past->paths) : NULL;
    burnish_status status = past->texts && past->paths ? BURNISH_STATUS_OK : fail_memory(error);
    for (size_t i = 0; i < count; ++i) {
        if (status == BURNISH_STATUS_OK) {
            status = read_report(b, reports[i].path, head, error);
        } else {
            free(reports[i].path);
        }
    }
    if (past->count > 0) {
        qsort(past->lines, past->count, sizeof *past->lines, compare_lines);
    }
    free(reports);
    free(head);
    return status;
}

void batch_remove_past_parts(const batch *b) {
    for (size_t i = 0; i < b->past.text_count && b->settings->part.count == 0; ++i) {
        if (b->past.paths[i]) {
            unlink(b->past.paths[i]);
        }
    }
}

#endif

void batch_release_past(batch_past *past) {
    for (size_t i = 0; i < past->text_count; ++i) {
        free(past->texts[i]);
        free(past->paths[i]);
    }
    free(past->texts);
    free(past->paths);
    free(past->lines);
}

/* ---- Writing ---- */

void batch_add_hash(cJSON *object, const char *key, uint64_t hash, int *failed) {
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    cli_json_add(object, key, cJSON_CreateString(text), failed);
}

char *batch_head_line(const batch *b) {
    int failed = 0;
    cJSON *object = cJSON_CreateObject();
    cli_json_add(object, "burnish", cJSON_CreateString(burnish_version()), &failed);
    cli_json_add(object, "options", cli_json_text(b->options), &failed);
    if (b->options_hash != 0) {
        batch_add_hash(object, "options_hash", b->options_hash, &failed);
    }
    return cli_json_string(object, failed, 0);
}

void batch_add_seconds(const batch *b, cJSON *object, double seconds, int *failed) {
    if (!b->settings->no_seconds) {
        cJSON *times = cJSON_CreateObject();
        cli_json_add(times, "total", cli_json_seconds(seconds), failed);
        cli_json_add(object, "seconds", times, failed);
    }
}

void batch_add_names(const batch_item *item, cJSON *object, int *failed) {
    cli_json_add(object, "input", cli_json_text(item->input), failed);
    if (!cli_is_utf8(item->input)) {
        cli_json_add(object, "input_bytes", cli_json_bytes(item->input), failed);
    }
    cli_json_add(object, "output", cli_json_text(item->output), failed);
    if (!cli_is_utf8(item->output)) {
        cli_json_add(object, "output_bytes", cli_json_bytes(item->output), failed);
    }
}

char *batch_failed_line(const batch *b, const batch_item *item, int code, const char *message,
                        double seconds) {
    int failed = 0;
    if (b->settings->is_render) {
        cJSON *line = render_describe_failure(item->input, code, message, seconds, &failed);
        return cli_json_string(line, failed, 0);
    }
    cJSON *object = cJSON_CreateObject();
    batch_add_hash(object, "id", item->id, &failed);
    batch_add_names(item, object, &failed);
    cli_json_add_outcome(object, code, message, &failed);
    cli_json_add(object, "bytes", cli_json_count((size_t)item->bytes), &failed);
    batch_add_seconds(b, object, seconds, &failed);
    return cli_json_string(object, failed, 0);
}

burnish_status batch_write_report(batch *b, burnish_error *error) {
    char *text = NULL, *head = b->report ? batch_head_line(b) : NULL;
    size_t size = 0;
    if (!b->report) {
        return BURNISH_STATUS_OK;
    }
    FILE *stream = cli_open_memory(&text, &size);
    burnish_status status = BURNISH_STATUS_OK;
    if (stream && head && !b->settings->is_render) {
        fprintf(stream, "%.*s", (int)strlen(head) - 1, head);
        if (b->passed_over > 0) {
            fprintf(stream, ",\"passed_over\":%zu", b->passed_over);
        }
        fprintf(stream, "}\n");
    }
    for (size_t i = 0; i < b->list.count && stream; ++i) {
        if (b->list.items[i].line) {
            fprintf(stream, "%s\n", b->list.items[i].line);
        }
    }
    if (!stream || cli_close_memory(stream, &text, &size) != 0 || !head) {
        status = fail_memory(error);
    } else {
        status = cli_file_write(b->report, text, size, error);
    }
    free(text);
    free(head);
    return status;
}
