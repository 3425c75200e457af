/* Medians and quantiles of named values. */
#include "figures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const burnish_peers_figure *find(const burnish_peers_figures *figures, const char *name) {
    for (size_t i = 0; i < figures->count; ++i) {
        if (strcmp(figures->items[i].name, name) == 0) {
            return &figures->items[i];
        }
    }
    return NULL;
}

void burnish_peers_add(burnish_peers_figures *figures, const char *name, double value) {
    const burnish_peers_figure *found = find(figures, name);
    size_t index = found ? (size_t)(found - figures->items) : figures->count;
    if (index == BURNISH_PEERS_FIGURES) {
        return;
    }
    burnish_peers_figure *figure = &figures->items[index];
    if (!found) {
        snprintf(figure->name, sizeof figure->name, "%s", name);
        figure->count = 0;
        ++figures->count;
    }
    if (figure->count < BURNISH_PEERS_VALUES) {
        figure->values[figure->count++] = value;
    }
}

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double burnish_peers_quantile(const burnish_peers_figures *figures, const char *name,
                              double share) {
    const burnish_peers_figure *figure = find(figures, name);
    double sorted[BURNISH_PEERS_VALUES];
    if (!figure) {
        return NAN;
    }
    memcpy(sorted, figure->values, figure->count * sizeof *sorted);
    qsort(sorted, figure->count, sizeof *sorted, compare_doubles);
    double place = share * (double)(figure->count - 1);
    size_t below = (size_t)place;
    size_t above = below + 1 < figure->count ? below + 1 : below;
    return sorted[below] + (place - (double)below) * (sorted[above] - sorted[below]);
}

double burnish_peers_median(const burnish_peers_figures *figures, const char *name) {
    return burnish_peers_quantile(figures, name, 0.5);
}
