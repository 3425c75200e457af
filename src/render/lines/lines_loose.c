/* Noise of scans makes creases and silhouettes that begin and end in the midst of a surface. Lines
 * with adjacent ends form sets, and short sets with loose ends are dropped. */
#include "render/lines/lines_loose.h"

#include <string.h>

/* Pixels: ends in the same cell or in adjacent cells meet. */
#define CELL 2.0f

/* Adjacent cells, and the lines that end there. */
typedef struct group {
    uint32_t row, column;
    uint32_t line; /* the first one, and ... */
    int several;   /* ... whether there is another */
} group;

enum { RIM = 2 };

typedef struct sets {
    const burnish_lines *lines;
    uint32_t *order;  /* ends, 2 * line + 0 or 1, by row and column of their cells */
    uint32_t *other;  /* the same while they are sorted */
    uint32_t *counts; /* of ends in a row or column, one more */
    group *groups;    /* cells in use, by row and column */
    size_t group_count;
    uint32_t *parents; /* of each line; a root is its own parent */
    float *lengths;    /* of each root's lines */
    uint8_t *is_loose; /* of each root: 1: a line has a loose end; RIM: one is at a rim */
} sets;

static const float *end_point(const burnish_lines *lines, uint32_t end) {
    const uint32_t point = end % 2 ? lines->starts[end / 2 + 1] - 1 : lines->starts[end / 2];
    return lines->points + 2 * (size_t)point;
}

static uint32_t cell_of(const sets *s, uint32_t end, int axis) {
    return (uint32_t)(end_point(s->lines, end)[axis] / CELL);
}

static uint32_t find_root(uint32_t *parents, uint32_t line) {
    while (parents[line] != line) {
        line = parents[line] = parents[parents[line]];
    }
    return line;
}

/* The smaller root represents both. */
static void join(uint32_t *parents, uint32_t a, uint32_t b) {
    const uint32_t x = find_root(parents, a), y = find_root(parents, b);
    parents[x > y ? x : y] = x > y ? y : x;
}

/* Counting sort by one coordinate of the cell, which keeps the order of equal ones. */
static void sort_ends(const sets *s, int axis, size_t cells, const uint32_t *from, uint32_t *to) {
    const size_t count = 2 * s->lines->line_count;
    memset(s->counts, 0, (cells + 1) * sizeof *s->counts);
    for (size_t i = 0; i < count; ++i) {
        ++s->counts[cell_of(s, from[i], axis) + 1];
    }
    for (size_t i = 1; i <= cells; ++i) {
        s->counts[i] += s->counts[i - 1];
    }
    for (size_t i = 0; i < count; ++i) {
        to[s->counts[cell_of(s, from[i], axis)]++] = from[i];
    }
}

static void find_groups(sets *s) {
    for (size_t i = 0; i < 2 * s->lines->line_count; ++i) {
        const uint32_t end = s->order[i];
        const uint32_t row = cell_of(s, end, 1), column = cell_of(s, end, 0);
        group *last = s->group_count > 0 ? &s->groups[s->group_count - 1] : NULL;
        if (last && last->row == row && last->column == column) {
            last->several |= last->line != end / 2;
            join(s->parents, last->line, end / 2);
        } else {
            s->groups[s->group_count++] = (group){row, column, end / 2, 0};
        }
    }
}

/* Both groups' ends meet: each hears of the other's lines. */
static void meet(sets *s, group *a, group *b, uint8_t *has_company, size_t first, size_t second) {
    join(s->parents, a->line, b->line);
    has_company[first] |= b->several || b->line != a->line;
    has_company[second] |= a->several || b->line != a->line;
}

/* Joins adjacent groups of a row, and groups of a row with groups of the row before. */
static void join_groups(sets *s, uint8_t *has_company) {
    size_t before = 0; /* the first group that may lie above, or left of that */
    for (size_t i = 0; i < s->group_count; ++i) {
        group *g = &s->groups[i];
        has_company[i] |= (uint8_t)g->several;
        if (i > 0 && s->groups[i - 1].row == g->row && s->groups[i - 1].column + 1 == g->column) {
            meet(s, g, &s->groups[i - 1], has_company, i, i - 1);
        }
        while (s->groups[before].row + 1 < g->row ||
               (s->groups[before].row + 1 == g->row && s->groups[before].column + 1 < g->column)) {
            ++before;
        }
        for (size_t k = before;
             s->groups[k].row + 1 == g->row && s->groups[k].column <= g->column + 1; ++k) {
            meet(s, g, &s->groups[k], has_company, i, k);
        }
    }
}

static int is_closed(const burnish_lines *lines, uint32_t line) {
    return memcmp(end_point(lines, 2 * line), end_point(lines, 2 * line + 1), 2 * sizeof(float)) ==
           0;
}

static float length_of(const burnish_lines *lines, uint32_t line) {
    float length = 0;
    for (size_t i = lines->starts[line]; i + 1 < lines->starts[line + 1]; ++i) {
        const float *p = lines->points + 2 * i;
        const float dx = p[2] - p[0], dy = p[3] - p[1];
        length += __builtin_sqrtf(dx * dx + dy * dy);
    }
    return length;
}

static void measure_sets(sets *s, const uint8_t *is_rim, const uint8_t *has_company) {
    const size_t count = s->lines->line_count;
    for (size_t i = 0, at = 0; i < 2 * count; ++i) {
        const uint32_t end = s->order[i], line = end / 2;
        while (s->groups[at].row != cell_of(s, end, 1) ||
               s->groups[at].column != cell_of(s, end, 0)) {
            ++at;
        }
        if (!has_company[at] && !is_closed(s->lines, line)) {
            s->is_loose[find_root(s->parents, line)] |= 1;
        }
    }
    for (size_t line = 0; line < count; ++line) {
        const uint32_t root = find_root(s->parents, (uint32_t)line);
        s->lengths[root] += length_of(s->lines, (uint32_t)line);
        s->is_loose[root] |= is_rim[line] ? RIM : 0;
    }
}

/* Moves the lines that stay to the front. */
static void keep_lines(burnish_line_art *art, sets *s, float shortest) {
    burnish_lines *lines = &art->lines;
    size_t kept = 0, points = 0;
    for (size_t i = 0; i < lines->line_count; ++i) {
        const uint32_t root = find_root(s->parents, (uint32_t)i);
        const size_t first = art->starts[i], count = art->starts[i + 1] - first;
        if (s->is_loose[root] == 1 && s->lengths[root] < shortest) {
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
}

void burnish_line_art_drop_loose(burnish_line_art *art, double shortest, burnish_memory *memory) {
    const size_t count = art->lines.line_count, ends = 2 * count;
    const size_t columns = (size_t)((float)art->lines.width / CELL) + 1;
    const size_t rows = (size_t)((float)art->lines.height / CELL) + 1;
    const char *what = "ends of lines";
    sets s = {.lines = &art->lines};
    if (count == 0) {
        return;
    }
    s.order = burnish_allocate(memory, ends, sizeof *s.order, what);
    s.other = burnish_allocate(memory, ends, sizeof *s.other, what);
    s.counts =
        burnish_allocate(memory, (columns > rows ? columns : rows) + 1, sizeof *s.counts, what);
    s.groups = burnish_allocate(memory, ends, sizeof *s.groups, what);
    s.parents = burnish_allocate(memory, count, sizeof *s.parents, what);
    s.lengths = burnish_allocate_zeroed(memory, count, sizeof *s.lengths, what);
    s.is_loose = burnish_allocate_zeroed(memory, count, sizeof *s.is_loose, what);
    uint8_t *has_company = burnish_allocate_zeroed(memory, ends, 1, what);
    if (memory->status == BURNISH_STATUS_OK) {
        for (size_t i = 0; i < ends; ++i) {
            s.order[i] = (uint32_t)i;
            s.parents[i / 2] = (uint32_t)(i / 2);
        }
        sort_ends(&s, 0, columns, s.order, s.other);
        sort_ends(&s, 1, rows, s.other, s.order);
        find_groups(&s);
        join_groups(&s, has_company);
        measure_sets(&s, art->is_rim, has_company);
        keep_lines(art, &s, (float)shortest);
    }
    void *const arrays[] = {s.order,   s.other,   s.counts,   s.groups,
                            s.parents, s.lengths, s.is_loose, has_company};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        burnish_release(memory->context, arrays[i]);
    }
}
