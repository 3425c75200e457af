/* The library's kernels timed against their alternatives in one run.
 *
 * Contenders take turns: a round runs each for about a millisecond. The result is the median over
 * rounds of a contender's time divided by the lobe's in the same round, which other work on the
 * machine disturbs least. No thread is pinned to a core. */
#ifndef BURNISH_BENCH_KERNELS_H
#define BURNISH_BENCH_KERNELS_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/kernels.h"

enum {
    BURNISH_BENCH_POINTS = 2048, /* per block: cosines and values stay in the first cache */
    BURNISH_BENCH_EXPONENT = 32,
    BURNISH_BENCH_ROWS_MAX = 48
};

typedef struct burnish_bench_settings {
    uint32_t isa_mask; /* bits of 1 << burnish_isa */
    int quick;         /* fewer and shorter rounds, smaller arrays in memory */
} burnish_bench_settings;

/* One contender in one section. */
typedef struct burnish_bench_row {
    const char *section; /* "lobe.l1" */
    const char *name;    /* "schlick" */
    const char *label;   /* for display */
    int is_inverse;     /* 1: ratio is the first row's time over this row's; its key is over_NAME */
    double nanoseconds; /* per element; NaN if missing */
    double cycles;      /* of the time-stamp counter; NaN if not measured */
    double ratio;       /* this row's time over the first's, but see is_inverse; NaN if missing */
    const char *missing; /* why the number is missing; NULL if it is not */
    /* By burnish_bench_errors only: the largest errors, NaN if a value is NaN. */
    double absolute, relative;
} burnish_bench_row;

typedef struct burnish_bench_table {
    int count;
    burnish_bench_row rows[BURNISH_BENCH_ROWS_MAX];
} burnish_bench_table;

typedef struct burnish_bench_machine {
    char processor[96];
    char compiler[96];
    size_t cache_bytes[3]; /* data caches of level 1 to 3, 0 if unknown */
    size_t free_bytes;     /* available memory, 0 if unknown */
} burnish_bench_machine;

typedef struct burnish_bench_report {
    burnish_bench_machine machine;
    int rounds;
    size_t array_bytes; /* of each array in memory; 0: not enough memory */
    double tsc_hertz;   /* time-stamp counter; 0 if the machine lacks one */
    int has_isa[BURNISH_ISA_COUNT];
    burnish_bench_table isa[BURNISH_ISA_COUNT];
    burnish_bench_table scalar; /* scalar code, one value at a time; the paper's forms */
} burnish_bench_report;

/* Measures. Takes some seconds per instruction set and the memory of two arrays.
 * Errors: MEMORY. */
burnish_status burnish_bench_run(const burnish_bench_settings *settings,
                                 burnish_bench_report *report, burnish_error *error);

/* 1 for the instruction sets that can be measured here. */
int burnish_bench_has(burnish_isa isa);

/* The errors of one instruction set's contenders over BURNISH_BENCH_POINTS cosines in [0, 1]: of
 * lobes, section "lobe.l1", against max(0, c)^32 by libm in double; of inverse square roots,
 * section "root.l1", against 1/sqrt. Relative ones where the exact value is at least 1e-6. For the
 * tests. Errors: MEMORY. */
burnish_status burnish_bench_errors(burnish_isa isa, burnish_bench_table *errors,
                                    burnish_error *error);

/* The row's key: "lobe.l1.schlick_over", "lobe.l1.over_copy". */
void burnish_bench_key(const burnish_bench_row *row, char *key, size_t size);

#endif
