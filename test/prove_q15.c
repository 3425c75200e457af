/* Every proof of q15_proof.h over every exponent, n = 1 .. 1023; a minute, so `make
 * prove-q15` and not ctest runs it. Prints the table of docs/firmware.md. Usage: prove_q15
 * [--markdown] */
#include <stdlib.h>

#include "q15_proof.h"

/* Adds what another thread found. */
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

/* One proof over all exponents, shared by threads when OpenMP is on. */
static q15_result all(const q15_case *c, int of_lambdas) {
    q15_result result = {0};
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic, 8)
#endif
    for (int n = 1; n <= 1023; ++n) {
        q15_result found = {0};
        if (of_lambdas) {
            q15_prove_lambdas(c, (uint32_t)n, 7, &found);
        } else {
            q15_prove_cosines(c, (uint32_t)n, &found);
        }
#ifdef _OPENMP
#pragma omp critical
#endif
        merge(&result, &found);
    }
    return result;
}

static void print_markdown(const q15_result results[Q15_CASES]) {
    printf("| fit | order |");
    for (int form = 0; form < Q15_FORMS; ++form) {
        printf(" `%s` |", q15_form_names[form]);
    }
    printf("\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (int i = 0; i < Q15_CASES; ++i) {
        printf("| %s | %d |", q15_cases[i].name, q15_cases[i].order);
        for (int form = 0; form < Q15_FORMS; ++form) {
            printf(" %.3f |", results[i].error[form]);
        }
        printf("\n");
    }
}

int main(int argc, char **argv) {
    const int markdown = argc == 2 && strcmp(argv[1], "--markdown") == 0;
    q15_result cosines[Q15_CASES];
    int bad = 0;
    if (argc > 2 || (argc == 2 && !markdown)) {
        fprintf(stderr, "prove_q15: the only argument is --markdown\n");
        return 2;
    }
    if (markdown) {
        for (int i = 0; i < Q15_CASES; ++i) {
            cosines[i] = all(&q15_cases[i], 0);
        }
        print_markdown(cosines);
        return 0;
    }
    printf(
        "Largest errors in steps of the result (2^-16; fast8 and exact8 2^-8), and results seen\n");
    printf("%-19s ", "");
    for (int form = 0; form < Q15_FORMS; ++form) {
        printf(" %8s", q15_form_names[form]);
    }
    printf("\n");
    for (int i = 0; i < Q15_CASES; ++i) {
        cosines[i] = all(&q15_cases[i], 0);
        bad += !q15_report("cosine", &q15_cases[i], &cosines[i]);
        fflush(stdout);
    }
    for (int i = 0; i < Q15_CASES; ++i) {
        const q15_result result = all(&q15_cases[i], 1);
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
