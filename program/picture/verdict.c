#include "picture/verdict.h"

#include <math.h>

#include "base/cli/output.h"

const cli_word picture_metric_words[] = {
    {"ssim", PICTURE_SSIM}, {"flip", PICTURE_FLIP}, {"pixels", PICTURE_PIXELS}, {NULL, 0}};

static double share_of_pixels(const burnish_comparison *numbers) {
    return (double)numbers->different_pixels / (double)numbers->pixels;
}

picture_verdict picture_judge(const picture_rule *rule, const burnish_comparison *numbers) {
    picture_verdict found = {.numbers = *numbers};
    const double errors[] = {[PICTURE_SSIM] = 1 - numbers->ssim,
                             [PICTURE_FLIP] = numbers->flip,
                             [PICTURE_PIXELS] = share_of_pixels(numbers)};
    found.error = errors[rule->metric];
    if (isnan(found.error)) {
        found.error = share_of_pixels(numbers);
    }
    found.passes = numbers->different_pixels == 0 ||
                   (rule->threshold.given && found.error <= rule->threshold.value);
    return found;
}

/* ---- JSON ---- */

void picture_add_verdict(cJSON *object, const picture_rule *rule, const picture_verdict *verdict,
                         int *failed) {
    const burnish_comparison *n = &verdict->numbers;
    cli_json_add(object, "passes", cJSON_CreateBool(verdict->passes), failed);
    cli_json_add(object, "metric", cJSON_CreateString(picture_metric_words[rule->metric].name),
                 failed);
    cli_json_add(object, "error", cli_json_real(verdict->error), failed);
    cli_json_add(object, "threshold",
                 rule->threshold.given ? cli_json_real(rule->threshold.value) : cJSON_CreateNull(),
                 failed);
    cli_json_add(object, "tolerance", cJSON_CreateNumber(rule->tolerance), failed);
    cli_json_add(object, "pixels", cli_json_count((size_t)n->pixels), failed);
    cli_json_add(object, "different_pixels", cli_json_count((size_t)n->different_pixels), failed);
    cli_json_add(object, "different_share", cli_json_real(share_of_pixels(n)), failed);
    cli_json_add(object, "different_bounds",
                 n->different_pixels > 0 ? cli_json_integers(4, n->bounds) : cJSON_CreateNull(),
                 failed);
    cli_json_add(object, "largest_difference", cli_json_integers(4, n->largest), failed);
    cli_json_add(object, "mean_difference", cli_json_reals(4, n->mean), failed);
    cli_json_add(object, "mean_squared_error", cli_json_real(n->mean_squared_error), failed);
    cli_json_add(object, "psnr", cli_json_real(n->psnr), failed);
    cli_json_add(object, "ssim", cli_json_real(n->ssim), failed);
    cli_json_add(object, "flip", cli_json_real(n->flip), failed);
    cli_json_add(object, "silhouette_iou", cli_json_real(n->silhouette_iou), failed);
}

/* ---- Text ---- */

static void print_real(FILE *stream, const char *name, double value, int decimals,
                       const char *unit) {
    if (isfinite(value)) {
        fprintf(stream, "  %-20s  %.*f%s\n", name, decimals, value, unit);
    }
}

void picture_print_verdict(FILE *stream, const picture_verdict *verdict) {
    const burnish_comparison *n = &verdict->numbers;
    const int *box = n->bounds, *most = n->largest;
    fprintf(stream, "  %-20s  %llu of %llu (%.3g %%)\n", "pixels that differ",
            (unsigned long long)n->different_pixels, (unsigned long long)n->pixels,
            100 * share_of_pixels(n));
    if (n->different_pixels > 0) {
        fprintf(stream, "  %-20s  %d, %d to %d, %d\n", "all of them within", box[0], box[1], box[2],
                box[3]);
    }
    fprintf(stream, "  %-20s  R %d, G %d, B %d, alpha %d\n", "largest difference", most[0], most[1],
            most[2], most[3]);
    fprintf(stream, "  %-20s  R %.3g, G %.3g, B %.3g, alpha %.3g\n", "mean difference", n->mean[0],
            n->mean[1], n->mean[2], n->mean[3]);
    print_real(stream, "PSNR", n->psnr, 2, " dB");
    print_real(stream, "SSIM", n->ssim, 6, "");
    print_real(stream, "FLIP", n->flip, 6, "");
    print_real(stream, "silhouettes, IoU", n->silhouette_iou, 6, "");
}
