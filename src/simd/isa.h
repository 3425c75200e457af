/* What CPUID says, apart from asking it: a pure function, so that tests can try any processor. */
#ifndef BURNISH_SIMD_ISA_H
#define BURNISH_SIMD_ISA_H

#include <stdint.h>

#include "burnish/core.h"

/* The registers that decide, as an x86 processor gives them; 0 where a leaf does not exist. */
typedef struct burnish_cpuid {
    uint32_t leaf1_ecx, leaf1_edx;
    uint32_t leaf7_ebx;
    uint64_t xcr0; /* what the operating system saves; 0 without OSXSAVE */
} burnish_cpuid;

/* The tiers that such a processor runs, SCALAR included. */
uint32_t burnish_isa_from_cpuid(const burnish_cpuid *cpuid);

/* The tiers that this build has a table for. */
uint32_t burnish_isa_built(void);

#endif
