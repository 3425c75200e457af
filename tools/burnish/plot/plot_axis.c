/* Ranges and ticks that a reader can read off: 1, 2, 5 steps, exponent axes by powers. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/plot.h"

/* A number of an axis, in enhanced text with a true minus. */
static void write_tick(double at, char *text, size_t size) {
    const char *sign = at < 0 ? "−" : "";
    double magnitude = fabs(at);
    if (magnitude == 0 || (magnitude >= 1e-4 && magnitude < 1e6)) {
        snprintf(text, size, "%s%.6g", sign, magnitude);
        return;
    }
    int power = (int)floor(log10(magnitude) + 1e-9);
    double digits = magnitude / pow(10, power);
    const char *power_sign = power < 0 ? "−" : "";
    if (fabs(digits - 1) < 1e-6) {
        snprintf(text, size, "%s10^{%s%d}", sign, power_sign, abs(power));
    } else {
        snprintf(text, size, "%s%.2g·10^{%s%d}", sign, digits, power_sign, abs(power));
    }
}

static void add_tick(plot_axis *axis, double at, int minor) {
    if (axis->tick_count == PLOT_TICKS_MAX) {
        return;
    }
    plot_tick *tick = &axis->ticks[axis->tick_count++];
    tick->at = at;
    tick->minor = minor;
    tick->text[0] = 0;
    if (!minor) {
        write_tick(at, tick->text, sizeof tick->text);
    }
}

/* 10^k without libm's rounding: exact for the k of axes. */
static double power_of_ten(int k) {
    double power = 1;
    for (int i = 0; i < (k < 0 ? -k : k); ++i) {
        power *= 10;
    }
    return k < 0 ? 1 / power : power;
}

/* The largest of 1, 2, 5 times a power of ten that is at most x > 0, or the least that is at least
 * x; a rounding error either way does not count. */
static double round_125(double x, int up) {
    static const double steps[] = {1, 2, 5, 10};
    double decade = power_of_ten((int)floor(log10(x) + 1e-9));
    double best = decade;
    for (size_t i = 0; i < 4; ++i) {
        double step = steps[i] * decade;
        if (up && step >= x * (1 - 1e-9)) {
            return step;
        }
        best = step <= x * (1 + 1e-9) ? step : best;
    }
    return best;
}

/* The ends of an axis of exponents are labelled where no other label is near. */
static void label_ends(plot_axis *axis) {
    const double room = 0.055; /* of the axis */
    double ends[2] = {axis->low, axis->high}, length = log(axis->high / axis->low);
    for (int e = 0; e < 2; ++e) {
        int near = 0;
        for (size_t i = 0; i < axis->tick_count; ++i) {
            const plot_tick *tick = &axis->ticks[i];
            near |= !tick->minor && fabs(log(tick->at / ends[e])) < room * length;
        }
        if (!near) {
            add_tick(axis, ends[e], 0);
        }
    }
}

static void logarithmic_ticks(plot_axis *axis) {
    double decades = log10(axis->high / axis->low);
    int first = (int)floor(log10(axis->low) - 1e-9), last = (int)ceil(log10(axis->high));
    for (int k = first; k <= last; ++k) {
        for (int digit = 1; digit < 10; ++digit) {
            double at = digit * power_of_ten(k);
            int labelled = digit == 1 || (decades < 3.6 && (digit == 2 || digit == 5));
            if (at >= axis->low * (1 - 1e-9) && at <= axis->high * (1 + 1e-9)) {
                add_tick(axis, at, !labelled);
            }
        }
    }
    label_ends(axis);
}

/* Steps of an axis of angles divide a right angle. */
static double linear_step(const plot_axis *axis, int is_x) {
    static const double degrees[] = {1, 2, 5, 10, 15, 30};
    double span = axis->high - axis->low;
    if (strcmp(axis->column, "angle_deg") == 0) {
        for (size_t i = 0; i < sizeof degrees / sizeof *degrees; ++i) {
            if (span / degrees[i] <= 9) {
                return degrees[i];
            }
        }
    }
    return round_125(span / (is_x ? 9 : 7), 1);
}

static void linear_ticks(plot_axis *axis, int is_x) {
    double step = linear_step(axis, is_x);
    for (double i = ceil(axis->low / step - 1e-9); i * step <= axis->high + 1e-9 * step; ++i) {
        add_tick(axis, i * step + 0.0, 0); /* + 0: no negative zero */
    }
}

static void data_range(const plot_chart *chart, int is_x, double range[2]) {
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        for (size_t k = 0; k < series->count; ++k) {
            double value = is_x ? series->x[k] : series->y[k];
            int drawn = !(is_x ? &chart->x : &chart->y)->logarithmic || value > 0;
            if (drawn && isfinite(value) && isfinite(series->y[k])) {
                range[0] = value < range[0] ? value : range[0];
                range[1] = value > range[1] ? value : range[1];
            }
        }
    }
}

static void finish_axis(const plot_chart *chart, plot_axis *axis, int is_x) {
    if (axis->low == 0 && axis->high == 0) {
        double range[2];
        data_range(chart, is_x, range);
        if (!(range[0] <= range[1]) || (axis->logarithmic && !(range[1] > 0))) {
            range[0] = axis->logarithmic ? 0.1 : 0;
            range[1] = 1;
        }
        if (axis->logarithmic) {
            /* Six decades show everything that matters; curves may leave through the floor. */
            double floor_value = range[1] * 1e-6;
            axis->low = round_125(range[0] > floor_value ? range[0] : floor_value, 0);
            axis->high = round_125((chart->note_count > 0 ? 1.6 : 1.08) * range[1], 1);
        } else {
            axis->low = range[0] < 0 ? range[0] : 0;
            axis->high = range[1];
            double step = axis->high > axis->low ? linear_step(axis, is_x) : 1;
            axis->low = floor(axis->low / step + 1e-9) * step;
            axis->high = ceil(axis->high / step - 1e-9) * step;
        }
        if (!(axis->high > axis->low)) {
            axis->high = axis->logarithmic ? axis->low * 10 : axis->low + 1;
        }
    }
    if (axis->tick_count == 0) {
        if (axis->logarithmic) {
            logarithmic_ticks(axis);
        } else {
            linear_ticks(axis, is_x);
        }
    }
}

void plot_finish_axes(plot_chart *chart) {
    finish_axis(chart, &chart->x, 1);
    finish_axis(chart, &chart->y, 0);
}
