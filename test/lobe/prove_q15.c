/* Every proof of q15_proof.h over every exponent, n = 1 .. 1023, every cosine and every lambda up
 * to past the cutoff. It takes two minutes: `make prove-q15` runs it, not ctest.
 * Usage: prove_q15 [--markdown|--short|--inputs|--tables]
 *   --markdown  the table of errors of docs/firmware.md
 *   --short     the same of every 64th exponent
 *   --inputs    the table of the errors of input formats
 *   --tables    the table of lobes and tables of cos^n, all against cos^n */
#include <math.h>
#include <stdlib.h>

#include "../hardware/firmware/rivals.h"
#include "burnish/shade_q15.h"
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

static void unit(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; ++k) {
        v[k] /= length;
    }
}

static int16_t to_q15(double x) {
    return (int16_t)lrint(fmin(32767, fmax(-32767, x * 32768)));
}

/* The error due to the input's format, without the lobe's own rounding: the largest error in steps
 * of an 8-bit result, over random pairs of unit vectors inside the lobe. */
static void print_inputs(void) {
    printf(
        "| exponent | exact cosine rounded to UQ1.15 | N.H of vectors in Q15 | chord of vectors in "
        "Q15 | exact 1 - cosine in UQ0.24 |\n| ---: | ---: | ---: | ---: | ---: |\n");
    for (uint16_t n = 8; n < 1024; n = n < 512 ? (uint16_t)(2 * n) : n == 512 ? 1023 : 1024) {
        uint64_t state = n; /* the page shows the result */
        double worst[4] = {0};
        burnish_lobe_q15 lobe;
        burnish_lobe_q15_create(&lobe, BURNISH_Q15_TAYLOR, 2, n);
        for (int i = 0; i < 1000000; ++i) {
            double a[3], b[3], lambda = 0;
            int16_t x[3], y[3];
            for (int k = 0; k < 3; ++k) {
                a[k] = test_uniform(&state, -1, 1);
            }
            unit(a);
            for (int k = 0; k < 3; ++k) {
                b[k] = a[k] + test_uniform(&state, -1, 1) * sqrt(2.0 / n);
            }
            unit(b);
            for (int k = 0; k < 3; ++k) {
                lambda += (a[k] - b[k]) * (a[k] - b[k]) / 2;
                x[k] = to_q15(a[k]);
                y[k] = to_q15(b[k]);
            }
            const double t = fmax(0, 1 - n * lambda / 2), real = t * t * 256;
            const uint32_t found[4] = {
                burnish_lobe_q15_wide(&lobe, (uint16_t)lrint((1 - lambda) * 32768)),
                burnish_lobe_q15_wide(&lobe, burnish_q15_cosine(burnish_q15_dot(x, y))),
                burnish_lobe_q15_wide_lambda(&lobe, burnish_q15_chord(x, y)),
                burnish_lobe_q15_wide_lambda(&lobe, (uint32_t)lrint(lambda * 16777216))};
            for (int k = 0; k < 4; ++k) {
                worst[k] = fmax(worst[k], fabs(found[k] / 16777216.0 - real));
            }
        }
        printf("| %d | %.2f | %.2f | %.2f | %.3f |\n", n, worst[0], worst[1], worst[2], worst[3]);
    }
}

static uint16_t power_word(double cosine, int n) {
    return (uint16_t)fmin(65535, floor(pow(cosine, n) * 65536 + .5));
}

/* Largest errors against cos^n over all cosines, in the order of the columns below. */
static void rival_errors(int n, double worst[6]) {
    static const struct {
        burnish_q15_fit fit;
        uint16_t order;
    } columns[] = {{BURNISH_Q15_SHIFT7, 2},
                   {BURNISH_Q15_ENERGY, 2},
                   {BURNISH_Q15_ENERGY, 4},
                   {BURNISH_Q15_ENERGY, 8}};
    uint16_t middles[256], ends[257];
    burnish_lobe_q15 lobes[4];
    for (int i = 0; i < 4; ++i) {
        burnish_lobe_q15_create(&lobes[i], columns[i].fit, columns[i].order, (uint16_t)n);
    }
    for (int i = 0; i <= 256; ++i) {
        ends[i] = power_word(i / 256.0, n);
        if (i < 256) {
            middles[i] = power_word((i + .5) / 256, n);
        }
    }
    for (uint16_t cosine = 0; cosine <= 0x8000; ++cosine) {
        const double real = pow(cosine / 32768.0, n);
        uint16_t found[6] = {table_nearest(middles, cosine), table_between(ends, cosine)};
        for (int i = 0; i < 4; ++i) {
            found[2 + i] = burnish_lobe_q15_fast(&lobes[i], cosine);
        }
        for (int i = 0; i < 6; ++i) {
            worst[i] = fmax(worst[i], fabs(found[i] / 65536.0 - real));
        }
    }
}

static void print_tables(void) {
    printf(
        "| exponent | 256 entries, nearest | 257 entries, interpolated | shift7 | energy, order 2 "
        "| energy, order 4 | energy, order 8 |\n"
        "| ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (int n = 8; n < 1024; n = n < 512 ? 2 * n : n == 512 ? 1023 : 1024) {
        double worst[6] = {0};
        rival_errors(n, worst);
        printf("| %d | %.4f | %.4f | %.4f | %.4f | %.4f | %.4f |\n", n, worst[0], worst[1],
               worst[2], worst[3], worst[4], worst[5]);
    }
}

int main(int argc, char **argv) {
    const int brief = argc == 2 && strcmp(argv[1], "--short") == 0;
    const int markdown = brief || (argc == 2 && strcmp(argv[1], "--markdown") == 0);
    q15_result cosines[Q15_CASES];
    int bad = 0;
    if (argc == 2 && strcmp(argv[1], "--inputs") == 0) {
        print_inputs();
        return EXIT_SUCCESS;
    }
    if (argc == 2 && strcmp(argv[1], "--tables") == 0) {
        print_tables();
        return EXIT_SUCCESS;
    }
    if (argc > 2 || (argc == 2 && !markdown)) {
        fprintf(stderr, "prove_q15: use --markdown, --short, --inputs, --tables or nothing\n");
        return EXIT_FAILURE;
    }
    if (markdown) {
        for (int i = 0; i < Q15_CASES; ++i) {
            cosines[i] = all(&q15_cases[i], 0, brief ? 64 : 1);
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
        cosines[i] = all(&q15_cases[i], 0, 1);
        bad += !q15_report("cosine", &q15_cases[i], &cosines[i]);
        fflush(stdout);
    }
    for (int i = 0; i < Q15_CASES; ++i) {
        const q15_result result = all(&q15_cases[i], 1, 1);
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
