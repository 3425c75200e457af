/* The columns of `burnish lobe table`: all properties of a lobe in burnish/theory.h. */
#ifndef TOOL_LOBE_METRICS_H
#define TOOL_LOBE_METRICS_H

#include "base/cli/output.h"
#include "burnish/theory.h"

/* The input of metrics. */
typedef struct lobe_facts {
    burnish_theory_model model;
    burnish_theory_difference difference; /* filled only where a metric needs it */
    burnish_theory_cost cost;
} lobe_facts;

typedef struct lobe_metric {
    const char *name;           /* as --metrics has it */
    const char *key;            /* of CSV and JSON */
    const char *heading, *unit; /* "deg" and "%": values are in radians and parts of 1 */
    int decimals;               /* as cli_column */
    char takes;                 /* 0; 'q': name:BITS; 'a': name:DEGREES; 'l': name:LENGTH; 'c':
                                   name:LOBES */
    const char *what;           /* for the man page */
    /* source of the value, one of these */
    double (*of_model)(const burnish_theory_model *model);
    double (*of_exponent)(double exponent);
    double (*at)(const burnish_theory_model *model, double argument);
    size_t difference_at; /* offset in lobe_facts of a double of `difference` */
    size_t count_at;      /* offset in lobe_facts of an int of `cost` */
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

/* Names, NAME:ARGUMENT and groups (widths, energies, errors, cost, shape, all, sums) between commas. */
burnish_status lobe_read_metrics(const char *flag, const char *text, lobe_metric_list *list,
                                 burnish_error *error);

/* The value in the unit of the metric's column; NaN: not defined. */
double lobe_metric_value(const lobe_metric_choice *choice, const lobe_facts *facts);

/* The column of a metric. */
void lobe_metric_column(const lobe_metric_choice *choice, cli_column *column);

#endif
