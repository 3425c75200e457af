/* `burnish-lobe choose`: the cheapest lobe close enough to cos^n, as C code. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/lobe.h"

typedef struct choose_settings {
    const char *output;
    cli_real exponent, roughness, epsilon;
    int affine, distribution, format;
} choose_settings;

static cli_work work;

#define TARGET(member) .offset = offsetof(choose_settings, member)

static const cli_flag choose_flags[] = {
    {.group = "Requirements",
     CLI_FLAG("exponent", "N", "exponent of cos^n to replace, from 1 to 65536", cli_flag_real,
              exponent),
     CLI_RANGE(1, 65536),
     .manual = "Exponent of the cos^n that the lobe replaces. Required without *--roughness*."},
    {CLI_FLAG("roughness", "R", "a rough surface instead of cos^n, 0.001 to 1", cli_flag_real,
              roughness),
     CLI_RANGE(1e-3, 1),
     .manual =
         "Instead of a lobe for cos^n, the sum of the fewest lobes for a rough surface at normal "
         "incidence, around the mirror direction. *--epsilon* then limits the energy in the wrong "
         "direction, *moved*; "
         "*cap* is the largest error of the light from a round light there."},
    {CLI_FLAG("distribution", "NAME", "distribution of normals, with --roughness", cli_flag_word,
              distribution),
     .default_text = "ggx", .words = lobe_distribution_words,
     .manual = "*ggx* or *beckmann*, with *--roughness*."},
    {CLI_FLAG("epsilon", "E", "largest error allowed, between 0 and 1, such as 0.02; required",
              cli_flag_angle, epsilon),
     CLI_RANGE(0, 1),
     .manual = "Largest absolute error against cos^n over all angles; 1/256 is a step of an 8-bit "
               "display. Required."},
    {CLI_SWITCH("affine", "allow lobes whose peak is a little below 1", affine),
     .manual = "Allows the fit *affine*, whose A and B are both free. A + B is not 1: the peak is "
               "lower by the error, and the error is smaller by a sixth for the same cost."},
    CLI_FORMAT_FLAG(choose_settings, cli_format_words, "text"),
    CLI_OUTPUT_FLAG(choose_settings, NULL),
};

static const cli_example examples[] = {
    {"burnish-lobe choose --exponent=100 --epsilon=0.02", "constants for C, and other candidates"},
    {"burnish-lobe choose --exponent=20 --epsilon=0.03 --affine", "with a peak below 1"},
    {"burnish-lobe choose --roughness=0.4 --epsilon=0.05", "a sum of lobes for GGX"},
    {NULL, NULL},
};

const cli_command lobe_choose_command = {
    .name = "choose",
    .operand = "",
    .summary = "the cheapest lobe close enough to cos^n, as C",
    .operand_help = "cheapest: fewest functions, then divisions, then other operations",
    .manual =
        "Finds the cheapest lobe whose largest absolute error against cos^n is within the bound; "
        "among equally cheap lobes, the most accurate. Costs are per cosine with precomputed "
        "constants, compared by function calls, then divisions, then multiplications, additions "
        "and comparisons together. The other candidates follow, cheapest first.",
    .operands_max = 0,
    .flags = choose_flags,
    .flag_count = sizeof choose_flags / sizeof *choose_flags,
    .examples = examples,
    .settings_size = sizeof(choose_settings),
    .work = work,
};

typedef struct candidate {
    burnish_theory_model model;
    burnish_theory_cost cost;
    double maximum;
    char name[LOBE_NAME];
} candidate;

enum { CANDIDATES_MAX = 24 };

typedef struct result {
    const choose_settings *settings;
    candidate best, others[CANDIDATES_MAX];
    size_t count; /* number of others */
} result;

static void add(result *r, const char *word, double exponent) {
    candidate *c = &r->others[r->count];
    if (strcmp(word, r->best.name) == 0 ||
        burnish_theory_model_parse(word, exponent, &c->model, NULL) != BURNISH_STATUS_OK) {
        return;
    }
    snprintf(c->name, sizeof c->name, "%s", word);
    c->cost = burnish_theory_model_cost(&c->model);
    c->maximum = burnish_theory_maximum_error(&c->model, CLI_RIGHT_ANGLE);
    ++r->count;
}

static int compare_candidates(const void *a, const void *b) {
    const candidate *x = a, *y = b;
    int order = burnish_theory_cost_order(&x->cost, &y->cost);
    return order ? order : (x->maximum > y->maximum) - (x->maximum < y->maximum);
}

static burnish_status choose(result *r, burnish_error *error) {
    static const char *const words[] = {"minimax:2",   "minimax:4",   "minimax:8",   "minimax:16",
                                        "minimax:32",  "composite:3", "composite:4", "composite:5",
                                        "composite:6", "schlick",     "gx",          "nv2x",
                                        "gaussian",    "kuijk-blake", "power"};
    static const char *const affine_words[] = {"affine:2", "affine:4", "affine:8", "affine:16",
                                               "affine:32"};
    const choose_settings *settings = r->settings;
    double n = settings->exponent.value;
    burnish_status status =
        burnish_theory_choose(n, settings->epsilon.value, settings->affine, &r->best.model,
                              &r->best.cost, &r->best.maximum, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_lobe_spec_name(&r->best.model.lobe, r->best.name, sizeof r->best.name);
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        add(r, words[i], n);
    }
    for (size_t i = 0; settings->affine && i < sizeof affine_words / sizeof *affine_words; ++i) {
        add(r, affine_words[i], n);
    }
    qsort(r->others, r->count, sizeof *r->others, compare_candidates);
    return BURNISH_STATUS_OK;
}

/* A and B of u = max(0, A c + B) with S = u^m, as floats. For a peak of 1, the rounded A and B add up to 1
 * as closely as floats allow. */
static void constants_of(const burnish_theory_model *model, double *a, double *b) {
    double root = pow(model->scale, 1.0 / model->lobe.order);
    *a = (float)(model->zeta * root);
    *b = (float)(root - *a);
}

/* ---- Text ---- */

static void print_constant(FILE *stream, const char *name, double value) {
    char text[48];
    snprintf(text, sizeof text, "%.9g", (double)(float)value);
    fprintf(stream, "    static const float %s = %s%sF;\n", name, text,
            strpbrk(text, ".e") ? "" : ".0");
}

static void print_squarings(FILE *stream, int order) {
    for (int power = 2; power < order; power *= 2) {
        fprintf(stream, "    u *= u;\n");
    }
    fprintf(stream, "    specular = u * u;\n");
}

/* The constants of u = max(0, T - A lambda), u = u u, u = u (u + offset) ... With A c + B, rounding
 * B would move the peak, by .002 at n = 65536. */
static burnish_composite composite_of(const burnish_theory_model *model) {
    burnish_composite made;
    (void)burnish_composite_create(&made, model->lobe.aim, model->lobe.order,
                                   (float)model->exponent);
    return made;
}

static void print_composite(FILE *stream, const burnish_theory_model *model) {
    const burnish_composite made = composite_of(model);
    char name[] = "C1";
    print_constant(stream, "T", (double)made.top);
    print_constant(stream, "A", (double)made.slope);
    for (int i = 0; i < made.multiplications - 2; ++i, ++name[1]) {
        print_constant(stream, name, (double)made.offset[i]);
    }
    fprintf(stream, "    const float lambda = 1.0F - c; /* or burnish_lobe_chord */\n"
                    "    u = fmaxf(T - A * lambda, 0.0F);\n    u *= u;\n");
    for (int i = 0; i < made.multiplications - 2; ++i) {
        fprintf(stream, "    u *= u + C%d;\n", i + 1);
    }
    fprintf(stream, "    specular = u;\n");
}

/* Prints the lobe as C; c is the cosine. */
static void print_code(FILE *stream, const burnish_theory_model *model) {
    double a, b, n = model->exponent;
    switch (model->lobe.kind) {
    case BURNISH_LOBE_FAMILY:
        constants_of(model, &a, &b);
        print_constant(stream, "A", a);
        print_constant(stream, "B", b);
        fprintf(stream, "    u = fmaxf(A * c + B, 0.0F);\n");
        print_squarings(stream, model->lobe.order);
        break;
    case BURNISH_LOBE_COMPOSITE:
        print_composite(stream, model);
        break;
    case BURNISH_LOBE_SCHLICK:
        print_constant(stream, "n", n);
        fprintf(stream, "    c = fmaxf(c, 0.0F);\n    specular = c / (n - n * c + c);\n");
        break;
    case BURNISH_LOBE_GX:
        print_constant(stream, "A", n / 2);
        print_constant(stream, "B", 1 - n / 2);
        fprintf(stream, "    c = fmaxf(c, 0.0F);\n    specular = c * c / (A + B * c * c);\n");
        break;
    case BURNISH_LOBE_NV2X:
        print_constant(stream, "K0", model->k[0]);
        print_constant(stream, "K1", model->k[1]);
        print_constant(stream, "K2", model->k[2]);
        fprintf(stream, "    specular = fmaxf(c + K0, 0.0F) / (K2 + K1 * c);\n");
        break;
    case BURNISH_LOBE_GAUSSIAN:
        print_constant(stream, "K", n + 0.775);
        fprintf(stream, "    specular = expf(K * c - K);\n");
        break;
    default:
        print_constant(stream, "n", n);
        fprintf(stream, "    specular = powf(fmaxf(c, 0.0F), n);\n");
        break;
    }
}

enum { COLUMNS = 8 };

static const cli_column columns[COLUMNS] = {
    {.key = "lobe", .heading = "lobe", .is_text = 1},
    {.key = "within_epsilon", .heading = "within", .is_yes_no = 1},
    {.key = "max_error", .heading = "max error", .decimals = 5},
    {.key = "multiplications", .heading = "mul"},
    {.key = "additions", .heading = "add"},
    {.key = "comparisons", .heading = "max"},
    {.key = "divisions", .heading = "div"},
    {.key = "functions", .heading = "fn"},
};

/* Prints the chosen lobe's row, then the others. */
static void fill_row(const result *r, size_t i, cli_value row[COLUMNS]) {
    const candidate *c = i == 0 ? &r->best : &r->others[i - 1];
    row[0].text = c->name;
    row[1].number = c->maximum <= r->settings->epsilon.value;
    row[2].number = c->maximum;
    row[3].number = c->cost.multiplications;
    row[4].number = c->cost.additions;
    row[5].number = c->cost.comparisons;
    row[6].number = c->cost.divisions;
    row[7].number = c->cost.transcendentals;
}

static void print_text(FILE *stream, const cli_table *table, const void *context) {
    const result *r = context;
    char exponent[CLI_REAL_SIZE], epsilon[CLI_REAL_SIZE], cost[64];
    const burnish_theory_model *model = &r->best.model;
    lobe_cost_text(&r->best.cost, cost, sizeof cost);
    fprintf(stream, "%s is the cheapest lobe within %s of c^%s at every angle.\n\n", r->best.name,
            cli_shortest(r->settings->epsilon.value, epsilon),
            cli_shortest(r->settings->exponent.value, exponent));
    fprintf(stream, "  largest error  %.*f\n  cost           %s\n", r->best.maximum < 1e-3 ? 8 : 5,
            r->best.maximum, cost);
    if (model->zeta > 0 && model->lobe.kind != BURNISH_LOBE_NV2X) {
        fprintf(stream, "  zeta           %.9g\n", model->zeta);
        if (model->scale < 1) {
            fprintf(stream, "  peak           %.9g\n", model->scale);
        }
        fprintf(stream, "  zero below c = %.7g\n", burnish_theory_cutoff_cosine(model));
    }
    fprintf(stream, "\n");
    print_code(stream, model);
    fprintf(stream, "\nAll candidates, this one first, then the cheapest first:\n\n");
    cli_table_text(stream, table);
}

static void add_keys(cJSON *root, const void *context, int *failed) {
    const result *r = context;
    const burnish_theory_model *model = &r->best.model;
    cli_json_add(root, "exponent", cli_json_real(r->settings->exponent.value), failed);
    cli_json_add(root, "epsilon", cli_json_real(r->settings->epsilon.value), failed);
    cli_json_add(root, "lobe", cJSON_CreateString(r->best.name), failed);
    cli_json_add(root, "max_error", cli_json_real(r->best.maximum), failed);
    if (model->lobe.kind == BURNISH_LOBE_FAMILY) {
        double a, b;
        constants_of(model, &a, &b);
        cli_json_add(root, "zeta", cli_json_real(model->zeta), failed);
        cli_json_add(root, "peak", cli_json_real(model->scale), failed);
        cli_json_add(root, "a", cli_json_real(a), failed);
        cli_json_add(root, "b", cli_json_real(b), failed);
    } else if (model->lobe.kind == BURNISH_LOBE_COMPOSITE) {
        const burnish_composite made = composite_of(model);
        cJSON *offsets = cJSON_CreateArray();
        cli_json_add(root, "zeta", cli_json_real(model->zeta), failed);
        cli_json_add(root, "top", cli_json_real((double)made.top), failed);
        cli_json_add(root, "slope", cli_json_real((double)made.slope), failed);
        for (int i = 0; i < made.multiplications - 2; ++i) {
            cli_json_add(offsets, NULL, cli_json_real((double)made.offset[i]), failed);
        }
        cli_json_add(root, "offsets", offsets, failed);
    }
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    const choose_settings *settings = target;
    result r = {.settings = settings};
    (void)call;
    if (settings->roughness.given && settings->epsilon.given && !settings->exponent.given) {
        const lobe_sum_wish wish = {(burnish_theory_distribution)settings->distribution,
                                    settings->roughness.value, settings->epsilon.value,
                                    (cli_format)settings->format, settings->output};
        return lobe_choose_sum(&wish, error);
    }
    if (settings->roughness.given && settings->exponent.given) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--roughness: not available with --exponent; omit one of them");
    }
    if (!settings->exponent.given || !settings->epsilon.given) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "choose: --%s is missing; try \"burnish-lobe choose "
                        "--exponent=100 --epsilon=0.02\"",
                        settings->exponent.given || settings->roughness.given ? "epsilon"
                                                                              : "exponent");
    }
    burnish_status status = choose(&r, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    cli_value cells[CANDIDATES_MAX + 1][COLUMNS];
    for (size_t i = 0; i <= r.count; ++i) {
        fill_row(&r, i, cells[i]);
    }
    const cli_table table = {
        .columns = columns, .cells = cells[0], .column_count = COLUMNS, .row_count = r.count + 1};
    const cli_document document = {"candidates", print_text, add_keys, &r};
    return cli_document_write(&document, &table, (cli_format)settings->format, settings->output,
                              error);
}
