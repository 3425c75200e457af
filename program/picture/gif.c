/* GIF 89a with one palette for all frames. Each frame is the part that changed, and within it what
 * stayed is "as before".
 *
 * Colours between those of the palette are mixed by a fixed pattern (ordered dithering): what stays
 * the same in a scene has the same pixels in every frame and does not flicker, as it would where
 * errors are handed on from pixel to pixel; and a colour of the palette, as the ground is, stays
 * flat. LZW is written here: it takes fewer lines than a library's streams would. */
#include <stdlib.h>
#include <string.h>

#include "picture/animation.h"

enum {
    NOTHING = 255, /* the index that shows what was there before, or nothing */
    MIX = 16,      /* pixels that mix colours of the palette to another one */
    MIX_BITS = 15, /* mixes that are kept: 640 KiB */
    LZW_CLEAR = 256,
    LZW_END = 257,
    LZW_MAX = 4095,
    LZW_SLOTS = 8192, /* a hash table at most half full */
    BLOCK_MAX = 255
};

/* Codes of 9 to 12 bits, the lowest bit first, in blocks of up to 255 bytes. */
typedef struct lzw {
    picture_bytes *out;
    uint32_t bits;
    int bit_count, width, next;
    uint8_t block[BLOCK_MAX];
    int block_size;
    uint32_t keys[LZW_SLOTS]; /* 1 + (prefix << 8 | value); 0: free */
    uint16_t codes[LZW_SLOTS];
} lzw;

typedef struct color_mix {
    uint32_t key;         /* 1 + the colour; 0: free */
    uint8_t indices[MIX]; /* the darkest first */
} color_mix;

typedef struct gif_state {
    uint8_t *indices, *before; /* of this frame and of the one before */
    int is_transparent;
    lzw coder;
    color_mix mixes[1 << MIX_BITS]; /* by a hash of their colours; a new one replaces another */
} gif_state;

/* ---- LZW ---- */

static void flush_block(lzw *coder) {
    if (coder->block_size > 0) {
        picture_put_byte(coder->out, coder->block_size);
        picture_put(coder->out, coder->block, (size_t)coder->block_size);
        coder->block_size = 0;
    }
}

static void put_code(lzw *coder, int code) {
    coder->bits |= (uint32_t)code << coder->bit_count;
    coder->bit_count += coder->width;
    while (coder->bit_count >= 8) {
        coder->block[coder->block_size++] = (uint8_t)coder->bits;
        coder->bits >>= 8;
        coder->bit_count -= 8;
        if (coder->block_size == BLOCK_MAX) {
            flush_block(coder);
        }
    }
}

static void clear_table(lzw *coder) {
    put_code(coder, LZW_CLEAR);
    memset(coder->keys, 0, sizeof coder->keys);
    coder->width = 9;
    coder->next = LZW_END + 1;
}

/* The slot of a key, or the free one where it belongs. */
static inline uint32_t find_slot(const lzw *coder, uint32_t key) {
    uint32_t slot = key * 2654435761U >> 19; /* 13 bits */
    while (coder->keys[slot] != key && coder->keys[slot] != 0) {
        slot = (slot + 1) % LZW_SLOTS;
    }
    return slot;
}

/* A reader learns each code one step later than the writer, and widens its codes when the next one
 * does not fit: so here before the code is counted. */
static void count_code(lzw *coder) {
    if (coder->next == 1 << coder->width && coder->width < 12) {
        ++coder->width;
    }
    ++coder->next;
}

/* Returns the code of what is left to be put; negative: nothing. */
static int put_row(lzw *coder, const uint8_t *row, int count, int prefix) {
    int i = 0;
    if (prefix < 0) {
        prefix = row[i++];
    }
    for (; i < count; ++i) {
        const uint32_t key = 1 + ((uint32_t)prefix << 8 | row[i]);
        const uint32_t slot = find_slot(coder, key);
        if (coder->keys[slot] == key) {
            prefix = coder->codes[slot];
            continue;
        }
        put_code(coder, prefix);
        coder->keys[slot] = key;
        coder->codes[slot] = (uint16_t)coder->next;
        count_code(coder);
        if (coder->next > LZW_MAX) {
            clear_table(coder);
        }
        prefix = row[i];
    }
    return prefix;
}

/* The image data of a rectangle of indices. */
static void put_indices(gif_state *state, picture_bytes *out, const int box[4], int width) {
    lzw *coder = &state->coder;
    int prefix = -1;
    *coder = (lzw){.out = out, .width = 9};
    picture_put_byte(out, 8); /* bits of an index */
    clear_table(coder);
    for (int y = box[1]; y < box[1] + box[3]; ++y) {
        prefix = put_row(coder, state->indices + (size_t)y * (size_t)width + (size_t)box[0], box[2],
                         prefix);
    }
    put_code(coder, prefix);
    count_code(coder);
    put_code(coder, LZW_END);
    if (coder->bit_count > 0) {
        coder->block[coder->block_size++] = (uint8_t)coder->bits;
    }
    flush_block(coder);
    picture_put_byte(out, 0);
}

/* ---- Colours to indices ---- */

/* 0 to 15, each once in 4 x 4 pixels, neighbours far apart (Bayer). */
static const uint8_t ranks[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

static int color_luma(const uint8_t color[3]) {
    return 3 * color[0] + 6 * color[1] + color[2];
}

/* Colours of the palette whose mean is this one, as near as can be (Knoll's pattern dithering):
 * each is the nearest to what the ones before leave to be done. Darker ones first, so that
 * neighbouring mixes are alike. A colour of the palette is all of its mix. */
static void choose_mix(const picture_palette *palette, const uint8_t color[3], uint8_t mix[MIX]) {
    int left[3] = {0};
    for (int i = 0; i < MIX; ++i) {
        uint8_t wanted[3];
        for (int k = 0; k < 3; ++k) {
            const int value = color[k] + left[k];
            wanted[k] = (uint8_t)(value < 0 ? 0 : value > 255 ? 255 : value);
        }
        const int nearest = picture_palette_nearest(palette, wanted);
        for (int k = 0; k < 3; ++k) {
            left[k] += color[k] - palette->colors[nearest][k];
        }
        int at = i;
        for (; at > 0 &&
               color_luma(palette->colors[mix[at - 1]]) > color_luma(palette->colors[nearest]);
             --at) {
            mix[at] = mix[at - 1];
        }
        mix[at] = (uint8_t)nearest;
    }
}

/* The mix of a colour. */
static const uint8_t *find_mix(gif_state *state, const picture_palette *palette,
                               const uint8_t color[3]) {
    const uint32_t key = 1 + ((uint32_t)color[0] << 16 | (uint32_t)color[1] << 8 | color[2]);
    color_mix *mix = &state->mixes[key * 2654435761U >> (32 - MIX_BITS)];
    if (mix->key != key) {
        mix->key = key;
        choose_mix(palette, color, mix->indices);
    }
    return mix->indices;
}

static void map_frame(gif_state *state, const picture_palette *palette,
                      const burnish_image *frame) {
    const size_t channels = (size_t)frame->channels, width = (size_t)frame->width;
    const uint8_t *pixel = frame->pixels;
    for (int y = 0; y < frame->height; ++y) {
        uint8_t *row = state->indices + (size_t)y * width;
        const uint8_t *rank = ranks[y & 3];
        for (size_t x = 0; x < width;) {
            const size_t run = picture_run(pixel, width - x, channels), end = x + run;
            const uint8_t *mix = find_mix(state, palette, pixel);
            const int is_seen = channels == 3 || pixel[3] >= 128;
            for (; x < end; ++x) {
                row[x] = is_seen ? mix[rank[x & 3]] : NOTHING;
            }
            pixel += run * channels;
        }
    }
}

/* Indices that are those of the frame before become NOTHING. [*left, *right] grows by the others.
 * Returns whether there are some. */
static int drop_row(uint8_t *indices, uint8_t *before, int width, int *left, int *right) {
    enum { STEP = 32 };
    int is_changed = 0;
    for (int x = 0; x < width; x += STEP) {
        const int end = width - x < STEP ? width : x + STEP;
        if (memcmp(indices + x, before + x, (size_t)(end - x)) == 0) {
            memset(indices + x, NOTHING, (size_t)(end - x));
            continue;
        }
        for (int i = x; i < end; ++i) {
            if (indices[i] == before[i]) {
                indices[i] = NOTHING;
            } else {
                before[i] = indices[i];
                *left = i < *left ? i : *left;
                *right = i > *right ? i : *right;
            }
        }
        is_changed = 1;
    }
    return is_changed;
}

/* box: the part of the frame that changed. */
static void drop_unchanged(gif_state *state, int width, int height, int box[4]) {
    int left = width, right = -1, top = height, bottom = -1;
    for (int y = 0; y < height; ++y) {
        const size_t at = (size_t)y * (size_t)width;
        if (drop_row(state->indices + at, state->before + at, width, &left, &right)) {
            top = y < top ? y : top;
            bottom = y;
        }
    }
    const int none = right < 0;
    box[0] = none ? 0 : left;
    box[1] = none ? 0 : top;
    box[2] = none ? 1 : right - left + 1;
    box[3] = none ? 1 : bottom - top + 1;
}

/* ---- The file ---- */

static void put_u16(picture_bytes *out, int value) {
    picture_put_byte(out, value & 255);
    picture_put_byte(out, value >> 8);
}

static burnish_status gif_begin(picture_animation *animation, burnish_error *error) {
    const picture_animation_options *o = &animation->options;
    picture_bytes *out = &animation->out;
    const size_t count = (size_t)o->width * (size_t)o->height;
    gif_state *state = calloc(1, sizeof *state);
    animation->state = state;
    if (state) {
        state->indices = malloc(count);
        state->before = malloc(count);
        state->is_transparent = o->channels == 4;
    }
    if (!state || !state->indices || !state->before) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the GIF");
    }
    memset(state->before, NOTHING, count);
    picture_put(out, "GIF89a", 6);
    put_u16(out, o->width);
    put_u16(out, o->height);
    picture_put(out, "\xF7\0", 3); /* a palette of 256, no background, square pixels */
    picture_put(out, o->palette->colors, 3 * (size_t)o->palette->count);
    for (int i = o->palette->count; i < 256; ++i) {
        picture_put(out, "\0\0", 3);
    }
    picture_put(out,
                "\x21\xFE\x07"
                "burnish\0",
                11);                                             /* a comment, as PNG's Software */
    picture_put(out, "\x21\xFF\x0BNETSCAPE2.0\x03\x01\0\0", 19); /* repeat for ever */
    return BURNISH_STATUS_OK;
}

static burnish_status gif_add(picture_animation *animation, const burnish_image *frame,
                              burnish_error *error) {
    gif_state *state = animation->state;
    picture_bytes *out = &animation->out;
    const int time = picture_time(animation, animation->index + 1, 100) -
                     picture_time(animation, animation->index, 100);
    int box[4] = {0, 0, frame->width, frame->height};
    (void)error;
    map_frame(state, animation->options.palette, frame);
    if (!state->is_transparent) {
        drop_unchanged(state, frame->width, frame->height, box);
    }
    picture_put(out, "\x21\xF9\x04", 3);
    /* with a transparent index; afterwards it stays, or where the ground is transparent goes */
    picture_put_byte(out, state->is_transparent ? 9 : 5);
    put_u16(out, time);
    picture_put_byte(out, NOTHING);
    picture_put_byte(out, 0);
    picture_put_byte(out, 0x2C);
    for (int i = 0; i < 4; ++i) {
        put_u16(out, box[i]);
    }
    picture_put_byte(out, 0);
    put_indices(state, out, box, frame->width);
    return BURNISH_STATUS_OK;
}

static burnish_status gif_end(picture_animation *animation, burnish_error *error) {
    (void)error;
    picture_put_byte(&animation->out, 0x3B);
    return BURNISH_STATUS_OK;
}

static void gif_destroy(void *from) {
    gif_state *state = from;
    free(state->indices);
    free(state->before);
    free(state);
}

const picture_animator picture_gif = {gif_begin, gif_add, gif_end, gif_destroy};
