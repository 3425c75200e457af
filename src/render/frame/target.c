/* What a finished tile becomes in the caller's target: samples to pixels in linear light, and
 * pixels to bytes. target_planes.c has the planes. */
#include "render/frame/target.h"

#include <string.h>

#include "base/layout.h"

/* Marks targets that burnish_target_default() made. */
#define COOKIE BURNISH_COOKIE(0x74677431, burnish_target)

void burnish_target_init(burnish_target *target, uint64_t layout) {
    const burnish_target defaults = {.cookie = COOKIE};
    burnish_layout_init(target, layout, BURNISH_LAYOUT(burnish_target), &defaults);
}

static size_t pixel_size_of(burnish_pixel_format format) {
    static const size_t sizes[] = {[BURNISH_PIXELS_RGB8] = 3,
                                   [BURNISH_PIXELS_RGBA8] = 4,
                                   [BURNISH_PIXELS_BGRA8] = 4,
                                   [BURNISH_PIXELS_RGBA_FLOAT] = 16};
    return sizes[format];
}

/* ---- Checks ---- */

/* Whether rows of `width` items of `size` bytes, made of words, fit a plane's stride. */
static burnish_status check_plane(const void *plane, size_t stride, size_t row, size_t word,
                                  const char *name, burnish_error *error) {
    if (plane && (stride < row || stride % word != 0)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "target: %s has a stride of %zu bytes; expected at least %zu, a multiple of %zu", name,
            stride, row, word);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_pixels(const burnish_pixels *pixels,
                                   const burnish_render_options *options, burnish_error *error) {
    if (!pixels->pixels) {
        return BURNISH_STATUS_OK;
    }
    if ((unsigned)pixels->format > BURNISH_PIXELS_RGBA_FLOAT) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "target: %d is no pixel format; expected RGB8, RGBA8, BGRA8 or RGBA_FLOAT",
            (int)pixels->format);
    }
    const burnish_row_range rows = burnish_drawn_rows(options);
    if (pixels->width != options->width || pixels->height != rows.end - rows.first) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "target: %d x %d pixels, but the options ask for %d x %d",
                            pixels->width, pixels->height, options->width, rows.end - rows.first);
    }
    if (options->transparent && pixels->format == BURNISH_PIXELS_RGB8) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "target: RGB8 has no alpha; use RGBA8 or BGRA8 for a transparent background");
    }
    return check_plane(pixels->pixels, pixels->stride,
                       (size_t)pixels->width * pixel_size_of(pixels->format), 1, "pixels", error);
}

burnish_status burnish_target_check(const burnish_target *target,
                                    const burnish_render_options *options, burnish_error *error) {
    burnish_status status = burnish_layout_check(target, COOKIE, "target", "target", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t width = (size_t)options->width;
    status = check_pixels(&target->pixels, options, error);
    const struct {
        const void *plane;
        size_t stride, size, word;
        const char *name;
    } planes[] = {{target->depth, target->depth_stride, 4, 4, "depth"},
                  {target->triangles, target->triangle_stride, 4, 4, "triangles"},
                  {target->normals, target->normal_stride, 12, 4, "normals"},
                  {target->coverage, target->coverage_stride, 1, 1, "coverage"}};
    for (size_t i = 0; i < sizeof planes / sizeof *planes && status == BURNISH_STATUS_OK; ++i) {
        status = check_plane(planes[i].plane, planes[i].stride, width * planes[i].size,
                             planes[i].word, planes[i].name, error);
    }
    return status;
}

/* ---- Resolve ---- */

/* What passes to the samples `bits` of a pixel, of each channel. */
static void find_through(const burnish_layer_light *layers, int samples, int pixel, unsigned bits,
                         float through[3]) {
    through[0] = through[1] = through[2] = burnish_layers_through(layers, samples, 0, pixel, bits);
    for (int k = 1; k < 3 && layers->channel; ++k) {
        through[k] = burnish_layers_through(layers, samples, k, pixel, bits);
    }
}

static void add_light(burnish_tile_sums *sums, const burnish_fragments *fragments,
                      const float *const rgb[3], int samples, float limit) {
    for (int i = 0; i < fragments->count; ++i) {
        const int pixel = fragments->pixels[i];
        float weight[3] = {(float)fragments->weight[i]};
        if (sums->layers) {
            find_through(sums->layers, samples, pixel, fragments->samples[i], weight);
        } else {
            weight[1] = weight[2] = weight[0];
        }
        for (int k = 0; k < 3; ++k) {
            const float value = rgb[k][i];
            sums->light[k][pixel] += weight[k] * (value < limit ? value : limit);
        }
        sums->covered[pixel] = (uint8_t)(sums->covered[pixel] + fragments->weight[i]);
    }
}

/* a where simple >= 0, b elsewhere; without a branch, which would be unpredictable. */
static inline float pick_simple(int32_t simple, float a, float b) {
    uint32_t none = (uint32_t)(simple >> 31), a_bits, b_bits;
    memcpy(&a_bits, &a, sizeof a_bits);
    memcpy(&b_bits, &b, sizeof b_bits);
    a_bits = (a_bits & ~none) | (b_bits & none);
    memcpy(&a, &a_bits, sizeof a);
    return a;
}

/* Resolves a row with several samples in place: simple pixels stay, complex ones get the mean of
 * their sums. Pixels that nothing covers get the background's code back from its linear value. */
static void resolve_row(const burnish_output *output, const burnish_tile_sums *sums, int number,
                        burnish_row_light *row) {
    const int base = number * BURNISH_BLOCK_ROW_PIXELS, samples = output->samples;
    const int transparent = output->transparent;
    const uint8_t *covered = sums->covered + base;
    const float all = 1.0f / (float)samples; /* a power of two */
    const float limit = output->limit;
    for (int k = 0; k < 3; ++k) {
        const float background = output->background_light[k];
        const float *sum = sums->light[k] + base;
        float *light = row->rgb[k];
        for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
            const float missing = (float)(samples - covered[i]);
            float mixed = (sum[i] + missing * background) * all;
            if (transparent) {
                mixed = covered[i] ? sum[i] * (1.0f / (float)covered[i]) : 0.0f;
            }
            const float value = light[i] < limit ? light[i] : limit;
            light[i] = pick_simple(row->pixels.simple[i], value, mixed);
        }
    }
}

/* One sample at least of pixel i of a row shows a layer: what the row has there so far is the light
 * of opaque triangles, and their light and the background's pass through the layers. */
static void resolve_layered_pixel(const burnish_output *output, const burnish_tile *tile,
                                  const burnish_tile_sums *sums, int number, int i,
                                  burnish_row_light *row) {
    const int pixel = number * BURNISH_BLOCK_ROW_PIXELS + i, samples = output->samples;
    const unsigned all = (1u << samples) - 1;
    const int is_simple = row->pixels.simple[i] >= 0;
    unsigned empty = 0;
    for (int s = 0; s < samples && !is_simple; ++s) {
        const float depth = tile->buffer.depths[burnish_sample_index(samples, pixel, s)];
        empty |= (unsigned)(depth == BURNISH_FARTHEST) << s;
    }
    float passed[3], missing[3];
    find_through(sums->layers, samples, pixel, is_simple ? all : 0, passed);
    find_through(sums->layers, samples, pixel, empty, missing);
    float least = missing[0] < missing[1] ? missing[0] : missing[1];
    least = missing[2] < least ? missing[2] : least;
    const float alpha = (float)samples - least;
    for (int k = 0; k < 3; ++k) {
        const float value = row->rgb[k][i] < output->limit ? row->rgb[k][i] : output->limit;
        float sum = sums->layers->light[k][pixel];
        sum += is_simple ? passed[k] * value : samples > 1 ? sums->light[k][pixel] : 0.0f;
        if (output->transparent) { /* as in front of white, which shows the tint */
            row->rgb[k][i] = alpha > 0 ? (sum + (missing[k] - least)) / alpha : 0.0f;
            missing[k] = least;
        } else {
            row->rgb[k][i] = (sum + missing[k] * output->background_light[k]) / (float)samples;
        }
        sums->layers->behind[k][pixel] = missing[k] / (float)samples;
    }
    sums->layers->alpha[pixel] = alpha / (float)samples;
    row->pixels.simple[i] = is_simple ? row->pixels.simple[i] : 0; /* it shows something */
}

static void resolve_layers(const burnish_output *output, const burnish_tile *tile,
                           const burnish_tile_sums *sums, int number, burnish_row_light *row) {
    for (int block = 0; block < BURNISH_TILE_BLOCKS; ++block) {
        for (unsigned rest = burnish_layered_pixels(sums, number, block); rest; rest &= rest - 1) {
            const int i = block * BURNISH_BLOCK_PIXELS + __builtin_ctz(rest);
            resolve_layered_pixel(output, tile, sums, number, i, row);
        }
    }
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

/* The same as three bytes per pixel. */
static void pack_codes(const burnish_output *output, const uint32_t *codes, int width,
                       uint8_t *out) {
    const int whole = width / BURNISH_BLOCK_SIZE, rest = width % BURNISH_BLOCK_SIZE;
    output->ops->pack_groups((size_t)whole, codes, BURNISH_BLOCK_PIXELS, out);
    if (rest) {
        uint8_t bytes[3 * BURNISH_BLOCK_SIZE];
        output->ops->pack_groups(1, codes + whole * BURNISH_BLOCK_PIXELS, 0, bytes);
        memcpy(out + 3 * whole * BURNISH_BLOCK_SIZE, bytes, 3 * (size_t)rest);
    }
}

static uint8_t *row_at(const burnish_output *output, const burnish_tile *tile, int y) {
    const size_t row = (size_t)(tile->y + y - output->rows.first);
    return output->target.pixels.pixels + row * output->target.pixels.stride +
           (size_t)tile->x * output->pixel_size;
}

/* ---- sRGB codes ---- */

/* With one sample a pixel: dirty blocks are encoded, the others are background. */
static void encode_blocks(const burnish_output *output, unsigned dirty,
                          const burnish_row_light *row, uint32_t *codes) {
    for (int block = 0, end; block < BURNISH_TILE_BLOCKS; block = end) {
        const unsigned is_dirty = dirty >> block & 1;
        for (end = block + 1; end < BURNISH_TILE_BLOCKS && (dirty >> end & 1) == is_dirty; ++end) {
        }
        const int first = block * BURNISH_BLOCK_PIXELS;
        const int count = (end - block) * BURNISH_BLOCK_PIXELS;
        if (is_dirty) {
            const float *const rgb[3] = {row->rgb[0] + first, row->rgb[1] + first,
                                         row->rgb[2] + first};
            output->ops->encode_pixels(output->encoder, (size_t)count, rgb,
                                       row->pixels.simple + first, output->alpha,
                                       output->background_code, codes + first);
        }
        for (int i = first; i < first + count && !is_dirty; ++i) {
            codes[i] = output->background_code;
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

/* Puts the alpha of pixels that show layers into a row's codes. */
static void encode_layered_alpha(const burnish_output *output, const burnish_tile_sums *sums,
                                 int number, uint32_t *codes) {
    for (int block = 0; block < BURNISH_TILE_BLOCKS && output->transparent; ++block) {
        for (unsigned rest = burnish_layered_pixels(sums, number, block); rest; rest &= rest - 1) {
            const int i = block * BURNISH_BLOCK_PIXELS + __builtin_ctz(rest);
            const float alpha = sums->layers->alpha[number * BURNISH_BLOCK_ROW_PIXELS + i];
            codes[i] = (codes[i] & 0xffffffu) | (uint32_t)(255 * alpha + 0.5f) << 24;
        }
    }
}

/* ---- Linear light ---- */

/* `width` pixels of row y of the blocks, as floats. */
static void store_light(const burnish_output *output, const burnish_tile_sums *sums, int number,
                        const burnish_row_light *row, int y, int width, uint8_t *out) {
    const uint8_t *covered = sums->covered + number * BURNISH_BLOCK_ROW_PIXELS;
    for (int x = 0; x < width; ++x, out += sizeof output->background_light) {
        const int i = x / 4 * BURNISH_BLOCK_PIXELS + y * BURNISH_BLOCK_SIZE + x % 4;
        float pixel[4] = {row->rgb[0][i], row->rgb[1][i], row->rgb[2][i], 1.0f};
        if (output->samples == 1 && row->pixels.simple[i] < 0) {
            memcpy(pixel, output->background_light, sizeof pixel);
        } else if (output->samples > 1 && output->transparent) {
            pixel[3] = (float)covered_samples(output, covered, row, i) / (float)output->samples;
        }
        if (burnish_layered_pixels(sums, number, x / 4) >> i % BURNISH_BLOCK_PIXELS & 1 &&
            output->transparent) {
            pixel[3] = sums->layers->alpha[number * BURNISH_BLOCK_ROW_PIXELS + i];
        }
        memcpy(out, pixel, sizeof pixel);
    }
}

/* ---- Tiles ---- */

void burnish_output_add_fragments(const burnish_output *output, const burnish_tile *tile,
                                  const burnish_fragments *fragments,
                                  const burnish_fragment_batch *batch, const float *const rgb[3],
                                  burnish_tile_sums *sums) {
    add_light(sums, fragments, rgb, output->samples, output->limit);
    if (output->has_planes) {
        burnish_planes_store_fragments(output, tile, fragments, batch, sums->weights);
    }
}

void burnish_output_store_codes(const burnish_output *output, const burnish_tile *tile, int number,
                                const uint32_t *codes) {
    const int is_packed = output->target.pixels.format == BURNISH_PIXELS_RGB8;
    const burnish_row_range rows = burnish_output_rows(output, tile, number);
    for (int y = rows.first, top = number * BURNISH_BLOCK_SIZE; y < rows.end; ++y) {
        (is_packed ? pack_codes : store_codes)(output, codes + y * BURNISH_BLOCK_SIZE, tile->width,
                                               row_at(output, tile, top + y));
    }
}

static void store_pixels(const burnish_output *output, const burnish_tile *tile,
                         const burnish_tile_sums *sums, int number, const burnish_row_light *row) {
    const burnish_row_range rows = burnish_output_rows(output, tile, number);
    uint32_t codes[BURNISH_BLOCK_ROW_PIXELS];
    if (output->target.pixels.format == BURNISH_PIXELS_RGBA_FLOAT) {
        for (int y = rows.first, top = number * BURNISH_BLOCK_SIZE; y < rows.end; ++y) {
            store_light(output, sums, number, row, y, tile->width, row_at(output, tile, top + y));
        }
        return;
    }
    if (output->samples == 1) {
        encode_blocks(output, tile->buffer.dirty_blocks[number], row, codes);
    } else {
        encode_row(output, sums, number, row, codes);
    }
    encode_layered_alpha(output, sums, number, codes);
    burnish_output_store_codes(output, tile, number, codes);
}

/* ---- Ground ---- */

/* `width` pixels of row y of the blocks, as floats. */
static void store_resolved(const burnish_row_light *row, const float *alpha, int y, int width,
                           uint8_t *out) {
    for (int x = 0; x < width; ++x) {
        const int i = x / 4 * BURNISH_BLOCK_PIXELS + y * BURNISH_BLOCK_SIZE + x % 4;
        const float pixel[4] = {row->rgb[0][i], row->rgb[1][i], row->rgb[2][i], alpha[i]};
        memcpy(out + (size_t)x * sizeof pixel, pixel, sizeof pixel);
    }
}

static void store_on_ground(const burnish_output *output, const burnish_tile *tile,
                            const burnish_tile_sums *sums, int number, const float *shadow,
                            burnish_row_light *row) {
    const float *const rgb[3] = {row->rgb[0], row->rgb[1], row->rgb[2]};
    const burnish_row_range rows = burnish_output_rows(output, tile, number);
    float alpha[BURNISH_BLOCK_ROW_PIXELS];
    uint32_t codes[BURNISH_BLOCK_ROW_PIXELS];
    if (output->backdrop) {
        burnish_add_backdrop(output, tile, sums, number, shadow, row);
        for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
            alpha[i] = 1;
        }
    } else {
        burnish_darken_background(output, sums, number, shadow, row, alpha);
    }
    if (output->target.pixels.format == BURNISH_PIXELS_RGBA_FLOAT) {
        for (int y = rows.first, top = number * BURNISH_BLOCK_SIZE; y < rows.end; ++y) {
            store_resolved(row, alpha, y, tile->width, row_at(output, tile, top + y));
        }
        return;
    }
    output->ops->encode_pixels(output->encoder, BURNISH_BLOCK_ROW_PIXELS, rgb, NULL, 0, 0, codes);
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS && output->alpha; ++i) {
        codes[i] |= (uint32_t)(alpha[i] * 255.0f + 0.5f) << 24;
    }
    burnish_output_store_codes(output, tile, number, codes);
}

static void store_outline(const burnish_output *output, const burnish_tile *tile, int number,
                          const burnish_outline_pixels *pixels) {
    const burnish_row_range rows = burnish_output_rows(output, tile, number);
    burnish_outline_store(output->outline, tile, number, rows.first, rows.end, pixels);
}

void burnish_output_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number, burnish_row_light *row) {
    float shadow[BURNISH_BLOCK_ROW_PIXELS];
    if (output->has_planes) { /* while row->pixels tells of opaque triangles alone */
        burnish_planes_store_row(output, tile, sums, number, &row->pixels);
    }
    if (output->target.pixels.pixels) {
        if (output->samples > 1) {
            resolve_row(output, sums, number, row);
        }
        resolve_layers(output, tile, sums, number, row);
        if (burnish_find_shadow(output, tile, sums, number, shadow)) {
            store_on_ground(output, tile, sums, number, shadow, row);
        } else {
            store_pixels(output, tile, sums, number, row);
        }
    }
    if (output->outline) {
        const burnish_outline_pixels pixels = {row->pixels.simple,
                                               output->samples > 1 ? sums->covered : NULL,
                                               sums->layers ? sums->layers->covered : NULL};
        store_outline(output, tile, number, &pixels);
    }
}

void burnish_output_prefetch(const burnish_output *output, int x, int y) {
    enum { LINE = 64 /* bytes */ };
    const burnish_pixels *pixels = &output->target.pixels;
    const int left = pixels->width - x, end = y + BURNISH_BLOCK_SIZE;
    const int width = left < BURNISH_TILE_SIZE ? left : BURNISH_TILE_SIZE;
    for (; pixels->pixels && y < end; ++y) {
        if (y < output->rows.first || y >= output->rows.end) {
            continue;
        }
        const uint8_t *row = pixels->pixels + (size_t)(y - output->rows.first) * pixels->stride +
                             (size_t)x * output->pixel_size;
        for (size_t i = 0; i < (size_t)width * output->pixel_size; i += LINE) {
            __builtin_prefetch(row + i, 1, 2);
        }
    }
}

void burnish_output_store_background(const burnish_output *output, const burnish_tile *tile,
                                     int number) {
    const burnish_row_range rows = burnish_output_rows(output, tile, number);
    const int top = number * BURNISH_BLOCK_SIZE;
    float shadow[BURNISH_BLOCK_ROW_PIXELS];
    if (output->outline) {
        store_outline(output, tile, number, NULL);
    }
    if (output->target.pixels.pixels && burnish_find_shadow(output, tile, NULL, number, shadow)) {
        burnish_row_light row;
        store_on_ground(output, tile, NULL, number, shadow, &row);
        return;
    }
    for (int y = rows.first; output->target.pixels.pixels && y < rows.end; ++y) {
        memcpy(row_at(output, tile, top + y), output->background,
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
    output->rows = burnish_drawn_rows(options);
    output->has_planes = burnish_planes_are_wanted(target);
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
            output->background_light[k] = output->backdrop ? 0 : burnish_srgb_to_linear[code[k]];
        }
        output->background_light[3] = 1.0f;
    }
    output->pixel_size = pixel_size_of(target->pixels.format);
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
