/* Other libraries' vector powf, loaded at run time and optional. */
#ifndef BURNISH_BENCH_KERNELS_LIBRARIES_H
#define BURNISH_BENCH_KERNELS_LIBRARIES_H

#include "bench/kernels/isa.h"

/* One library's function, or why there is none. */
typedef struct burnish_bench_symbol {
    void *handle; /* of the library */
    burnish_bench_library *function;
    const char *missing;
} burnish_bench_symbol;

/* libmvec.so.1 and libsleef.so.3; release with burnish_bench_close. */
burnish_bench_symbol burnish_bench_open_libmvec(const burnish_bench_contenders *contenders);
burnish_bench_symbol burnish_bench_open_sleef(const burnish_bench_contenders *contenders);
void burnish_bench_close(burnish_bench_symbol *symbol);

#endif
