/* The figure `polygon`: the error of every evaluation of a polygon's light. The figure `rough`: GGX
 * and sums of lobes that approximate it. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "base/cli/values.h"
#include "program/figures.h"

enum { QUADS = 150, SLOPES = 61 };
#define SLOPE_MAX 1000.0
#define FLOOR 1e-14 /* of errors, which can be 0 */

/* Numerical Recipes' 64-bit generator. */
static double uniform(uint64_t *state, double low, double high) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * ((double)(*state >> 11) * 0x1p-53);
}

/* A rectangle above the ground, and a direction within a lobe's width of one of its edges. */
static void random_quad(uint64_t *state, double zeta, double (*corners)[3], double axis[3]) {
    double turn = uniform(state, 0, 2 * CLI_PI), tilt = uniform(state, -0.4, 0.4);
    double width = 0.03 * pow(50, uniform(state, 0, 1));
    double height = 0.03 * pow(50, uniform(state, 0, 1));
    double along = uniform(state, 0, 1), reach = fmin(1, sqrt(2 / zeta));
    for (int i = 0; i < 4; ++i) {
        double x = i == 1 || i == 2 ? -width : width, y = i < 2 ? -height : height;
        corners[i][0] = x * cos(turn) - y * sin(turn);
        corners[i][1] = x * sin(turn) + y * cos(turn);
        corners[i][2] = 1 + tilt * x / (1 + width);
    }
    for (int j = 0; j < 3; ++j) {
        axis[j] = corners[0][j] + along * (corners[1][j] - corners[0][j]);
    }
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    for (int j = 0; j < 3; ++j) {
        axis[j] = axis[j] / length + reach * uniform(state, -1, 1);
    }
}

/* The largest error relative to the whole lobe. */
static double worst_error(int order, double zeta, const burnish_theory_polygon_rule *rule) {
    uint64_t state = 1;
    double worst = FLOOR;
    for (int i = 0; i < QUADS; ++i) {
        double corners[4][3], axis[3];
        random_quad(&state, zeta, corners, axis);
        const double(*vertices)[3] = (const double(*)[3])corners;
        double best = burnish_theory_polygon(order, zeta, axis, NULL, vertices, 4, NULL);
        double value = burnish_theory_polygon(order, zeta, axis, NULL, vertices, 4, rule);
        worst = fmax(worst, fabs(value - best) * zeta * (order + 1) / (2 * CLI_PI));
    }
    return worst;
}

burnish_status plot_fill_polygon(const plot_request *request, plot_chart *chart,
                                 burnish_error *error) {
    static const struct {
        burnish_theory_polygon_rule rule;
        const char *name;
        int ink, dash;
    } rows[] = {
        {{BURNISH_THEORY_POLYGON_CLOSED, 0}, "closed form", 1, PLOT_LINE},
        {{BURNISH_THEORY_POLYGON_GAUSS, 4}, "4 nodes", 0, PLOT_DOTTED},
        {{BURNISH_THEORY_POLYGON_GAUSS, 6}, "6 nodes", 0, PLOT_DASH_DOT},
        {{BURNISH_THEORY_POLYGON_GAUSS, 8}, "8 nodes", 0, PLOT_DASHED},
        {{BURNISH_THEORY_POLYGON_NARROW, 2}, "narrow form 2 points", 2, PLOT_DOTTED},
        {{BURNISH_THEORY_POLYGON_NARROW, 3}, "narrow form 3 points", 2, PLOT_DASHED},
        {{BURNISH_THEORY_POLYGON_NARROW, 4}, "narrow form 4 points", 2, PLOT_LINE},
    };
    burnish_theory_model model;
    burnish_status status =
        plot_make_model(request->lobes.items[0], request->exponents.items[0], &model, error);
    for (size_t i = 0; i < sizeof rows / sizeof *rows && status == BURNISH_STATUS_OK; ++i) {
        plot_series *series = plot_add_series(chart, error);
        if (!series) {
            return error->status;
        }
        snprintf(series->name, sizeof series->name, "%s", rows[i].name);
        snprintf(series->text, sizeof series->text, "%s", rows[i].name);
        series->ink = PLOT_INK_LOBE + rows[i].ink;
        series->dash = rows[i].dash;
        for (size_t k = 0; k < SLOPES; ++k) {
            double zeta = pow(SLOPE_MAX, (double)k / (SLOPES - 1));
            double value = worst_error(model.lobe.order, zeta, &rows[i].rule);
            series->x[series->count] = zeta;
            series->y[series->count++] = value > 2 ? NAN : value;
        }
    }
    chart->x_low = 1;
    chart->x_high = SLOPE_MAX;
    chart->x_column = "zeta";
    snprintf(chart->condition, sizeof chart->condition, ", order %d", model.lobe.order);
    return status;
}

/* Adds a curve over the angle from the mirror direction, relative to GGX at its peak: GGX itself
 * for count 0. */
static burnish_status add_rough(plot_chart *chart, double roughness, int count, int ink,
                                burnish_error *error) {
    plot_series *series = plot_add_series(chart, error);
    burnish_theory_lobe_sum sum;
    double alpha = roughness * roughness;
    if (!series) {
        return error->status;
    }
    if (count > 0) { /* the parameters are in range: no error */
        (void)burnish_theory_lobe_sum_fit(BURNISH_THEORY_GGX, alpha, count, &sum, error);
    }
    snprintf(series->name, sizeof series->name, "%s%d r=%g", count ? "sum" : "GGX", count,
             roughness);
    if (count == 0) {
        snprintf(series->text, sizeof series->text, "{/:Italic r} = %g", roughness);
    }
    series->ink = count == 3 ? PLOT_INK_TEXT : ink; /* it covers GGX */
    series->dash = count == 0 ? PLOT_LINE : count == 3 ? PLOT_DASHED : PLOT_DOTTED;
    double peak = burnish_theory_rough_value(BURNISH_THEORY_GGX, alpha, 0);
    for (size_t i = 0; i < PLOT_POINTS; ++i) {
        double degrees = 90 * pow((double)i / (PLOT_POINTS - 1), 1.5);
        double lambda = 1 - cos(degrees * CLI_DEGREE);
        double value = count ? burnish_theory_lobe_sum_value(&sum, lambda)
                             : burnish_theory_rough_value(BURNISH_THEORY_GGX, alpha, lambda);
        series->x[series->count] = degrees;
        series->y[series->count++] = value / peak;
    }
    return BURNISH_STATUS_OK;
}

burnish_status plot_fill_rough(const plot_request *request, plot_chart *chart,
                               burnish_error *error) {
    static const double roughnesses[] = {0.3, 0.4, 0.5, 0.65, 1};
    burnish_status status = BURNISH_STATUS_OK;
    (void)request;
    for (int i = 0; i < 5 && status == BURNISH_STATUS_OK; ++i) {
        int ink = PLOT_INK_RAMP + i * (PLOT_RAMP_INKS - 1) / 4;
        for (int count = 0; count <= 3 && status == BURNISH_STATUS_OK; ++count) {
            if (count != 2 && (count != 1 || roughnesses[i] < 1)) {
                status = add_rough(chart, roughnesses[i], count, ink, error);
            }
        }
    }
    chart->x_low = 0;
    chart->x_high = 90;
    chart->x_column = "angle_deg";
    return status;
}
