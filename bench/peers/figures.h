/* Measured values by name, and their statistics. */
#ifndef BURNISH_BENCH_PEERS_FIGURES_H
#define BURNISH_BENCH_PEERS_FIGURES_H

#include <stddef.h>

enum {
    BURNISH_PEERS_NAME = 64,
    BURNISH_PEERS_FIGURES = 128, /* names */
    BURNISH_PEERS_VALUES = 512   /* per name */
};

typedef struct burnish_peers_figure {
    char name[BURNISH_PEERS_NAME];
    size_t count;
    double values[BURNISH_PEERS_VALUES];
} burnish_peers_figure;

typedef struct burnish_peers_figures {
    size_t count;
    burnish_peers_figure items[BURNISH_PEERS_FIGURES];
} burnish_peers_figures;

/* Adds a value to the figure of that name; values beyond the capacity are dropped. */
void burnish_peers_add(burnish_peers_figures *figures, const char *name, double value);

/* The share'th quantile, [0, 1], of the figure; NaN without values of that name. */
double burnish_peers_quantile(const burnish_peers_figures *figures, const char *name, double share);

double burnish_peers_median(const burnish_peers_figures *figures, const char *name);

#endif
