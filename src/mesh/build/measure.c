/* Area, volume and centre of mass by the divergence theorem.
 *
 * Sums are compensated, and taken per block of triangles. The blocks are added in their order, so
 * no digit depends on threads. Coordinates count from the middle of the bounding box: a part far
 * from the origin keeps its digits. */
#include "mesh/build/measure.h"

#include <float.h>

enum { BLOCK = 4096 }; /* triangles per block of the sums */

/* Volumes below this share of area times size are rounding noise around 0: the products of a
 * triangle are right to 2^-52, and their sums cancel. */
#define FLAT_VOLUME 1e-12

/* A sum and what its rounding lost (D. E. Knuth, "The Art of Computer Programming", 4.2.2). */
typedef struct sum {
    double value, lost;
} sum;

static void sum_add(sum *s, double term) {
    const double value = s->value + term, part = value - s->value;
    s->lost += (s->value - (value - part)) + (term - part);
    s->value = value;
}

static void add_sum(sum *s, const sum *other) {
    sum_add(s, other->value);
    s->lost += other->lost;
}

static double sum_total(const sum *s) {
    return s->value + s->lost;
}

/* The sums: twice the area, six times the volume, and both times three and four times the centre.
 */
enum { AREA, VOLUME, AREA_X, VOLUME_X = AREA_X + 3, SUM_COUNT = VOLUME_X + 3 };

typedef struct block {
    float low[3], high[3]; /* of the corners of triangles with area */
    size_t flat;           /* triangles without area */
    sum sums[SUM_COUNT];
} block;

typedef struct measuring {
    const burnish_measured *m;
    block *blocks;
    burnish_vec3 middle;
} measuring;

static size_t block_count(size_t triangles) {
    return triangles / BLOCK + (triangles % BLOCK > 0);
}

static size_t block_end(const burnish_measured *m, size_t index) {
    const size_t first = index * BLOCK;
    return m->triangle_count - first < BLOCK ? m->triangle_count : first + BLOCK;
}

static void widen_block(block *to, const float low[3], const float high[3]) {
    for (int axis = 0; axis < 3; ++axis) {
        to->low[axis] = low[axis] < to->low[axis] ? low[axis] : to->low[axis];
        to->high[axis] = high[axis] > to->high[axis] ? high[axis] : to->high[axis];
    }
}

static const block empty_block = {.low = {FLT_MAX, FLT_MAX, FLT_MAX},
                                  .high = {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

static void bound_block(void *context, size_t index, int thread) {
    const measuring *c = context;
    const burnish_measured *m = c->m;
    block *b = &c->blocks[index];
    (void)thread;
    *b = empty_block;
    for (size_t i = index * BLOCK, end = block_end(m, index); i < end; ++i) {
        const uint32_t *corners = m->corners + 3 * i;
        if (!burnish_has_area(burnish_face_cross(m->positions, corners))) {
            ++b->flat;
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const float *p = m->positions + 3 * (size_t)corners[k];
            widen_block(b, p, p);
        }
    }
}

/* The tetrahedron of a triangle and the middle has the volume a . (b x c) / 6, its centre is
 * (a + b + c) / 4; b x c and the triangle's own cross product give the same. */
static void sum_block(void *context, size_t index, int thread) {
    const measuring *c = context;
    const burnish_measured *m = c->m;
    sum *sums = c->blocks[index].sums;
    (void)thread;
    for (size_t i = index * BLOCK, end = block_end(m, index); i < end; ++i) {
        const uint32_t *corners = m->corners + 3 * i;
        const burnish_vec3 cross = burnish_face_cross(m->positions, corners);
        burnish_vec3 points[3];
        for (int k = 0; k < 3; ++k) {
            points[k] = burnish_vec3_sub(burnish_vec3_loadf(m->positions + 3 * (size_t)corners[k]),
                                         c->middle);
        }
        const burnish_vec3 center =
            burnish_vec3_add(burnish_vec3_add(points[0], points[1]), points[2]);
        const double area = burnish_vec3_length(cross), volume = burnish_vec3_dot(points[0], cross);
        const double terms[SUM_COUNT] = {area,
                                         volume,
                                         area * center.x,
                                         area * center.y,
                                         area * center.z,
                                         volume * center.x,
                                         volume * center.y,
                                         volume * center.z};
        for (int k = 0; k < SUM_COUNT; ++k) {
            sum_add(&sums[k], terms[k]);
        }
    }
}

/* From the sums of all blocks; `size` is the longest side of the bounding box. */
static void take_sums(const sum sums[SUM_COUNT], burnish_vec3 middle, double size,
                      burnish_mesh_facts *facts) {
    facts->area = sum_total(&sums[AREA]) / 2;
    facts->volume = sum_total(&sums[VOLUME]) / 6;
    const double volume = facts->volume < 0 ? -facts->volume : facts->volume;
    double least = FLAT_VOLUME * size; /* thickness of what is not flat */
    least = facts->join_tolerance > least ? facts->join_tolerance : least;
    facts->is_solid = facts->is_closed && facts->is_consistent && volume > least * facts->area;
    const sum *center = sums + (facts->is_solid ? VOLUME_X : AREA_X);
    const double divisor =
        facts->is_solid ? 4 * sum_total(&sums[VOLUME]) : 3 * sum_total(&sums[AREA]);
    const double from[3] = {middle.x, middle.y, middle.z};
    for (int axis = 0; axis < 3; ++axis) {
        facts->center_of_mass[axis] =
            from[axis] + (divisor != 0 ? sum_total(&center[axis]) / divisor : 0);
    }
}

static burnish_status measure_sizes(const burnish_measured *m, burnish_mesh_facts *facts) {
    const size_t count = block_count(m->triangle_count);
    measuring c = {.m = m};
    c.blocks = burnish_allocate(m->memory, count, sizeof *c.blocks, "measuring");
    if (m->memory->status != BURNISH_STATUS_OK) {
        return m->memory->status;
    }
    burnish_tasks_run(m->tasks, count, 1, 0, bound_block, &c);
    burnish_status status = burnish_tasks_check(m->tasks, m->memory->error);
    block all = empty_block;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        widen_block(&all, c.blocks[i].low, c.blocks[i].high);
        all.flat += c.blocks[i].flat;
    }
    if (status == BURNISH_STATUS_OK && all.flat < m->triangle_count) {
        const burnish_vec3 low = burnish_vec3_loadf(all.low), high = burnish_vec3_loadf(all.high);
        const burnish_vec3 sides = burnish_vec3_sub(high, low);
        double size = sides.x > sides.y ? sides.x : sides.y;
        size = sides.z > size ? sides.z : size;
        c.middle = burnish_vec3_scale(burnish_vec3_add(low, high), 0.5);
        burnish_tasks_run(m->tasks, count, 1, 0, sum_block, &c);
        status = burnish_tasks_check(m->tasks, m->memory->error);
        for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
            for (int k = 0; k < SUM_COUNT; ++k) {
                add_sum(&all.sums[k], &c.blocks[i].sums[k]);
            }
        }
        take_sums(all.sums, c.middle, size, facts);
    }
    facts->degenerate_count = all.flat;
    burnish_release(m->memory->context, c.blocks);
    return status;
}

burnish_status burnish_build_measure(burnish_builder *b) {
    burnish_measured m = {.positions = burnish_positions(b->data),
                          .corners = b->corner_positions,
                          .position_count = b->position_count,
                          .triangle_count = b->data->triangle_count - b->data->beside_count,
                          .tasks = b->data->tasks,
                          .memory = b->memory};
    burnish_mesh_facts *facts = &b->mesh->facts;
    facts->triangle_count = m.triangle_count;
    m.marks = burnish_allocate_zeroed(m.memory, m.position_count, sizeof *m.marks, "measuring");
    burnish_status status = m.marks ? burnish_measure_edges(&m, facts) : m.memory->status;
    if (status == BURNISH_STATUS_OK && !facts->is_closed) {
        status = burnish_measure_joined_edges(&m, facts);
    }
    burnish_release(m.memory->context, m.marks);
    if (status == BURNISH_STATUS_OK) {
        status = measure_sizes(&m, facts);
    }
    b->mesh->has_facts = status == BURNISH_STATUS_OK;
    return status;
}
