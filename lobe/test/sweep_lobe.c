/* Every sweep of sweep.h over all 2^32 floats; takes minutes, so `make sweep` runs it, not ctest.
 * Usage: sweep_lobe [STRIDE]. */
#include <stdlib.h>

#include "sweep.h"

enum { PARTS = 256 };

/* One case, in parts that threads share. */
static sweep_result sweep_all(const sweep_case *c, uint64_t stride) {
    sweep_result found[PARTS] = {{0}}, result = {0};
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (int part = 0; part < PARTS; ++part) {
        const uint64_t part_size = ((uint64_t)1 << 32) / PARTS;
        const uint64_t begin = (uint64_t)part * part_size;
        /* the first multiple of the stride in this part */
        sweep_run(c, (begin + stride - 1) / stride * stride, begin + part_size, stride,
                  &found[part]);
    }
    for (int part = 0; part < PARTS; ++part) {
        sweep_merge(&result, &found[part]);
    }
    return result;
}

int main(int argc, char **argv) {
    uint64_t stride = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    int bad = 0;
    if (stride == 0) {
        fprintf(stderr, "sweep_lobe: the stride must be an integer above 0\n");
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
