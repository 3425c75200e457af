/* Faces are measured in blocks: scattered positions are brought together, then loops over arrays,
 * which compilers vectorise, compute. The operations and their order are the same for any width. */
#include <stddef.h>

#include "mesh/build/normals/faces.h"

enum { BLOCK = 64 };

/* The triangles of some corners, and where their faces go. */
typedef struct block {
    float positions[9][BLOCK]; /* x, y, z of the first corner, the second and the third */
    int64_t at[BLOCK];         /* 0..2: the corner that counts */
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

/* From corner `from` to corner `to` of triangle i. */
static inline __attribute__((always_inline)) burnish_vec3 edge_of(const block *b, size_t i,
                                                                  int from, int to) {
    double edge[3];
    for (int k = 0; k < 3; ++k) {
        edge[k] = (double)b->positions[3 * to + k][i] - (double)b->positions[3 * from + k][i];
    }
    return (burnish_vec3){edge[0], edge[1], edge[2]};
}

/* Area makes the length positive: the square of the smallest product does not underflow. */
static inline __attribute__((always_inline)) void measure_any(const block *b, size_t count) {
    double *restrict x = b->x, *restrict y = b->y, *restrict z = b->z;
    double *restrict lengths = b->lengths, *restrict angles = b->angles;
    for (size_t i = 0; i < count; ++i) {
        const burnish_vec3 second = edge_of(b, i, 0, 1), third = edge_of(b, i, 0, 2);
        const burnish_vec3 between = edge_of(b, i, 1, 2);
        const burnish_vec3 cross = burnish_vec3_cross(second, third);
        const double length = burnish_vec3_length(cross), scale = 1 / length;
        lengths[i] = length;
        x[i] = cross.x * scale;
        y[i] = cross.y * scale;
        z[i] = cross.z * scale;
        angles[i] = choose(b->at[i] == 0, burnish_vec3_dot(second, third),
                           choose(b->at[i] == 1, -burnish_vec3_dot(between, second),
                                  burnish_vec3_dot(third, between)));
    }
    for (size_t i = 0; i < count; ++i) {
        angles[i] = angle_of(lengths[i], angles[i]);
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static void measure_avx2(const block *b, size_t count) {
    measure_any(b, count);
}

__attribute__((target("avx512f,avx512dq"))) static void measure_avx512(const block *b,
                                                                       size_t count) {
    measure_any(b, count);
}
#endif

/* Fills a block up with copies of the first triangle, whose results go beyond the others. */
static size_t fill_vectors(block *b, size_t count) {
    for (; count % BURNISH_FACE_LANES != 0; ++count) {
        for (int k = 0; k < 9; ++k) {
            b->positions[k][count] = b->positions[k][0];
        }
        b->at[count] = 0;
    }
    return count;
}

/* Measures the first `count` triangles of a block. */
static void measure_block(block *b, size_t count, int wide) {
    count = fill_vectors(b, count);
#if defined(__x86_64__)
    if (wide) {
        (wide > 1 ? measure_avx512 : measure_avx2)(b, count);
        return;
    }
#endif
    (void)wide;
    measure_any(b, count);
}

static inline void load_triangle(block *b, size_t i, const float *positions,
                                 const uint32_t *numbers) {
    for (int k = 0; k < 3; ++k) {
        const float *position = positions + 3 * (size_t)numbers[k];
        b->positions[3 * k][i] = position[0];
        b->positions[3 * k + 1][i] = position[1];
        b->positions[3 * k + 2][i] = position[2];
    }
}

void burnish_measure_faces(const burnish_surface *surface, const uint32_t *corners, size_t count,
                           int wide, const burnish_measured_faces *to) {
    static const uint8_t after[5] = {0, 1, 2, 0, 1};
    for (size_t start = 0, size; start < count; start += size) {
        size = count - start < BLOCK ? count - start : BLOCK;
        block b;
        b.x = to->x + start, b.y = to->y + start, b.z = to->z + start;
        b.lengths = to->lengths + start, b.angles = to->angles + start;
        for (size_t i = 0; i < size; ++i) {
            const uint32_t corner = corners[start + i], at = corner % 3;
            const uint32_t *numbers = surface->corner_positions + (corner - at);
            load_triangle(&b, i, surface->positions, numbers);
            b.at[i] = at;
            to->next[start + i] = numbers[after[at + 1]];
            to->previous[start + i] = numbers[after[at + 2]];
        }
        measure_block(&b, size, wide);
    }
}

/* ---- areas ---- */

static inline __attribute__((always_inline)) void find_any(const block *b, size_t count,
                                                           uint8_t *has_area) {
    for (size_t i = 0; i < count; ++i) {
        const burnish_vec3 second = edge_of(b, i, 0, 1), third = edge_of(b, i, 0, 2);
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

void burnish_find_areas(const float *positions, const uint32_t *corners, size_t count, int wide,
                        uint8_t *has_area) {
    for (size_t start = 0, size; start < count; start += size) {
        size = count - start < BLOCK ? count - start : BLOCK;
        block b;
        uint8_t found[BLOCK];
        for (size_t i = 0; i < size; ++i) {
            load_triangle(&b, i, positions, corners + 3 * (start + i));
        }
        const size_t whole = fill_vectors(&b, size);
#if defined(__x86_64__)
        (wide > 1 ? find_avx512 : wide ? find_avx2 : find_scalar)(&b, whole, found);
#else
        (void)wide;
        find_scalar(&b, whole, found);
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
