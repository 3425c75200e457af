/* The figure `cost`: every lobe's error beside what it costs, and the front that none of them
 * beats. */
#include <math.h>
#include <string.h>

#include "plot/plot.h"

enum { COLUMN_GAP = 3, BAND_GAP = 5, BAND_INDENT = 2 }; /* letters */

typedef struct candidate {
    char word[PLOT_LOBE_SIZE];
    burnish_theory_model model;
    burnish_theory_cost cost;
    double error;
    double column; /* its place on the axis; lobes of equal cost share one */
} candidate;

static int simple_operations(const burnish_theory_cost *cost) {
    return cost->multiplications + cost->additions + cost->comparisons;
}

/* The dearest kind of operation: what the columns are grouped by. */
static const char *heading(const burnish_theory_cost *cost) {
    return cost->transcendentals > 0 ? "with pow, exp or acos"
           : cost->divisions > 0     ? "with a division"
           : cost->lookups > 0       ? "with a table"
                                     : "multiplications, additions, maximum only";
}

static void sort_by_cost(candidate *candidates, size_t count) {
    for (size_t i = 1; i < count; ++i) {
        candidate moving = candidates[i];
        size_t k = i;
        for (; k > 0 && burnish_theory_cost_order(&candidates[k - 1].cost, &moving.cost) > 0; --k) {
            candidates[k] = candidates[k - 1];
        }
        candidates[k] = moving;
    }
}

/* Columns are as wide, in letters, as the names that stand in them, and bands at least as wide as
 * their headings. */
static void place_columns(candidate *candidates, size_t count) {
    double column = 0, band = 0;
    size_t widest = 0;
    for (size_t i = 0; i < count; ++i) {
        size_t length = strlen(candidates[i].word);
        const burnish_theory_cost *before = &candidates[i > 0 ? i - 1 : 0].cost;
        if (burnish_theory_cost_order(before, &candidates[i].cost) != 0) {
            int new_band = strcmp(heading(before), heading(&candidates[i].cost)) != 0;
            column += (double)widest + COLUMN_GAP + (new_band ? BAND_GAP : 0);
            widest = 0;
            if (new_band) {
                band = fmax(column, band + (double)strlen(heading(before)) + BAND_GAP);
                column = band;
            }
        }
        widest = length > widest ? length : widest;
        candidates[i].column = column;
    }
}

static burnish_status measure(const plot_request *request, candidate *candidates,
                              burnish_error *error) {
    for (size_t i = 0; i < request->lobe_count; ++i) {
        candidate *c = &candidates[i];
        memcpy(c->word, request->lobes[i], sizeof c->word);
        burnish_status status = plot_model(c->word, request->exponents[0], &c->model, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        c->cost = burnish_theory_model_cost(&c->model);
        c->error = burnish_theory_maximum_error(&c->model, acos(0));
    }
    sort_by_cost(candidates, request->lobe_count);
    place_columns(candidates, request->lobe_count);
    return BURNISH_STATUS_OK;
}

/* A tick a column, a band a kind of operation. */
static void fill_columns(const candidate *candidates, size_t count, plot_chart *chart) {
    plot_axis *axis = &chart->x;
    for (size_t i = 0; i < count; ++i) {
        const candidate *c = &candidates[i];
        if (i == 0 || c->column != candidates[i - 1].column) {
            plot_tick *tick = &axis->ticks[axis->tick_count++];
            tick->at = c->column;
            snprintf(tick->text, sizeof tick->text, "%d", simple_operations(&c->cost));
        }
        if (i == 0 || strcmp(heading(&c->cost), heading(&candidates[i - 1].cost)) != 0) {
            chart->bands[chart->band_count++] =
                (plot_band){heading(&c->cost), c->column - BAND_INDENT};
        }
    }
    axis->low = -BAND_INDENT;
    axis->high =
        candidates[count - 1].column + (double)strlen(candidates[count - 1].word) + COLUMN_GAP;
}

/* The stairs below which no lobe of these lies. */
static burnish_status fill_front(const candidate *candidates, size_t count, plot_chart *chart,
                                 burnish_error *error) {
    plot_series *front = plot_add_series(chart, error);
    if (!front) {
        return error->status;
    }
    snprintf(front->name, sizeof front->name, "front");
    front->ink = PLOT_INK_AXIS;
    front->style = PLOT_STAIRS;
    double best = INFINITY;
    for (size_t i = 0; i < count; ++i) {
        const candidate *c = &candidates[i];
        if (!(c->error < best)) {
            continue;
        }
        if (front->count > 0 && front->x[front->count - 1] == c->column) {
            front->y[front->count - 1] = c->error;
        } else {
            if (front->count > 0) {
                front->x[front->count] = c->column;
                front->y[front->count++] = best;
            }
            front->x[front->count] = c->column;
            front->y[front->count++] = c->error;
        }
        best = c->error;
    }
    if (front->count > 0) {
        front->x[front->count] = chart->x.high;
        front->y[front->count++] = best;
    }
    return BURNISH_STATUS_OK;
}

burnish_status plot_fill_cost(const plot_request *request, plot_chart *chart,
                              burnish_error *error) {
    candidate candidates[PLOT_LIST_MAX];
    size_t count = request->lobe_count;
    burnish_status status = measure(request, candidates, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    fill_columns(candidates, count, chart);
    status = fill_front(candidates, count, chart, error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        const candidate *c = &candidates[i];
        plot_series *point = plot_add_series(chart, error);
        if (!point) {
            return error->status;
        }
        int family =
            c->model.lobe.kind == BURNISH_LOBE_FAMILY || c->model.lobe.kind == BURNISH_LOBE_LYON;
        snprintf(point->name, sizeof point->name, "%.*s", (int)sizeof c->word, c->word);
        point->ink = PLOT_INK_LOBE + !family;
        point->style = family ? PLOT_DISCS : PLOT_RINGS;
        point->count = 1;
        point->x[0] = c->column;
        point->y[0] = c->error > 0 ? c->error : NAN;
        plot_note *note = &chart->notes[chart->note_count++];
        snprintf(note->text, sizeof note->text, "%.*s%s", (int)sizeof c->word, c->word,
                 c->error > 0 ? "" : " (no error)");
        note->x = c->column;
        note->y = c->error;
        note->ink = point->ink;
    }
    chart->x.title = "cost of one value: additions, multiplications and comparisons";
    chart->x.column = "column";
    plot_state_exponent(request, chart);
    chart->y.title = "largest absolute error, angles from 0° to 90°";
    chart->y.column = "maximum_error";
    chart->y.logarithmic = 1;
    return status;
}
