/* The figures: what each plots, with default lobes and exponents. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/values.h"
#include "program/figures.h"

static const double DEGREES = 1 / CLI_DEGREE;

static plot_metric lobe_value, power_error, core_error, extreme_error, extreme_error_searched,
    energy_ratio, whole_error, curvature_radius;

static const plot_figure figures[] = {
    {.name = "error",
     .panel = "2",
     .title = "Absolute error of W against the angle",
     .exponents = "3,10,30,100,300,1000",
     .lobes = "taylor:2",
     .y_column = "absolute_error",
     .measure = power_error,
     .is_narrow = 1,
     .has_paper_names = 1},
    {.name = "curves",
     .panel = "3",
     .title = "The power, W and Schlick's function against the angle",
     .exponents = "100",
     .lobes = "power,taylor:2,schlick",
     .y_column = "value",
     .measure = lobe_value,
     .has_paper_names = 1},
    {.name = "core",
     .panel = "4",
     .axis = PLOT_AXIS_EXPONENTS,
     .title = "Largest relative error from the peak to the inflection against the exponent",
     .exponents = "2,1000",
     .lobes = "taylor:2,shift7,schlick",
     .y_column = "relative_error_percent",
     .measure = core_error,
     .has_paper_names = 1},
    {.name = "ratio",
     .panel = "5",
     .axis = PLOT_AXIS_EXPONENTS,
     .title = "Ratio R of the angles at which power and lobe fall to 2^-q against the exponent",
     .exponents = "2,1000",
     .lobes = "taylor:2,schlick",
     .bits = "2,4,8,12",
     .y_column = "ratio",
     .measure = burnish_theory_width_ratio,
     .has_paper_names = 1},
    {.name = "w1",
     .panel = "6a",
     .title = "W1 and the power against the angle",
     .exponents = "10",
     .lobes = "power,energy:2",
     .y_column = "value",
     .measure = lobe_value,
     .has_paper_names = 1},
    {.name = "w1-extreme",
     .panel = "6b",
     .axis = PLOT_AXIS_EXPONENTS,
     .title = "Extreme relative error of W1 against the exponent",
     .exponents = "2,1000",
     .lobes = "energy:2",
     .y_column = "relative_error_percent",
     .measure = extreme_error,
     .points = extreme_error_searched,
     .has_paper_names = 1},
    {.name = "cost",
     .axis = PLOT_AXIS_NONE,
     .title = "Largest absolute error of every lobe against what it costs",
     .exponents = "64",
     .lobes = "taylor:2,energy:2,shift7,minimax:2,affine:2,energy:4,minimax:4,affine:4,minimax:8,"
              "affine:8,"
              "minimax:16,affine:16,minimax:32,affine:32,composite:3,composite:4,composite:5,"
              "composite:6,nv2x,power,schlick,gx,gaussian,"
              "kuijk-blake,table256,table256:linear",
     .width = 960,
     .height = 820,
     .y_column = "maximum_error",
     .fill = plot_fill_cost},
    {.name = "multiplications",
     .axis = PLOT_AXIS_NONE,
     .title = "Largest absolute error of every family against the number of multiplications",
     .exponents = "256",
     .lobes = "taylor:2,taylor:4,taylor:8,taylor:16,taylor:32,energy:2,energy:4,energy:8,energy:16,"
              "energy:32,minimax:2,minimax:4,minimax:8,minimax:16,minimax:32,affine:2,affine:4,"
              "affine:8,affine:16,affine:32,composite:2,composite:3,composite:4,composite:5,"
              "composite:6",
     .y_column = "maximum_error",
     .fill = plot_fill_multiplications},
    {.name = "energy",
     .axis = PLOT_AXIS_EXPONENTS,
     .title = "Energy over the hemisphere relative to the power's against the exponent",
     .exponents = "2,1000",
     .lobes = "schlick,gx,energy:2,minimax:2,shift3,shift7,taylor:2",
     .y_column = "energy_ratio",
     .measure = energy_ratio,
     .has_paper_names = 1},
    {.name = "orders",
     .axis = PLOT_AXIS_EXPONENTS,
     .title = "Largest absolute error of every order against the exponent",
     .exponents = "2,5000",
     .lobes = "minimax:2,minimax:4,minimax:8,minimax:16,minimax:32",
     .y_column = "maximum_error",
     .measure = whole_error,
     .is_ordered = 1},
    {.name = "widths",
     .axis = PLOT_AXIS_BITS,
     .title = "Ratio R of the angles at which power and lobe fall to 2^-q against q",
     .exponents = "64",
     .lobes = "taylor:2,shift7,energy:2,minimax:2,shift3,minimax:4,minimax:8,gaussian,schlick",
     .bits = "1,16",
     .y_column = "ratio",
     .measure = burnish_theory_width_ratio,
     .has_paper_names = 1},
    {.name = "radius",
     .title = "Radius of curvature of W and the power against the angle",
     .exponents = "10,100,1000",
     .lobes = "taylor:2,power",
     .y_column = "radius_rad",
     .measure = curvature_radius,
     .least_angle = 0.02,
     .has_paper_names = 1},
    {.name = "polygon",
     .axis = PLOT_AXIS_NONE,
     .title = "Error of the evaluations of a polygon's light against the slope",
     .exponents = "64",
     .lobes = "energy:8",
     .y_column = "error",
     .fill = plot_fill_polygon},
    {.name = "rough",
     .axis = PLOT_AXIS_NONE,
     .title = "GGX around the mirror direction, and sums of lobes",
     .exponents = "64",
     .lobes = "energy:2",
     .y_column = "value",
     .fill = plot_fill_rough},
};

const plot_figure *plot_figure_at(size_t index) {
    return index < sizeof figures / sizeof *figures ? &figures[index] : NULL;
}

burnish_status plot_make_model(const char *word, double exponent, burnish_theory_model *model,
                               burnish_error *error) {
    burnish_error inner;
    if (burnish_theory_model_parse(word, exponent, model, &inner) == BURNISH_STATUS_OK) {
        return BURNISH_STATUS_OK;
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--lobes: %s", inner.text);
}

plot_series *plot_add_series(plot_chart *chart, burnish_error *error) {
    if (chart->series_count == PLOT_SERIES_MAX) {
        cli_fail(error, BURNISH_STATUS_ARGUMENT,
                 "%s: more than %d curves; leave out some lobes, exponents or bits", chart->name,
                 PLOT_SERIES_MAX);
        return NULL;
    }
    return &chart->series[chart->series_count++];
}

/* The lobe's label in a figure; the paper's name if it has one. */
void plot_name_lobe(const burnish_theory_model *model, char *text, size_t size) {
    char word[LOBE_NAME];
    burnish_lobe_spec_name(&model->lobe, word, sizeof word);
    if (strcmp(word, "taylor:2") == 0) {
        snprintf(text, size, "{/:Italic W}");
    } else if (strcmp(word, "energy:2") == 0) {
        snprintf(text, size, "{/:Italic W}_1");
    } else if (strcmp(word, "shift7:2") == 0) {
        snprintf(text, size, "{/:Italic W}_{0.5}");
    } else if (strcmp(word, "level0.5:2") == 0) {
        snprintf(text, size, "{/:Italic W}_{0.5}, exact");
    } else if (strcmp(word, "power") == 0) {
        snprintf(text, size, "cos^{{/:Italic n}}");
    } else if (strcmp(word, "schlick") == 0) {
        snprintf(text, size, "Schlick");
    } else {
        snprintf(text, size, "%s", word);
    }
}

/* The ink for item i of `count` ordered ones, spread over the steps. */
static int ramp_ink(size_t i, size_t count) {
    size_t last = PLOT_RAMP_INKS - 1;
    size_t step = count > 1 ? (i * last + (count - 1) / 2) / (count - 1) : 2;
    return PLOT_INK_RAMP + (int)(step > last ? last : step);
}

/* A lobe has the same hue in every figure; labels distinguish the few that share one. */
int plot_lobe_ink(const burnish_theory_model *model) {
    static const int kinds[BURNISH_LOBE_KIND_COUNT] = {
        [BURNISH_LOBE_SCHLICK] = 1, [BURNISH_LOBE_LYON] = 0,      [BURNISH_LOBE_GAUSSIAN] = 4,
        [BURNISH_LOBE_GX] = 4,      [BURNISH_LOBE_NV2X] = 5,      [BURNISH_LOBE_KUIJK_BLAKE] = 4,
        [BURNISH_LOBE_TABLE] = 6,   [BURNISH_LOBE_COMPOSITE] = 1,
    };
    static const int fits[BURNISH_FIT_COUNT] = {
        [BURNISH_FIT_TAYLOR] = 0,  [BURNISH_FIT_ENERGY] = 2,        [BURNISH_FIT_LEVEL] = 4,
        [BURNISH_FIT_SHIFT7] = 5,  [BURNISH_FIT_SHIFT3] = 6,        [BURNISH_FIT_PROJECTED] = 2,
        [BURNISH_FIT_MINIMAX] = 3, [BURNISH_FIT_LEAST_SQUARES] = 4, [BURNISH_FIT_AFFINE] = 5,
        [BURNISH_FIT_GIVEN] = 6,
    };
    if (model->lobe.kind == BURNISH_LOBE_POWER) {
        return PLOT_INK_REFERENCE;
    }
    return PLOT_INK_LOBE + (model->lobe.kind == BURNISH_LOBE_FAMILY ? fits[model->lobe.fit]
                                                                    : kinds[model->lobe.kind]);
}

/* Dashes show the order. */
static int lobe_style(const burnish_theory_model *model) {
    return model->lobe.order <= 2   ? PLOT_LINE
           : model->lobe.order == 4 ? PLOT_DASHED
           : model->lobe.order == 8 ? PLOT_DASH_DOT
                                    : PLOT_DOTTED;
}

/* The i-th style of curves that share their hues. */
static int style_of(size_t i) {
    static const int styles[] = {PLOT_LINE,   PLOT_DASHED,       PLOT_DASH_DOT,
                                 PLOT_DOTTED, PLOT_DASH_DOT_DOT, PLOT_SHORT_DASHED};
    return styles[i % (sizeof styles / sizeof *styles)];
}

/* ---- Measures ---------------------------------------------------------------------------------*/

static double lobe_value(const burnish_theory_model *model, double degrees) {
    return burnish_theory_value_at_angle(model, degrees / DEGREES);
}

static double power_error(const burnish_theory_model *model, double degrees) {
    return fabs(lobe_value(model, degrees) -
                burnish_theory_power(cos(degrees / DEGREES), model->exponent));
}

static double curvature_radius(const burnish_theory_model *model, double degrees) {
    return burnish_theory_curvature_radius(model, degrees / DEGREES);
}

static double core_error(const burnish_theory_model *model, double bits) {
    burnish_theory_difference difference;
    double end = burnish_theory_inflection_angle(model->exponent);
    (void)bits;
    if (!(end > 0)) {
        return NAN;
    }
    burnish_theory_compare(model, end, &difference);
    return 100 * difference.relative;
}

/* The relative error at an angle, in percent; NaN: no such angle. */
static double percent_at(const burnish_theory_model *model, double angle) {
    return isnan(angle) ? NAN : 100 * burnish_theory_relative_error(model, angle);
}

static double extreme_error(const burnish_theory_model *model, double bits) {
    (void)bits;
    return percent_at(model, burnish_theory_extreme_angle(model));
}

static double extreme_error_searched(const burnish_theory_model *model, double bits) {
    (void)bits;
    return percent_at(model, burnish_theory_extreme_angle_searched(model));
}

static burnish_theory_model power_with(double exponent) {
    burnish_theory_model power;
    burnish_theory_model_create(&power, &(burnish_lobe_spec){.kind = BURNISH_LOBE_POWER}, exponent);
    return power;
}

static double energy_ratio(const burnish_theory_model *model, double bits) {
    const burnish_theory_model power = power_with(model->exponent);
    (void)bits;
    return burnish_theory_integral(model, BURNISH_THEORY_SOLID_ANGLE) /
           burnish_theory_integral(&power, BURNISH_THEORY_SOLID_ANGLE);
}

static double whole_error(const burnish_theory_model *model, double bits) {
    (void)bits;
    return burnish_theory_maximum_error(model, acos(0));
}

/* ---- Curves -----------------------------------------------------------------------------------*/

/* A curve's lobe and, if list is not NULL, its number `index` of a list. */
typedef struct curve {
    const char *lobe;
    size_t lobe_index, index;
    const plot_list *list; /* NULL: none */
    char letter;           /* of the numbers: n or q */
} curve;

/* Sets name, ink and dashes. A list of numbers is ordered and uses the ramp; lobes have hues. */
static void dress(const plot_figure *figure, const plot_request *request, const curve *c,
                  const burnish_theory_model *model, plot_series *series) {
    const int many = request->lobes.count > 1;
    const int is_bits = c->list == &request->bits;
    const int several = c->list && (is_bits || c->list->count > 1);
    char text[64];
    plot_name_lobe(model, text, sizeof text);
    snprintf(series->name, sizeof series->name, "%s", c->lobe);
    if (c->list) {
        snprintf(series->name, sizeof series->name, "%s %c=%.10g", c->lobe, c->letter,
                 c->list->items[c->index]);
    }
    snprintf(series->text, sizeof series->text, "%s", figure->has_paper_names ? text : c->lobe);
    if (several) {
        snprintf(series->text, sizeof series->text, "%s%s{/:Italic %c} = %.6g",
                 many || is_bits ? text : "", many || is_bits ? ", " : "", c->letter,
                 c->list->items[c->index]);
    }
    series->ink = several              ? ramp_ink(c->index, c->list->count)
                  : figure->is_ordered ? ramp_ink(c->lobe_index, request->lobes.count)
                                       : plot_lobe_ink(model);
    series->dash = c->list              ? style_of(several && !many ? c->index : c->lobe_index)
                   : figure->is_ordered ? PLOT_LINE
                                        : lobe_style(model);
}

/* The axis's value number i of PLOT_POINTS. */
static double x_at(const plot_figure *figure, const plot_chart *chart, size_t i) {
    double share = (double)i / (PLOT_POINTS - 1);
    if (i == 0 || i == PLOT_POINTS - 1) {
        return i == 0 ? chart->x_low : chart->x_high;
    }
    if (figure->axis == PLOT_AXIS_EXPONENTS || figure->least_angle > 0) {
        return chart->x_low * pow(chart->x_high / chart->x_low, share);
    }
    return chart->x_low + (chart->x_high - chart->x_low) * share * (figure->is_narrow ? share : 1);
}

/* The least exponent that has such a lobe, between low (which has none) and high (which has one). */
static double first_exponent(const burnish_theory_model *pattern, double low, double high,
                             burnish_theory_model *model) {
    for (int i = 0; i < 50; ++i) {
        double middle = 0.5 * (low + high);
        if (burnish_theory_model_create(model, &pattern->lobe, middle) == BURNISH_LOBE_OK) {
            high = middle;
        } else {
            low = middle;
        }
    }
    burnish_theory_model_create(model, &pattern->lobe, high);
    return high;
}

/* Values over the exponent, from the least exponent that has the lobe. */
static void sample_exponents(const burnish_theory_model *pattern, plot_metric *measure, double bits,
                             plot_series *series) {
    burnish_theory_model model;
    int before = 0;
    for (size_t i = 0; i < PLOT_POINTS; ++i) {
        const double exponent = series->x[i];
        int exists =
            burnish_theory_model_create(&model, &pattern->lobe, exponent) == BURNISH_LOBE_OK;
        series->y[i] = exists ? measure(&model, bits) : NAN;
        if (i > 0 && exists && !before) {
            series->x[i - 1] = first_exponent(pattern, series->x[i - 1], exponent, &model);
            series->y[i - 1] = measure(&model, bits);
        }
        before = exists;
    }
}

/* There is no radius where the lobe is 0: the curve ends at the zero, with the radius there. */
static void end_at_zero(const burnish_theory_model *model, plot_series *series) {
    const double zero = burnish_theory_zero_angle(model) * DEGREES;
    for (size_t i = 0; i < series->count; ++i) {
        if (series->x[i] >= zero) {
            series->x[i] = zero;
            series->y[i] = burnish_theory_zero_curvature_radius(model);
            series->count = i + 1;
        }
    }
}

static void sample(const plot_figure *figure, const plot_chart *chart,
                   const burnish_theory_model *model, plot_metric *measure, double bits,
                   plot_series *series) {
    series->count = PLOT_POINTS;
    for (size_t i = 0; i < PLOT_POINTS; ++i) {
        series->x[i] = x_at(figure, chart, i);
    }
    if (figure->axis == PLOT_AXIS_EXPONENTS) {
        sample_exponents(model, measure, bits, series);
        return;
    }
    for (size_t i = 0; i < PLOT_POINTS; ++i) {
        series->y[i] = measure(model, series->x[i]);
    }
    if (measure == curvature_radius) {
        end_at_zero(model, series);
    }
}

static burnish_status add_curve(const plot_figure *figure, const plot_request *request,
                                const curve *c, const burnish_theory_model *model,
                                plot_chart *chart, burnish_error *error) {
    const double bits = c->list == &request->bits ? c->list->items[c->index] : 0;
    plot_series *series = plot_add_series(chart, error);
    if (!series) {
        return error->status;
    }
    dress(figure, request, c, model, series);
    sample(figure, chart, model, figure->measure, bits, series);
    return BURNISH_STATUS_OK;
}

/* Adds points from an independent method to every line. */
static burnish_status add_points(const plot_figure *figure, const plot_request *request,
                                 plot_chart *chart, burnish_error *error) {
    for (size_t l = 0; l < request->lobes.count; ++l) {
        plot_series *line = &chart->series[l], *points = plot_add_series(chart, error);
        burnish_theory_model model;
        burnish_status status = points ? plot_make_model(request->lobes.items[l],
                                                         request->exponents.high, &model, error)
                                       : error->status;
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        sample(figure, chart, &model, figure->points, 0, points);
        snprintf(points->name, sizeof points->name, "%s searched", request->lobes.items[l]);
        snprintf(points->text, sizeof points->text, "found by search");
        snprintf(line->text + strlen(line->text), sizeof line->text - strlen(line->text),
                 ", by formula");
        points->ink = line->ink;
        points->dash = PLOT_LINE; /* the script draws it as points */
        points->count = 0;
        for (size_t i = 0; i < PLOT_POINTS; i += 20) {
            points->x[points->count] = points->x[i];
            points->y[points->count++] = points->y[i];
        }
    }
    return BURNISH_STATUS_OK;
}

void plot_state_exponent(const plot_request *request, plot_chart *chart) {
    snprintf(chart->condition, sizeof chart->condition, ", {/:Italic n} = %.6g",
             request->exponents.items[0]);
}

/* Sets the x axis: exponents, bits, or angles up to where cos^n is invisible and the slowest
 * comparison still visible. */
static void set_axis(const plot_figure *figure, const plot_request *request, plot_chart *chart) {
    if (figure->axis == PLOT_AXIS_ANGLES) {
        const burnish_theory_model power = power_with(request->exponents.low);
        double end = 2.4 * burnish_theory_angle_at(&power, 1.0 / 256) * DEGREES;
        chart->x_column = "angle_deg";
        chart->x_low = figure->least_angle;
        chart->x_high = end < 80 ? ceil(end / 5) * 5 : 90;
    } else {
        const int is_bits = figure->axis == PLOT_AXIS_BITS;
        const plot_list *list = is_bits ? &request->bits : &request->exponents;
        chart->x_column = is_bits ? "bits" : "exponent";
        chart->x_low = list->low;
        chart->x_high = list->high;
    }
    if (figure->axis != PLOT_AXIS_EXPONENTS && request->exponents.count == 1) {
        plot_state_exponent(request, chart);
    }
}

static burnish_status fill_curves(const plot_figure *figure, const plot_request *request,
                                  plot_chart *chart, burnish_error *error) {
    const int over_angles = figure->axis == PLOT_AXIS_ANGLES;
    burnish_status status = BURNISH_STATUS_OK;
    curve c = {.letter = over_angles ? 'n' : 'q'};
    if (over_angles) {
        c.list = &request->exponents;
    } else if (figure->axis == PLOT_AXIS_EXPONENTS && request->bits.count > 0) {
        c.list = &request->bits;
    }
    set_axis(figure, request, chart);
    for (c.lobe_index = 0; c.lobe_index < request->lobes.count; ++c.lobe_index) {
        c.lobe = request->lobes.items[c.lobe_index];
        for (c.index = 0; c.index < (c.list ? c.list->count : 1); ++c.index) {
            burnish_theory_model model;
            status = plot_make_model(c.lobe,
                                     over_angles ? c.list->items[c.index] : request->exponents.high,
                                     &model, error);
            if (status != BURNISH_STATUS_OK && over_angles && request->lenient) {
                continue;
            }
            if (status == BURNISH_STATUS_OK) {
                status = add_curve(figure, request, &c, &model, chart, error);
            }
            if (status != BURNISH_STATUS_OK) {
                return status;
            }
        }
    }
    if (chart->series_count == 0) {
        return status;
    }
    return figure->points ? add_points(figure, request, chart, error) : BURNISH_STATUS_OK;
}

burnish_status plot_fill(const plot_figure *figure, const plot_request *request, plot_chart *chart,
                         burnish_error *error) {
    return figure->fill ? figure->fill(request, chart, error)
                        : fill_curves(figure, request, chart, error);
}
