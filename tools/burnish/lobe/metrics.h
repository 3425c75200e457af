/* The columns of `burnish lobe table`: everything that burnish/theory.h knows about one lobe. */
#ifndef BURNISH_TOOL_LOBE_METRICS_H
#define BURNISH_TOOL_LOBE_METRICS_H

#include "lobe/lobe.h"

/* What a metric may be computed from. */
typedef struct burnish_cli_lobe_facts {
    burnish_theory_model model;
    burnish_theory_difference difference; /* filled only where a metric needs it */
    double argument;                      /* of the metric: bits, degrees, length */
} burnish_cli_lobe_facts;

typedef struct burnish_cli_metric {
    const char *name; /* as --metrics has it */
    const char *key;  /* of CSV and JSON */
    const char *heading, *unit;
    int decimals;         /* as burnish_cli_column */
    int needs_difference; /* 1: burnish_theory_compare */
    char takes;           /* 0; 'q': name:BITS; 'a': name:DEGREES; 'l': name:LENGTH */
    double (*compute)(const burnish_cli_lobe_facts *facts);
    const char *what; /* for the man page */
} burnish_cli_metric;

/* A metric with its argument. */
typedef struct burnish_cli_metric_choice {
    const burnish_cli_metric *metric;
    double argument;
} burnish_cli_metric_choice;

enum { BURNISH_CLI_METRICS_MAX = 64 };

typedef struct burnish_cli_metric_list {
    burnish_cli_metric_choice items[BURNISH_CLI_METRICS_MAX];
    size_t count;
} burnish_cli_metric_list;

/* All metrics; NULL past the end. */
const burnish_cli_metric *burnish_cli_metric_at(size_t index);

/* Names, NAME:ARGUMENT and groups (widths, energy, errors, cost, shape, all) between commas. */
burnish_status burnish_cli_read_metrics(const char *flag, const char *text,
                                        burnish_cli_metric_list *list, burnish_error *error);

/* The column of a metric. */
void burnish_cli_metric_column(const burnish_cli_metric_choice *choice, burnish_cli_column *column);

#endif
