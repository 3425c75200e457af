/* burnish-lobe: the program, and the table of its commands. */
#include "base/cli/program.h"
#include "program/lobe.h"

static const cli_command *const commands[] = {
    &lobe_table_command,    &lobe_claims_command, &lobe_choose_command,
    &lobe_boundary_command, &cli_help_command,    NULL,
};

static const cli_example examples[] = {
    {"burnish-lobe table --lobes=energy:2,schlick --exponents=10,100", "two lobes side by side"},
    {"burnish-lobe table --lobes=taylor,energy,level0.5,shift7", "the paper's W, W_1, W_Q, W_0.5"},
    {"burnish-lobe claims core-w", "a claim of the paper"},
    {"burnish-lobe choose --exponent=100 --epsilon=0.02", "the cheapest sufficient lobe"},
    {"burnish-lobe boundary --exponents=1-255 --as=mem -o boundary.mem", "a memory for Verilog"},
    {"burnish-lobe choose --roughness=0.4 --epsilon=0.05", "a sum of lobes for GGX"},
    {NULL, NULL},
};

static const cli_term lobe_terms[] = {
    {"*energy*", "zeta = (n + 1) / (m + 1): the same integral over solid angle as cos^n. "
                 "*energy:2* is the paper's W_1."},
    {"*taylor*",
     "zeta = n / m: the same value and slope at the centre. *taylor:2* is the paper's W."},
    {"*level*_Q_",
     "equals cos^n where that is _Q_, between 0 and 1, as in *level0.5:2*: the paper's W_Q."},
    {"*projected*", "the same cosine-weighted integral as cos^n."},
    {"*minimax*", "the least maximum error against cos^n."},
    {"*leastsquares*", "the least integral of the squared error over the cosine."},
    {"*affine*", "like minimax with a peak a little below 1: an error lower by a sixth for the "
                 "same cost."},
    {"*zeta*_Z_", "that slope for every exponent, as in *zeta6.645:2*."},
    {"*shift7*, *shift3*", "zeta = 7n/16 and 3n/8, order 2, for integer hardware. "
                           "*shift7* is the paper's W_0.5."},
    {"*composite*:_M_",
     "a composition of quadratics with _M_ multiplications, 2 to 6, and the least "
     "maximum error against cos^n: far lower than the family's."},
    {"*display*:_M_", "the same for 8-bit sRGB: _M_ is 5 or 6."},
    {"*exact*",
     "the cheapest lobe whose highlight has, in 8-bit sRGB, the codes of cos^n, at most 1 "
     "off on a tenth of its range: a product, *display:5* or *power*, by the exponent."},
    {"*auto*", "*exact* for materials that state their exponent (in an MTL file, with *--material* "
               "or *--exponent*), *energy:2* for the rest."},
    {"*power*, *schlick*, *gaussian*, *gx*, *lyon*:_ORDER_",
     "for comparison: c^n, c / (n - n c + c), exp(-(n + 0.775) (1 - c)), "
     "c^2 / (n/2 + (1 - n/2) c^2), and the taylor fit taken from the chord of vectors that "
     "are nearly of unit length."},
    {NULL, NULL},
};

static const cli_section lobes = {
    .heading = "LOBES",
    .text = "The family max(0, 1 + zeta (c - 1))^m needs no pow and no division: c is the "
            "cosine, m the order, and the fit chooses zeta from the exponent n. _FIT_:_ORDER_ "
            "names a member, _ORDER_ being 2, 4, 8, 16 or 32, by default 2. If an exponent is too "
            "low for the order, a lower order is drawn, with a warning.",
    .terms = lobe_terms,
};

static const cli_section environment = {
    .heading = "ENVIRONMENT",
    .text = "The locale is ignored: the decimal separator is always a point.",
};

static const cli_program program = {
    .name = "burnish-lobe",
    .summary = "properties of specular lobes: numbers, claims, memories",
    .usage = "burnish-lobe COMMAND [options]; \"burnish lobe\" runs the same",
    .advice = "\"burnish-lobe table\" or \"burnish-lobe --help\"",
    .man_date = "2026-11-28",
    .description =
        "Computes properties of the lobes of *LOBES* in double precision. In addition to the lobes "
        "of *burnish render*, these commands accept *nv2x*, *kuijk-blake*, *table*_N_ and "
        "*table*_N_*:linear* for comparison. Errors are relative to cos^n with the same exponent. "
        "Angles are degrees.",
    .commands = commands,
    .exits = (const cli_word[]){{NULL, 0}},
    .examples = examples,
    .values = &lobes,
    .environment = &environment,
    .see_also = ".BR burnish (1)",
};

int main(int argc, char **argv) {
    return cli_run_program(&program, argc, argv);
}
