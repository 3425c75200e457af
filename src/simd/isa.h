/* The instruction sets of this build, and those that a processor runs. */
#ifndef BURNISH_SIMD_ISA_H
#define BURNISH_SIMD_ISA_H

#include "burnish/core.h"

/* X(name, word) for each instruction set of this build, names as in BURNISH_ISA_LIST.
 * scripts/cmake/isa.cmake defines the list, and compiles each ..._isa.c once per item. A build that
 * does not define it compiles ..._isa.c once, for what the compiler's flags allow. */
#if !defined(BURNISH_BUILT_ISAS)
#if defined(__AVX2__)
#define BURNISH_BUILT_ISAS X(AVX2, avx2)
#elif defined(__SSE2__)
#define BURNISH_BUILT_ISAS X(SSE2, sse2)
#elif defined(__aarch64__)
#define BURNISH_BUILT_ISAS X(NEON, neon)
#elif defined(__wasm_simd128__)
#define BURNISH_BUILT_ISAS X(WASM, wasm)
#else
#define BURNISH_BUILT_ISAS X(SCALAR, scalar)
#endif
#endif

/* `ops`_`word`, macros expanded: the name of a table in ..._isa.c is
 * BURNISH_ISA_TABLE(burnish_raster_ops, VECTOR_WORD). */
#define BURNISH_ISA_PASTE(ops, word) ops##_##word
#define BURNISH_ISA_TABLE(ops, word) BURNISH_ISA_PASTE(ops, word)

/* The registers that decide, as an x86 processor gives them; 0 where a leaf does not exist. */
typedef struct burnish_cpuid {
    uint32_t leaf1_ecx, leaf1_edx;
    uint32_t leaf7_ebx;
    uint64_t xcr0; /* what the operating system saves; 0 without OSXSAVE */
} burnish_cpuid;

/* The instruction sets that such a processor runs, SCALAR included. A pure function, so tests can
 * try any processor. */
uint32_t burnish_isa_from_cpuid(const burnish_cpuid *cpuid);

#endif
