/* The contenders of one instruction set: the alternatives of the library's kernels. They are
 * compiled per instruction set like the kernels, but unlike these may use fused multiply-adds,
 * gathers and other libraries. */
#ifndef BURNISH_BENCH_KERNELS_ISA_H
#define BURNISH_BENCH_KERNELS_ISA_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/kernels.h"
#include "shading/shader.h"

/* The lobes that the library does not have; max(0, c)^n unless the line says otherwise. Numbers
 * start above the library's lobe kinds: the lighting kernel switches over both. */
typedef enum burnish_bench_lobe {
    BURNISH_BENCH_SCHLICK = 100,   /* c / (n - (n - 1) c): one clamp, one division */
    BURNISH_BENCH_SQUARINGS,       /* c^32 by five squarings, n = 32 only; never subnormal */
    BURNISH_BENCH_SQUARINGS_PLAIN, /* the same of max(0, c) */
    BURNISH_BENCH_TABLE,           /* the nearest of 1,024 entries */
    BURNISH_BENCH_VECTOR_POW,      /* exp2 and log2 by polynomials, 1.2e-4 relative at n = 32 */
    BURNISH_BENCH_LIBRARY,         /* another library's vector powf */
    BURNISH_BENCH_LIBM,            /* powf, one at a time */
    BURNISH_BENCH_COPY,            /* c itself */
    BURNISH_BENCH_STREAM_COPY,     /* c itself, stored past the caches */
    BURNISH_BENCH_LOBE_END
} burnish_bench_lobe;

enum { BURNISH_BENCH_TABLE_SIZE = 1024 };

/* Inverse square roots. */
typedef enum burnish_bench_root {
    BURNISH_BENCH_ROOT_OURS,   /* the library's: a tuned Newton step and one of third order */
    BURNISH_BENCH_ROOT_IEEE,   /* IEEE square root and division */
    BURNISH_BENCH_ROOT_TUNED,  /* two tuned Newton steps */
    BURNISH_BENCH_ROOT_NEWTON, /* three plain Newton steps */
    BURNISH_BENCH_ROOT_COUNT
} burnish_bench_root;

/* A powf over this instruction set's vectors; its real type takes and returns vectors. */
typedef void burnish_bench_library(void);

/* The data of a contender. The shader comes first: a lobe inside the lighting kernel finds the rest
 * through it. */
typedef struct burnish_bench_shader {
    burnish_kernels_shader shader;
    burnish_light_constants light;  /* the shader's */
    const float *table;             /* BURNISH_BENCH_TABLE_SIZE entries and one of padding */
    burnish_bench_library *library; /* for BURNISH_BENCH_LIBRARY */
} burnish_bench_shader;

/* out[i] = lobe(in[i]); count is a multiple of 64, out aligned to 64 bytes. */
typedef void burnish_bench_lobe_function(const burnish_bench_shader *shader, size_t count,
                                         const float *in, float *out);

/* The library's lighting kernel with another lobe; RGBA8. */
typedef void burnish_bench_shade_function(const burnish_bench_shader *shader,
                                          const burnish_kernels_points *points, size_t count,
                                          uint8_t *rgba);

/* out[i] = 1 / sqrt(in[i]); count is a multiple of 64. */
typedef void burnish_bench_root_function(size_t count, const float *in, float *out);

#define BURNISH_BENCH_INDEX(lobe) ((int)(lobe) - (int)BURNISH_BENCH_SCHLICK)
enum { BURNISH_BENCH_LOBE_COUNT = (int)BURNISH_BENCH_LOBE_END - (int)BURNISH_BENCH_SCHLICK };

typedef struct burnish_bench_contenders {
    const char *libmvec, *sleef; /* names of the powf there; NULL if missing */
    burnish_bench_lobe_function *lobe[BURNISH_BENCH_LOBE_COUNT];
    burnish_bench_shade_function *shade[BURNISH_BENCH_LOBE_COUNT][2]; /* distant, general */
    burnish_bench_root_function *root[BURNISH_BENCH_ROOT_COUNT];
} burnish_bench_contenders;

/* isa.c is compiled for each instruction set and returns its contenders, or NULL if its
 * flags lack that instruction set. */
#define BURNISH_BENCH_DECLARE(name, word, lanes)                                                   \
    const burnish_bench_contenders *burnish_bench_contenders_##word(void);
BURNISH_ISA_LIST(BURNISH_BENCH_DECLARE)
#undef BURNISH_BENCH_DECLARE

/* The contenders of one that runs here; NULL if this build or processor lacks them. */
const burnish_bench_contenders *burnish_bench_contenders_for(burnish_isa isa);

#endif
