/* Fuzzes the image decoders: libFuzzer's bytes are decoded as PNG, JPEG, WebP, BMP or TGA, and as
 * an environment, Radiance HDR or EXR. A decoded image must have a size and every byte or pixel
 * written; otherwise the error must be one line.
 *
 * Built by `make fuzz`; test/fuzz/run starts it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "burnish/image.h"
#include "burnish/light.h"
#include "image/decode/decode.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(int condition, const char *what, const burnish_error *error) {
    if (!condition) {
        fprintf(stderr, "fuzz_decode: %s: %s\n", what, error ? error->text : "");
        abort();
    }
}

/* ---- Environments ---- */

enum { SIDE_MAX = 1 << 15, PIXELS_MAX = 1 << 14 /* so that most inputs take little time */ };

typedef struct pixels {
    uint64_t width, height, count;
    float sum;
} pixels;

static burnish_status begin(void *context, uint64_t width, uint64_t height, uint64_t pixel_bytes) {
    pixels *p = context;
    *p = (pixels){.width = width, .height = height};
    return width * height > PIXELS_MAX || pixel_bytes == 0
               ? burnish_fail(NULL, BURNISH_STATUS_LIMIT, "large")
               : BURNISH_STATUS_OK;
}

static void add(void *context, int x, int y, const float rgb[3]) {
    pixels *p = context;
    require(x >= 0 && y >= 0 && (uint64_t)x < p->width && (uint64_t)y < p->height, "place", NULL);
    p->sum += rgb[0] + rgb[1] + rgb[2]; /* reads them */
    ++p->count;
}

static void decode_environment(const uint8_t *data, size_t size) {
    burnish_error error = {0};
    burnish_memory memory = burnish_memory_of(NULL, &error);
    burnish_environment *environment;
    pixels p = {0};
    const burnish_encoded from = {.bytes = data,
                                  .size = size,
                                  .name = "fuzz",
                                  .max_side = SIDE_MAX,
                                  .max_pixels = UINT64_MAX};
    burnish_status status =
        burnish_decode_floats(&from, &memory, &(burnish_float_sink){begin, add, &p});
    require(status != BURNISH_STATUS_OK || p.count == p.width * p.height, "pixels", &error);
    if (status == BURNISH_STATUS_LIMIT) {
        return;
    }
    status = burnish_environment_decode(NULL, data, size, NULL, &environment, &error);
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
