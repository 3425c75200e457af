/* Strokes: exact distances from pixel centres to segments, bands of rows side by side. */
#include "image/text/strokes.h"

#include <string.h>

#include "core/srgb.h"
#include "image/pixels.h"

enum {
    BAND = 16,              /* rows that are covered before they are blended */
    ENTRIES_MAX = 1 << 20,  /* of strokes in bands at a time, unless a single band has more */
    STROKES_GRAIN = 1 << 16 /* strokes between two checks for cancelling */
};

static const float most_radius = 1024;
static const float far_away = 32768; /* beyond it strokes are cut, so floats stay exact */
static const float too_far = 1e9F;   /* beyond it doubles could not cut them well */

/* ---- Coverage ---- */

/* floor(value) clamped to [0, most]; NaN gives 0. */
static int clamp_to_pixels(float value, int most) {
    if (!(value > 0)) {
        return 0;
    }
    return value < (float)most ? (int)value : most;
}

burnish_rectangle burnish_stroke_bounds(const burnish_stroke *stroke, int width, int height) {
    float reach = stroke->radius + 0.5F;
    float left = stroke->x0 < stroke->x1 ? stroke->x0 : stroke->x1;
    float right = stroke->x0 < stroke->x1 ? stroke->x1 : stroke->x0;
    float top = stroke->y0 < stroke->y1 ? stroke->y0 : stroke->y1;
    float bottom = stroke->y0 < stroke->y1 ? stroke->y1 : stroke->y0;
    return (burnish_rectangle){
        clamp_to_pixels(left - reach, width), clamp_to_pixels(top - reach, height),
        clamp_to_pixels(right + reach + 1, width), clamp_to_pixels(bottom + reach + 1, height)};
}

void burnish_stroke_cover(const burnish_stroke *stroke, int row, int first, int count,
                          float *coverage) {
    float ex = stroke->x1 - stroke->x0;
    float ey = stroke->y1 - stroke->y0;
    float length2 = ex * ex + ey * ey;
    float inverse = length2 > 0 ? 1 / length2 : 0;
    float py = (float)row + 0.5F - stroke->y0;
    float most = stroke->radius < 0.5F ? 2 * stroke->radius : 1;
    for (int i = 0; i < count; ++i) {
        float px = (float)(first + i) + 0.5F - stroke->x0;
        float t = (px * ex + py * ey) * inverse;
        t = t > 0 ? (t < 1 ? t : 1) : 0;
        float dx = px - t * ex;
        float dy = py - t * ey;
        /* -fno-math-errno: the instruction, never a call */
        float share = 0.5F + stroke->radius - __builtin_sqrtf(dx * dx + dy * dy);
        share = share < most ? share : most;
        coverage[i] = share > coverage[i] ? share : coverage[i];
    }
}

static float clamp_to_one(float value) {
    return value > 0 ? (value < 1 ? value : 1) : 0;
}

/* The columns of one row that a stroke can touch: only near the part of the segment within reach of
 * the row. Otherwise each row of a slanting line would take the whole width of the line. */
static void row_columns(const burnish_stroke *stroke, int row, int width, int *first, int *end) {
    const float reach = stroke->radius + 0.5F, slack = 1; /* pixels: more than all rounding */
    const float rise = stroke->y1 - stroke->y0, run = stroke->x1 - stroke->x0;
    const float y = (float)row + 0.5F - stroke->y0;
    float from = 0, to = 1;
    if (rise > 0.01F || rise < -0.01F) {
        const float a = clamp_to_one((y - reach) / rise), b = clamp_to_one((y + reach) / rise);
        from = a < b ? a : b;
        to = a < b ? b : a;
    }
    const float x0 = stroke->x0 + from * run, x1 = stroke->x0 + to * run;
    *first = clamp_to_pixels((x0 < x1 ? x0 : x1) - reach - slack, width);
    *end = clamp_to_pixels((x0 < x1 ? x1 : x0) + reach + slack + 1, width);
}

/* ---- Ink ---- */

burnish_ink burnish_ink_of(const uint8_t srgb[3], float opacity) {
    burnish_ink ink = {.opacity = opacity};
    for (int k = 0; k < 3; ++k) {
        ink.linear[k] = burnish_srgb_to_linear[srgb[k]];
    }
    return ink;
}

/* red: the byte that holds it, 0 or 2. */
static void blend_codes(uint8_t *pixel, int channels, int red, const float linear[3], float share) {
    if (channels == 4) {
        float alpha = (float)pixel[3] / 255.0F;
        float sum = share + alpha * (1 - share);
        share = share / sum;
        pixel[3] = (uint8_t)(sum * 255.0F + 0.5F);
    }
    float below = 1 - share;
    for (int k = 0; k < 3; ++k) {
        uint8_t *code = &pixel[red ? 2 - k : k];
        *code = burnish_linear_to_srgb(linear[k] * share + burnish_srgb_to_linear[*code] * below);
    }
}

static void blend_light(uint8_t *bytes, const float linear[3], float share) {
    float pixel[4];
    memcpy(pixel, bytes, sizeof pixel);
    const float sum = share + pixel[3] * (1 - share);
    share = share / sum;
    for (int k = 0; k < 3; ++k) {
        pixel[k] = linear[k] * share + pixel[k] * (1 - share);
    }
    pixel[3] = sum;
    memcpy(bytes, pixel, sizeof pixel);
}

void burnish_ink_blend(const burnish_pixels *pixels, int row, int first, int count,
                       const float *coverage, const burnish_ink *ink) {
    const int channels = (int)burnish_pixel_size(pixels->format); /* of 8 bits */
    const int is_light = pixels->format == BURNISH_PIXELS_RGBA_FLOAT;
    const int red = pixels->format == BURNISH_PIXELS_BGRA8 ? 2 : 0;
    const size_t size = is_light ? 4 * sizeof(float) : (size_t)channels;
    uint8_t *bytes = pixels->pixels + (size_t)row * pixels->stride + (size_t)first * size;
    for (int i = 0; i < count; ++i, bytes += size) {
        const float share = coverage[i] * ink->opacity;
        if (!(share > 0)) {
            continue;
        }
        if (is_light) {
            blend_light(bytes, ink->linear, share);
        } else {
            blend_codes(bytes, channels, red, ink->linear, share);
        }
    }
}

/* ---- Strokes far outside ---- */

int burnish_cut_to_range(double p, double d, double low, double high, double *from, double *to) {
    if (d == 0) {
        return p >= low && p <= high;
    }
    const double a = (low - p) / d, b = (high - p) / d;
    const double enter = a < b ? a : b, leave = a < b ? b : a;
    *from = enter > *from ? enter : *from;
    *to = leave < *to ? leave : *to;
    return *from <= *to;
}

static int is_within(const burnish_stroke *stroke, float limit) {
    return stroke->x0 >= -limit && stroke->x0 <= limit && stroke->y0 >= -limit &&
           stroke->y0 <= limit && stroke->x1 >= -limit && stroke->x1 <= limit &&
           stroke->y1 >= -limit && stroke->y1 <= limit;
}

/* Cuts off the parts of a stroke that are far outside the image, beyond what its round ends can
 * touch. Returns 0 if no pixel is touched. */
static int prepare_stroke(const burnish_stroke *stroke, int width, int height,
                          burnish_stroke *prepared) {
    *prepared = *stroke;
    if (is_within(stroke, far_away)) {
        return 1;
    }
    const double x = stroke->x0, y = stroke->y0;
    const double dx = stroke->x1 - x, dy = stroke->y1 - y, border = stroke->radius + 2;
    double from = 0, to = 1;
    if (!is_within(stroke, too_far) ||
        !burnish_cut_to_range(x, dx, -border, (double)width + border, &from, &to) ||
        !burnish_cut_to_range(y, dy, -border, (double)height + border, &from, &to)) {
        return 0;
    }
    prepared->x0 = (float)(x + from * dx);
    prepared->y0 = (float)(y + from * dy);
    prepared->x1 = (float)(x + to * dx);
    prepared->y1 = (float)(y + to * dy);
    return 1;
}

/* ---- Bands ---- */

typedef struct figure {
    const burnish_pixels *pixels;
    int first_row, end_row; /* of the picture, that pixels hold */
    int height;             /* of the picture */
    const burnish_stroke *strokes;
    size_t count;
    const burnish_ink *ink;
    int bands;         /* of the picture, down to the last one that is drawn */
    int first_band;    /* the first one in entries */
    size_t *ends;      /* one past each band's entries; before they are filled, their starts */
    uint32_t *entries; /* strokes of each band */
    float *coverage;   /* BAND rows for each thread */
    burnish_tasks *tasks;
} figure;

/* The bands with rows of the pixels that a stroke touches: [*first, *end). */
static void stroke_bands(const figure *f, size_t index, int *first, int *end) {
    burnish_stroke stroke;
    *first = *end = 0;
    if (prepare_stroke(&f->strokes[index], f->pixels->width, f->height, &stroke)) {
        const burnish_rectangle bounds =
            burnish_stroke_bounds(&stroke, f->pixels->width, f->height);
        const int top = bounds.top > f->first_row ? bounds.top : f->first_row;
        const int bottom = bounds.bottom < f->end_row ? bounds.bottom : f->end_row;
        if (bounds.left < bounds.right && top < bottom) {
            *first = top / BAND;
            *end = (bottom - 1) / BAND + 1;
        }
    }
}

static void cover_band(const figure *f, const burnish_stroke *stroke, int top, int rows,
                       float *coverage, int bounds[BAND][2]) {
    const int width = f->pixels->width;
    const burnish_rectangle touched = burnish_stroke_bounds(stroke, width, f->height);
    const int first_row = touched.top > top ? touched.top : top;
    const int end_row = touched.bottom < top + rows ? touched.bottom : top + rows;
    for (int row = first_row; row < end_row; ++row) {
        int first, end, *bound = bounds[row - top];
        row_columns(stroke, row, width, &first, &end);
        if (first < end) {
            burnish_stroke_cover(stroke, row, first, end - first,
                                 coverage + (size_t)(row - top) * (size_t)width + first);
            bound[0] = first < bound[0] ? first : bound[0];
            bound[1] = end > bound[1] ? end : bound[1];
        }
    }
}

static void draw_band(void *context, size_t index, int thread) {
    const figure *f = context;
    const int width = f->pixels->width, band = f->first_band + (int)index;
    const int top = band * BAND > f->first_row ? band * BAND : f->first_row;
    const int bottom = (band + 1) * BAND < f->end_row ? (band + 1) * BAND : f->end_row;
    const int rows = bottom - top;
    float *coverage = f->coverage + (size_t)thread * BAND * (size_t)width;
    const size_t end = f->ends[band];
    const size_t first = index > 0 ? f->ends[band - 1] : 0;
    int bounds[BAND][2];
    if (first == end) {
        return;
    }
    memset(coverage, 0, (size_t)rows * (size_t)width * sizeof *coverage);
    for (int i = 0; i < BAND; ++i) {
        bounds[i][0] = width;
        bounds[i][1] = 0;
    }
    for (size_t i = first; i < end; ++i) {
        burnish_stroke stroke;
        prepare_stroke(&f->strokes[f->entries[i]], width, f->height, &stroke);
        cover_band(f, &stroke, top, rows, coverage, bounds);
    }
    for (int row = 0; row < rows; ++row) {
        if (bounds[row][0] < bounds[row][1]) {
            burnish_ink_blend(f->pixels, top + row - f->first_row, bounds[row][0],
                              bounds[row][1] - bounds[row][0],
                              coverage + (size_t)row * (size_t)width + bounds[row][0], f->ink);
        }
    }
}

/* ends[i] becomes the number of strokes in band i. */
static void count_entries(void *context, size_t first, size_t end) {
    figure *f = context;
    for (size_t i = first; i < end; ++i) {
        int band, last;
        for (stroke_bands(f, i, &band, &last); band < last; ++band) {
            ++f->ends[band];
        }
    }
}

/* As many bands from first_band on as entries hold; returns the end. ends becomes starts. */
static int choose_bands(figure *f, size_t capacity) {
    size_t sum = 0;
    int band = f->first_band;
    for (; band < f->bands; ++band) {
        const size_t count = f->ends[band];
        if (sum + count > capacity) {
            break;
        }
        f->ends[band] = sum;
        sum += count;
    }
    return band;
}

typedef struct filling {
    figure *f;
    int end_band;
} filling;

static void fill_entries(void *context, size_t first, size_t end) {
    const filling *fill = context;
    figure *f = fill->f;
    for (size_t i = first; i < end; ++i) {
        int band, last;
        stroke_bands(f, i, &band, &last);
        band = band > f->first_band ? band : f->first_band;
        last = last < fill->end_band ? last : fill->end_band;
        for (; band < last; ++band) {
            f->entries[f->ends[band]++] = (uint32_t)i;
        }
    }
}

/* Entries for all bands, or for as many as the bound allows and at least the fullest one. */
static size_t entry_capacity(const figure *f) {
    size_t sum = 0, most = 0;
    for (int i = 0; i < f->bands; ++i) {
        sum += f->ends[i];
        most = f->ends[i] > most ? f->ends[i] : most;
    }
    return sum <= ENTRIES_MAX ? sum : most > ENTRIES_MAX ? most : ENTRIES_MAX;
}

static burnish_status draw_figure(figure *f, burnish_memory *memory) {
    const size_t threads = (size_t)burnish_tasks_threads(f->tasks);
    const size_t used = threads < (size_t)f->bands ? threads : (size_t)f->bands;
    burnish_tasks_in_order(f->tasks, f->count, STROKES_GRAIN, count_entries, f);
    const size_t capacity = entry_capacity(f);
    f->entries = burnish_allocate(memory, capacity, sizeof *f->entries, "strokes of bands");
    f->coverage = burnish_allocate(memory, used * BAND * (size_t)f->pixels->width,
                                   sizeof *f->coverage, "coverage of strokes");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    while (f->first_band < f->bands && capacity > 0) {
        const int end = choose_bands(f, capacity);
        filling fill = {f, end};
        burnish_tasks_in_order(f->tasks, f->count, STROKES_GRAIN, fill_entries, &fill);
        burnish_tasks_run(f->tasks, (size_t)(end - f->first_band), 1, (int)used, draw_band, f);
        if (burnish_tasks_cancelled(f->tasks)) {
            break;
        }
        f->first_band = end;
    }
    return burnish_tasks_check(f->tasks, memory->error);
}

static burnish_status check_strokes(const burnish_pixels *pixels, const burnish_stroke *strokes,
                                    size_t count, burnish_error *error) {
    if (!pixels->pixels || pixels->width < 1 || pixels->width > BURNISH_IMAGE_MAX_SIZE ||
        pixels->height < 1 || pixels->height > BURNISH_IMAGE_MAX_SIZE ||
        (unsigned)pixels->format > BURNISH_PIXELS_RGBA_FLOAT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "strokes: pixels of a known format and of 1 to %d a side are expected",
                            BURNISH_IMAGE_MAX_SIZE);
    }
    if ((uint64_t)count > UINT32_MAX) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT, "strokes: more than 2^32 - 1");
    }
    for (size_t i = 0; i < count; ++i) {
        if (!(strokes[i].radius > 0 && strokes[i].radius <= most_radius)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "strokes: a radius of %g pixels is not in (0, %g]",
                                (double)strokes[i].radius, (double)most_radius);
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_strokes_draw(const burnish_pixels *pixels, const burnish_stroke *strokes,
                                    size_t count, const burnish_ink *ink, burnish_tasks *tasks,
                                    burnish_memory *memory) {
    const burnish_pixel_rows rows = {pixels, 0, pixels->height};
    return burnish_strokes_draw_rows(&rows, strokes, count, ink, tasks, memory);
}

burnish_status burnish_strokes_draw_rows(const burnish_pixel_rows *rows,
                                         const burnish_stroke *strokes, size_t count,
                                         const burnish_ink *ink, burnish_tasks *tasks,
                                         burnish_memory *memory) {
    const burnish_pixels *pixels = rows->pixels;
    burnish_status status = check_strokes(pixels, strokes, count, memory->error);
    if (status != BURNISH_STATUS_OK || count == 0) {
        return status;
    }
    const int first_row = rows->first_row;
    figure f = {.pixels = pixels,
                .first_row = first_row,
                .end_row = first_row + pixels->height,
                .height = rows->height,
                .strokes = strokes,
                .count = count,
                .ink = ink,
                .bands = (first_row + pixels->height + BAND - 1) / BAND,
                .first_band = first_row / BAND,
                .tasks = tasks};
    f.ends = burnish_allocate_zeroed(memory, (size_t)f.bands, sizeof *f.ends, "bands of strokes");
    status = f.ends ? draw_figure(&f, memory) : memory->status;
    burnish_release(memory->context, f.coverage);
    burnish_release(memory->context, f.entries);
    burnish_release(memory->context, f.ends);
    return status;
}
