/* `burnish-lobe table`: any lobes, exponents and metrics. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/lobe.h"

typedef struct table_settings {
    const char *lobes, *exponents, *metrics, *range, *output;
    int format;
} table_settings;

static cli_work work;

#define TARGET(member) .offset = offsetof(table_settings, member)

static const cli_flag table_flags[] = {
    {.group = "Contents",
     CLI_FLAG("lobes", "LIST", "rows, such as power,energy:2,minimax:4", cli_flag_text, lobes),
     .default_text = "power,schlick,taylor:2,energy:2,minimax:2,minimax:4,minimax:8",
     .default_label = "a selection",
     .manual = "Lobes, between commas, in the words of *LOBES* and *LOBE*. If an exponent is too "
               "low for a lobe's order, the row has no numbers."},
    {CLI_FLAG("exponents", "LIST", "numbers and ranges: 10,100 1-1023 10-100:10 2-1024x2",
              cli_flag_text, exponents),
     .default_text = "10,100",
     .manual = "Exponents from 1 to 65536 between commas, and ranges of them: *1-1023* in steps of "
               "1, *10-100:10* in steps of 10, *2-1024x2* doubling."},
    {CLI_FLAG("metrics", "LIST", "columns: names, shape, widths, energies, errors, cost, all, sums",
              cli_flag_text, metrics),
     .default_text = "zeta,max-error,max-error-angle,rms,energy,zero-angle,ratio,multiplications,"
                     "additions,comparisons,divisions,functions",
     .default_label = "a selection", .manual = "Columns, between commas; see *METRICS*."},
    {CLI_FLAG("range", "NAME", "range of errors: all, inflection, level:L (down to cos^n = L)",
              cli_flag_text, range),
     .default_text = "all",
     .manual = "Range of angles for errors against cos^n, from 0: *all* ends at 90 degrees, "
               "*inflection* at the inflection of cos^n, *level:*_L_ where cos^n falls to _L_."},
    CLI_FORMAT_FLAG(table_settings, cli_table_format_words, "text"),
    CLI_OUTPUT_FLAG(table_settings, NULL),
};

static const cli_example examples[] = {
    {"burnish-lobe table", "a first look"},
    {"burnish-lobe table --lobes=taylor:2 --range=inflection --metrics=max-relative", "figure 4"},
    {"burnish-lobe table --lobes=minimax:8 --exponents=8-1024x2 --metrics=errors", "against n"},
    {"burnish-lobe table --metrics=angle:4,angle:8,ratio:4,ratio:8", "widths"},
    {"burnish-lobe table --metrics=all --format=csv -o lobes.csv", "everything"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "METRICS",
     .text = "The columns of *burnish-lobe table*. The groups *shape*, *widths*, *energies*, "
             "*errors* and *cost* are subsets, *all* has every column but those of *sums*, which "
             "are of "
             "sums of lobes and not of the row's lobe. _BITS_ (default 8), _DEG_ (10), _LENGTH_ "
             "(0.9) and _LOBES_ (3) follow a colon, as in *angle:4*.",
     .each_term = lobe_each_metric},
    {.heading = NULL},
};

const cli_command lobe_table_command = {
    .name = "table",
    .operand = "",
    .summary = "lobes in numbers: errors, widths, energy, cost",
    .operand_help = "burnish-lobe help --man lists the metrics; angles are degrees",
    .manual = "Prints a table with a row for every lobe and exponent.",
    .operands_max = 0,
    .flags = table_flags,
    .flag_count = sizeof table_flags / sizeof *table_flags,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(table_settings),
    .work = work,
};

/* The parsed lists of the table. */
typedef struct plan {
    lobe_names lobes;
    lobe_exponents exponents;
    lobe_metrics metrics;
    int to_inflection;
    double level; /* range level:L; 0: none */
    int needs_difference;
} plan;

static burnish_status read_range(const char *text, plan *p, burnish_error *error) {
    p->to_inflection = strcmp(text, "inflection") == 0;
    if (p->to_inflection || strcmp(text, "all") == 0) {
        return BURNISH_STATUS_OK;
    }
    if (strncmp(text, "level:", 6) == 0 && cli_read_real(text + 6, strlen(text + 6), &p->level) &&
        p->level > 0 && p->level < 1) {
        return BURNISH_STATUS_OK;
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--range: \"%.60s\" is not all, inflection, nor level:L with L between "
                    "0 and 1, such as level:0.5",
                    text);
}

static burnish_status read_plan(const table_settings *settings, plan *p, burnish_error *error) {
    burnish_status status = lobe_read_lobes("lobes", settings->lobes, &p->lobes, error);
    if (status == BURNISH_STATUS_OK) {
        status = lobe_read_metrics("metrics", settings->metrics, &p->metrics, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = read_range(settings->range, p, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = lobe_read_exponents("exponents", settings->exponents, &p->exponents, error);
    }
    for (size_t i = 0; i < p->metrics.count; ++i) {
        p->needs_difference = p->needs_difference || p->metrics.items[i].metric->needs_difference;
    }
    return status;
}

/* The end of the range of errors for an exponent. NaN: an inflection at 0 (n = 1) leaves no range. */
static double range_end(const plan *p, double exponent) {
    burnish_theory_model power;
    if (p->to_inflection) {
        return exponent > 1 ? burnish_theory_inflection_angle(exponent) : NAN;
    }
    if (p->level == 0) {
        return CLI_RIGHT_ANGLE;
    }
    (void)burnish_theory_model_create(&power, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER},
                                      exponent);
    return burnish_theory_angle_at(&power, p->level);
}

static void fill_row(const plan *p, const char *lobe, double exponent, cli_value *row) {
    burnish_theory_model model;
    burnish_theory_difference difference;
    int exists = burnish_theory_model_parse(lobe, exponent, &model, NULL) == BURNISH_STATUS_OK;
    if (exists && p->needs_difference) {
        burnish_theory_compare(&model, range_end(p, exponent), &difference);
    }
    row[0].number = exponent;
    row[1].text = lobe;
    for (size_t i = 0; i < p->metrics.count; ++i) {
        const lobe_metric *m = &p->metrics.items[i];
        row[2 + i].number =
            exists ? burnish_theory_metric_value(m->metric, &model, m->argument, &difference) : NAN;
    }
}

static burnish_status make_table(const plan *p, cli_table *table, burnish_error *error) {
    table->column_count = 2 + p->metrics.count;
    table->row_count = p->lobes.count * p->exponents.count;
    table->repeated = 2;
    table->rows_in_group = p->lobes.count > 1 && p->exponents.count > 1 ? p->lobes.count : 0;
    if (table->row_count > CLI_CELLS_MAX / table->column_count) {
        return cli_fail(error, BURNISH_STATUS_LIMIT,
                        "table: %zu rows of %zu columns are more than %d cells; use fewer "
                        "lobes, exponents or metrics",
                        table->row_count, table->column_count, CLI_CELLS_MAX);
    }
    cli_column *columns = calloc(table->column_count, sizeof *columns);
    table->columns = columns;
    table->cells = calloc(table->row_count * table->column_count, sizeof *table->cells);
    if (!columns || !table->cells) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu rows",
                        table->row_count);
    }
    columns[0] = (cli_column){.key = "exponent", .heading = "n", .decimals = -6};
    columns[1] = (cli_column){.key = "lobe", .heading = "lobe", .is_text = 1};
    for (size_t i = 0; i < p->metrics.count; ++i) {
        lobe_metric_column(&p->metrics.items[i], &columns[2 + i]);
    }
    cli_value *row = table->cells;
    for (size_t k = 0; k < p->exponents.count; ++k) {
        for (size_t i = 0; i < p->lobes.count; ++i) {
            fill_row(p, p->lobes.items[i], p->exponents.items[k], row);
            row += table->column_count;
        }
    }
    return BURNISH_STATUS_OK;
}

static void add_range(cJSON *root, const void *settings, int *failed) {
    const char *range = ((const table_settings *)settings)->range;
    cli_json_add(root, "range", cJSON_CreateString(range), failed);
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    const table_settings *settings = target;
    cli_table table = {0};
    (void)call;
    plan *p = calloc(1, sizeof *p);
    if (!p) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    }
    burnish_status status = read_plan(settings, p, error);
    if (status == BURNISH_STATUS_OK) {
        status = make_table(p, &table, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const cli_document document = {"rows", NULL, add_range, settings};
        status = cli_document_write(&document, &table, (cli_format)settings->format,
                                    settings->output, error);
    }
    free((void *)table.columns);
    free(table.cells);
    free(p->exponents.items);
    free(p);
    return status;
}
