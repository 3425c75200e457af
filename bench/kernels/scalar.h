/* Lobes one value at a time: latency and throughput. */
#ifndef BURNISH_BENCH_KERNELS_SCALAR_H
#define BURNISH_BENCH_KERNELS_SCALAR_H

#include <stddef.h>

#include "burnish/lobe.h"

/* What the scalar lobes read. */
typedef struct burnish_bench_scalar_lobe {
    burnish_lobe family;
    burnish_composite composite[4]; /* of 3 to 6 multiplications */
    float exponent, offset;         /* n, 1 - zeta */
    int whole_exponent;             /* n, of the paper's forms */
} burnish_bench_scalar_lobe;

/* A lobe in two loops: `through` has independent values, out[i] = lobe(in[i]); in `chain` each
 * cosine depends on the value before it. Returns the last value. */
typedef float burnish_bench_scalar_function(const burnish_bench_scalar_lobe *lobe, size_t count,
                                            const float *in, float *out);

typedef struct burnish_bench_scalar {
    const char *label;
    burnish_bench_scalar_function *through, *chain;
} burnish_bench_scalar;

/* The first is the reference of the ratios, the second the bare loop; a NULL label ends the list. */
extern const burnish_bench_scalar burnish_bench_scalars[];

/* Schlick's lobe, then the paper's W and W_0.5, each from an integer exponent that is read again
 * for every value. */
extern const burnish_bench_scalar burnish_bench_paper[];

#endif
