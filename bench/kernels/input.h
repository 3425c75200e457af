/* Input of the contenders. */
#ifndef BURNISH_BENCH_KERNELS_INPUT_H
#define BURNISH_BENCH_KERNELS_INPUT_H

#include "bench/kernels/kernels.h"
#include "bench/kernels/libraries.h"

/* The lobes that a prepared shader may have. */
enum {
    BURNISH_BENCH_OF_FAMILY, /* energy:2 */
    BURNISH_BENCH_OF_FAMILY_4,
    BURNISH_BENCH_OF_NONE,
    BURNISH_BENCH_OF_EXPONENT, /* n alone: Schlick, the table, the tuned pow, libm */
    BURNISH_BENCH_OF_SLEEF,
    BURNISH_BENCH_OF_LIBMVEC,
    BURNISH_BENCH_OF_COUNT
};

/* DIRECTIONAL: one directional light, a distant viewer. POINT: one point light, a near viewer. */
enum { BURNISH_BENCH_DIRECTIONAL, BURNISH_BENCH_POINT, BURNISH_BENCH_SCENES };

/* A square light near the points: its diffuse light alone, with one lobe, with three that fit GGX. */
enum {
    BURNISH_BENCH_SQUARE_DIFFUSE,
    BURNISH_BENCH_SQUARE_WIDE,
    BURNISH_BENCH_SQUARE_NARROW,
    BURNISH_BENCH_SQUARE_GGX,
    BURNISH_BENCH_SQUARES
};

typedef struct burnish_bench_input {
    float cosines[BURNISH_BENCH_POINTS]; /* uniform in [0, 1] */
    float bright[BURNISH_BENCH_POINTS];  /* uniform inside the lobe: no mispredicted branch */
    float values[BURNISH_BENCH_POINTS], others[BURNISH_BENCH_POINTS];
    float table[BURNISH_BENCH_TABLE_SIZE + 1];
    uint8_t rgba[4 * BURNISH_BENCH_POINTS];
    burnish_bench_shader shaders[BURNISH_BENCH_SCENES][BURNISH_BENCH_OF_COUNT];
    burnish_kernels_polygon squares[BURNISH_BENCH_SQUARES];
    size_t blocks;               /* of BURNISH_BENCH_POINTS points of a sphere */
    float *normals, *positions;  /* x, y and z one after the other */
    size_t array_bytes;          /* of each of the two in memory */
    float *source, *destination; /* NULL: not enough memory */
} burnish_bench_input;

/* Everything but the functions of other libraries; release with burnish_bench_input_destroy. */
burnish_status burnish_bench_input_create(burnish_bench_input **input, burnish_error *error);

/* The two arrays in memory, written once to map their pages; NULL if memory is short. */
void burnish_bench_input_map(burnish_bench_input *input, size_t bytes);

void burnish_bench_input_destroy(burnish_bench_input *input);

/* The points of a block. */
burnish_kernels_points burnish_bench_block(const burnish_bench_input *input, size_t block);

#endif
