/* Generated normals: sums over the faces around a vertex that joining.c has put into one set. */

#include <float.h>
#include <stddef.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "mesh/build/creases.h"
#include "mesh/build/joining.h"

#define DEGREE (3.14159265358979323846 / 180)

/* A sum shorter than this share of its weights is rounding noise around zero. */
#define CANCELLED 1e-9
#define LARGEST_ANGLE 4 /* more than pi */

/* A flat face with so many times the area of the other faces gives its normal to all of them. */
#define FLAT_SHARE 4

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
        rings->known = burnish_allocate_zeroed(memory, BURNISH_KNOWN, sizeof *rings->known, what);
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

/* ---- faces ---- */

/* Faces are measured in blocks: scattered positions are brought together, then loops over arrays,
 * which compilers vectorise, compute. The operations and their order are the same for any width. */
enum {
    BLOCK = 64,
    LANES = 8 /* of the widest vectors: a block is filled up to a multiple */
};

/* The triangles of some corners, and where their faces go. */
typedef struct block {
    float positions[9][BLOCK]; /* x, y, z of the first corner, the second and the third */
    double dots[3][BLOCK];     /* of the two edges from each corner */
    uint8_t at[BLOCK];         /* 0..2: the corner that counts */
    double *x, *y, *z, *lengths, *angles;
} block;

#define QUARTER_PI 0x1.921fb54442d18p-1
#define TANGENT 0x1.a827999fcef32p-2 /* of pi / 8 */

/* atan(t) = t + t^3 (c[0] + c[1] t^2 + ...) for abs(t) <= tan(pi / 8), within 6e-18: a Chebyshev
 * expansion */
static const double arctangent[11] = {
    -0x1.5555555555555p-2, 0x1.999999999934cp-3, -0x1.2492492436201p-3, 0x1.c71c71853d7c8p-4,
    -0x1.745d0b28a7649p-4, 0x1.3b12630643e8ap-4, -0x1.10fa77b104ae8p-4, 0x1.dfe6497394f40p-5,
    -0x1.a0999c2994d42p-5, 0x1.4162bf84bf0bfp-5, -0x1.3a31b0297d745p-6};

/* By bits, since compilers make branches of ?: here. */
static inline __attribute__((always_inline)) double choose(int is, double yes, double no) {
    const uint64_t mask = is ? UINT64_MAX : 0;
    uint64_t first, second;
    memcpy(&first, &yes, sizeof first);
    memcpy(&second, &no, sizeof second);
    first = (first & mask) | (second & ~mask);
    memcpy(&yes, &first, sizeof yes);
    return yes;
}

/* The angle between two vectors, in (0, pi], within 5e-16: from the length of their cross product,
 * above 0, and their dot product. It is near 0, a right angle, or 45 degrees. */
static inline __attribute__((always_inline)) double angle_of(double length, double dot) {
    const double width = __builtin_fabs(dot);
    const int flat = length <= TANGENT * width, steep = width <= TANGENT * length;
    const double up = choose(flat, length, choose(steep, -width, length - width));
    const double along = choose(flat, width, choose(steep, length, length + width));
    const double base = choose(flat, 0, choose(steep, 2 * QUARTER_PI, QUARTER_PI));
    const double t = up / along, z = t * t;
    double sum = arctangent[10];
    for (int i = 9; i >= 0; --i) {
        sum = sum * z + arctangent[i];
    }
    const double angle = base + (t + t * (z * sum));
    return choose(dot < 0, 4 * QUARTER_PI - angle, angle);
}

/* Area makes the length positive: the square of the smallest product does not underflow. */
static inline __attribute__((always_inline)) void measure_any(block *b, size_t count) {
    double *restrict x = b->x, *restrict y = b->y, *restrict z = b->z;
    double *restrict lengths = b->lengths, *restrict angles = b->angles;
    for (size_t i = 0; i < count; ++i) {
        double p[9];
        for (int k = 0; k < 9; ++k) {
            p[k] = b->positions[k][i];
        }
        const burnish_vec3 second = {p[3] - p[0], p[4] - p[1], p[5] - p[2]};
        const burnish_vec3 third = {p[6] - p[0], p[7] - p[1], p[8] - p[2]};
        const burnish_vec3 between = {p[6] - p[3], p[7] - p[4], p[8] - p[5]};
        const burnish_vec3 cross = burnish_vec3_cross(second, third);
        const double length = burnish_vec3_length(cross), scale = 1 / length;
        lengths[i] = length;
        x[i] = cross.x * scale;
        y[i] = cross.y * scale;
        z[i] = cross.z * scale;
        b->dots[0][i] = burnish_vec3_dot(second, third);
        b->dots[1][i] = -burnish_vec3_dot(between, second);
        b->dots[2][i] = burnish_vec3_dot(third, between);
    }
    for (size_t i = 0; i < count; ++i) {
        angles[i] = b->dots[b->at[i]][i];
    }
    for (size_t i = 0; i < count; ++i) {
        angles[i] = angle_of(lengths[i], angles[i]);
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void measure_avx2(block *b, size_t count) {
    measure_any(b, count);
}

__attribute__((target("avx512f,avx512dq"))) static void measure_avx512(block *b, size_t count) {
    measure_any(b, count);
}
#endif

/* Measures the first `count` triangles of a block, and some copies of the first, whose results go
 * beyond the others. */
static void measure_block(block *b, size_t count, int wide) {
    for (; count % LANES != 0; ++count) {
        for (int k = 0; k < 9; ++k) {
            b->positions[k][count] = b->positions[k][0];
        }
        b->at[count] = 0;
    }
#if defined(__x86_64__)
    if (wide) {
        (wide > 1 ? measure_avx512 : measure_avx2)(b, count);
        return;
    }
#endif
    (void)wide;
    measure_any(b, count);
}

/* Prefetches what the corners a little later in the list need: first the numbers of their
 * positions, then the positions. */
static inline void fetch_ahead(const burnish_surface *surface, const uint32_t *corners, size_t i,
                               size_t count) {
    enum { NUMBERS_AHEAD = 24, POSITIONS_AHEAD = 8 };
    if (i + NUMBERS_AHEAD < count) {
        __builtin_prefetch(surface->corner_positions + corners[i + NUMBERS_AHEAD]);
    }
    if (i + POSITIONS_AHEAD < count) {
        const uint32_t later = corners[i + POSITIONS_AHEAD] / 3;
        const uint32_t *numbers = surface->corner_positions + 3 * (size_t)later;
        for (int k = 0; k < 3; ++k) {
            __builtin_prefetch(surface->positions + 3 * (size_t)numbers[k]);
        }
    }
}

void burnish_rings_measure(burnish_rings *rings, const uint32_t *corners, size_t count) {
    static const uint8_t after[5] = {0, 1, 2, 0, 1};
    const burnish_surface *surface = rings->surface;
    rings->corners = corners;
    for (size_t start = 0, size; start < count; start += size) {
        size = count - start < BLOCK ? count - start : BLOCK;
        block b;
        b.x = rings->x + start, b.y = rings->y + start, b.z = rings->z + start;
        b.lengths = rings->lengths + start, b.angles = rings->angles + start;
        for (size_t i = 0; i < size; ++i) {
            fetch_ahead(surface, corners, start + i, count);
            const uint32_t triangle = corners[start + i] / 3, at = corners[start + i] % 3;
            const uint32_t *numbers = surface->corner_positions + 3 * (size_t)triangle;
            for (int corner = 0; corner < 3; ++corner) {
                const float *position = surface->positions + 3 * (size_t)numbers[corner];
                for (int k = 0; k < 3; ++k) {
                    b.positions[3 * corner + k][i] = position[k];
                }
            }
            b.at[i] = (uint8_t)at;
            rings->next[start + i] = numbers[after[at + 1]];
            rings->previous[start + i] = numbers[after[at + 2]];
        }
        measure_block(&b, size, rings->wide);
    }
}

/* ---- normals ---- */

static burnish_vec3 weighted_normal(const burnish_rings *rings, size_t i) {
    return burnish_vec3_scale(burnish_ring_normal(rings, i), rings->angles[i]);
}

/* No angle is larger than pi, so the share of one weight also is a share of the largest. */
static int is_cancelled(double length, double angle) {
    return !(length > CANCELLED * angle);
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
    const int dominated = rest > 0 && set->flat_area >= FLAT_SHARE * rest;
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

#if defined(__x86_64__)
__attribute__((target("avx2"))) static double sum_lanes(__m256d lanes) {
    const __m128d pair = _mm_add_pd(_mm256_castpd256_pd128(lanes), _mm256_extractf128_pd(lanes, 1));
    return _mm_cvtsd_f64(_mm_add_sd(pair, _mm_unpackhi_pd(pair, pair)));
}

/* The same bits. Reads BURNISH_PAIRWISE_MAX entries from `first` on. */
__attribute__((target("avx2"))) static uint32_t choose_faces_avx2(const burnish_rings *rings,
                                                                  size_t first, size_t count) {
    const __m256d coplanar = _mm256_set1_pd(BURNISH_COPLANAR_COSINE);
    const __m256i all = _mm256_set1_epi64x((long long)count);
    burnish_face_set set = {0};
    __m256d areas[2], flat_areas[2];
    int flat = 0;
    for (int k = 0; k < 2; ++k) {
        const __m256i lanes =
            _mm256_add_epi64(_mm256_setr_epi64x(0, 1, 2, 3), _mm256_set1_epi64x(4 * k));
        areas[k] = _mm256_and_pd(_mm256_loadu_pd(rings->lengths + first + 4 * (size_t)k),
                                 _mm256_castsi256_pd(_mm256_cmpgt_epi64(all, lanes)));
    }
    __m256d most = _mm256_max_pd(areas[0], areas[1]);
    most = _mm256_max_pd(most, _mm256_permute2f128_pd(most, most, 1));
    most = _mm256_max_pd(most, _mm256_permute_pd(most, 5));
    const int largest = _mm256_movemask_pd(_mm256_cmp_pd(areas[0], most, _CMP_EQ_OQ)) |
                        _mm256_movemask_pd(_mm256_cmp_pd(areas[1], most, _CMP_EQ_OQ)) << 4;
    set.largest = first + (size_t)__builtin_ctz((unsigned)largest);
    for (int k = 0; k < 2; ++k) {
        const size_t at = first + 4 * (size_t)k;
        const __m256d x =
            _mm256_mul_pd(_mm256_loadu_pd(rings->x + at), _mm256_set1_pd(rings->x[set.largest]));
        const __m256d y =
            _mm256_mul_pd(_mm256_loadu_pd(rings->y + at), _mm256_set1_pd(rings->y[set.largest]));
        const __m256d z =
            _mm256_mul_pd(_mm256_loadu_pd(rings->z + at), _mm256_set1_pd(rings->z[set.largest]));
        const __m256d is_part =
            _mm256_cmp_pd(_mm256_add_pd(_mm256_add_pd(x, y), z), coplanar, _CMP_GT_OQ);
        flat_areas[k] = _mm256_and_pd(areas[k], is_part);
        flat |= _mm256_movemask_pd(is_part) << 4 * k;
    }
    set.area = sum_lanes(_mm256_add_pd(areas[0], areas[1]));
    set.flat_area = sum_lanes(_mm256_add_pd(flat_areas[0], flat_areas[1]));
    return (is_dominated(&set) ? (uint32_t)flat : ~0U) & ((1U << count) - 1);
}
#endif

/* The sum of a few faces in one set. */
static burnish_vec3 sum_few(const burnish_rings *rings, size_t first, size_t count) {
    uint32_t chosen = (1U << count) - 1;
    burnish_vec3 sum = {0, 0, 0};
    if (rings->asks) {
#if defined(__x86_64__)
        chosen = rings->wide ? choose_faces_avx2(rings, first, count)
                             : choose_faces(rings, first, count);
#else
        chosen = choose_faces(rings, first, count);
#endif
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
    if (is_cancelled(length, LARGEST_ANGLE)) {
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

int burnish_rings_normals(burnish_rings *rings, size_t first, size_t count, float *normals) {
    uint32_t sets[BURNISH_SETS_MAX];
    if (rings->flat) {
        for (size_t i = 0; i < count; ++i) {
            burnish_store_unit(burnish_ring_normal(rings, first + i), normals + 3 * i);
        }
        return 0;
    }
    if (count <= BURNISH_PAIRWISE_MAX && burnish_join_fan(rings, first, count) &&
        store_common(rings, first, count, normals)) {
        return 1;
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
