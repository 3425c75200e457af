/* Compares two images: differences of 8-bit values, silhouettes, and bands shared by threads. */
#include "burnish/compare.h"
#include "image/compare.h"

#include <math.h>
#include <stdlib.h>

#include "base/elementary.h"
#include "base/layout.h"
#include "base/memory.h"
#include "core/float_mode.h"
#include "core/tasks.h"

#define COOKIE BURNISH_COOKIE(0x636d7031, burnish_compare_options)

enum {
    BAND_ROWS = 64,
    MOST_SCRATCH = 128 << 20, /* bytes, which limits the number of threads */
    OBJECT_DIFFERENCE = 4     /* 8-bit steps: pixels that differ more show the object */
};

/* The sums of a band. */
typedef struct band_sums {
    int largest[4], bounds[4]; /* bounds: x0, y0, x1, y1; x1 0: empty */
    uint64_t sums[4], squares; /* squares: of R, G, B */
    uint64_t different;
    uint64_t overlap, unions;
    double ssim, flip;
} band_sums;

/* The colour that means "no object" in an image without coverage. */
typedef struct silhouette {
    const uint8_t *coverage;
    int by_alpha, known;
    uint8_t background[3];
} silhouette;

typedef struct comparer {
    burnish_tasks tasks;
    const burnish_compare_options *options;
    burnish_picture_pair pair;
    silhouette silhouettes[2];
    burnish_ssim ssim;
    burnish_flip flip;
    int band_count;
    band_sums *bands;
    size_t scratch_size; /* per thread */
    uint8_t *scratch;
} comparer;

void burnish_compare_options_init(burnish_compare_options *options, uint64_t layout) {
    const burnish_compare_options defaults = {
        .cookie = COOKIE, .metrics = BURNISH_METRICS_ALL, .background = {255, 255, 255}};
    burnish_layout_init(options, layout, BURNISH_LAYOUT(burnish_compare_options), &defaults);
}

/* ---- Rows ---- */

/* (a c + (255 - a) b) / 255, rounded. */
static uint8_t blend_over(int code, int alpha, int background) {
    return (uint8_t)((alpha * code + (255 - alpha) * background + 127) / 255);
}

void burnish_pair_row(const burnish_picture_pair *pair, int which, int y, uint8_t *rgb) {
    const burnish_pixels *picture = pair->pictures[which];
    const uint8_t *from = picture->pixels + picture->stride * (size_t)y, *b = pair->background;
    const int red = picture->format == BURNISH_PIXELS_BGRA8 ? 2 : 0;
    const int step = (int)burnish_pixel_size(picture->format);
    for (int x = 0; x < pair->width; ++x, from += step, rgb += 3) {
        const int alpha = step == 4 ? from[3] : 255;
        rgb[0] = blend_over(from[red], alpha, b[0]);
        rgb[1] = blend_over(from[1], alpha, b[1]);
        rgb[2] = blend_over(from[2 - red], alpha, b[2]);
    }
}

/* ---- 8-bit values ---- */

/* Adds the difference of one channel; returns its size. */
static int add_channel(band_sums *sums, int channel, int a, int b) {
    const int size = abs(a - b);
    sums->largest[channel] = size > sums->largest[channel] ? size : sums->largest[channel];
    sums->sums[channel] += (unsigned)size;
    return size;
}

static void widen_bounds(int bounds[4], int x, int y) {
    if (bounds[2] == 0) {
        bounds[0] = x;
        bounds[1] = y;
    }
    bounds[0] = x < bounds[0] ? x : bounds[0];
    bounds[2] = x >= bounds[2] ? x + 1 : bounds[2];
    bounds[3] = y + 1;
}

static void add_codes(const comparer *c, int y, const uint8_t *a, const uint8_t *b,
                      band_sums *sums) {
    for (int x = 0; x < c->pair.width; ++x, a += 3, b += 3) {
        int largest = add_channel(sums, 3, burnish_pixels_alpha(c->pair.pictures[0], x, y),
                                  burnish_pixels_alpha(c->pair.pictures[1], x, y));
        for (int k = 0; k < 3; ++k) {
            const int size = add_channel(sums, k, a[k], b[k]);
            sums->squares += (unsigned)(size * size);
            largest = size > largest ? size : largest;
        }
        if (largest > c->options->tolerance) {
            ++sums->different;
            widen_bounds(sums->bounds, x, y);
        }
    }
}

/* ---- Silhouettes ---- */

/* From colours only: whether a pixel shows any of the object. */
static int is_soft(const silhouette *s) {
    return s->coverage || s->by_alpha;
}

static int is_covered(const comparer *c, int which, int x, int y, const uint8_t *rgb) {
    const silhouette *s = &c->silhouettes[which];
    if (s->coverage) {
        return s->coverage[(size_t)y * (size_t)c->pair.width + (size_t)x];
    }
    if (s->by_alpha) {
        return burnish_pixels_alpha(c->pair.pictures[which], x, y);
    }
    int object = 0;
    for (int k = 0; k < 3; ++k) {
        object |= abs(rgb[k] - s->background[k]) > OBJECT_DIFFERENCE;
    }
    return object ? 255 : 0;
}

static void add_silhouettes(const comparer *c, int y, const uint8_t *a, const uint8_t *b,
                            band_sums *sums) {
    const int soft = is_soft(&c->silhouettes[0]) && is_soft(&c->silhouettes[1]);
    for (int x = 0; x < c->pair.width; ++x, a += 3, b += 3) {
        const int of_a = is_covered(c, 0, x, y, a), of_b = is_covered(c, 1, x, y, b);
        const int in_a = soft ? of_a : 255 * (of_a > 0), in_b = soft ? of_b : 255 * (of_b > 0);
        sums->overlap += (unsigned)(in_a < in_b ? in_a : in_b);
        sums->unions += (unsigned)(in_a < in_b ? in_b : in_a);
    }
}

/* Coverage if given, else alpha, else the difference from the colour of all four corners. */
static silhouette find_silhouette(const comparer *c, int which) {
    const burnish_pixels *picture = c->pair.pictures[which];
    silhouette found = {.coverage = c->options->coverage[which]};
    const int right = picture->width - 1, bottom = picture->height - 1;
    const int corners[4][2] = {{0, 0}, {right, 0}, {0, bottom}, {right, bottom}};
    const int red = picture->format == BURNISH_PIXELS_BGRA8 ? 2 : 0;
    found.known = 1;
    found.by_alpha = picture->format != BURNISH_PIXELS_RGB8;
    for (int i = 0; i < 4 && !found.by_alpha; ++i) {
        const uint8_t *corner =
            picture->pixels + picture->stride * (size_t)corners[i][1] + 3 * (size_t)corners[i][0];
        for (int k = 0; k < 3; ++k) {
            const uint8_t code = corner[k == 1 ? 1 : k ^ red];
            found.known &= i == 0 || code == found.background[k];
            found.background[k] = code;
        }
    }
    found.known |= found.coverage != NULL;
    return found;
}

/* ---- Bands ---- */

static int knows_silhouettes(const comparer *c) {
    return c->silhouettes[0].known && c->silhouettes[1].known;
}

static void compare_codes(const comparer *c, burnish_band band, uint8_t *scratch, band_sums *sums) {
    uint8_t *a = scratch, *b = scratch + 3 * (size_t)c->pair.width;
    for (int y = band.first; y < band.end; ++y) {
        burnish_pair_row(&c->pair, 0, y, a);
        burnish_pair_row(&c->pair, 1, y, b);
        add_codes(c, y, a, b, sums);
        if (knows_silhouettes(c)) {
            add_silhouettes(c, y, a, b, sums);
        }
    }
}

static void compare_band(void *context, size_t index, int thread) {
    const comparer *c = context;
    const burnish_float_mode before = burnish_float_mode_enter();
    const int first = BAND_ROWS * (int)index, rest = c->pair.height - first;
    const burnish_band band = {first, first + (rest < BAND_ROWS ? rest : BAND_ROWS)};
    uint8_t *scratch = c->scratch + c->scratch_size * (size_t)thread;
    band_sums *sums = &c->bands[index];
    compare_codes(c, band, scratch, sums);
    if (c->options->metrics & BURNISH_METRIC_SSIM) {
        sums->ssim = burnish_ssim_band(&c->ssim, &c->pair, band, scratch);
    }
    if (c->options->metrics & BURNISH_METRIC_FLIP) {
        sums->flip = burnish_flip_band(&c->flip, &c->pair, band, scratch, c->options->flip_map);
    }
    burnish_float_mode_leave(before);
}

static void add_band(band_sums *all, const band_sums *band) {
    for (int k = 0; k < 4; ++k) {
        all->largest[k] = band->largest[k] > all->largest[k] ? band->largest[k] : all->largest[k];
        all->sums[k] += band->sums[k];
    }
    all->squares += band->squares;
    all->different += band->different;
    all->overlap += band->overlap;
    all->unions += band->unions;
    all->ssim += band->ssim;
    all->flip += band->flip;
    if (band->different > 0) {
        widen_bounds(all->bounds, band->bounds[0], band->bounds[1]);
        widen_bounds(all->bounds, band->bounds[2] - 1, band->bounds[3] - 1);
    }
}

static double ten_log10(double x) {
    return 10 * (burnish_log(x) / 2.30258509299404568402);
}

static void conclude_comparison(const comparer *c, burnish_comparison *found) {
    band_sums all = {0};
    for (int i = 0; i < c->band_count; ++i) {
        add_band(&all, &c->bands[i]);
    }
    const int width = c->pair.width, height = c->pair.height;
    const double pixels = (double)width * height;
    const double windows =
        (double)(width - BURNISH_SSIM_TAPS + 1) * (height - BURNISH_SSIM_TAPS + 1);
    found->pixels = (uint64_t)width * (uint64_t)height;
    found->different_pixels = all.different;
    for (int k = 0; k < 4; ++k) {
        found->largest[k] = all.largest[k];
        found->mean[k] = (double)all.sums[k] / pixels;
        found->bounds[k] = all.bounds[k];
    }
    found->mean_squared_error = (double)all.squares / (3 * pixels);
    found->psnr = all.squares > 0 ? ten_log10(255.0 * 255.0 / found->mean_squared_error) : INFINITY;
    found->ssim = NAN;
    found->flip = NAN;
    found->silhouette_iou =
        knows_silhouettes(c) && all.unions > 0 ? (double)all.overlap / (double)all.unions : NAN;
    if ((c->options->metrics & BURNISH_METRIC_SSIM) && width >= BURNISH_SSIM_TAPS &&
        height >= BURNISH_SSIM_TAPS) {
        found->ssim = all.squares > 0 ? all.ssim / windows : 1;
    }
    if (c->options->metrics & BURNISH_METRIC_FLIP) {
        found->flip = all.flip / pixels;
    }
}

static size_t larger_size(size_t a, size_t b) {
    return a > b ? a : b;
}

static burnish_status run_comparison(comparer *c, burnish_comparison *found, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(c->options->context, error);
    int threads = burnish_tasks_threads(&c->tasks);
    c->band_count = (c->pair.height + BAND_ROWS - 1) / BAND_ROWS;
    c->scratch_size =
        larger_size(6 * (size_t)c->pair.width, larger_size(burnish_ssim_scratch(c->pair.width),
                                                           burnish_flip_scratch(c->pair.width)));
    c->scratch_size =
        (c->scratch_size + BURNISH_ALIGNMENT - 1) / BURNISH_ALIGNMENT * BURNISH_ALIGNMENT;
    const size_t most = MOST_SCRATCH / c->scratch_size + 1;
    threads = threads < c->band_count ? threads : c->band_count;
    threads = (size_t)threads < most ? threads : (int)most;
    c->bands = burnish_allocate_zeroed(&memory, (size_t)c->band_count, sizeof *c->bands,
                                       "the comparison's bands");
    c->scratch =
        burnish_allocate(&memory, (size_t)threads, c->scratch_size, "the comparison's rows");
    burnish_status status = memory.status;
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_run(&c->tasks, (size_t)c->band_count, 1, threads, compare_band, c);
        status = burnish_tasks_check(&c->tasks, error);
    }
    if (status == BURNISH_STATUS_OK) {
        conclude_comparison(c, found);
    }
    burnish_release(c->options->context, c->bands);
    burnish_release(c->options->context, c->scratch);
    return status;
}

static burnish_status check_compare(const burnish_pixels *a, const burnish_pixels *b,
                                    const burnish_compare_options *options, burnish_error *error) {
    burnish_status status =
        burnish_layout_check(options, COOKIE, "compare options", "compare_options", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (options->threads < 0 || options->threads > BURNISH_THREADS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "compare options: %d threads; expected 0 to %d", options->threads,
                            BURNISH_THREADS_MAX);
    }
    if (options->tolerance < 0 || options->tolerance > 255) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "compare options: a tolerance of %d; expected 0 to 255 codes",
                            options->tolerance);
    }
    status = burnish_pixels_check(a, "compare: first picture", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_pixels_check(b, "compare: second picture", error);
    }
    if (status == BURNISH_STATUS_OK &&
        (a->format > BURNISH_PIXELS_BGRA8 || b->format > BURNISH_PIXELS_BGRA8)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "compare: pictures of 16 bits; RGB8, RGBA8 and BGRA8 are compared");
    }
    if (status == BURNISH_STATUS_OK && (a->width != b->width || a->height != b->height)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "compare: %d x %d and %d x %d pixels; pictures of one size are compared", a->width,
            a->height, b->width, b->height);
    }
    return status;
}

burnish_status burnish_pixels_compare(const burnish_pixels *a, const burnish_pixels *b,
                                      const burnish_compare_options *options,
                                      burnish_comparison *comparison, burnish_error *error) {
    const burnish_compare_options usual = burnish_compare_options_default();
    comparer c = {.options = options ? options : &usual, .pair = {.pictures = {a, b}}};
    *comparison = (burnish_comparison){0};
    const burnish_status status = check_compare(a, b, c.options, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_float_mode before = burnish_float_mode_enter();
    c.pair.width = a->width;
    c.pair.height = a->height;
    for (int i = 0; i < 2; ++i) {
        c.pair.background[i] = c.options->background[i];
        c.silhouettes[i] = find_silhouette(&c, i);
    }
    c.pair.background[2] = c.options->background[2];
    c.ssim = burnish_ssim_make();
    c.flip = burnish_flip_make();
    burnish_tasks_begin(&c.tasks, c.options->context, c.options->threads);
    const burnish_status ran = run_comparison(&c, comparison, error);
    burnish_float_mode_leave(before);
    return ran;
}
