/* burnish/isa.h: the instruction sets that kernels are compiled for, and the choice of one.
 *
 * Whatever is chosen, the results have the same bits; only the speed differs.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_ISA_H
#define BURNISH_ISA_H

#include <stdint.h>

#include "burnish/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The tiers, X(name, word, lanes): lanes is the number of floats in a vector. A processor's tiers
 * are ordered: a later one is faster. avx512 means F, DQ, BW and VL together. */
#define BURNISH_ISA_LIST(X)                                                                        \
    X(SCALAR, "scalar", 1)                                                                         \
    X(SSE2, "sse2", 4)                                                                             \
    X(AVX2, "avx2", 8)                                                                             \
    X(AVX512, "avx512", 16)                                                                        \
    X(NEON, "neon", 4)                                                                             \
    X(WASM, "wasm", 4)

typedef enum burnish_isa {
#define BURNISH_ISA_ENUM(name, word, lanes) BURNISH_ISA_##name,
    BURNISH_ISA_LIST(BURNISH_ISA_ENUM)
#undef BURNISH_ISA_ENUM
        BURNISH_ISA_COUNT
} burnish_isa;

/* The environment variable that burnish_isa_choose reads. */
#define BURNISH_ISA_VARIABLE "BURNISH_ISA"

/* "avx2"; "unknown" for a value outside the list. */
BURNISH_API const char *burnish_isa_name(burnish_isa isa);

/* Floats in a vector of that tier, 0 for a value outside the list. */
BURNISH_API int burnish_isa_lanes(burnish_isa isa);

/* The tiers that this build has and this processor runs, as a mask of bits 1 << burnish_isa.
 * SCALAR is always there. On x86 a tier counts only where the operating system saves its registers
 * (CPUID together with XCR0). Asks the processor each time, which takes microseconds under a
 * hypervisor: keep the answer. */
BURNISH_API uint32_t burnish_isa_available(void);

/* The fastest tier of a mask; SCALAR for an empty one. Depends on nothing else. */
BURNISH_API burnish_isa burnish_isa_best(uint32_t mask);

/* Chooses a tier by name.
 *   name  a tier's word; NULL or "auto": what the environment variable BURNISH_ISA names, and where
 *         that is unset, empty or "auto" the best available
 *   isa   receives the tier, SCALAR on error; not NULL
 *   error receives the one line of an error; may be NULL
 * Errors: ARGUMENT for an unknown word, or a tier that this build or processor lacks. */
BURNISH_API burnish_status burnish_isa_choose(const char *name, burnish_isa *isa,
                                              burnish_error *error);

#ifdef __cplusplus
}
#endif

#endif
