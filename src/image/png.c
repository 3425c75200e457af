/* PNG (ISO/IEC 15948), compressed in bands of rows.
 *
 * A band does not depend on the others and ends at a byte boundary, so bands can be made in any
 * order and the stream is their concatenation. The file does not depend on the number of threads;
 * its compressed bytes depend on the library that compresses, its pixels never. */
#include <string.h>

#include "base/layout.h"
#include "base/memory.h"
#include "core/tasks.h"
#include "image/deflate.h"
#include "image/pixels.h"

/* The chunk that names the software: keyword, zero, text. */
#define SOFTWARE "Software\0burnish"

enum {
    SIGNATURE_SIZE = 8,
    CHUNK_FRAME = 12, /* length, type, CRC */
    IHDR_SIZE = 13,
    SRGB_SIZE = 1,
    PHYS_SIZE = 9,
    TEXT_SIZE = sizeof SOFTWARE - 1,
    HEAD_MAX = SIGNATURE_SIZE + CHUNK_FRAME + IHDR_SIZE + CHUNK_FRAME + SRGB_SIZE + CHUNK_FRAME +
               PHYS_SIZE + CHUNK_FRAME + TEXT_SIZE,
    FILTER_UP = 2,
    ZLIB_HEAD_SIZE = 2,
    ADLER_SIZE = 4,
    BAND_SIZE = 1 << 17 /* filtered bytes: smaller bands compress less well */
};
#define COOKIE BURNISH_COOKIE(0x706e6731, burnish_png_options)

/* Deflate with a window of 32 KiB, fastest algorithm (RFC 1950). */
static const uint8_t zlib_head[ZLIB_HEAD_SIZE] = {0x78, 0x01};

void burnish_png_options_init(burnish_png_options *options, uint64_t layout) {
    const burnish_png_options defaults = {.cookie = COOKIE};
    burnish_layout_init(options, layout, BURNISH_LAYOUT(burnish_png_options), &defaults);
}

/* Bytes of a filtered row. */
static size_t row_size(const burnish_pixels *image) {
    return burnish_pixels_row(image) + 1;
}

static uint8_t *put_u32(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)(value >> 24);
    to[1] = (uint8_t)(value >> 16);
    to[2] = (uint8_t)(value >> 8);
    to[3] = (uint8_t)value;
    return to + 4;
}

/* Writes length, type and CRC around the `size` bytes at to + 8; returns the end. */
static uint8_t *put_chunk_frame(uint8_t *to, const char type[4], size_t size) {
    put_u32(to, (uint32_t)size);
    memcpy(to + 4, type, 4);
    return put_u32(to + 8 + size, burnish_deflate_crc32(to + 4, size + 4));
}

/* Bits per channel and colour type of each format. */
static const uint8_t kinds[BURNISH_PIXELS_COUNT][2] = {
    [BURNISH_PIXELS_RGB8] = {8, 2},   [BURNISH_PIXELS_RGBA8] = {8, 6},
    [BURNISH_PIXELS_BGRA8] = {8, 6},  [BURNISH_PIXELS_GRAY16] = {16, 0},
    [BURNISH_PIXELS_RGB16] = {16, 2},
};

/* Both axes, in dots per metre. */
static uint8_t *put_density(uint8_t *to, double dots_per_inch) {
    const uint32_t density = (uint32_t)(dots_per_inch / 0.0254 + 0.5);
    put_u32(to + 8, density);
    put_u32(to + 12, density);
    to[16] = 1; /* per metre */
    return put_chunk_frame(to, "pHYs", PHYS_SIZE);
}

static uint8_t *put_header(uint8_t *to, const burnish_pixels *image,
                           const burnish_png_options *options) {
    static const uint8_t signature[SIGNATURE_SIZE] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    memcpy(to, signature, SIGNATURE_SIZE);
    to += SIGNATURE_SIZE;
    uint8_t *header = to + 8;
    header = put_u32(header, (uint32_t)image->width);
    header = put_u32(header, (uint32_t)image->height);
    *header++ = kinds[image->format][0];
    *header++ = kinds[image->format][1];
    *header++ = 0; /* deflate */
    *header++ = 0; /* adaptive filtering */
    *header = 0;   /* not interlaced */
    to = put_chunk_frame(to, "IHDR", IHDR_SIZE);
    if (!options->is_data && kinds[image->format][0] == 8) {
        to[8] = 0; /* rendering intent: perceptual */
        to = put_chunk_frame(to, "sRGB", SRGB_SIZE);
    }
    if (options->dots_per_inch > 0) {
        to = put_density(to, options->dots_per_inch);
    }
    memcpy(to + 8, SOFTWARE, TEXT_SIZE);
    return put_chunk_frame(to, "tEXt", TEXT_SIZE);
}

/* The bytes of a row, or differences of such, into PNG's order of channels and bytes. */
static void reorder_row(const burnish_pixels *image, uint8_t *bytes) {
    if (image->format == BURNISH_PIXELS_BGRA8) {
        burnish_pixels_swap(bytes, bytes, (size_t)image->width);
    } else if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ && kinds[image->format][0] == 16) {
        for (size_t i = 0; i < burnish_pixels_row(image); i += 2) {
            const uint8_t low = bytes[i];
            bytes[i] = bytes[i + 1];
            bytes[i + 1] = low;
        }
    }
}

/* The difference of two rows. */
static void filter_row(const burnish_pixels *image, const uint8_t *restrict row,
                       const uint8_t *restrict above, uint8_t *restrict filtered) {
    const size_t size = burnish_pixels_row(image);
    for (size_t i = 0; i < size; ++i) {
        filtered[i] = (uint8_t)(row[i] - above[i]);
    }
}

/* ---- bands: compressed side by side, an IDAT chunk each ---- */

typedef struct band {
    uint8_t *chunk; /* NULL until made; released when the file is put together */
    size_t size;
    uint32_t adler;    /* of its filtered rows alone, but for the first band's ... */
    uint64_t filtered; /* ... and how many bytes they have */
    burnish_status status;
} band;

/* What one thread needs to make a band. */
typedef struct band_maker {
    uint8_t *filtered;
    burnish_deflate *deflate;
    uint8_t *packed;
} band_maker;

/* A file that is being encoded. */
typedef struct encoder {
    burnish_tasks tasks;
    const burnish_context *context;
    burnish_pixels image;
    burnish_png_options options;
    int rows; /* per band */
    int band_count;
    band *bands;
    int maker_count;
    band_maker *makers;
    atomic_int done; /* bands */
} encoder;

static const uint8_t *row_at(const encoder *e, int y) {
    return e->image.pixels + e->image.stride * (size_t)y;
}

/* Every row as its difference from the row above. This filter has the best ratio of size to time
 * for rendered images. */
static void filter_rows(const encoder *e, int first, int end, uint8_t *restrict filtered) {
    const burnish_pixels *image = &e->image;
    const size_t size = burnish_pixels_row(image);
    for (int y = first; y < end; ++y) {
        *filtered++ = FILTER_UP;
        if (y > 0) {
            filter_row(image, row_at(e, y), row_at(e, y - 1), filtered);
        } else {
            memcpy(filtered, row_at(e, y), size);
        }
        reorder_row(image, filtered);
        filtered += size;
    }
}

/* The Adler-32 checksum of two parts, the second of `size` bytes (RFC 1950: b is the sum of all
 * intermediate a, all modulo 65521). */
static uint32_t join_adler(uint32_t first, uint32_t second, uint64_t size) {
    const uint64_t prime = 65521;
    uint64_t a1 = first & 0xffff, b1 = first >> 16, a2 = second & 0xffff, b2 = second >> 16;
    uint64_t before = (a1 + prime - 1) % prime; /* the second part's a began with 1 */
    uint64_t a = (a2 + before) % prime;
    uint64_t b = (b1 + b2 + before * (size % prime)) % prime;
    return (uint32_t)(b << 16 | a);
}

/* Bands depend only on the size of the image, so the file does not depend on the threads. */
static void divide_into_bands(encoder *e) {
    const int height = e->image.height;
    size_t all = row_size(&e->image) * (size_t)height;
    int count = (int)((all + BAND_SIZE - 1) / BAND_SIZE);
    count = count < height ? count : height;
    e->rows = (height + count - 1) / count;
    e->band_count = (height + e->rows - 1) / e->rows;
}

static size_t band_bytes(const encoder *e) {
    return row_size(&e->image) * (size_t)e->rows;
}

static void create_makers(encoder *e, burnish_memory *memory) {
    const char *what = "the PNG's bands";
    const size_t bytes = band_bytes(e);
    int count = burnish_tasks_threads(&e->tasks);
    count = count < e->band_count ? count : e->band_count;
    e->bands = burnish_allocate_zeroed(memory, (size_t)e->band_count, sizeof *e->bands, what);
    e->makers = burnish_allocate_zeroed(memory, (size_t)count, sizeof *e->makers, what);
    e->maker_count = e->makers ? count : 0;
    for (int i = 0; i < e->maker_count; ++i) {
        band_maker *maker = &e->makers[i];
        maker->filtered = burnish_allocate(memory, bytes, 1, what);
        maker->deflate = burnish_deflate_create(memory);
        maker->packed = burnish_allocate(memory, burnish_deflate_bound(bytes), 1, what);
    }
}

static void destroy_encoder(encoder *e) {
    for (int i = 0; e->bands && i < e->band_count; ++i) {
        burnish_release(e->context, e->bands[i].chunk);
    }
    for (int i = 0; i < e->maker_count; ++i) {
        burnish_release(e->context, e->makers[i].filtered);
        burnish_deflate_destroy(e->context, e->makers[i].deflate);
        burnish_release(e->context, e->makers[i].packed);
    }
    burnish_release(e->context, e->bands);
    burnish_release(e->context, e->makers);
}

/* The chunk of one band; the first one begins the stream, the last one leaves room for its end. */
static burnish_status make_band(const encoder *e, int index, band_maker *maker) {
    band *made = &e->bands[index];
    int first = index * e->rows, end = first + e->rows;
    int last = index + 1 == e->band_count;
    end = last ? e->image.height : end;
    size_t bytes = row_size(&e->image) * (size_t)(end - first);
    filter_rows(e, first, end, maker->filtered);
    made->filtered = bytes;
    made->adler = burnish_deflate_adler32(maker->filtered, bytes);
    size_t packed = burnish_deflate_band(maker->deflate, maker->filtered, bytes, last,
                                         maker->packed, burnish_deflate_bound(bytes));
    if (packed == 0) {
        return BURNISH_STATUS_LIMIT;
    }
    size_t head = index == 0 ? ZLIB_HEAD_SIZE : 0, tail = last ? ADLER_SIZE : 0;
    burnish_memory memory = burnish_memory_of(e->context, NULL);
    made->size = head + packed + tail;
    made->chunk = burnish_allocate(&memory, CHUNK_FRAME + made->size, 1, "a band");
    if (!made->chunk) {
        return memory.status;
    }
    if (index == 0) {
        memcpy(made->chunk + 8, zlib_head, ZLIB_HEAD_SIZE);
    }
    memcpy(made->chunk + 8 + head, maker->packed, packed);
    if (!last) { /* the last one's checksum needs all others */
        put_chunk_frame(made->chunk, "IDAT", made->size);
    }
    return BURNISH_STATUS_OK;
}

static void band_task(void *context, size_t index, int thread) {
    encoder *e = context;
    e->bands[index].status = make_band(e, (int)index, &e->makers[thread]);
    const int done = atomic_fetch_add(&e->done, 1) + 1;
    if (thread == 0) {
        burnish_tasks_progress(&e->tasks, BURNISH_STAGE_ENCODE, (double)done / e->band_count);
    }
}

/* The first failure. */
static burnish_status bands_status(const encoder *e) {
    for (int i = 0; i < e->band_count; ++i) {
        if (e->bands[i].status != BURNISH_STATUS_OK) {
            return e->bands[i].status;
        }
    }
    return BURNISH_STATUS_OK;
}

static uint32_t whole_adler(const encoder *e) {
    uint32_t adler = e->bands[0].adler;
    for (int i = 1; i < e->band_count; ++i) {
        adler = join_adler(adler, e->bands[i].adler, e->bands[i].filtered);
    }
    return adler;
}

/* The file's bytes from the bands, which are released. */
static void put_bytes(encoder *e, burnish_memory *memory, uint8_t **bytes, size_t *size) {
    uint8_t head[HEAD_MAX];
    const size_t head_size = (size_t)(put_header(head, &e->image, &e->options) - head);
    band *last = &e->bands[e->band_count - 1];
    put_u32(last->chunk + 8 + last->size - ADLER_SIZE, whole_adler(e));
    put_chunk_frame(last->chunk, "IDAT", last->size);
    size_t sum = head_size + CHUNK_FRAME;
    for (int i = 0; i < e->band_count; ++i) {
        sum += CHUNK_FRAME + e->bands[i].size;
    }
    *bytes = burnish_allocate(memory, sum, 1, "the PNG file");
    if (!*bytes) {
        return;
    }
    *size = sum;
    memcpy(*bytes, head, head_size);
    uint8_t *to = *bytes + head_size;
    for (int i = 0; i < e->band_count; ++i) {
        memcpy(to, e->bands[i].chunk, CHUNK_FRAME + e->bands[i].size);
        to += CHUNK_FRAME + e->bands[i].size;
        burnish_release(e->context, e->bands[i].chunk);
        e->bands[i].chunk = NULL;
    }
    put_chunk_frame(to, "IEND", 0);
}

static burnish_status fail_bands(burnish_status status, burnish_error *error) {
    return burnish_fail(error, status,
                        status == BURNISH_STATUS_MEMORY
                            ? "out of memory: the PNG's bands; free memory"
                            : "PNG: the compressed rows outgrow their bound; write a smaller one");
}

static burnish_status encoder_begin(encoder *e, const burnish_pixels *image,
                                    const burnish_png_options *options, burnish_error *error) {
    const burnish_png_options defaults = burnish_png_options_default();
    burnish_memory memory = burnish_memory_of(options ? options->context : NULL, error);
    e->image = *image;
    e->options = options ? *options : defaults;
    e->context = e->options.context;
    burnish_tasks_begin(&e->tasks, e->context, e->options.threads);
    divide_into_bands(e);
    create_makers(e, &memory);
    return memory.status;
}

static burnish_status encode(encoder *e, uint8_t **bytes, size_t *size, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(e->context, error);
    burnish_tasks_run(&e->tasks, (size_t)e->band_count, 1, e->maker_count, band_task, e);
    burnish_status status = burnish_tasks_check(&e->tasks, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    status = bands_status(e);
    if (status != BURNISH_STATUS_OK) {
        return fail_bands(status, error);
    }
    put_bytes(e, &memory, bytes, size);
    return memory.status;
}

static burnish_status check_options(const burnish_png_options *options, burnish_error *error) {
    if (!options) {
        return BURNISH_STATUS_OK;
    }
    const burnish_status status =
        burnish_layout_check(options, COOKIE, "PNG options", "png_options", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if ((options->threads < 0 || options->threads > BURNISH_THREADS_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "PNG options: %d threads; expected 0 to %d", options->threads,
                            BURNISH_THREADS_MAX);
    }
    if (options && options->dots_per_inch != 0 &&
        !(options->dots_per_inch >= 1 && options->dots_per_inch <= 1e6)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "PNG options: %g dots per inch; expected 1 to 1e6, or 0 for none",
                            options->dots_per_inch);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_png_encode(const burnish_pixels *pixels, const burnish_png_options *options,
                                  uint8_t **bytes, size_t *size, burnish_error *error) {
    encoder e = {.band_count = 0};
    *bytes = NULL;
    *size = 0;
    burnish_status status = check_options(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_pixels_check(pixels, "PNG", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = encoder_begin(&e, pixels, options, error);
        if (status == BURNISH_STATUS_OK) {
            status = encode(&e, bytes, size, error);
        }
        destroy_encoder(&e);
    }
    return status;
}

burnish_status burnish_png_write(const burnish_pixels *pixels, const char *path,
                                 const burnish_png_options *options, burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    burnish_status status = burnish_png_encode(pixels, options, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_file_write(path, bytes, size, error);
        burnish_release(options ? options->context : NULL, bytes);
    }
    return status;
}

burnish_status burnish_image_write_png(const burnish_image *image, const char *path,
                                       burnish_error *error) {
    const burnish_pixels pixels = burnish_image_get_pixels(image);
    return burnish_png_write(&pixels, path, NULL, error);
}
