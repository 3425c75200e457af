/* `burnish lobe`: the list of its subcommands and what they share. */
#include "lobe/lobe.h"

#include <stdlib.h>
#include <string.h>

static const cli_command *const parts[] = {
    &lobe_table_command,    &lobe_claims_command, &lobe_choose_command, &lobe_fit_command,
    &lobe_boundary_command, &lobe_sample_command, &lobe_plot_command,   NULL,
};

static const cli_example examples[] = {
    {"burnish lobe table --lobes=energy:2,schlick --exponents=10,100", "two lobes side by side"},
    {"burnish lobe claims core-w", "a claim of the paper"},
    {"burnish lobe choose --exponent=100 --epsilon=0.02", "the cheapest lobe that will do"},
    {"burnish lobe boundary --exponents=1-255 --as=mem -o boundary.mem", "a memory for Verilog"},
    {"burnish lobe sample --lobe=energy:2 --exponent=50 -o rays.csv", "directions to trace"},
    {NULL, NULL},
};

static const cli_term lobe_terms[] = {
    {"*energy*", "zeta = (n + 1) / (m + 1): the same integral over solid angle as the power."},
    {"*taylor*", "zeta = n / m: the same value and slope at the centre."},
    {"*level*_Q_", "meets the power where it is _Q_, between 0 and 1, as in *level0.5:2*."},
    {"*projected*", "the same cosine-weighted integral as the power."},
    {"*minimax*", "the least maximum error against the power."},
    {"*leastsquares*", "the least integral of the squared error over the cosine."},
    {"*affine*", "like minimax with a peak a little below 1: an error lower by a sixth for the "
                 "same cost."},
    {"*zeta*_Z_", "that slope for every exponent, as in *zeta6.645:2*."},
    {"*shift7*, *shift3*", "zeta = 7n/16 and 3n/8, order 2, for integer hardware."},
    {"*power*, *schlick*, *gaussian*, *gx*, *lyon*:_ORDER_",
     "for comparison: c^n, c / (n - n c + c), exp(-(n + 0.775) (1 - c)), "
     "c^2 / (n/2 + (1 - n/2) c^2), and the taylor fit taken from the chord of vectors that "
     "are nearly of unit length."},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "LOBES",
     .text = "The family max(0, 1 + zeta (c - 1))^m needs no pow and no division: c is the "
             "cosine, m the order, and the fit chooses zeta from the exponent n. _FIT_:_ORDER_ "
             "names a member, _ORDER_ being 2, 4, 8, 16 or 32, and 2 when left out. Where an "
             "exponent is too low for the order, a lower order is drawn, with a warning.",
     .terms = lobe_terms},
    {.heading = NULL},
};

const cli_command lobe_command = {
    .name = "lobe",
    .operand = "COMMAND",
    .summary = "what is true of a lobe: numbers, claims, fits, figures",
    .operand_help =
        "burnish lobe COMMAND --help lists the flags; burnish help --man explains them.",
    .manual = "Numbers about the lobes of *LOBES*, computed when asked for, in double precision. "
              "Beside the words of *burnish render* these know, for comparison, *nv2x*, "
              "*kuijk-blake*, *table*_N_ and *table*_N_*:linear*. Errors are those against the "
              "power with the same exponent. "
              "Angles are degrees.",
    .examples = examples,
    .sections = sections,
    .parts = parts,
};

/* ---- Lists ---- */

/* From, to, and how to get from one to the next: a sum or, for by > 1 with multiply, a product. */
typedef struct span {
    double from, to, by;
    int multiply;
} span;

static int read_exponent(const char *text, size_t length, double *value) {
    return cli_read_real(text, length, value) && *value >= 1 && *value <= 65536;
}

/* "10", "1-1023", "10-100:10", "2-1024x2"; 0 when it is none of these. */
static int read_span(const char *item, size_t length, span *result) {
    const char *end = item + length, *dash = item;
    while (dash < end && (*dash != '-' || dash == item || dash[-1] == 'e' || dash[-1] == 'E')) {
        ++dash; /* an e before it: 1e-3 is one number */
    }
    *result = (span){0, 0, 1, 0};
    if (!read_exponent(item, (size_t)(dash - item), &result->from)) {
        return 0;
    }
    if (dash == end) {
        result->to = result->from;
        return 1;
    }
    const char *to = dash + 1, *mark = to;
    while (mark < end && *mark != ':' && *mark != 'x') {
        ++mark;
    }
    if (!read_exponent(to, (size_t)(mark - to), &result->to) || result->to < result->from) {
        return 0;
    }
    if (mark < end) {
        result->multiply = *mark == 'x';
        if (!cli_read_real(mark + 1, (size_t)(end - mark - 1), &result->by)) {
            return 0;
        }
    }
    return result->by >= (result->multiply ? 1.001 : 0.001);
}

/* Adds the numbers of a span, or only counts them where items is NULL. Every number is made from
 * the first one, so that rounding does not pile up; the small excess lets the last one be reached.
 */
static size_t expand(const span *range, double *items, size_t room) {
    size_t count = 0;
    double value = range->from;
    while (value <= range->to * (1 + 1e-12) && count < room) {
        if (items) {
            items[count] = value < range->to ? value : range->to;
        }
        ++count;
        value = range->multiply ? value * range->by : range->from + (double)count * range->by;
    }
    return count;
}

burnish_status lobe_read_exponents(const char *flag, const char *text, lobe_exponents *list,
                                   burnish_error *error) {
    size_t total = 0;
    *list = (lobe_exponents){0};
    for (int pass = 0; pass < 2; ++pass) {
        const char *rest = text, *item;
        while (rest) {
            size_t length = cli_next_item(&rest, ',', &item);
            span range;
            if (!read_span(item, length, &range)) {
                return cli_fail(
                    error, BURNISH_STATUS_ARGUMENT,
                    "--%s: \"%.*s\" is not an exponent from 1 to 65536, nor a range such as "
                    "1-1023, 10-100:10 or 2-1024x2",
                    flag, length < 60 ? (int)length : 60, item);
            }
            if (pass == 1) {
                list->count += expand(&range, list->items + list->count, total - list->count);
                continue;
            }
            total += expand(&range, NULL, LOBE_EXPONENTS_MAX + 1);
            if (total > LOBE_EXPONENTS_MAX) {
                return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                "--%s: more than %d exponents; give fewer or wider steps", flag,
                                LOBE_EXPONENTS_MAX);
            }
        }
        if (pass == 0) {
            list->items = malloc(total * sizeof *list->items);
            if (!list->items) {
                return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu exponents",
                                total);
            }
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status lobe_read_lobes(const char *flag, const char *text, lobe_names *list,
                               burnish_error *error) {
    const char *rest = text, *item;
    list->count = 0;
    while (rest) {
        size_t length = cli_next_item(&rest, ',', &item);
        char word[64];
        burnish_theory_model model;
        burnish_error reason;
        if (list->count == LOBE_LOBES_MAX) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: more than %d lobes; ask in several runs", flag, LOBE_LOBES_MAX);
        }
        snprintf(word, sizeof word, "%.*s", length < 60 ? (int)length : 60, item);
        /* every order exists for the largest exponent */
        if (burnish_theory_model_parse(word, 65536, &model, &reason) != BURNISH_STATUS_OK) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: %s", flag, reason.text);
        }
        burnish_lobe_spec_name(&model.lobe, list->items[list->count++], LOBE_NAME);
    }
    return BURNISH_STATUS_OK;
}

void lobe_cost_text(const burnish_theory_cost *cost, char *text, size_t size) {
    const struct {
        int count;
        const char *name;
    } parts_of_cost[] = {{cost->multiplications, "mul"}, {cost->additions, "add"},
                         {cost->comparisons, "max"},     {cost->divisions, "div"},
                         {cost->transcendentals, "fn"},  {cost->lookups, "look"}};
    size_t used = 0;
    text[0] = 0;
    for (size_t i = 0; i < sizeof parts_of_cost / sizeof *parts_of_cost && used < size; ++i) {
        if (parts_of_cost[i].count > 0) {
            used += (size_t)snprintf(text + used, size - used, "%s%d %s", used > 0 ? " " : "",
                                     parts_of_cost[i].count, parts_of_cost[i].name);
        }
    }
}
