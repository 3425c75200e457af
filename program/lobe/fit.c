/* `burnish lobe fit`: fits lobes to measured samples. */
#include "lobe/fit_solve.h"
#include "lobe/lists.h"
#include "lobe/samples.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/lobe.h"

typedef struct fit_settings {
    const char *output;
    int unit, offset, residuals, format;
} fit_settings;

static cli_work work;

static const cli_word unit_words[] = {{"deg", LOBE_UNIT_DEGREES},
                                      {"rad", LOBE_UNIT_RADIANS},
                                      {"cosine", LOBE_UNIT_COSINE},
                                      {NULL, 0}};

#define TARGET(member) .offset = offsetof(fit_settings, member)

static const cli_flag fit_flags[] = {
    {.group = "Samples",
     CLI_FLAG("unit", "NAME", "unit of the first column", cli_flag_word, unit),
     .default_text = "deg",
     .words = unit_words,
     .manual = "Unit of the first column: an angle in degrees or radians, of either sign, or its "
               "cosine."},
    {CLI_SWITCH("offset", "also fit a constant, such as diffuse light", offset),
     .manual = "Also fits a constant offset, such as diffuse and stray light."},
    CLI_FORMAT_FLAG(fit_settings, cli_format_words, "text"),
    {CLI_SWITCH("residuals", "list samples with the best lobe's values instead", residuals),
     .manual =
         "Lists each sample with the best lobe's value and the difference, instead of the lobes."},
    CLI_OUTPUT_FLAG(fit_settings, NULL),
};

static const cli_example examples[] = {
    {"burnish lobe fit samples.csv", "angles in degrees"},
    {"burnish lobe fit samples.csv --offset --format=json", "over diffuse light"},
    {"burnish lobe fit samples.csv --residuals --format=csv -o residuals.csv", "every sample"},
    {NULL, NULL},
};

const cli_command lobe_fit_command = {
    .name = "lobe fit",
    .operand = "FILE",
    .summary = "the lobe that fits measured angles and intensities",
    .operand_help = "CSV: angle and intensity per line; # begins a comment; - is standard input",
    .manual =
        "Reads samples of a highlight, an angle from its centre and an intensity per line, between "
        "commas, semicolons, tabs or blanks; one header row, empty lines and lines that begin with "
        "# are ignored. The limit is a million samples. For each order of the family, least "
        "squares find the slope, the scale and, with *--offset*, the offset; for the comparison "
        "lobes, the exponent. The lobes are ranked by their residuals.\n"
        "Order and slope define a lobe of the family; the equivalent exponent depends on the fit "
        "and is printed for each fit. If no lobe explains half of the variation, the command fails "
        "with exit code 4.",
    .operands_max = 1,
    .flags = fit_flags,
    .flag_count = sizeof fit_flags / sizeof *fit_flags,
    .examples = examples,
    .settings_size = sizeof(fit_settings),
    .work = work,
};

/* The results. */
typedef struct findings {
    const fit_settings *settings;
    const char *path;
    lobe_samples samples;
    lobe_fitted fitted[LOBE_FITTED_MAX];
    size_t count;
} findings;

/* The fits that map an exponent to a slope. */
static const struct {
    burnish_lobe_fit fit;
    const char *name;
} named_fits[] = {{BURNISH_FIT_ENERGY, "energy"},
                  {BURNISH_FIT_TAYLOR, "taylor"},
                  {BURNISH_FIT_LEVEL, "level0.5"},
                  {BURNISH_FIT_PROJECTED, "projected"},
                  {BURNISH_FIT_MINIMAX, "minimax"}};

enum { NAMED_FITS = sizeof named_fits / sizeof *named_fits };

/* "order 4", "power" */
static const char *shape_name(const lobe_fitted *f, char text[LOBE_NAME]) {
    if (f->model.lobe.kind == BURNISH_LOBE_FAMILY) {
        snprintf(text, LOBE_NAME, "order %d", f->model.lobe.order);
    } else {
        burnish_lobe_spec_name(&f->model.lobe, text, LOBE_NAME);
    }
    return text;
}

static double exponent_as(const lobe_fitted *f, burnish_lobe_fit fit) {
    return f->model.lobe.kind == BURNISH_LOBE_FAMILY
               ? lobe_exponent_of_slope(fit, f->model.lobe.order, f->model.zeta)
               : f->model.exponent;
}

/* ---- The table of all lobes ---- */

enum { COLUMNS = 10 };

static const cli_column columns[COLUMNS] = {
    {.key = "lobe", .heading = "lobe", .is_text = 1},
    {.key = "zeta", .heading = "zeta", .decimals = -6},
    {.key = "exponent", .heading = "exponent", .decimals = -6},
    {.key = "scale", .heading = "scale", .decimals = -5},
    {.key = "offset", .heading = "offset", .decimals = -4},
    {.key = "rms", .heading = "rms", .decimals = -4},
    {.key = "max", .heading = "max", .decimals = -4},
    {.key = "explained_percent", .heading = "explained", .unit = "%", .decimals = 3},
    {.key = "operations", .heading = "ops"},
    {.key = "slow_operations", .heading = "div, fn"},
};

static void fill_row(const findings *found, size_t i, char name[LOBE_NAME],
                     cli_value row[COLUMNS]) {
    const lobe_fitted *f = &found->fitted[i];
    burnish_theory_cost cost = burnish_theory_model_cost(&f->model);
    row[0].text = shape_name(f, name);
    row[1].number = f->model.lobe.kind == BURNISH_LOBE_FAMILY ? f->model.zeta : NAN;
    row[2].number = exponent_as(f, BURNISH_FIT_ENERGY);
    row[3].number = f->scale;
    row[4].number = f->offset;
    row[5].number = f->rms;
    row[6].number = f->maximum;
    row[7].number = 100 * lobe_explained(&found->samples, f);
    row[8].number = cost.multiplications + cost.additions + cost.comparisons;
    row[9].number = cost.divisions + cost.transcendentals;
}

static void print_sentence(FILE *stream, const findings *found) {
    const fit_settings *settings = found->settings;
    const lobe_fitted *f = &found->fitted[0];
    char name[LOBE_NAME];
    fprintf(stream, "%zu samples. Best: %.5g times ", found->samples.count, f->scale);
    if (f->model.lobe.kind == BURNISH_LOBE_FAMILY) {
        fprintf(stream, "max(0, 1 - %.6g (1 - c))^%d", f->model.zeta, f->model.lobe.order);
    } else {
        fprintf(stream, "%s with exponent %.6g", shape_name(f, name), f->model.exponent);
    }
    if (settings->offset) {
        fprintf(stream, " %c %.5g", f->offset < 0 ? '-' : '+', fabs(f->offset));
    }
    fprintf(stream, "\nResiduals: rms %.4g, largest %.4g at %.6g%s.\n", f->rms, f->maximum,
            found->samples.items[f->worst].x,
            settings->unit == LOBE_UNIT_DEGREES   ? " degrees"
            : settings->unit == LOBE_UNIT_RADIANS ? " radians"
                                                  : "");
    if (f->at_limit) {
        fprintf(stream, "The search ended at the end of its range: the samples do not say how wide "
                        "the lobe is.\n");
    }
}

/* Prints the same lobe as arguments for the other commands. */
static void print_names(FILE *stream, const lobe_fitted *f) {
    int first = 1;
    if (f->model.lobe.kind != BURNISH_LOBE_FAMILY) {
        return;
    }
    fprintf(stream, "The same lobe, by fit and exponent:\n");
    for (int i = 0; i < NAMED_FITS; ++i) {
        double n = exponent_as(f, named_fits[i].fit);
        if (!isnan(n)) {
            fprintf(stream, "%s%s:%d %.6g", first ? "  " : ",  ", named_fits[i].name,
                    f->model.lobe.order, n);
            first = 0;
        }
    }
    fprintf(stream, first ? "  none with an exponent from the order up\n" : "\n");
}

static void add_best(cJSON *root, const findings *found, int *failed) {
    const lobe_fitted *f = &found->fitted[0];
    int is_family = f->model.lobe.kind == BURNISH_LOBE_FAMILY;
    char name[LOBE_NAME];
    cJSON *best = cJSON_CreateObject(), *names = cJSON_CreateObject();
    cli_json_add(best, "lobe", cJSON_CreateString(shape_name(f, name)), failed);
    cli_json_add(best, "order",
                 is_family ? cJSON_CreateNumber(f->model.lobe.order) : cJSON_CreateNull(), failed);
    cli_json_add(best, "zeta", cli_json_real(is_family ? f->model.zeta : NAN), failed);
    for (int i = 0; is_family && i < NAMED_FITS; ++i) {
        char key[48];
        snprintf(key, sizeof key, "%s:%d", named_fits[i].name, f->model.lobe.order);
        cli_json_add(names, key, cli_json_real(exponent_as(f, named_fits[i].fit)), failed);
    }
    if (!is_family) {
        cli_json_add(names, name, cli_json_real(f->model.exponent), failed);
    }
    cli_json_add(best, "exponents", names, failed);
    cli_json_add(best, "scale", cli_json_real(f->scale), failed);
    cli_json_add(best, "offset", cli_json_real(f->offset), failed);
    cli_json_add(best, "rms", cli_json_real(f->rms), failed);
    cli_json_add(best, "max", cli_json_real(f->maximum), failed);
    cli_json_add(best, "at_limit", cJSON_CreateBool(f->at_limit), failed);
    cli_json_add(root, "best", best, failed);
}

static void print_lobes(FILE *stream, const cli_table *table, const void *context) {
    const findings *found = context;
    print_sentence(stream, found);
    print_names(stream, &found->fitted[0]);
    fputc('\n', stream);
    cli_table_text(stream, table);
    fprintf(stream, "\nExponents of orders are those of the fit energy.\n");
}

static void add_lobe_keys(cJSON *root, const void *context, int *failed) {
    const findings *found = context;
    cli_json_add(root, "samples", cli_json_count(found->samples.count), failed);
    add_best(root, found, failed);
}

static burnish_status write_lobes(const findings *found, burnish_error *error) {
    cli_value cells[LOBE_FITTED_MAX][COLUMNS];
    char names[LOBE_FITTED_MAX][LOBE_NAME];
    for (size_t i = 0; i < found->count; ++i) {
        fill_row(found, i, names[i], cells[i]);
    }
    const cli_table table = {
        .columns = columns, .cells = cells[0], .column_count = COLUMNS, .row_count = found->count};
    const cli_document document = {"lobes", print_lobes, add_lobe_keys, found};
    return cli_document_write(&document, &table, (cli_format)found->settings->format,
                              found->settings->output, error);
}

/* ---- Residuals ---- */

enum { RESIDUAL_COLUMNS = 4 };

static void print_residuals(FILE *stream, const cli_table *table, const void *context) {
    print_sentence(stream, context);
    fputc('\n', stream);
    cli_table_text(stream, table);
}

static void add_residual_keys(cJSON *root, const void *context, int *failed) {
    add_best(root, context, failed);
}

static burnish_status write_residuals(const findings *found, burnish_error *error) {
    static const cli_column first[] = {
        [LOBE_UNIT_DEGREES] = {"angle_deg", "angle", "deg", .decimals = -7},
        [LOBE_UNIT_RADIANS] = {"angle_rad", "angle", "rad", .decimals = -7},
        [LOBE_UNIT_COSINE] = {"cosine", "cosine", "", .decimals = -7},
    };
    const cli_column residual_columns[RESIDUAL_COLUMNS] = {
        first[found->settings->unit],
        {.key = "intensity", .heading = "intensity", .decimals = -6},
        {.key = "fitted", .heading = "fitted", .decimals = -6},
        {.key = "residual", .heading = "residual", .decimals = -4},
    };
    cli_table table = {.columns = residual_columns,
                       .column_count = RESIDUAL_COLUMNS,
                       .row_count = found->samples.count};
    table.cells = calloc(table.row_count * RESIDUAL_COLUMNS, sizeof *table.cells);
    if (!table.cells) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the residuals");
    }
    for (size_t i = 0; i < table.row_count; ++i) {
        const lobe_sample *sample = &found->samples.items[i];
        const double residual = lobe_residual(&found->fitted[0], sample);
        cli_value *row = &table.cells[i * RESIDUAL_COLUMNS];
        row[0].number = sample->x;
        row[1].number = sample->intensity;
        row[2].number = sample->intensity - residual;
        row[3].number = residual;
    }
    const cli_document document = {"residuals", print_residuals, add_residual_keys, found};
    burnish_status status = cli_document_write(
        &document, &table, (cli_format)found->settings->format, found->settings->output, error);
    free(table.cells);
    return status;
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    const fit_settings *settings = target;
    findings found = {.settings = settings};
    if (call->operand_count == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "lobe fit: no FILE; give CSV with angle and intensity per line, or "
                        "see \"burnish lobe fit --help\"");
    }
    found.path = strcmp(call->operands[0], "-") == 0 ? "standard input" : call->operands[0];
    burnish_status status =
        lobe_read_samples(call->operands[0], (lobe_unit)settings->unit, &found.samples, error);
    if (status == BURNISH_STATUS_OK) {
        status = lobe_fit_samples(&found.samples, settings->offset, found.path, found.fitted,
                                  &found.count, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = settings->residuals ? write_residuals(&found, error) : write_lobes(&found, error);
    }
    free(found.samples.items);
    return status;
}
