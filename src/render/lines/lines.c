/* Which edges a drawing shows, and how they are chained. */
#include "render/lines/lines.h"

#include <string.h>

#include "core/vec3.h"
#include "image/text/strokes.h"
#include "render/lines/lines_steps.h"

enum {
    EDGE_BLOCK = 1 << 14, /* edges that a thread selects at a time */
    STEP = 1 << 16,       /* segments of a serial loop before it asks whether to end */
    CHAIN_MAX = 32000     /* pixels: a longer chain is traced in parts */
};

/* Triangles seen at a smaller angle count as seen edge on: in views along an axis the sides of a
 * part are, but for rounding. */
#define EDGE_ON_SINE 1e-5

#define INNER_SHARE 0.6 /* of the width of outlines: wireframes, and edges while noise is dropped */
#define TANGENT_GAP 2   /* widths of outlines, from where a tangent edge ends */

/* Lines shorter than these shares of the picture's smaller side are noise; see
 * burnish_line_limits. A set has at least SET_LEAST pixels. */
#define TICK_SHARE 0.02f
#define SET_SHARE 0.04f
#define FOLD_SHARE 0.06f
#define SET_LEAST 10.0f

/* Segments of a wireframe that are shorter than this, in pixels on average, are drawn thinner, down
 * to a share of their width, which keeps faces visible. */
#define DENSE_LENGTH 10.0
#define DENSE_LEAST 0.12

/* No segment's end: its number would be 2 * segment + 0 or 1. */
#define NO_LINK UINT32_MAX
#define BROKEN (UINT32_MAX - 1) /* of a joint: more than two segments meet */

/* ---- Projection ---- */

/* Cuts [*from, *to] of a + t (b - a) to where it is at least 0. Returns 0 where nothing is left. */
static int cut_positive(double a, double b, double *from, double *to) {
    if (a < 0 && b < 0) {
        return 0;
    }
    if (a < 0) {
        const double t = a / (a - b);
        *from = t > *from ? t : *from;
    } else if (b < 0) {
        const double t = a / (a - b);
        *to = t < *to ? t : *to;
    }
    return *from < *to;
}

static burnish_clip_point point_between(burnish_clip_point a, burnish_clip_point b, double t) {
    return (burnish_clip_point){a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z),
                                a.w + t * (b.w - a.w)};
}

static void store_end(const burnish_line_projection *p, burnish_clip_point c,
                      burnish_line_segment *segment, int end) {
    const double x = p->middle[0] + c.x / c.w, y = p->middle[1] - c.y / c.w;
    segment->x[end] = (float)(x > 0 ? x < p->size[0] ? x : p->size[0] : 0);
    segment->y[end] = (float)(y > 0 ? y < p->size[1] ? y : p->size[1] : 0);
    segment->key[end] = (float)burnish_line_key(p, c);
}

/* Ends on the screen, cut to what is before the camera and within the picture: the sides of the
 * picture are planes x = +-w middle. */
static void place_segment(const burnish_line_projection *p, const burnish_mesh_view *mesh,
                          const burnish_edge *edge, burnish_line_segment *segment) {
    const burnish_clip_point a =
        burnish_line_project(p, burnish_vec3_loadf(mesh->positions + 3 * (size_t)edge->ends[0]));
    const burnish_clip_point b =
        burnish_line_project(p, burnish_vec3_loadf(mesh->positions + 3 * (size_t)edge->ends[1]));
    const double wide = p->middle[0], high = p->middle[1];
    double from = 0, to = 1;
    const int is_inside = (cut_positive(a.w - a.z, b.w - b.z, &from, &to) &&
                           cut_positive(a.w * wide - a.x, b.w * wide - b.x, &from, &to) &&
                           cut_positive(a.w * wide + a.x, b.w * wide + b.x, &from, &to) &&
                           cut_positive(a.w * high - a.y, b.w * high - b.y, &from, &to) &&
                           cut_positive(a.w * high + a.y, b.w * high + b.y, &from, &to));
    segment->is_done = is_inside ? 0 : BURNISH_LINE_OUTSIDE;
    if (is_inside) {
        store_end(p, from > 0 ? point_between(a, b, from) : a, segment, 0);
        store_end(p, to < 1 ? point_between(a, b, to) : b, segment, 1);
    }
    segment->ends[0] = from > 0 ? BURNISH_LINE_CUT : edge->ends[0];
    segment->ends[1] = to < 1 ? BURNISH_LINE_CUT : edge->ends[1];
}

/* ---- Selection ---- */

/* What the tasks of a frame share. */
typedef struct selection {
    burnish_line_art *art;
    const burnish_mesh_view *mesh;
    const burnish_render_options *options;
    burnish_line_projection projection;
    int fills; /* 1: segments have room */
} selection;

static void find_facing(void *context, size_t first, size_t end) {
    const selection *s = context;
    for (size_t i = first; i < end; ++i) {
        const uint32_t *corners = s->mesh->indices + 3 * i;
        const burnish_vec3 a = burnish_vec3_loadf(s->mesh->positions + 3 * (size_t)corners[0]);
        const burnish_vec3 b = burnish_vec3_loadf(s->mesh->positions + 3 * (size_t)corners[1]);
        const burnish_vec3 c = burnish_vec3_loadf(s->mesh->positions + 3 * (size_t)corners[2]);
        const burnish_vec3 normal =
            burnish_vec3_cross(burnish_vec3_sub(b, a), burnish_vec3_sub(c, a));
        const burnish_vec3 toward = s->projection.is_parallel
                                        ? s->projection.viewer
                                        : burnish_vec3_sub(s->projection.viewer, a);
        const double cosine = burnish_vec3_dot(normal, toward);
        const double square = burnish_vec3_dot(normal, normal) * burnish_vec3_dot(toward, toward);
        const int faces = cosine * cosine > EDGE_ON_SINE * EDGE_ON_SINE * square;
        s->art->facing[i] = (int8_t)(!faces ? 0 : cosine > 0 ? 1 : -1);
    }
}

/* On which side of the edge, seen along it on the screen, its triangles lie: 1 left, -1 right. */
static void edge_sides(const selection *s, const burnish_edge *edge, int sides[2]) {
    const int8_t *facing = s->art->facing;
    sides[0] = facing[edge->triangles[0]];
    sides[1] = 0;
    if (edge->triangles[1] != BURNISH_EDGE_OPEN) {
        const int other = facing[edge->triangles[1]];
        sides[1] = edge->flags & BURNISH_EDGE_ALIKE ? other : -other;
    }
}

static int is_feature(const burnish_edge *edge, int wanted) {
    const int is_open = edge->triangles[1] == BURNISH_EDGE_OPEN;
    return (wanted & BURNISH_EDGES_ALL) || ((wanted & BURNISH_EDGES_BOUNDARIES) && is_open) ||
           ((wanted & BURNISH_EDGES_CREASES) && edge->flags & BURNISH_EDGE_SHARP) ||
           ((wanted & BURNISH_EDGES_MATERIALS) && edge->flags & BURNISH_EDGE_MATERIAL);
}

/* Fills `segment`, unless it is NULL, and returns 1 where the edge is to be looked at. */
static int select_edge(const selection *s, const burnish_edge *edge,
                       burnish_line_segment *segment) {
    const int wanted = s->options->edges;
    const int8_t *facing = s->art->facing;
    int sides[2], feature = is_feature(edge, wanted);
    if (!feature && !(wanted & (BURNISH_EDGES_SILHOUETTES | BURNISH_EDGES_TANGENTS))) {
        return 0;
    }
    edge_sides(s, edge, sides);
    const int is_outline = sides[0] == sides[1] ? sides[0] != 0 : sides[0] == 0 || sides[1] == 0;
    if (!feature && !is_outline && wanted & BURNISH_EDGES_TANGENTS) {
        feature = edge->flags & BURNISH_EDGE_TANGENT ? 2 : 0;
    }
    if (!feature && !(is_outline && wanted & BURNISH_EDGES_SILHOUETTES)) {
        return 0;
    }
    const int has_front =
        facing[edge->triangles[0]] > 0 ||
        (edge->triangles[1] != BURNISH_EDGE_OPEN && facing[edge->triangles[1]] > 0);
    if (s->options->cull_back_faces && !has_front && !(wanted & BURNISH_EDGES_HIDDEN)) {
        return 0;
    }
    if (segment) {
        memcpy(segment->triangles, edge->triangles, sizeof segment->triangles);
        segment->outside = (int8_t)(is_outline ? -(sides[0] ? sides[0] : sides[1]) : 0);
        segment->has_front = (uint8_t)has_front;
        segment->is_feature = (uint8_t)feature;
        place_segment(&s->projection, s->mesh, edge, segment);
    }
    return 1;
}

/* Counts the segments of a block of edges, or fills those from block_counts[block] on. */
static void select_block(void *context, size_t block, int thread) {
    const selection *s = context;
    const burnish_edges *edges = &s->art->edges;
    const size_t first = block * EDGE_BLOCK;
    const size_t end = edges->count - first < EDGE_BLOCK ? edges->count : first + EDGE_BLOCK;
    burnish_line_segment *to = s->fills ? s->art->segments + s->art->block_counts[block] : NULL;
    size_t count = 0;
    (void)thread;
    for (size_t i = first; i < end; ++i) {
        count += (size_t)select_edge(s, &edges->items[i], to ? to + count : NULL);
    }
    if (!to) {
        s->art->block_counts[block] = count;
    }
}

/* The segments of a frame, in the order of edges. */
static burnish_status select_segments(selection *s, burnish_tasks *tasks, burnish_memory *memory) {
    burnish_line_art *art = s->art;
    const size_t triangles = s->mesh->triangle_count;
    const size_t blocks = (art->edges.count + EDGE_BLOCK - 1) / EDGE_BLOCK;
    size_t sum = 0;
    art->facing = burnish_reserve_discard(memory, art->facing, &art->facing_capacity, triangles,
                                          sizeof *art->facing, "facing of triangles");
    art->block_counts =
        burnish_reserve_discard(memory, art->block_counts, &art->block_capacity, blocks,
                                sizeof *art->block_counts, "counts of lines");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    burnish_tasks_ranges(tasks, triangles, EDGE_BLOCK, find_facing, s);
    burnish_tasks_run(tasks, blocks, 1, 0, select_block, s);
    burnish_status status = burnish_tasks_check(tasks, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < blocks; ++i) {
        const size_t count = art->block_counts[i];
        art->block_counts[i] = sum;
        sum += count;
    }
    art->segments = burnish_reserve_discard(memory, art->segments, &art->segment_capacity, sum,
                                            sizeof *art->segments, "lines");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    art->segment_count = sum;
    s->fills = 1;
    burnish_tasks_run(tasks, sum > 0 ? blocks : 0, 1, 0, select_block, s);
    return burnish_tasks_check(tasks, memory->error);
}

/* ---- Links: where exactly two segments of a kind meet ---- */

static void link_end(burnish_line_art *art, uint32_t end) {
    const uint32_t vertex = art->segments[end / 2].ends[end % 2];
    if (vertex == BURNISH_LINE_CUT) {
        return;
    }
    uint32_t *joint = &art->joints[vertex];
    if (*joint == NO_LINK) {
        *joint = end;
    } else if (*joint != BROKEN && art->links[*joint] == NO_LINK) {
        art->links[*joint] = end;
        art->links[end] = *joint;
    } else if (*joint != BROKEN) { /* a third one */
        art->links[art->links[*joint]] = NO_LINK;
        art->links[*joint] = NO_LINK;
        *joint = BROKEN;
    }
}

/* Joints are all NO_LINK before and afterwards. */
static burnish_status link_segments(burnish_line_art *art, const burnish_mesh_view *mesh,
                                    burnish_tasks *tasks, burnish_memory *memory) {
    const size_t count = art->segment_count;
    if (count >= BROKEN / 2) {
        return burnish_fail(memory->error, BURNISH_STATUS_LIMIT, "edges: more than 2^31 lines");
    }
    art->links = burnish_reserve_discard(memory, art->links, &art->link_capacity, 2 * count,
                                         sizeof *art->links, "lines");
    art->joints = burnish_reserve_discard(memory, art->joints, &art->joint_capacity,
                                          mesh->vertex_count, sizeof *art->joints, "joints");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    if (count > 0) {
        memset(art->links, 0xff, 2 * count * sizeof *art->links);
    }
    for (int features = 0; features < 3; ++features) {
        memset(art->joints, 0xff, mesh->vertex_count * sizeof *art->joints);
        for (size_t i = 0; i < count; ++i) {
            if (!art->segments[i].is_done && art->segments[i].is_feature == features) {
                link_end(art, (uint32_t)(2 * i));
                link_end(art, (uint32_t)(2 * i + 1));
            }
        }
    }
    return burnish_tasks_check(tasks, memory->error);
}

/* ---- Chains ---- */

/* A walk from segment to segment; each is walked once in a pass. */
typedef struct walk {
    burnish_line_art *art;
    burnish_line_scene *scene;
    burnish_memory *memory;
    uint8_t pass; /* BURNISH_LINE_VISIBLE or _HIDDEN */
    uint32_t *chain;
    size_t count, capacity;
    double length;
} walk;

static void end_chain(walk *w) {
    if (w->count > 0 && w->memory->status == BURNISH_STATUS_OK) {
        burnish_line_art_trace(w->art, w->scene, w->chain, w->count, w->memory);
    }
    w->count = 0;
    w->length = 0;
}

/* Walks from a segment's end, away from it, as far as links lead. */
static void walk_from(walk *w, uint32_t end) {
    burnish_line_art *art = w->art;
    while (end != NO_LINK && art->segments[end / 2].is_done != BURNISH_LINE_OUTSIDE &&
           art->segments[end / 2].is_done != w->pass) {
        burnish_line_segment *segment = &art->segments[end / 2];
        const double length = burnish_line_length(segment);
        if (w->length + length > CHAIN_MAX) {
            end_chain(w);
        }
        w->chain = burnish_reserve(w->memory, w->chain, &w->capacity, w->count + 1,
                                   sizeof *w->chain, "a chain of lines");
        if (w->memory->status != BURNISH_STATUS_OK) {
            return;
        }
        w->chain[w->count++] = end;
        w->length += length;
        segment->is_done = w->pass;
        end = art->links[end ^ 1];
    }
    end_chain(w);
}

/* Open chains from their ends, then closed ones. */
static void trace_chains(burnish_line_art *art, burnish_line_scene *scene, burnish_tasks *tasks,
                         burnish_memory *memory) {
    walk w = {.art = art,
              .scene = scene,
              .memory = memory,
              .pass = scene->taken ? BURNISH_LINE_HIDDEN : BURNISH_LINE_VISIBLE};
    for (int is_closed = 0; is_closed < 2; ++is_closed) {
        for (size_t i = 0; i < art->segment_count && memory->status == BURNISH_STATUS_OK; ++i) {
            const uint32_t end = (uint32_t)(2 * i);
            if (i % STEP == 0 && burnish_tasks_cancelled(tasks)) {
                break;
            }
            if (is_closed || art->links[end] == NO_LINK) {
                walk_from(&w, end);
            } else if (art->links[end + 1] == NO_LINK) {
                walk_from(&w, end + 1);
            }
        }
    }
    burnish_release(memory->context, w.chain);
}

/* ---- A frame ---- */

/* The mean length of segments in the picture. */
static double mean_length(const burnish_line_art *art) {
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < art->segment_count; ++i) {
        if (!art->segments[i].is_done) {
            sum += burnish_line_length(&art->segments[i]);
            ++count;
        }
    }
    return count > 0 ? sum / (double)count : 0;
}

static burnish_line_scene make_scene(const burnish_line_art *art, const burnish_mesh_view *mesh,
                                     const burnish_line_view *view,
                                     const burnish_render_options *options,
                                     const burnish_target *target) {
    const float *right = view->raster->rows[0], *forward = view->raster->rows[3];
    const double pixels = burnish_vec3_length(burnish_vec3_loadf(right));
    const double units = burnish_vec3_length(burnish_vec3_loadf(forward));
    burnish_line_scene scene = {.target = target,
                                .facing = art->facing,
                                .cap_facing = mesh->inside == BURNISH_INSIDE_BACK    ? -1
                                              : mesh->inside == BURNISH_INSIDE_FRONT ? 1
                                                                                     : 0,
                                .width = options->width,
                                .height = options->height,
                                .is_parallel = options->camera.orthographic_height > 0,
                                .outline = (double)options->edge_width,
                                .inner = INNER_SHARE * (double)options->edge_width,
                                .keeps_all = (options->edges & BURNISH_EDGES_ALL) != 0};
    if (scene.keeps_all) {
        const double dense = mean_length(art) / DENSE_LENGTH;
        scene.inner *= dense < DENSE_LEAST ? DENSE_LEAST : dense < 1 ? dense : 1;
    }
    scene.footprint = scene.is_parallel ? 1 / pixels : units / pixels;
    return scene;
}

/* The mesh's edges, unless they are there. */
static burnish_status update_edges(burnish_line_art *art, const burnish_mesh_view *mesh,
                                   int has_tangents, burnish_tasks *tasks, burnish_memory *memory) {
    if (art->mesh == mesh->serial && art->has_tangents >= has_tangents) {
        return BURNISH_STATUS_OK;
    }
    art->mesh = art->axes_mesh = 0;
    burnish_release(memory->context, art->edges.items);
    const burnish_status status = burnish_edges_find(mesh, tasks, memory, &art->edges);
    if (status == BURNISH_STATUS_OK && has_tangents) {
        burnish_edges_find_tangents(mesh, memory, &art->edges);
    }
    art->has_tangents = has_tangents;
    art->mesh = status == memory->status && status == BURNISH_STATUS_OK ? mesh->serial : 0;
    return status != BURNISH_STATUS_OK ? status : memory->status;
}

static float smaller_side(const burnish_render_options *options) {
    return (float)(options->width < options->height ? options->width : options->height);
}

static void drop_noise(burnish_line_art *art, const burnish_render_options *options,
                       burnish_memory *memory) {
    const float side = smaller_side(options);
    const burnish_line_limits limits = {.tick = TICK_SHARE * side > SET_LEAST ? TICK_SHARE * side
                                                                              : SET_LEAST,
                                        .least = SET_LEAST,
                                        .set = SET_SHARE * side,
                                        .fold = FOLD_SHARE * side,
                                        .outline = options->edge_width};
    if (memory->status == BURNISH_STATUS_OK && !(options->edges & BURNISH_EDGES_ALL)) {
        burnish_line_art_drop_loose(art, &limits, memory);
    }
}

/* Moves the ends of an open line inward. */
static void shorten_line(const burnish_line_art *art, size_t line, float by) {
    float *first = art->points + 2 * (size_t)art->starts[line];
    float *last = art->points + 2 * (size_t)art->starts[line + 1] - 2;
    for (int k = 0; k < 2 && (first[0] != last[0] || first[1] != last[1]); ++k) {
        float *end = k ? last : first, *next = k ? last - 2 : first + 2;
        const float dx = next[0] - end[0], dy = next[1] - end[1];
        const float share = by / __builtin_sqrtf(dx * dx + dy * dy);
        end[0] += (share < 0.25F ? share : 0.25F) * dx;
        end[1] += (share < 0.25F ? share : 0.25F) * dy;
    }
}

/* Visible edges and outlines have one width (ISO 128-3), unless they are faint or a wireframe. They
 * differ while noise is dropped. Tangent edges stay narrow, and end before other lines. */
static void widen_lines(burnish_line_art *art, const burnish_render_options *options) {
    const int is_drawing = options->edge_opacity == 1 && !(options->edges & BURNISH_EDGES_ALL);
    for (size_t i = 0; i < art->lines.line_count && is_drawing; ++i) {
        if (art->widths[i] == (float)BURNISH_LINE_NARROW * options->edge_width) {
            shorten_line(art, i, TANGENT_GAP * options->edge_width);
        } else {
            art->widths[i] = options->edge_width;
        }
    }
}

/* Appends dashes for what the surface hides and no line covers. */
static void trace_hidden(burnish_line_art *art, burnish_line_scene *scene,
                         const burnish_render_options *options, burnish_tasks *tasks,
                         burnish_memory *memory) {
    if (memory->status != BURNISH_STATUS_OK || !(options->edges & BURNISH_EDGES_HIDDEN)) {
        return;
    }
    scene->hidden_fold = (double)(FOLD_SHARE * smaller_side(options));
    scene->taken = burnish_allocate_zeroed(memory, (size_t)options->width * (size_t)options->height,
                                           sizeof *scene->taken, "hidden lines");
    if (memory->status == BURNISH_STATUS_OK) {
        burnish_line_scene_take(scene, &art->lines);
        trace_chains(art, scene, tasks, memory);
    }
    burnish_release(memory->context, scene->taken);
}

static void describe_lines(burnish_line_art *art, const burnish_render_options *options) {
    art->lines.width = options->width;
    art->lines.height = options->height;
    memcpy(art->lines.color, options->edge_color, sizeof art->lines.color);
    art->lines.opacity = options->edge_opacity;
    art->lines.points = art->points;
    art->lines.starts = art->starts;
    art->lines.widths = art->widths;
}

burnish_status burnish_line_art_update(burnish_line_art *art, const burnish_mesh_view *mesh,
                                       const burnish_line_view *view,
                                       const burnish_render_options *options,
                                       const burnish_target *target, burnish_tasks *tasks,
                                       burnish_memory *memory) {
    selection s = {art, mesh, options, burnish_line_project_view(view, options), 0};
    memset(&art->lines, 0, sizeof art->lines);
    burnish_status status =
        update_edges(art, mesh, (options->edges & BURNISH_EDGES_TANGENTS) != 0, tasks, memory);
    if (status == BURNISH_STATUS_OK) {
        status = select_segments(&s, tasks, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        status = link_segments(art, mesh, tasks, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_line_scene scene = make_scene(art, mesh, view, options, target);
        trace_chains(art, &scene, tasks, memory);
        describe_lines(art, options);
        drop_noise(art, options, memory);
        widen_lines(art, options);
        trace_hidden(art, &scene, options, tasks, memory);
        if (options->edges & BURNISH_EDGES_CENTERS) {
            describe_lines(art, options);
            burnish_line_art_add_centers(art, mesh, &scene, &s.projection, options, memory);
        }
        describe_lines(art, options);
        status = memory->status != BURNISH_STATUS_OK ? memory->status
                                                     : burnish_tasks_check(tasks, memory->error);
    }
    if (status != BURNISH_STATUS_OK) {
        memset(&art->lines, 0, sizeof art->lines);
    }
    return status;
}

burnish_status burnish_line_art_planes(burnish_line_art *art, const burnish_render_options *options,
                                       burnish_target *target, burnish_memory *memory) {
    const size_t width = (size_t)options->width, count = width * (size_t)options->height;
    if (!target->depth) {
        art->depth = burnish_reserve_discard(memory, art->depth, &art->depth_capacity, count,
                                             sizeof *art->depth, "depths for lines");
        target->depth = art->depth;
        target->depth_stride = width * sizeof *art->depth;
    }
    if (!target->triangles) {
        art->triangles =
            burnish_reserve_discard(memory, art->triangles, &art->triangle_capacity, count,
                                    sizeof *art->triangles, "triangles for lines");
        target->triangles = art->triangles;
        target->triangle_stride = width * sizeof *art->triangles;
    }
    return memory->status;
}

void burnish_line_art_drop_planes(burnish_line_art *art, const burnish_context *context) {
    burnish_release(context, art->depth);
    burnish_release(context, art->triangles);
    art->depth = NULL;
    art->triangles = NULL;
    art->depth_capacity = art->triangle_capacity = 0;
}

burnish_status burnish_line_art_draw(const burnish_line_art *art,
                                     const burnish_render_options *options,
                                     const burnish_pixels *pixels, burnish_tasks *tasks,
                                     burnish_memory *memory) {
    const burnish_lines *lines = &art->lines;
    const burnish_ink ink = burnish_ink_of(options->edge_color, options->edge_opacity);
    const size_t count = lines->point_count - lines->line_count;
    size_t made = 0;
    burnish_stroke *strokes = burnish_allocate(memory, count, sizeof *strokes, "strokes");
    if (!strokes) {
        return memory->status;
    }
    for (size_t i = 0; i < lines->line_count; ++i) {
        for (size_t k = lines->starts[i]; k + 1 < lines->starts[i + 1]; ++k) {
            const float *p = lines->points + 2 * k;
            strokes[made++] = (burnish_stroke){p[0], p[1], p[2], p[3], lines->widths[i] * 0.5f};
        }
    }
    const burnish_pixel_rows rows = {pixels, options->first_row, options->height};
    const burnish_status status =
        burnish_strokes_draw_rows(&rows, strokes, made, &ink, tasks, memory);
    burnish_release(memory->context, strokes);
    return status;
}

void burnish_line_art_destroy(burnish_line_art *art, const burnish_context *context) {
    void *const arrays[] = {art->axes.items, art->axes.circles, art->edges.items, art->joints,
                            art->facing,     art->block_counts, art->segments,    art->links,
                            art->points,     art->starts,       art->widths,      art->is_rim,
                            art->depth,      art->triangles,    art->axes.arcs};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        burnish_release(context, arrays[i]);
    }
    memset(art, 0, sizeof *art);
}
