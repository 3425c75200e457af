/* A runner: one process per core. It reads inputs only to hash them; a worker, forked for one item,
 * parses and draws. */
#include <stdlib.h>
#include <string.h>

#include "batch/batch.h"
#include "batch/types.h"

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/cli/output.h"
#include "base/cli/platform.h"
#include "base/cli/process.h"
#include "base/clock.h"
#include "base/inputs.h"
#include "cli/contents.h"
#include "cli/limits.h"
#include "cli/main.h"
#include "import/importers.h"
#include "render/output/result.h"
#include "render/render.h"
#include "sandbox/channel.h"
#include "sandbox/lock.h"
#include "sandbox/process.h"

enum { WARNINGS_MAX = 8, WARNING_BYTES = 240, FILES_MAX = 64, PLATES_MAX = 64, FILAMENTS_MAX = 64 };
enum { REPORT_BYTES = 1 << 20 };

/* A worker's results, in memory that it shares with its runner. The runner does not trust them and
 * checks them before use. */
typedef struct facts {
    uint64_t picture, triangles, vertices;
    float size[3];
    char unit[16], format[16];
    double volume, area;
    uint64_t open_edges, shells;
    int32_t is_measured, is_closed, is_solid;
    int32_t is_drawn, width, height, is_blank, is_legible;
    uint32_t warning_count, unmet, plate_count, filament_count;
    struct {
        int32_t number, is_used;
        char name[BURNISH_NAME_SIZE];
        float size[3];
    } plates[PLATES_MAX];
    uint8_t filaments[FILAMENTS_MAX][3];
    char warnings[WARNINGS_MAX][WARNING_BYTES];
    char message[480];
} facts;

/* The referenced files that a worker requested. */
typedef struct files {
    char *names[FILES_MAX];
    size_t count;
    int are_too_many;
    uint64_t hash; /* of names and bytes, in order */
} files;

typedef struct runner {
    const batch *b;
    facts *shared;
    char *report; /* REPORT_BYTES after *shared: the line of `burnish render --json`, if wanted */
} runner;

/* ---- Hashes ---- */

/* Hashes an open file. Returns 0, with errno set, if it is not a regular file or can't be read. */
static int hash_open_file(int file, uint64_t *hash, uint64_t seed) {
    static char buffer[1 << 13]; /* its pages fault again after each worker's fork */
    struct stat state;
    XXH64_state_t hasher;
    ssize_t size = -1;
    off_t at = 0;
    XXH64_reset(&hasher, seed);
    if (fstat(file, &state) == 0 && S_ISREG(state.st_mode)) {
        for (; (size = pread(file, buffer, sizeof buffer, at)) > 0; at += size) {
            XXH64_update(&hasher, buffer, (size_t)size);
        }
    } else {
        errno = EINVAL;
    }
    *hash = XXH64_digest(&hasher);
    return size == 0;
}

int batch_hash_file(const char *path, uint64_t *hash, uint64_t seed) {
    const int file = burnish_open_input(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (file < 0) {
        return 0;
    }
    const int is_read = hash_open_file(file, hash, seed), code = errno;
    close(file);
    errno = code;
    return is_read;
}

static uint64_t hash_text(const char *text, uint64_t seed) {
    return XXH64(text, strlen(text), seed);
}

static void release_files(files *f) {
    for (size_t i = 0; i < f->count; ++i) {
        free(f->names[i]);
    }
    *f = (files){0};
}

static void record_file(void *context, const char *name, int file) {
    files *f = context;
    char *copy = f->count < FILES_MAX ? strdup(name) : NULL;
    if (!copy) {
        f->are_too_many = 1;
        return;
    }
    f->names[f->count++] = copy;
    const uint64_t seed = hash_text(name, f->hash);
    f->hash = file >= 0 && hash_open_file(file, &f->hash, seed) ? f->hash : seed + 1;
}

/* ---- What is unchanged ---- */

static int is_hash(const char *text, uint64_t hash) {
    char expected[17];
    snprintf(expected, sizeof expected, "%016llx", (unsigned long long)hash);
    return strcmp(text, expected) == 0;
}

/* Whether the files listed in the line still have the recorded hash. */
static int has_same_files(const cJSON *line, const char *input, const char *root) {
    const cJSON *names = cJSON_GetObjectItemCaseSensitive(line, "files"), *name;
    const size_t folder = (size_t)(cli_base_name(input) - input);
    uint64_t hash = 0;
    cJSON_ArrayForEach(name, names) {
        static char path[8192]; /* most batches need none */
        if (!cJSON_IsString(name) ||
            snprintf(path, sizeof path, "%.*s%s%s", root ? (int)strlen(root) : (int)folder,
                     root ? root : input, root ? "/" : "", name->valuestring) >= (int)sizeof path) {
            return 0;
        }
        uint64_t next = hash_text(name->valuestring, hash);
        hash = batch_hash_file(path, &hash, next) ? hash : next + 1;
    }
    return !names || is_hash(batch_text(line, "files_hash"), hash);
}

/* Whether the line of an earlier run, or NULL, still applies. */
static int is_unchanged(const batch *b, const batch_item *item, const struct batch_past_line *past,
                        uint64_t hash) {
    struct stat state;
    if (!past || !past->is_same || b->settings->force || stat(item->output, &state) != 0 ||
        state.st_size == 0) {
        return 0;
    }
    cJSON *object = cJSON_Parse(past->line);
    const int is_same = object && strcmp(batch_text(object, "status"), "done") == 0 &&
                        is_hash(batch_text(object, "input_hash"), hash) &&
                        !cJSON_HasObjectItem(object, "uncertain") &&
                        has_same_files(object, item->input, b->settings->render.input.load.root);
    cJSON_Delete(object);
    return is_same;
}

/* ---- The worker ---- */

/* The first of the plates and filaments of a print project. */
static void record_contents(facts *f, const burnish_mesh *mesh) {
    const burnish_contents *c = burnish_mesh_get_contents(mesh);
    burnish_box *boxes = c->plate_count > 0 ? cli_bound_parts(mesh) : NULL;
    for (size_t i = 0; i < c->plate_count && i < PLATES_MAX && boxes; ++i) {
        const burnish_box box = cli_bound_plate(mesh, boxes, c->plates[i].number);
        f->plates[i].number = c->plates[i].number;
        f->plates[i].is_used = cli_box_size(&box, f->plates[i].size);
        memcpy(f->plates[i].name, c->plates[i].name, BURNISH_NAME_SIZE);
        f->plate_count = (uint32_t)i + 1;
    }
    free(boxes);
    for (size_t i = 0; i < c->filament_count && i < FILAMENTS_MAX; ++i) {
        memcpy(f->filaments[i], c->filaments[i].srgb, 3);
        f->filament_count = (uint32_t)i + 1;
    }
}

static void record_result(void *context, const render_result *result) {
    const runner *r = context;
    facts *f = r->shared;
    const burnish_mesh_info *info = burnish_mesh_get_info(result->mesh);
    const burnish_mesh_view *view = burnish_mesh_get_view(result->mesh);
    char extension[IMPORT_EXTENSION_SIZE];
    f->picture = result->hash;
    f->triangles = view->triangle_count;
    f->vertices = view->vertex_count;
    snprintf(f->format, sizeof f->format, "%s",
             import_format_word(result->settings->input.name, result->settings->input.load.format,
                                info, extension));
    f->width = result->picture->width;
    f->height = result->picture->height;
    f->is_blank = result->blank_cells > 0;
    f->is_legible = result->faulty_cells == 0;
    float low[3], high[3];
    burnish_mesh_get_bounds(result->mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        f->size[k] = high[k] - low[k];
    }
    snprintf(f->unit, sizeof f->unit, "%s", info->unit ? info->unit : "");
    const burnish_mesh_facts *measured = burnish_mesh_get_facts(result->mesh);
    if (measured) {
        f->is_measured = 1;
        f->volume = measured->volume;
        f->area = measured->area;
        f->open_edges = measured->open_edge_count;
        f->shells = measured->shell_count;
        f->is_closed = measured->is_closed;
        f->is_solid = measured->is_solid;
    }
    for (size_t i = 0; i < result->warnings.count && i < WARNINGS_MAX; ++i) {
        snprintf(f->warnings[i], WARNING_BYTES, "%s", result->warnings.lines[i]);
        f->warning_count = (uint32_t)i + 1;
    }
    record_contents(f, result->mesh);
    f->unmet = result->unmet;
    f->is_drawn = 1;
    if (result->settings->job.is_reported) {
        char *line = render_json_line(result);
        if (!line || snprintf(r->report, REPORT_BYTES, "%s", line) >= REPORT_BYTES) {
            f->is_drawn = 0;
            snprintf(f->message, sizeof f->message, "its report is too long; draw it alone");
        }
        free(line);
    }
}

/* The settings of one item; is_ours: an earlier run has drawn it. */
static void set_item(const batch *b, const batch_item *item, int is_ours,
                     render_settings *settings) {
    *settings = b->settings->render;
    settings->input.name = item->input;
    settings->output.path = item->output;
    settings->output.overwrite |= is_ours;
    settings->output.is_derived = 1; /* the existing file may be a texture */
    if (item->view >= 0) {
        settings->picture.views.items[0] = settings->picture.views.items[item->view];
        settings->picture.views.count = 1;
    }
    settings->job.quiet = settings->job.is_one_of_many = 1;
    settings->job.threads = 1;
    settings->job.is_reported = b->settings->is_render && b->report;
    settings->job.on_result = record_result;
}

/* Draws, then ends the process with the exit code of `burnish render`. */
__attribute__((noreturn)) static void draw(const runner *r, const batch_item *item, int is_ours) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    int code = 0;
    burnish_status status = cli_limit_memory(r->b->settings->render.job.max_memory, &error);
    cli_prepare_memory();
    render_settings *settings = malloc(sizeof *settings);
    status = settings ? status
                      : cli_fail(&error, BURNISH_STATUS_MEMORY, "out of memory for the settings");
    if (status == BURNISH_STATUS_OK) {
        set_item(r->b, item, is_ours, settings);
        settings->job.user_data = (void *)(uintptr_t)r;
        status = render_finish(settings, &error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_run(settings, &code, &error);
    }
    if (status != BURNISH_STATUS_OK) {
        snprintf(r->shared->message, sizeof r->shared->message, "%s", error.text);
        code = burnish_status_exit_code(status);
    }
    _exit(code);
}

/* Forks a worker without a sandbox, which opens files itself, and waits for it. *code is -1 in it. */
static burnish_status run_plainly(int *code, burnish_error *ended, burnish_error *error) {
    const pid_t worker = cli_fork(&(cli_plan){.ended_by = SIGKILL});
    if (worker == 0) {
        cli_limit_worker(cli_seconds_given());
        *code = -1;
        return BURNISH_STATUS_OK;
    }
    if (worker < 0) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "no process: %s", strerror(errno));
    }
    cli_limit_child(worker);
    const int state = cli_wait_child(worker);
    *code = WIFEXITED(state) ? WEXITSTATUS(state) : 1;
    if (!WIFEXITED(state)) {
        cli_fail(ended, BURNISH_STATUS_FORMAT, "the program ended by signal %d (%s)",
                 WTERMSIG(state), strsignal(WTERMSIG(state)));
    }
    return BURNISH_STATUS_OK;
}

/* Forks the worker and waits for it. *code receives its exit code, *line the reason for a failure. */
static burnish_status run_worker(const runner *r, const batch_item *item, int is_ours, files *seen,
                                 int *code, int *is_late, burnish_error *line) {
    const render_settings *settings = &r->b->settings->render;
    burnish_error error = {BURNISH_STATUS_OK, ""}, ended = {BURNISH_STATUS_OK, ""};
    const sandbox_plan plan = {.input = item->input,
                               .root = settings->input.load.root,
                               .format = settings->input.load.format,
                               .outputs = {item->output},
                               .output_count = 1,
                               .max_input_bytes = settings->input.load.max_input_bytes,
                               .max_memory = settings->job.max_memory,
                               .record_file = record_file,
                               .context = seen,
                               .ended = &ended};
    memset(r->shared, 0, sizeof *r->shared);
    *r->report = 0;
    cli_limit_child_seconds(settings->job.max_seconds.value);
    cli_set_child_memory(settings->job.max_memory);
    burnish_status status = settings->job.sandbox ? sandbox_begin(&plan, code, &error)
                                                  : run_plainly(code, &ended, &error);
    if (status == BURNISH_STATUS_OK && *code < 0) {
        draw(r, item, is_ours);
    }
    cli_limit_child_seconds(0);
    *is_late =
        status == BURNISH_STATUS_OK && settings->job.max_seconds.value > 0 && cli_child_was_late();
    if (*is_late) {
        cli_fail_late(cli_child_was_late(), settings->job.max_seconds.value, &ended);
        status = cli_fail(&error, ended.status, "%.300s: %s", item->input, ended.text);
    } else if (status == BURNISH_STATUS_OK && ended.text[0]) {
        status = cli_fail(&error, ended.status, "%.150s: %.300s", item->input, ended.text);
    }
    if (status != BURNISH_STATUS_OK) {
        *code = burnish_status_exit_code(status);
    }
    *line = error;
    return status;
}

/* ---- Items ---- */

int batch_make_folders(const char *path) {
    char *copy = strdup(path);
    int is_made = copy != NULL;
    for (char *slash = copy ? strchr(copy + 1, '/') : NULL; slash && is_made;
         slash = strchr(slash + 1, '/')) {
        *slash = 0;
        is_made = mkdir(copy, 0777) == 0 || errno == EEXIST;
        *slash = '/';
    }
    free(copy);
    return is_made;
}

static void add_warnings(cJSON *object, facts *f, int *failed) {
    cJSON *array = cJSON_CreateArray();
    for (uint32_t i = 0; i < f->warning_count && i < WARNINGS_MAX; ++i) {
        f->warnings[i][WARNING_BYTES - 1] = 0;
        cli_clean(f->warnings[i]);
        cli_json_add(array, NULL, cli_json_text(f->warnings[i]), failed);
    }
    cli_json_add(object, "warnings", array, failed);
}

static void add_contents(cJSON *object, facts *f, int *failed) {
    cJSON *plates = cJSON_CreateArray(), *filaments = cJSON_CreateArray();
    for (uint32_t i = 0; i < f->plate_count && i < PLATES_MAX; ++i) {
        cJSON *row = cJSON_CreateObject();
        char *name = f->plates[i].name;
        name[BURNISH_NAME_SIZE - 1] = 0;
        cli_clean(name);
        cli_json_add(row, "number", cJSON_CreateNumber(f->plates[i].number), failed);
        cli_json_add(row, "name", cli_json_text(name), failed);
        cli_json_add(row, "size",
                     f->plates[i].is_used ? cli_json_floats(3, f->plates[i].size)
                                          : cJSON_CreateNull(),
                     failed);
        cli_json_add(plates, NULL, row, failed);
    }
    for (uint32_t i = 0; i < f->filament_count && i < FILAMENTS_MAX; ++i) {
        const uint8_t *srgb = f->filaments[i];
        char text[8];
        snprintf(text, sizeof text, "#%02X%02X%02X", srgb[0], srgb[1], srgb[2]);
        cli_json_add(filaments, NULL, cJSON_CreateString(text), failed);
    }
    if (f->plate_count > 0) {
        cli_json_add(object, "plates", plates, failed);
    } else {
        cJSON_Delete(plates);
    }
    if (f->filament_count > 0) {
        cli_json_add(object, "filaments", filaments, failed);
    } else {
        cJSON_Delete(filaments);
    }
}

/* Results of measuring, if any. */
static void add_facts(const batch *b, cJSON *object, facts *f, int *failed) {
    f->unit[sizeof f->unit - 1] = 0;
    cli_clean(f->unit);
    if (*f->unit) {
        cli_json_add(object, "unit", cli_json_text(f->unit), failed);
    }
    if (b->settings->render.input.measure && f->is_measured) {
        cli_json_add(object, "volume", cli_json_real(f->volume), failed);
        cli_json_add(object, "area", cli_json_real(f->area), failed);
        cli_json_add(object, "closed", cJSON_CreateBool(f->is_closed != 0), failed);
        cli_json_add(object, "solid", cJSON_CreateBool(f->is_solid != 0), failed);
        cli_json_add(object, "open_edges", cli_json_count((size_t)f->open_edges), failed);
        cli_json_add(object, "shells", cli_json_count((size_t)f->shells), failed);
    }
}

#ifndef O_PATH
#define O_PATH O_RDONLY
#endif

/* Opens a folder of an output, and creates it if it is missing. A link fails with ELOOP. */
static int open_part(int at, const char *part) {
    struct stat state;
    if (mkdirat(at, part, 0777) == 0 || errno == EEXIST) {
        const int next = openat(at, part, O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        const int code = errno;
        if (next >= 0) {
            return next;
        }
        errno = fstatat(at, part, &state, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(state.st_mode)
                    ? ELOOP
                    : code;
    }
    return -1;
}

/* Creates the missing folders of an output. --output-dir may be a link, but below it none is
 * followed: pictures stay there. */
static burnish_status make_output_folders(const batch *b, const char *output,
                                          burnish_error *error) {
    const char *folder = b->settings->output_dir;
    const size_t length = strcmp(folder, ".") == 0 ? 0 : strlen(folder);
    char *copy = strdup(output), *part = copy ? copy + length : NULL;
    int at = -1;
    if (part) {
        part += *part == '/';
        char first = *part;
        *part = 0;
        at = length == 0 || batch_make_folders(copy)
                 ? open(length == 0 ? "." : copy, O_PATH | O_DIRECTORY | O_CLOEXEC)
                 : -1;
        *part = first;
    }
    for (char *slash; at >= 0 && (slash = strchr(part, '/')) != NULL; part = slash + 1) {
        *slash = 0;
        const int next = open_part(at, part), code = errno;
        close(at);
        errno = code;
        at = next;
    }
    const int code = errno;
    free(copy);
    if (at >= 0) {
        close(at);
        return BURNISH_STATUS_OK;
    }
    return code == ELOOP ? cli_fail(error, BURNISH_STATUS_WRITE,
                                    "%.300s: one of its folders is a link, which can lead out of "
                                    "--output-dir; remove the link",
                                    output)
                         : cli_fail(error, BURNISH_STATUS_WRITE, "%.300s: no folder for it: %s",
                                    output, strerror(code));
}

static char *done_line(const batch *b, const batch_item *item, uint64_t hash, facts *f,
                       const files *seen, double seconds) {
    f->format[sizeof f->format - 1] = 0;
    cli_clean(f->format);
    int failed = 0;
    cJSON *object = cJSON_CreateObject();
    batch_add_hash(object, "id", item->id, &failed);
    batch_add_names(item, object, &failed);
    cli_json_add_outcome(object, 0, NULL, &failed);
    cli_json_add(object, "bytes", cli_json_count((size_t)item->bytes), &failed);
    batch_add_hash(object, "input_hash", hash, &failed);
    batch_add_hash(object, "hash", f->picture, &failed);
    cli_json_add(object, "format", cli_json_text(f->format), &failed);
    cli_json_add(object, "triangles", cli_json_count((size_t)f->triangles), &failed);
    cli_json_add(object, "vertices", cli_json_count((size_t)f->vertices), &failed);
    cli_json_add(object, "size", cli_json_floats(3, f->size), &failed);
    add_facts(b, object, f, &failed);
    add_contents(object, f, &failed);
    cli_json_add(object, "width", cJSON_CreateNumber(f->width), &failed);
    cli_json_add(object, "height", cJSON_CreateNumber(f->height), &failed);
    cli_json_add(object, "blank", cJSON_CreateBool(f->is_blank != 0), &failed);
    cli_json_add(object, "legible", cJSON_CreateBool(f->is_legible != 0), &failed);
    add_warnings(object, f, &failed);
    if (seen->count > 0) {
        cli_json_add(object, "files", cli_json_texts(seen->count, seen->names), &failed);
        batch_add_hash(object, "files_hash", seen->hash, &failed);
    }
    if (seen->are_too_many) { /* too many to check whether they are unchanged */
        cli_json_add(object, "uncertain", cJSON_CreateTrue(), &failed);
    }
    batch_add_seconds(b, object, seconds, &failed);
    return cli_json_string(object, failed, 0);
}

/* The line of `burnish render --json`; NULL if the worker wrote no such thing. It is not printed
 * again, because cJSON rounds. */
static char *render_line(const runner *r) {
    r->report[REPORT_BYTES - 1] = 0;
    cli_clean(r->report);
    cJSON *object = cJSON_Parse(r->report);
    char *line = object ? strdup(r->report) : NULL;
    cJSON_Delete(object);
    return line;
}

/* Returns the line, to be freed, and fills *reply, which is sent before it. */
static char *run_item(runner *r, uint32_t index, batch_reply *reply) {
    const batch_item *item = &r->b->list.items[index];
    const struct batch_past_line *past = batch_past_line(&r->b->past, item->id);
    const double start = burnish_seconds_now();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    files seen = {0};
    uint64_t hash = 0;
    int code = 0, is_late = 0;
    burnish_status status = BURNISH_STATUS_OK;
    if (*item->input != ':' && !batch_hash_file(item->input, &hash, 0)) {
        status = cli_fail(&error, BURNISH_STATUS_READ, "%.300s: can't be read: %s", item->input,
                          errno == EINVAL ? "it is no file" : cli_open_reason(item->input, errno));
    }
    *reply = (batch_reply){.index = index};
    if (status == BURNISH_STATUS_OK && is_unchanged(r->b, item, past, hash)) {
        reply->is_kept = 1;
        return strdup(past->line);
    }
    r->shared->is_drawn = 0;
    if (status == BURNISH_STATUS_OK) {
        status = make_output_folders(r->b, item->output, &error);
    }
    code = burnish_status_exit_code(status);
    if (status == BURNISH_STATUS_OK) {
        status = run_worker(r, item, past != NULL, &seen, &code, &is_late, &error);
    }
    facts *result = r->shared; /* nothing else has it any more */
    reply->unmet = result->unmet;
    result->message[sizeof result->message - 1] = 0;
    if (status == BURNISH_STATUS_OK && code == 0 && !result->is_drawn) {
        code = 1; /* ended by a crash or the sandbox */
    }
    if (status == BURNISH_STATUS_OK && code != 0) {
        cli_fail(&error, BURNISH_STATUS_FORMAT, "%s",
                 code == CLI_EXIT_BLANK ? "the picture is blank (--fail-on-blank)"
                 : result->message[0]   ? result->message
                                        : "the program that draws ended without a picture");
    }
    if (code != 0) {
        reply->failed = is_late ? BATCH_LATE : BATCH_FAILED;
    }
    const double seconds = burnish_seconds_now() - start;
    const int is_whole = result->is_drawn && /* else it could not be finished */
                         (code == 0 || code == CLI_EXIT_BLANK || code == CLI_EXIT_DIFFERENT);
    char *text = r->b->settings->is_render && r->b->report && is_whole ? render_line(r)
                 : reply->failed ? batch_failed_line(r->b, item, code, error.text, seconds)
                                 : done_line(r->b, item, hash, result, &seen, seconds);
    release_files(&seen);
    return text;
}

void batch_runner(const batch *b, int channel) {
    runner r = {.b = b,
                .shared = mmap(NULL, sizeof(facts) + REPORT_BYTES, PROT_READ | PROT_WRITE,
                               MAP_SHARED | MAP_ANONYMOUS, -1, 0)};
    r.report = (char *)(r.shared + 1);
    uint32_t index;
    int is_there = 1;
    if (b->settings->render.job.sandbox) {
        sandbox_prepare(0); /* if it fails, workers report it */
    }
    cli_prepare_forks();
    while (is_there && r.shared != MAP_FAILED && channel_read(channel, &index, sizeof index)) {
        batch_reply reply;
        char *line = run_item(&r, index, &reply);
        reply.size = line ? (uint32_t)strlen(line) : 0;
        is_there = cli_write_all(channel, &reply, sizeof reply) &&
                   (!line || cli_write_all(channel, line, reply.size));
        free(line);
    }
}

#endif
