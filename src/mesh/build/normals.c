/* Made normals: union-find over the corners that meet in a vertex, joined across smooth edges. */
#include "mesh/build/normals.h"

#include <float.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/memory.h"

#define DEGREE (3.14159265358979323846 / 180)

/* Edges with at most this many faces at a vertex are compared face by face, so that the order of
 * the faces does not matter; beyond it only neighbours in that order are, so that the cost stays
 * linear. */
enum { PAIRWISE_MAX = 8 };

/* Edges up to which insertion sort is faster than a heap. */
enum { INSERTION_MAX = 40 };

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

static burnish_status allocate_doubles(double **array, size_t count, burnish_error *error) {
    return burnish_legacy_allocate((void **)array, count, sizeof **array, "making normals", error);
}
static burnish_status allocate_numbers(uint32_t **array, size_t count, burnish_error *error) {
    return burnish_legacy_allocate((void **)array, count, sizeof **array, "making normals", error);
}

burnish_status burnish_fan_create(burnish_fan *fan, size_t capacity, double crease_angle,
                                  burnish_error *error) {
    double sine;
    *fan = (burnish_fan){.flat = crease_angle <= 0, .capacity = capacity};
#if defined(__x86_64__)
    fan->wide = __builtin_cpu_supports("avx2") != 0;
#endif
    burnish_sincos(crease_angle * DEGREE, &sine, &fan->crease_cosine);
    double **doubles[] = {&fan->x, &fan->y, &fan->z, &fan->lengths, &fan->dots, &fan->angles};
    uint32_t **numbers[] = {&fan->next, &fan->previous, &fan->parents};
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < 6 && status == BURNISH_STATUS_OK; ++i) {
        status = allocate_doubles(doubles[i], capacity + PAIRWISE_MAX, error);
    }
    for (size_t i = 0; i < 3 && status == BURNISH_STATUS_OK; ++i) {
        status = allocate_numbers(numbers[i], capacity + PAIRWISE_MAX, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&fan->sums, capacity, sizeof *fan->sums,
                                         "making normals", error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&fan->edges, capacity, 2 * sizeof *fan->edges,
                                         "making normals", error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_fan_destroy(fan);
    }
    return status;
}

void burnish_fan_destroy(burnish_fan *fan) {
    free(fan->x);
    free(fan->y);
    free(fan->z);
    free(fan->lengths);
    free(fan->dots);
    free(fan->angles);
    free(fan->next);
    free(fan->previous);
    free(fan->parents);
    free(fan->sums);
    free(fan->edges);
    *fan = (burnish_fan){0};
}

/* ---- faces ---- */

/* From squared lengths to lengths, and unit normals by them. Area makes the length positive: the
 * square of the smallest product does not underflow. */
static inline __attribute__((always_inline)) void unitise(double *restrict lengths,
                                                          double *restrict x, double *restrict y,
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
__attribute__((target("avx2"))) static void unitise_avx2(const burnish_fan *fan, size_t count) {
    unitise(fan->lengths, fan->x, fan->y, fan->z, count);
}
#endif

void burnish_fan_measure(burnish_fan *fan, const float *positions, const uint32_t *corner_vertices,
                         const uint32_t *corners, size_t count) {
    static const uint8_t after[5] = {0, 1, 2, 0, 1};
    for (size_t i = 0; i < count; ++i) {
        const uint32_t *face = corner_vertices + corners[i] / 3 * (size_t)3;
        uint32_t at = corners[i] % 3, second = after[at + 1], third = after[at + 2];
        const burnish_vec3 points[3] = {burnish_vec3_loadf(positions + 3 * (size_t)face[0]),
                                        burnish_vec3_loadf(positions + 3 * (size_t)face[1]),
                                        burnish_vec3_loadf(positions + 3 * (size_t)face[2])};
        burnish_vec3 a = burnish_vec3_sub(points[second], points[at]);
        burnish_vec3 b = burnish_vec3_sub(points[third], points[at]);
        burnish_vec3 cross = burnish_vec3_cross(burnish_vec3_sub(points[1], points[0]),
                                                burnish_vec3_sub(points[2], points[0]));
        fan->x[i] = cross.x;
        fan->y[i] = cross.y;
        fan->z[i] = cross.z;
        fan->lengths[i] = burnish_vec3_dot(cross, cross);
        fan->dots[i] = burnish_vec3_dot(a, b);
        fan->next[i] = face[second];
        fan->previous[i] = face[third];
    }
#if defined(__x86_64__)
    if (fan->wide) {
        unitise_avx2(fan, count);
    } else
#endif
    {
        unitise(fan->lengths, fan->x, fan->y, fan->z, count);
    }
    if (!fan->flat) {
        burnish_atan2_array(fan->lengths, fan->dots, fan->angles, count);
    }
}

static burnish_vec3 face_normal(const burnish_fan *fan, size_t i) {
    return (burnish_vec3){fan->x[i], fan->y[i], fan->z[i]};
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
static int join(burnish_fan *fan, size_t first, uint32_t i, uint32_t j) {
    if (burnish_vec3_dot(face_normal(fan, first + i), face_normal(fan, first + j)) <=
        fan->crease_cosine) {
        return 0;
    }
    i = find_root(fan->parents, i);
    j = find_root(fan->parents, j);
    if (i < j) {
        fan->parents[j] = i;
    } else {
        fan->parents[i] = j;
    }
    return i != j;
}

/* For each face of a few the set of those that it shares a smooth edge with, as bits. Without
 * branches: what a face shares with another can't be predicted. */
static void find_neighbours(const burnish_fan *fan, size_t first, size_t count,
                            uint32_t neighbours[PAIRWISE_MAX]) {
    const uint32_t *next = fan->next + first, *previous = fan->previous + first;
    for (size_t i = 0; i < count; ++i) {
        neighbours[i] = 0;
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_vec3 normal = face_normal(fan, first + i);
        for (size_t j = i + 1; j < count; ++j) {
            int edge = (next[i] == previous[j]) | (previous[i] == next[j]) | (next[i] == next[j]) |
                       (previous[i] == previous[j]);
            double cosine = burnish_vec3_dot(normal, face_normal(fan, first + j));
            uint32_t joined = (uint32_t)(edge & (cosine > fan->crease_cosine));
            neighbours[i] |= joined << j;
            neighbours[j] |= joined << i;
        }
    }
}

#if defined(__x86_64__)
/* The same, all of the others at once: the dot product has the same bits from either side. Reads
 * PAIRWISE_MAX entries from `first` on. */
__attribute__((target("avx2"))) static void
find_neighbours_avx2(const burnish_fan *fan, size_t first, size_t count,
                     uint32_t neighbours[PAIRWISE_MAX]) {
    const double *x = fan->x + first, *y = fan->y + first, *z = fan->z + first;
    __m256d crease = _mm256_set1_pd(fan->crease_cosine);
    __m256i next = _mm256_loadu_si256((const __m256i *)(fan->next + first));
    __m256i previous = _mm256_loadu_si256((const __m256i *)(fan->previous + first));
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
        __m256i at_next = _mm256_set1_epi32((int)fan->next[first + i]);
        __m256i at_previous = _mm256_set1_epi32((int)fan->previous[first + i]);
        __m256i edge = _mm256_or_si256(_mm256_or_si256(_mm256_cmpeq_epi32(at_next, previous),
                                                       _mm256_cmpeq_epi32(at_previous, next)),
                                       _mm256_or_si256(_mm256_cmpeq_epi32(at_next, next),
                                                       _mm256_cmpeq_epi32(at_previous, previous)));
        uint32_t joined = (uint32_t)(smooth & _mm256_movemask_ps(_mm256_castsi256_ps(edge)));
        neighbours[i] = joined & ((1U << count) - 1) & ~(1U << i);
    }
}
#endif

/* Sets of joined faces among a few; returns 1 when they are one, and leaves parents alone then. */
static int join_few(burnish_fan *fan, size_t first, size_t count) {
    uint32_t neighbours[PAIRWISE_MAX], all = (1U << count) - 1, left = all;
#if defined(__x86_64__)
    if (fan->wide) {
        find_neighbours_avx2(fan, first, count, neighbours);
    } else
#endif
    {
        find_neighbours(fan, first, count, neighbours);
    }
    for (uint32_t root = 0; left != 0; ++root) {
        uint32_t set = 1U << root, before;
        if (!(left & set)) {
            continue;
        }
        do {
            before = set;
            for (size_t i = 0; i < count; ++i) {
                set |= neighbours[i] & (0U - (set >> i & 1));
            }
        } while (set != before);
        if (set == all) {
            return 1;
        }
        for (size_t i = 0; i < count; ++i) {
            if (set >> i & 1) {
                fan->parents[i] = root;
            }
        }
        left &= ~set;
    }
    return 0;
}

static void sift_down(uint64_t *heap, size_t root, size_t count) {
    uint64_t value = heap[root];
    for (size_t child; (child = 2 * root + 1) < count; root = child) {
        child += child + 1 < count && heap[child] < heap[child + 1];
        if (value >= heap[child]) {
            break;
        }
        heap[root] = heap[child];
    }
    heap[root] = value;
}

static void sort_edges(uint64_t *edges, size_t count) {
    if (count <= INSERTION_MAX) {
        for (size_t i = 1; i < count; ++i) {
            uint64_t edge = edges[i];
            size_t j = i;
            for (; j > 0 && edge < edges[j - 1]; --j) {
                edges[j] = edges[j - 1];
            }
            edges[j] = edge;
        }
        return;
    }
    for (size_t i = count / 2; i > 0; --i) {
        sift_down(edges, i - 1, count);
    }
    for (size_t i = count - 1; i > 0; --i) {
        uint64_t last = edges[i];
        edges[i] = edges[0];
        edges[0] = last;
        sift_down(edges, 0, i);
    }
}

/* The same for any number, by sorting the edges by their other end, then by face. */
static int join_many(burnish_fan *fan, size_t first, size_t count) {
    uint64_t *edges = fan->edges;
    size_t joined = 0;
    for (size_t i = 0; i < count; ++i) {
        fan->parents[i] = (uint32_t)i;
        edges[2 * i] = (uint64_t)fan->next[first + i] << 32 | i;
        edges[2 * i + 1] = (uint64_t)fan->previous[first + i] << 32 | i;
    }
    sort_edges(edges, 2 * count);
    for (size_t start = 0, end; start < 2 * count; start = end) {
        for (end = start + 1; end < 2 * count && edges[end] >> 32 == edges[start] >> 32; ++end) {
        }
        size_t reach = end - start <= PAIRWISE_MAX ? PAIRWISE_MAX : 1;
        for (size_t i = start; i < end; ++i) {
            for (size_t j = i + 1; j < end && j <= i + reach; ++j) {
                joined += (size_t)join(fan, first, (uint32_t)edges[i], (uint32_t)edges[j]);
            }
        }
    }
    return joined + 1 == count;
}

/* ---- normals ---- */

static burnish_vec3 weighted_normal(const burnish_fan *fan, size_t i) {
    return burnish_vec3_scale(face_normal(fan, i), fan->angles[i]);
}

/* No angle is larger than pi, so the share of one weight also is a share of the largest. */
static int is_cancelled(double length, double angle) {
    return !(length > CANCELLED * angle);
}

/* The normal of all faces together; returns 0 when it cancels for one of them. */
static int store_common(const burnish_fan *fan, size_t first, size_t count, float *normal) {
    burnish_vec3 sum = {0, 0, 0};
    for (size_t i = first; i < first + count; ++i) {
        sum = burnish_vec3_add(sum, weighted_normal(fan, i));
    }
    double length = burnish_vec3_length(sum);
    for (size_t i = first; i < first + count; ++i) {
        if (is_cancelled(length, fan->angles[i])) {
            return 0;
        }
    }
    burnish_store_unit(sum, normal);
    return 1;
}

int burnish_fan_normals(burnish_fan *fan, size_t first, size_t count, float *normals) {
    if (fan->flat) {
        for (size_t i = 0; i < count; ++i) {
            burnish_store_unit(face_normal(fan, first + i), normals + 3 * i);
        }
        return 0;
    }
    int one = count <= PAIRWISE_MAX ? join_few(fan, first, count) : join_many(fan, first, count);
    if (one && store_common(fan, first, count, normals)) {
        return 1;
    }
    for (size_t i = 0; i < count && one; ++i) {
        fan->parents[i] = 0;
    }
    for (size_t i = 0; i < count; ++i) {
        fan->sums[i] = (burnish_vec3){0, 0, 0};
    }
    for (size_t i = 0; i < count; ++i) {
        uint32_t root = find_root(fan->parents, (uint32_t)i);
        fan->sums[root] = burnish_vec3_add(fan->sums[root], weighted_normal(fan, first + i));
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_vec3 sum = fan->sums[find_root(fan->parents, (uint32_t)i)];
        int cancelled = is_cancelled(burnish_vec3_length(sum), fan->angles[first + i]);
        burnish_store_unit(cancelled ? face_normal(fan, first + i) : sum, normals + 3 * i);
    }
    return 0;
}
