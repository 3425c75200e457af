/* The machine that the benchmark runs on. */
#ifndef BURNISH_BENCH_KERNELS_MACHINE_H
#define BURNISH_BENCH_KERNELS_MACHINE_H

#include "bench/kernels/kernels.h"

void burnish_bench_find_machine(burnish_bench_machine *machine);

#endif
