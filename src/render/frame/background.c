/* What rows show where nothing covers them: an environment, and the shadow on the ground. */
#include <string.h>

#include "render/frame/target.h"

int burnish_find_shadow(const burnish_output *output, const burnish_tile *tile,
                        const burnish_tile_sums *sums, int number, float *shadow) {
    const burnish_screen_points points = burnish_row_points(&output->view->raster, tile, number);
    const burnish_ground_view *ground = output->ground;
    const int is_exact =
        sums || output->backdrop || output->target.pixels.format == BURNISH_PIXELS_RGBA_FLOAT;
    const float limit = is_exact ? 0.0f : BURNISH_GROUND_DARK;
    int is_dark = output->backdrop != NULL;
    if (ground && !is_exact &&
        (points.x > ground->most[0] || points.x + BURNISH_TILE_SIZE < ground->least[0] ||
         points.y < ground->least[1] || points.y - BURNISH_BLOCK_SIZE > ground->most[1])) {
        ground = NULL;
    }
    if (!ground) {
        memset(shadow, 0, is_dark ? BURNISH_BLOCK_ROW_PIXELS * sizeof *shadow : 0);
        return is_dark;
    }
    output->ops->shadow_ground(ground, &points, BURNISH_BLOCK_ROW_PIXELS, shadow);
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        is_dark |= shadow[i] > limit;
    }
    return is_dark;
}

/* The part of a pixel that shows background, in each channel. sums: NULL where nothing else is. */
static void find_shares(const burnish_output *output, const burnish_tile_sums *sums, int number,
                        const burnish_row_light *row, int i, float shares[3]) {
    const int pixel = number * BURNISH_BLOCK_ROW_PIXELS + i;
    const unsigned block = (unsigned)i / BURNISH_BLOCK_PIXELS;
    float share = 1.0f;
    int differ = 0;
    if (sums && burnish_layered_pixels(sums, number, (int)block) >> i % BURNISH_BLOCK_PIXELS & 1) {
        share = 1.0f - sums->layers->alpha[pixel];
        differ = sums->layers->channel > 0;
    } else if (sums && (row->pixels.simple[i] >= 0 || output->samples == 1)) {
        share = row->pixels.simple[i] >= 0 ? 0.0f : 1.0f;
    } else if (sums) {
        share = (float)(output->samples - sums->covered[pixel]) / (float)output->samples;
    }
    for (int k = 0; k < 3; ++k) {
        shares[k] = differ ? sums->layers->behind[k][pixel] : share;
    }
}

void burnish_add_backdrop(const burnish_output *output, const burnish_tile *tile,
                          const burnish_tile_sums *sums, int number, const float *shadow,
                          burnish_row_light *row) {
    const burnish_tones *tones = &output->view->shading.tones;
    float share[BURNISH_BLOCK_ROW_PIXELS][3], light[3][BURNISH_BLOCK_ROW_PIXELS];
    float *const rgb[3] = {light[0], light[1], light[2]};
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        const int pixel = number * BURNISH_BLOCK_ROW_PIXELS + i;
        float seen[3] = {0, 0, 0};
        find_shares(output, sums, number, row, i, share[i]);
        if (share[i][0] > 0 || share[i][1] > 0 || share[i][2] > 0) {
            burnish_backdrop_light(output->backdrop, tile->x + burnish_pixel_x(pixel),
                                   tile->y + burnish_pixel_y(pixel), seen);
        }
        for (int k = 0; k < 3; ++k) {
            light[k][i] = seen[k];
        }
    }
    if (!tones->is_linear) {
        output->ops->map_tones(tones, BURNISH_BLOCK_ROW_PIXELS, rgb);
    }
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
        for (int k = 0; k < 3; ++k) {
            const float value = light[k][i] < output->limit ? light[k][i] : output->limit;
            const float part = share[i][k];
            if (part != 0) {
                row->rgb[k][i] = (part < 1 ? row->rgb[k][i] : 0) + part * (1 - shadow[i]) * value;
            }
        }
    }
}

void burnish_darken_background(const burnish_output *output, const burnish_tile_sums *sums,
                               int number, const float *shadow, burnish_row_light *row,
                               float *alpha) {
    for (int k = 0; k < 3 && !sums; ++k) { /* most of all rows; loops that become vectors */
        const float background = output->transparent ? 0.0f : output->background_light[k];
        float *light = row->rgb[k];
        for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS; ++i) {
            light[i] = background - shadow[i] * background;
        }
    }
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS && !sums; ++i) {
        alpha[i] = output->transparent ? shadow[i] : 1.0f;
    }
    for (int i = 0; i < BURNISH_BLOCK_ROW_PIXELS && sums; ++i) {
        const unsigned layered = burnish_layered_pixels(sums, number, i / BURNISH_BLOCK_PIXELS);
        float share[3];
        if (row->pixels.simple[i] >= 0 && !(layered >> i % BURNISH_BLOCK_PIXELS & 1)) {
            alpha[i] = 1.0f; /* covered */
            continue;
        }
        find_shares(output, sums, number, row, i, share);
        alpha[i] = output->transparent ? (1.0f - share[0]) + share[0] * shadow[i] : 1.0f;
        for (int k = 0; k < 3; ++k) {
            const float dark = share[k] * shadow[i], before = 1.0f - share[k];
            float *light = &row->rgb[k][i];
            const float background = output->background_light[k];
            if (output->transparent) {
                *light = before > 0 ? *light * (before / alpha[i]) : 0.0f;
            } else {
                *light = (before > 0 ? *light : background) - dark * background;
            }
        }
    }
}
