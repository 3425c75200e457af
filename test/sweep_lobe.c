/* Every sweep of sweep.h over all 2^32 floats; minutes, so `make sweep` and not ctest runs it.
 * Usage: sweep_lobe [STRIDE]. */
#include <stdlib.h>

#include "sweep.h"

/* One case, in parts that threads share when OpenMP is on. */
static sweep_result sweep_all(const sweep_case *c, uint64_t stride) {
    const uint64_t part_size = ((uint64_t)1 << 32) / 256;
    sweep_result result = {0};
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (int part = 0; part < 256; ++part) {
        /* the first multiple of the stride in this part */
        uint64_t begin = (uint64_t)part * part_size;
        uint64_t first = (begin + stride - 1) / stride * stride;
        sweep_result found = {0};
        sweep_run(c, first, begin + part_size, stride, &found);
#ifdef _OPENMP
#pragma omp critical
#endif
        sweep_merge(&result, &found);
    }
    return result;
}

int main(int argc, char **argv) {
    uint64_t stride = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    int bad = 0;
    if (stride == 0) {
        fprintf(stderr, "sweep_lobe: the stride must be a whole number above 0\n");
        return EXIT_FAILURE;
    }
    for (int i = 0; i < SWEEP_CASE_COUNT; ++i) {
        sweep_result result = sweep_all(&sweep_cases[i], stride);
        bad += !sweep_report(&sweep_cases[i], &result);
        fflush(stdout);
    }
    printf("sweep_lobe: %d of %d sweeps failed\n", bad, SWEEP_CASE_COUNT);
    return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
