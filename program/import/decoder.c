/* Decodes Draco streams in glTF, and files of scenes, through importers. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifndef _WIN32
#include <unistd.h>
#endif

#include "base/cli/options.h"
#include "base/cli/process.h"
#include "import/importers.h"
#include "import/run.h"

#ifndef _WIN32

static const import_program draco = {.name = "burnish-import-draco",
                                     .from = "libdraco-dev and g++ and build burnish again",
                                     .extensions = "",
                                     .argument = "draco",
                                     .otherwise =
                                         "export the file without KHR_draco_mesh_compression"};

static int is_draco(const char *form) {
    return strcmp(form, draco.argument) == 0;
}

int import_can_decode(const char *form) {
    return is_draco(form) || import_of_extension(form);
}

burnish_status import_decode_file(const char *name, const char *form, int file, import_sink sink,
                                  burnish_error *error) {
    const import_program *importer = is_draco(form) ? &draco : import_of_extension(form);
    return importer ? import_run(importer, name, form, file, UINT64_MAX, sink, error)
                    : cli_fail(error, BURNISH_STATUS_FORMAT,
                               "neither its name nor its first bytes identify the format");
}

burnish_status import_decode_bytes(const char *name, const char *form, const void *bytes,
                                   size_t size, import_stream *stream, burnish_error *error) {
    const int file = cli_unnamed_file();
    if (file < 0 || !cli_write_all(file, bytes, size)) {
        if (file >= 0) {
            close(file);
        }
        return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: no room for an importer: %s", name,
                        strerror(errno));
    }
    burnish_status status =
        import_decode_file(name, form, file, (import_sink){import_keep, stream}, error);
    close(file);
    return status == BURNISH_STATUS_MEMORY && stream->is_short ? BURNISH_STATUS_OK : status;
}

/* Reads the error message from the stream of an importer that failed. */
static burnish_status take_error(const char *name, const import_stream *stream,
                                 burnish_error *error) {
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    const burnish_status status = import_build(&draco, name, stream, &options, &mesh, error);
    burnish_mesh_destroy(mesh);
    return status == BURNISH_STATUS_OK
               ? cli_fail(error, BURNISH_STATUS_FORMAT, "%.200s: %s makes a mesh of its own", name,
                          draco.name)
               : status;
}

static burnish_status decode_stream(void *user_data, const char *form, const void *bytes,
                                    size_t size, const uint8_t **decoded, size_t *decoded_size,
                                    burnish_error *error) {
    const import_decoding *decoding = user_data;
    const char *name = decoding->name;
    import_stream stream = {0};
    burnish_status status = decoding->decode(name, form, bytes, size, &stream, error);
    if (status == BURNISH_STATUS_OK &&
        (stream.is_short || (is_draco(form) && (stream.size < 4 || memcmp(stream.bytes,
                                                                          "\x89"
                                                                          "BMS",
                                                                          4) == 0)))) {
        status = take_error(name, &stream, error);
    }
    if (status != BURNISH_STATUS_OK) {
        free(stream.bytes);
        return status;
    }
    *decoded = stream.bytes;
    *decoded_size = stream.size;
    return BURNISH_STATUS_OK;
}

static void release_decoded(void *user_data, const uint8_t *decoded, size_t size) {
    (void)user_data, (void)size;
    free((void *)(uintptr_t)decoded);
}

burnish_stream_decoder import_decoder(const import_decoding *decoding) {
    return decoding->decode ? (burnish_stream_decoder){decode_stream, release_decoded,
                                                       (void *)(uintptr_t)decoding}
                            : (burnish_stream_decoder){0};
}

#else

burnish_stream_decoder import_decoder(const import_decoding *decoding) {
    (void)decoding;
    return (burnish_stream_decoder){0};
}

#endif
