/* Loads a mesh from a path, standard input or memory: gets the bytes, reads them, builds the mesh.
 */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/inputs.h"
#include "base/platform.h"
#include "core/float_mode.h"
#include "mesh/arrange_parts.h"
#include "mesh/build/build.h"
#include "mesh/builtin.h"
#include "mesh/read/archive.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/io/beside.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/read.h"

enum { FIRST_READ = 1 << 16, LARGEST_READ = 1 << 30 };

/* A file's bytes and their source. */
typedef struct opened_file {
    const char *name; /* for messages */
    uint64_t max_bytes;
    burnish_format format; /* required of a stream; COUNT: any bytes are accepted */
    burnish_memory memory; /* takes errors too */
    uint8_t *bytes;
    size_t size;
    int may_stream;          /* 1: read only the head of a file that may be streamed */
    burnish_format streamed; /* the format of such a file; AUTO for any other */
    size_t whole;            /* its size */
} opened_file;

static burnish_status fail_errno(opened_file *file, const char *what, int code) {
    const burnish_status status = code == ENOMEM ? BURNISH_STATUS_MEMORY : BURNISH_STATUS_READ;
    const int is_missing = code == ENOENT, is_address = strstr(file->name, "://") != NULL;
    return burnish_fail(file->memory.error, status, "%s: %s: %s",
                        burnish_show_name(file->name).text, what,
                        is_missing && is_address ? "it is an address; download the file first"
                        : is_missing && strpbrk(file->name, "*?")
                            ? "No such file; shells replace patterns only outside quotes"
                            : burnish_errno_reason(code).text);
}

static burnish_status fail_size(burnish_error *error, const char *name, uint64_t max_bytes) {
    return burnish_fail(
        error, BURNISH_STATUS_LIMIT,
        "%s: larger than the limit of %llu bytes; raise the limit or simplify the mesh",
        burnish_show_name(name).text, (unsigned long long)max_bytes);
}

/* Appends up to `size` bytes; fewer at the end of the file. Returns errno, 0 for success. */
static int read_fully(int descriptor, opened_file *file, size_t size) {
    while (size > 0) {
        ssize_t count =
            read(descriptor, file->bytes + file->size, size < LARGEST_READ ? size : LARGEST_READ);
        if (count == 0) {
            return 0;
        }
        if (count < 0 && errno != EINTR) {
            return errno;
        }
        file->size += count > 0 ? (size_t)count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return 0;
}

/* The rest of a regular file of known size; fewer bytes if it has become shorter. */
static burnish_status read_sized(int descriptor, opened_file *file, size_t size) {
    uint8_t *bytes = burnish_allocate(&file->memory, size, 1, file->name);
    if (!bytes) {
        return file->memory.status;
    }
    if (file->size > 0) {
        memcpy(bytes, file->bytes, file->size);
    }
    burnish_release(file->memory.context, file->bytes);
    file->bytes = bytes;
    const int code = read_fully(descriptor, file, size - file->size);
    return code != 0 ? fail_errno(file, "can't be read", code) : BURNISH_STATUS_OK;
}

/* ---- Streams ---- */

/* Parts of a stream of unknown size. They keep it in memory only once, also while they are joined.
 */
typedef struct stream_parts {
    uint8_t **items;
    size_t count, capacity, size; /* size: of each but the last one */
} stream_parts;

enum { STREAM_PART = 1 << 22 };

static void release_parts(stream_parts *parts, const burnish_context *context) {
    for (size_t i = 0; i < parts->count; ++i) {
        burnish_release(context, parts->items[i]);
    }
    burnish_release(context, parts->items);
}

/* Reads another part of at most `size` bytes; *got is fewer at the end of the stream. */
static burnish_status read_part(int descriptor, opened_file *file, stream_parts *parts, size_t size,
                                size_t *got) {
    opened_file part = {.name = file->name, .memory = file->memory};
    parts->items = burnish_reserve(&file->memory, parts->items, &parts->capacity, parts->count + 1,
                                   sizeof *parts->items, file->name);
    part.bytes = file->memory.status == BURNISH_STATUS_OK
                     ? burnish_allocate(&file->memory, size, 1, file->name)
                     : NULL;
    if (!part.bytes) {
        return file->memory.status;
    }
    parts->items[parts->count++] = part.bytes;
    const int code = read_fully(descriptor, &part, size);
    *got = part.size;
    return code != 0 ? fail_errno(file, "can't be read", code) : BURNISH_STATUS_OK;
}

/* Appends the parts to the file's first bytes. Each part is released as soon as it is copied, so
 * the pages of both are not needed at the same time. */
static burnish_status join_parts(opened_file *file, stream_parts *parts, size_t size) {
    uint8_t *joined = burnish_allocate(&file->memory, file->size + size, 1, file->name);
    if (!joined) {
        return file->memory.status;
    }
    memcpy(joined, file->bytes, file->size);
    burnish_release(file->memory.context, file->bytes);
    file->bytes = joined;
    for (size_t i = 0; i < parts->count; ++i) {
        const size_t rest = size - i * parts->size;
        const size_t count = rest < parts->size ? rest : parts->size;
        memcpy(joined + file->size + i * parts->size, parts->items[i], count);
        burnish_release(file->memory.context, parts->items[i]);
        parts->items[i] = NULL;
    }
    file->size += size;
    return BURNISH_STATUS_OK;
}

/* Reads the rest of a stream after its first bytes, and one byte beyond the limit, to detect a
 * stream that is too long. */
static burnish_status read_rest(int descriptor, opened_file *file) {
    stream_parts parts = {.size = STREAM_PART};
    burnish_status status = BURNISH_STATUS_OK;
    const uint64_t most = file->max_bytes - file->size;
    uint64_t rest = most < UINT64_MAX ? most + 1 : most;
    size_t total = 0, got = STREAM_PART;
    while (status == BURNISH_STATUS_OK && got == STREAM_PART && rest > 0) {
        const size_t size = rest < STREAM_PART ? (size_t)rest : STREAM_PART;
        got = 0;
        status = read_part(descriptor, file, &parts, size, &got);
        total += got;
        rest -= got;
    }
    if (status == BURNISH_STATUS_OK && total > most) {
        status = fail_size(file->memory.error, file->name, file->max_bytes);
    }
    if (status == BURNISH_STATUS_OK && total > 0) {
        status = join_parts(file, &parts, total);
    }
    release_parts(&parts, file->memory.context);
    return status;
}

/* A pipe, a device, or a file of unknown size. It may be endless, so input that can't be a mesh is
 * rejected by its first bytes. */
static burnish_status read_stream(int descriptor, opened_file *file) {
    const size_t first = file->max_bytes < FIRST_READ ? (size_t)file->max_bytes + 1 : FIRST_READ;
    burnish_status status = read_sized(descriptor, file, first);
    if (status != BURNISH_STATUS_OK || file->size < first) {
        return status;
    }
    if (file->size > file->max_bytes) {
        return fail_size(file->memory.error, file->name, file->max_bytes);
    }
    if (!burnish_may_be(file->format, file->bytes, file->size, file->name)) {
        return burnish_fail(file->memory.error, BURNISH_STATUS_FORMAT,
                            "%s: its first %d bytes match no supported format%s; give a mesh",
                            burnish_show_name(file->name).text, FIRST_READ,
                            file->format != BURNISH_FORMAT_AUTO ? ", or not the named one" : "");
    }
    return read_rest(descriptor, file);
}

/* fstat, or what a sandbox permits of it: the size of a seekable file. */
static int find_state(int descriptor, struct stat *info) {
    if (fstat(descriptor, info) == 0) {
        return 1;
    }
    const int is_forbidden = errno == EPERM || errno == EACCES;
    const off_t end = is_forbidden ? lseek(descriptor, 0, SEEK_END) : -1;
    memset(info, 0, sizeof *info);
    if (end >= 0 && lseek(descriptor, 0, SEEK_SET) == 0) {
        info->st_mode = S_IFREG;
        info->st_size = end;
    }
    return is_forbidden;
}

static burnish_status read_descriptor(int descriptor, opened_file *file, int only_regular) {
    struct stat info;
    if (!find_state(descriptor, &info)) {
        return fail_errno(file, "can't be read", errno);
    }
    if (S_ISDIR(info.st_mode)) {
        return fail_errno(file, "can't be read", EISDIR);
    }
    if (only_regular && !S_ISREG(info.st_mode)) {
        return burnish_fail(file->memory.error, BURNISH_STATUS_READ, "%s: is not a regular file",
                            burnish_show_name(file->name).text);
    }
    if (!S_ISREG(info.st_mode) || info.st_size <= 0) {
        return read_stream(descriptor, file);
    }
    const uint64_t size = (uint64_t)info.st_size;
    if (size > file->max_bytes) {
        return fail_size(file->memory.error, file->name, file->max_bytes);
    }
    if (size > SIZE_MAX) { /* on 32 bits */
        return burnish_fail_memory(file->memory.error, file->name, SIZE_MAX);
    }
    file->whole = (size_t)size;
    if (BURNISH_HAS_PREAD && file->may_stream && size > BURNISH_STREAMED_HEAD &&
        lseek(descriptor, 0, SEEK_CUR) == 0) {
        const burnish_status status = read_sized(descriptor, file, BURNISH_STREAMED_HEAD);
        if (status == BURNISH_STATUS_OK && file->size == BURNISH_STREAMED_HEAD) {
            file->streamed =
                burnish_streamed_format(file->format, file->bytes, file->whole, file->name);
        }
        if (status != BURNISH_STATUS_OK || file->streamed != BURNISH_FORMAT_AUTO) {
            return status;
        }
    }
    return read_sized(descriptor, file, file->whole);
}

/* Waits for the writer of a named pipe. */
static int open_path(const char *path) {
    int descriptor;
    do {
        descriptor = burnish_open_input(path, O_RDONLY | O_CLOEXEC | O_NOCTTY | O_BINARY);
    } while (descriptor < 0 && errno == EINTR);
    return descriptor;
}

/* ---- Files next to the input ---- */

typedef struct folder {
    const char *input; /* the path of a file in it, or its own with "/" at its end */
    const burnish_context *context;
} folder;

static burnish_status load_beside(void *user_data, const char *name, uint64_t max_bytes,
                                  const void **bytes, size_t *size, burnish_error *error) {
    const folder *beside = user_data;
    opened_file file = {.name = name,
                        .max_bytes = max_bytes,
                        .format = BURNISH_FORMAT_COUNT,
                        .memory = burnish_memory_of(beside->context, error)};
    const int descriptor = burnish_open_beside(beside->input, name, &file.memory);
    if (file.memory.status != BURNISH_STATUS_OK) {
        return file.memory.status;
    }
    if (descriptor < 0) {
        return errno == EXDEV || errno == ELOOP
                   ? burnish_fail(error, BURNISH_STATUS_READ,
                                  "%s: leads out of the folder of the file",
                                  burnish_show_name(name).text)
                   : fail_errno(&file, "can't be opened", errno);
    }
    burnish_status status = read_descriptor(descriptor, &file, 1);
    close(descriptor);
    if (status != BURNISH_STATUS_OK) {
        burnish_release(beside->context, file.bytes);
        return status;
    }
    *bytes = file.bytes;
    *size = file.size;
    return status;
}

static void release_beside(void *user_data, const void *bytes, size_t size) {
    const folder *beside = user_data;
    (void)size;
    burnish_release(beside->context, (void *)(uintptr_t)bytes);
}

/* ---- Loading ---- */

/* Strict loading rejects a mesh with warnings. */
static burnish_status refuse_warnings(burnish_mesh **mesh, burnish_error *error) {
    const size_t count = burnish_mesh_get_warning_count(*mesh);
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_fail(error, BURNISH_STATUS_FORMAT,
                     "%s: rejected, as loading is strict; repair the file, or allow warnings",
                     burnish_mesh_get_warning(*mesh, 0));
    burnish_mesh_destroy(*mesh);
    *mesh = NULL;
    return status;
}

/* Reads and builds. Releases *owned, the bytes of a file, as soon as they have been read. start:
 * when the file was opened. *again becomes 1 if streaming failed and should be retried with
 * all bytes in memory. */
static burnish_status load_input(const burnish_reader_input *input, burnish_format format,
                                 uint8_t *owned, double start, burnish_mesh **mesh, int *again,
                                 burnish_error *error) {
    const burnish_context *context = input->options->context;
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, context, input->options->threads);
    burnish_mesh_data data = burnish_mesh_data_begin(context, &tasks, error);
    burnish_reader_input unpacked = *input;
    burnish_reader reader = {.input = &unpacked, .mesh = &data, .error = error};
    burnish_archive archive = {.zip = {0}};
    uint8_t *bytes;
    *again = 0;
    burnish_status status = burnish_unpack_input(&unpacked, &data.memory, &bytes);
    if (bytes) {
        burnish_release(context, owned);
        owned = NULL;
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_archive_open(&archive, &unpacked, &data, error);
        format = archive.bytes ? BURNISH_FORMAT_AUTO : format;
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_read(&reader, &format);
        *again = input->streamed &&
                 (status == BURNISH_STATUS_OK
                      ? reader.has_warned
                      : status != BURNISH_STATUS_MEMORY && status != BURNISH_STATUS_CANCELLED);
    }
    burnish_archive_close(&archive);
    burnish_release(context, bytes);
    burnish_release(context, owned);
    if (status == BURNISH_STATUS_OK && !*again) {
        status = burnish_arrange_parts(&data, unpacked.name, input->options, error);
    }
    if (status == BURNISH_STATUS_OK && !*again) {
        data.start = start;
        data.crowded_max = burnish_budget_crowded(&reader);
        status = burnish_mesh_build(&data, unpacked.name, input->options, format, mesh);
    }
    burnish_mesh_data_destroy(&data);
    return status == BURNISH_STATUS_OK && !*again && input->options->strict
               ? refuse_warnings(mesh, error)
               : status;
}

static burnish_status load_builtin(const char *name, const burnish_load_options *options,
                                   burnish_mesh **mesh, burnish_error *error) {
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, options->context, options->threads);
    burnish_mesh_data data = burnish_mesh_data_begin(options->context, &tasks, error);
    burnish_status status = burnish_make_builtin(name + 1, options, &data, error);
    if (options->origin) {
        memcpy(data.origin, options->origin, sizeof data.origin);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_move_positions(&data);
        status = burnish_mesh_build(&data, name, options, BURNISH_FORMAT_BUILTIN, mesh);
    }
    burnish_mesh_data_destroy(&data);
    return status;
}

/* Streams a file. If that fails, *again is 1 and the whole file is in memory. */
static burnish_status load_streamed(int descriptor, opened_file *file, burnish_reader_input *input,
                                    double start, burnish_mesh **mesh, int *again,
                                    burnish_error *error) {
    const burnish_streaming streaming = {descriptor, file->size};
    burnish_reader_input head = *input;
    head.bytes = file->bytes;
    head.size = file->whole;
    head.streamed = &streaming;
    burnish_status status = load_input(&head, file->streamed, NULL, start, mesh, again, error);
    if (!*again) {
        lseek(descriptor, 0, SEEK_END); /* as if it had been read to its end */
        return status;
    }
    if (error) {
        *error = (burnish_error){0};
    }
    return read_sized(descriptor, file, file->whole);
}

/* From an open descriptor, which is closed after reading if there is a path. */
static burnish_status load_opened(const char *path, int descriptor, opened_file *file,
                                  burnish_reader_input *input, double start, burnish_mesh **mesh,
                                  burnish_error *error) {
    int again = 1;
    double told = 0;
    input->told = &told;
    burnish_status status = read_descriptor(descriptor, file, 0);
    if (BURNISH_HAS_PREAD && status == BURNISH_STATUS_OK && file->streamed != BURNISH_FORMAT_AUTO) {
        status = load_streamed(descriptor, file, input, start, mesh, &again, error);
    }
    if (path) {
        close(descriptor);
    }
    if (status != BURNISH_STATUS_OK || !again) {
        burnish_release(file->memory.context, file->bytes);
        return status;
    }
    input->bytes = file->bytes;
    input->size = file->size;
    return load_input(input, input->options->format, file->bytes, start, mesh, &again, error);
}

/* From a path, or from a descriptor if that is NULL. */
static burnish_status load_file(const char *path, int descriptor, const char *name,
                                const burnish_load_options *options, burnish_mesh **mesh,
                                burnish_error *error) {
    const double start = burnish_seconds_now();
    folder beside = {path, options->context};
    char below[BURNISH_INPUT_PATH], root[BURNISH_INPUT_PATH + 1];
    opened_file file = {.name = name,
                        .max_bytes = options->max_input_bytes,
                        .format = options->format,
                        .memory = burnish_memory_of(options->context, error),
                        .may_stream = 1};
    burnish_reader_input input = {.name = file.name,
                                  .options = options,
                                  .companions = options->referenced_files,
                                  .folder =
                                      options->referenced_files.load ? options->folder : NULL};
    const int opened = path ? open_path(path) : descriptor;
    if (path && opened < 0) {
        return fail_errno(&file, "can't be opened", errno);
    }
    if (options->ignore_referenced_files) {
        input.companions = (burnish_file_loader){0};
    } else if (!input.companions.load && path) {
        input.companions = (burnish_file_loader){load_beside, release_beside, &beside};
        if (options->root && !burnish_archive_member(path)) {
            const int code = burnish_folder_below(options->root, path, below);
            if (code != 0) {
                close(opened);
                return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "root: %s: %s",
                                    burnish_show_name(options->root).text,
                                    burnish_root_fault(code));
            }
            snprintf(root, sizeof root, "%s/", options->root);
            beside.input = root;
            input.folder = below;
        }
    }
    return load_opened(path, opened, &file, &input, start, mesh, error);
}

burnish_status burnish_mesh_load(const char *path, const burnish_load_options *options,
                                 burnish_mesh **mesh, burnish_error *error) {
    burnish_status status = burnish_check_load(options, mesh, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (!path) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "path: NULL; pass a path");
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    status = *path == ':' ? load_builtin(path, options, mesh, error)
             : strcmp(path, "-") == 0
                 ? load_file(NULL, STDIN_FILENO, "standard input", options, mesh, error)
                 : load_file(path, -1, path, options, mesh, error);
    burnish_float_mode_leave(before);
    return status;
}

burnish_status burnish_mesh_load_descriptor(int descriptor, const char *name,
                                            const burnish_load_options *options,
                                            burnish_mesh **mesh, burnish_error *error) {
    burnish_status status = burnish_check_load(options, mesh, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    status = load_file(NULL, descriptor, name ? name : "input", options, mesh, error);
    burnish_float_mode_leave(before);
    return status;
}

burnish_status burnish_mesh_load_memory(const void *bytes, size_t size, const char *name,
                                        const burnish_load_options *options, burnish_mesh **mesh,
                                        burnish_error *error) {
    burnish_status status = burnish_check_load(options, mesh, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_reader_input input = {.bytes = bytes,
                                        .size = size,
                                        .name = name ? name : "memory",
                                        .options = options,
                                        .companions = options->ignore_referenced_files
                                                          ? (burnish_file_loader){0}
                                                          : options->referenced_files,
                                        .folder = options->folder};
    if (!bytes && size > 0) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "bytes: NULL; pass the bytes");
    }
    if (size > options->max_input_bytes) {
        return fail_size(error, input.name, options->max_input_bytes);
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    int again;
    status = load_input(&input, options->format, NULL, burnish_seconds_now(), mesh, &again, error);
    burnish_float_mode_leave(before);
    return status;
}
