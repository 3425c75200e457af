/* `burnish-lobe claims`: recomputes the paper's statements and gives verdicts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/lobe.h"

typedef struct claims_settings {
    const char *output;
    int format;
} claims_settings;

static cli_work work;

static const cli_flag claims_flags[] = {
    CLI_FORMAT_FLAG(claims_settings, cli_table_format_words, "text"),
    CLI_OUTPUT_FLAG(claims_settings, NULL),
};

static const cli_example examples[] = {
    {"burnish-lobe claims", "all of them, with a count of the verdicts"},
    {"burnish-lobe claims core-w", "one"},
    {"burnish-lobe claims --format=json -o claims.json", "for programs"},
    {NULL, NULL},
};

const cli_command lobe_claims_command = {
    .name = "claims",
    .operand = "[ID]",
    .summary = "check the paper's statements",
    .operand_help = "a claim, such as core-w; default: all claims",
    .manual = "Recomputes every number in the paper on the order 2 lobe and reports whether each "
              "statement holds, holds in part (a note lists for which numbers), or does not hold. "
              "The paper approximates BRDFs by cosine-quadratic functions; its "
              "references date it after 2005, and no bibliographic record of it was found. "
              "Statements from elsewhere name their source. *make bench* measures speeds and "
              "*make operations* counts operations in machine code.\n"
              "A verdict is a result, not a failure: the exit code stays 0.",
    .operands_max = 1,
    .flags = claims_flags,
    .flag_count = sizeof claims_flags / sizeof *claims_flags,
    .examples = examples,
    .settings_size = sizeof(claims_settings),
    .work = work,
};

typedef struct claim_list {
    burnish_theory_claim *items;
    size_t count;
} claim_list;

static const char *relation_text(burnish_theory_relation relation) {
    static const char *const texts[] = {"at most", "at least", "about", ""};
    return texts[relation];
}

static const char *id_at(const void *list, size_t index) {
    burnish_theory_claim claim;
    (void)list;
    return burnish_theory_claim_compute(index, &claim) == BURNISH_STATUS_OK ? claim.id : NULL;
}

/* Computes all claims, or the claim with that id. */
static burnish_status compute(const char *id, claim_list *list, burnish_error *error) {
    size_t count = burnish_theory_claim_count();
    list->items = calloc(count, sizeof *list->items);
    if (!list->items) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu claims", count);
    }
    for (size_t i = 0; i < count; ++i) {
        (void)burnish_theory_claim_compute(i, &list->items[list->count]); /* i is in range */
        list->count += !id || strcmp(list->items[list->count].id, id) == 0;
    }
    return list->count > 0
               ? BURNISH_STATUS_OK
               : cli_fail_unknown(error, "claims", "claim", id, id_at, NULL, "burnish-lobe claims");
}

/* ---- Text ---- */

enum { INDENT = 4 };

static const char PAPER[] = "the paper";

static void print_bound(FILE *stream, const burnish_theory_claim *claim) {
    char number[CLI_REAL_SIZE];
    if (claim->relation != BURNISH_THEORY_NONE) {
        fprintf(stream, "%s %s", relation_text(claim->relation),
                cli_shortest(claim->bound, number));
    }
}

static void format_value(double value, char *text, size_t size) {
    snprintf(text, size, "%.5g", fabs(value) < 1e-13 ? 0.0 : value);
}

/* Prints the values in columns of equal width. An asterisk marks values without a verdict. */
static void print_values(FILE *stream, const burnish_theory_claim *claim) {
    int label = 0, number = 0, unjudged = 0;
    char text[32];
    for (int i = 0; i < claim->count; ++i) {
        format_value(claim->values[i].value, text, sizeof text);
        label = (int)strlen(claim->values[i].label) > label ? (int)strlen(claim->values[i].label)
                                                            : label;
        number = (int)strlen(text) > number ? (int)strlen(text) : number;
        unjudged = unjudged || !claim->values[i].judged;
    }
    int width = label + number + unjudged + 5;
    int columns = (CLI_TEXT_WIDTH - INDENT + 3) / width;
    columns = columns > 6 ? 6 : columns < 1 ? 1 : columns;
    for (int i = 0; i < claim->count; ++i) {
        int last = i + 1 == claim->count || (i + 1) % columns == 0;
        format_value(claim->values[i].value, text, sizeof text);
        fprintf(stream, "%*s%-*s  %*s%s", i % columns == 0 ? INDENT : 0, "", label,
                claim->values[i].label, number, text, claim->values[i].judged ? "" : "*");
        fprintf(stream, "%*s", last ? 0 : 3 + (unjudged && claim->values[i].judged), "");
        fputs(last ? "\n" : "", stream);
    }
    if (unjudged) {
        fprintf(stream, "%*s(* for information, not judged)\n", INDENT, "");
    }
}

static void print_claim(FILE *stream, const burnish_theory_claim *claim) {
    const char *verdict = burnish_theory_verdict_text(claim->verdict);
    fprintf(stream, "%-*s%s\n%*s", CLI_TEXT_WIDTH - (int)strlen(verdict), claim->id, verdict, 2,
            "");
    cli_print_wrapped(stream, claim->claim, 2, CLI_TEXT_WIDTH);
    if (strcmp(claim->source, PAPER) != 0) {
        fprintf(stream, "  Source: %s, not the paper\n", claim->source);
    }
    if (claim->count > 0) {
        fprintf(stream, "  %s: ", claim->quantity);
        print_bound(stream, claim);
        fputc('\n', stream);
        print_values(stream, claim);
    }
    if (*claim->note) {
        fprintf(stream, "  Note: ");
        cli_print_wrapped(stream, claim->note, 8, CLI_TEXT_WIDTH);
    }
    fprintf(stream, "  $ %s\n", claim->command);
}

static void print_count(FILE *stream, const claim_list *list) {
    int counts[BURNISH_THEORY_VERDICT_COUNT] = {0};
    for (size_t i = 0; i < list->count; ++i) {
        ++counts[list->items[i].verdict];
    }
    char text[256];
    int length = snprintf(text, sizeof text, "%zu claims.", list->count);
    for (int i = 0; i < BURNISH_THEORY_VERDICT_COUNT; ++i) {
        length +=
            snprintf(text + length, sizeof text - (size_t)length, "%s %s: %d", i > 0 ? ";" : "",
                     burnish_theory_verdict_text((burnish_theory_verdict)i), counts[i]);
    }
    fputc('\n', stream);
    cli_print_wrapped(stream, text, 0, CLI_TEXT_WIDTH);
}

static void print_text(FILE *stream, const claim_list *list) {
    for (size_t i = 0; i < list->count; ++i) {
        fputs(i > 0 ? "\n" : "", stream);
        print_claim(stream, &list->items[i]);
    }
    if (list->count > 1) {
        print_count(stream, list);
    }
}

/* ---- Markdown, CSV, JSON ---- */

/* The least and the greatest of the judged values. */
static void judged_range(const burnish_theory_claim *claim, double *low, double *high) {
    *low = INFINITY;
    *high = -INFINITY;
    for (int i = 0; i < claim->count; ++i) {
        if (claim->values[i].judged) {
            *low = fmin(*low, claim->values[i].value);
            *high = fmax(*high, claim->values[i].value);
        }
    }
}

static void print_markdown(FILE *stream, const claim_list *list) {
    fprintf(stream, "| claim | what is computed | stated | computed | verdict |\n"
                    "| --- | --- | --- | --- | --- |\n");
    for (size_t i = 0; i < list->count; ++i) {
        const burnish_theory_claim *claim = &list->items[i];
        char low_text[32], high_text[32];
        double low, high;
        judged_range(claim, &low, &high);
        format_value(low, low_text, sizeof low_text);
        format_value(high, high_text, sizeof high_text);
        fprintf(stream, "| %s", claim->claim);
        if (strcmp(claim->source, PAPER) != 0) {
            fprintf(stream, " (%s, not the paper)", claim->source);
        }
        fprintf(stream, " | %s | ", claim->quantity);
        print_bound(stream, claim);
        fprintf(stream, " | %s%s%s | %s |\n", claim->count > 0 ? low_text : "",
                strcmp(low_text, high_text) != 0 && claim->count > 0 ? " to " : "",
                strcmp(low_text, high_text) != 0 && claim->count > 0 ? high_text : "",
                burnish_theory_verdict_text(claim->verdict));
    }
}

/* A row for every value; a claim without values has one row with empty fields. */
static void print_csv(FILE *stream, const claim_list *list) {
    fprintf(stream, "id,claim,quantity,note,label,value,judged,relation,bound,unit,verdict,source,"
                    "command\n");
    for (size_t i = 0; i < list->count; ++i) {
        const burnish_theory_claim *claim = &list->items[i];
        for (int k = 0; k < (claim->count > 0 ? claim->count : 1); ++k) {
            const char *texts[] = {claim->id, claim->claim, claim->quantity, claim->note};
            for (size_t t = 0; t < sizeof texts / sizeof *texts; ++t) {
                cli_csv_text(stream, texts[t]);
                fputc(',', stream);
            }
            if (k < claim->count) {
                cli_csv_text(stream, claim->values[k].label);
                fputc(',', stream);
                cli_csv_real(stream, claim->values[k].value);
                fprintf(stream, ",%d,", claim->values[k].judged);
            } else {
                fprintf(stream, ",,,");
            }
            fprintf(stream, "%s,", relation_text(claim->relation));
            cli_csv_real(stream, claim->bound);
            fputc(',', stream);
            cli_csv_real(stream, claim->unit);
            fputc(',', stream);
            cli_csv_text(stream, burnish_theory_verdict_text(claim->verdict));
            fputc(',', stream);
            cli_csv_text(stream, claim->source);
            fputc(',', stream);
            cli_csv_text(stream, claim->command);
            fputc('\n', stream);
        }
    }
}

static cJSON *claim_object(const burnish_theory_claim *claim, int *failed) {
    cJSON *object = cJSON_CreateObject(), *values = cJSON_CreateArray();
    cli_json_add(object, "id", cJSON_CreateString(claim->id), failed);
    cli_json_add(object, "claim", cJSON_CreateString(claim->claim), failed);
    cli_json_add(object, "source", cJSON_CreateString(claim->source), failed);
    cli_json_add(object, "quantity", cJSON_CreateString(claim->quantity), failed);
    for (int i = 0; i < claim->count; ++i) {
        cJSON *value = cJSON_CreateObject();
        cli_json_add(value, "label", cJSON_CreateString(claim->values[i].label), failed);
        cli_json_add(value, "value", cli_json_real(claim->values[i].value), failed);
        cli_json_add(value, "judged", cJSON_CreateBool(claim->values[i].judged), failed);
        cli_json_add(values, NULL, value, failed);
    }
    cli_json_add(object, "values", values, failed);
    cli_json_add(object, "relation", cJSON_CreateString(relation_text(claim->relation)), failed);
    cli_json_add(object, "bound", cli_json_real(claim->bound), failed);
    cli_json_add(object, "unit", cli_json_real(claim->unit), failed);
    cli_json_add(object, "verdict", cJSON_CreateString(burnish_theory_verdict_text(claim->verdict)),
                 failed);
    cli_json_add(object, "note", cJSON_CreateString(claim->note), failed);
    cli_json_add(object, "command", cJSON_CreateString(claim->command), failed);
    return object;
}

static burnish_status print_json(FILE *stream, const claim_list *list, burnish_error *error) {
    int failed = 0;
    cJSON *root = cJSON_CreateObject(), *claims = cJSON_CreateArray();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), &failed);
    for (size_t i = 0; i < list->count; ++i) {
        cli_json_add(claims, NULL, claim_object(&list->items[i], &failed), &failed);
    }
    cli_json_add(root, "claims", claims, &failed);
    return cli_json_print(stream, root, failed, error);
}

static burnish_status print_claims(const claims_settings *settings, const claim_list *list,
                                   burnish_error *error) {
    cli_output output;
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    switch ((cli_format)settings->format) {
    case CLI_FORMAT_TEXT:
        print_text(output.stream, list);
        break;
    case CLI_FORMAT_MARKDOWN:
        print_markdown(output.stream, list);
        break;
    case CLI_FORMAT_CSV:
        print_csv(output.stream, list);
        break;
    case CLI_FORMAT_JSON:
        status = print_json(output.stream, list, error);
        break;
    }
    return cli_output_end(&output, settings->output, status, error);
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    claim_list list = {0};
    burnish_status status =
        compute(call->operand_count > 0 ? call->operands[0] : NULL, &list, error);
    if (status == BURNISH_STATUS_OK) {
        status = print_claims(target, &list, error);
    }
    free(list.items);
    return status;
}
