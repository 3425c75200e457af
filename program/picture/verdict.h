/* Whether two pictures are alike enough, and the numbers that say so. */
#ifndef TOOL_PICTURE_VERDICT_H
#define TOOL_PICTURE_VERDICT_H

#include <cjson/cJSON.h>
#include <stdio.h>

#include "burnish/compare.h"
#include "burnish/image.h"
#include "cli/values.h"

/* What the threshold is compared with. */
typedef enum picture_metric {
    PICTURE_SSIM,  /* 1 - SSIM */
    PICTURE_FLIP,  /* mean FLIP */
    PICTURE_PIXELS /* share of pixels that differ by more than the tolerance */
} picture_metric;

extern const cli_word picture_metric_words[];

/* Two pictures pass where no pixel differs by more than the tolerance, or with a threshold where
 * the error is at most that. */
typedef struct picture_rule {
    int tolerance; /* 8-bit codes */
    cli_real threshold;
    int metric; /* picture_metric */
} picture_rule;

typedef struct picture_verdict {
    burnish_comparison numbers;
    double error; /* by the rule's metric; the share of pixels where there is no SSIM */
    int passes;
} picture_verdict;

picture_verdict picture_judge(const picture_rule *rule, const burnish_comparison *numbers);

/* The keys that the man page's section lists, in that order. */
void picture_add_verdict(cJSON *object, const picture_rule *rule, const picture_verdict *verdict,
                         int *failed);

/* Lines of text. */
void picture_print_verdict(FILE *stream, const picture_verdict *verdict);

#endif
