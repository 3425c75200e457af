/* Shared by the subcommands of `burnish-lobe`: lists of exponents, lobes and metrics, costs as text. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/lobe.h"

/* A range: each number is the previous one plus `by` or, with multiply, times `by`. */
typedef struct span {
    double from, to, by;
    int multiply;
} span;

static int read_exponent(const char *text, size_t length, double *value) {
    return cli_read_real(text, length, value) && *value >= 1 && *value <= 65536;
}

/* "10", "1-1023", "10-100:10", "2-1024x2"; Returns 0 for anything else. */
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

/* Adds the numbers of a span, or counts them if items is NULL. Every number is computed from the
 * first one, so rounding errors do not accumulate; a small tolerance includes the last one. */
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
                            "--%s: more than %d lobes; use several runs", flag, LOBE_LOBES_MAX);
        }
        snprintf(word, sizeof word, "%.*s", length < 60 ? (int)length : 60, item);
        /* every order exists for the largest exponent */
        if (burnish_theory_model_parse(word, 65536, &model, &reason) != BURNISH_STATUS_OK) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: %s", flag, reason.text);
        }
        burnish_lobe_spec lobe; /* its own words: "exact" is another lobe for each exponent */
        (void)burnish_lobe_spec_parse_any(word, &lobe, NULL);
        burnish_lobe_spec_name(&lobe, list->items[list->count++], LOBE_NAME);
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

/* ---- Metrics ---- */

void lobe_each_metric(cli_take_term *take) {
    const burnish_theory_metric *metric;
    for (size_t i = 0; (metric = burnish_theory_metric_at(i)) != NULL; ++i) {
        char tag[64];
        snprintf(tag, sizeof tag, "*%s*%s%s%s", metric->name, metric->takes ? "[:_" : "",
                 metric->takes ? metric->takes : "", metric->takes ? "_]" : "");
        take(tag, metric->about);
    }
}

void lobe_metric_column(const lobe_metric *choice, cli_column *column) {
    const burnish_theory_metric *metric = choice->metric;
    char suffix[16] = "";
    if (metric->takes) {
        snprintf(suffix, sizeof suffix, "%.6g", choice->argument);
    }
    *column = (cli_column){.decimals = metric->decimals};
    snprintf(column->key, sizeof column->key, "%s%s%s", metric->key, *suffix ? "_" : "", suffix);
    snprintf(column->heading, sizeof column->heading, "%s%s%s", metric->heading, *suffix ? ":" : "",
             suffix);
    snprintf(column->unit, sizeof column->unit, "%s", metric->unit);
}

static const char *metric_name_at(const void *list, size_t index) {
    const burnish_theory_metric *metric = burnish_theory_metric_at(index);
    (void)list;
    return metric ? metric->name : NULL;
}

static int matches(const char *name, const char *item, size_t length) {
    return strlen(name) == length && memcmp(name, item, length) == 0;
}

/* Reads the text after the colon; returns 0 if the metric does not take it. */
static int read_argument(const burnish_theory_metric *metric, const char *text, size_t length,
                         double *argument) {
    return metric->takes && cli_read_real(text, length, argument) && *argument >= metric->low &&
           *argument <= metric->high &&
           (strcmp(metric->takes, "LOBES") != 0 || *argument == floor(*argument));
}

static burnish_status fail_argument(const char *flag, const burnish_theory_metric *metric,
                                    const char *item, size_t length, burnish_error *error) {
    static const char *const hints[][2] = {
        {"BITS", "takes bits above 0 and up to 1024, as in angle:8"},
        {"DEG", "takes degrees from 0 to 90, as in value:10"},
        {"LENGTH", "takes a length from 0 to 1, as in toksvig:0.9"},
        {"LOBES", "takes 1, 2 or 3 lobes, as in ggx-moved:2"},
    };
    const char *hint = "takes no number; remove the text after the colon";
    for (size_t i = 0; metric->takes && i < sizeof hints / sizeof *hints; ++i) {
        hint = strcmp(metric->takes, hints[i][0]) == 0 ? hints[i][1] : hint;
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: \"%.*s\": %s %s", flag,
                    length < 60 ? (int)length : 60, item, metric->name, hint);
}

/* Adds the metrics of an item, a name with or without an argument, or a group. */
static burnish_status add_metrics(const char *flag, const char *item, size_t length,
                                  lobe_metrics *list, burnish_error *error) {
    const char *colon = memchr(item, ':', length);
    const size_t name = colon ? (size_t)(colon - item) : length, before = list->count;
    const burnish_theory_metric *metric;
    for (size_t i = 0; (metric = burnish_theory_metric_at(i)) != NULL; ++i) {
        double argument = metric->usual;
        if (matches(metric->name, item, name)) {
            if (colon && !read_argument(metric, colon + 1, length - name - 1, &argument)) {
                return fail_argument(flag, metric, item, length, error);
            }
        } else if (!matches(metric->group, item, length) &&
                   !(matches("all", item, length) && strcmp(metric->group, "sums") != 0)) {
            continue;
        }
        if (list->count == LOBE_METRICS_MAX) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d metrics", flag,
                            LOBE_METRICS_MAX);
        }
        list->items[list->count++] = (lobe_metric){metric, argument};
    }
    if (list->count > before) {
        return BURNISH_STATUS_OK;
    }
    char where[CLI_NAME_MAX + 1], typed[CLI_NAME_MAX + 1];
    snprintf(where, sizeof where, "--%s", flag);
    snprintf(typed, sizeof typed, "%.*s", name < CLI_NAME_MAX ? (int)name : CLI_NAME_MAX, item);
    return cli_fail_unknown(error, where, "metric", typed, metric_name_at, NULL,
                            "burnish-lobe help --man");
}

burnish_status lobe_read_metrics(const char *flag, const char *text, lobe_metrics *list,
                                 burnish_error *error) {
    const char *rest = text, *item;
    burnish_status status = BURNISH_STATUS_OK;
    list->count = 0;
    while (rest && status == BURNISH_STATUS_OK) {
        size_t length = cli_next_item(&rest, ',', &item);
        status = add_metrics(flag, item, length, list, error);
    }
    return status;
}
