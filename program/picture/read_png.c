#include "picture/read_png.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/options.h"

int picture_is_png(const uint8_t *bytes, size_t size) {
    static const uint8_t signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    return size >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

/* ---- Files ---- */

/* Reads the rest of the stream. */
static burnish_status read_stream(const char *path, FILE *file, uint64_t max_bytes, uint8_t **bytes,
                                  size_t *size, burnish_error *error) {
    size_t capacity = 0;
    for (;;) {
        if (*size == capacity) {
            capacity = capacity ? 2 * capacity : 1 << 16;
            uint8_t *grown = capacity > *size ? realloc(*bytes, capacity) : NULL;
            if (!grown) {
                return cli_fail(error, BURNISH_STATUS_MEMORY, "%.200s: out of memory for the file",
                                path);
            }
            *bytes = grown;
        }
        const size_t count = fread(*bytes + *size, 1, capacity - *size, file);
        *size += count;
        if (*size > max_bytes) {
            return cli_fail(error, BURNISH_STATUS_LIMIT,
                            "%.200s: larger than %llu bytes; raise --max-input-bytes", path,
                            (unsigned long long)max_bytes);
        }
        if (ferror(file)) {
            return cli_fail(error, BURNISH_STATUS_READ, "%.200s: can't be read: %s", path,
                            strerror(errno));
        }
        if (count == 0) {
            return BURNISH_STATUS_OK;
        }
    }
}

burnish_status picture_read_bytes(const char *path, uint64_t max_bytes, uint8_t **bytes,
                                  size_t *size, burnish_error *error) {
    const int standard = strcmp(path, "-") == 0;
    FILE *file = standard ? stdin : fopen(path, "rb");
    *bytes = NULL;
    *size = 0;
    if (!file) {
        return cli_fail(error, BURNISH_STATUS_READ, "%.200s: can't be opened: %s", path,
                        strerror(errno));
    }
    const burnish_status status =
        read_stream(standard ? "standard input" : path, file, max_bytes, bytes, size, error);
    if (!standard) {
        fclose(file);
    }
    if (status != BURNISH_STATUS_OK) {
        free(*bytes);
        *bytes = NULL;
        *size = 0;
    }
    return status;
}

burnish_status picture_read_png(const char *path, uint64_t max_bytes, burnish_image *image,
                                burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    *image = (burnish_image){0};
    burnish_status status = picture_read_bytes(path, max_bytes, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK) {
        status = picture_decode_png(path, bytes, size, image, error);
    }
    free(bytes);
    return status;
}

/* ---- Decoding ---- */

burnish_status picture_decode_png(const char *name, const uint8_t *bytes, size_t size,
                                  burnish_image *image, burnish_error *error) {
    *image = (burnish_image){0};
    if (!picture_is_png(bytes, size)) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "%.200s: not a PNG file; convert the picture to PNG", name);
    }
    return burnish_image_decode(NULL, bytes, size, name, image, error);
}
