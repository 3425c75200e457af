/* Shared by the subcommands of `burnish lobe`: lists of exponents and lobes, costs as text. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/values.h"
#include "lobe/lists.h"

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
 * first one, so rounding errors do not accumulate; a small tolerance includes the last one.
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
                            "--%s: more than %d lobes; use several runs", flag, LOBE_LOBES_MAX);
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
