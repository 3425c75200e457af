/* TGA (Truevision, "TGA File Format Specification", version 2.0, 1991), the format of textures in
 * older files: colours of 16, 24 and 32 bits, grey, and palettes, each also run-length encoded. It
 * needs no library. TGA has no signature, so burnish_is_tga checks whether the header is plausible.
 */
#include "base/bytes.h"
#include "image/decode/decode.h"

#include <string.h>

enum {
    HEADER = 18,
    PALETTE = 1, /* types; with RUNS: the same in runs */
    COLOR = 2,
    GREY = 3,
    RUNS = 8,
    FROM_RIGHT = 0x10, /* bits of the descriptor */
    FROM_TOP = 0x20,
    ALPHA_BITS = 0x0F
};

typedef struct tga {
    int type, in_runs;
    size_t width, height, pixel_size; /* bytes of a pixel in the file */
    unsigned descriptor;
    const uint8_t *palette; /* from its entry 0 on */
    size_t palette_first, palette_end, entry_size;
    const uint8_t *next, *end;
} tga;

/* Returns 0 if the bytes are not a TGA file. */
static int read_header(const uint8_t *bytes, size_t size, tga *t) {
    if (size < HEADER) {
        return 0;
    }
    const unsigned type = bytes[2], depth = bytes[16], entry = bytes[7];
    const size_t first = burnish_load16(bytes + 3), count = burnish_load16(bytes + 5);
    *t = (tga){.type = (int)(type & ~(unsigned)RUNS),
               .in_runs = type & RUNS,
               .width = burnish_load16(bytes + 12),
               .height = burnish_load16(bytes + 14),
               .pixel_size = (depth + 7) / 8,
               .descriptor = bytes[17],
               .palette_first = first,
               .palette_end = first + count,
               .entry_size = (entry + 7) / 8,
               .end = bytes + size};
    const int has_palette = bytes[1] == 1;
    const int is_color = depth == 15 || depth == 16 || depth == 24 || depth == 32;
    const int fits = t->type == PALETTE ? has_palette && depth == 8
                     : t->type == COLOR ? is_color
                                        : t->type == GREY && depth == 8;
    const size_t palette = has_palette ? count * t->entry_size : 0;
    if (!fits || bytes[1] > 1 || t->width == 0 || t->height == 0 || (t->descriptor & 0xC0) ||
        (has_palette && (entry < 15 || entry > 32)) || size - HEADER < bytes[0] + palette) {
        return 0;
    }
    t->palette = bytes + HEADER + bytes[0];
    t->next = t->palette + palette;
    return 1;
}

int burnish_is_tga(const uint8_t *bytes, size_t size) {
    tga unused;
    return read_header(bytes, size, &unused);
}

/* Blue first; 2 bytes hold 5 bits of each. */
static void write_color(const tga *t, const uint8_t *from, size_t size, uint8_t rgba[4]) {
    rgba[3] = 255;
    if (size == 2) {
        const unsigned bits = burnish_load16(from);
        rgba[0] = burnish_widen_5_bits(bits >> 10);
        rgba[1] = burnish_widen_5_bits(bits >> 5);
        rgba[2] = burnish_widen_5_bits(bits);
        return;
    }
    rgba[0] = from[2];
    rgba[1] = from[1];
    rgba[2] = from[0];
    if (size == 4 && (t->descriptor & ALPHA_BITS) == 8) {
        rgba[3] = from[3];
    }
}

static void write_pixel(const tga *t, const uint8_t *from, uint8_t rgba[4]) {
    if (t->type == COLOR) {
        write_color(t, from, t->pixel_size, rgba);
    } else if (t->type == GREY) {
        memset(rgba, *from, 3);
        rgba[3] = 255;
    } else if (*from >= t->palette_first && *from < t->palette_end) {
        write_color(t, t->palette + (*from - t->palette_first) * t->entry_size, t->entry_size,
                    rgba);
    } else {
        memcpy(rgba, (const uint8_t[4]){0, 0, 0, 255}, 4);
    }
}

/* Pixel i of the file, where it belongs. */
static uint8_t *pixel_at(const tga *t, const burnish_image *picture, size_t i) {
    const size_t row = i / t->width, column = i % t->width;
    const size_t y = t->descriptor & FROM_TOP ? row : t->height - 1 - row;
    const size_t x = t->descriptor & FROM_RIGHT ? t->width - 1 - column : column;
    return picture->pixels + (size_t)picture->channels * (y * t->width + x);
}

/* Returns 0 if the file ends before its last pixel. */
static int read_pixels(tga *t, const burnish_image *picture) {
    const size_t count = t->width * t->height;
    for (size_t i = 0; i < count;) {
        size_t length = count, step = t->pixel_size; /* without runs, all pixels are one sequence */
        if (t->in_runs) {
            if (t->next == t->end) {
                return 0;
            }
            length = (size_t)(*t->next & 0x7F) + 1;
            step = *t->next++ & 0x80 ? 0 : t->pixel_size;
        }
        length = length < count - i ? length : count - i;
        if ((size_t)(t->end - t->next) < (step ? length * step : t->pixel_size)) {
            return 0;
        }
        for (size_t k = 0; k < length; ++k, ++i) {
            uint8_t rgba[4];
            write_pixel(t, t->next + k * step, rgba);
            memcpy(pixel_at(t, picture, i), rgba, (size_t)picture->channels);
        }
        t->next += step ? length * step : t->pixel_size;
    }
    return 1;
}

burnish_status burnish_decode_tga(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture) {
    enum { LONGEST = 128 /* pixels of a run */ };
    tga t;
    const int is_there = read_header(from->bytes, from->size, &t);
    const uint64_t room = is_there ? (uint64_t)(t.end - t.next) * (t.in_runs ? LONGEST : 1) : 0;
    if (!is_there || room < (uint64_t)t.width * t.height) {
        return burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                            "%.200s: the file ends before its pixels; it is truncated", from->name);
    }
    const size_t color_size = t.type == PALETTE ? t.entry_size : t.pixel_size;
    const int has_alpha = color_size == 4 && (t.descriptor & ALPHA_BITS) == 8;
    const int channels = from->channels == 4 || has_alpha ? 4 : 3;
    burnish_status status =
        burnish_decode_reserve(from, t.width, t.height, channels, memory, picture);
    if (status == BURNISH_STATUS_OK && !read_pixels(&t, picture)) {
        status =
            burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                         "%.200s: the file ends before its pixels; it is truncated", from->name);
    }
    return status;
}
