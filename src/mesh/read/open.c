/* From a path, standard input or memory to a scene: reads the bytes, finds the reader, builds. */
#include <errno.h>
#include <string.h>

#include "core/clock.h"
#include "core/platform.h"
#include "mesh/mesh.h"
#include "mesh/read/reader.h"
#include "mesh/read/text.h"

enum { FIRST_CHUNK = 1 << 16, LARGEST_READ = 1 << 30 };

static burnish_status fail_errno(burnish_error *error, const char *name, const char *what,
                                 int code) {
    return burnish_fail_at(error, BURNISH_STATUS_READ, burnish_place_file(name), "%s%s", what,
                           burnish_errno_reason(code).text);
}

static burnish_status fail_size(burnish_error *error, const char *name, uint64_t max_bytes) {
    return burnish_fail_at(error, BURNISH_STATUS_LIMIT, burnish_place_file(name),
                           "larger than the limit of %llu bytes; raise the limit or simplify the "
                           "mesh",
                           (unsigned long long)max_bytes);
}

/* Reads up to size bytes; *got is less at the end of the file. Returns errno, 0 for success. */
static int read_fully(int descriptor, uint8_t *bytes, size_t size, size_t *got) {
    *got = 0;
    while (*got < size) {
        size_t wanted = size - *got < LARGEST_READ ? size - *got : LARGEST_READ;
        ssize_t count = read(descriptor, bytes + *got, wanted);
        if (count == 0) {
            return 0;
        }
        if (count < 0 && errno != EINTR) {
            return errno;
        }
        *got += count > 0 ? (size_t)count : 0;
    }
    return 0;
}

/* A regular file of known size, as far as it goes. */
static burnish_status read_sized(int descriptor, const char *name, size_t size, uint8_t **bytes,
                                 size_t *got, burnish_error *error) {
    uint8_t *memory = malloc(size);
    if (!memory) {
        return burnish_fail_memory(error, name, size);
    }
    int code = read_fully(descriptor, memory, size, got);
    if (code != 0) {
        free(memory);
        return fail_errno(error, name, "can't be read: ", code);
    }
    *bytes = memory;
    return BURNISH_STATUS_OK;
}

/* A pipe, a device, or a file that does not tell its size. */
static burnish_status read_stream(int descriptor, const char *name, uint64_t max_bytes,
                                  uint8_t **bytes, size_t *size, burnish_error *error) {
    uint8_t *memory = NULL;
    size_t used = 0, capacity = 0, got = 0;
    burnish_status status = BURNISH_STATUS_OK;
    do {
        status =
            burnish_legacy_reserve((void **)&memory, &capacity, used + FIRST_CHUNK, 1, name, error);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        size_t room = capacity - used;
        int code = read_fully(descriptor, memory + used, room, &got);
        used += got;
        if (code != 0) {
            status = fail_errno(error, name, "can't be read: ", code);
        } else if (used > max_bytes) {
            status = fail_size(error, name, max_bytes);
        }
    } while (status == BURNISH_STATUS_OK && used == capacity);
    if (status != BURNISH_STATUS_OK) {
        free(memory);
        return status;
    }
    *bytes = memory;
    *size = used;
    return BURNISH_STATUS_OK;
}

static burnish_status read_descriptor(int descriptor, const char *name, int only_regular,
                                      uint64_t max_bytes, uint8_t **bytes, size_t *size,
                                      burnish_error *error) {
    struct stat info;
    if (fstat(descriptor, &info) != 0) {
        return fail_errno(error, name, "can't be read: ", errno);
    }
    if (S_ISDIR(info.st_mode)) {
        return fail_errno(error, name, "can't be read: ", EISDIR);
    }
    if (only_regular && !S_ISREG(info.st_mode)) {
        return burnish_fail_at(error, BURNISH_STATUS_READ, burnish_place_file(name),
                               "is no regular file");
    }
    if (!S_ISREG(info.st_mode) || info.st_size <= 0) {
        return read_stream(descriptor, name, max_bytes, bytes, size, error);
    }
    if ((uint64_t)info.st_size > max_bytes) {
        return fail_size(error, name, max_bytes);
    }
    return read_sized(descriptor, name, (size_t)info.st_size, bytes, size, error);
}

static burnish_status read_path(const char *path, const char *name, int only_regular,
                                uint64_t max_bytes, uint8_t **bytes, size_t *size,
                                burnish_error *error) {
    /* A pipe given as the input is waited for; one posing as a material library is not. */
    int flags = O_RDONLY | O_BINARY | O_CLOEXEC | O_NOCTTY | (only_regular ? O_NONBLOCK : 0);
    int descriptor;
    do {
        descriptor = open(path, flags);
    } while (descriptor < 0 && errno == EINTR);
    if (descriptor < 0) {
        return fail_errno(error, name, "can't be opened: ", errno);
    }
    burnish_status status =
        read_descriptor(descriptor, name, only_regular, max_bytes, bytes, size, error);
    close(descriptor);
    return status;
}

/* burnish_reader_input.open_beside for inputs that are files. */
static burnish_status open_beside(const char *input_name, const char *file, uint64_t max_bytes,
                                  uint8_t **bytes, size_t *size, burnish_error *error) {
    const char *slash = strrchr(input_name, '/');
    size_t folder = slash ? (size_t)(slash - input_name) + 1 : 0, length = strlen(file);
    char *path = malloc(folder + length + 1);
    if (!path) {
        return burnish_fail_memory(error, "path", folder + length + 1);
    }
    memcpy(path, input_name, folder);
    memcpy(path + folder, file, length + 1);
    burnish_status status = read_path(path, file, 1, max_bytes, bytes, size, error);
    free(path);
    return status;
}

static burnish_status read_format(const burnish_reader_input *input, burnish_format *format,
                                  burnish_source *source, burnish_error *error) {
    *format = input->options->format;
    if (input->size == 0) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_byte(input->name, 0),
                               "the file is empty; fetch it again");
    }
    if (*format == BURNISH_FORMAT_AUTO) {
        *format = burnish_guess_format(input->bytes, input->size, input->name);
    }
    switch (*format) {
    case BURNISH_FORMAT_OBJ:
        return burnish_read_obj(input, source, error);
    case BURNISH_FORMAT_PLY:
        return burnish_read_ply(input, source, error);
    case BURNISH_FORMAT_STL:
        return burnish_read_stl(input, source, error);
    case BURNISH_FORMAT_AUTO:
    case BURNISH_FORMAT_BUILTIN:
    case BURNISH_FORMAT_ARRAYS:
    case BURNISH_FORMAT_COUNT:
        break;
    }
    return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_file(input->name),
                           "neither its name nor its first bytes tell OBJ, PLY or STL; name the "
                           "format");
}

/* Reads and builds; releases *owned, the bytes of a file, as soon as it has been read. start: when
 * it was opened. */
static burnish_status load(const burnish_reader_input *input, uint8_t *owned, double start,
                           burnish_mesh **scene, burnish_error *error) {
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, NULL, input->options->threads);
    burnish_source source = {.pool = &tasks};
    burnish_format format;
    burnish_status status = read_format(input, &format, &source, error);
    free(owned);
    burnish_mesh_data data = burnish_mesh_data_begin(NULL, &tasks, error);
    if (status == BURNISH_STATUS_OK) {
        burnish_source_move(&source, &data);
        data.start = start;
        status = burnish_mesh_build(&data, input->name, input->options, format, scene);
    }
    burnish_mesh_data_destroy(&data);
    burnish_source_destroy(&source);
    return status;
}

static burnish_status load_builtin(const char *name, const burnish_load_options *options,
                                   burnish_mesh **scene, burnish_error *error) {
    burnish_tasks tasks;
    burnish_tasks_begin(&tasks, options->context, options->threads);
    burnish_mesh_data data = burnish_mesh_data_begin(options->context, &tasks, error);
    burnish_status status = burnish_make_builtin(name + 1, options, &data, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_mesh_build(&data, name, options, BURNISH_FORMAT_BUILTIN, scene);
    }
    burnish_mesh_data_destroy(&data);
    return status;
}

/* What both ways in share. */
static burnish_status check_arguments(const void *required, const char *what,
                                      const burnish_load_options *options, burnish_mesh **scene,
                                      burnish_error *error) {
    burnish_status status = burnish_check_load(options, scene, error);
    if (status == BURNISH_STATUS_OK && !required) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: NULL; pass one", what);
    }
    return status;
}

burnish_status burnish_mesh_load(const char *path, const burnish_load_options *options,
                                 burnish_mesh **scene, burnish_error *error) {
    burnish_status status = check_arguments(path, "path", options, scene, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (*path == ':') {
        return load_builtin(path, options, scene, error);
    }
    int from_input = strcmp(path, "-") == 0;
    burnish_reader_input input = {.name = from_input ? "standard input" : path,
                                  .options = options,
                                  .open_beside = from_input ? NULL : open_beside};
    uint8_t *bytes = NULL;
    double start = burnish_seconds_now();
    status = from_input
                 ? read_descriptor(STDIN_FILENO, input.name, 0, options->max_input_bytes, &bytes,
                                   &input.size, error)
                 : read_path(path, path, 0, options->max_input_bytes, &bytes, &input.size, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    input.bytes = bytes;
    return load(&input, bytes, start, scene, error);
}

burnish_status burnish_mesh_load_memory(const void *bytes, size_t size, const char *name,
                                        const burnish_load_options *options, burnish_mesh **scene,
                                        burnish_error *error) {
    static const uint8_t nothing[1];
    const void *given = bytes ? bytes : size == 0 ? nothing : NULL;
    burnish_status status = check_arguments(given, "bytes", options, scene, error);
    if (status == BURNISH_STATUS_OK && size > options->max_input_bytes) {
        status = fail_size(error, name ? name : "memory", options->max_input_bytes);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_reader_input input = {
        .bytes = given, .size = size, .name = name ? name : "memory", .options = options};
    return load(&input, NULL, burnish_seconds_now(), scene, error);
}
