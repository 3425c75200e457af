/* OpenEXR by its C core. */
#include "image/decode/decode.h"

#if BURNISH_HAS_EXR
#include <openexr.h>
#include <string.h>

#include "image/decode/sanitize.h"

/* The most bytes of a chunk: rows or a tile. */
#define CHUNK_MAX ((uint64_t)1 << 28)

typedef struct exr {
    const burnish_encoded *from;
    burnish_memory *memory;
    exr_context_t codec;
    int width, height, is_gray;
    float *colors[3]; /* of a chunk */
    char reason[160]; /* the library's first error message */
} exr;

static burnish_status fail(const exr *e, burnish_status status, const char *what) {
    return burnish_fail(e->memory->error, status, "%.200s: %s", e->from->name, what);
}

static burnish_status fail_codec(const exr *e, exr_result_t result) {
    if (result == EXR_ERR_OUT_OF_MEMORY) {
        return burnish_fail_memory(e->memory->error, e->from->name, e->from->size);
    }
    return burnish_fail(e->memory->error, BURNISH_STATUS_FORMAT,
                        "%.200s: this EXR can't be decoded: %.150s", e->from->name,
                        e->reason[0] ? e->reason : exr_get_default_error_message(result));
}

/* ---- The library's view of the file ---- */

static int64_t read_bytes(exr_const_context_t codec, void *user_data, void *buffer, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t report) {
    const exr *e = user_data;
    const uint64_t left = offset < e->from->size ? e->from->size - offset : 0;
    const uint64_t count = size < left ? size : left;
    (void)codec, (void)report;
    memcpy(buffer, e->from->bytes + (count > 0 ? offset : 0), (size_t)count);
    return (int64_t)count;
}

static int64_t find_size(exr_const_context_t codec, void *user_data) {
    (void)codec;
    return (int64_t)((const exr *)user_data)->from->size;
}

/* Receives messages that the library would print to standard error. */
static void take_reason(exr_const_context_t codec, exr_result_t code, const char *reason) {
    void *user_data = NULL;
    (void)code;
    if (exr_get_user_data(codec, &user_data) == EXR_ERR_SUCCESS && user_data) {
        exr *e = user_data;
        if (!e->reason[0]) {
            strncpy(e->reason, reason, sizeof e->reason - 1);
        }
    }
}

/* ---- Chunks ---- */

/* Directs R, G and B, or Y, to the arrays. Returns 0 if there are neither. */
static int choose_channels(exr *e, exr_decode_pipeline_t *pipeline) {
    static const char *const names[4] = {"R", "G", "B", "Y"};
    int found = 0, is_whole = 1;
    for (int i = 0; i < pipeline->channel_count; ++i) {
        exr_coding_channel_info_t *to = &pipeline->channels[i];
        int k = 0;
        while (k < 4 && strcmp(names[k], to->channel_name) != 0) {
            ++k;
        }
        to->decode_to_ptr = NULL;
        if (k == 4) {
            continue;
        }
        found |= 1 << k;
        is_whole = is_whole && to->x_samples == 1 && to->y_samples == 1;
        to->user_bytes_per_element = sizeof(float);
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_pixel_stride = sizeof(float);
        to->user_line_stride = to->width * (int32_t)sizeof(float);
        to->decode_to_ptr = (uint8_t *)e->colors[k % 3];
    }
    e->is_gray = found == 8;
    return is_whole && (found == 7 || found == 8);
}

/* Decodes a chunk whose first pixel is (x, y). */
static burnish_status read_chunk(exr *e, exr_decode_pipeline_t *pipeline,
                                 const exr_chunk_info_t *chunk, int x, int y,
                                 const burnish_float_sink *sink) {
    const int is_first = pipeline->channels == NULL;
    exr_result_t result = is_first ? exr_decoding_initialize(e->codec, 0, chunk, pipeline)
                                   : exr_decoding_update(e->codec, 0, chunk, pipeline);
    if (result == EXR_ERR_SUCCESS && !choose_channels(e, pipeline)) {
        return fail(e, BURNISH_STATUS_FORMAT,
                    "neither channels R, G and B nor Y alone in full resolution; convert it");
    }
    if (result == EXR_ERR_SUCCESS && is_first) {
        result = exr_decoding_choose_default_routines(e->codec, 0, pipeline);
    }
    if (result == EXR_ERR_SUCCESS) {
        result = exr_decoding_run(e->codec, 0, pipeline);
    }
    if (result != EXR_ERR_SUCCESS) {
        return fail_codec(e, result);
    }
    size_t at = 0;
    for (int j = 0; j < chunk->height; ++j) {
        for (int i = 0; i < chunk->width; ++i, ++at) {
            const float rgb[3] = {e->colors[0][at], e->colors[e->is_gray ? 0 : 1][at],
                                  e->colors[e->is_gray ? 0 : 2][at]};
            sink->add(sink->context, x + i, y + j, rgb);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_rows(exr *e, int top, exr_decode_pipeline_t *pipeline,
                                const burnish_float_sink *sink) {
    int32_t rows = 1;
    burnish_status status = BURNISH_STATUS_OK;
    exr_result_t result = exr_get_scanlines_per_chunk(e->codec, 0, &rows);
    for (int y = 0; y < e->height && status == BURNISH_STATUS_OK; y += rows) {
        exr_chunk_info_t chunk;
        if (result == EXR_ERR_SUCCESS) {
            result = exr_read_scanline_chunk_info(e->codec, 0, top + y, &chunk);
        }
        status = result == EXR_ERR_SUCCESS ? read_chunk(e, pipeline, &chunk, 0, y, sink)
                                           : fail_codec(e, result);
    }
    return status;
}

static burnish_status read_tiles(exr *e, exr_decode_pipeline_t *pipeline,
                                 const burnish_float_sink *sink) {
    int32_t width = 0, height = 0;
    burnish_status status = BURNISH_STATUS_OK;
    exr_result_t result = exr_get_tile_sizes(e->codec, 0, 0, 0, &width, &height);
    if (result != EXR_ERR_SUCCESS || width < 1 || height < 1) {
        return fail_codec(e, result);
    }
    for (int y = 0; y < e->height; y += height) {
        for (int x = 0; x < e->width && status == BURNISH_STATUS_OK; x += width) {
            exr_chunk_info_t chunk;
            result = exr_read_tile_chunk_info(e->codec, 0, x / width, y / height, 0, 0, &chunk);
            status = result == EXR_ERR_SUCCESS ? read_chunk(e, pipeline, &chunk, x, y, sink)
                                               : fail_codec(e, result);
        }
    }
    return status;
}

static burnish_status read_pixels(exr *e, int top, exr_storage_t storage,
                                  const burnish_float_sink *sink) {
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t width = e->width, height = 1;
    uint64_t bytes = 0;
    exr_get_chunk_unpacked_size(e->codec, 0, &bytes);
    if (storage == EXR_STORAGE_TILED) {
        exr_get_tile_sizes(e->codec, 0, 0, 0, &width, &height);
    } else {
        exr_get_scanlines_per_chunk(e->codec, 0, &height);
    }
    const uint64_t pixels = (uint64_t)(width > 0 ? width : 0) * (uint64_t)(height > 0 ? height : 0);
    if (bytes > CHUNK_MAX || pixels > CHUNK_MAX / 12) {
        return fail(e, BURNISH_STATUS_LIMIT, "blocks of more than 256 MiB; convert it");
    }
    float *colors =
        burnish_allocate_zeroed(e->memory, 3 * (size_t)pixels, sizeof(float), e->from->name);
    for (size_t k = 0; k < 3 && colors; ++k) {
        e->colors[k] = colors + k * (size_t)pixels;
    }
    burnish_status status = e->memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = storage == EXR_STORAGE_TILED ? read_tiles(e, &pipeline, sink)
                                              : read_rows(e, top, &pipeline, sink);
        exr_decoding_destroy(e->codec, &pipeline);
        burnish_release(e->memory->context, colors);
    }
    return status;
}

static burnish_status read_part(exr *e, const burnish_float_sink *sink) {
    exr_attr_box2i_t window;
    exr_storage_t storage;
    exr_result_t result = exr_get_storage(e->codec, 0, &storage);
    if (result == EXR_ERR_SUCCESS) {
        result = exr_get_data_window(e->codec, 0, &window);
    }
    if (result != EXR_ERR_SUCCESS) {
        return fail_codec(e, result);
    }
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) {
        return fail(e, BURNISH_STATUS_FORMAT, "deep images are not supported; convert it");
    }
    const int64_t width = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    burnish_status status = burnish_decode_check(e->from, (uint64_t)(width > 0 ? width : 0),
                                                 (uint64_t)(height > 0 ? height : 0), e->memory);
    if (status == BURNISH_STATUS_OK) {
        status = sink->begin(sink->context, (uint64_t)width, (uint64_t)height);
    }
    e->width = (int)width;
    e->height = (int)height;
    return status == BURNISH_STATUS_OK ? read_pixels(e, window.min.y, storage, sink) : status;
}

burnish_status burnish_decode_exr(const burnish_encoded *from, burnish_memory *memory,
                                  const burnish_float_sink *sink) {
    exr e = {.from = from, .memory = memory};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &e;
    setup.read_fn = read_bytes;
    setup.size_fn = find_size;
    setup.error_handler_fn = take_reason;
    const exr_result_t result = exr_start_read(&e.codec, "memory", &setup);
    const burnish_status status =
        result == EXR_ERR_SUCCESS ? read_part(&e, sink) : fail_codec(&e, result);
    exr_finish(&e.codec);
    return status;
}

#else

burnish_status burnish_decode_exr(const burnish_encoded *from, burnish_memory *memory,
                                  const burnish_float_sink *sink) {
    (void)sink;
    return burnish_fail(memory->error, BURNISH_STATUS_ARGUMENT,
                        "%.200s: this burnish reads no EXR: it was built without OpenEXR; convert "
                        "it to Radiance HDR",
                        from->name);
}

#endif
