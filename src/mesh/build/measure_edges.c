/* Edges, and what they reveal: openings, shells, inconsistent windings, duplicates.
 *
 * A degenerate triangle with three different corners has edges like any other: exporters fill
 * T-junctions with such triangles, and without them a closed surface would seem to have slits. A
 * triangle with a repeated corner has no edges, since its two sides are one edge, there and back.
 *
 * Each edge is listed once per triangle with the lesser of its positions, and the list of a
 * position is sorted by the greater. Triangles are joined in sets by union-find, in which each
 * knows whether it is to be turned against the first of its set. */
#include "mesh/build/measure.h"

#define SORT_TYPE uint64_t
#define SORT_NAME(name) sort_side_##name
#define SORT_LESS(a, b) (*(a) < *(b))
#define SORT_INSERTION_MAX 24 /* a position is the lesser one of about six sides */
#include "mesh/build/sort.h"

/* A set's triangles that are to be turned: no choice makes the windings agree. */
#define UNORIENTABLE UINT32_MAX

/* A triangle in its set: a tree, identified by its root. */
typedef struct member {
    uint32_t link;         /* twice the parent, + 1: turned against it; a root is its own parent */
    uint32_t size, turned; /* of a root: triangles in the set, and those turned against the root */
} member;

typedef struct edges {
    const burnish_measured *m;
    burnish_mesh_facts *facts;
    uint32_t *first;  /* of each position: where its sides start in ... */
    uint64_t *sides;  /* ... the greater position << 32 | 3 triangle + corner where it starts */
    member *members;  /* one per triangle */
    size_t repeating; /* triangles with a repeated corner */
    int unbalanced;   /* 1: an odd number of triangles shares some edge */
} edges;

/* ---- Listing ---- */

static const uint8_t following[3] = {1, 2, 0};

static uint32_t lesser(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

static uint32_t greater(uint32_t a, uint32_t b) {
    return a > b ? a : b;
}

static void count_sides(void *context, size_t first, size_t end) {
    edges *e = context;
    for (size_t i = first; i < end; ++i) {
        const uint32_t *corners = e->m->corners + 3 * i;
        e->members[i] = (member){.link = 2 * (uint32_t)i, .size = 1};
        for (int k = 0; k < 3; ++k) {
            e->m->marks[corners[k]] |= BURNISH_MARK_USED;
        }
        if (burnish_repeats_corner(corners)) {
            ++e->repeating;
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            ++e->first[lesser(corners[k], corners[following[k]]) + (size_t)2];
        }
    }
}

static void place_sides(void *context, size_t first, size_t end) {
    const edges *e = context;
    for (size_t i = first; i < end; ++i) {
        const uint32_t *corners = e->m->corners + 3 * i;
        for (size_t k = 0; k < 3 && !burnish_repeats_corner(corners); ++k) {
            const uint32_t a = corners[k], b = corners[following[k]];
            e->sides[e->first[lesser(a, b) + (size_t)1]++] =
                (uint64_t)greater(a, b) << 32 | (3 * i + k);
        }
    }
}

static void sort_sides(void *context, size_t first, size_t end) {
    const edges *e = context;
    for (size_t i = first; i < end; ++i) {
        sort_side_array(e->sides + e->first[i], e->first[i + 1] - e->first[i]);
    }
}

/* The sides of every position, sorted. The counting sort keeps its counts two entries ahead, so
 * filling leaves the starts in place. */
static burnish_status list_sides(edges *e) {
    const burnish_measured *m = e->m;
    burnish_tasks_in_order(m->tasks, m->triangle_count, BURNISH_BUILD_STEP, count_sides, e);
    burnish_status status = burnish_tasks_check(m->tasks, m->memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 2; i < m->position_count + 2; ++i) {
        e->first[i] += e->first[i - 1];
        e->facts->vertex_count += m->marks[i - 2] & BURNISH_MARK_USED;
    }
    burnish_tasks_in_order(m->tasks, m->triangle_count, BURNISH_BUILD_STEP, place_sides, e);
    status = burnish_tasks_check(m->tasks, m->memory->error);
    if (status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(m->tasks, m->position_count, BURNISH_BUILD_GRAIN, sort_sides, e);
        status = burnish_tasks_check(m->tasks, m->memory->error);
    }
    return status;
}

/* ---- Sets of triangles ---- */

/* Twice the root, + 1 if the triangle is turned against it; shortens the path. */
static uint32_t find_root(member *members, uint32_t triangle) {
    uint32_t turned = 0;
    while (members[triangle].link >> 1 != triangle) {
        const uint32_t link = members[triangle].link;
        members[triangle].link = members[link >> 1].link ^ (link & 1);
        turned ^= members[triangle].link & 1;
        triangle = members[triangle].link >> 1;
    }
    return triangle << 1 | turned;
}

/* Puts two triangles into one set; differs: one of them is to be turned against the other. */
static void join_members(member *members, uint32_t a, uint32_t b, uint32_t differs) {
    uint32_t root = find_root(members, a), other = find_root(members, b);
    const uint32_t turned = (root ^ other ^ differs) & 1;
    root >>= 1;
    other >>= 1;
    if (root == other) {
        members[root].turned = turned ? UNORIENTABLE : members[root].turned;
        return;
    }
    if (members[root].size < members[other].size) {
        const uint32_t smaller = root;
        root = other;
        other = smaller;
    }
    member *to = &members[root], *from = &members[other];
    from->link = root << 1 | turned;
    if (to->turned == UNORIENTABLE || from->turned == UNORIENTABLE) {
        to->turned = UNORIENTABLE;
    } else {
        to->turned += turned ? from->size - from->turned : from->turned;
    }
    to->size += from->size;
}

/* In each set, the smaller group of triangles is turned. */
static void count_flipped(void *context, size_t first, size_t end) {
    const edges *e = context;
    for (size_t i = first; i < end; ++i) {
        const member *set = &e->members[i];
        if (set->link >> 1 != i) {
            continue;
        }
        if (set->turned == UNORIENTABLE) {
            ++e->facts->unorientable_count;
        } else {
            e->facts->flipped_count += lesser(set->turned, set->size - set->turned);
        }
    }
}

static void count_shells(void *context, size_t first, size_t end) {
    const edges *e = context;
    for (size_t i = first; i < end; ++i) {
        e->facts->shell_count += e->members[i].link >> 1 == i;
    }
}

/* ---- Edges ---- */

/* How many sides, from the first on, are of one edge. */
static size_t count_equal(const uint64_t *sides, size_t count) {
    size_t same = 1;
    while (same < count && sides[same] >> 32 == sides[0] >> 32) {
        ++same;
    }
    return same;
}

static uint32_t triangle_of(uint64_t side) {
    return (uint32_t)side / 3;
}

/* 1: the triangle runs from the lesser position to the greater. */
static uint32_t is_forward(const edges *e, uint64_t side) {
    return e->m->corners[(uint32_t)side] != side >> 32;
}

static void count_edge(edges *e, uint32_t position, const uint64_t *sides, size_t count) {
    burnish_mesh_facts *facts = e->facts;
    size_t forward = 0;
    for (size_t i = 0; i < count; ++i) {
        forward += is_forward(e, sides[i]);
    }
    ++facts->edge_count;
    facts->open_edge_count += count == 1;
    facts->non_manifold_edge_count += count > 2;
    facts->inconsistent_edge_count += count % 2 == 0 && 2 * forward != count;
    if (count % 2 != 0) {
        e->unbalanced = 1;
        e->m->marks[position] |= BURNISH_MARK_ODD;
        e->m->marks[sides[0] >> 32] |= BURNISH_MARK_ODD;
    }
    if (count == 2) {
        join_members(e->members, triangle_of(sides[0]), triangle_of(sides[1]), forward != 1);
    }
}

static void count_edges(void *context, size_t first, size_t end) {
    edges *e = context;
    for (size_t position = first; position < end; ++position) {
        const size_t stop = e->first[position + 1];
        for (size_t i = e->first[position], size; i < stop; i += size) {
            size = count_equal(e->sides + i, stop - i);
            count_edge(e, (uint32_t)position, e->sides + i, size);
        }
    }
}

/* The position of a side's triangle that is not on it. */
static uint32_t opposite_corner(const edges *e, uint64_t side) {
    const uint32_t corner = (uint32_t)side % 3;
    return e->m->corners[(uint32_t)side - corner + following[following[corner]]];
}

/* Triangles with the same corners share the edge of the two lesser ones; there they are counted by
 * the third. Overwrites the sides. */
static size_t count_duplicates(const edges *e, uint64_t *sides, size_t count) {
    size_t thirds = 0, duplicates = 0;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t third = opposite_corner(e, sides[i]);
        if (third > sides[i] >> 32) {
            sides[thirds++] = third;
        }
    }
    sort_side_array(sides, thirds);
    for (size_t i = 1; i < thirds; ++i) {
        duplicates += sides[i] == sides[i - 1];
    }
    return duplicates;
}

/* Joins across edges of more than two triangles, whose windings can't be compared. */
static void join_the_rest(void *context, size_t first, size_t end) {
    const edges *e = context;
    for (size_t position = first; position < end; ++position) {
        const size_t stop = e->first[position + 1];
        for (size_t i = e->first[position], size; i < stop; i += size) {
            uint64_t *sides = e->sides + i;
            size = count_equal(sides, stop - i);
            for (size_t k = 1; k < size && size > 2; ++k) {
                join_members(e->members, triangle_of(sides[0]), triangle_of(sides[k]), 0);
            }
            e->facts->duplicate_count += size > 1 ? count_duplicates(e, sides, size) : 0;
        }
    }
}

/* Every pass over positions or triangles. Each step needs the one before it. */
static burnish_status count_all(edges *e) {
    const burnish_measured *m = e->m;
    const struct {
        size_t count;
        burnish_range_task *run;
    } passes[] = {{m->position_count, count_edges},
                  {m->triangle_count, count_flipped},
                  {m->position_count, join_the_rest},
                  {m->triangle_count, count_shells}};
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < sizeof passes / sizeof *passes && status == BURNISH_STATUS_OK; ++i) {
        burnish_tasks_in_order(m->tasks, passes[i].count, BURNISH_BUILD_STEP, passes[i].run, e);
        status = burnish_tasks_check(m->tasks, m->memory->error);
    }
    e->facts->shell_count -= e->repeating;
    e->facts->is_closed = !e->unbalanced;
    e->facts->is_consistent = e->facts->inconsistent_edge_count == 0;
    return status;
}

burnish_status burnish_measure_edges(const burnish_measured *m, burnish_mesh_facts *facts) {
    const char *what = "measuring";
    burnish_memory *memory = m->memory;
    edges e = {.m = m, .facts = facts};
    e.first = burnish_allocate_zeroed(memory, m->position_count + 2, sizeof *e.first, what);
    e.sides = burnish_allocate(memory, m->triangle_count, 3 * sizeof *e.sides, what);
    e.members = burnish_allocate(memory, m->triangle_count, sizeof *e.members, what);
    burnish_status status = memory->status == BURNISH_STATUS_OK ? list_sides(&e) : memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = count_all(&e);
    }
    burnish_release(memory->context, e.first);
    burnish_release(memory->context, e.sides);
    burnish_release(memory->context, e.members);
    return status;
}
