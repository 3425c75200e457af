#include "picture/read_png.h"

#include <stdlib.h>
#include <string.h>

#include "cli/input.h"

int picture_is_png(const uint8_t *bytes, size_t size) {
    static const uint8_t signature[8] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    return size >= sizeof signature && memcmp(bytes, signature, sizeof signature) == 0;
}

burnish_status picture_read_png(const char *path, uint64_t max_bytes, burnish_image *image,
                                burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    *image = (burnish_image){0};
    burnish_status status = cli_read_bytes(path, max_bytes, picture_is_png, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK) {
        status = picture_decode_png(path, bytes, size, image, error);
    }
    free(bytes);
    return status;
}

burnish_status picture_decode_png(const char *name, const uint8_t *bytes, size_t size,
                                  burnish_image *image, burnish_error *error) {
    *image = (burnish_image){0};
    if (!picture_is_png(bytes, size)) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "%.200s: not a PNG file; convert the picture to PNG", name);
    }
    return burnish_image_decode(NULL, bytes, size, name, image, error);
}
