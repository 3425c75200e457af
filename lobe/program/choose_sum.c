#include "program/lobe.h"

#include <math.h>

const cli_word lobe_distribution_words[] = {
    {"ggx", BURNISH_THEORY_GGX}, {"beckmann", BURNISH_THEORY_BECKMANN}, {NULL, 0}};

enum { COLUMNS = 6 };

typedef struct result {
    const lobe_sum_wish *wish;
    burnish_theory_lobe_sum sums[BURNISH_THEORY_LOBE_SUM_MAX];
    burnish_theory_lobe_sum_error errors[BURNISH_THEORY_LOBE_SUM_MAX];
    int best; /* number of lobes; 0: none is close enough */
} result;

static const cli_column columns[COLUMNS] = {
    {.key = "lobes", .heading = "lobes"},
    {.key = "within_epsilon", .heading = "within", .is_yes_no = 1},
    {.key = "moved_percent", .heading = "moved", .unit = "%", .decimals = 2},
    {.key = "cap_percent", .heading = "cap", .unit = "%", .decimals = 2},
    {.key = "multiplications", .heading = "mul"},
    {.key = "additions", .heading = "add"},
};

/* Of one evaluation from a cosine: A c + B, squarings, the weight. */
static void count_operations(const burnish_theory_lobe_sum *sum, int *multiplications,
                             int *additions) {
    *multiplications = *additions = 0;
    for (int j = 0; j < sum->count; ++j) {
        *additions += j > 0 ? 2 : 1;
        *multiplications += 2;
        for (int power = 1; power < sum->order[j]; power *= 2) {
            ++*multiplications;
        }
    }
}

static void print_code(FILE *stream, const burnish_theory_lobe_sum *sum) {
    for (int j = 0; j < sum->count; ++j) {
        const double zeta = sum->zeta[j];
        const double peak = sum->weight[j] * zeta * (sum->order[j] + 1) / (2 * CLI_PI);
        fprintf(stream, "    u = fmaxf(%.9gF * c %+.9gF, 0.0F);\n", zeta, 1 - zeta);
        for (int power = 1; power < sum->order[j]; power *= 2) {
            fprintf(stream, "    u *= u;\n");
        }
        fprintf(stream, "    specular %s %#.9gF * u;\n", j > 0 ? "+=" : "=", peak);
    }
}

static void print_text(FILE *stream, const cli_table *table, const void *context) {
    const result *r = context;
    const lobe_sum_wish *wish = r->wish;
    char roughness[CLI_REAL_SIZE], epsilon[CLI_REAL_SIZE];
    fprintf(
        stream,
        "%d lobe%s within %s of the energy of %s at roughness %s. c is the cosine to the mirror "
        "direction.\n\n",
        r->best, r->best > 1 ? "s are" : " is", cli_shortest(wish->epsilon, epsilon),
        wish->distribution == BURNISH_THEORY_GGX ? "GGX" : "Beckmann",
        cli_shortest(wish->roughness, roughness));
    print_code(stream, &r->sums[r->best - 1]);
    fprintf(stream, "\nAll candidates:\n\n");
    cli_table_text(stream, table);
}

static void add_keys(cJSON *root, const void *context, int *failed) {
    const result *r = context;
    const burnish_theory_lobe_sum *sum = &r->sums[r->best - 1];
    cJSON *lobes = cJSON_CreateArray();
    cli_json_add(root, "roughness", cli_json_real(r->wish->roughness), failed);
    cli_json_add(root, "epsilon", cli_json_real(r->wish->epsilon), failed);
    for (int j = 0; j < sum->count; ++j) {
        cJSON *lobe = cJSON_CreateObject();
        cli_json_add(lobe, "order", cli_json_real(sum->order[j]), failed);
        cli_json_add(lobe, "zeta", cli_json_real(sum->zeta[j]), failed);
        cli_json_add(lobe, "weight", cli_json_real(sum->weight[j]), failed);
        *failed |= !cJSON_AddItemToArray(lobes, lobe); /* refuses NULL */
    }
    cli_json_add(root, "sum", lobes, failed);
}

burnish_status lobe_choose_sum(const lobe_sum_wish *wish, burnish_error *error) {
    const double alpha = wish->roughness * wish->roughness;
    result r = {.wish = wish};
    cli_value cells[BURNISH_THEORY_LOBE_SUM_MAX][COLUMNS];
    double least = 1;
    for (int i = 0; i < BURNISH_THEORY_LOBE_SUM_MAX; ++i) {
        int multiplications, additions;
        const burnish_status status =
            burnish_theory_lobe_sum_fit(wish->distribution, alpha, i + 1, &r.sums[i], error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        burnish_theory_lobe_sum_compare(wish->distribution, alpha, &r.sums[i], &r.errors[i]);
        const double moved = r.errors[i].moved;
        least = moved < least ? moved : least;
        r.best = r.best == 0 && moved <= wish->epsilon ? i + 1 : r.best;
        count_operations(&r.sums[i], &multiplications, &additions);
        cells[i][0].number = i + 1;
        cells[i][1].number = moved <= wish->epsilon;
        cells[i][2].number = 100 * moved;
        cells[i][3].number = 100 * r.errors[i].cap;
        cells[i][4].number = multiplications;
        cells[i][5].number = additions;
    }
    if (r.best == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--epsilon: no sum of 3 lobes is that close; use at least %.2g",
                        ceil(1000 * least) / 1000);
    }
    const cli_table table = {.columns = columns,
                             .cells = cells[0],
                             .column_count = COLUMNS,
                             .row_count = BURNISH_THEORY_LOBE_SUM_MAX};
    const cli_document document = {"candidates", print_text, add_keys, &r};
    return cli_document_write(&document, &table, wish->format, wish->output, error);
}
