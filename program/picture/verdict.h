/* Decides whether two pictures are similar enough, and reports the metrics. */
#ifndef TOOL_PICTURE_VERDICT_H
#define TOOL_PICTURE_VERDICT_H

#include <cjson/cJSON.h>
#include <stdio.h>

#include "base/cli/values.h"
#include "burnish/compare.h"
#include "burnish/image.h"

/* The metric that the threshold limits. */
typedef enum picture_metric {
    PICTURE_SSIM,  /* 1 - SSIM */
    PICTURE_FLIP,  /* mean FLIP */
    PICTURE_PIXELS /* share of pixels that differ by more than the tolerance */
} picture_metric;

extern const cli_word picture_metric_words[];

/* Two pictures pass if no pixel differs by more than the tolerance or, with a threshold, if the
 * error is at most the threshold. */
typedef struct picture_rule {
    int tolerance; /* 8-bit codes */
    cli_real threshold;
    int metric; /* picture_metric */
} picture_rule;

typedef struct picture_verdict {
    burnish_comparison numbers;
    double error; /* by the rule's metric; the share of pixels if there is no SSIM */
    int passes;
} picture_verdict;

picture_verdict picture_judge(const picture_rule *rule, const burnish_comparison *numbers);

/* Adds the keys in the order of the man page. */
void picture_add_verdict(cJSON *object, const picture_rule *rule, const picture_verdict *verdict,
                         int *failed);

/* Prints the verdict as text. */
void picture_print_verdict(FILE *stream, const picture_verdict *verdict);

#endif
