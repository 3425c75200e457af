/* The columns of `burnish lobe table`: everything that burnish/theory.h knows about one lobe. */
#ifndef TOOL_LOBE_METRICS_H
#define TOOL_LOBE_METRICS_H

#include "lobe/lobe.h"

/* What a metric may be computed from. */
typedef struct lobe_facts {
    burnish_theory_model model;
    burnish_theory_difference difference; /* filled only where a metric needs it */
    double argument;                      /* of the metric: bits, degrees, length */
} lobe_facts;

typedef struct lobe_metric {
    const char *name; /* as --metrics has it */
    const char *key;  /* of CSV and JSON */
    const char *heading, *unit;
    int decimals;         /* as cli_column */
    int needs_difference; /* 1: burnish_theory_compare */
    char takes;           /* 0; 'q': name:BITS; 'a': name:DEGREES; 'l': name:LENGTH */
    double (*compute)(const lobe_facts *facts);
    const char *what; /* for the man page */
} lobe_metric;

/* A metric with its argument. */
typedef struct lobe_metric_choice {
    const lobe_metric *metric;
    double argument;
} lobe_metric_choice;

enum { LOBE_METRICS_MAX = 64 };

typedef struct lobe_metric_list {
    lobe_metric_choice items[LOBE_METRICS_MAX];
    size_t count;
} lobe_metric_list;

/* All metrics for the man page. */
void lobe_each_metric(cli_take_term *take);

/* Names, NAME:ARGUMENT and groups (widths, energy, errors, cost, shape, all) between commas. */
burnish_status lobe_read_metrics(const char *flag, const char *text, lobe_metric_list *list,
                                 burnish_error *error);

/* The column of a metric. */
void lobe_metric_column(const lobe_metric_choice *choice, cli_column *column);

#endif
