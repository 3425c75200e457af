/* Generated normals: union-find over the corners that meet in a vertex, joined across smooth edges.
 */

#include <float.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "mesh/build/builder.h"

#define DEGREE (3.14159265358979323846 / 180)

/* Edges with at most this many faces at a vertex are compared face by face, so that the order of
 * the faces does not matter; beyond it only neighbors in that order are, so that the cost stays
 * linear. */
enum { PAIRWISE_MAX = 8 };

/* A sum shorter than this share of its weights is rounding noise around zero. */
#define CANCELLED 1e-9

/* Shorter vectors, sums weighted by the tip of a needle, have squares that lose bits to underflow;
 * a power of two lengthens them. */
#define SHORT_LENGTH 0x1p-400
#define LENGTHEN 0x1p600

void burnish_store_unit(burnish_vec3 v, float unit[3]) {
    double length = burnish_vec3_length(v);
    if (length < SHORT_LENGTH) {
        v = burnish_vec3_scale(v, LENGTHEN);
        length = burnish_vec3_length(v);
    }
    double scale = length > 0 && length <= DBL_MAX ? 1 / length : 0;
    unit[0] = unit[1] = unit[2] = 0;
    if (scale > 0) {
        /* Adding 0 turns -0 into 0, so that equal normals have equal bits. */
        unit[0] = (float)(v.x * scale) + 0.0f;
        unit[1] = (float)(v.y * scale) + 0.0f;
        unit[2] = (float)(v.z * scale) + 0.0f;
    }
}

void burnish_rings_create(burnish_rings *rings, size_t capacity, double crease_angle, int wide,
                          burnish_memory *memory) {
    const char *what = "generating normals";
    const size_t padded = capacity + PAIRWISE_MAX;
    double sine;
    *rings = (burnish_rings){.flat = crease_angle <= 0, .wide = wide, .capacity = capacity};
    burnish_sincos(crease_angle * DEGREE, &sine, &rings->crease_cosine);
    double **doubles[] = {&rings->x,       &rings->y,    &rings->z,
                          &rings->lengths, &rings->dots, &rings->angles};
    uint32_t **numbers[] = {&rings->next, &rings->previous, &rings->parents};
    for (int i = 0; i < 6; ++i) {
        *doubles[i] = burnish_allocate(memory, padded, sizeof **doubles[i], what);
    }
    for (int i = 0; i < 3; ++i) {
        *numbers[i] = burnish_allocate(memory, padded, sizeof **numbers[i], what);
    }
    rings->sums = burnish_allocate(memory, capacity, sizeof *rings->sums, what);
    rings->edges = burnish_allocate(memory, capacity, 2 * sizeof *rings->edges, what);
}

void burnish_rings_destroy(burnish_rings *rings, const burnish_context *context) {
    void *arrays[] = {rings->x,       rings->y,      rings->z,    rings->lengths,
                      rings->dots,    rings->angles, rings->next, rings->previous,
                      rings->parents, rings->sums,   rings->edges};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i) {
        burnish_release(context, arrays[i]);
    }
    *rings = (burnish_rings){0};
}

/* ---- faces ---- */

/* From squared lengths to lengths, and unit normals by them. Area makes the length positive: the
 * square of the smallest product does not underflow. */
static inline __attribute__((always_inline)) void
normalize_faces(double *restrict lengths, double *restrict x, double *restrict y,
                double *restrict z, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        double length = __builtin_sqrt(lengths[i]), scale = 1 / length;
        lengths[i] = length;
        x[i] = x[i] * scale;
        y[i] = y[i] * scale;
        z[i] = z[i] * scale;
    }
}
#if defined(__x86_64__)
__attribute__((target("avx2"))) static void normalize_faces_avx2(const burnish_rings *rings,
                                                                 size_t count) {
    normalize_faces(rings->lengths, rings->x, rings->y, rings->z, count);
}
#endif

void burnish_rings_measure(burnish_rings *rings, const float *positions,
                           const uint32_t *corner_positions, const uint32_t *corners,
                           size_t count) {
    static const uint8_t after[5] = {0, 1, 2, 0, 1};
    for (size_t i = 0; i < count; ++i) {
        const uint32_t *face = corner_positions + corners[i] / 3 * (size_t)3;
        uint32_t at = corners[i] % 3, second = after[at + 1], third = after[at + 2];
        const burnish_vec3 points[3] = {burnish_vec3_loadf(positions + 3 * (size_t)face[0]),
                                        burnish_vec3_loadf(positions + 3 * (size_t)face[1]),
                                        burnish_vec3_loadf(positions + 3 * (size_t)face[2])};
        burnish_vec3 a = burnish_vec3_sub(points[second], points[at]);
        burnish_vec3 b = burnish_vec3_sub(points[third], points[at]);
        burnish_vec3 cross = burnish_vec3_cross(burnish_vec3_sub(points[1], points[0]),
                                                burnish_vec3_sub(points[2], points[0]));
        rings->x[i] = cross.x;
        rings->y[i] = cross.y;
        rings->z[i] = cross.z;
        rings->lengths[i] = burnish_vec3_dot(cross, cross);
        rings->dots[i] = burnish_vec3_dot(a, b);
        rings->next[i] = face[second];
        rings->previous[i] = face[third];
    }
#if defined(__x86_64__)
    if (rings->wide) {
        normalize_faces_avx2(rings, count);
    } else
#endif
    {
        normalize_faces(rings->lengths, rings->x, rings->y, rings->z, count);
    }
    if (!rings->flat) {
        burnish_atan2_array(rings->lengths, rings->dots, rings->angles, count, rings->wide);
    }
}

static burnish_vec3 face_normal(const burnish_rings *rings, size_t i) {
    return (burnish_vec3){rings->x[i], rings->y[i], rings->z[i]};
}

/* ---- joining ---- */

static uint32_t find_root(uint32_t *parents, uint32_t i) {
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

/* Joins faces i and j of the vertex when the edge between them is smooth; the smaller root stays
 * one. Returns 1 when two sets became one. */
static int join(burnish_rings *rings, size_t first, uint32_t i, uint32_t j) {
    if (burnish_vec3_dot(face_normal(rings, first + i), face_normal(rings, first + j)) <=
        rings->crease_cosine) {
        return 0;
    }
    i = find_root(rings->parents, i);
    j = find_root(rings->parents, j);
    if (i < j) {
        rings->parents[j] = i;
    } else {
        rings->parents[i] = j;
    }
    return i != j;
}

/* For each face of a few the set of those that it shares a smooth edge with, as bits. Without
 * branches: what a face shares with another can't be predicted. */
static void find_neighbors(const burnish_rings *rings, size_t first, size_t count,
                           uint32_t neighbors[PAIRWISE_MAX]) {
    const uint32_t *next = rings->next + first, *previous = rings->previous + first;
    for (size_t i = 0; i < count; ++i) {
        neighbors[i] = 0;
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_vec3 normal = face_normal(rings, first + i);
        for (size_t j = i + 1; j < count; ++j) {
            int edge = (next[i] == previous[j]) | (previous[i] == next[j]) | (next[i] == next[j]) |
                       (previous[i] == previous[j]);
            double cosine = burnish_vec3_dot(normal, face_normal(rings, first + j));
            uint32_t joined = (uint32_t)(edge & (cosine > rings->crease_cosine));
            neighbors[i] |= joined << j;
            neighbors[j] |= joined << i;
        }
    }
}

#if defined(__x86_64__)
/* The same, all of the others at once: the dot product has the same bits from either side. Reads
 * PAIRWISE_MAX entries from `first` on. */
__attribute__((target("avx2"))) static void find_neighbors_avx2(const burnish_rings *rings,
                                                                size_t first, size_t count,
                                                                uint32_t neighbors[PAIRWISE_MAX]) {
    const double *x = rings->x + first, *y = rings->y + first, *z = rings->z + first;
    __m256d crease = _mm256_set1_pd(rings->crease_cosine);
    __m256i next = _mm256_loadu_si256((const __m256i *)(rings->next + first));
    __m256i previous = _mm256_loadu_si256((const __m256i *)(rings->previous + first));
    for (size_t i = 0; i < count; ++i) {
        __m256d at_x = _mm256_set1_pd(x[i]), at_y = _mm256_set1_pd(y[i]);
        __m256d at_z = _mm256_set1_pd(z[i]);
        int smooth = 0;
        for (int half = 0; half < PAIRWISE_MAX; half += 4) {
            __m256d cosine =
                _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(at_x, _mm256_loadu_pd(x + half)),
                                            _mm256_mul_pd(at_y, _mm256_loadu_pd(y + half))),
                              _mm256_mul_pd(at_z, _mm256_loadu_pd(z + half)));
            smooth |= _mm256_movemask_pd(_mm256_cmp_pd(cosine, crease, _CMP_GT_OQ)) << half;
        }
        __m256i at_next = _mm256_set1_epi32((int)rings->next[first + i]);
        __m256i at_previous = _mm256_set1_epi32((int)rings->previous[first + i]);
        __m256i edge = _mm256_or_si256(_mm256_or_si256(_mm256_cmpeq_epi32(at_next, previous),
                                                       _mm256_cmpeq_epi32(at_previous, next)),
                                       _mm256_or_si256(_mm256_cmpeq_epi32(at_next, next),
                                                       _mm256_cmpeq_epi32(at_previous, previous)));
        uint32_t joined = (uint32_t)(smooth & _mm256_movemask_ps(_mm256_castsi256_ps(edge)));
        neighbors[i] = joined & ((1U << count) - 1) & ~(1U << i);
    }
}
#endif

/* Sets of joined faces among a few; returns 1 when they are one, and leaves parents alone then. */
static int join_few(burnish_rings *rings, size_t first, size_t count) {
    uint32_t neighbors[PAIRWISE_MAX], all = (1U << count) - 1, left = all;
#if defined(__x86_64__)
    if (rings->wide) {
        find_neighbors_avx2(rings, first, count, neighbors);
    } else
#endif
    {
        find_neighbors(rings, first, count, neighbors);
    }
    for (uint32_t root = 0; left != 0; ++root) {
        uint32_t set = 1U << root, before;
        if (!(left & set)) {
            continue;
        }
        do {
            before = set;
            for (size_t i = 0; i < count; ++i) {
                set |= neighbors[i] & (0U - (set >> i & 1));
            }
        } while (set != before);
        if (set == all) {
            return 1;
        }
        for (size_t i = 0; i < count; ++i) {
            if (set >> i & 1) {
                rings->parents[i] = root;
            }
        }
        left &= ~set;
    }
    return 0;
}

#define SORT_TYPE uint64_t
#define SORT_NAME(name) sort_edge_##name
#define SORT_LESS(a, b) (*(a) < *(b))
#define SORT_INSERTION_MAX 40
#include "mesh/build/sort.h"

/* The same for any number, by sorting the edges by their other end, then by face. */
static int join_many(burnish_rings *rings, size_t first, size_t count) {
    uint64_t *edges = rings->edges;
    size_t joined = 0;
    for (size_t i = 0; i < count; ++i) {
        rings->parents[i] = (uint32_t)i;
        edges[2 * i] = (uint64_t)rings->next[first + i] << 32 | i;
        edges[2 * i + 1] = (uint64_t)rings->previous[first + i] << 32 | i;
    }
    sort_edge_array(edges, 2 * count);
    for (size_t start = 0, end; start < 2 * count; start = end) {
        for (end = start + 1; end < 2 * count && edges[end] >> 32 == edges[start] >> 32; ++end) {
        }
        size_t reach = end - start <= PAIRWISE_MAX ? PAIRWISE_MAX : 1;
        for (size_t i = start; i < end; ++i) {
            for (size_t j = i + 1; j < end && j <= i + reach; ++j) {
                joined += (size_t)join(rings, first, (uint32_t)edges[i], (uint32_t)edges[j]);
            }
        }
    }
    return joined + 1 == count;
}

/* ---- normals ---- */

static burnish_vec3 weighted_normal(const burnish_rings *rings, size_t i) {
    return burnish_vec3_scale(face_normal(rings, i), rings->angles[i]);
}

/* No angle is larger than pi, so the share of one weight also is a share of the largest. */
static int is_cancelled(double length, double angle) {
    return !(length > CANCELLED * angle);
}

/* The normal of all faces together; returns 0 when it cancels for one of them. */
static int store_common(const burnish_rings *rings, size_t first, size_t count, float *normal) {
    burnish_vec3 sum = {0, 0, 0};
    for (size_t i = first; i < first + count; ++i) {
        sum = burnish_vec3_add(sum, weighted_normal(rings, i));
    }
    double length = burnish_vec3_length(sum);
    for (size_t i = first; i < first + count; ++i) {
        if (is_cancelled(length, rings->angles[i])) {
            return 0;
        }
    }
    burnish_store_unit(sum, normal);
    return 1;
}

int burnish_rings_normals(burnish_rings *rings, size_t first, size_t count, float *normals) {
    if (rings->flat) {
        for (size_t i = 0; i < count; ++i) {
            burnish_store_unit(face_normal(rings, first + i), normals + 3 * i);
        }
        return 0;
    }
    int one =
        count <= PAIRWISE_MAX ? join_few(rings, first, count) : join_many(rings, first, count);
    if (one && store_common(rings, first, count, normals)) {
        return 1;
    }
    for (size_t i = 0; i < count && one; ++i) {
        rings->parents[i] = 0;
    }
    for (size_t i = 0; i < count; ++i) {
        rings->sums[i] = (burnish_vec3){0, 0, 0};
    }
    for (size_t i = 0; i < count; ++i) {
        uint32_t root = find_root(rings->parents, (uint32_t)i);
        rings->sums[root] = burnish_vec3_add(rings->sums[root], weighted_normal(rings, first + i));
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_vec3 sum = rings->sums[find_root(rings->parents, (uint32_t)i)];
        int cancelled = is_cancelled(burnish_vec3_length(sum), rings->angles[first + i]);
        burnish_store_unit(cancelled ? face_normal(rings, first + i) : sum, normals + 3 * i);
    }
    return 0;
}
