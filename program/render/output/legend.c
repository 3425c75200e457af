/* The legend of --color-by. */
#include "render/output/result.h"

#include <stdio.h>
#include <string.h>

#include "burnish/sheet.h"
#include "render/scene/color.h"

enum { TICKS = 5 };
#define TEXT (1.0 / 44) /* height of letters, in parts of the smaller side */

static void fill_box(burnish_image *image, const int box[4], const uint8_t srgb[3]) {
    for (int y = box[1] > 0 ? box[1] : 0; y < box[3] && y < image->height; ++y) {
        for (int x = box[0] > 0 ? box[0] : 0; x < box[2] && x < image->width; ++x) {
            uint8_t *pixel = image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) *
                                                 (size_t)image->channels;
            memcpy(pixel, srgb, 3);
            if (image->channels == 4) {
                pixel[3] = 255;
            }
        }
    }
}

/* The label of a tick, from the highest value on. */
static void write_label(const double range[2], int tick, char label[32]) {
    const double at = range[1] + (range[0] - range[1]) * tick / (TICKS - 1);
    const double size = range[1] > range[0] ? range[1] - range[0] : range[0] - range[1];
    snprintf(label, 32, "%.4g", at < size * 1e-4 && at > -size * 1e-4 ? 0.0 : at);
}

/* Pixels from the bar to the end of the longest label. */
static float label_room(const double range[2], float text) {
    static const uint8_t ink[3] = {0};
    float most = 0;
    for (int i = 0; i < TICKS; ++i) {
        char label[32];
        write_label(range, i, label);
        const float length = burnish_image_draw_text(NULL, 0, 0, text, ink, label);
        most = length > most ? length : most;
    }
    return text / 2 + 2 + most;
}

/* Names of what is drawn, each beside its colour. */
static void draw_names(const render_result *result, burnish_image *image, float text,
                       const uint8_t ink[3]) {
    const burnish_contents *c = burnish_mesh_get_contents(result->mesh);
    const int by_part = render_names_parts(&result->settings->input.coloring);
    const int smaller = image->width < image->height ? image->width : image->height;
    const size_t count = by_part ? c->part_count : c->filament_count;
    const int size = (int)text;
    int left = image->width - (int)(RENDER_LEGEND_INSET * smaller), top = image->height / 8;
    for (size_t i = 0; i < count && by_part; ++i) { /* the longest one fits */
        const float length = burnish_image_draw_text(NULL, 0, 0, text, ink, c->parts[i].name);
        const int first = image->width - (int)length - 4 * size;
        left = first < left ? first > 0 ? first : 0 : left;
    }
    for (size_t i = 0; i < count; ++i) {
        char label[BURNISH_NAME_SIZE];
        uint8_t srgb[3];
        const int box[4] = {left, top, left + size, top + size};
        if ((by_part && c->parts[i].role != BURNISH_PART_SOLID) || box[3] > image->height) {
            continue;
        }
        burnish_part_color(i, srgb);
        fill_box(image, box, by_part ? srgb : c->filaments[i].srgb);
        snprintf(label, sizeof label, "%zu %.40s", i + 1, by_part ? c->parts[i].name : "");
        burnish_image_draw_text(image, (float)(left + size + size / 2), (float)(top + size), text,
                                ink, label);
        top += size + size / 2;
    }
}

/* What the values are, and their unit. */
static void write_title(const render_result *result, char title[64]) {
    const char *unit = burnish_mesh_get_info(result->mesh)->unit;
    const int is_length = strcmp(result->settings->input.coloring.by, "height") == 0 && unit;
    snprintf(title, 64, "%.40s%s%s", result->settings->input.coloring.by, is_length ? ", " : "",
             is_length ? unit : "");
}

void render_draw_legend(const render_result *result, burnish_image *image) {
    const uint8_t *background = result->options->background;
    static const uint8_t inks[2][3] = {{34, 36, 40}, {242, 243, 245}};
    const render_coloring *coloring = &result->settings->input.coloring;
    const int smaller = image->width < image->height ? image->width : image->height;
    const float text = smaller * TEXT > 9 ? (float)(int)(smaller * TEXT + 0.5) : 9;
    const int is_dark =
        !result->options->transparent && background[0] + background[1] + background[2] < 3 * 110;
    const uint8_t *ink = inks[is_dark];
    const double *range = result->color_range;
    char title[64], label[32];
    if (!render_has_legend(coloring) || smaller < 100) {
        return;
    }
    if (render_colors_by_part(coloring)) {
        draw_names(result, image, text, ink);
        return;
    }
    const int width = (int)text, inset = (int)(RENDER_LEGEND_INSET * smaller);
    const int needed = width + (int)label_room(range, text) + 2; /* more in small pictures */
    const int left = image->width - (needed > inset ? needed : inset);
    const int top = image->height / 4, height = image->height / 2;
    for (int y = 0; y < height; ++y) {
        uint8_t srgb[3];
        const int box[4] = {left, top + y, left + width, top + y + 1};
        burnish_color_map_get((burnish_color_map)coloring->map, 1 - y / (height - 1.0), srgb);
        fill_box(image, box, srgb);
    }
    for (int i = 0; i < TICKS; ++i) {
        const int y = top + (height - 1) * i / (TICKS - 1);
        const int box[4] = {left + width, y, left + width + width / 3, y + 1};
        write_label(range, i, label);
        fill_box(image, box, ink);
        burnish_image_draw_text(image, (float)(left + width + width / 2 + 2), (float)y + text / 2,
                                text, ink, label);
    }
    write_title(result, title);
    const float room = burnish_image_draw_text(NULL, 0, 0, text, ink, title) + text / 2;
    const float at =
        (float)image->width - room < (float)left ? (float)image->width - room : (float)left;
    burnish_image_draw_text(image, at, (float)top - text, text, ink, title);
}
