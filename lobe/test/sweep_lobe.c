/* Every sweep of sweep.h over all 2^32 floats; takes minutes, so `make sweep` runs it, not ctest.
 * Usage: sweep_lobe [STRIDE]. */
#include <stdlib.h>

#include "falloff.h"
#include "sweep.h"

int main(int argc, char **argv) {
    static sweep_result results[SWEEP_CASE_COUNT];
    const uint64_t stride = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    int bad = 0;
    if (stride == 0) {
        fprintf(stderr, "sweep_lobe: the stride must be an integer above 0\n");
        return EXIT_FAILURE;
    }
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (int i = 0; i < SWEEP_CASE_COUNT; ++i) {
        sweep_run(&sweep_cases[i], stride, &results[i]);
    }
    for (int i = 0; i < SWEEP_CASE_COUNT; ++i) {
        bad += !sweep_report(&sweep_cases[i], &results[i]);
    }
    for (int i = 0; i < FALLOFF_CASE_COUNT; ++i) {
        bad += !falloff_keeps(&falloff_cases[i], stride);
    }
    printf("sweep_lobe: %d of %d sweeps failed\n", bad, SWEEP_CASE_COUNT + FALLOFF_CASE_COUNT);
    return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
