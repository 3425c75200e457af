/* Noise of scans makes creases and silhouettes that begin and end in the midst of a surface, and
 * ticks along real lines. A grid of cells tells which lines each end meets; lines that meet form
 * sets; short sets with loose ends and short lines with one loose end are dropped. */
#include "render/lines/lines_steps.h"

#include <string.h>

#include "core/vec3.h"

/* Pixels: an end meets the lines in its cell and in the eight around it. */
#define CELL 2.0f

/* Dropping ticks makes loose ends where they met. */
#define PASSES 3

/* The first two lines in a cell, as line + 1; 0: none. */
typedef struct cell {
    uint32_t lines[2];
} cell;

/* What a set has: a loose end, a line at a rim, an edge of the surface, a closed line. */
enum { LOOSE = 1, RIM = 2, FEATURE = 4, CLOSED = 8 };

typedef struct sets {
    const burnish_lines *lines;
    cell *cells;
    size_t columns, rows;
    uint32_t *parents; /* of each line; a root is its own parent */
    float *lengths;    /* of each line */
    float *sums;       /* of each root's lines */
    uint8_t *loose;    /* of each line: number of loose ends */
    uint8_t *kinds;    /* of each root: LOOSE: a line has a loose end, ... */
} sets;

static const float *end_point(const burnish_lines *lines, uint32_t line, int end) {
    const uint32_t point = end ? lines->starts[line + 1] - 1 : lines->starts[line];
    return lines->points + 2 * (size_t)point;
}

static uint32_t find_root(uint32_t *parents, uint32_t line) {
    while (parents[line] != line) {
        line = parents[line] = parents[parents[line]];
    }
    return line;
}

/* The smaller root represents both. */
static void join_sets(uint32_t *parents, uint32_t a, uint32_t b) {
    const uint32_t x = find_root(parents, a), y = find_root(parents, b);
    parents[x > y ? x : y] = x > y ? y : x;
}

static void mark_cell(const sets *s, float x, float y, uint32_t line) {
    cell *c = &s->cells[(size_t)(y / CELL) * s->columns + (size_t)(x / CELL)];
    if (c->lines[0] == 0) {
        c->lines[0] = line + 1;
    } else if (c->lines[0] != line + 1 && c->lines[1] == 0) {
        c->lines[1] = line + 1;
    }
}

/* Marks the cells along a line, and returns its length. */
static float mark_line(const sets *s, uint32_t line) {
    const burnish_lines *lines = s->lines;
    float sum = 0;
    for (size_t i = lines->starts[line]; i + 1 < lines->starts[line + 1]; ++i) {
        const float *p = lines->points + 2 * i;
        const float dx = p[2] - p[0], dy = p[3] - p[1];
        const float length = __builtin_sqrtf(dx * dx + dy * dy);
        const int steps = (int)length + 1;
        for (int k = 0; k <= steps; ++k) {
            const float t = (float)k / (float)steps;
            mark_cell(s, p[0] + t * dx, p[1] + t * dy, line);
        }
        sum += length;
    }
    return sum;
}

/* Joins a line with those at its end; returns 1 if there are none. */
static int is_loose_end(const sets *s, uint32_t line, int end) {
    const float *p = end_point(s->lines, line, end);
    const size_t x = (size_t)(p[0] / CELL), y = (size_t)(p[1] / CELL);
    int found = 0;
    for (size_t row = y > 0 ? y - 1 : 0; row <= y + 1 && row < s->rows; ++row) {
        for (size_t column = x > 0 ? x - 1 : 0; column <= x + 1 && column < s->columns; ++column) {
            const cell *c = &s->cells[row * s->columns + column];
            for (int k = 0; k < 2; ++k) {
                if (c->lines[k] != 0 && c->lines[k] != line + 1) {
                    join_sets(s->parents, c->lines[k] - 1, line);
                    found = 1;
                }
            }
        }
    }
    return !found;
}

static int is_closed(const burnish_lines *lines, uint32_t line) {
    return memcmp(end_point(lines, line, 0), end_point(lines, line, 1), 2 * sizeof(float)) == 0;
}

static void measure_sets(const sets *s, const burnish_line_art *art, float outline) {
    const size_t count = s->lines->line_count;
    memset(s->cells, 0, s->columns * s->rows * sizeof *s->cells);
    memset(s->sums, 0, count * sizeof *s->sums);
    memset(s->kinds, 0, count);
    for (uint32_t line = 0; line < count; ++line) {
        s->parents[line] = line;
        s->lengths[line] = mark_line(s, line);
    }
    for (uint32_t line = 0; line < count; ++line) {
        const int first = is_loose_end(s, line, 0), second = is_loose_end(s, line, 1);
        s->loose[line] = is_closed(s->lines, line) ? 0 : (uint8_t)(first + second);
    }
    for (uint32_t line = 0; line < count; ++line) {
        const uint32_t root = find_root(s->parents, line);
        s->sums[root] += s->lengths[line];
        s->kinds[root] |=
            (uint8_t)((s->loose[line] > 0 ? LOOSE : 0) | (art->is_rim[line] ? RIM : 0) |
                      (art->widths[line] < outline ? FEATURE : 0) |
                      (is_closed(s->lines, line) ? CLOSED : 0));
    }
}

/* Whether a line is too short to mean anything. */
static int is_noise(const sets *s, const burnish_line_art *art, uint32_t line,
                    const burnish_line_limits *limits) {
    const uint32_t root = find_root(s->parents, line);
    const int kind = s->kinds[root];
    const float sum = s->sums[root];
    const int is_tangent = art->widths[line] == (float)BURNISH_LINE_NARROW * limits->outline;
    if (s->loose[line] > 0 && !art->is_rim[line] &&
        (is_tangent || s->lengths[line] < limits->tick)) {
        return 1;
    }
    if (kind & RIM) {
        return 0;
    }
    return sum < limits->least || (!(kind & CLOSED) && kind & LOOSE && sum < limits->set) ||
           (!(kind & (CLOSED | FEATURE)) && sum < limits->fold);
}

/* Moves the lines that stay to the front; returns 1 if there are fewer now. */
static int keep_lines(burnish_line_art *art, const sets *s, const burnish_line_limits *limits) {
    burnish_lines *lines = &art->lines;
    const size_t before = lines->line_count;
    size_t kept = 0, points = 0;
    for (size_t i = 0; i < before; ++i) {
        const size_t first = art->starts[i], count = art->starts[i + 1] - first;
        if (is_noise(s, art, (uint32_t)i, limits)) {
            continue;
        }
        memmove(art->points + 2 * points, art->points + 2 * first, 2 * count * sizeof *art->points);
        art->widths[kept] = art->widths[i];
        art->is_rim[kept] = art->is_rim[i];
        art->starts[kept++] = (uint32_t)points; /* not after line i */
        points += count;
    }
    art->starts[kept] = (uint32_t)points;
    lines->line_count = kept;
    lines->point_count = points;
    return kept < before;
}

void burnish_line_art_drop_loose(burnish_line_art *art, const burnish_line_limits *limits,
                                 burnish_memory *memory) {
    const size_t count = art->lines.line_count;
    const char *what = "ends of lines";
    sets s = {.lines = &art->lines,
              .columns = (size_t)((float)art->lines.width / CELL) + 1,
              .rows = (size_t)((float)art->lines.height / CELL) + 1};
    if (count == 0) {
        return;
    }
    s.cells = burnish_allocate(memory, s.columns * s.rows, sizeof *s.cells, what);
    s.parents = burnish_allocate(memory, count, sizeof *s.parents, what);
    s.lengths = burnish_allocate(memory, count, sizeof *s.lengths, what);
    s.sums = burnish_allocate(memory, count, sizeof *s.sums, what);
    s.loose = burnish_allocate(memory, count, 1, what);
    s.kinds = burnish_allocate(memory, count, 1, what);
    int is_done = memory->status != BURNISH_STATUS_OK;
    for (int pass = 0; pass < PASSES && !is_done; ++pass) {
        measure_sets(&s, art, limits->outline);
        is_done = !keep_lines(art, &s, limits);
    }
    void *const arrays[] = {s.cells, s.parents, s.lengths, s.sums, s.loose, s.kinds};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        burnish_release(memory->context, arrays[i]);
    }
}
