/* Joins vertices that differ only by rounding, to recognise closed surfaces.
 *
 * Exporters write one vertex with different last digits for different triangles. Only vertices on
 * edges with an odd number of triangles are candidates. They are sorted by the cells of a grid that
 * is as wide as the tolerance, and taken in this order: a candidate joins the nearest leader within
 * the tolerance, or becomes one. No vertex moves by more than the tolerance along an axis, chains
 * can not form, and the result does not depend on threads. Points of a cell are within the
 * tolerance of each other but for rounding, so a cell has few leaders, and sorting dominates the
 * cost: O(n log n) for any input. */
#include <float.h>

#include "mesh/build/measure.h"
#include "mesh/data/box.h"

/* An axis has at most 2^20 cells, and a free one at both ends: neighbours never wrap around. */
enum { AXIS_BITS = 21 };

typedef struct candidate {
    uint64_t cell; /* x, y, z, AXIS_BITS each */
    uint32_t position;
} candidate;

static int candidate_less(const candidate *a, const candidate *b) {
    return a->cell != b->cell ? a->cell < b->cell : a->position < b->position;
}

#define SORT_TYPE candidate
#define SORT_NAME(name) sort_candidate_##name
#define SORT_LESS candidate_less
#define SORT_INSERTION_MAX 24
#include "mesh/build/sort.h"

/* Rows of three cells along z that may have leaders already, by x and y; the last is a cell's own.
 */
enum { ROWS = 5 };
static const int rows[ROWS][2] = {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1}, {0, 0}};

typedef struct joiner {
    const burnish_measured *m;
    burnish_box box;
    double tolerance;
    candidate *items; /* all candidates, sorted; the leaders so far take the place of the first */
    size_t count, leaders;
    size_t at[ROWS];  /* the first leader that may be in a row of the current cell */
    uint32_t *joined; /* of each position: the one that it becomes */
    size_t moved;     /* candidates that are not leaders */
    uint32_t *corners;
    size_t vanished; /* triangles whose corners became one */
} joiner;

static void bound_positions(void *context, size_t first, size_t end) {
    joiner *j = context;
    for (size_t i = first; i < end; ++i) {
        for (size_t k = 0; k < 3 && j->m->marks[i]; ++k) {
            const float value = j->m->positions[3 * i + k];
            j->box.low[k] = value < j->box.low[k] ? value : j->box.low[k];
            j->box.high[k] = value > j->box.high[k] ? value : j->box.high[k];
        }
    }
}

static void list_candidates(void *context, size_t first, size_t end) {
    joiner *j = context;
    for (size_t i = first; i < end; ++i) {
        uint64_t cell = 0;
        j->joined[i] = (uint32_t)i;
        if (!(j->m->marks[i] & BURNISH_MARK_ODD)) {
            continue; /* vertices of no triangle are beyond the bounds */
        }
        for (size_t k = 0; k < 3; ++k) {
            const double from = (double)j->m->positions[3 * i + k] - (double)j->box.low[k];
            cell = cell << AXIS_BITS | ((uint64_t)(from / j->tolerance) + 1);
        }
        j->items[j->count++] = (candidate){cell, (uint32_t)i};
    }
}

/* The largest difference of two positions along an axis. */
static double distance_of_positions(const joiner *j, uint32_t a, uint32_t b) {
    double most = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double d =
            (double)j->m->positions[3 * (size_t)a + k] - (double)j->m->positions[3 * (size_t)b + k];
        most = d > most ? d : -d > most ? -d : most;
    }
    return most;
}

/* BURNISH_NONE: there is none within the tolerance. */
static uint32_t nearest_leader(joiner *j, candidate c) {
    uint32_t best = BURNISH_NONE;
    double least = 0;
    for (int row = 0; row < ROWS; ++row) {
        const uint64_t middle = c.cell + ((uint64_t)(int64_t)rows[row][0] << 2 * AXIS_BITS) +
                                ((uint64_t)(int64_t)rows[row][1] << AXIS_BITS);
        while (j->at[row] < j->leaders && j->items[j->at[row]].cell < middle - 1) {
            ++j->at[row]; /* which never goes back: cells ascend */
        }
        for (size_t i = j->at[row]; i < j->leaders && j->items[i].cell <= middle + 1; ++i) {
            const double d = distance_of_positions(j, c.position, j->items[i].position);
            if (d <= j->tolerance && (best == BURNISH_NONE || d < least)) {
                best = j->items[i].position;
                least = d;
            }
        }
    }
    return best;
}

static void join_candidates(void *context, size_t first, size_t end) {
    joiner *j = context;
    for (size_t i = first; i < end; ++i) {
        const candidate c = j->items[i];
        const uint32_t leader = nearest_leader(j, c);
        if (leader == BURNISH_NONE) {
            j->items[j->leaders++] = c;
        } else {
            j->joined[c.position] = leader;
            ++j->moved;
        }
    }
}

static void join_corners(void *context, size_t first, size_t end) {
    joiner *j = context;
    for (size_t i = first; i < end; ++i) {
        const uint32_t *from = j->m->corners + 3 * i;
        uint32_t *to = j->corners + 3 * i;
        for (int k = 0; k < 3; ++k) {
            to[k] = j->joined[from[k]];
        }
        j->vanished += to[0] == to[1] && to[1] == to[2] && !burnish_repeats_corner(from);
    }
}

/* Every pass, each of which needs the one before. */
static burnish_status join_all(joiner *j) {
    const burnish_measured *m = j->m;
    burnish_tasks_in_order(m->tasks, m->position_count, BURNISH_BUILD_STEP, bound_positions, j);
    j->tolerance = burnish_box_longest_side(&j->box) * BURNISH_JOIN_TOLERANCE;
    burnish_status status = burnish_tasks_check(m->tasks, m->memory->error);
    if (status != BURNISH_STATUS_OK || !(j->tolerance > 0)) {
        return status;
    }
    burnish_tasks_in_order(m->tasks, m->position_count, BURNISH_BUILD_STEP, list_candidates, j);
    status = burnish_tasks_check(m->tasks, m->memory->error);
    if (status == BURNISH_STATUS_OK) {
        sort_candidate_array(j->items, j->count);
        burnish_tasks_in_order(m->tasks, j->count, BURNISH_BUILD_STEP, join_candidates, j);
        status = burnish_tasks_check(m->tasks, m->memory->error);
    }
    if (status == BURNISH_STATUS_OK && j->moved > 0) {
        burnish_tasks_in_order(m->tasks, m->triangle_count, BURNISH_BUILD_STEP, join_corners, j);
        status = burnish_tasks_check(m->tasks, m->memory->error);
    }
    return status;
}

/* Counts the edges once more, joined, and takes these facts if the surface is closed now. */
static burnish_status measure_joined(const joiner *j, burnish_mesh_facts *facts) {
    burnish_measured joined = *j->m;
    burnish_mesh_facts found = *facts;
    found.edge_count = found.open_edge_count = found.non_manifold_edge_count = 0;
    found.inconsistent_edge_count = found.shell_count = found.flipped_count = 0;
    found.unorientable_count = 0;
    joined.corners = j->corners;
    burnish_status status = burnish_measure_edges(&joined, &found);
    if (status == BURNISH_STATUS_OK && found.is_closed) {
        found.vertex_count = facts->vertex_count;
        found.duplicate_count = facts->duplicate_count;
        found.exact_open_edge_count = facts->open_edge_count;
        found.join_tolerance = j->tolerance;
        *facts = found;
    }
    return status;
}

burnish_status burnish_measure_joined_edges(const burnish_measured *m, burnish_mesh_facts *facts) {
    const char *what = "joining vertices";
    burnish_memory *memory = m->memory;
    joiner j = {.m = m, .box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}}};
    j.items = burnish_allocate(memory, m->position_count, sizeof *j.items, what);
    j.joined = burnish_allocate(memory, m->position_count, sizeof *j.joined, what);
    j.corners = burnish_allocate(memory, m->triangle_count, 3 * sizeof *j.corners, what);
    burnish_status status = memory->status == BURNISH_STATUS_OK ? join_all(&j) : memory->status;
    burnish_release(memory->context, j.items);
    burnish_release(memory->context, j.joined);
    if (status == BURNISH_STATUS_OK && j.moved > 0 && j.vanished == 0) {
        status = measure_joined(&j, facts);
    }
    burnish_release(memory->context, j.corners);
    return status;
}
