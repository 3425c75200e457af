/* Generated normals: sums over the faces around a vertex that joining.c has put into one set. */

#include "mesh/build/normals/creases.h"
#include "mesh/build/normals/faces.h"
#include "mesh/build/normals/joining.h"
#include <float.h>
#include <stddef.h>

#define DEGREE (3.14159265358979323846 / 180)

/* Shorter vectors, sums weighted by the tip of a needle, have squares that lose bits to underflow;
 * a power of two lengthens them. */
#define SHORT_LENGTH 0x1p-400
#define LENGTHEN 0x1p600

/* burnish_store_unit of a vector whose length is known. */
static void store_unit(burnish_vec3 v, double length, float unit[3]) {
    if (length < SHORT_LENGTH) {
        v = burnish_vec3_scale(v, LENGTHEN);
        length = burnish_vec3_length(v);
    }
    double scale = length > 0 && length <= DBL_MAX ? 1 / length : 0;
    unit[0] = unit[1] = unit[2] = 0;
    if (scale > 0) {
        /* Adding 0 turns -0 into 0: equal normals then have equal bits. */
        unit[0] = (float)(v.x * scale) + 0.0f;
        unit[1] = (float)(v.y * scale) + 0.0f;
        unit[2] = (float)(v.z * scale) + 0.0f;
    }
}

void burnish_store_unit(burnish_vec3 v, float unit[3]) {
    store_unit(v, burnish_vec3_length(v), unit);
}

void burnish_rings_create(burnish_rings *rings, size_t capacity, double crease_angle,
                          const burnish_surface *surface, int wide, burnish_memory *memory) {
    const char *what = "generating normals";
    const size_t padded = capacity + BURNISH_PAIRWISE_MAX;
    *rings = (burnish_rings){.surface = surface, .wide = wide, .capacity = capacity};
    if (crease_angle == BURNISH_CREASE_AUTO) {
        rings->asks = 1;
        rings->answers =
            burnish_allocate_zeroed(memory, BURNISH_ANSWERS, sizeof *rings->answers, what);
        rings->known = burnish_allocate_zeroed(memory, 1, sizeof *rings->known, what);
        rings->sharp_cosine = surface->is_organic ? BURNISH_ORGANIC_COSINE : BURNISH_SHARP_COSINE;
        rings->smooth_cosine = BURNISH_SMOOTH_COSINE;
    } else {
        double sine;
        burnish_sincos(crease_angle * DEGREE, &sine, &rings->sharp_cosine);
        rings->smooth_cosine = rings->sharp_cosine;
        rings->flat = crease_angle <= 0;
    }
    double **doubles[] = {&rings->x, &rings->y, &rings->z, &rings->lengths, &rings->angles};
    uint32_t **numbers[] = {&rings->next, &rings->previous, &rings->parents};
    for (int i = 0; i < 5; ++i) {
        *doubles[i] = burnish_allocate(memory, padded, sizeof **doubles[i], what);
    }
    for (int i = 0; i < 3; ++i) {
        *numbers[i] = burnish_allocate(memory, padded, sizeof **numbers[i], what);
    }
    rings->sets = burnish_allocate(memory, capacity, sizeof *rings->sets, what);
    rings->edges = burnish_allocate(memory, capacity, 2 * sizeof *rings->edges, what);
}

void burnish_rings_destroy(burnish_rings *rings, const burnish_context *context) {
    void *arrays[] = {rings->x,      rings->y,     rings->z,        rings->lengths,
                      rings->angles, rings->next,  rings->previous, rings->parents,
                      rings->sets,   rings->edges, rings->answers,  rings->known};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        burnish_release(context, arrays[i]);
    }
    *rings = (burnish_rings){0};
}

/* ---- normals ---- */

void burnish_rings_measure(burnish_rings *rings, const uint32_t *corners, size_t count) {
    const burnish_measured_faces to = {rings->x,      rings->y,    rings->z,       rings->lengths,
                                       rings->angles, rings->next, rings->previous};
    rings->corners = corners;
    burnish_measure_faces(rings->surface, corners, count, rings->wide, &to);
}

static burnish_vec3 weighted_normal(const burnish_rings *rings, size_t i) {
    return burnish_vec3_scale(burnish_ring_normal(rings, i), rings->angles[i]);
}

/* No angle is larger than pi, so the share of one weight also is a share of the largest. */
static int is_cancelled(double length, double angle) {
    return !(length > BURNISH_CANCELLED * angle);
}

static void add_face(burnish_face_set *set, const burnish_rings *rings, size_t i) {
    set->sum = burnish_vec3_add(set->sum, weighted_normal(rings, i));
    set->area += rings->lengths[i];
    set->largest = rings->lengths[i] > rings->lengths[set->largest] ? i : set->largest;
}

/* Whether a face is part of the flat face that the largest one of its set belongs to. */
static int is_flat(const burnish_face_set *set, const burnish_rings *rings, size_t i) {
    return burnish_vec3_dot(burnish_ring_normal(rings, i),
                            burnish_ring_normal(rings, set->largest)) > BURNISH_COPLANAR_COSINE;
}

/* The area of the flat face, once all faces of the set were added. */
static void add_flat_area(burnish_face_set *set, const burnish_rings *rings, size_t i) {
    set->flat_area += is_flat(set, rings, i) ? rings->lengths[i] : 0;
}

/* Whether the flat face gives its normal to the set: then that is summed up anew. */
static int is_dominated(burnish_face_set *set) {
    const double rest = set->area - set->flat_area;
    const int dominated = rest > 0 && set->flat_area >= BURNISH_FLAT_SHARE * rest;
    set->sum = dominated ? (burnish_vec3){0, 0, 0} : set->sum;
    return dominated;
}

static void add_if_flat(burnish_face_set *set, const burnish_rings *rings, size_t i) {
    if (is_flat(set, rings, i)) {
        set->sum = burnish_vec3_add(set->sum, weighted_normal(rings, i));
    }
}

/* The faces of a set that determine its normal, as bits: all of them, or the flat face. Four
 * partial sums, as vectors have them. */
static uint32_t choose_faces(const burnish_rings *rings, size_t first, size_t count) {
    double areas[4] = {0}, flat_areas[4] = {0};
    burnish_face_set set = {.largest = first};
    uint32_t flat = 0;
    for (size_t i = first; i < first + count; ++i) {
        areas[(i - first) % 4] += rings->lengths[i];
        set.largest = rings->lengths[i] > rings->lengths[set.largest] ? i : set.largest;
    }
    for (size_t i = first; i < first + count; ++i) {
        const uint32_t is_part = (uint32_t)is_flat(&set, rings, i);
        flat |= is_part << (i - first);
        flat_areas[(i - first) % 4] += is_part ? rings->lengths[i] : 0;
    }
    set.area = (areas[0] + areas[2]) + (areas[1] + areas[3]);
    set.flat_area = (flat_areas[0] + flat_areas[2]) + (flat_areas[1] + flat_areas[3]);
    return is_dominated(&set) ? flat : (1U << count) - 1;
}

/* The sum of a few faces in one set. */
static burnish_vec3 sum_few(const burnish_rings *rings, size_t first, size_t count) {
    uint32_t chosen = (1U << count) - 1;
    burnish_vec3 sum = {0, 0, 0};
    if (rings->asks) {
        chosen = choose_faces(rings, first, count);
    }
    for (size_t i = 0; i < count; ++i) {
        if (chosen >> i & 1) {
            sum = burnish_vec3_add(sum, weighted_normal(rings, first + i));
        }
    }
    return sum;
}

/* The sum of any number of faces in one set. */
static burnish_vec3 sum_many(const burnish_rings *rings, size_t first, size_t count) {
    burnish_face_set set = {.largest = first};
    for (size_t i = first; i < first + count; ++i) {
        add_face(&set, rings, i);
    }
    for (size_t i = first; i < first + count && rings->asks; ++i) {
        add_flat_area(&set, rings, i);
    }
    if (rings->asks && is_dominated(&set)) {
        for (size_t i = first; i < first + count; ++i) {
            add_if_flat(&set, rings, i);
        }
    }
    return set.sum;
}

/* The normal of all faces together; returns 0 when it cancels for one of them. */
static int store_common(const burnish_rings *rings, size_t first, size_t count, float *normal) {
    const burnish_vec3 sum = count <= BURNISH_PAIRWISE_MAX ? sum_few(rings, first, count)
                                                           : sum_many(rings, first, count);
    const double length = burnish_vec3_length(sum);
    if (is_cancelled(length, BURNISH_LARGEST_ANGLE)) {
        for (size_t i = first; i < first + count; ++i) {
            if (is_cancelled(length, rings->angles[i])) {
                return 0;
            }
        }
    }
    store_unit(sum, length, normal);
    return 1;
}

/* The set of a face of the vertex. */
static burnish_face_set *set_of(const burnish_rings *rings, size_t i) {
    return &rings->sets[burnish_find_root(rings->parents, (uint32_t)i)];
}

/* The sums of faces in several sets, or in one that cancels. */
static void sum_sets(burnish_rings *rings, size_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        rings->sets[i] = (burnish_face_set){.largest = first + i};
    }
    for (size_t i = 0; i < count; ++i) {
        add_face(set_of(rings, i), rings, first + i);
    }
    if (!rings->asks) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        add_flat_area(set_of(rings, i), rings, first + i);
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_face_set *set = &rings->sets[i];
        set->dominated = is_dominated(set);
    }
    for (size_t i = 0; i < count; ++i) {
        if (set_of(rings, i)->dominated) {
            add_if_flat(set_of(rings, i), rings, first + i);
        }
    }
}

/* The normals of the faces in some sets of many. */
static void store_sets(burnish_rings *rings, size_t first, size_t count, float *normals) {
    sum_sets(rings, first, count);
    for (size_t i = 0; i < count; ++i) {
        const burnish_vec3 sum = set_of(rings, i)->sum;
        int cancelled = is_cancelled(burnish_vec3_length(sum), rings->angles[first + i]);
        burnish_store_unit(cancelled ? burnish_ring_normal(rings, first + i) : sum,
                           normals + 3 * i);
    }
}

/* The sum of some faces of a few, as bits. */
static burnish_vec3 sum_set(const burnish_rings *rings, size_t first, uint32_t faces) {
    burnish_face_set set = {.largest = first + (size_t)__builtin_ctz(faces)};
    if ((faces & (faces - 1)) == 0) {
        return burnish_vec3_add(set.sum, weighted_normal(rings, set.largest));
    }
    for (uint32_t left = faces; left != 0; left &= left - 1) {
        add_face(&set, rings, first + (size_t)__builtin_ctz(left));
    }
    for (uint32_t left = rings->asks ? faces : 0; left != 0; left &= left - 1) {
        add_flat_area(&set, rings, first + (size_t)__builtin_ctz(left));
    }
    if (rings->asks && is_dominated(&set)) {
        for (uint32_t left = faces; left != 0; left &= left - 1) {
            add_if_flat(&set, rings, first + (size_t)__builtin_ctz(left));
        }
    }
    return set.sum;
}

/* The same for sets of a few. */
static void store_few(const burnish_rings *rings, size_t first, const uint32_t *sets, size_t count,
                      float *normals) {
    for (size_t k = 0; k < count; ++k) {
        const burnish_vec3 sum = sum_set(rings, first, sets[k]);
        const double length = burnish_vec3_length(sum);
        float unit[3];
        store_unit(sum, length, unit);
        for (uint32_t left = sets[k]; left != 0; left &= left - 1) {
            const size_t i = (size_t)__builtin_ctz(left);
            memcpy(normals + 3 * i, unit, sizeof unit);
            if (is_cancelled(length, rings->angles[first + i])) {
                burnish_store_unit(burnish_ring_normal(rings, first + i), normals + 3 * i);
            }
        }
    }
}

int burnish_rings_normals_of(burnish_rings *rings, size_t first, size_t count,
                             burnish_neighbors *neighbors, float *normals) {
    uint32_t sets[BURNISH_SETS_MAX];
    const size_t few = burnish_join_neighbors(rings, first, count, neighbors, sets);
    if (few == 1 && store_common(rings, first, count, normals)) {
        return 1;
    }
    store_few(rings, first, sets, few, normals);
    return 0;
}

int burnish_rings_normals(burnish_rings *rings, size_t first, size_t count, float *normals) {
    uint32_t sets[BURNISH_SETS_MAX];
    if (rings->flat) {
        for (size_t i = 0; i < count; ++i) {
            burnish_store_unit(burnish_ring_normal(rings, first + i), normals + 3 * i);
        }
        return 0;
    }
    const size_t few = count <= BURNISH_SETS_MAX ? burnish_join_few(rings, first, count, sets) : 0;
    const int one = few == 0 ? burnish_join_many(rings, first, count) : few == 1;
    if (one && store_common(rings, first, count, normals)) {
        return 1;
    }
    if (few > 0) {
        store_few(rings, first, sets, few, normals);
        return 0;
    }
    for (size_t i = 0; i < count && one; ++i) {
        rings->parents[i] = 0;
    }
    store_sets(rings, first, count, normals);
    return 0;
}
