/* A process for one request. It enters the sandbox before it receives the request: nothing is parsed
 * outside, and the next request can't see this one. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/output.h"
#include "render/render.h"
#include "serve/serve.h"

char *serve_failed_line(int code, const char *message, const char *report) {
    cJSON *object = cJSON_CreateObject();
    int failed = 0;
    cli_json_add(object, "code", cJSON_CreateNumber(code), &failed);
    cli_json_add(object, "error", cli_json_text(message), &failed);
    cli_json_add(object, "report", report ? cJSON_CreateRaw(report) : cJSON_CreateNull(), &failed);
    return cli_json_string(object, failed, 0);
}

#ifndef _WIN32

#include <errno.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/cli/file.h"
#include "base/cli/process.h"
#include "cli/limits.h"
#include "import/load_input.h"
#include "import/run.h"
#include "sandbox/channel.h"
#include "sandbox/lock.h"

enum { FILES_MAX = 256, FLAGS_MAX = 256, PIECE = 1 << 16, WARM_BYTES = 8 << 20, PAGE_BYTES = 4096 };

/* ---- Outputs ---- */

typedef struct output {
    char *bytes;
    size_t size, capacity;
} output;

/* Outputs of this process's only request. */
static output picture, report;

static burnish_status keep_output(const char *path, burnish_file_source *source, void *context,
                                  burnish_file_check *ready, burnish_error *error) {
    output *to = strcmp(path, "-") == 0 ? &picture : &report;
    for (size_t count = 1; count > 0; to->size += count) {
        if (to->capacity - to->size < PIECE) {
            const size_t capacity = 2 * to->capacity + 2 * PIECE;
            char *grown = capacity < SIZE_MAX / 4 ? realloc(to->bytes, capacity) : NULL;
            if (!grown) {
                return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the reply");
            }
            to->bytes = grown;
            to->capacity = capacity;
        }
        count = source(context, to->bytes + to->size, PIECE - 1);
    }
    to->bytes[to->size] = 0;
    return ready ? ready(context, error) : BURNISH_STATUS_OK;
}

/* ---- The request ---- */

typedef struct request {
    const char *name;
    const char *frame;
    const char *bytes; /* of the mesh */
    size_t size;
    cli_companions companions;
    cli_companion files[FILES_MAX];
    char *flags[FLAGS_MAX];
    int flag_count;
    int format; /* of --input-format */
} request;

static request only; /* of this process */

static burnish_status fail_key(const char *key, const char *what, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "request: \"%.60s\": %s", key, what);
}

static burnish_status take_flags(request *r, const cJSON *list, burnish_error *error) {
    const cJSON *item;
    cJSON_ArrayForEach(item, list) {
        if (!cJSON_IsString(item) || r->flag_count == FLAGS_MAX) {
            break;
        }
        r->flags[r->flag_count++] = item->valuestring;
    }
    return cJSON_IsArray(list) && !item
               ? BURNISH_STATUS_OK
               : fail_key("flags", "give an array of at most 256 texts", error);
}

/* The files are the last bytes, in order; the mesh precedes them. */
static burnish_status take_files(request *r, const cJSON *list, burnish_error *error) {
    const cJSON *item;
    uint64_t sum = 0;
    cJSON_ArrayForEach(item, list) {
        const cJSON *name = cJSON_GetObjectItemCaseSensitive(item, "name");
        const cJSON *bytes = cJSON_GetObjectItemCaseSensitive(item, "bytes");
        const double size = cJSON_IsNumber(bytes) ? bytes->valuedouble : -1;
        if (!cJSON_IsString(name) || !(size >= 0 && size <= (double)r->size) ||
            size != (double)(uint64_t)size || r->companions.count == FILES_MAX) {
            break;
        }
        sum += (uint64_t)size;
        r->files[r->companions.count++] =
            (cli_companion){.name = name->valuestring, .size = (size_t)size};
    }
    if (!cJSON_IsArray(list) || item || sum > r->size) {
        return fail_key("files",
                        "give at most 256 of {\"name\": text, \"bytes\": number}, no more bytes "
                        "than follow the line",
                        error);
    }
    r->size -= (size_t)sum;
    const char *next = r->bytes + r->size;
    for (size_t i = 0; i < r->companions.count; ++i) {
        r->files[i].bytes = next;
        next += r->files[i].size;
    }
    r->companions.items = r->files;
    return BURNISH_STATUS_OK;
}

static burnish_status take_keys(request *r, const cJSON *object, burnish_error *error) {
    const cJSON *item;
    burnish_status status = BURNISH_STATUS_OK;
    cJSON_ArrayForEach(item, object) {
        if (strcmp(item->string, "name") == 0) {
            r->name = item->valuestring;
            status = r->name && *r->name ? status : fail_key("name", "give a text", error);
        } else if (strcmp(item->string, "flags") == 0) {
            status = take_flags(r, item, error);
        } else if (strcmp(item->string, "files") == 0) {
            status = r->companions.count == 0 ? take_files(r, item, error)
                                              : fail_key("files", "give it once", error);
        } else {
            status = fail_key(item->string, "unknown key; there are name, flags and files", error);
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    if (*r->name == ':' && r->size > 0) {
        return fail_key("name", "a built-in object has no bytes; leave out the \":\"", error);
    }
    return status;
}

/* r's names and flags point into *object. */
static burnish_status parse_request(const char *frame, size_t size, request *r, cJSON **object,
                                    burnish_error *error) {
    const size_t most = size < SERVE_LINE_MAX ? size : SERVE_LINE_MAX;
    const char *end = memchr(frame, '\n', most), *stop = NULL;
    *object = NULL;
    if (!end) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "request: no newline in its first %zu bytes; a line of JSON comes first",
                        most);
    }
    *object = cJSON_ParseWithLengthOpts(frame, (size_t)(end - frame), &stop, 0);
    if (!cJSON_IsObject(*object) || !stop || stop + strspn(stop, " \t\r") != end) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "request: byte %zu: the line is not one JSON object",
                        stop && stop <= end ? (size_t)(stop - frame) : (size_t)(end - frame));
    }
    r->name = "mesh";
    r->frame = frame;
    r->bytes = end + 1;
    r->size = size - (size_t)(end + 1 - frame);
    return take_keys(r, *object, error);
}

/* ---- Drawing ---- */

/* The input is in memory. */
static burnish_status load_request_input(const char *input, const burnish_load_options *options,
                                         burnish_mesh **mesh, burnish_error *error) {
    return *input == ':'
               ? burnish_mesh_load(input, options, mesh, error)
               : burnish_mesh_load_memory(only.bytes, only.size, input, options, mesh, error);
}

static burnish_status import_in_broker(const import_program *importer, const char *extension,
                                       const char *input, uint64_t max_bytes, import_stream *stream,
                                       burnish_error *error) {
    (void)importer, (void)extension, (void)max_bytes; /* the server knows them, too */
    return serve_import(input, only.format, (uint64_t)(only.bytes - only.frame), only.size, stream,
                        error);
}

static burnish_file_loader list_files(const char *input) {
    (void)input;
    return cli_companion_loader(&only.companions);
}

static burnish_status draw_request(const serve_settings *server, request *r, int *code,
                                   burnish_error *error) {
    render_settings settings = server->render;
    cli_call call = {0};
    settings.given = (cli_given){{0}}; /* the server's flags are only defaults */
    burnish_status status =
        cli_parse(&serve_request_command, r->flag_count, r->flags, &settings, &call, error);
    if (status == BURNISH_STATUS_OK && call.help) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "--help: not a flag of a request");
    }
    settings.input.name = r->name;
    settings.output.path = "-";
    settings.job.quiet = 1;
    settings.picture.opens_no_font = 1;
    r->format = settings.input.load.format;
    if (status == BURNISH_STATUS_OK) {
        status = render_finish(&settings, error);
    }
    settings.output.json = "report";
    return status == BURNISH_STATUS_OK ? render_run(&settings, code, error) : status;
}

/* ---- The reply ---- */

static burnish_status serve_request(const serve_settings *settings, const char *frame, size_t size,
                                    int *code, burnish_error *error) {
    cJSON *object;
    burnish_status status = parse_request(frame, size, &only, &object, error);
    if (status == BURNISH_STATUS_OK) {
        status = draw_request(settings, &only, code, error);
    }
    if (status == BURNISH_STATUS_OK && *code != 0) {
        cli_fail(error, status, "%.300s: the picture is blank (--fail-on-blank)", only.name);
    }
    return status; /* the process exits, so nothing is released */
}

/* Writes the reply and ends the process. */
__attribute__((noreturn)) static void reply(const serve_settings *settings, const char *frame,
                                            size_t size) {
    static const char head[] = "{\"code\":0,\"error\":null,\"report\":";
    burnish_error error;
    int code = 0;
    const burnish_status status = serve_request(settings, frame, size, &code, &error);
    if (report.bytes) {
        cJSON_Minify(report.bytes); /* to one line */
    }
    int is_written;
    if (status == BURNISH_STATUS_OK && code == 0) {
        is_written = cli_write_all(SERVE_REPLY, head, sizeof head - 1) &&
                     cli_write_all(SERVE_REPLY, report.bytes, strlen(report.bytes)) &&
                     cli_write_all(SERVE_REPLY, "}\n", 2) &&
                     cli_write_all(SERVE_REPLY, picture.bytes, picture.size);
    } else {
        char *line = serve_failed_line(code != 0 ? code : burnish_status_exit_code(status),
                                       error.text, code != 0 ? report.bytes : NULL);
        is_written = line && cli_write_all(SERVE_REPLY, line, strlen(line)) &&
                     cli_write_all(SERVE_REPLY, "\n", 1);
    }
    _exit(is_written ? 0 : burnish_status_exit_code(BURNISH_STATUS_MEMORY));
}

/* ---- The process ---- */

/* Touches memory while idle, enough for a picture of 256 x 256 pixels. */
static void warm_up(void) {
    volatile char *room = malloc(WARM_BYTES);
    for (size_t i = 0; room && i < WARM_BYTES; i += PAGE_BYTES) {
        room[i] = 0;
    }
    free((void *)(uintptr_t)room);
}

static burnish_status get_ready(const serve_settings *settings, burnish_error *error) {
    burnish_processor_count(); /* reads files, once */
    /* only the mesh itself is worth another process */
    static const import_source source = {load_request_input, import_in_broker, list_files,
                                         .decode = NULL};
    cli_file_set_writer(keep_output);
    import_set_source(&source);
    burnish_status status = cli_limit_memory(settings->render.job.max_memory, error);
    cli_prepare_memory();
    warm_up();
    if (status == BURNISH_STATUS_OK && !settings->no_sandbox) {
        const char *wall;
        const int reason = sandbox_lock(SERVE_DESCRIPTORS, 0, &wall);
        status =
            reason == 0
                ? status
                : cli_fail(
                      error, BURNISH_STATUS_ARGUMENT,
                      "serve-stdio: this system can't create a sandbox (%s: %s); use --no-sandbox",
                      wall, strerror(reason));
    }
    return status;
}

void serve_work(const serve_settings *settings) {
    burnish_error error;
    uint64_t size = 0;
    const burnish_status status = get_ready(settings, &error);
    if (status != BURNISH_STATUS_OK) {
        cli_write_all(SERVE_REPLY, error.text, strlen(error.text));
        _exit(burnish_status_exit_code(status));
    }
    if (!cli_write_all(SERVE_CHANNEL, "", 1) || !channel_read(SERVE_CHANNEL, &size, sizeof size)) {
        _exit(0); /* no more requests */
    }
    const char *frame = mmap(NULL, (size_t)size, PROT_READ, MAP_PRIVATE, SERVE_REQUEST, 0);
    if (frame == MAP_FAILED) {
        _exit(burnish_status_exit_code(BURNISH_STATUS_MEMORY));
    }
    reply(settings, frame, (size_t)size);
}

#endif
