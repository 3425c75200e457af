/* lobe/docs/theory.md, "Two places at most": sign changes of the difference of the slopes of a lobe and
 * of the power, counted on fine grids, against the places that burnish_theory_stationary finds. */
#include <math.h>

#include "support.h"
#include "theory/internal.h"

enum { CELLS = 2000 };

/* One lobe s max(0, 1 - zeta lambda)^m beside (1 - lambda)^n. */
typedef struct {
    double s, zeta, m, n;
} pair;

/* Slope of the power minus slope of the lobe: both slopes are negative. */
static double slope_difference(const pair *p, double lambda) {
    long double lobe = (long double)(p->s * p->m * p->zeta) *
                       powl(1 - (long double)p->zeta * lambda, (long double)p->m - 1);
    long double power = (long double)p->n * powl(1 - (long double)lambda, (long double)p->n - 1);
    long double difference = lobe - power;
    return fabsl(difference) > 1e-11L * (lobe + power) ? (double)(difference / (lobe + power)) : 0;
}

/* The cell borders: dense at both ends, where narrow lobes change sign. */
static double border(double end, int i) {
    double share = (double)i / CELLS;
    return end * share * share * (3 - 2 * share);
}

/* Sign changes in (0, end); where: the cells in which they lie, the first two. */
static int count_changes(const pair *p, double end, double cells[2][2]) {
    int changes = 0, sign = 0;
    double last = 0;
    for (int i = 1; i < CELLS; ++i) {
        double lambda = border(end, i), difference = slope_difference(p, lambda);
        int now = (difference > 0) - (difference < 0);
        if (now != 0 && sign != 0 && now != sign) {
            if (changes < 2) {
                cells[changes][0] = last;
                cells[changes][1] = lambda;
            }
            ++changes;
        }
        if (now != 0) {
            sign = now;
            last = lambda;
        }
    }
    return changes;
}

/* Exponents, slopes and scales by a random sequence of its own; every order, and some that burnish
 * does not have: the proof holds for any m above 1. */
static void check_family(void) {
    static const double orders[] = {2, 4, 8, 16, 32, 1.5, 3, 7.25};
    int seen[3] = {0}, found = 0;
    uint64_t state = 88172645463325252u;
    for (int i = 0; i < 1500; ++i) {
        double random[3];
        for (int k = 0; k < 3; ++k) {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            random[k] = (double)(state >> 11) * 0x1p-53;
        }
        pair p = {.s = i % 3 ? 1 : 1 - 0.1 * random[0],
                  .m = orders[i % 8],
                  .n = exp(log(4000) * random[1])};
        p.zeta = p.n / p.m * exp2(3 * random[2] - 1.5);
        double end = p.zeta > 1 ? 1 / p.zeta : 1, cells[2][2], v[2];
        int changes = count_changes(&p, end, cells);
        if (!CHECK(changes <= 2, "m=%g n=%.17g zeta=%.17g s=%g: %d places", p.m, p.n, p.zeta, p.s,
                   changes)) {
            return;
        }
        ++seen[changes];
        if (p.m != floor(p.m)) {
            continue; /* the shape takes whole orders */
        }
        burnish_theory_shape shape = burnish_theory_family_shape(p.zeta, p.s, (int)p.m, p.n);
        int count = burnish_theory_stationary(&shape, 1, v);
        for (int k = 0; k < changes; ++k) {
            int hit = 0;
            for (int j = 0; j < count; ++j) {
                hit += v[j] >= cells[k][0] && v[j] <= cells[k][1];
            }
            CHECK(hit == 1, "m=%g n=%.17g zeta=%.17g: between %g and %g", p.m, p.n, p.zeta,
                  cells[k][0], cells[k][1]);
            found += hit;
        }
    }
    printf("places of equal slope: none %d times, one %d, two %d; %d found again\n", seen[0],
           seen[1], seen[2], found);
    CHECK1(seen[0] > 5 && seen[1] > 500 && seen[2] > 500 && found > 1000);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_family());
    return test_end("theory_slopes");
}
