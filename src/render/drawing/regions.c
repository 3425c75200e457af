#include "render/drawing/regions.h"

#include <stdlib.h>
#include <string.h>

#include "core/vec3.h"

/* Half pixels: the maximum distance of a straight line from the points that it replaces. Those of a
 * straight border are up to 1 off it, and the line may begin on either side. */
#define TOLERANCE 2.1

enum { VISITED = 128 };

typedef struct point {
    double x, y; /* half pixels */
} point;

/* ---- Fewer points ---- */

/* The lines from a point that pass all points since then closely enough lie between two directions.
 * The one after which there are none left begins the next line. */
typedef struct thinner {
    burnish_borders *borders;
    burnish_memory *memory;
    double scale; /* half pixels per unit */
    point anchor, last, low, high;
    double farthest; /* from the anchor, squared */
    int is_open;     /* 1: no direction is excluded yet */
} thinner;

static void push_border_point(thinner *t, point p) {
    burnish_borders *b = t->borders;
    b->points = burnish_reserve(t->memory, b->points, &b->point_capacity, 2 * b->point_count + 2,
                                sizeof *b->points, "borders");
    if (t->memory->status == BURNISH_STATUS_OK) {
        b->points[2 * b->point_count] = (float)(p.x / t->scale);
        b->points[2 * b->point_count++ + 1] = (float)(p.y / t->scale);
    }
    t->anchor = t->last = p;
    t->farthest = 0;
    t->is_open = 1;
}

static double cross_of_points(point a, point b) {
    return a.x * b.y - a.y * b.x;
}

/* Whether a line from the anchor can go on to the point, and the directions that are then left. */
static int narrow_cone(thinner *t, point p) {
    const point d = {p.x - t->anchor.x, p.y - t->anchor.y};
    const double square = d.x * d.x + d.y * d.y, wide = TOLERANCE * TOLERANCE;
    if (square <= wide) {
        return t->is_open;
    }
    const double along = burnish_sqrt(square - wide);
    const point low = {d.x * along + d.y * TOLERANCE, d.y * along - d.x * TOLERANCE};
    const point high = {d.x * along - d.y * TOLERANCE, d.y * along + d.x * TOLERANCE};
    const int is_back = square < t->farthest;
    const int is_between =
        t->is_open || (cross_of_points(t->low, d) >= 0 && cross_of_points(d, t->high) >= 0);
    if (is_back || !is_between) {
        return 0;
    }
    t->low = t->is_open || cross_of_points(t->low, low) > 0 ? low : t->low;
    t->high = t->is_open || cross_of_points(high, t->high) > 0 ? high : t->high;
    t->farthest = square;
    t->is_open = 0;
    return 1;
}

static void take_point(thinner *t, point p) {
    if (!narrow_cone(t, p)) {
        push_border_point(t, t->last);
        narrow_cone(t, p);
    }
    t->last = p;
}

/* ---- Borders ---- */

static int is_inside(const burnish_region_map *map, uint8_t value, int x, int y) {
    return x >= 0 && y >= 0 && x < map->width && y < map->height &&
           (map->values[(size_t)y * (size_t)map->width + (size_t)x] & ~VISITED) == value;
}

/* Follows a border with the region on its right, from the upper side of a pixel eastward. Pixels
 * that touch at a corner only are not connected. Returns twice the area, in square half pixels. */
static double follow_border(const burnish_region_map *map, uint8_t value, int first_x, int first_y,
                            thinner *t) {
    static const int step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    static const int right[4][2] = {{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}; /* the pixel ahead */
    static const int left[4][2] = {{0, -1}, {0, 0}, {-1, 0}, {-1, -1}};
    int x = first_x, y = first_y, way = 0;
    const point first = {2 * x + 1, 2 * y};
    point before = first;
    double area = 0;
    push_border_point(t, first);
    do {
        if (way == 0) {
            map->values[(size_t)y * (size_t)map->width + (size_t)x] |= VISITED;
        }
        x += step[way][0];
        y += step[way][1];
        if (!is_inside(map, value, x + right[way][0], y + right[way][1])) {
            way = (way + 1) % 4;
        } else if (is_inside(map, value, x + left[way][0], y + left[way][1])) {
            way = (way + 3) % 4;
        }
        const point middle = {2 * x + step[way][0], 2 * y + step[way][1]};
        area += cross_of_points(before, middle);
        before = middle;
        take_point(t, middle);
    } while (x != first_x || y != first_y || way != 0);
    push_border_point(t, first);
    return area;
}

void burnish_borders_find(burnish_borders *borders, const burnish_region_map *map, uint8_t value,
                          int scale, burnish_memory *memory) {
    thinner t = {.borders = borders, .memory = memory, .scale = 2 * scale};
    const double least = 4.0 * scale * scale; /* twice half a square unit, in half pixels */
    borders->count = borders->point_count = borders->hatch_count = 0;
    for (int y = 0; y < map->height; ++y) {
        uint8_t *row = map->values + (size_t)y * (size_t)map->width;
        for (int x = 0; x < map->width && memory->status == BURNISH_STATUS_OK; ++x) {
            if (row[x] != value || is_inside(map, value, x, y - 1)) {
                continue; /* none, or visited, or no upper side */
            }
            const size_t start = borders->point_count;
            const double area = follow_border(map, value, x, y, &t);
            if (area < least && area > -least) {
                borders->point_count = start;
                continue;
            }
            borders->starts =
                burnish_reserve(memory, borders->starts, &borders->start_capacity,
                                borders->count + 2, sizeof *borders->starts, "borders");
            if (memory->status == BURNISH_STATUS_OK) {
                borders->starts[borders->count++] = (uint32_t)start;
                borders->starts[borders->count] = (uint32_t)borders->point_count;
            }
        }
    }
    const size_t count = (size_t)map->width * (size_t)map->height;
    for (size_t i = 0; i < count; ++i) {
        map->values[i] &= (uint8_t)~VISITED;
    }
}

/* ---- Hatching ---- */

/* Where a border crosses a line of the hatching. */
typedef struct crossing {
    int64_t line;
    double x;
} crossing;

static int compare_crossings(const void *a, const void *b) {
    const crossing *p = a, *q = b;
    return p->line != q->line ? (p->line < q->line ? -1 : 1) : (p->x > q->x) - (p->x < q->x);
}

typedef struct crossings {
    crossing *items;
    size_t count, capacity;
} crossings;

/* Lines i with period i + offset in [lower end, upper end). The half-open range makes each border
 * cross every line an even number of times. */
static void cross_edge(crossings *to, const float *a, const float *b, double sign, double period,
                       double offset, burnish_memory *memory) {
    const double f = ((double)a[0] + sign * (double)a[1] - offset) / period;
    const double g = ((double)b[0] + sign * (double)b[1] - offset) / period;
    const double low = f < g ? f : g, high = f < g ? g : f;
    int64_t i = (int64_t)low - 1;
    while ((double)i < low) {
        ++i;
    }
    for (; (double)i < high && memory->status == BURNISH_STATUS_OK; ++i) {
        const double t = ((double)i - f) / (g - f);
        to->items = burnish_reserve(memory, to->items, &to->capacity, to->count + 1,
                                    sizeof *to->items, "hatching");
        if (memory->status == BURNISH_STATUS_OK) {
            to->items[to->count++] =
                (crossing){i, (double)a[0] + t * ((double)b[0] - (double)a[0])};
        }
    }
}

void burnish_borders_hatch(burnish_borders *borders, int way, double period, double offset,
                           burnish_memory *memory) {
    crossings all = {.count = 0};
    const double sign = way ? -1 : 1;
    for (size_t i = 0; i < borders->count; ++i) {
        for (size_t k = borders->starts[i]; k + 1 < borders->starts[i + 1]; ++k) {
            const float *p = borders->points + 2 * k;
            cross_edge(&all, p, p + 2, sign, period, offset, memory);
        }
    }
    if (all.count > 0) {
        qsort(all.items, all.count, sizeof *all.items, compare_crossings);
    }
    borders->hatch_count = 0;
    for (size_t i = 0; i + 1 < all.count && memory->status == BURNISH_STATUS_OK; i += 2) {
        const double at = period * (double)all.items[i].line + offset;
        borders->hatch =
            burnish_reserve(memory, borders->hatch, &borders->hatch_capacity,
                            4 * borders->hatch_count + 4, sizeof *borders->hatch, "hatching");
        for (int end = 0; end < 2 && memory->status == BURNISH_STATUS_OK; ++end) {
            const double x = all.items[i + (size_t)end].x;
            borders->hatch[4 * borders->hatch_count + 2 * (size_t)end] = (float)x;
            borders->hatch[4 * borders->hatch_count + 2 * (size_t)end + 1] =
                (float)(sign * (at - x));
        }
        borders->hatch_count += memory->status == BURNISH_STATUS_OK;
    }
    burnish_release(memory->context, all.items);
}

void burnish_borders_release(burnish_borders *borders, const burnish_context *context) {
    burnish_release(context, borders->points);
    burnish_release(context, borders->starts);
    burnish_release(context, borders->hatch);
    memset(borders, 0, sizeof *borders);
}
