/* WebP by libwebp: lossless, or lossy with a given quality. */
#include "picture/animation.h"
#include "picture/formats.h"

#if BURNISH_HAS_WEBP
#include <stdlib.h>
#include <webp/encode.h>
#include <webp/mux.h>

/* Lossy files still have lossless alpha. */
static int webp_configure(WebPConfig *config, int quality, int threads) {
    if (!WebPConfigInit(config)) {
        return 0;
    }
    config->lossless = quality == 0;
    config->quality = quality > 0 ? (float)quality : 20; /* lossless: effort */
    config->method = config->lossless ? 2 : 4;
    config->exact = 1; /* keep colours of transparent pixels */
    config->use_sharp_yuv = 1;
    config->thread_level = threads != 1;
    return WebPValidateConfig(config);
}

static int webp_import(WebPPicture *picture, const burnish_pixels *pixels) {
    const int stride = (int)pixels->stride;
    picture->use_argb = 1;
    picture->width = pixels->width;
    picture->height = pixels->height;
    return pixels->format == BURNISH_PIXELS_RGBA8
               ? WebPPictureImportRGBA(picture, pixels->pixels, stride)
               : WebPPictureImportRGB(picture, pixels->pixels, stride);
}

/* Exif with one entry: software, as PNG's Software. */
static const uint8_t exif[] = "II*\0\x08\0\0\0\1\0\x31\1\2\0\x08\0\0\0\x1A\0\0\0\0\0\0\0burnish";

/* *file: the data with Exif; release it with WebPDataClear(). Returns 0 without memory. */
static int add_software(const WebPData *data, WebPData *file) {
    const WebPData software = {exif, sizeof exif};
    WebPMux *mux = WebPMuxCreate(data, 0);
    const int added = mux && WebPMuxSetChunk(mux, "EXIF", &software, 0) == WEBP_MUX_OK &&
                      WebPMuxAssemble(mux, file) == WEBP_MUX_OK;
    WebPMuxDelete(mux);
    return added;
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
    if (!webp_configure(&config, options->quality, options->threads) ||
        !WebPPictureInit(&picture)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "WebP: another version of libwebp");
    }
    WebPMemoryWriterInit(&writer);
    picture.writer = WebPMemoryWrite;
    picture.custom_ptr = &writer;
    const int encoded = webp_import(&picture, pixels) && WebPEncode(&config, &picture);
    const int code = picture.error_code;
    WebPPictureFree(&picture);
    if (!encoded) {
        WebPMemoryWriterClear(&writer);
        return cli_fail(error, BURNISH_STATUS_MEMORY, "WebP: not encoded (libwebp's error %d)",
                        code);
    }
    WebPData data = {writer.mem, writer.size}, marked = {NULL, 0};
    const int added = add_software(&data, &marked);
    WebPMemoryWriterClear(&writer);
    if (!added) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the WebP");
    }
    file->bytes = (uint8_t *)(uintptr_t)marked.bytes;
    file->size = marked.size;
    file->release = WebPFree;
    return BURNISH_STATUS_OK;
}

/* ---- Animations: libwebpmux collects the compressed frames until the end ---- */

static burnish_status fail_animation(const WebPAnimEncoder *encoder, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_MEMORY, "WebP: %.200s",
                    encoder ? WebPAnimEncoderGetError((WebPAnimEncoder *)encoder)
                            : "no encoder; the frames are too large, or memory is short");
}

static burnish_status webp_begin(picture_animation *animation, burnish_error *error) {
    WebPAnimEncoderOptions options;
    const picture_animation_options *o = &animation->options;
    if (o->width > WEBP_MAX_DIMENSION || o->height > WEBP_MAX_DIMENSION) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "WebP holds at most %d x %d pixels, not %d x %d; write PNG",
                        WEBP_MAX_DIMENSION, WEBP_MAX_DIMENSION, o->width, o->height);
    }
    if (WebPAnimEncoderOptionsInit(&options)) {
        animation->state = WebPAnimEncoderNew(o->width, o->height, &options);
    }
    return animation->state ? BURNISH_STATUS_OK : fail_animation(NULL, error);
}

static burnish_status webp_add(picture_animation *animation, const burnish_image *frame,
                               burnish_error *error) {
    WebPConfig config;
    WebPPicture picture;
    const picture_animation_options *o = &animation->options;
    const burnish_pixels pixels = burnish_image_get_pixels(frame);
    if (!webp_configure(&config, o->quality, o->threads) || !WebPPictureInit(&picture)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "WebP: another version of libwebp");
    }
    const int added = webp_import(&picture, &pixels) &&
                      WebPAnimEncoderAdd(animation->state, &picture,
                                         picture_time(animation, animation->index, 1000), &config);
    WebPPictureFree(&picture);
    return added ? BURNISH_STATUS_OK : fail_animation(animation->state, error);
}

static burnish_status webp_end(picture_animation *animation, burnish_error *error) {
    WebPData data = {NULL, 0}, marked = {NULL, 0};
    if (!WebPAnimEncoderAdd(animation->state, NULL,
                            picture_time(animation, animation->options.frames, 1000), NULL) ||
        !WebPAnimEncoderAssemble(animation->state, &data)) {
        return fail_animation(animation->state, error);
    }
    const int added = add_software(&data, &marked);
    WebPDataClear(&data);
    if (!added) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the WebP");
    }
    picture_put(&animation->out, marked.bytes, marked.size);
    WebPDataClear(&marked);
    return BURNISH_STATUS_OK;
}

static void webp_destroy(void *state) {
    WebPAnimEncoderDelete(state);
}

const picture_animator picture_webp = {webp_begin, webp_add, webp_end, webp_destroy};

#else

static burnish_status webp_begin(picture_animation *animation, burnish_error *error) {
    (void)animation;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "WebP: this build has no libwebp");
}

const picture_animator picture_webp = {webp_begin, NULL, NULL, NULL};

burnish_status picture_encode_webp(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error) {
    (void)pixels, (void)options, (void)file;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "WebP: this build has no libwebp");
}

#endif
