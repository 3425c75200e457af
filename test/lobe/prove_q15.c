/* Every proof of q15_proof.h over every exponent, n = 1 .. 1023, every cosine and every lambda up
 * to past the cutoff. It takes two minutes: `make prove-q15` runs it, not ctest.
 * Usage: prove_q15 [short]     short: every 64th exponent */
#include <stdlib.h>

#include "core/tasks.h"
#include "q15_proof.h"
#include "support.h"

/* Merges another thread's results. */
static void merge(q15_result *to, const q15_result *from) {
    for (int form = 0; form < Q15_FORMS; ++form) {
        to->error[form] = to->error[form] > from->error[form] ? to->error[form] : from->error[form];
    }
    if (from->wrong) {
        to->wrong_n = from->wrong_n;
        to->wrong_input = from->wrong_input;
    }
    to->values += from->values;
    to->wrong += from->wrong;
}

enum { EXPONENTS = 1023 };

/* A proof for every exponent, each on its own. */
typedef struct proof {
    const q15_case *c;
    int of_lambdas;
    int stride;
    q15_result found[EXPONENTS];
} proof;

static void prove_exponent(void *of, size_t index, int thread) {
    proof *p = of;
    const uint32_t n = (uint32_t)index * (uint32_t)p->stride + 1;
    (void)thread;
    if (p->of_lambdas) {
        q15_prove_lambdas(p->c, n, 1, &p->found[index]);
    } else {
        q15_prove_cosines(p->c, n, &p->found[index]);
    }
}

/* One proof over every stride-th exponent, shared by threads. */
static q15_result all(const q15_case *c, int of_lambdas, int stride) {
    const size_t count = (size_t)((EXPONENTS + stride - 1) / stride);
    static proof p;
    q15_result result = {0};
    burnish_tasks tasks, *pool = &tasks;
    burnish_tasks_begin(&tasks, NULL, 0);
    p = (proof){.c = c, .of_lambdas = of_lambdas, .stride = stride};
    burnish_tasks_run(pool, count, 1, 0, prove_exponent, &p);
    for (size_t i = 0; i < count; ++i) {
        merge(&result, &p.found[i]);
    }
    return result;
}

int main(int argc, char **argv) {
    const int stride = argc == 2 && strcmp(argv[1], "short") == 0 ? 64 : 1;
    int bad = 0;
    if (argc > 2 || (argc == 2 && stride == 1)) {
        fprintf(stderr, "usage: prove_q15 [short]\n");
        return EXIT_FAILURE;
    }
    printf(
        "Largest errors in steps of the result (2^-16; fast8 and exact8 2^-8), and results seen\n");
    printf("%-19s ", "");
    for (int form = 0; form < Q15_FORMS; ++form) {
        printf(" %8s", q15_form_names[form]);
    }
    printf("\n");
    for (int i = 0; i < Q15_CASES; ++i) {
        const q15_result result = all(&q15_cases[i], 0, stride);
        bad += !q15_report("cosine", &q15_cases[i], &result);
        fflush(stdout);
    }
    for (int i = 0; i < Q15_CASES; ++i) {
        const q15_result result = all(&q15_cases[i], 1, stride);
        bad += !q15_report("lambda", &q15_cases[i], &result);
        fflush(stdout);
    }
    for (int i = 0; i < 4; ++i) {
        q15_result result = {0};
        q15_prove_steps(q15_cases[i].order, &result);
        bad += !q15_report("any", &q15_cases[i], &result);
    }
    printf("prove_q15: %d of 24 proofs failed; results never decrease as the cosine grows\n", bad);
    return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
