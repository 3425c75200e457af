/* Polygons to triangles by ear clipping (G. H. Meisters, "Polygons have ears", 1975): a simple
 * polygon always has a convex corner whose neighbours see each other. Clipping one changes only its
 * neighbours (J. O'Rourke, "Computational Geometry in C", 1.5), hence O(n^2) in all. */
#include "mesh/read/common/triangulate.h"

#include "mesh/read/common/damage.h"

enum { CORNERS = BURNISH_POLYGON_CORNERS };

typedef struct point {
    double x, y;
} point;

/* The corners still there, in a ring. */
typedef struct ring {
    point points[CORNERS];
    uint16_t next[CORNERS], previous[CORNERS];
    uint8_t convex[CORNERS], ear[CORNERS];
    size_t left;
} ring;

/* Twice the signed area of a, b, c: positive when they turn to the left. */
static double turn_of(point a, point b, point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static int same_point(point a, point b) {
    return a.x == b.x && a.y == b.y;
}

/* Projects along the dominant axis of Newell's normal, which makes the polygon run to the left.
 * Returns 0 when the polygon has no normal. */
static int project_polygon(const float *positions, const uint32_t *corners, size_t count,
                           point *points) {
    double normal[3] = {0, 0, 0};
    const float *origin = positions + 3 * (size_t)corners[0];
    for (size_t i = 0; i < count; ++i) {
        const float *a = positions + 3 * (size_t)corners[i];
        const float *b = positions + 3 * (size_t)corners[i + 1 < count ? i + 1 : 0];
        double ax = (double)a[0] - origin[0], bx = (double)b[0] - origin[0];
        double ay = (double)a[1] - origin[1], by = (double)b[1] - origin[1];
        double az = (double)a[2] - origin[2], bz = (double)b[2] - origin[2];
        normal[0] += ay * bz - az * by;
        normal[1] += az * bx - ax * bz;
        normal[2] += ax * by - ay * bx;
    }
    int axis = 0;
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        double size = normal[i] < 0 ? -normal[i] : normal[i];
        if (size > largest) {
            largest = size;
            axis = i;
        }
    }
    if (!(largest > 0)) {
        return 0;
    }
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0) {
        int swap = u;
        u = v;
        v = swap;
    }
    for (size_t i = 0; i < count; ++i) {
        const float *p = positions + 3 * (size_t)corners[i];
        points[i] = (point){p[u], p[v]};
    }
    return 1;
}

static void write_triangle(uint16_t *triangle, size_t a, size_t b, size_t c) {
    triangle[0] = (uint16_t)a;
    triangle[1] = (uint16_t)b;
    triangle[2] = (uint16_t)c;
}

static int is_ear(const ring *r, size_t tip) {
    point a = r->points[r->previous[tip]], b = r->points[tip], c = r->points[r->next[tip]];
    if (!r->convex[tip]) {
        return 0;
    }
    /* Only a corner that is not convex can be the one that reaches deepest into the triangle. */
    for (size_t i = r->next[r->next[tip]]; i != r->previous[tip]; i = r->next[i]) {
        point p = r->points[i];
        if (!r->convex[i] && turn_of(a, b, p) >= 0 && turn_of(b, c, p) >= 0 &&
            turn_of(c, a, p) >= 0 && !same_point(p, a) && !same_point(p, b) && !same_point(p, c)) {
            return 0;
        }
    }
    return 1;
}

static void judge_corner(ring *r, size_t corner) {
    r->convex[corner] =
        turn_of(r->points[r->previous[corner]], r->points[corner], r->points[r->next[corner]]) > 0;
}

/* The next ear at or after corner, or CORNERS. */
static size_t find_ear(const ring *r, size_t corner) {
    for (size_t tried = 0; tried < r->left; ++tried, corner = r->next[corner]) {
        if (r->ear[corner]) {
            return corner;
        }
    }
    return CORNERS;
}

static void judge_all(ring *r, size_t corner) {
    size_t i = corner;
    do {
        judge_corner(r, i);
        i = r->next[i];
    } while (i != corner);
    do {
        r->ear[i] = (uint8_t)is_ear(r, i);
        i = r->next[i];
    } while (i != corner);
}

static void clip_ears(ring *r, uint16_t *triangles) {
    size_t corner = 0;
    int rejudged = 0;
    judge_all(r, corner);
    while (r->left > 3) {
        size_t tip = find_ear(r, corner);
        if (tip == CORNERS && !rejudged) {
            /* Coinciding corners can free an ear further away: look once more. */
            rejudged = 1;
            judge_all(r, corner);
            continue;
        }
        int fan = tip == CORNERS; /* not a simple polygon: a fan around corner */
        tip = fan ? r->next[corner] : tip;
        size_t before = r->previous[tip], after = r->next[tip];
        write_triangle(triangles, before, tip, after);
        triangles += 3;
        r->next[before] = (uint16_t)after;
        r->previous[after] = (uint16_t)before;
        --r->left;
        judge_corner(r, before);
        judge_corner(r, after);
        r->ear[before] = (uint8_t)is_ear(r, before);
        r->ear[after] = (uint8_t)is_ear(r, after);
        corner = fan ? before : after;
    }
    write_triangle(triangles, r->previous[corner], corner, r->next[corner]);
}

/* Links the corners; returns 1 when every one turns strictly to the left. */
static int make_ring(ring *r, size_t count) {
    int convex = 1;
    r->left = count;
    for (size_t i = 0; i < count; ++i) {
        r->previous[i] = (uint16_t)(i > 0 ? i - 1 : count - 1);
        r->next[i] = (uint16_t)(i + 1 < count ? i + 1 : 0);
        convex &= turn_of(r->points[r->previous[i]], r->points[i], r->points[r->next[i]]) > 0;
    }
    return convex;
}

int burnish_polygon_cut(const float *positions, const uint32_t *corners, size_t count,
                        uint16_t *triangles) {
    ring r;
    if (count > 3 && project_polygon(positions, corners, count, r.points) &&
        !make_ring(&r, count)) {
        clip_ears(&r, triangles);
        return 1;
    }
    for (size_t i = 0; i + 2 < count; ++i) {
        write_triangle(triangles + 3 * i, 0, i + 1, i + 2);
    }
    return 0;
}

/* ---- Of a mesh ---- */

/* Cuts one face, whose corners are taken from its fan. */
static void cut_polygon(const burnish_mesh_data *mesh, burnish_polygon polygon) {
    enum { MOST = BURNISH_POLYGON_CORNERS };
    uint16_t cut[3 * (MOST - 2)];
    uint32_t corners[MOST];
    const size_t count = polygon.corner_count, first = 3 * (size_t)polygon.first_triangle;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        uint32_t *to = mesh->streams[i].corners;
        if (!to) {
            continue;
        }
        to += first;
        corners[0] = to[0];
        corners[1] = to[1];
        for (size_t k = 2; k < count; ++k) {
            corners[k] = to[3 * (k - 2) + 2];
        }
        if (i == BURNISH_POSITION &&
            !burnish_polygon_cut(burnish_positions(mesh), corners, count, cut)) {
            return;
        }
        for (size_t k = 0; k < 3 * (count - 2); ++k) {
            to[k] = corners[cut[k]];
        }
    }
}

static void cut_range(void *user_data, size_t first, size_t end) {
    const burnish_reader *reader = user_data;
    for (size_t i = first; i < end; ++i) {
        cut_polygon(reader->mesh, reader->polygons[i]);
    }
}

burnish_status burnish_cut_polygons(burnish_reader *reader) {
    burnish_mark_damage(reader);
    burnish_tasks_ranges(reader->mesh->tasks, reader->polygon_count, 1 << 12, cut_range, reader);
    return burnish_tasks_check(reader->mesh->tasks, reader->error);
}
