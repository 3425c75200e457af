/* What is seen of a chain of segments, and how it becomes polylines. */
#include "render/lines/lines_steps.h"

#include <string.h>

#include "core/vec3.h"

enum {
    SAMPLES_MAX = 1 << 16, /* of a chain, which has at most 32,000 pixels and a segment more */
    GAP_MAX = 2,           /* samples: shorter gaps are closed */
    SWITCH_MAX = 4         /* samples: a shorter change between outline and inner line is none */
};

/* What a sample shows; RIM: an outline where the background begins. COVERED: another line is drawn
 * there. BLOCKED is added if a feature's own pixel shows a surface well before it, and only one next
 * to it does not: where a line passes behind an outline at a small angle, it would reach across. */
enum { HIDDEN, INNER, OUTLINE, RIM, COVERED, BLOCKED = 16 };

/* Pixels. */
#define SURFACE_SLACK 2.0 /* of depth: how far a pixel's surface may be before an edge's sample */
#define JUST_OUTSIDE 1.5  /* how far outside a silhouette no sample of a pixel shows its surface */
#define RIM_OUTSIDE 1.25  /* how far outside a silhouette the background may begin; ... */
#define LOOK_OUTSIDE 2.0  /* ... where the next surface is looked up, ... */
#define STEP_DEPTH 8.0    /* ... how much farther away it is, at least, ... */
#define LOOK_FARTHER 4.0  /* ... without its slope, which is measured up to here */
#define STUB 3.0          /* shorter ends of hidden edges, visible at corners, are dropped */
#define COVERS 2.0        /* hidden lines reach this far under the lines that cover them */
#define SHORTEST 0.01     /* shorter lines are points */
#define TOLERANCE 0.08    /* the maximum distance of dropped points from a line */

/* Distances are floats. */
#define DISTANCE_PRECISION 0x1p-21

/* ---- Samples ---- */

/* A sample of a segment: where it is on the screen, how far away, and the unit vector to its left.
 */
typedef struct sample {
    double x, y, distance, left[2];
    double pixel; /* a pixel's width there, in the mesh's units */
} sample;

static sample sample_at(const burnish_line_scene *scene, const burnish_line_segment *s, double t) {
    const double dx = (double)s->x[1] - (double)s->x[0], dy = (double)s->y[1] - (double)s->y[0];
    const double length = burnish_sqrt(dx * dx + dy * dy);
    const double inverse = length > 0 ? 1 / length : 0;
    const double key = (double)s->key[0] + t * ((double)s->key[1] - (double)s->key[0]);
    sample at = {.x = (double)s->x[0] + t * dx,
                 .y = (double)s->y[0] + t * dy,
                 .distance = scene->is_parallel ? key : 1 / key,
                 .left = {dy * inverse, -dx * inverse}};
    at.pixel = scene->is_parallel ? scene->footprint : scene->footprint * at.distance;
    return at;
}

/* The pixel `aside` to the left of a sample; 0 outside the picture. */
static int pixel_beside(const burnish_line_scene *scene, const sample *at, double aside, int *x,
                        int *y) {
    const double px = at->x + aside * at->left[0], py = at->y + aside * at->left[1];
    if (!(px >= 0 && py >= 0 && px < scene->width && py < scene->height)) {
        return 0;
    }
    *x = (int)px;
    *y = (int)py;
    return 1;
}

static float depth_at(const burnish_target *target, int x, int y) {
    const void *row = (const char *)target->depth + (size_t)y * target->depth_stride;
    return ((const float *)row)[x];
}

static uint32_t triangle_at(const burnish_target *target, int x, int y) {
    const void *row = (const char *)target->triangles + (size_t)y * target->triangle_stride;
    return ((const uint32_t *)row)[x];
}

/* Whether what a pixel near the edge shows is the edge's own triangle, not behind a cap, or nothing
 * nearer than the edge; BLOCKED if only pixels next to a feature do. The latter tells nothing of an
 * edge without a front-facing triangle, unless triangles are seen from their back here: a part seen
 * along an axis hides the edges of its other side, which lie just where its own do. */
static int is_seen(const burnish_line_scene *scene, const burnish_line_segment *s,
                   const sample *at) {
    const double limit = at->distance * (1 - DISTANCE_PRECISION) - SURFACE_SLACK * at->pixel;
    const double aside[4] = {0, 1, -1, JUST_OUTSIDE * s->outside};
    const int count = s->outside ? 4 : 3;
    int is_free = 0, sees_back = s->has_front, blocked = 0;
    for (int i = 0; i < count; ++i) {
        int x, y;
        if (!pixel_beside(scene, at, aside[i], &x, &y)) {
            continue;
        }
        const uint32_t triangle = triangle_at(scene->target, x, y);
        const int shows = triangle != BURNISH_TRIANGLE_NONE;
        const int is_cap =
            shows && scene->cap_facing && scene->facing[triangle] == scene->cap_facing;
        if (shows && !is_cap && (triangle == s->triangles[0] || triangle == s->triangles[1])) {
            return 1 | blocked;
        }
        const double depth = (double)depth_at(scene->target, x, y);
        if (i == 0 && s->is_feature && depth < limit - STEP_DEPTH * at->pixel) {
            blocked = BLOCKED;
        }
        is_free |= depth >= limit;
        sees_back |= shows && scene->facing[triangle] < 0;
    }
    return is_free && sees_back ? 1 | blocked : 0;
}

/* The distance of what a pixel beside the edge shows; 0 for the background. At the picture's border
 * that is not known, and taken for the background. */
static double surface_beside(const burnish_line_scene *scene, const sample *at, double aside) {
    int x, y;
    return pixel_beside(scene, at, aside, &x, &y) &&
                   triangle_at(scene->target, x, y) != BURNISH_TRIANGLE_NONE
               ? (double)depth_at(scene->target, x, y)
               : 0;
}

/* RIM or OUTLINE where there is a step in depth at a silhouette, else HIDDEN. A surface that goes
 * on falling away is not a step. */
static uint8_t step_at(const burnish_line_scene *scene, const burnish_line_segment *s,
                       const sample *at) {
    const double nearest = s->outside ? surface_beside(scene, at, RIM_OUTSIDE * s->outside) : 0;
    if (s->outside == 0 || nearest == 0) {
        return s->outside == 0 ? HIDDEN : RIM;
    }
    const double next = surface_beside(scene, at, LOOK_OUTSIDE * s->outside);
    const double far = surface_beside(scene, at, LOOK_FARTHER * s->outside);
    const double surface = next > 0 ? next : nearest;
    const double slope = next > 0 && far > next ? far - next : 0;
    return surface - at->distance - slope > STEP_DEPTH * at->pixel ? OUTLINE : HIDDEN;
}

static uint8_t look_at(burnish_line_scene *scene, const burnish_line_segment *s, double t) {
    const sample at = sample_at(scene, s, t);
    const int seen = is_seen(scene, s, &at);
    if (!seen) {
        return HIDDEN;
    }
    const uint8_t step = step_at(scene, s, &at);
    const uint8_t state = step != HIDDEN ? step : s->is_feature ? INNER : HIDDEN;
    return state == HIDDEN ? state : (uint8_t)(state | (seen & BLOCKED));
}

/* ---- Hidden lines ---- */

/* What a map has where a visible line is drawn; then each hidden sample has a number. */
enum { TAKEN = 1, FIRST_SAMPLE = 64, BACKWARD = 12 };

/* Whether a visible line, or a hidden one apart from the last few samples, is drawn at a pixel or
 * next to it. */
static int is_covered(const burnish_line_scene *scene, int x, int y) {
    for (int row = y > 0 ? y - 1 : 0; row <= y + 1 && row < scene->height; ++row) {
        for (int column = x > 0 ? x - 1 : 0; column <= x + 1 && column < scene->width; ++column) {
            const uint32_t at = scene->taken[(size_t)row * (size_t)scene->width + (size_t)column];
            if (at == TAKEN || (at > TAKEN && scene->taken_count - at > BACKWARD)) {
                return 1;
            }
        }
    }
    return 0;
}

static uint8_t look_behind(burnish_line_scene *scene, const burnish_line_segment *s, double t) {
    const sample at = sample_at(scene, s, t);
    int x, y;
    if (!pixel_beside(scene, &at, 0, &x, &y) || is_seen(scene, s, &at)) {
        return HIDDEN;
    }
    uint32_t *taken = &scene->taken[(size_t)y * (size_t)scene->width + (size_t)x];
    scene->taken_count += scene->taken_count < UINT32_MAX;
    if (is_covered(scene, x, y)) {
        return COVERED;
    }
    *taken = *taken == 0 ? scene->taken_count : *taken;
    return INNER;
}

void burnish_line_scene_take(burnish_line_scene *scene, const burnish_lines *lines) {
    scene->taken_count = FIRST_SAMPLE;
    for (size_t line = 0; line < lines->line_count; ++line) {
        for (size_t i = lines->starts[line]; i + 1 < lines->starts[line + 1]; ++i) {
            const float *p = lines->points + 2 * i;
            const float dx = p[2] - p[0], dy = p[3] - p[1];
            const int steps = (int)__builtin_sqrtf(dx * dx + dy * dy) + 1;
            for (int k = 0; k <= steps; ++k) {
                const float share = (float)k / (float)steps;
                const int x = (int)(p[0] + share * dx), y = (int)(p[1] + share * dy);
                if (x < scene->width && y < scene->height) {
                    scene->taken[(size_t)y * (size_t)scene->width + (size_t)x] = TAKEN;
                }
            }
        }
    }
}

int burnish_line_scene_shows(const burnish_line_scene *scene, double x, double y, double distance) {
    if (!(x >= 0 && y >= 0 && x < scene->width && y < scene->height) ||
        triangle_at(scene->target, (int)x, (int)y) == BURNISH_TRIANGLE_NONE) {
        return 0;
    }
    const double away = (double)depth_at(scene->target, (int)x, (int)y) - distance;
    const double pixel = scene->is_parallel ? scene->footprint : scene->footprint * distance;
    const double slack = STUB * pixel + DISTANCE_PRECISION * distance;
    return away <= slack && away >= -slack;
}

/* ---- Runs of samples ---- */

static size_t run_end(const uint8_t *states, size_t first, size_t count) {
    size_t end = first + 1;
    while (end < count && states[end] == states[first]) {
        ++end;
    }
    return end;
}

/* Blocked samples next to a run of hidden ones become hidden. All lose the mark. */
static void trim_blocked(uint8_t *states, size_t count) {
    for (size_t first = 0, end; first < count; first = end) {
        end = run_end(states, first, count);
        if (states[first] == HIDDEN && end - first > GAP_MAX) {
            for (size_t i = first; i > 0 && states[i - 1] & BLOCKED; --i) {
                states[i - 1] = HIDDEN;
            }
            while (end < count && states[end] & BLOCKED) {
                states[end++] = HIDDEN;
            }
        }
    }
    for (size_t i = 0; i < count; ++i) {
        states[i] &= (uint8_t)~BLOCKED;
    }
}

/* Runs of `state` no longer than `most` between two samples that are not HIDDEN get the state
 * before them. */
static void close_runs(uint8_t *states, size_t count, uint8_t state, size_t most) {
    for (size_t first = 0, end; first < count; first = end) {
        end = run_end(states, first, count);
        if (states[first] == state && end - first <= most && first > 0 && end < count &&
            states[first - 1] != HIDDEN && states[end] != HIDDEN) {
            memset(states + first, states[first - 1], end - first);
            end = first;
            while (end < count && states[end] == states[first - 1]) {
                ++end;
            }
        }
    }
}

/* ---- Polylines ---- */

/* A point on a chain: the end of one of its segments, walked forward or backward. */
static void chain_point(const burnish_line_art *art, uint32_t end, double t, double point[2]) {
    const burnish_line_segment *s = &art->segments[end / 2];
    const double u = end % 2 ? 1 - t : t;
    point[0] = (double)s->x[0] + u * ((double)s->x[1] - (double)s->x[0]);
    point[1] = (double)s->y[0] + u * ((double)s->y[1] - (double)s->y[0]);
}

/* A polyline that grows: points that lie within TOLERANCE of the line from the last kept one are
 * left out. Those lines make a cone, which each point narrows (Williams 1978, Sklansky and Gonzalez
 * 1980): O(n). */
typedef struct growing {
    burnish_line_art *art;
    burnish_memory *memory;
    double kept[2], last[2];
    double left[2], right[2]; /* the cone's sides; 0, 0: none yet */
    int has_last;
} growing;

static double cross_2d(const double a[2], const double b[2]) {
    return a[0] * b[1] - a[1] * b[0];
}

static void store_point(growing *g, const double point[2]) {
    burnish_lines *lines = &g->art->lines;
    g->art->points = burnish_reserve(g->memory, g->art->points, &g->art->point_capacity,
                                     2 * (lines->point_count + 1), sizeof *g->art->points, "lines");
    if (g->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    float *to = g->art->points + 2 * lines->point_count++;
    to[0] = (float)point[0];
    to[1] = (float)point[1];
    memcpy(g->kept, point, sizeof g->kept);
    memset(g->left, 0, sizeof g->left);
    memset(g->right, 0, sizeof g->right);
    g->has_last = 0;
}

/* Narrows the cone by a point at v from its tip. */
static void narrow_cone(growing *g, const double v[2], double length) {
    const double sine = TOLERANCE / length, cosine = burnish_sqrt(1 - sine * sine);
    const double a[2] = {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]};
    const double b[2] = {cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0]};
    const int is_new = g->left[0] == 0 && g->left[1] == 0;
    if (is_new || cross_2d(g->left, a) < 0) {
        memcpy(g->left, a, sizeof a);
    }
    if (is_new || cross_2d(g->right, b) > 0) {
        memcpy(g->right, b, sizeof b);
    }
}

static void add_point(growing *g, const double point[2]) {
    for (int again = 0; again < 2; ++again) {
        const double v[2] = {point[0] - g->kept[0], point[1] - g->kept[1]};
        const double length = burnish_sqrt(v[0] * v[0] + v[1] * v[1]);
        const int has_cone = g->left[0] != 0 || g->left[1] != 0;
        const int inside = !has_cone || (cross_2d(g->right, v) >= 0 && cross_2d(v, g->left) >= 0 &&
                                         v[0] * g->left[0] + v[1] * g->left[1] > 0);
        if (inside || !g->has_last) {
            if (length > 2 * TOLERANCE) {
                narrow_cone(g, v, length);
            }
            break;
        }
        const double last[2] = {g->last[0], g->last[1]};
        store_point(g, last);
    }
    memcpy(g->last, point, sizeof g->last);
    g->has_last = 1;
}

static void begin_line(growing *g, double width, int is_rim, const double point[2]) {
    burnish_line_art *art = g->art;
    const size_t line = art->lines.line_count;
    art->starts = burnish_reserve(g->memory, art->starts, &art->start_capacity, line + 2,
                                  sizeof *art->starts, "lines");
    art->widths = burnish_reserve(g->memory, art->widths, &art->width_capacity, line + 1,
                                  sizeof *art->widths, "lines");
    art->is_rim = burnish_reserve(g->memory, art->is_rim, &art->rim_capacity, line + 1,
                                  sizeof *art->is_rim, "lines");
    if (art->lines.point_count > UINT32_MAX / 4 && g->memory->status == BURNISH_STATUS_OK) {
        g->memory->status =
            burnish_fail(g->memory->error, BURNISH_STATUS_LIMIT, "edges: more than 2^30 points");
    }
    if (g->memory->status == BURNISH_STATUS_OK) {
        art->starts[line] = (uint32_t)art->lines.point_count;
        art->widths[line] = (float)width;
        art->is_rim[line] = (uint8_t)is_rim;
        store_point(g, point);
    }
}

static void end_line(growing *g) {
    burnish_line_art *art = g->art;
    if (g->memory->status == BURNISH_STATUS_OK && g->has_last) {
        const double last[2] = {g->last[0], g->last[1]};
        store_point(g, last);
    }
    if (g->memory->status == BURNISH_STATUS_OK) {
        art->starts[++art->lines.line_count] = (uint32_t)art->lines.point_count;
    }
}

/* ---- Tracing ---- */

/* A chain, and where it is walked: its segment, and the length before it. */
typedef struct cursor {
    const uint32_t *chain; /* as burnish_line_art_trace has it */
    size_t count, at;
    double before, length; /* of the segment at hand */
} cursor;

/* The part of a chain that becomes a line. */
typedef struct chain_part {
    double from, to; /* lengths */
    double width;
    int is_rim;
} chain_part;

/* Moves on to the segment that holds the chain's length `to`; returns where in it. */
static double advance_to(const burnish_line_art *art, cursor *c, double to) {
    while (c->at + 1 < c->count && c->before + c->length <= to) {
        c->before += c->length;
        c->length = burnish_line_length(&art->segments[c->chain[++c->at] / 2]);
    }
    const double t = c->length > 0 ? (to - c->before) / c->length : 0;
    return t > 0 ? t < 1 ? t : 1 : 0;
}

static void add_line(burnish_line_art *art, cursor *c, const chain_part *part,
                     burnish_memory *memory) {
    growing g = {.art = art, .memory = memory};
    double point[2];
    double t = advance_to(art, c, part->from);
    chain_point(art, c->chain[c->at], t, point);
    begin_line(&g, part->width, part->is_rim, point);
    for (size_t before = c->at; memory->status == BURNISH_STATUS_OK; before = c->at) {
        const double end = c->before + c->length;
        t = advance_to(art, c, part->to < end ? part->to : end);
        chain_point(art, c->chain[before], before == c->at ? t : 1, point);
        add_point(&g, point);
        if (before == c->at) {
            break;
        }
    }
    end_line(&g);
}

void burnish_line_art_add(burnish_line_art *art, const double from[2], const double to[2],
                          double width, burnish_memory *memory) {
    growing g = {.art = art, .memory = memory};
    begin_line(&g, width, 0, from);
    add_point(&g, to);
    end_line(&g);
}

/* A run of a hidden line as dashes that begin and end with one (ISO 128-2: 12 widths, gaps of 3
 * between their round ends). */
static void add_dashes(burnish_line_art *art, cursor *c, const chain_part *part,
                       burnish_memory *memory) {
    const double dash = 11 * part->width, gap = 4 * part->width, length = part->to - part->from;
    const int count = (int)((length + gap) / (dash + gap) + 0.5), steps = count > 1 ? count - 1 : 0;
    const double scale = length / (steps * (dash + gap) + dash);
    for (int i = 0; i <= steps; ++i) {
        chain_part piece = *part;
        piece.from = part->from + i * (dash + gap) * scale;
        piece.to = i < steps ? piece.from + dash * scale : part->to;
        add_line(art, c, &piece, memory);
    }
}

static double chain_length(const burnish_line_art *art, const uint32_t *chain, size_t count) {
    double length = 0;
    for (size_t i = 0; i < count; ++i) {
        length += burnish_line_length(&art->segments[chain[i] / 2]);
    }
    return length;
}

/* The samples of a chain at the middle of `samples` equal steps. */
static void look_along(const burnish_line_art *art, burnish_line_scene *scene, cursor c,
                       size_t samples, double step, uint8_t *states) {
    for (size_t i = 0; i < samples; ++i) {
        const double t = advance_to(art, &c, ((double)i + 0.5) * step);
        const uint32_t end = c.chain[c.at];
        states[i] = (scene->taken ? look_behind : look_at)(scene, &art->segments[end / 2],
                                                           end % 2 ? 1 - t : t);
    }
    trim_blocked(states, samples);
    close_runs(states, samples, HIDDEN, GAP_MAX);
    for (uint8_t state = INNER; state <= COVERED; ++state) {
        close_runs(states, samples, state, SWITCH_MAX);
    }
}

void burnish_line_art_trace(burnish_line_art *art, burnish_line_scene *scene, const uint32_t *chain,
                            size_t count, burnish_memory *memory) {
    uint8_t states[SAMPLES_MAX];
    cursor c = {chain, count, 0, 0, burnish_line_length(&art->segments[chain[0] / 2])};
    const double length = chain_length(art, chain, count);
    const size_t samples = length < SAMPLES_MAX - 2 ? (size_t)length + 1 : SAMPLES_MAX;
    const double step = length / (double)samples;
    const int feature = art->segments[chain[0] / 2].is_feature;
    const double least = !scene->taken ? SHORTEST : feature == 1 ? STUB : scene->hidden_fold;
    if (scene->taken && (feature == 2 || length <= least)) {
        return;
    }
    look_along(art, scene, c, samples, step, states);
    for (size_t first = 0, end; first < samples; first = end) {
        end = run_end(states, first, samples);
        const int was_covered = first > 0 && states[first - 1] == COVERED;
        const int is_covered = end < samples && states[end] == COVERED;
        const double from = (double)first * step - was_covered * COVERS;
        const double to = (double)end * step + is_covered * COVERS;
        const int is_stub = states[first] == INNER && to - from < STUB && end - first < samples &&
                            !scene->keeps_all;
        if (states[first] != HIDDEN && states[first] != COVERED && to - from > least && !is_stub) {
            const chain_part part = {from > 0 ? from : 0, to < length ? to : length,
                                     states[first] == INNER && (scene->taken || feature == 2)
                                         ? BURNISH_LINE_NARROW * scene->outline
                                     : states[first] == INNER ? scene->inner
                                                              : scene->outline,
                                     states[first] == RIM};
            (scene->taken ? add_dashes : add_line)(art, &c, &part, memory);
        }
    }
}
