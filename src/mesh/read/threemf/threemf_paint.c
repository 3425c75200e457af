/* Painted triangles of slicers (TriangleSelector.cpp of PrusaSlicer, Bambu Studio and OrcaSlicer): a
 * tree that splits a triangle by middles of its edges, with a filament per leaf.
 *
 * The code is hexadecimal and read from its end. Of a node's digit, bits 0-1 are the number of
 * edges that are split. Of a leaf, bits 2-3 are the filament, or 3 if more digits follow. Of others,
 * they are the edge that differs; then the children follow, the last one first.
 *
 * Neighbours may be split to different depths. Middles are therefore kept by their edges, and at
 * the end each triangle is split at those of its neighbours: a closed surface remains closed. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include "mesh/read/io/budget.h"

enum {
    DEPTH_MOST = 24, /* an edge's 2^24th part: a float has no middles beyond */
    ROOM = 3 * DEPTH_MOST + 4
};

/* ---- Codes ---- */

typedef struct code_reader {
    const char *code;
    size_t left;
} code_reader;

/* The next digit; -1 at the end of the code, and for other characters. */
static int next_digit(code_reader *reader) {
    return reader->left > 0 ? burnish_threemf_digit(reader->code[--reader->left]) : -1;
}

typedef struct code_node {
    int splits, special;
    uint32_t filament;
} code_node;

static int next_node(code_reader *reader, code_node *node) {
    int digit = next_digit(reader);
    if (digit < 0) {
        return 0;
    }
    *node = (code_node){digit & 3, (digit & 3) < 3 ? (digit >> 2) % 3 : 0, (uint32_t)digit >> 2};
    if (node->splits == 0 && node->filament == 3) {
        do {
            digit = next_digit(reader);
            node->filament += digit > 0 ? (uint32_t)digit : 0;
        } while (digit == 15);
    }
    return digit >= 0;
}

int burnish_threemf_is_paint(const char *code) {
    code_reader reader = {code, strlen(code)};
    uint8_t left[DEPTH_MOST + 1] = {1}; /* children to come, on each level */
    size_t depth = 0;
    code_node node;
    do {
        if (!next_node(&reader, &node) || (node.splits > 0 && depth == DEPTH_MOST)) {
            return 0;
        }
        --left[depth];
        if (node.splits > 0) {
            left[++depth] = (uint8_t)(node.splits + 1);
        }
        while (depth > 0 && left[depth] == 0) {
            --depth;
        }
    } while (left[depth] > 0);
    return 1;
}

/* ---- Middles of edges ---- */

static size_t hash_edge(uint32_t a, uint32_t b, size_t mask) {
    const uint64_t mixed = ((uint64_t)a << 32 | b) * 0x9E3779B97F4A7C15u;
    return (size_t)(mixed >> 32) & mask;
}

/* The slot of an edge, or the empty one where it belongs. */
static burnish_threemf_middle *find_slot(const burnish_threemf *threemf, uint32_t a, uint32_t b) {
    const size_t mask = threemf->middle_room - 1;
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t at = hash_edge(low, high, mask);
    while (threemf->middles[at].vertex &&
           (threemf->middles[at].ends[0] != low || threemf->middles[at].ends[1] != high)) {
        at = (at + 1) & mask;
    }
    return &threemf->middles[at];
}

/* Keeps a third of the slots empty. */
static int grow_middles(burnish_threemf *threemf) {
    burnish_threemf_middle *old = threemf->middles;
    const size_t room = threemf->middle_room;
    if (3 * (threemf->middle_count + 1) < 2 * room) {
        return 1;
    }
    threemf->middle_room = room > 0 ? 2 * room : 1024;
    threemf->middles = burnish_allocate_zeroed(threemf->memory, threemf->middle_room,
                                               sizeof *threemf->middles, "painting");
    for (size_t i = 0; i < room && threemf->middles; ++i) {
        if (old[i].vertex) {
            *find_slot(threemf, old[i].ends[0], old[i].ends[1]) = old[i];
        }
    }
    threemf->middle_room = threemf->middles ? threemf->middle_room : 0;
    burnish_release(threemf->memory->context, old);
    return threemf->middles != NULL;
}

/* The vertex in the middle of an edge, which is made at its first use. Returns 0 on failure. */
static uint32_t middle_of(burnish_threemf *threemf, burnish_threemf_object *object, uint32_t a,
                          uint32_t b) {
    if (!grow_middles(threemf)) {
        return 0;
    }
    burnish_threemf_middle *slot = find_slot(threemf, a, b);
    if (slot->vertex == 0) {
        burnish_threemf_position *to = BURNISH_THREEMF_APPEND(threemf, &threemf->vertices);
        if (!to || threemf->vertices.count > BURNISH_VALUE_LIMIT) {
            return 0;
        }
        const burnish_threemf_position *from = threemf->vertices.items + object->first_vertex;
        for (int k = 0; k < 3; ++k) {
            to->xyz[k] = (float)(((double)from[a].xyz[k] + (double)from[b].xyz[k]) / 2);
        }
        *slot = (burnish_threemf_middle){{a < b ? a : b, a < b ? b : a}, object->vertex_count++};
        ++threemf->middle_count;
    }
    return slot->vertex;
}

/* ---- Triangles ---- */

int burnish_threemf_add_triangle(burnish_threemf *threemf, burnish_threemf_object *object,
                                 const burnish_threemf_triangle *triangle) {
    if (threemf->triangles.count >= burnish_budget_triangles(threemf->reader)) {
        threemf->status = burnish_budget_check(threemf->reader, threemf->vertices.count,
                                               threemf->triangles.count + 1);
        if (threemf->status == BURNISH_STATUS_OK) {
            threemf->status = burnish_fail_triangles(threemf->reader, NULL);
        }
        return 0;
    }
    burnish_threemf_triangle *to = BURNISH_THREEMF_APPEND(threemf, &threemf->triangles);
    if (to) {
        *to = *triangle;
        ++object->triangle_count;
    }
    return to != NULL;
}

/* Puts the children of a node on the stack, the one that the code has first on top. `t` has the
 * corners from the special one on; `m` the middles of t0 t1, t1 t2, t2 t0. */
static size_t split_node(const code_node *node, const uint32_t t[3], const uint32_t m[3],
                         uint32_t (*stack)[3]) {
    const uint32_t children[4][4][3] = {
        {{0}},
        {{t[0], t[1], m[1]}, {m[1], t[2], t[0]}},
        {{t[0], m[0], m[2]}, {m[0], t[1], m[2]}, {t[1], t[2], m[2]}},
        {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[1], t[2], m[2]}, {m[0], m[1], m[2]}}};
    memcpy(stack, children[node->splits], (size_t)(node->splits + 1) * sizeof *stack);
    return (size_t)node->splits + 1;
}

int burnish_threemf_paint(burnish_threemf *threemf, burnish_threemf_object *object,
                          const burnish_threemf_triangle *triangle, const char *code) {
    static const uint8_t edges[4] = {0, 2, 5, 7}; /* bit k: edge k of split_node has a middle */
    code_reader reader = {code, strlen(code)};
    uint32_t stack[ROOM][3];
    size_t count = 1;
    memcpy(stack[0], triangle->corners, sizeof stack[0]);
    while (count > 0) {
        code_node node = {0, 0, 0};
        uint32_t t[3], m[3] = {0};
        next_node(&reader, &node);
        for (int k = 0; k < 3; ++k) {
            t[k] = stack[count - 1][(k + node.special) % 3];
        }
        --count;
        if (node.splits == 0) {
            burnish_threemf_triangle piece = *triangle;
            memcpy(piece.corners, t, sizeof t);
            piece.paint = node.filament;
            threemf->paint_most =
                node.filament > threemf->paint_most ? node.filament : threemf->paint_most;
            if (!burnish_threemf_add_triangle(threemf, object, &piece)) {
                return 0;
            }
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            if (edges[node.splits] >> k & 1) {
                m[k] = middle_of(threemf, object, t[k], t[(k + 1) % 3]);
                if (m[k] == 0) {
                    return 0;
                }
            }
        }
        count += split_node(&node, t, m, stack + count);
    }
    return 1;
}

/* Splits a triangle at the middles of its edges. */
static int join_triangle(burnish_threemf *threemf, burnish_threemf_object *object,
                         const burnish_threemf_triangle *triangle) {
    uint32_t stack[4 * ROOM][3];
    size_t count = 1;
    memcpy(stack[0], triangle->corners, sizeof stack[0]);
    while (count > 0) {
        uint32_t t[3], middle = 0;
        int edge = 0;
        memcpy(t, stack[--count], sizeof t);
        for (; edge < 3 && !middle && count + 2 < 4 * ROOM; edge += !middle) {
            middle = find_slot(threemf, t[edge], t[(edge + 1) % 3])->vertex;
        }
        if (middle) {
            const uint32_t a = t[edge], b = t[(edge + 1) % 3], c = t[(edge + 2) % 3];
            const uint32_t halves[2][3] = {{a, middle, c}, {middle, b, c}};
            memcpy(stack + count, halves, sizeof halves);
            count += 2;
            continue;
        }
        burnish_threemf_triangle piece = *triangle;
        memcpy(piece.corners, t, sizeof t);
        if (!burnish_threemf_add_triangle(threemf, object, &piece)) {
            return 0;
        }
    }
    return 1;
}

int burnish_threemf_join_paint(burnish_threemf *threemf, burnish_threemf_object *object) {
    const uint32_t count = object->triangle_count;
    int is_fine = 1;
    if (threemf->middle_count == 0) {
        return 1;
    }
    object->triangle_count = 0;
    for (uint32_t i = 0; i < count && is_fine; ++i) {
        const burnish_threemf_triangle triangle =
            threemf->triangles.items[object->first_triangle + i];
        is_fine = join_triangle(threemf, object, &triangle);
    }
    memmove(threemf->triangles.items + object->first_triangle,
            threemf->triangles.items + object->first_triangle + count,
            object->triangle_count * sizeof *threemf->triangles.items);
    threemf->triangles.count -= count;
    memset(threemf->middles, 0, threemf->middle_room * sizeof *threemf->middles);
    threemf->middle_count = 0;
    return is_fine;
}

#endif
