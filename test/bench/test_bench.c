/* The benchmark's contenders compute what they claim: asserts their errors against libm, not their
 * times. */
#include <math.h>

#include "bench/kernels/kernels.h"
#include "bench/kernels/scalar.h"
#include "support.h"

/* Largest errors against max(0, c)^32 and 1/sqrt: the absolute one, and the relative one where
 * cos^n is at least 1e-6; 0: not asserted. */
static const struct claim {
    const char *name;
    double absolute, relative;
} CLAIMS[] = {
    {"lobe", 0.085, 0},    /* another function: energy:2 */
    {"copy", 0.87, 0},     /* another function: the cosine */
    {"order4", 0.044, 0},  /* another function: energy:4 */
    {"schlick", 0.197, 0}, /* another function */
    {"schlick_robust", 0.197, 0},
    {"squarings", 4e-6, 4e-6},
    {"squarings_plain", 4e-6, 4e-6},
    {"table", 0.0158, 0}, /* slope 32 times half a step of 1/1023 */
    {"vector_pow", 2e-4, 2e-4},
    {"sleef", 2e-7, 2e-7},
    {"libmvec", 1e-6, 1e-6},
    {"libm", 2e-7, 2e-7},
    {"ours", 0, 1.04e-7},
    {"ieee", 0, 0.91e-7},
    {"tuned2", 0, 4.8e-7},
    {"newton3", 0, 1.6e-7},
};

static const struct claim *find_claim(const char *name) {
    for (size_t i = 0; i < sizeof CLAIMS / sizeof *CLAIMS; ++i) {
        if (strcmp(CLAIMS[i].name, name) == 0) {
            return &CLAIMS[i];
        }
    }
    return NULL;
}

static void check_isa(burnish_isa isa) {
    burnish_bench_table errors;
    burnish_error error;
    const char *word = burnish_isa_name(isa);
    int known = 0;
    if (!CHECK(burnish_bench_errors(isa, &errors, &error) == BURNISH_STATUS_OK, "%s: %s", word,
               error.text)) {
        return;
    }
    for (int i = 0; i < errors.count; ++i) {
        const burnish_bench_row *row = &errors.rows[i];
        const struct claim *claim = find_claim(row->name);
        if (!CHECK(claim, "%s: nothing is claimed of %s", word, row->name)) {
            continue;
        }
        ++known;
        if (row->missing) {
            printf("%s: %s: %s\n", word, row->name, row->missing);
            continue;
        }
        printf("%s: %-16s absolute %.3g, relative %.3g\n", word, row->name, row->absolute,
               row->relative);
        CHECK(claim->absolute == 0 || row->absolute <= claim->absolute,
              "%s: %s is off by %g, not %g", word, row->name, row->absolute, claim->absolute);
        CHECK(claim->relative == 0 || row->relative <= claim->relative,
              "%s: %s is off by %g of its value, not %g", word, row->name, row->relative,
              claim->relative);
        CHECK(strcmp(row->name, "ieee") == 0 || row->relative > 0, "%s: %s: no error at all?", word,
              row->name);
    }
    CHECK(known == (int)(sizeof CLAIMS / sizeof *CLAIMS), "%s: %d contenders", word, known);
}

static void check_keys(void) {
    char key[64];
    burnish_bench_row row = {.section = "lobe.l1", .name = "copy", .is_inverse = 1};
    burnish_bench_key(&row, key, sizeof key);
    CHECK(strcmp(key, "lobe.l1.over_copy") == 0, "%s", key);
    row = (burnish_bench_row){.section = "shade.point", .name = "libmvec"};
    burnish_bench_key(&row, key, sizeof key);
    CHECK(strcmp(key, "shade.point.libmvec_over") == 0, "%s", key);
}

/* The paper's forms from a whole exponent, against their formulas. */
static void check_paper(void) {
    static const float cosines[] = {-0.5f, 0.0f, 0.9f, 0.95f, 0.99f, 1.0f};
    enum { COUNT = sizeof cosines / sizeof *cosines };
    const burnish_bench_scalar_lobe lobe = {.whole_exponent = 21};
    float values[COUNT];
    for (const burnish_bench_scalar *form = burnish_bench_paper; form->name; ++form) {
        /* 21 >> 1, (8 * 21 - 21) >> 4 */
        const double zeta = strcmp(form->name, "w") == 0 ? 10 : 9;
        if (strcmp(form->name, "loop") == 0) {
            continue;
        }
        (void)form->through(&lobe, COUNT, cosines, values);
        for (int i = 0; i < COUNT; ++i) {
            const double c = fmax(0, (double)cosines[i]), u = fmax(0, 1 + zeta * (c - 1));
            const double exact = strcmp(form->name, "schlick") == 0 ? c / (21 - 20 * c) : u * u;
            CHECK(fabs((double)values[i] - exact) < 1e-6, "%s(%g): %g, not %g", form->name, c,
                  (double)values[i], exact);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (burnish_bench_has((burnish_isa)isa)) {
            RUN(check_isa((burnish_isa)isa));
        }
    }
    RUN(check_keys());
    RUN(check_paper());
    return test_end("bench");
}
