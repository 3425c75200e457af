/* OpenEXR by its C core, which parses the file and unpacks blocks. Samples are converted here: the
 * library's fast conversions write every channel, wanted or not. */
#include "image/decode/decode.h"

#if BURNISH_HAS_EXR
#include <openexr.h>
#include <stdlib.h>
#include <string.h>

#include "base/bytes.h"
#include "base/context.h"
#include "image/decode/sanitize.h"

/* The most bytes of a chunk: rows or a tile. */
#define CHUNK_MAX ((uint64_t)1 << 28)

/* The most bytes of all headers: the library's time grows with the square of their attributes. */
#define HEADER_MAX ((size_t)1 << 19)

enum { CHANNELS = 3, ZLIB_MEMORY = 1 << 16 };

typedef struct exr {
    const burnish_encoded *from;
    burnish_memory *memory;
    exr_context_t codec;
    int is_open, is_long; /* the headers are read; they go beyond HEADER_MAX */
    int part;
    exr_storage_t storage;
    uint64_t pixel_bytes;   /* of all channels, each in full resolution */
    int channels[CHANNELS]; /* R, G and B; RY, Y and BY; or Y three times */
    int is_chroma;
    int top, width, height;       /* of the data window */
    float *rows[CHANNELS];        /* the latest samples of the channels, one per pixel */
    exr_decode_pipeline_t blocks; /* of which the current one is decoded */
    char reason[160];             /* the library's first error message */
} exr;

/* Of this thread, since the library's allocators get no context. Its own error codes don't tell: some
 * hide that memory is short, and damaged PXR24 counts as such. */
static _Thread_local int ran_short;

static burnish_status exr_fail(const exr *e, burnish_status status, const char *what) {
    return burnish_fail(e->memory->error, status, "%.200s: %s", e->from->name, what);
}

static burnish_status fail_codec(const exr *e, exr_result_t result) {
    if (e->is_long && !e->is_open) {
        return exr_fail(e, BURNISH_STATUS_LIMIT, "headers of more than 512 KiB; convert it");
    }
    if (ran_short) {
        return burnish_fail_memory(e->memory->error, e->from->name, e->from->size);
    }
    return burnish_fail(e->memory->error, BURNISH_STATUS_FORMAT,
                        "%.200s: this EXR can't be decoded: %.150s", e->from->name,
                        e->reason[0] ? e->reason : exr_get_default_error_message(result));
}

/* ---- The library's view of the file ---- */

static int64_t read_bytes(exr_const_context_t codec, void *user_data, void *buffer, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t report) {
    exr *e = user_data;
    const int is_long = !e->is_open && offset < e->from->size && offset + size > HEADER_MAX;
    const uint64_t left = offset < e->from->size && !is_long ? e->from->size - offset : 0;
    const uint64_t count = size < left ? size : left;
    e->is_long |= is_long;
    (void)codec, (void)report;
    memcpy(buffer, e->from->bytes + (count > 0 ? offset : 0), (size_t)count);
    return (int64_t)count;
}

static int64_t find_size(exr_const_context_t codec, void *user_data) {
    (void)codec;
    return (int64_t)((const exr *)user_data)->from->size;
}

/* Cleared: the library can leave parts of a damaged block unwritten. */
static void *exr_allocate(size_t size) {
    void *memory = calloc(1, size);
    ran_short |= memory == NULL;
    return memory;
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

/* ---- Parts and channels ---- */

static int find_channel(const exr_attr_chlist_t *list, const char *name) {
    int i = 0;
    while (i < list->num_channels && strcmp(list->entries[i].name.str, name) != 0) {
        ++i;
    }
    return i < list->num_channels ? i : -1;
}

static int find_channels(exr *e, const exr_attr_chlist_t *list) {
    static const char *const sets[][CHANNELS] = {
        {"R", "G", "B"}, {"RY", "Y", "BY"}, {"Y", "Y", "Y"}};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
        int found = 1;
        for (int k = 0; k < CHANNELS; ++k) {
            e->channels[k] = find_channel(list, sets[i][k]);
            found &= e->channels[k] >= 0;
        }
        if (found) {
            e->is_chroma = i == 1;
            return 1;
        }
    }
    return 0;
}

/* Whether part `e->part` can be read; *is_deep: if not, only because it is deep. */
static int is_readable(exr *e, exr_result_t *result, int *is_deep) {
    const exr_attr_chlist_t *list = NULL;
    *result = exr_get_storage(e->codec, e->part, &e->storage);
    if (*result == EXR_ERR_SUCCESS) {
        *result = exr_get_channels(e->codec, e->part, &list);
    }
    if (*result != EXR_ERR_SUCCESS || !find_channels(e, list)) {
        return 0;
    }
    for (int i = 0; i < list->num_channels; ++i) {
        e->pixel_bytes += list->entries[i].pixel_type == EXR_PIXEL_HALF ? 2 : 4;
    }
    *is_deep = e->storage != EXR_STORAGE_SCANLINE && e->storage != EXR_STORAGE_TILED;
    return !*is_deep;
}

/* Chooses the first part that can be read. */
static burnish_status choose_part(exr *e) {
    int count = 0, is_deep = 0;
    exr_result_t result = exr_get_count(e->codec, &count);
    while (e->part < count && result == EXR_ERR_SUCCESS && !is_readable(e, &result, &is_deep)) {
        e->pixel_bytes = 0;
        ++e->part;
    }
    if (result != EXR_ERR_SUCCESS) {
        return fail_codec(e, result);
    }
    if (e->part == count) {
        return exr_fail(e, BURNISH_STATUS_FORMAT,
                        is_deep ? "deep images are not supported; convert it"
                                : "neither channels R, G and B nor Y; convert it");
    }
    if (count > 1) {
        burnish_error line;
        burnish_fail(&line, BURNISH_STATUS_FORMAT, "%.200s: only part %d of %d is used",
                     e->from->name, e->part + 1, count);
        burnish_context_warn(e->memory->context, line.text);
    }
    return BURNISH_STATUS_OK;
}

/* ---- Samples ---- */

static float half_to_float(uint32_t half) {
    const uint32_t size = half & 0x7fff;
    const uint32_t rebias = size < 0x7c00 ? 127 - 15 : 255 - 31; /* infinities and NaN stay such */
    const uint32_t bits = (size + (rebias << 10)) << 13;
    float value;
    memcpy(&value, &bits, sizeof value);
    value = size < 0x400 ? (float)size * 0x1p-24f : value;
    return half & 0x8000 ? -value : value;
}

/* Fills a row; each sample is that of x_samples pixels. */
static void read_samples(const exr *e, const uint8_t *bytes,
                         const exr_coding_channel_info_t *channel, float *row) {
    int x = 0;
    for (int i = 0; i < channel->width; ++i, bytes += channel->bytes_per_element) {
        const float value = channel->data_type == EXR_PIXEL_HALF
                                ? half_to_float(burnish_load16(bytes))
                            : channel->data_type == EXR_PIXEL_FLOAT ? burnish_load_float(bytes)
                                                                    : (float)burnish_load32(bytes);
        for (int k = 0; k < channel->x_samples && x < e->width; ++k) {
            row[x++] = value;
        }
    }
}

/* Reads line y of the decoded block from *bytes on. Returns 0 if the block is too short. */
static int read_line(const exr *e, int y, const uint8_t **bytes, const uint8_t *end) {
    for (int i = 0; i < e->blocks.channel_count; ++i) {
        const exr_coding_channel_info_t *channel = &e->blocks.channels[i];
        const size_t size = (size_t)channel->width * (size_t)channel->bytes_per_element;
        if (channel->y_samples > 1 && y % channel->y_samples != 0) {
            continue;
        }
        if (size > (size_t)(end - *bytes)) {
            return 0;
        }
        for (int k = 0; k < CHANNELS; ++k) {
            if (e->channels[k] == i) {
                read_samples(e, *bytes, channel, e->rows[k]);
            }
        }
        *bytes += size;
    }
    return 1;
}

/* Luminance, and chroma relative to it, with the weights of Rec. 709. */
static void to_rgb(float rgb[3]) {
    const float y = rgb[1];
    rgb[0] = (rgb[0] + 1) * y;
    rgb[2] = (rgb[2] + 1) * y;
    rgb[1] = (y - 0.2126f * rgb[0] - 0.0722f * rgb[2]) / 0.7152f;
}

/* ---- Blocks ---- */

/* Decodes a block to e->blocks. */
static burnish_status decode_block(exr *e, const exr_chunk_info_t *chunk) {
    exr_decode_pipeline_t *blocks = &e->blocks;
    const int is_first = blocks->channels == NULL;
    exr_result_t result = is_first ? exr_decoding_initialize(e->codec, e->part, chunk, blocks)
                                   : exr_decoding_update(e->codec, e->part, chunk, blocks);
    if (result == EXR_ERR_SUCCESS && is_first) {
        result = exr_decoding_choose_default_routines(e->codec, e->part, blocks);
        blocks->unpack_and_convert_fn = NULL;
    }
    if (result == EXR_ERR_SUCCESS) {
        result = exr_decoding_run(e->codec, e->part, blocks);
    }
    if (result == EXR_ERR_CORRUPT_CHUNK) { /* also if zlib got no memory, so there must be some */
        free(exr_allocate(ZLIB_MEMORY));
        result = exr_decoding_run(e->codec, e->part, blocks);
    }
    return result == EXR_ERR_SUCCESS ? BURNISH_STATUS_OK : fail_codec(e, result);
}

/* Reads a block whose first pixel is (x, y). */
static burnish_status read_block(exr *e, const exr_chunk_info_t *chunk, int x, int y,
                                 const burnish_float_sink *sink) {
    burnish_status status = decode_block(e, chunk);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const uint8_t *bytes = e->blocks.unpacked_buffer;
    const uint8_t *end = bytes + (bytes ? chunk->unpacked_size : 0);
    int is_damaged =
        chunk->width > e->width - x || chunk->height > e->height - y ||
        (chunk->compression == EXR_COMPRESSION_NONE && chunk->packed_size != chunk->unpacked_size);
    burnish_written_outside(bytes, (size_t)(end - bytes));
    for (int j = 0; j < chunk->height && !is_damaged; ++j) {
        is_damaged = !read_line(e, e->top + y + j, &bytes, end);
        for (int i = 0; i < chunk->width && !is_damaged; ++i) {
            float rgb[CHANNELS] = {e->rows[0][i], e->rows[1][i], e->rows[2][i]};
            if (e->is_chroma) {
                to_rgb(rgb);
            }
            sink->add(sink->context, x + i, y + j, rgb);
        }
    }
    return is_damaged ? exr_fail(e, BURNISH_STATUS_FORMAT,
                                 "a block has another size than its pixels; it is damaged")
                      : BURNISH_STATUS_OK;
}

static burnish_status read_blocks(exr *e, int width, int height, const burnish_float_sink *sink) {
    burnish_status status = BURNISH_STATUS_OK;
    for (int y = 0; y < e->height; y += height) {
        for (int x = 0; x < e->width && status == BURNISH_STATUS_OK; x += width) {
            exr_chunk_info_t chunk;
            const exr_result_t result =
                e->storage == EXR_STORAGE_TILED
                    ? exr_read_tile_chunk_info(e->codec, e->part, x / width, y / height, 0, 0,
                                               &chunk)
                    : exr_read_scanline_chunk_info(e->codec, e->part, e->top + y, &chunk);
            status = result == EXR_ERR_SUCCESS ? read_block(e, &chunk, x, y, sink)
                                               : fail_codec(e, result);
        }
    }
    return status;
}

static burnish_status read_pixels(exr *e, const burnish_float_sink *sink) {
    int32_t width = e->width, height = 1;
    uint64_t bytes = 0;
    exr_result_t result = exr_get_chunk_unpacked_size(e->codec, e->part, &bytes);
    if (result == EXR_ERR_SUCCESS) {
        result = e->storage == EXR_STORAGE_TILED
                     ? exr_get_tile_sizes(e->codec, e->part, 0, 0, &width, &height)
                     : exr_get_scanlines_per_chunk(e->codec, e->part, &height);
    }
    if (result != EXR_ERR_SUCCESS || width < 1 || height < 1) {
        return fail_codec(e, result);
    }
    if (bytes > CHUNK_MAX) {
        return exr_fail(e, BURNISH_STATUS_LIMIT, "blocks of more than 256 MiB; convert it");
    }
    float *rows = burnish_allocate_zeroed(e->memory, CHANNELS * (size_t)e->width, sizeof(float),
                                          e->from->name);
    if (!rows) {
        return e->memory->status;
    }
    for (int k = 0; k < CHANNELS; ++k) {
        e->rows[k] = rows + k * (size_t)e->width;
    }
    const burnish_status status = read_blocks(e, width, height, sink);
    exr_decoding_destroy(e->codec, &e->blocks);
    burnish_release(e->memory->context, rows);
    return status;
}

static burnish_status read_part(exr *e, const burnish_float_sink *sink) {
    exr_attr_box2i_t window;
    burnish_status status = choose_part(e);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const exr_result_t result = exr_get_data_window(e->codec, e->part, &window);
    if (result != EXR_ERR_SUCCESS) {
        return fail_codec(e, result);
    }
    const int64_t width = (int64_t)window.max.x - window.min.x + 1;
    const int64_t height = (int64_t)window.max.y - window.min.y + 1;
    status = burnish_decode_check(e->from, (uint64_t)(width > 0 ? width : 0),
                                  (uint64_t)(height > 0 ? height : 0), e->memory);
    if (status == BURNISH_STATUS_OK) {
        status = sink->begin(sink->context, (uint64_t)width, (uint64_t)height, e->pixel_bytes);
    }
    e->top = window.min.y;
    e->width = (int)width;
    e->height = (int)height;
    return status == BURNISH_STATUS_OK ? read_pixels(e, sink) : status;
}

burnish_status burnish_decode_exr(const burnish_encoded *from, burnish_memory *memory,
                                  const burnish_float_sink *sink) {
    exr e = {.from = from, .memory = memory};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &e;
    setup.alloc_fn = exr_allocate;
    setup.free_fn = free;
    setup.read_fn = read_bytes;
    setup.size_fn = find_size;
    setup.error_handler_fn = take_reason;
    ran_short = 0;
    const exr_result_t result = exr_start_read(&e.codec, "memory", &setup);
    e.is_open = result == EXR_ERR_SUCCESS;
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
