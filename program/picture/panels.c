#include "picture/panels.h"
#include "burnish/sheet.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/cli/file.h"
#include "base/cli/options.h"
#include "picture/difference.h"

enum {
    LEAST_WIDTH = 320, /* pixels: narrower pictures are enlarged */
    LEAST_TEXT = 8,    /* height of capitals, pixels */
    MOST_TEXT = 24,
    PANELS = 3,
    LINE_SIZE = 160
};

typedef struct layout {
    int factor;        /* of enlargement */
    int width, height; /* of a panel */
    int across;        /* 1: side by side */
    int gap, band;     /* between panels; below each, for its label */
    int foot;          /* below all */
    float text;        /* height of capitals */
    int total[2];
} layout;

static const uint8_t ink[3] = {47, 54, 63};

static burnish_status lay_out(const burnish_image *picture, layout *l, burnish_error *error) {
    l->factor = (LEAST_WIDTH + picture->width - 1) / picture->width;
    while (l->factor > 1 && l->factor * picture->height > 4 * LEAST_WIDTH) {
        --l->factor;
    }
    l->width = l->factor * picture->width;
    l->height = l->factor * picture->height;
    const int text = l->width / 40;
    l->text = (float)(text < LEAST_TEXT ? LEAST_TEXT : text > MOST_TEXT ? MOST_TEXT : text);
    l->gap = 2 * (int)l->text;
    l->band = (int)(2.4F * l->text);
    l->foot = (int)(5.2F * l->text);
    for (l->across = 1; l->across >= 0; --l->across) {
        const int columns = l->across ? PANELS : 1, rows = PANELS / columns;
        l->total[0] = columns * (l->width + l->gap) + l->gap;
        l->total[1] = rows * (l->height + l->band + l->gap) + l->foot;
        if (l->total[0] <= BURNISH_IMAGE_MAX_SIZE && l->total[1] <= BURNISH_IMAGE_MAX_SIZE) {
            return BURNISH_STATUS_OK;
        }
    }
    return cli_fail(
        error, BURNISH_STATUS_LIMIT,
        "--output: three panels of %d x %d pixels exceed %d pixels; leave the picture out",
        picture->width, picture->height, BURNISH_IMAGE_MAX_SIZE);
}

static void corner_of(const layout *l, int panel, int *x, int *y) {
    *x = l->gap + (l->across ? panel * (l->width + l->gap) : 0);
    *y = l->gap + (l->across ? 0 : panel * (l->height + l->band + l->gap));
}

static uint8_t *pixel_at(burnish_image *image, int x, int y) {
    return image->pixels + 3 * ((size_t)y * (size_t)image->width + (size_t)x);
}

/* Enlarges a picture and blends it with white. */
static void place_panel(const layout *l, const burnish_image *picture, int panel,
                        burnish_image *made) {
    int left, top;
    corner_of(l, panel, &left, &top);
    for (int y = 0; y < l->height; ++y) {
        const uint8_t *row = picture->pixels + (size_t)(y / l->factor) * (size_t)picture->width *
                                                   (size_t)picture->channels;
        uint8_t *to = pixel_at(made, left, top + y);
        for (int x = 0; x < l->width; ++x, to += 3) {
            const uint8_t *from = row + (size_t)(x / l->factor) * (size_t)picture->channels;
            const int alpha = picture->channels == 4 ? from[3] : 255;
            for (int k = 0; k < 3; ++k) {
                to[k] = (uint8_t)((alpha * from[k] + (255 - alpha) * 255 + 127) / 255);
            }
        }
    }
}

/* Frames the pixels that differ, unless they fill the picture. */
static void frame_difference(const layout *l, const burnish_image *picture, const int box[4],
                             burnish_image *made) {
    int left, top;
    if (box[2] == 0 || (box[2] - box[0] == picture->width && box[3] - box[1] == picture->height)) {
        return;
    }
    corner_of(l, PANELS - 1, &left, &top);
    const int x0 = left + box[0] * l->factor, x1 = left + box[2] * l->factor - 1;
    const int y0 = top + box[1] * l->factor, y1 = top + box[3] * l->factor - 1;
    for (int x = x0; x <= x1; ++x) {
        memcpy(pixel_at(made, x, y0), ink, 3);
        memcpy(pixel_at(made, x, y1), ink, 3);
    }
    for (int y = y0; y <= y1; ++y) {
        memcpy(pixel_at(made, x0, y), ink, 3);
        memcpy(pixel_at(made, x1, y), ink, 3);
    }
}

/* Draws one line as large as the width allows, and truncates it if it does not fit. */
static void write_line(burnish_image *made, int left, float y, float height, int width,
                       const char *text) {
    char shown[LINE_SIZE];
    snprintf(shown, sizeof shown, "%s", text);
    size_t length = strlen(shown);
    while (height > LEAST_TEXT &&
           burnish_image_draw_text(NULL, 0, 0, height, ink, shown) > (float)width) {
        height -= 1;
    }
    while (length > 3 && burnish_image_draw_text(NULL, 0, 0, height, ink, shown) > (float)width) {
        snprintf(shown + --length - 3, 4, "...");
    }
    burnish_image_draw_text(made, (float)left, y, height, ink, shown);
}

/* The end of the scale: a round number not below any difference. */
static double choose_end(const burnish_comparison *numbers) {
    static const int ends[] = {8, 16, 32, 64, 128, 256};
    int largest = 0;
    size_t i = 0;
    for (int k = 0; k < 3; ++k) {
        largest = numbers->largest[k] > largest ? numbers->largest[k] : largest;
    }
    while (ends[i] < largest) {
        ++i;
    }
    return ends[i];
}

static burnish_status map_flip(const picture_panels *panels, burnish_image *map,
                               burnish_error *error) {
    const burnish_image *like = panels->pictures[0];
    const burnish_status status =
        burnish_image_create(NULL, map, like->width, like->height, 3, error);
    const size_t pixels = (size_t)like->width * (size_t)like->height;
    for (size_t i = 0; i < pixels && status == BURNISH_STATUS_OK; ++i) {
        picture_difference_color((double)panels->flip_map[i], 1, map->pixels + 3 * i);
    }
    return status;
}

static void write_numbers(const layout *l, const burnish_comparison *n, float y,
                          burnish_image *made) {
    char lines[2][LINE_SIZE], ssim[32] = "", iou[32] = "";
    const int width = l->across ? 2 * l->width : l->width;
    const int most = n->largest[0] > n->largest[1] ? n->largest[0] : n->largest[1];
    if (isfinite(n->ssim)) {
        snprintf(ssim, sizeof ssim, ", SSIM %.4f", n->ssim);
    }
    if (isfinite(n->silhouette_iou)) {
        snprintf(iou, sizeof iou, ", silhouettes' IoU %.4f", n->silhouette_iou);
    }
    snprintf(lines[0], LINE_SIZE,
             "%.3g %% of the pixels differ, by %d of 255 at most, by %.3g on average",
             100 * (double)n->different_pixels / (double)n->pixels,
             most > n->largest[2] ? most : n->largest[2],
             (n->mean[0] + n->mean[1] + n->mean[2]) / 3);
    if (isfinite(n->psnr)) {
        snprintf(lines[1], LINE_SIZE, "PSNR %.2f dB%s, FLIP %.4f%s", n->psnr, ssim, n->flip, iou);
    } else {
        snprintf(lines[1], LINE_SIZE, "the pictures are the same");
    }
    write_line(made, l->gap, y + l->text * 1.4F, l->text, width, lines[0]);
    write_line(made, l->gap, y + l->text * 3.4F, l->text, width, lines[1]);
}

/* Draws labels, numbers and the scale, which is below the difference. */
static void annotate_panels(const layout *l, const picture_panels *panels, double end,
                            burnish_image *made) {
    const char *labels[PANELS] = {
        panels->labels[0], panels->labels[1],
        panels->flip_map ? "FLIP" : "B - A, 8-bit values of the channel that differs most"};
    static const char *const letters[PANELS] = {"A: ", "B: ", ""};
    int x, y;
    for (int i = 0; i < PANELS; ++i) {
        char text[LINE_SIZE];
        corner_of(l, i, &x, &y);
        snprintf(text, sizeof text, "%s%s", letters[i], labels[i]);
        write_line(made, x, (float)(y + l->height) + 1.8F * l->text, l->text, l->width, text);
    }
    const int foot = y + l->height + l->band, thickness = (int)(1.4F * l->text);
    const int inset = (int)(1.5F * l->text); /* half of the outermost numbers */
    const int bar = l->across ? l->width - 2 * inset : l->width / 3;
    const int box[4] = {x + l->width - inset - bar, foot + (int)(0.3F * l->text), bar, thickness};
    picture_draw_scale(made, box, l->text, panels->flip_map ? 0 : -end, end);
    write_numbers(l, panels->numbers, (float)foot, made);
}

static burnish_status compose_panels(const picture_panels *panels, burnish_image *made,
                                     burnish_error *error) {
    layout l;
    burnish_image difference = {0};
    const double end = panels->flip_map ? 1 : choose_end(panels->numbers);
    *made = (burnish_image){0};
    burnish_status status = lay_out(panels->pictures[0], &l, error);
    if (status == BURNISH_STATUS_OK) {
        status = panels->flip_map ? map_flip(panels, &difference, error)
                                  : picture_subtract(panels->pictures[0], panels->pictures[1], end,
                                                     &difference, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_image_create(NULL, made, l.total[0], l.total[1], 3, error);
    }
    if (status == BURNISH_STATUS_OK) {
        memset(made->pixels, 255, 3 * (size_t)made->width * (size_t)made->height);
        place_panel(&l, panels->pictures[0], 0, made);
        place_panel(&l, panels->pictures[1], 1, made);
        place_panel(&l, &difference, 2, made);
        frame_difference(&l, panels->pictures[0], panels->numbers->bounds, made);
        annotate_panels(&l, panels, end, made);
    }
    burnish_image_destroy(&difference);
    return status;
}

burnish_status picture_write_panels(const picture_panels *panels, const char *path,
                                    picture_format format, const picture_options *options,
                                    burnish_error *error) {
    burnish_image image;
    picture_file file = {0};
    burnish_status status = compose_panels(panels, &image, error);
    if (status == BURNISH_STATUS_OK) {
        const burnish_pixels pixels = burnish_image_get_pixels(&image);
        status = picture_encode(format, &pixels, options, &file, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = cli_file_write(path, file.bytes, file.size, error);
    }
    picture_release(&file);
    burnish_image_destroy(&image);
    return status;
}
