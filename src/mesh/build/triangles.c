/* The triangles that a mesh keeps: welded, turned to their normals, with area. */
#include <stdatomic.h>

#include "mesh/build/builder.h"
#include "mesh/build/measure.h"
#include "mesh/build/normals/creases.h"
#include "mesh/build/normals/faces.h"
#include "mesh/build/normals/normals.h"
#include "mesh/build/weld.h"

/* ---- positions ---- */

/* Moves the different positions to the head of their array; remap gives each position of the file
 * its number among them. */
static burnish_status weld_positions(burnish_builder *b, uint32_t *remap) {
    burnish_stream *stream = &b->data->streams[BURNISH_POSITION];
    burnish_status status = burnish_weld(stream->items, stream->count, b->data->tasks, b->memory,
                                         remap, stream->items, &b->position_count);
    if (status == BURNISH_STATUS_OK && b->position_count <= stream->count / 2) {
        stream->items = burnish_shrink(b->memory->context, stream->items, &stream->capacity,
                                       b->position_count, 3 * sizeof(float));
    }
    return status;
}

/* ---- the file's normals ---- */

typedef struct normals_context {
    float *normals;
    atomic_size_t missing;
} normals_context;

static void normalize_range(void *context, size_t first, size_t end) {
    normals_context *c = context;
    size_t missing = 0;
    for (size_t i = first; i < end; ++i) {
        float *n = c->normals + 3 * i;
        burnish_store_unit(burnish_vec3_loadf(n), n);
        missing += n[0] == 0 && n[1] == 0 && n[2] == 0;
    }
    atomic_fetch_add(&c->missing, missing);
}

/* Makes the file's normals unit vectors. Normals without a direction become 0 and are generated. */
static void normalize_file_normals(burnish_builder *b) {
    const burnish_stream *stream = &b->data->streams[BURNISH_NORMAL];
    const size_t corner_count = stream->corners ? 3 * b->data->triangle_count : 0;
    normals_context context = {.normals = stream->items};
    burnish_tasks_ranges(b->data->tasks, stream->count, BURNISH_BUILD_GRAIN, normalize_range,
                         &context);
    size_t missing = atomic_load(&context.missing);
    for (size_t i = 0; i < corner_count; ++i) {
        missing += stream->corners[i] == BURNISH_NONE;
    }
    b->normals_complete = stream->count > 0 && missing == 0;
}

/* ---- triangles ---- */

static void swap_corners(uint32_t *corners, size_t triangle) {
    if (corners) {
        const uint32_t second = corners[3 * triangle + 1];
        corners[3 * triangle + 1] = corners[3 * triangle + 2];
        corners[3 * triangle + 2] = second;
    }
}

/* Turns a triangle whose winding contradicts the file's normals. It comes before normals are
 * generated, because those follow the winding. */
static void orient_triangle(const burnish_builder *b, size_t triangle, burnish_vec3 cross) {
    burnish_vec3 sum = {0, 0, 0};
    const uint32_t *numbers = burnish_stream_corners(b->data, BURNISH_NORMAL) + 3 * triangle;
    const float *normals = burnish_normals(b->data);
    for (int i = 0; i < 3; ++i) {
        if (b->normals_complete || numbers[i] != BURNISH_NONE) { /* no direction adds 0 */
            sum = burnish_vec3_add(sum, burnish_vec3_loadf(normals + 3 * (size_t)numbers[i]));
        }
    }
    if (burnish_vec3_dot(cross, sum) < 0) {
        swap_corners(b->corner_positions, triangle);
        for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
            uint32_t *corners = b->data->streams[i].corners;
            swap_corners(corners != b->corner_positions ? corners : NULL, triangle);
        }
    }
}

static burnish_vec3 cross_of(const burnish_builder *b, size_t triangle) {
    return burnish_face_cross(burnish_positions(b->data), b->corner_positions + 3 * triangle);
}

/* ---- whether the file's normals are believed ---- */

/* Tools that average the normals of all faces at a vertex also do so at the edges of boxes and
 * machined parts, which then look like molten tin. A triangle is molten if all of this is true:
 *   - the file's normal at a corner is more than 35 degrees off the face;
 *   - an edge at this corner is sharp but smooth in the file: the faces differ by 60 degrees or more
 *     and have the same normal at the corner;
 *   - it is flat: part of a larger flat face, or sharp at all its edges.
 * Coarse characters also have normals far off their faces, and some sharp edges, but few flat faces.
 */
#define MOLTEN_COSINE 0.81915204428899178
#define SAME_COSINE 0.999
/* From this share of the area on, the file's normals are dropped. Of 79 public files with normals,
 * boxes and machined parts had 11 % and more, others at most 3 %, except for one cube with wrong
 * normals at 8 %. */
#define MOLTEN_SHARE 0.1

enum {
    MOLTEN_SAMPLES = 1 << 15, /* triangles that are examined, spread over the mesh */
    MOLTEN_FACES_MAX = 64     /* at a vertex; more are not searched, which bounds the time */
};

static burnish_vec3 file_normal(const burnish_builder *b, size_t corner) {
    const float *normal = burnish_file_normal(b->data, corner);
    return normal ? burnish_vec3_loadf(normal) : (burnish_vec3){0, 0, 0};
}

/* What the neighbours at edges of a triangle show: the file smooths a sharp edge; a neighbour is in
 * the same plane; an edge is neither flat nor sharp. */
enum { SMOOTHED = 1, FLAT = 2, BENT = 4 };

/* The neighbours at the two edges from a corner.
 *   unit  the normal of the corner's triangle, by winding */
static int look_around(const burnish_builder *b, size_t corner, burnish_vec3 unit, int is_off) {
    const size_t triangle = corner / 3, at = corner % 3;
    const uint32_t here = b->corner_positions[corner];
    const uint32_t after = b->corner_positions[3 * triangle + (at + 1) % 3];
    const uint32_t before = b->corner_positions[3 * triangle + (at + 2) % 3];
    const burnish_vec3 normal = file_normal(b, corner);
    const uint32_t *corners = b->corners + b->first_corner[here];
    const size_t count = b->first_corner[here + (size_t)1] - b->first_corner[here];
    int found = 0;
    for (size_t i = 0; i < count && count <= MOLTEN_FACES_MAX; ++i) {
        const size_t other = corners[i] / 3, other_at = corners[i] % 3;
        const uint32_t next = b->corner_positions[3 * other + (other_at + 1) % 3];
        const uint32_t previous = b->corner_positions[3 * other + (other_at + 2) % 3];
        const int is_wound_alike = next == before || previous == after;
        const burnish_vec3 cross = cross_of(b, other);
        if (other == triangle || (!is_wound_alike && next != after && previous != before) ||
            !burnish_has_area(cross)) {
            continue;
        }
        const double cosine =
            burnish_vec3_dot(burnish_vec3_normalize(cross), unit) * (is_wound_alike ? 1 : -1);
        if (cosine > BURNISH_SHARP_COSINE) {
            found |= cosine > BURNISH_COPLANAR_COSINE ? FLAT : BENT;
        } else if (is_off && burnish_vec3_dot(file_normal(b, corners[i]), normal) > SAME_COSINE) {
            found |= SMOOTHED;
        }
    }
    return found;
}

/* Whether a triangle is molten.
 *   cross      of its edges, length long
 *   by_edges   0: only the first condition, which needs no neighbours */
static int is_molten(const burnish_builder *b, size_t triangle, burnish_vec3 cross, double length,
                     int by_edges) {
    const uint32_t *numbers = burnish_stream_corners(b->data, BURNISH_NORMAL) + 3 * triangle;
    double heights[3] = {length, length, length}, least = 0;
    int found = 0;
    for (int k = 0; k < 3; ++k) {
        if (b->normals_complete || numbers[k] != BURNISH_NONE) {
            heights[k] = burnish_vec3_dot(
                cross, burnish_vec3_loadf(burnish_normals(b->data) + 3 * (size_t)numbers[k]));
        }
    }
    const double side = heights[0] + heights[1] + heights[2] < 0 ? -1 : 1; /* of a wrong winding */
    for (int k = 0; k < 3; ++k) {
        heights[k] = side * heights[k] - MOLTEN_COSINE * length;
        least = heights[k] < least ? heights[k] : least;
    }
    for (size_t k = 0; k < 3 && by_edges && least < 0; ++k) {
        found |=
            look_around(b, 3 * triangle + k, burnish_vec3_scale(cross, 1 / length), heights[k] < 0);
    }
    return by_edges ? (found & SMOOTHED) && ((found & FLAT) || !(found & BENT)) : least < 0;
}

/* The share of the area that is molten. */
static double molten_share(const burnish_builder *b, int by_edges) {
    const size_t step = b->data->triangle_count / MOLTEN_SAMPLES + 1;
    double all = 0, molten = 0;
    for (size_t i = 0; i < b->data->triangle_count; i += step) {
        const burnish_vec3 cross = cross_of(b, i);
        const double length = burnish_vec3_length(cross);
        all += length;
        molten += length > 0 && is_molten(b, i, cross, length, by_edges) ? length : 0;
    }
    return all > 0 ? molten / all : 0;
}

/* Drops the file's normals if too much is molten. Most files fail the first condition; only the
 * others need lists of corners. */
static burnish_status judge_normals(burnish_builder *b) {
    const uint64_t crowded_max = b->data->crowded_max;
    if (molten_share(b, 0) <= MOLTEN_SHARE) {
        return BURNISH_STATUS_OK;
    }
    b->data->crowded_max = 0; /* crowded vertices are skipped */
    b->triangle_count = b->data->triangle_count;
    const burnish_status status = burnish_build_list_corners(b);
    const double share = status == BURNISH_STATUS_OK ? molten_share(b, 1) : 0;
    burnish_release(b->memory->context, b->corners);
    burnish_release(b->memory->context, b->first_corner);
    b->corners = b->first_corner = NULL;
    b->max_faces = 0;
    b->data->crowded_max = crowded_max;
    if (share <= MOLTEN_SHARE) {
        return status;
    }
    burnish_mesh_data_drop(b->data, BURNISH_NORMAL);
    b->normals_complete = 0;
    b->normals_replaced = 1;
    burnish_mesh_data_warn(b->data,
                           "%s: its normals smooth the sharp edges of %.0f %% of the surface and "
                           "are replaced; set normals=file to keep them",
                           burnish_show_name(b->name).text, 100 * share);
    return b->memory->status;
}

/* Says that a given crease angle has no effect. */
static burnish_status check_crease_angle(burnish_builder *b) {
    if (b->crease_angle != BURNISH_CREASE_AUTO && b->normals_complete) {
        burnish_mesh_data_warn(b->data,
                               "%s: the crease angle has no effect, as every vertex has a normal "
                               "already; set normals=own to generate them",
                               burnish_show_name(b->name).text);
    }
    return b->memory->status;
}

/* ---- keeping ---- */

/* Triangles with area move to the head of their range. If a single thread takes the ranges in turn,
 * they move to the head of the whole array. */
typedef struct triangles_context {
    burnish_builder *b;
    const uint32_t *corners, *remap; /* remap NULL: corner_positions are there */
    size_t *kept;                    /* of each range; NULL: one after the other */
    size_t next;                     /* where the next one goes */
} triangles_context;

static void weld_corners(void *context, size_t first, size_t end) {
    const triangles_context *c = context;
    for (size_t i = 3 * first; i < 3 * end; ++i) {
        c->b->corner_positions[i] = c->remap[c->corners[i]];
    }
}

static void move_triangles(burnish_builder *b, size_t from, size_t to, size_t count) {
    uint16_t *materials = b->data->triangle_materials, *parts = b->data->triangle_parts;
    memmove(b->corner_positions + 3 * to, b->corner_positions + 3 * from, count * BURNISH_TRIPLE);
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        uint32_t *corners = b->data->streams[i].corners;
        if (corners && corners != b->corner_positions) {
            memmove(corners + 3 * to, corners + 3 * from, count * BURNISH_TRIPLE);
        }
    }
    if (materials) {
        memmove(materials + to, materials + from, count * sizeof *materials);
    }
    if (parts) {
        memmove(parts + to, parts + from, count * sizeof *parts);
    }
}

/* Keeps those of `count` triangles that have area. Returns the end of all kept. */
static size_t keep_some(burnish_builder *b, size_t first, size_t count, size_t next) {
    enum { SOME = 256 };
    uint8_t has_area[SOME];
    for (size_t i = first, size; i < first + count; i += size) {
        size = first + count - i < SOME ? first + count - i : SOME;
        burnish_find_areas(burnish_positions(b->data), b->corner_positions + 3 * i, size, b->wide,
                           has_area);
        for (size_t k = 0, run; k < size; k += run + 1) {
            const uint8_t *flat = memchr(has_area + k, 0, size - k);
            run = flat ? (size_t)(flat - has_area) - k : size - k;
            if (next != i + k && run > 0) {
                move_triangles(b, i + k, next, run);
            }
            next += run;
        }
    }
    return next;
}

/* The same, and turns them to the file's normals. */
static size_t orient_some(burnish_builder *b, size_t first, size_t count, size_t next) {
    for (size_t i = first; i < first + count; ++i) {
        const burnish_vec3 cross = cross_of(b, i);
        if (burnish_has_area(cross)) {
            orient_triangle(b, i, cross);
            if (next != i) {
                move_triangles(b, i, next, 1);
            }
            ++next;
        }
    }
    return next;
}

static void look_at_range(void *context, size_t first, size_t end) {
    triangles_context *c = context;
    burnish_builder *b = c->b;
    size_t next = c->kept ? first : c->next;
    if (c->remap) {
        weld_corners(c, first, end);
    }
    next = (b->data->streams[BURNISH_NORMAL].count > 0 ? orient_some
                                                       : keep_some)(b, first, end - first, next);
    if (c->kept) {
        c->kept[first / BURNISH_BUILD_GRAIN] = next - first;
    } else {
        c->next = next;
    }
}

/* Joins the triangles that the ranges have kept. */
static void join_ranges(triangles_context *c, size_t count) {
    for (size_t first = 0; first < count; first += BURNISH_BUILD_GRAIN) {
        const size_t kept = c->kept[first / BURNISH_BUILD_GRAIN];
        if (c->next != first) {
            move_triangles(c->b, first, c->next, kept);
        }
        c->next += kept;
    }
}

/* Keeps the triangles with area. */
static burnish_status keep_triangles(burnish_builder *b, triangles_context *context) {
    const size_t count = b->data->triangle_count;
    burnish_tasks *tasks = b->data->tasks;
    if (burnish_tasks_threads(tasks) > 1) {
        context->kept = burnish_allocate(b->memory, count / BURNISH_BUILD_GRAIN + 1,
                                         sizeof *context->kept, "triangles");
    }
    if (b->memory->status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(tasks, count, BURNISH_BUILD_GRAIN, look_at_range, context);
    }
    burnish_status status = b->memory->status == BURNISH_STATUS_OK
                                ? burnish_tasks_check(tasks, b->memory->error)
                                : b->memory->status;
    if (status == BURNISH_STATUS_OK && context->kept) {
        join_ranges(context, count);
    }
    burnish_release(b->memory->context, context->kept);
    b->triangle_count = context->next;
    if (status == BURNISH_STATUS_OK && context->next == 0) {
        return burnish_fail(b->memory->error, BURNISH_STATUS_FORMAT,
                            "%s: no triangle has any area; %zu triangle%s read, and a mesh needs "
                            "at least one whose corners are not on a line",
                            burnish_show_name(b->name).text, count, count == 1 ? " was" : "s were");
    }
    /* fewer are usual in sound files, and nothing that a user could see or repair */
    if (status == BURNISH_STATUS_OK && count - context->next >= (count + 1) / 2) {
        burnish_mesh_data_warn(b->data, "%s: %zu of %zu triangles have no area and were left out",
                               burnish_show_name(b->name).text, count - context->next, count);
        status = b->memory->status;
    }
    return status;
}

/* Whether some attribute is numbered as the file's positions are. */
static int shares_corners(const burnish_mesh_data *data) {
    int shared = 0;
    for (int i = BURNISH_NORMAL; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        shared |= data->streams[i].count > 0 && !data->streams[i].corners;
    }
    return shared;
}

typedef struct soup_context {
    const uint32_t *corners;
    atomic_int differs;
} soup_context;

static void compare_corners(void *context, size_t first, size_t end) {
    soup_context *c = context;
    uint32_t differs = (uint32_t)atomic_load(&c->differs);
    for (size_t i = first; i < end && !differs; i += BURNISH_BUILD_GRAIN) {
        const size_t next = end - i < BURNISH_BUILD_GRAIN ? end : i + BURNISH_BUILD_GRAIN;
        for (size_t k = i; k < next; ++k) {
            differs |= c->corners[k] ^ (uint32_t)k;
        }
    }
    if (differs) {
        atomic_store(&c->differs, 1);
    }
}

/* Whether every corner has a position of its own, in their order, and nothing else is numbered so:
 * then corners can get welded numbers at once. */
static int is_soup(const burnish_mesh_data *data) {
    const burnish_stream *stream = &data->streams[BURNISH_POSITION];
    soup_context context = {.corners = stream->corners};
    if (stream->count != 3 * data->triangle_count || shares_corners(data)) {
        return 0;
    }
    burnish_tasks_ranges(data->tasks, stream->count, BURNISH_BUILD_STEP, compare_corners, &context);
    return !atomic_load(&context.differs);
}

static void release_corners_of(burnish_builder *b, burnish_attribute attribute) {
    burnish_stream *stream = &b->data->streams[attribute];
    burnish_release(b->memory->context, stream->corners);
    stream->corners = NULL;
    stream->corner_capacity = 0;
}

/* Corners get the numbers of welded positions in place, unless an attribute still needs the numbers
 * of the file. */
static burnish_status place_corners(burnish_builder *b, triangles_context *context) {
    burnish_stream *stream = &b->data->streams[BURNISH_POSITION];
    const int shared = shares_corners(b->data), all_differ = b->position_count == stream->count;
    context->corners = b->corner_positions = stream->corners;
    if (shared && !all_differ) {
        b->corner_positions =
            burnish_allocate(b->memory, b->data->triangle_count, BURNISH_TRIPLE, "triangles");
    }
    b->corner_capacity = shared ? b->data->triangle_count : stream->corner_capacity;
    if (!shared) {
        stream->corners = NULL;
        stream->corner_capacity = 0;
    }
    if (all_differ) {
        context->remap = NULL;
    }
    return b->memory->status;
}

burnish_status burnish_build_triangles(burnish_builder *b) {
    const burnish_stream *stream = &b->data->streams[BURNISH_POSITION];
    if (b->normals == BURNISH_NORMALS_OWN) {
        burnish_mesh_data_drop(b->data, BURNISH_NORMAL);
    }
    const int soup = is_soup(b->data), judges = b->normals == BURNISH_NORMALS_AUTO &&
                                                b->data->streams[BURNISH_NORMAL].count > 0;
    uint32_t *remap =
        soup ? NULL : burnish_allocate(b->memory, stream->count, sizeof *remap, "welding");
    triangles_context context = {.b = b, .remap = remap};
    burnish_status status = b->memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = weld_positions(b, soup ? stream->corners : remap);
    }
    if (status == BURNISH_STATUS_OK) {
        status = place_corners(b, &context);
    }
    if (status == BURNISH_STATUS_OK && (b->measure || judges)) {
        if (context.remap) {
            burnish_tasks_ranges(b->data->tasks, b->data->triangle_count, BURNISH_BUILD_GRAIN,
                                 weld_corners, &context);
            context.remap = NULL;
        }
        status = burnish_tasks_check(b->data->tasks, b->memory->error);
        status = status == BURNISH_STATUS_OK && b->measure ? burnish_build_measure(b) : status;
    }
    if (status == BURNISH_STATUS_OK) {
        normalize_file_normals(b);
        status = judges ? judge_normals(b) : check_crease_angle(b);
        b->has_file_normals = b->data->streams[BURNISH_NORMAL].count > 0;
    }
    if (status == BURNISH_STATUS_OK) {
        status = keep_triangles(b, &context);
    }
    burnish_release(b->memory->context, remap);
    return status;
}

void burnish_build_release_numbers(burnish_builder *b) {
    if (b->corner_positions != b->data->streams[BURNISH_POSITION].corners) {
        burnish_release(b->memory->context, b->corner_positions);
    }
    b->corner_positions = NULL;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        release_corners_of(b, (burnish_attribute)i);
    }
}

void burnish_build_release_corners(burnish_builder *b, int extras) {
    if (b->corner_positions != b->data->streams[BURNISH_POSITION].corners) {
        burnish_release(b->memory->context, b->corner_positions);
    }
    burnish_release(b->memory->context, b->corners);
    burnish_release(b->memory->context, b->first_corner);
    burnish_release(b->memory->context, b->order);
    b->corners = b->first_corner = b->corner_positions = b->order = NULL;
    burnish_mesh_data_drop(b->data, BURNISH_NORMAL);
    if (!extras) {
        release_corners_of(b, BURNISH_POSITION);
        for (int i = BURNISH_EXTRA_ATTRIBUTES; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
            burnish_mesh_data_drop(b->data, (burnish_attribute)i);
        }
    }
}
