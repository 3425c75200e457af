/* PNG (ISO/IEC 15948): 8-bit RGB and RGBA, compressed in bands of rows, checksums by libdeflate. */
#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/output.h"
#include "base/threads.h"
#include "burnish/image.h"
#include "image/deflate.h"

enum {
    SIGNATURE_SIZE = 8,
    CHUNK_FRAME = 12, /* length, type, CRC */
    IHDR_SIZE = 13,
    SRGB_SIZE = 1,
    HEAD_SIZE = SIGNATURE_SIZE + CHUNK_FRAME + IHDR_SIZE + CHUNK_FRAME + SRGB_SIZE,
    FILTER_UP = 2,
    ZLIB_HEAD_SIZE = 2,
    ADLER_SIZE = 4,
    BAND_SIZE = 1 << 17 /* filtered bytes: a smaller band loses bytes to its codes */
};

/* Deflate with a window of 32 KiB, fastest algorithm (RFC 1950). */
static const uint8_t zlib_head[ZLIB_HEAD_SIZE] = {0x78, 0x01};

/* Bytes of a filtered row. */
static size_t row_size(const burnish_image *image) {
    return (size_t)image->width * (size_t)image->channels + 1;
}

static uint8_t *put_u32(uint8_t *to, uint32_t value) {
    to[0] = (uint8_t)(value >> 24);
    to[1] = (uint8_t)(value >> 16);
    to[2] = (uint8_t)(value >> 8);
    to[3] = (uint8_t)value;
    return to + 4;
}

/* Writes length, type and CRC around `size` bytes that stand at to + 8 already; returns the end. */
static uint8_t *put_chunk_frame(uint8_t *to, const char type[4], size_t size) {
    put_u32(to, (uint32_t)size);
    memcpy(to + 4, type, 4);
    return put_u32(to + 8 + size, libdeflate_crc32(0, to + 4, size + 4));
}

static uint8_t *put_header(uint8_t *to, const burnish_image *image) {
    static const uint8_t signature[SIGNATURE_SIZE] = {137, 'P', 'N', 'G', 13, 10, 26, 10};
    memcpy(to, signature, SIGNATURE_SIZE);
    to += SIGNATURE_SIZE;
    uint8_t *header = to + 8;
    header = put_u32(header, (uint32_t)image->width);
    header = put_u32(header, (uint32_t)image->height);
    *header++ = 8;                            /* bits a channel */
    *header++ = image->channels == 4 ? 6 : 2; /* RGBA, RGB */
    *header++ = 0;                            /* deflate */
    *header++ = 0;                            /* adaptive filtering */
    *header = 0;                              /* not interlaced */
    to = put_chunk_frame(to, "IHDR", IHDR_SIZE);
    to[8] = 0; /* rendering intent: perceptual */
    return put_chunk_frame(to, "sRGB", SRGB_SIZE);
}

/* Every row as its difference to the row above: of the filters, the one with the best ratio of size
 * to time for rendered pictures. */
static void filter_rows(const burnish_image *image, int first, int end,
                        uint8_t *restrict filtered) {
    size_t stride = row_size(image) - 1;
    for (int y = first; y < end; ++y) {
        const uint8_t *row = image->pixels + stride * (size_t)y;
        *filtered++ = FILTER_UP;
        if (y == 0) {
            memcpy(filtered, row, stride);
        } else {
            const uint8_t *above = row - stride;
            for (size_t i = 0; i < stride; ++i) {
                filtered[i] = (uint8_t)(row[i] - above[i]);
            }
        }
        filtered += stride;
    }
}

/* ---- bands: compressed side by side, an IDAT chunk each ---- */

typedef struct band {
    uint8_t *chunk; /* NULL until made; released when the file is put together */
    size_t size;
    uint32_t adler;    /* of its filtered rows alone, but for the first band's ... */
    uint64_t filtered; /* ... and how many bytes they have */
} band;

/* What one thread needs to make a band. */
typedef struct band_maker {
    uint8_t *filtered;
    burnish_deflate_sequence *sequences;
    uint8_t *packed;
} band_maker;

typedef struct encoder {
    const burnish_image *image;
    int rows; /* a band */
    int band_count;
    band *bands;
    int maker_count;
    band_maker *makers;
    int failed; /* out of memory */
} encoder;

/* The Adler-32 checksum of two pieces, the second of `size` bytes (RFC 1950: b is the sum of all
 * intermediate a, all modulo 65521). */
static uint32_t join_adler(uint32_t first, uint32_t second, uint64_t size) {
    const uint64_t prime = 65521;
    uint64_t a1 = first & 0xffff, b1 = first >> 16, a2 = second & 0xffff, b2 = second >> 16;
    uint64_t before = (a1 + prime - 1) % prime; /* the second piece's a began with 1 */
    uint64_t a = (a2 + before) % prime;
    uint64_t b = (b1 + b2 + before * (size % prime)) % prime;
    return (uint32_t)(b << 16 | a);
}

/* Bands depend on the picture's size only, so that the file does not depend on the threads. */
static void divide(encoder *e) {
    size_t all = row_size(e->image) * (size_t)e->image->height;
    int count = (int)((all + BAND_SIZE - 1) / BAND_SIZE);
    count = count < e->image->height ? count : e->image->height;
    e->rows = (e->image->height + count - 1) / count;
    e->band_count = (e->image->height + e->rows - 1) / e->rows;
}

static size_t band_bytes(const encoder *e) {
    return row_size(e->image) * (size_t)e->rows;
}

static burnish_status create_makers(encoder *e, int threads, burnish_error *error) {
    const char *what = "the PNG's bands";
    size_t bytes = band_bytes(e);
    int count = burnish_thread_count(threads, (size_t)e->band_count, 1);
    burnish_status status =
        burnish_allocate((void **)&e->bands, (size_t)e->band_count, sizeof *e->bands, what, error);
    if (status == BURNISH_STATUS_OK) {
        memset(e->bands, 0, (size_t)e->band_count * sizeof *e->bands);
        status =
            burnish_allocate((void **)&e->makers, (size_t)count, sizeof *e->makers, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        memset(e->makers, 0, (size_t)count * sizeof *e->makers);
        e->maker_count = count;
    }
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        band_maker *maker = &e->makers[i];
        status = burnish_allocate((void **)&maker->filtered, bytes, 1, what, error);
        if (status == BURNISH_STATUS_OK) {
            status =
                burnish_allocate((void **)&maker->sequences, burnish_deflate_sequence_bound(bytes),
                                 sizeof *maker->sequences, what, error);
        }
        if (status == BURNISH_STATUS_OK) {
            status = burnish_allocate((void **)&maker->packed, burnish_deflate_bound(bytes), 1,
                                      what, error);
        }
    }
    return status;
}

static void destroy_encoder(encoder *e) {
    for (int i = 0; e->bands && i < e->band_count; ++i) {
        free(e->bands[i].chunk);
    }
    for (int i = 0; i < e->maker_count; ++i) {
        free(e->makers[i].filtered);
        free(e->makers[i].sequences);
        free(e->makers[i].packed);
    }
    free(e->bands);
    free(e->makers);
}

/* The chunk of one band; the first one begins the stream, the last one leaves room for its end. */
static void make_band(encoder *e, int index, band_maker *maker) {
    band *made = &e->bands[index];
    int first = index * e->rows, end = first + e->rows;
    int last = index + 1 == e->band_count;
    end = last ? e->image->height : end;
    size_t bytes = row_size(e->image) * (size_t)(end - first);
    filter_rows(e->image, first, end, maker->filtered);
    made->filtered = bytes;
    made->adler = libdeflate_adler32(1, maker->filtered, bytes);
    size_t packed = burnish_deflate_band(maker->filtered, bytes, (size_t)e->image->channels, last,
                                         maker->sequences, maker->packed);
    size_t head = index == 0 ? ZLIB_HEAD_SIZE : 0, tail = last ? ADLER_SIZE : 0;
    made->size = head + packed + tail;
    made->chunk = malloc(CHUNK_FRAME + made->size);
    if (!made->chunk) {
#pragma omp atomic write
        e->failed = 1;
        return;
    }
    if (index == 0) {
        memcpy(made->chunk + 8, zlib_head, ZLIB_HEAD_SIZE);
    }
    memcpy(made->chunk + 8 + head, maker->packed, packed);
    if (!last) { /* the last one's checksum needs all others */
        put_chunk_frame(made->chunk, "IDAT", made->size);
    }
}

static uint32_t whole_adler(const encoder *e) {
    uint32_t adler = e->bands[0].adler;
    for (int i = 1; i < e->band_count; ++i) {
        adler = join_adler(adler, e->bands[i].adler, e->bands[i].filtered);
    }
    return adler;
}

static burnish_status put_file(encoder *e, uint8_t **bytes, size_t *size, burnish_error *error) {
    band *last = &e->bands[e->band_count - 1];
    put_u32(last->chunk + 8 + last->size - ADLER_SIZE, whole_adler(e));
    put_chunk_frame(last->chunk, "IDAT", last->size);
    *size = HEAD_SIZE + CHUNK_FRAME;
    for (int i = 0; i < e->band_count; ++i) {
        *size += CHUNK_FRAME + e->bands[i].size;
    }
    *bytes = malloc(*size);
    if (!*bytes) {
        return burnish_fail_memory(error, "the PNG file", *size);
    }
    uint8_t *to = put_header(*bytes, e->image);
    for (int i = 0; i < e->band_count; ++i) {
        memcpy(to, e->bands[i].chunk, CHUNK_FRAME + e->bands[i].size);
        to += CHUNK_FRAME + e->bands[i].size;
        free(e->bands[i].chunk);
        e->bands[i].chunk = NULL;
    }
    put_chunk_frame(to, "IEND", 0);
    return BURNISH_STATUS_OK;
}

burnish_status burnish_image_encode_png_threads(const burnish_image *image, int threads,
                                                uint8_t **bytes, size_t *size,
                                                burnish_error *error) {
    encoder e = {.image = image};
    *bytes = NULL;
    *size = 0;
    if (!image || !image->pixels) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "PNG: the image is empty; create or render it first");
    }
    divide(&e);
    burnish_status status = create_makers(&e, threads, error);
    if (status == BURNISH_STATUS_OK) {
#pragma omp parallel for num_threads(e.maker_count) schedule(dynamic, 1) if (e.maker_count > 1)
        for (int i = 0; i < e.band_count; ++i) {
            make_band(&e, i, &e.makers[burnish_thread_index()]);
        }
        status = e.failed ? burnish_fail(error, BURNISH_STATUS_MEMORY,
                                         "out of memory: the PNG's bands; free memory")
                          : put_file(&e, bytes, size, error);
    }
    destroy_encoder(&e);
    return status;
}

burnish_status burnish_image_encode_png(const burnish_image *image, uint8_t **bytes, size_t *size,
                                        burnish_error *error) {
    return burnish_image_encode_png_threads(image, 0, bytes, size, error);
}

burnish_status burnish_image_write_png(const burnish_image *image, const char *path,
                                       burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    burnish_status status = burnish_image_encode_png(image, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_write_file(path, bytes, size, error);
        free(bytes);
    }
    return status;
}
