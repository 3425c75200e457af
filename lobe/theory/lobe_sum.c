/* Sums of lobes, and the lobes of rough surfaces that they approximate. */
#include "theory/lobe_sum.h"

#include <math.h>

#include "theory/internal.h"

/* The target, up to a factor. With s = 1 - h^2, D of GGX is 1 / (alpha^2 + (1 - alpha^2) s)^2,
 * Beckmann's exp(-tan^2 / alpha^2) / h^4. */
static double shape(burnish_theory_distribution distribution, double alpha, double lambda) {
    double s = 0.5 * lambda, squared = alpha * alpha;
    double d = squared / (squared + (1 - squared) * s);
    if (distribution == BURNISH_THEORY_BECKMANN) {
        d = exp(-0.5 * s / (squared * (1 - s))) / (1 - s);
    }
    return lambda < 1 ? (1 - lambda) * d * d : 0;
}

/* The integral of the shape over solid angle, by Simpson's rule in log(1 + lambda / alpha^2). */
static double whole(burnish_theory_distribution distribution, double alpha) {
    enum { STEPS = 2000 };
    double scale = alpha * alpha, end = log1p(1 / scale), sum = 0;
    for (int i = 0; i <= STEPS; ++i) {
        double lambda = scale * expm1(end * i / STEPS), weight = i & 1 ? 4 : 2;
        weight = i == 0 || i == STEPS ? 1 : weight;
        sum += weight * shape(distribution, alpha, lambda) * (lambda + scale);
    }
    return 2 * BURNISH_PI * sum * end / (3 * STEPS);
}

double burnish_theory_rough_value(burnish_theory_distribution distribution, double alpha,
                                  double lambda) {
    return alpha > 0 && alpha <= 1
               ? shape(distribution, alpha, fmax(0, lambda)) / whole(distribution, alpha)
               : NAN;
}

double burnish_theory_lobe_sum_value(const burnish_theory_lobe_sum *sum, double lambda) {
    double value = 0;
    for (int i = 0; i < sum->count; ++i) {
        double u = fmax(0, 1 - sum->zeta[i] * lambda);
        double energy = 2 * BURNISH_PI / (sum->zeta[i] * (sum->order[i] + 1));
        value += sum->weight[i] / energy * pow(u, sum->order[i]);
    }
    return value;
}

void burnish_lobe_sum_evaluate(const burnish_lobe_sum_row *row, int count, double alpha,
                               burnish_theory_lobe_sum *sum) {
    double total = 0;
    *sum = (burnish_theory_lobe_sum){.count = count, .weight = {1}};
    for (int i = 0; i < 2 * count - 1; ++i) {
        double value = 0;
        for (int j = BURNISH_LOBE_SUM_TERMS - 1; j >= 0; --j) {
            value = value * alpha + row->terms[i][j];
        }
        if (i < count) {
            sum->zeta[i] = fmax(1, value / (alpha * alpha));
            sum->order[i] = row->order[i];
        } else {
            sum->weight[i - count + 1] = fmax(0, value);
            sum->weight[0] -= fmax(0, value);
        }
    }
    sum->weight[0] = fmax(0, sum->weight[0]);
    for (int i = 0; i < count; ++i) {
        total += sum->weight[i];
    }
    for (int i = 0; i < count; ++i) {
        sum->weight[i] /= total;
    }
}

void burnish_lobe_sum_prepare(burnish_theory_distribution distribution, double alpha,
                              burnish_lobe_sum_grid *grid) {
    double all = whole(distribution, alpha), before = 0, start = log(1e-3 * alpha * alpha);
    grid->peak = shape(distribution, alpha, 0) / all;
    for (int i = 0; i < grid->count; ++i) {
        double end = exp(start * (1 - (i + 1.0) / grid->count));
        grid->lambda[i] = 0.5 * (before + end);
        grid->step[i] = 2 * BURNISH_PI * (end - before);
        grid->value[i] = shape(distribution, alpha, grid->lambda[i]) / all;
        before = end;
    }
}

void burnish_lobe_sum_measure(const burnish_lobe_sum_grid *grid, const burnish_theory_lobe_sum *sum,
                              burnish_theory_lobe_sum_error *error) {
    double inside = 0;
    *error = (burnish_theory_lobe_sum_error){0};
    for (int i = 0; i < grid->count; ++i) {
        double value = burnish_theory_lobe_sum_value(sum, grid->lambda[i]);
        double difference = (value - grid->value[i]) * grid->step[i];
        inside += difference;
        error->moved += 0.5 * fabs(difference);
        error->cap = fmax(error->cap, fabs(inside));
    }
    error->peak = burnish_theory_lobe_sum_value(sum, 0) / grid->peak;
}
