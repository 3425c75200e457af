/* Every sweep of sweep.h over all 2^32 floats; takes minutes, so `make sweep` runs it, not ctest.
 * Usage: sweep_lobe [STRIDE]. */
#include <stdlib.h>

#include "core/tasks.h"
#include "sweep.h"

enum { PARTS = 256 };

typedef struct sweep_context {
    const sweep_case *c;
    uint64_t stride;
    sweep_result found[PARTS];
} sweep_context;

static void sweep_part(void *of, size_t part, int thread) {
    sweep_context *context = of;
    const uint64_t part_size = ((uint64_t)1 << 32) / PARTS, begin = part * part_size;
    /* the first multiple of the stride in this part */
    const uint64_t first = (begin + context->stride - 1) / context->stride * context->stride;
    (void)thread;
    sweep_run(context->c, first, begin + part_size, context->stride, &context->found[part]);
}

/* One case, in parts that threads share. */
static sweep_result sweep_all(const sweep_case *c, uint64_t stride, burnish_tasks *pool) {
    sweep_context context = {.c = c, .stride = stride};
    sweep_result result = {0};
    burnish_tasks_run(pool, PARTS, 1, 0, sweep_part, &context);
    for (int part = 0; part < PARTS; ++part) {
        sweep_merge(&result, &context.found[part]);
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
    burnish_tasks tasks, *pool = &tasks;
    burnish_tasks_begin(&tasks, NULL, 0);
    for (int i = 0; i < SWEEP_CASE_COUNT; ++i) {
        sweep_result result = sweep_all(&sweep_cases[i], stride, pool);
        bad += !sweep_report(&sweep_cases[i], &result);
        fflush(stdout);
    }
    printf("sweep_lobe: %d of %d sweeps failed\n", bad, SWEEP_CASE_COUNT);
    return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
