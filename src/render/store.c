#include "render/store.h"

#include <string.h>

size_t burnish_pixel_size(burnish_pixel_format format) {
    static const size_t sizes[BURNISH_PIXELS_COUNT] = {[BURNISH_PIXELS_RGB8] = 3,
                                                       [BURNISH_PIXELS_RGBA8] = 4,
                                                       [BURNISH_PIXELS_BGRA8] = 4,
                                                       [BURNISH_PIXELS_RGBA_FLOAT] = 16};
    return sizes[format];
}

/* ---- Formats ---- */

/* `width` pixels, four neighbours in each group of 16 codes, as bytes in the target's order. */
static void store_codes(const burnish_output *output, const uint32_t *codes, int width,
                        uint8_t *out) {
    const int is_blue_first = output->target.pixels.format == BURNISH_PIXELS_BGRA8;
    const int red = is_blue_first ? 16 : 0, blue = is_blue_first ? 0 : 16;
    for (int x = 0; x < width; ++x) {
        const uint32_t code = codes[x / 4 * BURNISH_BLOCK_PIXELS + x % 4];
        out[4 * x] = (uint8_t)(code >> red);
        out[4 * x + 1] = (uint8_t)(code >> 8);
        out[4 * x + 2] = (uint8_t)(code >> blue);
        out[4 * x + 3] = (uint8_t)(code >> 24);
    }
}

static void pack_codes(const burnish_output *output, const uint32_t *codes, int width,
                       uint8_t *out) {
    uint8_t bytes[3 * BURNISH_TILE_SIZE + 4];
    output->ops->pack_groups(BURNISH_TILE_SIZE / BURNISH_BLOCK_SIZE, codes, BURNISH_BLOCK_PIXELS,
                             bytes);
    if (width == BURNISH_TILE_SIZE) {
        memcpy(out, bytes, 3 * BURNISH_TILE_SIZE);
    } else {
        memcpy(out, bytes, 3 * (size_t)width);
    }
}

static uint8_t *row_at(const burnish_output *output, const burnish_tile *tile, int y) {
    return output->target.pixels.pixels + (size_t)(tile->y + y) * output->target.pixels.stride +
           (size_t)tile->x * output->pixel_size;
}

/* ---- sRGB codes ---- */

/* With one sample a pixel: dirty blocks are encoded, the others are background. */
static void encode_blocks(const burnish_output *output, unsigned dirty,
                          const burnish_row_light *row, uint32_t *codes) {
    for (int block = 0; block < BURNISH_TILE_BLOCKS; ++block) {
        const int first = block * BURNISH_BLOCK_PIXELS;
        if (dirty >> block & 1) {
            const float *const rgb[3] = {row->rgb[0] + first, row->rgb[1] + first,
                                         row->rgb[2] + first};
            output->ops->encode_pixels(output->encoder, BURNISH_BLOCK_PIXELS, rgb,
                                       row->pixels.simple + first, output->alpha,
                                       output->background_code, codes + first);
        } else {
            for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
                codes[first + i] = output->background_code;
            }
        }
    }
}

/* Samples of a pixel that show something. */
static int covered_samples(const burnish_output *output, const uint8_t *covered,
                           const burnish_row_light *row, int i) {
    return row->pixels.simple[i] >= 0 ? output->samples : covered[i];
}

static void encode_row(const burnish_output *output, const burnish_tile_sums *sums, int number,
                       const burnish_row_light *row, uint32_t *codes) {
    const float *const rgb[3] = {row->rgb[0], row->rgb[1], row->rgb[2]};
    const uint8_t *covered = sums->covered + number * BURNISH_BLOCK_ROW_PIXELS;
    const int samples = output->samples;
    output->ops->encode_pixels(output->encoder, BURNISH_BLOCK_ROW_PIXELS, rgb, NULL, 0, 0, codes);
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS && output->alpha; ++i) {
        const int count = covered_samples(output, covered, row, i);
        codes[i] |= output->transparent ? (uint32_t)((255 * count + samples / 2) / samples) << 24
                                        : output->alpha;
    }
}

/* ---- Linear light ---- */

/* `width` pixels of row y of the blocks, as floats. */
static void store_light(const burnish_output *output, const uint8_t *covered,
                        const burnish_row_light *row, int y, int width, uint8_t *out) {
    for (int x = 0; x < width; ++x, out += sizeof output->background_light) {
        const int i = x / 4 * BURNISH_BLOCK_PIXELS + y * BURNISH_BLOCK_SIZE + x % 4;
        float pixel[4] = {row->rgb[0][i], row->rgb[1][i], row->rgb[2][i], 1.0f};
        if (output->samples == 1 && row->pixels.simple[i] < 0) {
            memcpy(pixel, output->background_light, sizeof pixel);
        } else if (output->samples > 1 && output->transparent) {
            pixel[3] = (float)covered_samples(output, covered, row, i) / (float)output->samples;
        }
        memcpy(out, pixel, sizeof pixel);
    }
}

/* ---- Rows ---- */

void burnish_store_block_row(const burnish_output *output, const burnish_tile *tile,
                             const burnish_tile_sums *sums, int number,
                             const burnish_row_light *row) {
    const int top = number * BURNISH_BLOCK_SIZE, rest = tile->height - top;
    const int rows = rest < BURNISH_BLOCK_SIZE ? rest : BURNISH_BLOCK_SIZE;
    const burnish_pixel_format format = output->target.pixels.format;
    uint32_t codes[BURNISH_BLOCK_ROW_PIXELS];
    if (format == BURNISH_PIXELS_RGBA_FLOAT) {
        for (int y = 0; y < rows; ++y) {
            store_light(output, sums->covered + number * BURNISH_BLOCK_ROW_PIXELS, row, y,
                        tile->width, row_at(output, tile, top + y));
        }
        return;
    }
    if (output->samples == 1) {
        encode_blocks(output, tile->buffer.dirty_blocks[number], row, codes);
    } else {
        encode_row(output, sums, number, row, codes);
    }
    for (int y = 0; y < rows; ++y) {
        (format == BURNISH_PIXELS_RGB8 ? pack_codes : store_codes)(
            output, codes + y * BURNISH_BLOCK_SIZE, tile->width, row_at(output, tile, top + y));
    }
}

void burnish_store_background(const burnish_output *output, const burnish_tile *tile, int first,
                              int end) {
    for (int y = first; y < end && y < tile->height; ++y) {
        memcpy(row_at(output, tile, y), output->background,
               (size_t)tile->width * output->pixel_size);
    }
}

/* ---- A frame ---- */

/* One pixel of background in the target's format. */
static void background_pixel(const burnish_output *output, uint8_t pixel[16]) {
    if (output->target.pixels.format == BURNISH_PIXELS_RGBA_FLOAT) {
        memcpy(pixel, output->background_light, sizeof output->background_light);
    } else {
        store_codes(output, &output->background_code, 1, pixel);
    }
}

burnish_status burnish_output_begin(burnish_output *output, const burnish_target *target,
                                    const burnish_render_options *options, burnish_output_row *row,
                                    burnish_memory *memory) {
    const uint8_t *code = options->background;
    const size_t width = (size_t)options->width;
    uint8_t pixel[16];
    output->target = *target;
    output->samples = options->samples;
    output->transparent = options->transparent;
    output->limit = target->pixels.format == BURNISH_PIXELS_RGBA_FLOAT ? __builtin_inff() : 1.0f;
    output->alpha = target->pixels.format == BURNISH_PIXELS_RGB8 ? 0 : 0xff000000u;
    output->background_code = 0;
    memset(output->background_light, 0, sizeof output->background_light);
    if (!options->transparent) {
        output->background_code =
            (uint32_t)code[0] | (uint32_t)code[1] << 8 | (uint32_t)code[2] << 16 | output->alpha;
        for (int k = 0; k < 3; ++k) {
            output->background_light[k] = burnish_srgb_to_linear[code[k]];
        }
        output->background_light[3] = 1.0f;
    }
    output->pixel_size = burnish_pixel_size(target->pixels.format);
    row->bytes = burnish_reserve_discard(memory, row->bytes, &row->capacity,
                                         width * output->pixel_size, 1, "a row of background");
    if (!row->bytes) {
        return memory->status;
    }
    background_pixel(output, pixel);
    for (size_t i = 0; i < width; ++i) {
        memcpy(row->bytes + i * output->pixel_size, pixel, output->pixel_size);
    }
    output->background = row->bytes;
    return BURNISH_STATUS_OK;
}
