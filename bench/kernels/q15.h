/* The integer arrays of one kind of vectors: q15_vectors.c is compiled once for each. */
#ifndef BURNISH_BENCH_Q15_H
#define BURNISH_BENCH_Q15_H

#include "burnish/arrays_q15.h"

typedef void burnish_bench_q15_pixels(const burnish_q15_shader *shader,
                                      const burnish_q15_light *light, size_t count,
                                      const int16_t *const normal[3], void *pixels);
typedef void burnish_bench_q15_lobe(const burnish_lobe_q15 *lobe, size_t count,
                                    const uint16_t *cosines, void *values);

typedef struct burnish_bench_q15 {
    int lanes;
    burnish_bench_q15_lobe *fast, *near, *fast8;
    /* converts words for a lobe in floating point; vectorised by the compiler */
    void (*to_floats)(size_t count, const uint16_t *words, float *floats);
    void (*to_words)(size_t count, const float *floats, uint16_t *words);
    burnish_bench_q15_pixels *rgba8, *rgb565;
} burnish_bench_q15;

/* NULL if it was not compiled for that kind. */
const burnish_bench_q15 *burnish_bench_q15_scalar(void);
const burnish_bench_q15 *burnish_bench_q15_sse2(void);
const burnish_bench_q15 *burnish_bench_q15_avx2(void);
const burnish_bench_q15 *burnish_bench_q15_avx512(void);
const burnish_bench_q15 *burnish_bench_q15_neon(void);
const burnish_bench_q15 *burnish_bench_q15_wasm(void);

#endif
