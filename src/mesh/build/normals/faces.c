/* Faces are measured in blocks: scattered positions are brought together, then loops over arrays,
 * which compilers vectorise, compute. The operations and their order are the same for any width. */
#include <stddef.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "mesh/build/normals/faces.h"

enum { BLOCK = BURNISH_FACE_BLOCK };

/* The triangles of some corners, and where their faces go. */
typedef struct block {
    float positions[9][BLOCK]; /* x, y, z of the corner, the next one and the previous one */
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

/* The tangent of an angle is up / along, plus base where that is not 0. */
typedef struct tangent {
    double up, along, base;
} tangent;

/* Of the angle between two vectors, whose cross product's length is above 0, and their dot product
 * without its sign. It is near 0, a right angle, or 45 degrees. */
static inline __attribute__((always_inline)) tangent tangent_of(double length, double width) {
    const int flat = length <= TANGENT * width, steep = width <= TANGENT * length;
    return (tangent){choose(flat, length, choose(steep, -width, length - width)),
                     choose(flat, width, choose(steep, length, length + width)),
                     choose(flat, 0, choose(steep, 2 * QUARTER_PI, QUARTER_PI))};
}

/* The angle, in (0, pi], within 6e-16. */
static inline __attribute__((always_inline)) double angle_of(double t, double base, double dot) {
    const double *c = arctangent, z = t * t, z2 = z * z, z4 = z2 * z2;
    const double low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z);
    const double middle = (c[4] + c[5] * z) + z2 * (c[6] + c[7] * z);
    const double high = (c[8] + c[9] * z) + z2 * c[10];
    const double sum = low + z4 * (middle + z4 * high); /* short chains of operations */
    const double angle = base + (t + t * (z * sum));
    return choose(dot < 0, 4 * QUARTER_PI - angle, angle);
}

/* From corner 0 to corner `to` of triangle i. */
static inline __attribute__((always_inline)) burnish_vec3 edge_of(const block *b, size_t i,
                                                                  int to) {
    double edge[3];
    for (int k = 0; k < 3; ++k) {
        edge[k] = (double)b->positions[3 * to + k][i] - (double)b->positions[k][i];
    }
    return (burnish_vec3){edge[0], edge[1], edge[2]};
}

/* One division gives the inverse length and the tangent. No product of two lengths or dot products
 * of floats leaves the range of doubles. */
static inline __attribute__((always_inline)) uint64_t measure_any(const block *b, size_t count) {
    uint64_t missing = 0; /* the top bit: a length is 0 */
    double *restrict x = b->x, *restrict y = b->y, *restrict z = b->z;
    double *restrict lengths = b->lengths, *restrict angles = b->angles;
    for (size_t i = 0; i < count; ++i) {
        const burnish_vec3 next = edge_of(b, i, 1), previous = edge_of(b, i, 2);
        const burnish_vec3 cross = burnish_vec3_cross(next, previous);
        const double length = burnish_vec3_length(cross), dot = burnish_vec3_dot(next, previous);
        const tangent t = tangent_of(length, __builtin_fabs(dot));
        const double inverse = 1 / (length * t.along), scale = t.along * inverse;
        uint64_t bits;
        memcpy(&bits, &length, sizeof bits);
        missing |= bits - 1;
        lengths[i] = length;
        x[i] = cross.x * scale;
        y[i] = cross.y * scale;
        z[i] = cross.z * scale;
        angles[i] = angle_of(t.up * length * inverse, t.base, dot);
    }
    return missing >> 63;
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static uint64_t measure_avx2(const block *b, size_t count) {
    return measure_any(b, count);
}

__attribute__((target("avx512f,avx512dq"))) static uint64_t measure_avx512(const block *b,
                                                                           size_t count) {
    return measure_any(b, count);
}
#endif

/* Fills a block up with copies of the first triangle, whose results go beyond the others. */
static size_t fill_vectors(block *b, size_t count) {
    for (; count % BURNISH_FACE_LANES != 0; ++count) {
        for (int k = 0; k < 9; ++k) {
            b->positions[k][count] = b->positions[k][0];
        }
    }
    return count;
}

/* Measures the first `count` triangles of a block. Returns whether one seems to have no area. */
static uint64_t measure_block(block *b, size_t count, int wide) {
    count = fill_vectors(b, count);
#if defined(__x86_64__)
    if (wide) {
        return (wide > 1 ? measure_avx512 : measure_avx2)(b, count);
    }
#endif
    (void)wide;
    return measure_any(b, count);
}

static inline void load_position(block *b, size_t i, int row, const float *positions,
                                 uint32_t number) {
    const float *position = positions + 3 * (size_t)number;
    b->positions[row][i] = position[0];
    b->positions[row + 1][i] = position[1];
    b->positions[row + 2][i] = position[2];
}

/* The corners after and before one of a triangle. */
static inline void load_neighbors(block *b, size_t i, const burnish_surface *surface,
                                  uint32_t corner, const burnish_measured_faces *to) {
    static const uint8_t after[5] = {0, 1, 2, 0, 1};
    const uint32_t at = corner % 3, *numbers = surface->corner_positions + (corner - at);
    to->next[i] = numbers[after[at + 1]];
    to->previous[i] = numbers[after[at + 2]];
    load_position(b, i, 3, surface->positions, to->next[i]);
    load_position(b, i, 6, surface->positions, to->previous[i]);
}

/* A face that has area, though it seems to have none from this corner by rounding: measured as the
 * area was. */
static void measure_again(const burnish_surface *surface, uint32_t corner, size_t i,
                          const burnish_measured_faces *to) {
    const burnish_vec3 cross =
        burnish_face_cross(surface->positions, surface->corner_positions + (corner - corner % 3));
    const double length = burnish_vec3_length(cross);
    to->lengths[i] = length;
    to->x[i] = cross.x * (1 / length);
    to->y[i] = cross.y * (1 / length);
    to->z[i] = cross.z * (1 / length);
    to->angles[i] = 0;
}

static burnish_measured_faces skip_faces(const burnish_measured_faces *to, size_t count) {
    return (burnish_measured_faces){to->x + count,       to->y + count,      to->z + count,
                                    to->lengths + count, to->angles + count, to->next + count,
                                    to->previous + count};
}

/* Measures a block whose positions are loaded. */
static void measure_loaded(block *b, const burnish_surface *surface, const uint32_t *corners,
                           size_t count, int wide, const burnish_measured_faces *to) {
    b->x = to->x, b->y = to->y, b->z = to->z;
    b->lengths = to->lengths, b->angles = to->angles;
    const uint64_t any = measure_block(b, count, wide);
    for (size_t i = 0; i < count && any; ++i) {
        if (to->lengths[i] == 0) {
            measure_again(surface, corners[i], i, to);
        }
    }
}

void burnish_measure_faces(const burnish_surface *surface, const uint32_t *corners, size_t count,
                           int wide, const burnish_measured_faces *to) {
    for (size_t start = 0, size; start < count; start += size) {
        const burnish_measured_faces part = skip_faces(to, start);
        size = count - start < BLOCK ? count - start : BLOCK;
        block b;
        for (size_t i = 0; i < size; ++i) {
            load_position(&b, i, 0, surface->positions,
                          surface->corner_positions[corners[start + i]]);
            load_neighbors(&b, i, surface, corners[start + i], &part);
        }
        measure_loaded(&b, surface, corners + start, size, wide, &part);
    }
}

#if defined(__x86_64__)
/* Eight at a time: corners and to have room for whole vectors. */
__attribute__((target("avx2"))) static void
load_positions_avx2(block *b, size_t i, int row, const float *positions, __m256i numbers) {
    const __m256i at = _mm256_add_epi32(numbers, _mm256_slli_epi32(numbers, 1));
    for (int k = 0; k < 3; ++k) {
        _mm256_storeu_ps(b->positions[row + k] + i, _mm256_i32gather_ps(positions + k, at, 4));
    }
}

__attribute__((target("avx2"))) static void
load_neighbors_avx2(block *b, const burnish_surface *surface, const uint32_t *corners, size_t count,
                    const burnish_measured_faces *to) {
    const int *numbers = (const int *)(const void *)surface->corner_positions;
    const __m256i third = _mm256_set1_epi32((int)0xaaaaaaab), two = _mm256_set1_epi32(2);
    for (size_t i = 0; i < count; i += 8) {
        const __m256i corner = _mm256_loadu_si256((const __m256i *)(corners + i));
        const __m256i odd = _mm256_srli_epi64(corner, 32);
        const __m256i low = _mm256_srli_epi64(_mm256_mul_epu32(corner, third), 33);
        const __m256i high = _mm256_srli_epi64(_mm256_mul_epu32(odd, third), 33);
        const __m256i triangle = _mm256_or_si256(low, _mm256_slli_epi64(high, 32));
        const __m256i first = _mm256_add_epi32(triangle, _mm256_slli_epi32(triangle, 1));
        const __m256i at = _mm256_sub_epi32(corner, first);
        /* one more, but 0 after 2; one less, but 2 before 0 */
        const __m256i after = _mm256_sub_epi32(
            corner,
            _mm256_add_epi32(_mm256_set1_epi32(-1),
                             _mm256_and_si256(_mm256_cmpeq_epi32(at, two), _mm256_set1_epi32(3))));
        const __m256i before = _mm256_add_epi32(
            corner,
            _mm256_add_epi32(_mm256_set1_epi32(-1),
                             _mm256_and_si256(_mm256_cmpeq_epi32(at, _mm256_setzero_si256()),
                                              _mm256_set1_epi32(3))));
        const __m256i next = _mm256_i32gather_epi32(numbers, after, 4);
        const __m256i previous = _mm256_i32gather_epi32(numbers, before, 4);
        _mm256_storeu_si256((__m256i *)(to->next + i), next);
        _mm256_storeu_si256((__m256i *)(to->previous + i), previous);
        load_positions_avx2(b, i, 3, surface->positions, next);
        load_positions_avx2(b, i, 6, surface->positions, previous);
    }
}
#endif

static void load_row(block *b, const burnish_surface *surface, const uint32_t *corners,
                     size_t count, int wide, const burnish_measured_faces *to) {
#if defined(__x86_64__)
    if (wide) {
        load_neighbors_avx2(b, surface, corners, count, to);
        return;
    }
#endif
    (void)wide;
    for (size_t i = 0; i < count; ++i) {
        load_neighbors(b, i, surface, corners[i], to);
    }
}

void burnish_measure_fans(const burnish_surface *surface, const uint32_t *starts, size_t count,
                          size_t faces, int wide, const burnish_measured_faces *to) {
    const size_t whole = (count + BURNISH_FACE_LANES - 1) / BURNISH_FACE_LANES * BURNISH_FACE_LANES;
    uint32_t corners[BLOCK];
    block b;
    for (size_t v = 0; v < whole; ++v) { /* the first one fills vectors up */
        load_position(&b, v, 0, surface->positions,
                      surface->corner_positions[surface->corners[starts[v < count ? v : 0]]]);
    }
    for (size_t i = 0; i < faces; ++i) {
        for (size_t v = 0; v < whole; ++v) {
            corners[v] = surface->corners[starts[v < count ? v : 0] + i];
        }
        load_row(&b, surface, corners, whole, wide, &to[i]);
        measure_loaded(&b, surface, corners, whole, wide, &to[i]);
    }
}

/* ---- areas ---- */

static inline __attribute__((always_inline)) void find_any(const block *b, size_t count,
                                                           uint8_t *has_area) {
    for (size_t i = 0; i < count; ++i) {
        const burnish_vec3 second = edge_of(b, i, 1), third = edge_of(b, i, 2);
        const burnish_vec3 cross = burnish_vec3_cross(second, third);
        has_area[i] = (cross.x != 0) | (cross.y != 0) | (cross.z != 0);
    }
}

static void find_scalar(const block *b, size_t count, uint8_t *has_area) {
    find_any(b, count, has_area);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void find_avx2(const block *b, size_t count,
                                                      uint8_t *has_area) {
    find_any(b, count, has_area);
}

__attribute__((target("avx512f,avx512dq"))) static void find_avx512(const block *b, size_t count,
                                                                    uint8_t *has_area) {
    find_any(b, count, has_area);
}
#endif

static void load_triangles(block *b, const float *positions, const uint32_t *corners,
                           size_t count) {
    for (size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            load_position(b, i, 3 * k, positions, corners[3 * i + (size_t)k]);
        }
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void
load_triangles_avx2(block *b, const float *positions, const uint32_t *corners, size_t count) {
    const __m256i at = _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21);
    const size_t whole = count / 8 * 8;
    for (size_t i = 0; i < whole; i += 8) {
        const int *numbers = (const int *)(const void *)(corners + 3 * i);
        for (int k = 0; k < 3; ++k) {
            load_positions_avx2(b, i, 3 * k, positions, _mm256_i32gather_epi32(numbers + k, at, 4));
        }
    }
    for (size_t i = whole; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            load_position(b, i, 3 * k, positions, corners[3 * i + (size_t)k]);
        }
    }
}
#endif

void burnish_find_areas(const float *positions, const uint32_t *corners, size_t count, int wide,
                        uint8_t *has_area) {
    for (size_t start = 0, size; start < count; start += size) {
        size = count - start < BLOCK ? count - start : BLOCK;
        block b;
        uint8_t found[BLOCK];
#if defined(__x86_64__)
        (wide ? load_triangles_avx2 : load_triangles)(&b, positions, corners + 3 * start, size);
        const size_t whole = fill_vectors(&b, size);
        (wide > 1 ? find_avx512 : wide ? find_avx2 : find_scalar)(&b, whole, found);
#else
        (void)wide;
        load_triangles(&b, positions, corners + 3 * start, size);
        find_scalar(&b, fill_vectors(&b, size), found);
#endif
        memcpy(has_area + start, found, size);
    }
}

int burnish_face_width(void) {
    burnish_isa isa;
    const burnish_status status = burnish_isa_choose(NULL, &isa, NULL);
    return status != BURNISH_STATUS_OK ? 0
           : isa == BURNISH_ISA_AVX512 ? 2
                                       : isa == BURNISH_ISA_AVX2;
}
