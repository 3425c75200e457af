/* Writes lobe/theory/lobe_sums_table.h: sums of lobes fitted to GGX and to Beckmann.
 *
 *   cc -O2 -std=c17 -Ilobe/include -Ibase/include -Ilobe -o lobe_sums lobe/scripts/lobe_sums.c \
 *       lobe/theory/lobe_sum.c -lm && ./lobe_sums > lobe/theory/lobe_sums_table.h
 *
 * Slopes and weights are polynomials in alpha. The search starts from polynomials that least squares
 * put through the best sums of single roughnesses (GGX) or from constants (Beckmann). It changes
 * their values at five roughnesses at random, one at a time, and keeps what makes the mean error of 20
 * roughnesses smaller; a start stays unless the mean falls by a tenth. The output can depend on the
 * last digits of the C library; the test theory_surfaces measures the errors of the committed header.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "theory/lobe_sum.h"

enum {
    LOBES = BURNISH_THEORY_LOBE_SUM_MAX,
    TERMS = BURNISH_LOBE_SUM_TERMS,
    ROUGHNESSES = 20,
    POINTS = 300,
    TRIES = 20000
};

static const double nodes[TERMS] = {0.0025, 0.1, 0.3, 0.65, 1}; /* alphas */

typedef struct problem {
    int count;
    burnish_lobe_sum_grid grids[ROUGHNESSES];
    burnish_lobe_sum_row row;
    double values[2 * LOBES - 1][TERMS]; /* of the polynomials at the nodes */
} problem;

static double alpha_at(int i) {
    double roughness = (i + 1.0) / ROUGHNESSES;
    return roughness * roughness;
}

/* Newton's interpolation through the nodes. */
static void make_terms(problem *p, int polynomial) {
    double f[TERMS], *terms = p->row.terms[polynomial];
    memcpy(f, p->values[polynomial], sizeof f);
    memset(terms, 0, sizeof f);
    for (int j = 1; j < TERMS; ++j) {
        for (int i = TERMS - 1; i >= j; --i) {
            f[i] = (f[i] - f[i - 1]) / (nodes[i] - nodes[i - j]);
        }
    }
    for (int i = TERMS - 1; i >= 0; --i) {
        for (int j = TERMS - 1; j > 0; --j) {
            terms[j] = terms[j - 1] - nodes[i] * terms[j];
        }
        terms[0] = f[i] - nodes[i] * terms[0];
    }
}

static double cost(const problem *p) {
    double sum = 0;
    for (int i = 0; i < ROUGHNESSES; ++i) {
        burnish_theory_lobe_sum lobes;
        burnish_theory_lobe_sum_error error;
        burnish_lobe_sum_evaluate(&p->row, p->count, alpha_at(i), &lobes);
        burnish_lobe_sum_measure(&p->grids[i], &lobes, &error);
        sum += error.moved + 0.02 * fabs(log(error.peak));
    }
    return sum / ROUGHNESSES;
}

static double uniform(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(*state >> 11) * 0x1p-52 - 1;
}

/* Returns the mean error. */
static double search(problem *p) {
    uint64_t state = 1;
    double best = cost(p), steps[2 * LOBES - 1][TERMS];
    int polynomials = 2 * p->count - 1;
    for (int i = 0; i < polynomials * TERMS; ++i) {
        steps[i / TERMS][i % TERMS] = 0.3;
    }
    for (int try = 0; try < TRIES; ++try) {
        int i = try / TERMS % polynomials, j = try % TERMS;
        double before = p->values[i][j], step = steps[i][j] * uniform(&state);
        p->values[i][j] = i < p->count ? before * exp(step) : before + 0.5 * step;
        make_terms(p, i);
        double now = cost(p);
        if (now < best) {
            best = now;
            steps[i][j] = fmin(1, 1.6 * steps[i][j]);
        } else {
            p->values[i][j] = before;
            make_terms(p, i);
            steps[i][j] = fmax(1e-4, 0.92 * steps[i][j]);
        }
    }
    return best;
}

static void write_row(const problem *p) {
    printf("        {{%d, %d, %d},\n         {", p->row.order[0], p->row.order[1], p->row.order[2]);
    for (int i = 0; i < 2 * p->count - 1; ++i) {
        printf("%s{%.6f", i ? ",\n          " : "", p->row.terms[i][0]);
        for (int j = 1; j < TERMS; ++j) {
            printf(", %.6f", p->row.terms[i][j]);
        }
        printf("}");
    }
    printf("}},\n");
}

static void solve(burnish_theory_distribution distribution, const burnish_lobe_sum_row *start,
                  problem *p) {
    for (int i = 0; i < ROUGHNESSES; ++i) {
        p->grids[i].count = POINTS;
        burnish_lobe_sum_prepare(distribution, alpha_at(i), &p->grids[i]);
    }
    p->row = *start;
    double before = cost(p);
    for (int i = 0; i < 2 * p->count - 1; ++i) {
        for (int j = 0; j < TERMS; ++j) {
            p->values[i][j] = 0;
            for (int k = TERMS - 1; k >= 0; --k) {
                p->values[i][j] = p->values[i][j] * nodes[j] + start->terms[i][k];
            }
        }
    }
    if (search(p) > 0.9 * before) {
        p->row = *start;
    }
}

int main(void) {
    static const burnish_lobe_sum_row starts[2][LOBES] = {
        {{{2}, {{0.115814, 0.101127, 0.151972, 0.570558, 0.091010}}},
         {{4, 1},
          {{0.130873, 0.145536, 0.125278, 0.244102, 0.399355},
           {0.045493, 0.060453, 0.474393, 0.793652, -0.361736},
           {0.398137, 0.546989, -2.960546, 6.946654, -3.944059}}},
         {{4, 2, 1},
          {{0.195991, -0.038349, 2.437220, -4.349801, 2.777889},
           {0.070456, 0.049457, 1.228855, -1.088043, 0.823176},
           {0.020008, 0.024145, 0.752692, 0.344416, -0.140196},
           {0.433745, 0.095864, 0.223609, -1.405286, 0.656158},
           {0.187038, 0.186449, 0.333351, 0.745939, -0.446119}}}},
        {{{4}, {{0.09}}},
         {{4, 1}, {{0.1}, {0.1}, {0.2}}},
         {{8, 2, 1}, {{0.06}, {0.15}, {0.1}, {0.2}, {0.1}}}},
    };
    static problem p;
    printf("/* Sums of lobes by distribution and number. Written by scripts/lobe_sums.c; do\n"
           " * not edit. */\n"
           "#ifndef BURNISH_THEORY_LOBE_SUMS_TABLE_H\n#define BURNISH_THEORY_LOBE_SUMS_TABLE_H\n\n"
           "#include \"theory/lobe_sum.h\"\n\n/* clang-format off */\n"
           "static const burnish_lobe_sum_row burnish_lobe_sum_rows[2][3] = {\n");
    for (int d = 0; d < 2; ++d) {
        printf("    {\n");
        for (p.count = 1; p.count <= LOBES; ++p.count) {
            solve((burnish_theory_distribution)d, &starts[d][p.count - 1], &p);
            write_row(&p);
        }
        printf("    },\n");
    }
    printf("};\n/* clang-format on */\n\n#endif\n");
    return 0;
}
