#include "base/cli/file.h"

#include <string.h>

static cli_file_writer *chosen;

void cli_file_set_writer(cli_file_writer *writer) {
    chosen = writer;
}

/* Bytes in memory as the source of a file. */
typedef struct byte_source {
    const char *next;
    size_t rest;
    burnish_file_check *ready; /* or NULL */
    void *context;
} byte_source;

static size_t take_bytes(void *context, char *buffer, size_t size) {
    byte_source *source = context;
    const size_t count = size < source->rest ? size : source->rest;
    if (count > 0) {
        memcpy(buffer, source->next, count);
        source->next += count;
        source->rest -= count;
    }
    return count;
}

static burnish_status finish_bytes(void *context, burnish_error *error) {
    const byte_source *source = context;
    return source->ready ? source->ready(source->context, error) : BURNISH_STATUS_OK;
}

burnish_status cli_file_write(const char *path, const void *bytes, size_t size,
                              burnish_error *error) {
    return cli_file_write_checked(path, bytes, size, NULL, NULL, error);
}

burnish_status cli_file_write_checked(const char *path, const void *bytes, size_t size,
                                      burnish_file_check *ready, void *context,
                                      burnish_error *error) {
    if (!chosen) {
        return ready ? burnish_file_write_checked(path, bytes, size, ready, context, error)
                     : burnish_file_write(path, bytes, size, error);
    }
    byte_source source = {bytes, size, ready, context};
    return chosen(path, take_bytes, &source, finish_bytes, error);
}

burnish_status cli_file_write_stream(const char *path, burnish_file_source *source, void *context,
                                     burnish_file_check *ready, burnish_error *error) {
    return (chosen ? chosen : burnish_file_write_stream)(path, source, context, ready, error);
}
