/* Outlines: curves are split into lines of integer points; each line adds its signed area to the
 * pixels that it passes and its height to those right of them, whose running sum is the coverage.
 */
#include "image/text/glyph_outline.h"

#include <string.h>

/* 1/256 pixels; beyond it points are moved to it, so products fit 64 bits. */
#define FARTHEST (1 << 26)

enum { ONE = 256, FULL = 2 * ONE * ONE, CURVE_STEPS = 12 };

/* ---- Edges ---- */

static int32_t bounded_coordinate(int64_t value) {
    return (int32_t)(value < -FARTHEST ? -FARTHEST : value > FARTHEST ? FARTHEST : value);
}

static void line_to(burnish_outline *outline, int64_t x, int64_t y) {
    const burnish_outline_edge edge = {outline->at[0], outline->at[1], bounded_coordinate(x),
                                       bounded_coordinate(y)};
    outline->at[0] = edge.x1;
    outline->at[1] = edge.y1;
    if (edge.y0 == edge.y1) {
        return;
    }
    outline->edges = burnish_reserve(outline->memory, outline->edges, &outline->capacity,
                                     outline->count + 1, sizeof edge, "outlines of letters");
    if (outline->memory->status == BURNISH_STATUS_OK) {
        outline->edges[outline->count++] = edge;
    }
}

/* floor(a / b), b > 0. */
static int64_t floor_divide(int64_t a, int64_t b) {
    return a / b - (a % b < 0);
}

static int64_t rounded_quotient(int64_t a, int64_t b) {
    return floor_divide(2 * a + b, 2 * b);
}

/* Bezier curves in Bernstein form, each point rounded by itself. */
static void curve_to(burnish_outline *outline, const int64_t (*p)[2], int degree) {
    int64_t powers = 1;
    for (int i = 0; i < degree; ++i) {
        powers *= CURVE_STEPS;
    }
    for (int64_t t = 1; t <= CURVE_STEPS; ++t) {
        const int64_t s = CURVE_STEPS - t;
        int64_t at[2];
        for (int k = 0; k < 2; ++k) {
            const int64_t sum = degree == 2
                                    ? s * s * p[0][k] + 2 * s * t * p[1][k] + t * t * p[2][k]
                                    : s * s * s * p[0][k] + 3 * s * s * t * p[1][k] +
                                          3 * s * t * t * p[2][k] + t * t * t * p[3][k];
            at[k] = rounded_quotient(sum, powers);
        }
        line_to(outline, at[0], at[1]);
    }
}

void burnish_outline_add(void *user_data, burnish_outline_verb verb, const int32_t *points) {
    burnish_outline *outline = user_data;
    int64_t p[4][2] = {{outline->at[0], outline->at[1]}};
    const int count = verb == BURNISH_OUTLINE_CUBIC ? 3 : verb == BURNISH_OUTLINE_CONIC ? 2 : 1;
    for (int i = 0; i < count; ++i) {
        p[i + 1][0] = bounded_coordinate((int64_t)outline->x + points[2 * i]);
        p[i + 1][1] = bounded_coordinate((int64_t)outline->y - points[2 * i + 1]);
    }
    if (verb == BURNISH_OUTLINE_MOVE) {
        line_to(outline, outline->start[0], outline->start[1]); /* close what was open */
        outline->at[0] = outline->start[0] = (int32_t)p[1][0];
        outline->at[1] = outline->start[1] = (int32_t)p[1][1];
    } else if (count == 1) {
        line_to(outline, p[1][0], p[1][1]);
    } else {
        curve_to(outline, (const int64_t(*)[2])p, count);
    }
}

/* ---- Coverage ---- */

typedef struct row {
    int32_t *sums; /* width + 1 */
    int width;
} row;

/* A piece within one row, from (xa) to (xb), dy high: each pixel that it passes. */
static void cover_piece(row *to, int64_t xa, int64_t xb, int64_t dy) {
    const int64_t limit = (int64_t)to->width * ONE;
    if (xa >= limit && xb >= limit) {
        return;
    }
    if (xa <= 0 && xb <= 0) {
        to->sums[0] += (int32_t)(dy * 2 * ONE);
        return;
    }
    const int64_t step = xb < xa ? -1 : 1, run = (xb - xa) * step;
    const int64_t sense = dy < 0 ? -1 : 1, height = dy * sense;
    int64_t x = xa, done = 0;
    for (;;) {
        const int64_t column = step > 0 || x % ONE != 0 ? floor_divide(x, ONE) : x / ONE - 1;
        int64_t next = step > 0 ? (column + 1) * ONE : column * ONE;
        const int last = step > 0 ? next >= xb : next <= xb;
        next = last ? xb : next;
        const int64_t until = last ? height : (next - xa) * step * height / run;
        const int64_t part = (until - done) * sense;
        if (column < 0) {
            to->sums[0] += (int32_t)(part * 2 * ONE);
        } else if (column < to->width) {
            const int64_t middle = (x - column * ONE) + (next - column * ONE); /* twice it */
            to->sums[column] += (int32_t)(part * (2 * ONE - middle));
            to->sums[column + 1] += (int32_t)(part * middle);
        }
        if (last) {
            return;
        }
        done = until;
        x = next;
    }
}

static void cover_edge(const burnish_outline_edge *edge, int y, row *to) {
    const int down = edge->y0 < edge->y1;
    const int64_t x0 = down ? edge->x0 : edge->x1, y0 = down ? edge->y0 : edge->y1;
    const int64_t x1 = down ? edge->x1 : edge->x0, y1 = down ? edge->y1 : edge->y0;
    const int64_t top = (int64_t)y * ONE > y0 ? (int64_t)y * ONE : y0;
    const int64_t bottom = (int64_t)(y + 1) * ONE < y1 ? (int64_t)(y + 1) * ONE : y1;
    if (top >= bottom) {
        return;
    }
    const int64_t xa = x0 + floor_divide((top - y0) * (x1 - x0), y1 - y0);
    const int64_t xb = x0 + floor_divide((bottom - y0) * (x1 - x0), y1 - y0);
    cover_piece(to, xa, xb, down ? bottom - top : top - bottom);
}

/* Rows and columns that the edges can touch, within the picture. */
static burnish_rectangle touched_pixels(const burnish_outline *outline,
                                        const burnish_pixels *pixels) {
    int64_t low[2] = {FARTHEST, FARTHEST}, high[2] = {-FARTHEST, -FARTHEST};
    for (size_t i = 0; i < outline->count; ++i) {
        const burnish_outline_edge *e = &outline->edges[i];
        const int32_t xs[2] = {e->x0, e->x1}, ys[2] = {e->y0, e->y1};
        for (int k = 0; k < 2; ++k) {
            low[0] = xs[k] < low[0] ? xs[k] : low[0];
            low[1] = ys[k] < low[1] ? ys[k] : low[1];
            high[0] = xs[k] > high[0] ? xs[k] : high[0];
            high[1] = ys[k] > high[1] ? ys[k] : high[1];
        }
    }
    const int64_t left = floor_divide(low[0], ONE), top = floor_divide(low[1], ONE);
    const int64_t right = floor_divide(high[0], ONE) + 1, bottom = floor_divide(high[1], ONE) + 1;
    return (burnish_rectangle){(int)(left > 0 ? left : 0), (int)(top > 0 ? top : 0),
                               (int)(right < pixels->width ? right : pixels->width),
                               (int)(bottom < pixels->height ? bottom : pixels->height)};
}

static void fill_rows(const burnish_outline *outline, const burnish_pixels *pixels,
                      const burnish_ink *ink, row *sums, float *coverage) {
    const burnish_rectangle area = touched_pixels(outline, pixels);
    for (int y = area.top; y < area.bottom && area.left < area.right; ++y) {
        memset(sums->sums, 0, ((size_t)sums->width + 1) * sizeof *sums->sums);
        for (size_t i = 0; i < outline->count; ++i) {
            cover_edge(&outline->edges[i], y, sums);
        }
        int64_t sum = 0;
        for (int x = 0; x < area.right; ++x) {
            sum += sums->sums[x];
            const int64_t share = sum < 0 ? -sum : sum;
            coverage[x] = (float)(share < FULL ? share : FULL) / (float)FULL;
        }
        burnish_ink_blend(pixels, y, area.left, area.right - area.left, coverage + area.left, ink);
    }
}

burnish_status burnish_outline_fill(burnish_outline *outline, const burnish_pixels *pixels,
                                    const burnish_ink *ink) {
    burnish_memory *memory = outline->memory;
    row sums = {.width = pixels->width};
    line_to(outline, outline->start[0], outline->start[1]);
    sums.sums = burnish_allocate(memory, (size_t)pixels->width + 1, sizeof *sums.sums, "coverage");
    float *coverage = burnish_allocate(memory, (size_t)pixels->width, sizeof *coverage, "coverage");
    if (memory->status == BURNISH_STATUS_OK) {
        fill_rows(outline, pixels, ink, &sums, coverage);
    }
    burnish_release(memory->context, sums.sums);
    burnish_release(memory->context, coverage);
    burnish_release(memory->context, outline->edges);
    outline->edges = NULL;
    outline->count = outline->capacity = 0;
    return memory->status;
}
