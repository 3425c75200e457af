/* PNG (ISO/IEC 15948): 8-bit RGB and RGBA, compressed in bands of rows by ISA-L.
 *
 * A band knows nothing of the others and ends at a byte boundary (an empty stored block), so that
 * bands are made in any order and the stream is their concatenation. The file does not depend on
 * the number of threads; its compressed bytes may depend on the processor where ISA-L searches by
 * another hash (x86-64 without SSE4.2: 3 % longer), its pixels never. */
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/image.h"
#include "core/memory.h"
#include "core/output.h"
#include "core/tasks.h"

enum {
    SIGNATURE_SIZE = 8,
    CHUNK_FRAME = 12, /* length, type, CRC */
    IHDR_SIZE = 13,
    SRGB_SIZE = 1,
    HEAD_SIZE = SIGNATURE_SIZE + CHUNK_FRAME + IHDR_SIZE + CHUNK_FRAME + SRGB_SIZE,
    FILTER_UP = 2,
    ZLIB_HEAD_SIZE = 2,
    ADLER_SIZE = 4,
    BAND_SIZE = 1 << 17, /* filtered bytes: a smaller band loses bytes to its codes */
    LEVEL = 1,           /* level 2 takes 3 % longer and saves nothing, level 0 adds a fifth */
    SEARCH_SIZE = ISAL_DEF_LVL1_DEFAULT,
    BLOCK_FRAME = 1024 /* room for what is added to bytes that nothing shortens */
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
    return put_u32(to + 8 + size, crc32_gzip_refl(0, to + 4, size + 4));
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
    burnish_status status;
} band;

/* What one thread needs to make a band. */
typedef struct band_maker {
    uint8_t *filtered;
    struct isal_zstream *stream;
    uint8_t *search; /* SEARCH_SIZE bytes of the library's */
    uint8_t *packed;
} band_maker;

typedef struct encoder {
    burnish_tasks tasks;
    const burnish_image *image;
    int rows; /* a band */
    int band_count;
    band *bands;
    int maker_count;
    band_maker *makers;
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

/* Room for `bytes` compressed bytes. */
static size_t packed_bound(size_t bytes) {
    return bytes + bytes / 8 + BLOCK_FRAME;
}

static burnish_status create_makers(encoder *e, int threads, burnish_error *error) {
    const char *what = "the PNG's bands";
    size_t bytes = band_bytes(e);
    burnish_tasks_begin(&e->tasks, NULL, threads);
    int count = burnish_tasks_threads(&e->tasks);
    count = count < e->band_count ? count : e->band_count;
    burnish_status status = burnish_legacy_allocate((void **)&e->bands, (size_t)e->band_count,
                                                    sizeof *e->bands, what, error);
    if (status == BURNISH_STATUS_OK) {
        memset(e->bands, 0, (size_t)e->band_count * sizeof *e->bands);
        status = burnish_legacy_allocate((void **)&e->makers, (size_t)count, sizeof *e->makers,
                                         what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        memset(e->makers, 0, (size_t)count * sizeof *e->makers);
        e->maker_count = count;
    }
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        band_maker *maker = &e->makers[i];
        status = burnish_legacy_allocate((void **)&maker->filtered, bytes, 1, what, error);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_legacy_allocate((void **)&maker->stream, 1, sizeof *maker->stream,
                                             what, error);
        }
        if (status == BURNISH_STATUS_OK) {
            status = burnish_legacy_allocate((void **)&maker->search, SEARCH_SIZE, 1, what, error);
        }
        if (status == BURNISH_STATUS_OK) {
            status = burnish_legacy_allocate((void **)&maker->packed, packed_bound(bytes), 1, what,
                                             error);
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
        free(e->makers[i].stream);
        free(e->makers[i].search);
        free(e->makers[i].packed);
    }
    free(e->bands);
    free(e->makers);
}

/* Compresses the maker's filtered bytes; returns how many bytes that takes, 0 when the library did
 * not keep to its bounds. */
static size_t pack(band_maker *maker, size_t bytes, int last) {
    struct isal_zstream *stream = maker->stream;
    isal_deflate_init(stream);
    stream->level = LEVEL;
    stream->level_buf = maker->search;
    stream->level_buf_size = SEARCH_SIZE;
    stream->flush = FULL_FLUSH; /* a band starts without a history */
    stream->end_of_stream = (uint16_t)last;
    stream->next_in = maker->filtered;
    stream->avail_in = (uint32_t)bytes;
    stream->next_out = maker->packed;
    stream->avail_out = (uint32_t)packed_bound(bytes);
    int code = isal_deflate(stream);
    return code == COMP_OK && stream->avail_in == 0 && stream->avail_out > 0 ? stream->total_out
                                                                             : 0;
}

/* The chunk of one band; the first one begins the stream, the last one leaves room for its end. */
static burnish_status make_band(const encoder *e, int index, band_maker *maker) {
    band *made = &e->bands[index];
    int first = index * e->rows, end = first + e->rows;
    int last = index + 1 == e->band_count;
    end = last ? e->image->height : end;
    size_t bytes = row_size(e->image) * (size_t)(end - first);
    filter_rows(e->image, first, end, maker->filtered);
    made->filtered = bytes;
    made->adler = isal_adler32(1, maker->filtered, bytes);
    size_t packed = pack(maker, bytes, last);
    if (packed == 0) {
        return BURNISH_STATUS_LIMIT;
    }
    size_t head = index == 0 ? ZLIB_HEAD_SIZE : 0, tail = last ? ADLER_SIZE : 0;
    made->size = head + packed + tail;
    made->chunk = malloc(CHUNK_FRAME + made->size);
    if (!made->chunk) {
        return BURNISH_STATUS_MEMORY;
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

static void band_task(void *of, size_t index, int thread) {
    encoder *e = of;
    e->bands[index].status = make_band(e, (int)index, &e->makers[thread]);
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

static burnish_status fail_bands(burnish_status status, burnish_error *error) {
    return burnish_fail(error, status,
                        status == BURNISH_STATUS_MEMORY
                            ? "out of memory: the PNG's bands; free memory"
                            : "PNG: the compressed rows outgrow their bound; write a smaller one");
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
        burnish_tasks_run(&e.tasks, (size_t)e.band_count, 1, e.maker_count, band_task, &e);
        status = bands_status(&e);
        status = status == BURNISH_STATUS_OK ? put_file(&e, bytes, size, error)
                                             : fail_bands(status, error);
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
