/* Lobes one value at a time: latency and throughput. */
#ifndef BURNISH_BENCH_KERNELS_SCALAR_H
#define BURNISH_BENCH_KERNELS_SCALAR_H

#include <stddef.h>

/* A lobe in two loops: `through` has independent values, out[i] = lobe(in[i]); in `chain` each
 * cosine depends on the value before it. Returns the last value. */
typedef float burnish_bench_scalar_function(int exponent, size_t count, const float *in,
                                            float *out);

typedef struct burnish_bench_scalar {
    const char *label;
    burnish_bench_scalar_function *through, *chain;
} burnish_bench_scalar;

/* Schlick's lobe, then the paper's W and W_0.5, each from an integer exponent that is read again
 * for every value; the second row is the bare loop, and a NULL label ends the list. */
extern const burnish_bench_scalar burnish_bench_paper[];

#endif
