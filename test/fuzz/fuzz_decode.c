/* Fuzzes the image decoders: libFuzzer's bytes are decoded as PNG, JPEG, WebP, BMP or TGA, and as
 * an environment, Radiance HDR or EXR. A decoded image must have a size and every byte written;
 * otherwise the error must be one line.
 *
 * Built by `make fuzz`; test/fuzz/run starts it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/image.h"
#include "burnish/light.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(int condition, const char *what, const burnish_error *error) {
    if (!condition) {
        fprintf(stderr, "fuzz_decode: %s: %s\n", what, error->text);
        abort();
    }
}

static void decode_environment(const uint8_t *data, size_t size) {
    burnish_error error = {0};
    burnish_environment *environment;
    const burnish_status status =
        burnish_environment_decode(NULL, data, size, NULL, &environment, &error);
    require((status == BURNISH_STATUS_OK) == (environment != NULL), "environment", &error);
    require(environment || (error.status == status && *error.text && !strchr(error.text, '\n')),
            "not one line", &error);
    burnish_environment_destroy(environment);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    burnish_error error = {0};
    burnish_image image;
    const burnish_status status = burnish_image_decode(NULL, data, size, NULL, &image, &error);
    if (status == BURNISH_STATUS_OK) {
        require(image.width > 0 && image.height > 0 && (image.channels == 3 || image.channels == 4),
                "size", &error);
        require(burnish_image_hash(&image) != 0, "hash", &error); /* reads every byte */
    } else {
        require(error.status == status && *error.text && !strchr(error.text, '\n'), "not one line",
                &error);
        require(!image.pixels, "not empty", &error);
    }
    burnish_image_destroy(&image);
    decode_environment(data, size);
    return 0;
}
