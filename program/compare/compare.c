/* `burnish compare`: two pictures, two meshes under one camera, or two lobes on one mesh. */
#include "burnish/compare.h"
#include "compare/sides.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/cli/output.h"
#include "base/cli/platform.h"
#include "cli/limits.h"
#include "cli/main.h"
#include "picture/formats.h"
#include "picture/panels.h"
#include "render/flags.h"
#include "render/render.h"

static cli_work work;

#define TARGET(member) .offset = offsetof(compare_settings, member)

static const cli_word map_words[] = {{"values", COMPARE_CODES}, {"flip", COMPARE_FLIP}, {NULL, 0}};

static const cli_flag flags[] = {
    {.group = "Comparing",
     .topic = "comparing",
     CLI_FLAG("threshold", "X", "largest accepted error", cli_flag_real, rule.threshold),
     CLI_RANGE(0, 1),
     .default_label = "no pixel may differ",
     .common = 1,
     .manual = "The pictures pass if their error, as chosen by *--metric*, is at most _X_, from 0 "
               "to 1, or if no pixel differs by more than *--tolerance*. If they do not pass, the "
               "exit code is 10."},
    {CLI_FLAG("tolerance", "N", "largest accepted difference of a channel", cli_flag_integer,
              rule.tolerance),
     CLI_RANGE(0, 255), .default_text = "0", .common = 1,
     .manual = "A pixel differs if one of its channels, including alpha, differs by more than _N_ "
               "of 255."},
    {CLI_FLAG("metric", "NAME", "error metric", cli_flag_word, rule.metric), .default_text = "ssim",
     .words = picture_metric_words,
     .manual =
         "The error of *--threshold*: *ssim*, 1 minus the structural similarity; *flip*, the mean "
         "of FLIP; *pixels*, the share of pixels that differ. See *NUMBERS OF A COMPARISON*."},
    {CLI_FLAG("map", "NAME", "content of the third panel", cli_flag_word, map),
     .default_text = "values", .words = map_words,
     .manual = "Content of the third panel of the picture: *values*, the difference of the channel "
               "that differs most; *flip*, FLIP of each pixel."},
    {CLI_SWITCH("align", "move B's box onto A's", align), .common = 1,
     .aliases = "center,centre,align-centers",
     .manual = "Moves _B_, a mesh, so that the middle of its bounding box is at that of _A_'s: for "
               "two versions of a part that are at different places of their files. Nothing is "
               "turned or scaled. Coordinates of flags are those of each file."},
    {CLI_JSON_FLAG(compare_settings, json, "one JSON object instead of text, in FILE too",
                   "NUMBERS OF A COMPARISON")},
    {.group = "Picture",
     .topic = "picture",
     CLI_FLAG("output", "FILE", "before, after and difference side by side", cli_flag_text, output),
     .letter = 'o',
     .common = 1,
     .file = CLI_WRITES,
     .manual = "Writes both pictures and their difference side by side, with a legend: blue where "
               "_B_ is darker, orange where it is lighter. A frame surrounds all pixels that "
               "differ. Small pictures are enlarged. The file extension chooses the format, as in "
               "*burnish render*. With *-* for standard output, no text is printed."},
    {CLI_FLAG("size", "WxH", "size of drawn meshes; N: a square", cli_flag_size, size),
     CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE), .default_label = "the picture's, else 1024,768",
     .letter = 's', .common = 1, .also = "resolution", .aliases = "width,height,res",
     .manual = "Width and height of drawn meshes. If _A_ or _B_ is a picture, they are its size."},
};

static const cli_example examples[] = {
    {"burnish compare before.png after.png", "numbers and an exit code"},
    {"burnish compare before.stl after.stl -o changes.png", "two meshes with one camera"},
    {"burnish compare part.stl reference.png --threshold=0.02", "a mesh drawn like a picture"},
    {"burnish compare part.stl --lobe=power,energy:2 -o lobes.png", "two lobes on one mesh"},
    {NULL, NULL},
};

static const cli_term number_terms[] = {
    {"*burnish, output*", "the version; the name of the picture or null"},
    {"*a, b*",
     "*input*, *kind* (*picture* or *mesh*), *width*, *height*; for a mesh *lobe*, *camera*, *up*, "
     "*facts* (*triangles*, *vertices*, *shells*, *open_edges*, *size_x*, *size_y*, *size_z*, "
     "*area*, and *volume*, null if it is not closed) and *warnings*"},
    {"*moved*", "what *--align* adds to the coordinates of _B_: x, y, z; else 0"},
    {"*passes*", "true if the exit code is 0"},
    {"*metric, error, threshold, tolerance*",
     "the error of the metric; for pictures that are too small for SSIM, the share of pixels that "
     "differ. *threshold* is null if it is not given"},
    {"*pixels, different_pixels, different_share, different_bounds*",
     "the number of pixels; the number and share of pixels that differ by more than the tolerance; "
     "their x0, y0, x1, y1, ends excluded, or null"},
    {"*largest_difference, mean_difference*",
     "of red, green, blue and alpha, as 8-bit values; means over all pixels. Transparent pixels "
     "are blended with white"},
    {"*mean_squared_error, psnr*", "over red, green and blue; 10 log10(255^2 / mean squared error) "
                                   "in dB, null if the pictures are the same"},
    {"*ssim*", "mean structural similarity (Wang and others, 2004) of 0.299 R + 0.587 G + 0.114 B, "
               "in windows of 11 x 11 pixels weighted by a Gaussian of deviation 1.5, K1 = 0.01, "
               "K2 = 0.03; 1 for identical pictures; null if a side is shorter than 11 pixels"},
    {"*flip*", "mean FLIP (Andersson and others, 2020), at 67 pixels per degree; 0 for identical "
               "pictures, 1 for the largest difference"},
    {"*silhouette_iou*",
     "the area that both objects cover divided by the area that at least one covers. For a mesh, "
     "the coverage of each pixel counts; for a picture, alpha or, without alpha, a difference of "
     "more than 4 of 255 from the colour of all four corners. Null if it is undefined"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "NUMBERS OF A COMPARISON",
     .text = "The output of *burnish compare --json* is one object. Numbers are the same on every "
             "machine and for any number of threads.",
     .terms = number_terms},
    {.heading = NULL},
};

const cli_command compare_command = {
    .name = "compare",
    .aliases = "diff",
    .operand = "A B",
    .summary = "compare two pictures or meshes",
    .operand_help = "PNG files, or inputs of burnish render, with its flags for camera and light",
    .manual = "Compares _A_, the reference or the state before, with _B_. The exit code is 0 if "
              "they are similar enough, and 10 if they are not. Each is a PNG file or a mesh, that "
              "is, an input of *burnish render*; *-* is standard input, a PNG or a mesh. Two "
              "meshes are drawn with one camera, which frames both, and with the up axis of _A_ "
              "unless *--up* is given; differences of their sizes and counts are printed. A mesh "
              "that is compared with a picture is drawn in the picture's size. One mesh with two "
              "lobes, *--lobe=*_A_*,*_B_, is drawn with each lobe.\nPictures of different sizes "
              "are different. The other flags that *--help=all* lists have the same meaning as in "
              "*burnish render*; *--views* takes one view.",
    .operands_max = 2,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW | CLI_PHASE_PROCESS,
    .heir = HEIR_COMPARE,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(compare_settings),
    .given = offsetof(compare_settings, given),
    .work = work,
};

/* ---- Work ---- */

static burnish_status check_operands(const compare_settings *settings, const cli_call *call,
                                     burnish_error *error) {
    const size_t lobes = settings->render.shading.lobes.count;
    if (call->operand_count == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "compare: no A and B; try \"burnish compare before.png after.png\" or "
                        "\"burnish compare --help\"");
    }
    if (call->operand_count == 1 && lobes != 2) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "compare: only one input, \"%.100s\"; name another one, or two lobes, such "
                        "as --lobe=power,energy:2",
                        call->operands[0]);
    }
    if (call->operand_count == 2 && lobes > 1) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--lobe: %zu lobes for two inputs; use one lobe, or two lobes and one input", lobes);
    }
    if (settings->render.picture.views.count > 1) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--views: %zu views; only one view can be compared",
                        settings->render.picture.views.count);
    }
    if (call->operand_count == 2 && strcmp(call->operands[0], "-") == 0 &&
        strcmp(call->operands[1], "-") == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "compare: both are standard input; name a file for one of them");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_output(compare_settings *settings, burnish_error *error) {
    picture_format format = PICTURE_PNG;
    if (!settings->output) {
        return BURNISH_STATUS_OK;
    }
    if (settings->json && (strcmp(settings->output, settings->json) == 0 ||
                           cli_same_output(settings->output, settings->json))) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--json: \"%.200s\" is the picture; name another file", settings->json);
    }
    if (strcmp(settings->output, "-") == 0 && isatty(STDOUT_FILENO)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: standard output is a terminal; redirect it, or name a file with "
                        "--output=FILE");
    }
    const int use = PICTURE_8_BIT | (settings->render.output.overwrite ? PICTURE_REPLACES : 0);
    const burnish_status status =
        picture_choose("output", settings->output, use, PICTURE_AUTO, &format, error);
    settings->format = format;
    return status;
}

/* Pictures of different sizes are not compared further. */
static burnish_status report_sizes(const comparison *c, cli_call *call, burnish_error *error) {
    const burnish_image *a = compare_image(&c->sides[0]), *b = compare_image(&c->sides[1]);
    fprintf(stderr, "burnish: %s has %d x %d pixels, %s %d x %d: nothing else was compared\n",
            c->sides[0].label, a->width, a->height, c->sides[1].label, b->width, b->height);
    (void)error;
    call->exit_code = CLI_EXIT_DIFFERENT;
    return BURNISH_STATUS_OK;
}

static burnish_status write_panels(const comparison *c, burnish_error *error) {
    const compare_settings *settings = c->settings;
    const picture_panels panels = {
        .pictures = {compare_image(&c->sides[0]), compare_image(&c->sides[1])},
        .labels = {c->sides[0].label, c->sides[1].label},
        .numbers = &c->verdict.numbers,
        .flip_map = c->flip_map};
    const picture_options options = {.threads = settings->render.job.threads};
    return picture_write_panels(&panels, settings->output, (picture_format)settings->format,
                                &options, error);
}

static burnish_status measure_difference(comparison *c, burnish_error *error) {
    burnish_compare_options options = burnish_compare_options_default();
    const burnish_image *images[2] = {compare_image(&c->sides[0]), compare_image(&c->sides[1])};
    const burnish_pixels a = burnish_image_get_pixels(images[0]),
                         b = burnish_image_get_pixels(images[1]);
    burnish_comparison numbers;
    options.threads = c->settings->render.job.threads;
    options.tolerance = c->settings->rule.tolerance;
    options.coverage[0] = c->sides[0].coverage;
    options.coverage[1] = c->sides[1].coverage;
    if (c->settings->output && c->settings->map == COMPARE_FLIP) {
        c->flip_map = calloc((size_t)a.width * (size_t)a.height, sizeof *c->flip_map);
        if (!c->flip_map) {
            return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the map");
        }
        options.flip_map = c->flip_map;
    }
    const burnish_status status = burnish_pixels_compare(&a, &b, &options, &numbers, error);
    if (status == BURNISH_STATUS_OK) {
        c->verdict = picture_judge(&c->settings->rule, &numbers);
    }
    return status;
}

static burnish_status compare_inputs(comparison *c, cli_call *call, burnish_error *error) {
    burnish_status status = compare_draw_sides(c, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_image *a = compare_image(&c->sides[0]), *b = compare_image(&c->sides[1]);
    if (a->width != b->width || a->height != b->height) {
        return report_sizes(c, call, error);
    }
    status = measure_difference(c, error);
    if (status == BURNISH_STATUS_OK && c->settings->output) {
        status = write_panels(c, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = compare_write_report(c, error);
        call->exit_code = c->verdict.passes ? 0 : CLI_EXIT_DIFFERENT;
    }
    return status;
}

static burnish_status work(void *from, cli_call *call, burnish_error *error) {
    compare_settings *settings = from;
    burnish_status status = check_operands(settings, call, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_output(settings, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = render_check(&settings->render, error);
    }
    comparison *c = status == BURNISH_STATUS_OK ? calloc(1, sizeof *c) : NULL;
    if (!c) {
        return status == BURNISH_STATUS_OK
                   ? cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the comparison")
                   : status;
    }
    const cli_need map = {"map", settings->output != NULL,
                          "only the picture has panels; use --output=FILE"};
    status = cli_check_needs(&compare_command, settings, &map, 1,
                             settings->render.input.load.strict, settings->render.job.quiet, error);
    if (status != BURNISH_STATUS_OK) {
        free(c);
        return status;
    }
    cli_prepare_memory();
    c->settings = settings;
    c->lobes = call->operand_count == 1;
    c->sides[0].input = call->operands[0];
    c->sides[1].input = call->operands[c->lobes ? 0 : 1];
    status = compare_inputs(c, call, error);
    compare_release_sides(c);
    free(c->flip_map);
    free(c);
    return status;
}
