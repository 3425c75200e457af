/* A palette for all frames: boxes of colours are cut where that takes most of the error away, then
 * each colour moves to the middle of what is nearest to it (k-means). */
#include "picture/palette.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum {
    CODES = 1 << 24,
    ROUNDS = 6 /* of k-means; after them next to nothing moves */
};

enum { CODES_PER_PAGE = 256 };
struct picture_histogram {
    uint32_t *pages[CODES / CODES_PER_PAGE]; /* counts; NULL: none of its colours occurs */
};

/* A colour that occurs. */
typedef struct entry {
    uint8_t color[3];
    uint32_t weight;
} entry;

/* Entries first .. end - 1 and how far they lie from their middle. */
typedef struct box {
    size_t first, end;
    uint64_t error;
} box;

picture_histogram *picture_histogram_create(void) {
    return calloc(1, sizeof(picture_histogram));
}

void picture_histogram_destroy(picture_histogram *histogram) {
    for (size_t i = 0; histogram && i < CODES / CODES_PER_PAGE; ++i) {
        free(histogram->pages[i]);
    }
    free(histogram);
}

/* The counter of a colour; NULL without memory. */
static uint32_t *find_counter(picture_histogram *histogram, const uint8_t color[3]) {
    uint32_t **counts = &histogram->pages[color[0] << 8 | color[1]];
    if (!*counts) {
        *counts = calloc(CODES_PER_PAGE, sizeof **counts);
    }
    return *counts ? *counts + color[2] : NULL;
}

int picture_histogram_add(picture_histogram *histogram, const burnish_image *image) {
    const size_t channels = (size_t)image->channels;
    const uint8_t *pixel = image->pixels;
    size_t left = (size_t)image->width * (size_t)image->height;
    while (left > 0) {
        const size_t run = picture_run(pixel, left, channels);
        if (channels == 3 || pixel[3] >= 128) {
            uint32_t *counter = find_counter(histogram, pixel);
            if (!counter) {
                return 0;
            }
            *counter = run > UINT32_MAX - *counter ? UINT32_MAX : *counter + (uint32_t)run;
        }
        pixel += run * channels;
        left -= run;
    }
    return 1;
}

/* Square root, rounded down: a large flat part shall not take all colours from a small one. */
static uint32_t integer_root(uint32_t value) {
    uint32_t result = 0;
    for (uint32_t bit = 1U << 15; bit > 0; bit >>= 1) {
        const uint32_t next = result | bit;
        result = (uint64_t)next * next <= value ? next : result;
    }
    return result;
}

static entry *list_entries(const picture_histogram *histogram, size_t *count) {
    size_t most = 1;
    for (size_t i = 0; i < CODES / CODES_PER_PAGE; ++i) {
        most += histogram->pages[i] ? CODES_PER_PAGE : 0;
    }
    entry *entries = malloc(most * sizeof *entries);
    *count = 0;
    for (uint32_t code = 0; code < CODES && entries; ++code) {
        const uint32_t *counts = histogram->pages[code / CODES_PER_PAGE];
        if (!counts) {
            code += CODES_PER_PAGE - 1;
        } else if (counts[code % CODES_PER_PAGE] > 0) {
            entries[(*count)++] =
                (entry){{(uint8_t)(code >> 16), (uint8_t)(code >> 8), (uint8_t)code},
                        integer_root(counts[code % CODES_PER_PAGE])};
        }
    }
    return entries;
}

/* ---- Boxes ---- */

/* Weighted sums of a run of entries, at most 2^24 of weight 2^16 and values 2^16: below 2^56. */
typedef struct sums {
    uint64_t weight, first[3], second[3];
} sums;

static void add_entry(sums *s, const entry *e) {
    s->weight += e->weight;
    for (int k = 0; k < 3; ++k) {
        s->first[k] += (uint64_t)e->weight * e->color[k];
        s->second[k] += (uint64_t)e->weight * e->color[k] * e->color[k];
    }
}

/* Sum of w (x - mean)^2 = S2 - S1^2 / W along an axis. Split so that nothing overflows: with
 * S1 = q W + r, S1^2 / W = q S1 + q r + r^2 / W, where r^2 / W < W is below 2^40. */
static uint64_t squared_error(const sums *s, int axis) {
    if (s->weight == 0) {
        return 0;
    }
    const uint64_t q = s->first[axis] / s->weight, r = s->first[axis] % s->weight;
    const uint64_t mean = q * s->first[axis] + q * r + (r < (1ULL << 32) ? r * r / s->weight : r);
    return s->second[axis] > mean ? s->second[axis] - mean : 0;
}

static const uint64_t axis_weights[3] = {3, 4, 2}; /* of picture_distance */

static uint64_t error_of(const sums *s) {
    uint64_t error = 0;
    for (int k = 0; k < 3; ++k) {
        error += axis_weights[k] * squared_error(s, k);
    }
    return error;
}

static void sum_range(const entry *entries, size_t first, size_t end, sums *s) {
    memset(s, 0, sizeof *s);
    for (size_t i = first; i < end; ++i) {
        add_entry(s, &entries[i]);
    }
}

/* Colours differ, so that every library sorts them in one way. */
#define COMPARE(name, a, b, c)                                                                     \
    static int name(const void *left, const void *right) {                                         \
        const uint8_t *x = ((const entry *)left)->color, *y = ((const entry *)right)->color;       \
        return x[a] != y[a] ? x[a] - y[a] : x[b] != y[b] ? x[b] - y[b] : x[c] - y[c];              \
    }
COMPARE(compare_red, 0, 1, 2)
COMPARE(compare_green, 1, 0, 2)
COMPARE(compare_blue, 2, 1, 0)

/* Cuts a box of several entries in two where the sum of both errors is least, along the axis of the
 * largest spread; the second part becomes *other. */
static void cut_box(entry *entries, box *whole, box *other) {
    static int (*const compare[3])(const void *, const void *) = {compare_red, compare_green,
                                                                  compare_blue};
    sums all, left = {0};
    int axis = 0;
    sum_range(entries, whole->first, whole->end, &all);
    for (int k = 1; k < 3; ++k) {
        axis = axis_weights[k] * squared_error(&all, k) >
                       axis_weights[axis] * squared_error(&all, axis)
                   ? k
                   : axis;
    }
    qsort(entries + whole->first, whole->end - whole->first, sizeof *entries, compare[axis]);
    uint64_t least = UINT64_MAX;
    box parts[2] = {*whole, *whole};
    for (size_t i = whole->first; i + 1 < whole->end; ++i) {
        sums right = all;
        add_entry(&left, &entries[i]);
        right.weight -= left.weight;
        for (int k = 0; k < 3; ++k) {
            right.first[k] -= left.first[k];
            right.second[k] -= left.second[k];
        }
        const uint64_t a = error_of(&left), b = error_of(&right);
        if (a + b < least) {
            least = a + b;
            parts[0] = (box){whole->first, i + 1, a};
            parts[1] = (box){i + 1, whole->end, b};
        }
    }
    *whole = parts[0];
    *other = parts[1];
}

/* The middle of a run of entries. */
static void mean_color(const sums *s, uint8_t color[3]) {
    for (int k = 0; k < 3 && s->weight > 0; ++k) {
        color[k] = (uint8_t)((s->first[k] + s->weight / 2) / s->weight);
    }
}

static void cut_boxes(entry *entries, size_t count, int first, picture_palette *palette) {
    box boxes[PICTURE_PALETTE_MAX];
    sums s;
    int used = 1;
    sum_range(entries, 0, count, &s);
    boxes[0] = (box){0, count, error_of(&s)};
    while (used < PICTURE_PALETTE_MAX - first) {
        int worst = 0;
        for (int i = 1; i < used; ++i) {
            worst = boxes[i].error > boxes[worst].error ? i : worst;
        }
        if (boxes[worst].error == 0) {
            break;
        }
        cut_box(entries, &boxes[worst], &boxes[used++]);
    }
    for (int i = 0; i < used; ++i) {
        sum_range(entries, boxes[i].first, boxes[i].end, &s);
        mean_color(&s, palette->colors[first + i]);
    }
    palette->count = first + used;
}

/* ---- The palette ---- */

static int compare_colors(const void *left, const void *right) {
    const uint8_t *x = left, *y = right;
    return x[1] != y[1] ? x[1] - y[1] : x[0] != y[0] ? x[0] - y[0] : x[2] - y[2];
}

/* Puts the colours in the order in which picture_palette_nearest looks. */
static void order_colors(picture_palette *palette) {
    int next = 0;
    qsort(palette->colors, (size_t)palette->count, sizeof palette->colors[0], compare_colors);
    for (int green = 0; green < 256; ++green) {
        while (next < palette->count && palette->colors[next][1] < green) {
            ++next;
        }
        palette->first[green] = (uint8_t)next;
    }
}

/* Upward and downward from the colours of its green, until green alone is too far. */
int picture_palette_nearest(const picture_palette *palette, const uint8_t color[3]) {
    int nearest = 0, least = INT_MAX, step[2] = {palette->first[color[1]], 0};
    step[1] = step[0] - 1;
    for (int going = 3; going != 0;) {
        for (int way = 0; way < 2; ++way) {
            const int i = step[way];
            if (!(going >> way & 1)) {
                continue;
            }
            const int green = i >= 0 && i < palette->count ? palette->colors[i][1] - color[1] : 0;
            if (i < 0 || i >= palette->count || 4 * green * green >= least) {
                going &= ~(1 << way);
                continue;
            }
            const int distance = picture_distance(palette->colors[i], color);
            nearest = distance < least ? i : nearest;
            least = distance < least ? distance : least;
            step[way] += way == 0 ? 1 : -1;
        }
    }
    return nearest;
}

/* Each colour to the middle of the entries that are nearest to it, but for the ground. */
static void move_colors(const entry *entries, size_t count, const uint8_t ground[3],
                        picture_palette *palette) {
    sums parts[PICTURE_PALETTE_MAX];
    memset(parts, 0, sizeof parts);
    for (size_t i = 0; i < count; ++i) {
        add_entry(&parts[picture_palette_nearest(palette, entries[i].color)], &entries[i]);
    }
    for (int i = 0; i < palette->count; ++i) {
        if (memcmp(palette->colors[i], ground, 3) != 0) {
            mean_color(&parts[i], palette->colors[i]);
        }
    }
    order_colors(palette);
}

burnish_status picture_palette_choose(const picture_histogram *histogram, const uint8_t ground[3],
                                      picture_palette *palette, burnish_error *error) {
    size_t count;
    entry *entries = list_entries(histogram, &count);
    if (!entries) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the palette");
    }
    palette->count = 1;
    memcpy(palette->colors[0], ground, 3);
    if (count < PICTURE_PALETTE_MAX) {
        for (size_t i = 0; i < count; ++i) {
            if (memcmp(entries[i].color, ground, 3) != 0) {
                memcpy(palette->colors[palette->count++], entries[i].color, 3);
            }
        }
    } else {
        cut_boxes(entries, count, 1, palette);
    }
    order_colors(palette);
    for (int round = 0; round < ROUNDS && count >= PICTURE_PALETTE_MAX; ++round) {
        move_colors(entries, count, ground, palette);
    }
    free(entries);
    return BURNISH_STATUS_OK;
}
