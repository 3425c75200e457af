/* Instruction sets: which there are, and what CPUID says of them. */
#ifndef BURNISH_SIMD_ISA_H
#define BURNISH_SIMD_ISA_H

#include <stdint.h>

#include "burnish/core.h"
#include "simd/isa_ops.h"

/* The registers that decide, as an x86 processor gives them; 0 where a leaf does not exist. */
typedef struct burnish_cpuid {
    uint32_t leaf1_ecx, leaf1_edx;
    uint32_t leaf7_ebx;
    uint64_t xcr0; /* what the operating system saves; 0 without OSXSAVE */
} burnish_cpuid;

/* The tiers that such a processor runs, SCALAR included. A pure function, so that tests can try any
 * processor. */
uint32_t burnish_isa_from_cpuid(const burnish_cpuid *cpuid);

/* Each isa_<name>.c gives its table, or NULL where it was not compiled for that instruction set. */
#define BURNISH_ISA_DECLARE(name, word, lanes) const burnish_isa_ops *burnish_isa_ops_##word(void);
BURNISH_ISA_LIST(BURNISH_ISA_DECLARE)
#undef BURNISH_ISA_DECLARE

#endif
