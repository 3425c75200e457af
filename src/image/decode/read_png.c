/* PNG through libpng's row interface: the simplified one converts 16 bits by the file's gamma. */
#include "image/decode/decode.h"

#if BURNISH_HAS_PNG
#include <png.h>
#include <stdio.h>
#include <string.h>

#include "image/decode/sanitize.h"

enum {
    MOST_CHUNK_BYTES = 8 << 20, /* of a chunk that libpng unpacks: a colour profile */
    NO_CHUNKS = 1,              /* libpng's value for ignoring text and suggested palettes */
    LARGEST_RATIO = 1032        /* most bytes that deflate makes of one byte */
};

/* The argument of libpng's callbacks. */
typedef struct decoder {
    png_structp png;
    png_infop info;
    const uint8_t *bytes;
    size_t size, next;
    burnish_memory memory;   /* of libpng and its zlib */
    char reason[120];        /* libpng's */
    int passes;              /* more than 1 if interlaced */
    int has_palette;         /* rows are read as indices of 8 bits */
    uint8_t palette[256][4]; /* black beyond its end, as libpng has it */
} decoder;

static png_voidp png_read_allocate(png_structp png, png_alloc_size_t size) {
    decoder *d = png_get_mem_ptr(png);
    return burnish_allocate(&d->memory, size, 1, "reading a PNG");
}

static void give_back(png_structp png, png_voidp items) {
    const decoder *d = png_get_mem_ptr(png);
    burnish_release(d->memory.context, items);
}

static void png_read_take(png_structp png, png_bytep to, size_t count) {
    decoder *d = png_get_io_ptr(png);
    if (count > d->size - d->next) {
        png_error(png, "the file ends too early");
    }
    memcpy(to, d->bytes + d->next, count);
    d->next += count;
}

static void png_read_fail(png_structp png, png_const_charp reason) {
    decoder *d = png_get_error_ptr(png);
    snprintf(d->reason, sizeof d->reason, "%s", reason);
    png_longjmp(png, 1);
}

static void pass_over(png_structp png, png_const_charp reason) {
    (void)png, (void)reason;
}

/* Returns the channels of its colours. */
static int take_palette(decoder *d, int channels) {
    png_colorp colors = NULL;
    png_bytep alphas = NULL;
    int count = 0, alpha_count = 0;
    png_get_PLTE(d->png, d->info, &colors, &count);
    png_get_tRNS(d->png, d->info, &alphas, &alpha_count, NULL);
    for (int i = 0; i < 256; ++i) {
        const png_color color = i < count ? colors[i] : (png_color){0, 0, 0};
        const uint8_t alpha = i < alpha_count ? alphas[i] : 255;
        memcpy(d->palette[i], (uint8_t[]){color.red, color.green, color.blue, alpha}, 4);
    }
    return channels == 4 || alpha_count > 0 ? 4 : 3;
}

/* Everything as 8 bits of RGB or RGBA, or of indices. Returns the channels of the image. */
static int ask_for_codes(decoder *d, int channels) {
    d->has_palette = png_get_color_type(d->png, d->info) == PNG_COLOR_TYPE_PALETTE;
    if (d->has_palette) { /* libpng's own expansion takes 27 instructions per pixel */
        channels = take_palette(d, channels);
        png_set_packing(d->png);
    } else {
        png_set_expand(d->png);
        png_set_scale_16(d->png);
        png_set_gray_to_rgb(d->png);
        if (channels == 4) {
            png_set_add_alpha(d->png, 255, PNG_FILLER_AFTER);
        }
    }
    d->passes = png_set_interlace_handling(d->png);
    png_read_update_info(d->png, d->info);
    return d->has_palette ? channels : png_get_channels(d->png, d->info);
}

/* Colours of rows from their indices, which are at their ends. */
typedef struct index_rows {
    const decoder *decoder;
    const burnish_image *image;
} index_rows;

static void expand_rows(void *context, size_t first, size_t end) {
    const index_rows *rows = context;
    const decoder *d = rows->decoder;
    const size_t width = (size_t)rows->image->width, channels = (size_t)rows->image->channels;
    for (size_t y = first; y < end; ++y) {
        uint8_t *row = rows->image->pixels + y * width * channels;
        const uint8_t *from = row + width * (channels - 1);
        for (size_t x = 0; x < width && channels == 4; ++x) {
            memcpy(row + 4 * x, d->palette[from[x]], 4);
        }
        for (size_t x = 0; x < width && channels == 3; ++x) {
            memcpy(row + 3 * x, d->palette[from[x]], 3);
        }
    }
}

static burnish_status expand_indices(const decoder *d, const burnish_encoded *from,
                                     burnish_memory *memory, const burnish_image *image) {
    enum { GRAIN = 1 << 16 }; /* pixels that are worth a task */
    index_rows rows = {d, image};
    burnish_tasks_ranges(from->tasks, (size_t)image->height, 1 + GRAIN / (size_t)image->width,
                         expand_rows, &rows);
    return burnish_tasks_check(from->tasks, memory->error);
}

static void read_rows(const decoder *d, burnish_image *image) {
    const size_t width = (size_t)image->width, size = width * (size_t)image->channels;
    const size_t skipped = d->has_palette ? size - width : 0;
    for (int pass = 1; pass <= d->passes; ++pass) {
        for (int y = 0; y < image->height; ++y) {
            uint8_t *row = image->pixels + size * (size_t)y + skipped;
            png_read_row(d->png, row, NULL);
            burnish_written_outside(row, size - skipped);
        }
    }
}

/* Rejects more rows than the file can hold, so a small file can not use much memory. */
static burnish_status make_image(const burnish_encoded *from, decoder *d, burnish_memory *memory,
                                 burnish_image *image) {
    const uint64_t width = png_get_image_width(d->png, d->info);
    const uint64_t height = png_get_image_height(d->png, d->info);
    if (png_get_rowbytes(d->png, d->info) * height / LARGEST_RATIO > d->size) {
        return burnish_fail(
            memory->error, BURNISH_STATUS_FORMAT,
            "%.200s: %llu x %llu pixels can't be in a PNG of %zu bytes; it is cut off or damaged",
            from->name, (unsigned long long)width, (unsigned long long)height, d->size);
    }
    return burnish_decode_reserve(from, width, height, ask_for_codes(d, from->channels), memory,
                                  image);
}

/* Checks the size in the first chunk before libpng does, since libpng allocates rows of any
 * length. */
static burnish_status check_sides(const burnish_encoded *from, const decoder *d) {
    enum { TYPE_AT = 12, WIDTH_AT = 16, HEIGHT_AT = 20, ENOUGH = 24 };
    if (d->size < ENOUGH || memcmp(d->bytes + TYPE_AT, "IHDR", 4) != 0) {
        return BURNISH_STATUS_OK; /* libpng reads no other first chunk */
    }
    const uint64_t width = png_get_uint_32(d->bytes + WIDTH_AT);
    const uint64_t height = png_get_uint_32(d->bytes + HEIGHT_AT);
    return width > 0 && height > 0 ? burnish_decode_check(from, width, height, &d->memory)
                                   : BURNISH_STATUS_OK; /* nor these */
}

/* Whether all chunks up to IEND are present: libpng allocates the size that a text chunk states. */
static int is_whole(const decoder *d) {
    enum { SIGNATURE = 8, FRAME = 12 }; /* of a chunk: length, type and sum */
    const uint8_t *at = d->bytes + SIGNATURE;
    size_t left = d->size > SIGNATURE ? d->size - SIGNATURE : 0;
    while (left >= FRAME) {
        const size_t length = png_get_uint_32(at);
        if (length > left - FRAME) {
            return 0;
        }
        if (memcmp(at + 4, "IEND", 4) == 0) {
            return 1;
        }
        at += FRAME + length;
        left -= FRAME + length;
    }
    return 0;
}

static burnish_status png_read_decode(const burnish_encoded *from, decoder *d,
                                      burnish_memory *memory, burnish_image *image) {
    if (setjmp(png_jmpbuf(d->png))) {
        return d->memory.status != BURNISH_STATUS_OK
                   ? d->memory.status
                   : burnish_fail(memory->error, BURNISH_STATUS_FORMAT, "%.200s: no sound PNG: %s",
                                  from->name, d->reason);
    }
    if (!is_whole(d)) {
        png_error(d->png, "the file ends too early");
    }
    burnish_status status = check_sides(from, d);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    png_set_read_fn(d->png, d, png_read_take);
    png_set_user_limits(d->png, (png_uint_32)from->max_side, (png_uint_32)from->max_side);
    png_set_chunk_malloc_max(d->png, MOST_CHUNK_BYTES);
    png_set_chunk_cache_max(d->png, NO_CHUNKS);
    png_set_crc_action(d->png, PNG_CRC_ERROR_QUIT, PNG_CRC_WARN_DISCARD);
    png_set_option(d->png, PNG_IGNORE_ADLER32, PNG_OPTION_ON); /* chunks have their own sums */
    png_read_info(d->png, d->info);
    status = make_image(from, d, memory, image);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    read_rows(d, image);
    png_read_end(d->png, NULL);
    if (d->has_palette) {
        status = expand_indices(d, from, memory, image);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return d->memory.status; /* libpng ignores failures of optional parts */
}

burnish_status burnish_decode_png(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture) {
    decoder d = {.bytes = from->bytes,
                 .size = from->size,
                 .memory = burnish_memory_of(memory->context, memory->error)};
    d.png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &d, png_read_fail, pass_over, &d,
                                     png_read_allocate, give_back);
    d.info = d.png ? png_create_info_struct(d.png) : NULL;
    burnish_status status = d.info ? png_read_decode(from, &d, memory, picture)
                                   : burnish_fail(memory->error, BURNISH_STATUS_MEMORY,
                                                  "%.200s: out of memory", from->name);
    png_destroy_read_struct(&d.png, &d.info, NULL);
    return status;
}

#else

burnish_status burnish_decode_png(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture) {
    (void)picture;
    return burnish_fail(memory->error, BURNISH_STATUS_ARGUMENT,
                        "%.200s: this burnish reads no PNG: it was built without libpng",
                        from->name);
}

#endif
