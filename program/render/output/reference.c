#include "burnish/compare.h"
#include "render/output/result.h"

#include <stdio.h>
#include <string.h>

#include "base/cli/output.h"
#include "picture/panels.h"
#include "picture/read_png.h"

static picture_rule rule_of(const render_settings *settings) {
    return (picture_rule){.threshold = settings->output.reference_threshold,
                          .metric = PICTURE_SSIM};
}

burnish_status render_read_reference(render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    return settings->output.reference
               ? picture_read_png(settings->output.reference, settings->input.load.max_input_bytes,
                                  &result->reference.image, error)
               : BURNISH_STATUS_OK;
}

static burnish_status write_difference(const render_result *result,
                                       const burnish_comparison *numbers, burnish_error *error) {
    const render_settings *settings = result->settings;
    const picture_panels panels = {.pictures = {&result->reference.image, result->picture},
                                   .labels = {"the reference", "the picture"},
                                   .numbers = numbers};
    const picture_options options = {.threads = settings->job.threads};
    picture_format format;
    burnish_status status =
        picture_choose("reference-difference", settings->output.reference_difference, PICTURE_8_BIT,
                       PICTURE_AUTO, &format, error);
    return status == BURNISH_STATUS_OK
               ? picture_write_panels(&panels, settings->output.reference_difference, format,
                                      &options, error)
               : status;
}

burnish_status render_judge(render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    const burnish_image *reference = &result->reference.image, *picture = result->picture;
    burnish_comparison numbers;
    if (!settings->output.reference || reference->width != picture->width ||
        reference->height != picture->height) {
        return BURNISH_STATUS_OK;
    }
    const picture_rule rule = rule_of(settings);
    const burnish_pixels a = burnish_image_get_pixels(reference),
                         b = burnish_image_get_pixels(picture);
    burnish_compare_options options = burnish_compare_options_default();
    options.threads = settings->job.threads;
    burnish_status status = burnish_pixels_compare(&a, &b, &options, &numbers, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    result->reference.verdict = picture_judge(&rule, &numbers);
    return settings->output.reference_difference ? write_difference(result, &numbers, error)
                                                 : BURNISH_STATUS_OK;
}

void render_add_reference(cJSON *root, const render_result *result, int *failed) {
    const burnish_image *image = &result->reference.image;
    const picture_verdict *verdict = &result->reference.verdict;
    const picture_rule rule = rule_of(result->settings);
    if (!image->pixels) {
        return;
    }
    cJSON *object = cJSON_CreateObject();
    cli_json_add(object, "input", cli_json_text(result->settings->output.reference), failed);
    cli_json_add(object, "width", cJSON_CreateNumber(image->width), failed);
    cli_json_add(object, "height", cJSON_CreateNumber(image->height), failed);
    if (verdict->numbers.pixels > 0) {
        picture_add_verdict(object, &rule, verdict, failed);
    } else {
        cli_json_add(object, "passes", cJSON_CreateBool(0), failed);
    }
    cli_json_add(root, "reference", object, failed);
}

int render_is_different(const render_result *result, burnish_error *line) {
    const render_settings *settings = result->settings;
    const burnish_image *reference = &result->reference.image;
    const picture_verdict *verdict = &result->reference.verdict;
    const burnish_comparison *n = &verdict->numbers;
    if (!reference->pixels || verdict->passes) {
        return 0;
    }
    if (n->pixels == 0) {
        cli_fail(line, BURNISH_STATUS_OK,
                 "%.300s: the picture has %d x %d pixels, the reference %d x %d",
                 settings->output.reference, result->picture->width, result->picture->height,
                 reference->width, reference->height);
    } else {
        cli_fail(line, BURNISH_STATUS_OK,
                 "%.300s: the picture differs: error %.3g, allowed %.3g; %llu of %llu pixels in "
                 "%d, %d to %d, %d, SSIM %.4f, FLIP %.4f",
                 settings->output.reference, verdict->error,
                 settings->output.reference_threshold.given
                     ? settings->output.reference_threshold.value
                     : 0.0,
                 (unsigned long long)n->different_pixels, (unsigned long long)n->pixels,
                 n->bounds[0], n->bounds[1], n->bounds[2], n->bounds[3], n->ssim, n->flip);
    }
    return 1;
}
