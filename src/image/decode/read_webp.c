/* WebP through libwebp. */
#include "image/decode/decode.h"

#if BURNISH_HAS_WEBP
#include <webp/decode.h>

#include "image/decode/sanitize.h"

burnish_status burnish_decode_webp(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture) {
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config) ||
        WebPGetFeatures(from->bytes, from->size, &config.input) != VP8_STATUS_OK) {
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT, "%.200s: no sound WebP",
                            from->name);
    }
    burnish_written_outside(&config, sizeof config);
    const int channels = from->channels == 4 || config.input.has_alpha ? 4 : 3;
    burnish_status status =
        burnish_decode_reserve(from, (uint64_t)config.input.width, (uint64_t)config.input.height,
                               channels, memory, picture);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t row = (size_t)picture->width * (size_t)channels;
    config.output.colorspace = channels == 4 ? MODE_RGBA : MODE_RGB;
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = picture->pixels;
    config.output.u.RGBA.stride = (int)row;
    config.output.u.RGBA.size = row * (size_t)picture->height;
    const VP8StatusCode code = WebPDecode(from->bytes, from->size, &config);
    burnish_written_outside(picture->pixels, row * (size_t)picture->height);
    /* libwebp also returns USER_ABORT if it gets no memory */
    if (code == VP8_STATUS_OUT_OF_MEMORY || code == VP8_STATUS_USER_ABORT) {
        return burnish_fail(memory->error, BURNISH_STATUS_MEMORY,
                            "%.200s: out of memory; free memory or use a smaller picture",
                            from->name);
    }
    return code == VP8_STATUS_OK
               ? BURNISH_STATUS_OK
               : burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                              "%.200s: no sound WebP, libwebp's code is %d", from->name, (int)code);
}

#else

burnish_status burnish_decode_webp(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture) {
    (void)picture;
    return burnish_fail(memory->error, BURNISH_STATUS_ARGUMENT,
                        "%.200s: this burnish reads no WebP: it was built without libwebp",
                        from->name);
}

#endif
