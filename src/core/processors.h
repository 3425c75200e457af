/* Processors: how many by affinity and quota, and what they can do. */
#ifndef BURNISH_CORE_PROCESSORS_H
#define BURNISH_CORE_PROCESSORS_H

/* The processors that a control group's "QUOTA PERIOD" stands for, rounded up; 0 for no limit. */
int burnish_quota_processors(const char *text);

/* Whether set-up work may take AVX2: the processor has it, the operating system saves its
 * registers, and the environment variable BURNISH_ISA names no instruction set below it. Bits do
 * not depend on it. */
int burnish_processor_has_avx2(void);

#endif
