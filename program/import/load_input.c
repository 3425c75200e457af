/* Loads inputs. */
#include "import/load_input.h"

#include <stdlib.h>
#include <string.h>

#include "base/cli/options.h"
#include "base/inputs.h"
#include "cli/input.h"
#include "import/folder.h"
#include "import/run.h"

/* ---- Files of this process ---- */

#ifndef _WIN32

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/cli/process.h"

enum { PIECE = 1 << 16 };
#define STREAM_MOST ((uint64_t)1 << 30)

static burnish_status open_path(const char *path, int *input, burnish_error *error) {
    struct stat state;
    *input = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (*input < 0) {
        return cli_fail(error, cli_errno_status(errno), "%.300s: can't be opened: %s", path,
                        cli_open_reason(path, errno));
    }
    if (fstat(*input, &state) != 0 || S_ISDIR(state.st_mode)) {
        close(*input);
        return cli_fail(error, BURNISH_STATUS_READ, "%.300s: can't be read: Is a directory", path);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status copy_stream(int from, int to, uint64_t most, burnish_error *error) {
    static char piece[PIECE];
    uint64_t total = 0;
    ssize_t size;
    while ((size = read(from, piece, sizeof piece)) != 0) {
        if (size < 0 && errno != EINTR) {
            return cli_fail(error, cli_errno_status(errno), "standard input: can't be read: %s",
                            strerror(errno));
        }
        total += size > 0 ? (uint64_t)size : 0;
        if (total > most) {
            return cli_fail(error, BURNISH_STATUS_LIMIT,
                            "standard input: larger than the limit of %llu bytes; %s",
                            (unsigned long long)most,
                            most < STREAM_MOST ? "raise the limit or simplify the mesh"
                                               : "give the file by its name");
        }
        if (size > 0 && !cli_write_all(to, piece, (size_t)size)) {
            return cli_fail(error, BURNISH_STATUS_MEMORY, "standard input: no room for it: %s",
                            strerror(errno));
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status open_standard(uint64_t max_bytes, int *input, burnish_error *error) {
    struct stat state;
    if (fstat(STDIN_FILENO, &state) == 0 && S_ISREG(state.st_mode) &&
        lseek(STDIN_FILENO, 0, SEEK_CUR) == 0) {
        *input = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        if (*input >= 0) {
            return BURNISH_STATUS_OK;
        }
    }
    *input = cli_unnamed_file();
    if (*input < 0) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "standard input: no room for it: %s",
                        strerror(errno));
    }
    const burnish_status status =
        copy_stream(STDIN_FILENO, *input, max_bytes < STREAM_MOST ? max_bytes : STREAM_MOST, error);
    if (status != BURNISH_STATUS_OK) {
        close(*input);
    }
    return status;
}

burnish_status import_run_over(const import_program *importer, const char *extension,
                               const char *path, int held, uint64_t max_bytes, import_sink sink,
                               burnish_error *error) {
    const int is_standard = strcmp(path, "-") == 0;
    int input = held;
    burnish_status status = BURNISH_STATUS_OK;
    if (is_standard) { /* nothing is read for an importer that is not installed */
        status = import_check_installed(importer, import_shown(path), error);
    }
    if (status == BURNISH_STATUS_OK && held < 0) {
        status =
            is_standard ? open_standard(max_bytes, &input, error) : open_path(path, &input, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    status = import_run(importer, import_shown(path), extension, input, max_bytes, sink, error);
    if (held < 0) {
        close(input);
    }
    return status;
}

static burnish_status import_path(const import_program *importer, const char *extension,
                                  const char *path, uint64_t max_bytes, import_stream *stream,
                                  burnish_error *error) {
    return import_run_over(importer, extension, path, -1, max_bytes,
                           (import_sink){import_keep, stream}, error);
}

static const import_source files = {burnish_mesh_load, import_path, NULL, import_decode_bytes,
                                    NULL};
static const import_source *source = &files;

/* ---- Any source ---- */

/* Loads bytes of a format; the files that they name are those that `input` could. */
static burnish_status load_beside(const char *input, const void *bytes, size_t size,
                                  burnish_format format, const burnish_load_options *options,
                                  burnish_mesh **mesh, burnish_error *error) {
    burnish_load_options handed = *options;
    char path[BURNISH_INPUT_PATH];
    int folder = -1;
    burnish_status status = BURNISH_STATUS_OK;
    handed.format = format;
    if (!source->files) {
        status = folder_open(input, options->root, &folder, path, &handed.folder, error);
        handed.referenced_files = folder_loader(&folder);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_mesh_load_memory(bytes, size, input, &handed, mesh, error);
    }
    if (folder >= 0) {
        close(folder);
    }
    return status;
}

/* Runs the importer and builds the mesh of its stream. */
static burnish_status run_importer(const import_program *importer, const char *extension,
                                   const char *input, const burnish_load_options *options,
                                   burnish_mesh **mesh, burnish_error *error) {
    import_stream stream = {0};
    burnish_status status =
        source->import(importer, extension, input, options->max_input_bytes, &stream, error);
    if (status == BURNISH_STATUS_OK || stream.is_short) {
        burnish_load_options handed = *options;
        char path[BURNISH_INPUT_PATH];
        int folder = -1;
        status = BURNISH_STATUS_OK;
        if (!source->files) {
            status = folder_open(input, options->root, &folder, path, &handed.folder, error);
            handed.referenced_files = folder_loader(&folder);
        }
        if (status == BURNISH_STATUS_OK) {
            status = import_build(importer, import_shown(input), &stream, &handed, mesh, error);
        }
        if (folder >= 0) {
            close(folder);
        }
    }
    free(stream.bytes);
    return status;
}

#else /* no importers */

static burnish_status load_beside(const char *input, const void *bytes, size_t size,
                                  burnish_format format, const burnish_load_options *options,
                                  burnish_mesh **mesh, burnish_error *error) {
    (void)input, (void)bytes, (void)size, (void)format, (void)options, (void)mesh;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--scene: is not supported on this system");
}

static const import_source files = {burnish_mesh_load, NULL, NULL, NULL, NULL};
static const import_source *source = &files;

static burnish_status run_importer(const import_program *importer, const char *extension,
                                   const char *input, const burnish_load_options *options,
                                   burnish_mesh **mesh, burnish_error *error) {
    (void)importer, (void)extension, (void)input, (void)mesh;
    return cli_refuse_foreign((int)options->format, error);
}

#endif

/* What the source has for the input. */
static burnish_load_options hand_options(const burnish_load_options *options, const char *input,
                                         const import_decoding *decoding) {
    burnish_load_options handed = *options;
    handed.decoder = import_decoder(decoding);
    if (source->files) {
        handed.referenced_files = source->files(input);
        handed.folder = source->folder;
    }
    return handed;
}

burnish_status import_load_memory(const void *bytes, size_t size, const char *name,
                                  const burnish_load_options *options, burnish_mesh **mesh,
                                  burnish_error *error) {
    const import_decoding decoding = {source->decode, name};
    burnish_load_options handed = *options;
    handed.decoder = import_decoder(&decoding);
    return burnish_mesh_load_memory(bytes, size, name, &handed, mesh, error);
}

burnish_status import_load_items(const char *input, const char *items,
                                 const burnish_load_options *options, burnish_mesh **mesh,
                                 burnish_error *error) {
    const import_decoding decoding = {source->decode, input};
    const burnish_load_options handed = hand_options(options, input, &decoding);
    *mesh = NULL;
    return load_beside(input, items, strlen(items), BURNISH_FORMAT_SCENE, &handed, mesh, error);
}

void import_set_source(const import_source *other) {
    source = other;
}

burnish_status import_load(const char *input, const burnish_load_options *options,
                           burnish_mesh **mesh, burnish_error *error) {
    char extension[IMPORT_EXTENSION_SIZE];
    const int format = (int)options->format;
    const import_program *importer = import_choose(input, format, extension);
    const import_decoding decoding = {source->decode, input};
    burnish_load_options handed = hand_options(options, input, &decoding);
    burnish_error native;
    burnish_status status = BURNISH_STATUS_OK;
    *mesh = NULL;
    if (importer && burnish_archive_member(input)) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "%.200s: %s reads no archives; unpack the archive", import_shown(input),
                        importer->name);
    }
    if (importer) {
        status = run_importer(importer, extension, input, &handed, mesh, error);
        return import_may_be_other(status, format) &&
                       source->load(input, &handed, mesh, &native) == BURNISH_STATUS_OK
                   ? BURNISH_STATUS_OK
                   : status;
    }
    if (*input != ':') {
        status = cli_refuse_foreign(format, error);
    } else if (cli_foreign_extension(format)) { /* which a built-in object ignores */
        handed.format = BURNISH_FORMAT_AUTO;
    }
    return status == BURNISH_STATUS_OK ? source->load(input, &handed, mesh, error) : status;
}
