/* Every proof of q15_proof.h over every exponent, n = 1 .. 1023, every cosine and every lambda up
 * to past the cutoff. It takes two minutes: `make prove-q15` runs it, not ctest.
 * Usage: prove_q15 [short]     short: every 64th exponent */
#include <stdlib.h>

#include "q15_proof.h"
#include "support.h"

int main(int argc, char **argv) {
    const int stride = argc == 2 && strcmp(argv[1], "short") == 0 ? 64 : 1;
    static q15_result found[2][Q15_CASES];
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
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (int i = 0; i < 2 * Q15_CASES; ++i) {
        for (uint32_t n = 1; n <= 1023; n += (uint32_t)stride) {
            if (i % 2) {
                q15_prove_lambdas(&q15_cases[i / 2], n, 1, &found[1][i / 2]);
            } else {
                q15_prove_cosines(&q15_cases[i / 2], n, &found[0][i / 2]);
            }
        }
    }
    for (int i = 0; i < 2 * Q15_CASES; ++i) {
        bad += !q15_report(i < Q15_CASES ? "cosine" : "lambda", &q15_cases[i % Q15_CASES],
                           &found[i / Q15_CASES][i % Q15_CASES]);
    }
    for (int i = 0; i < 4; ++i) {
        q15_result result = {0};
        q15_prove_steps(q15_cases[i].order, &result);
        bad += !q15_report("any", &q15_cases[i], &result);
    }
    static q15_composites composites;
    for (uint32_t n = 1; n <= 1023; n += n <= 32 ? 1 : (uint32_t)stride) {
        q15_prove_composite(n, 1, &composites);
    }
    bad += !q15_report_composites(&composites);
    printf("prove_q15: %d of 25 proofs failed; results never decrease as the cosine grows\n", bad);
    return bad == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
