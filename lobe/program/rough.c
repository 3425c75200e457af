/* `burnish-lobe rough`: sums of lobes that approximate GGX and Beckmann. */
#include <math.h>
#include <string.h>

#include "program/lobe.h"

enum { ROUGH_MAX = 64, ROUGH_COLUMNS = 15 };

typedef struct rough_settings {
    const char *roughness, *output;
    int distribution, lobes, format;
} rough_settings;

static cli_work work;

#define TARGET(member) .offset = offsetof(rough_settings, member)

static const cli_flag rough_flags[] = {
    {.group = "Contents",
     CLI_FLAG("roughness", "LIST", "roughnesses above 0, up to 1", cli_flag_text, roughness),
     .default_text = "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1",
     .manual = "Roughnesses, between commas: the square roots of alpha."},
    {CLI_FLAG("distribution", "NAME", "distribution of normals", cli_flag_word, distribution),
     .default_text = "ggx", .words = lobe_distribution_words, .manual = "*ggx* or *beckmann*."},
    {CLI_FLAG("lobes", "N", "number of lobes, 1 to 3", cli_flag_integer, lobes), CLI_RANGE(1, 3),
     .default_text = "3", .manual = "Number of lobes in a sum."},
    CLI_FORMAT_FLAG(rough_settings, cli_table_format_words, "text"),
    CLI_OUTPUT_FLAG(rough_settings, NULL),
};

static const cli_example examples[] = {
    {"burnish-lobe rough", "three lobes for GGX"},
    {"burnish-lobe rough --roughness=0.35 --lobes=2 --format=json", "constants for a shader"},
    {NULL, NULL},
};

const cli_command lobe_rough_command = {
    .name = "rough",
    .operand = "",
    .summary = "sums of lobes for GGX and Beckmann, and their errors",
    .operand_help = "energies are shares of 1; angles are from the mirror direction",
    .manual =
        "Prints, for each roughness, a sum of lobes around the mirror direction that "
        "approximates a rough surface at normal incidence. Lobe _j_ is "
        "max(0, 1 + zeta_j (c - 1))^order_j with the share weight_j of the energy. *moved* is the "
        "energy in the wrong direction, *cap* the largest error of the light from a round light "
        "around the mirror direction, *peak* the value there, relative to the distribution's.",
    .operands_max = 0,
    .flags = rough_flags,
    .flag_count = sizeof rough_flags / sizeof *rough_flags,
    .examples = examples,
    .settings_size = sizeof(rough_settings),
    .work = work,
};

static const cli_column columns[ROUGH_COLUMNS] = {
    {.key = "roughness", .heading = "roughness", .decimals = -6},
    {.key = "moved_percent", .heading = "moved", .unit = "%", .decimals = 2},
    {.key = "cap_percent", .heading = "cap", .unit = "%", .decimals = 2},
    {.key = "peak", .heading = "peak", .decimals = 3},
    {.key = "end_angle_deg", .heading = "ends", .unit = "deg", .decimals = 1},
    {.key = "order_1", .heading = "order"},
    {.key = "zeta_1", .heading = "zeta", .decimals = -6},
    {.key = "weight_1", .heading = "weight", .decimals = 4},
    {.key = "order_2", .heading = "order"},
    {.key = "zeta_2", .heading = "zeta", .decimals = -6},
    {.key = "weight_2", .heading = "weight", .decimals = 4},
    {.key = "order_3", .heading = "order"},
    {.key = "zeta_3", .heading = "zeta", .decimals = -6},
    {.key = "weight_3", .heading = "weight", .decimals = 4},
};

static void fill_row(const rough_settings *settings, double roughness, cli_value *row) {
    burnish_theory_lobe_sum sum = {0};
    burnish_theory_lobe_sum_error errors;
    burnish_theory_distribution distribution = (burnish_theory_distribution)settings->distribution;
    double alpha = roughness * roughness, widest = HUGE_VAL;
    (void)burnish_theory_lobe_sum_fit(distribution, alpha, settings->lobes, &sum, NULL);
    burnish_theory_lobe_sum_compare(distribution, alpha, &sum, &errors);
    for (int j = 0; j < sum.count; ++j) {
        row[5 + 3 * j].number = sum.order[j];
        row[6 + 3 * j].number = sum.zeta[j];
        row[7 + 3 * j].number = sum.weight[j];
        widest = fmin(widest, sum.zeta[j]);
    }
    row[0].number = roughness;
    row[1].number = 100 * errors.moved;
    row[2].number = 100 * errors.cap;
    row[3].number = errors.peak;
    row[4].number = acos(1 - 1 / widest) / CLI_DEGREE;
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    const rough_settings *settings = target;
    static const cli_document document = {"rows", NULL, NULL, NULL};
    cli_value cells[ROUGH_MAX * ROUGH_COLUMNS];
    cli_table table = {
        .columns = columns, .cells = cells, .column_count = (size_t)(5 + 3 * settings->lobes)};
    const char *text = settings->roughness;
    (void)call;
    while (text) {
        const char *item;
        double roughness = 0;
        size_t length = cli_next_item(&text, ',', &item);
        if (!cli_read_real(item, length, &roughness) || !(roughness >= 1e-3 && roughness <= 1)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--roughness: \"%.*s\" is not a number from 0.001 to 1",
                            (int)(length < 60 ? length : 60), item);
        }
        if (table.row_count == ROUGH_MAX) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--roughness: more than %d numbers",
                            ROUGH_MAX);
        }
        fill_row(settings, roughness, cells + table.row_count++ * table.column_count);
    }
    return cli_document_write(&document, &table, (cli_format)settings->format, settings->output,
                              error);
}
