/* The figures `cost`, a row per lobe, cheapest first, and the Pareto front; and `multiplications`,
 * a curve per family. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/figures.h"

/* Kinds of series in figures.gp. */
enum { COST_FRONT = 1, COST_FAMILY, COST_OTHER, COST_EXACT, COST_HEADING };

typedef struct candidate {
    const char *word;
    burnish_theory_model model;
    burnish_theory_cost cost;
    double error;
} candidate;

/* Rows are grouped by their most expensive operation. */
static const char *heading(const burnish_theory_cost *cost) {
    return cost->transcendentals > 0 ? "with pow, exp or acos"
           : cost->divisions > 0     ? "with a division"
           : cost->lookups > 0       ? "with a table"
                                     : "multiplications, additions, maximum only";
}

static int compare_costs(const void *a, const void *b) {
    const candidate *x = a, *y = b;
    int order = burnish_theory_cost_order(&x->cost, &y->cost);
    return order ? order : (x->error > y->error) - (x->error < y->error);
}

static burnish_status price(const plot_request *request, candidate *candidates,
                            burnish_error *error) {
    for (size_t i = 0; i < request->lobes.count; ++i) {
        candidate *c = &candidates[i];
        c->word = request->lobes.items[i];
        burnish_status status =
            plot_make_model(c->word, request->exponents.items[0], &c->model, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        c->cost = burnish_theory_model_cost(&c->model);
        c->error = burnish_theory_maximum_error(&c->model, acos(0));
    }
    qsort(candidates, request->lobes.count, sizeof *candidates, compare_costs);
    return BURNISH_STATUS_OK;
}

static void add_point(plot_series *series, double x, double y) {
    series->x[series->count] = x;
    series->y[series->count++] = y;
}

/* Adds a row with its name, cost and point. The front steps down to points below it. */
static burnish_status add_row(plot_chart *chart, const candidate *c, double row,
                              burnish_error *error) {
    plot_series *front = &chart->series[0], *series = plot_add_series(chart, error);
    char cost[64], name[PLOT_TEXT_SIZE - 64 - 3];
    if (!series) {
        return error->status;
    }
    const burnish_lobe_kind kind = c->model.lobe.kind;
    int family =
        kind == BURNISH_LOBE_FAMILY || kind == BURNISH_LOBE_LYON || kind == BURNISH_LOBE_COMPOSITE;
    lobe_cost_text(&c->cost, cost, sizeof cost);
    snprintf(series->name, sizeof series->name, "%s", c->word);
    plot_name_lobe(&c->model, name, sizeof name);
    snprintf(series->text, sizeof series->text, "%s   %s", cost, name);
    series->ink = PLOT_INK_LOBE + !family;
    series->dash = !(c->error > 0) ? COST_EXACT : family ? COST_FAMILY : COST_OTHER;
    add_point(series, row, c->error > 0 ? c->error : NAN);
    double best = front->count > 0 ? front->y[front->count - 1] : INFINITY;
    if (c->error < best) {
        if (front->count > 0) { /* cos^n has a label next to it */
            add_point(front, c->error > 0 ? row : row - 0.45, best);
        }
        add_point(front, row, c->error > 0 ? c->error : NAN);
    }
    return BURNISH_STATUS_OK;
}

burnish_status plot_fill_cost(const plot_request *request, plot_chart *chart,
                              burnish_error *error) {
    candidate candidates[PLOT_LIST_MAX];
    double row = 0;
    const char *group = NULL;
    burnish_status status = price(request, candidates, error);
    plot_series *front = status == BURNISH_STATUS_OK ? plot_add_series(chart, error) : NULL;
    if (!front) {
        return status == BURNISH_STATUS_OK ? error->status : status;
    }
    snprintf(front->name, sizeof front->name, "front");
    front->ink = PLOT_INK_AXIS;
    front->dash = COST_FRONT;
    for (size_t i = 0; i < request->lobes.count && status == BURNISH_STATUS_OK; ++i) {
        const char *next = heading(&candidates[i].cost);
        if (!group || strcmp(group, next) != 0) {
            plot_series *title = plot_add_series(chart, error);
            if (!title) {
                return error->status;
            }
            group = next;
            snprintf(title->text, sizeof title->text, "%s", group);
            title->ink = PLOT_INK_TEXT;
            title->dash = COST_HEADING;
            add_point(title, ++row, NAN);
        }
        status = add_row(chart, &candidates[i], ++row, error);
    }
    chart->x_high = row;
    chart->x_column = "row";
    plot_state_exponent(request, chart);
    return status;
}

/* Neighbours in the list with the same word before the colon make a curve. */
burnish_status plot_fill_multiplications(const plot_request *request, plot_chart *chart,
                                         burnish_error *error) {
    plot_series *series = NULL;
    chart->x_low = HUGE_VAL;
    chart->x_column = "multiplications";
    plot_state_exponent(request, chart);
    for (size_t i = 0; i < request->lobes.count; ++i) {
        const char *word = request->lobes.items[i];
        const size_t length = strcspn(word, ":");
        burnish_theory_model model;
        burnish_status status = plot_make_model(word, request->exponents.items[0], &model, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        if (!series || strlen(series->name) != length || memcmp(series->name, word, length) != 0) {
            series = plot_add_series(chart, error);
            if (!series) {
                return error->status;
            }
            snprintf(series->name, sizeof series->name, "%.*s", (int)length, word);
            snprintf(series->text, sizeof series->text, "%s", series->name);
            series->ink = plot_lobe_ink(&model);
            series->dash = PLOT_LINE;
        }
        const double x = burnish_theory_model_cost(&model).multiplications;
        add_point(series, x, burnish_theory_maximum_error(&model, acos(0)));
        chart->x_low = fmin(chart->x_low, x);
        chart->x_high = fmax(chart->x_high, x);
    }
    return BURNISH_STATUS_OK;
}
