/* WebP by libwebp: without loss, or with the quality that is asked for. */
#include "picture/picture.h"

#if BURNISH_HAS_WEBP
#include <webp/encode.h>

/* Where loss is allowed, alpha keeps all its values. */
static int configure(WebPConfig *config, const picture_options *options) {
    if (!WebPConfigInit(config)) {
        return 0;
    }
    config->lossless = options->quality == 0;
    config->quality = options->quality > 0 ? (float)options->quality : 20; /* lossless: effort */
    config->method = config->lossless ? 2 : 4;
    config->exact = 1; /* colours below alpha 0 too: all that was drawn */
    config->use_sharp_yuv = 1;
    config->thread_level = options->threads != 1;
    return WebPValidateConfig(config);
}

burnish_status picture_encode_webp(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error) {
    WebPConfig config;
    WebPPicture picture;
    WebPMemoryWriter writer;
    if (pixels->width > WEBP_MAX_DIMENSION || pixels->height > WEBP_MAX_DIMENSION) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "WebP holds at most %d x %d pixels, not %d x %d; write PNG",
                        WEBP_MAX_DIMENSION, WEBP_MAX_DIMENSION, pixels->width, pixels->height);
    }
    if (!configure(&config, options) || !WebPPictureInit(&picture)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "WebP: another version of libwebp");
    }
    WebPMemoryWriterInit(&writer);
    picture.use_argb = config.lossless || config.use_sharp_yuv;
    picture.width = pixels->width;
    picture.height = pixels->height;
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    const int stride = (int)pixels->stride;
    const int imported = pixels->format == BURNISH_PIXELS_RGBA8
                             ? WebPPictureImportRGBA(&picture, pixels->pixels, stride)
                             : WebPPictureImportRGB(&picture, pixels->pixels, stride);
    const int encoded = imported && WebPEncode(&config, &picture);
    const int code = picture.error_code;
    WebPPictureFree(&picture);
    if (!encoded) {
        WebPMemoryWriterClear(&writer);
        return cli_fail(error, BURNISH_STATUS_MEMORY, "WebP: not encoded (libwebp's error %d)",
                        code);
    }
    file->bytes = writer.mem;
    file->size = writer.size;
    file->release = WebPFree;
    return BURNISH_STATUS_OK;
}

#else

burnish_status picture_encode_webp(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error) {
    (void)pixels, (void)options, (void)file;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "WebP: this build has no libwebp");
}

#endif
