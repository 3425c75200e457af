/* OpenEXR by its C core: scan lines in ZIP blocks of 16, without loss. */
#include "picture/exr.h"
#include "picture/formats.h"
#include "picture/npy.h"

#if BURNISH_HAS_EXR
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

/* The file in memory; the library seeks back to fill in its table of offsets. */
typedef struct growing {
    uint8_t *bytes;
    size_t size, capacity;
    char reason[160]; /* the library's error message */
} growing;

static int64_t write_bytes(exr_const_context_t codec, void *user_data, const void *buffer,
                           uint64_t size, uint64_t offset, exr_stream_error_func_ptr_t report) {
    growing *file = user_data;
    const uint64_t end = offset + size;
    if (end > file->capacity) {
        const size_t capacity = (size_t)(end > SIZE_MAX / 2 ? 0 : end + end / 2);
        uint8_t *grown = capacity > 0 ? realloc(file->bytes, capacity) : NULL;
        if (!grown) {
            report(codec, EXR_ERR_OUT_OF_MEMORY, "no memory for the file");
            return -1;
        }
        memset(grown + file->capacity, 0, capacity - file->capacity);
        file->bytes = grown;
        file->capacity = capacity;
    }
    memcpy(file->bytes + offset, buffer, (size_t)size);
    file->size = end > file->size ? (size_t)end : file->size;
    return (int64_t)size;
}

/* Receives messages that the library would print to standard error. */
static void take_reason(exr_const_context_t codec, exr_result_t code, const char *reason) {
    void *user_data = NULL;
    (void)code;
    if (exr_get_user_data(codec, &user_data) == EXR_ERR_SUCCESS && user_data) {
        growing *file = user_data;
        strncpy(file->reason, reason, sizeof file->reason - 1);
    }
}

static exr_pixel_type_t type_of(const picture_channel *channel) {
    return channel->kind == PICTURE_FLOAT ? EXR_PIXEL_FLOAT : EXR_PIXEL_UINT;
}

static exr_result_t write_header(exr_context_t codec, const picture_channels *channels) {
    int part;
    exr_result_t result = exr_add_part(codec, NULL, EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS) {
        result = exr_initialize_required_attr_simple(codec, part, channels->width, channels->height,
                                                     EXR_COMPRESSION_ZIP);
    }
    if (result == EXR_ERR_SUCCESS) {
        result = exr_attr_set_string(codec, part, "software", "burnish");
    }
    for (int i = 0; i < channels->count && result == EXR_ERR_SUCCESS; ++i) {
        const picture_channel *channel = &channels->items[i];
        result = exr_add_channel(codec, part, channel->name, type_of(channel),
                                 EXR_PERCEPTUALLY_LINEAR, 1, 1);
    }
    return result == EXR_ERR_SUCCESS ? exr_write_header(codec) : result;
}

/* Points the pipeline's channels, which the library has sorted, at rows from y on. */
static void point_channels(exr_encode_pipeline_t *pipeline, const picture_channels *channels,
                           int y) {
    for (int i = 0; i < pipeline->channel_count; ++i) {
        exr_coding_channel_info_t *to = &pipeline->channels[i];
        const picture_channel *from = channels->items;
        while (strcmp(from->name, to->channel_name) != 0) {
            ++from;
        }
        const size_t row = from->step * (size_t)channels->width;
        to->user_bytes_per_element = 4;
        to->user_data_type = (uint16_t)type_of(from);
        to->user_pixel_stride = (int32_t)from->step;
        to->user_line_stride = (int32_t)row;
        to->encode_from_ptr = (const uint8_t *)from->values + row * (size_t)y;
    }
}

static exr_result_t write_rows(exr_context_t codec, const picture_channels *channels) {
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t rows = 1;
    exr_result_t result = exr_get_scanlines_per_chunk(codec, 0, &rows);
    for (int y = 0; y < channels->height && result == EXR_ERR_SUCCESS; y += rows) {
        exr_chunk_info_t chunk;
        result = exr_write_scanline_chunk_info(codec, 0, y, &chunk);
        if (result == EXR_ERR_SUCCESS) {
            result = y == 0 ? exr_encoding_initialize(codec, 0, &chunk, &pipeline)
                            : exr_encoding_update(codec, 0, &chunk, &pipeline);
        }
        if (result == EXR_ERR_SUCCESS) {
            point_channels(&pipeline, channels, y);
            result = y == 0 ? exr_encoding_choose_default_routines(codec, 0, &pipeline) : result;
        }
        if (result == EXR_ERR_SUCCESS) {
            result = exr_encoding_run(codec, 0, &pipeline);
        }
    }
    exr_encoding_destroy(codec, &pipeline);
    return result;
}

burnish_status picture_encode_exr(const picture_channels *channels, picture_file *file,
                                  burnish_error *error) {
    growing grown = {0};
    exr_context_t codec = NULL;
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &grown;
    setup.write_fn = write_bytes;
    setup.error_handler_fn = take_reason;
    *file = (picture_file){0};
    exr_result_t result = exr_start_write(&codec, "memory", EXR_WRITE_FILE_DIRECTLY, &setup);
    if (result == EXR_ERR_SUCCESS) {
        result = write_header(codec, channels);
    }
    if (result == EXR_ERR_SUCCESS) {
        result = write_rows(codec, channels);
    }
    const exr_result_t closed = codec ? exr_finish(&codec) : EXR_ERR_SUCCESS;
    result = result == EXR_ERR_SUCCESS ? closed : result;
    if (result != EXR_ERR_SUCCESS) {
        free(grown.bytes);
        return cli_fail(error, BURNISH_STATUS_MEMORY, "OpenEXR: %s",
                        grown.reason[0] ? grown.reason : exr_get_default_error_message(result));
    }
    file->bytes = grown.bytes;
    file->size = grown.size;
    return BURNISH_STATUS_OK;
}

#else

burnish_status picture_encode_exr(const picture_channels *channels, picture_file *file,
                                  burnish_error *error) {
    (void)channels;
    *file = (picture_file){0};
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "OpenEXR: this build has no OpenEXRCore");
}

#endif
