/* Every proof of q15_proof.h over every exponent, n = 1 .. 1023, every cosine and every lambda up
 * to past the cutoff. It takes two minutes: `make prove-q15` runs it, not ctest.
 * Usage: prove_q15 [short]     short: every 64th exponent */
#include <stdlib.h>

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

/* One proof over every stride-th exponent, shared by threads. */
static q15_result all(const q15_case *c, int of_lambdas, int stride) {
    static q15_result found[EXPONENTS];
    const int count = (EXPONENTS + stride - 1) / stride;
    q15_result result = {0};
    memset(found, 0, sizeof found);
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (int i = 0; i < count; ++i) {
        const uint32_t n = (uint32_t)(i * stride + 1);
        if (of_lambdas) {
            q15_prove_lambdas(c, n, 1, &found[i]);
        } else {
            q15_prove_cosines(c, n, &found[i]);
        }
    }
    for (int i = 0; i < count; ++i) {
        merge(&result, &found[i]);
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
