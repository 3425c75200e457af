/* Sums of lobes, and the lobes of rough surfaces that they approximate. */
#include <math.h>

#include "theory/internal.h"

enum { TERMS = 5 };

/* Coefficients in alpha: zeta alpha^2 of each lobe, then the weights of all but the first. */
typedef struct sum_row {
    int order[BURNISH_THEORY_LOBE_SUM_MAX];
    double terms[2 * BURNISH_THEORY_LOBE_SUM_MAX - 1][TERMS];
} sum_row;

/* By distribution and number. A search lowered the mean error of 20 roughnesses. */
/* clang-format off */
static const sum_row rows[2][BURNISH_THEORY_LOBE_SUM_MAX] = {
    {
        {{2, 0, 0},
         {{0.115814, 0.101127, 0.151972, 0.570558, 0.091010}}},
        {{4, 1, 0},
         {{0.130873, 0.145536, 0.125278, 0.244102, 0.399355},
          {0.045493, 0.060453, 0.474393, 0.793652, -0.361736},
          {0.398137, 0.546989, -2.960546, 6.946654, -3.944059}}},
        {{4, 2, 1},
         {{0.195991, -0.038349, 2.437220, -4.349801, 2.777889},
          {0.070456, 0.049457, 1.228855, -1.088043, 0.823176},
          {0.020008, 0.024145, 0.752692, 0.344416, -0.140196},
          {0.433745, 0.095864, 0.223609, -1.405286, 0.656158},
          {0.187038, 0.186449, 0.333351, 0.745939, -0.446119}}},
    },
    {
        {{4, 0, 0},
         {{0.090000, 0.000000, 0.000000, 0.000000, 0.000000}}},
        {{4, 1, 0},
         {{0.124688, 0.053616, -0.847424, 3.462094, -2.567430},
          {0.103310, 0.092566, -1.086509, 5.536703, -4.181876},
          {0.322017, 0.541595, -10.245351, 31.579446, -21.197707}}},
        {{8, 2, 1},
         {{0.062953, -0.032183, 0.035184, 1.323338, -1.258886},
          {0.185306, -1.188878, 5.872717, -7.581791, 2.712646},
          {0.094120, -0.248998, 2.651247, -5.476155, 3.253023},
          {-0.348921, -6.268654, 54.672846, -99.108274, 51.053003},
          {0.191628, -1.194816, 7.610657, -19.293504, 19.153544}}},
    },
};
/* clang-format on */

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

/* Slopes and weights within their limits. */
static void evaluate(const sum_row *row, int count, double alpha, burnish_theory_lobe_sum *sum) {
    double total = 0;
    *sum = (burnish_theory_lobe_sum){.count = count, .weight = {1}};
    for (int i = 0; i < 2 * count - 1; ++i) {
        double value = 0;
        for (int j = TERMS - 1; j >= 0; --j) {
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

burnish_status burnish_theory_lobe_sum_fit(burnish_theory_distribution distribution, double alpha,
                                           int count, burnish_theory_lobe_sum *sum,
                                           burnish_error *error) {
    if (!(alpha > 0 && alpha <= 1)) {
        return burnish_theory_fail(error, "alpha %g is not in (0, 1]", alpha);
    }
    if (count < 1 || count > BURNISH_THEORY_LOBE_SUM_MAX) {
        return burnish_theory_fail(error, "%d lobes: a sum has 1 to %d", count,
                                   BURNISH_THEORY_LOBE_SUM_MAX);
    }
    evaluate(&rows[distribution == BURNISH_THEORY_BECKMANN][count - 1], count, alpha, sum);
    return BURNISH_STATUS_OK;
}

void burnish_theory_lobe_sum_compare(burnish_theory_distribution distribution, double alpha,
                                     const burnish_theory_lobe_sum *sum,
                                     burnish_theory_lobe_sum_error *error) {
    enum { POINTS = 1500 };
    double all = whole(distribution, alpha), start = log(1e-3 * alpha * alpha);
    double before = 0, inside = 0;
    *error = (burnish_theory_lobe_sum_error){0};
    for (int i = 0; i < POINTS; ++i) {
        double end = exp(start * (1 - (i + 1.0) / POINTS)), lambda = 0.5 * (before + end);
        double value = burnish_theory_lobe_sum_value(sum, lambda);
        double target = shape(distribution, alpha, lambda) / all;
        double difference = (value - target) * (2 * BURNISH_PI * (end - before));
        inside += difference;
        error->moved += 0.5 * fabs(difference);
        error->cap = fmax(error->cap, fabs(inside));
        before = end;
    }
    error->peak = burnish_theory_lobe_sum_value(sum, 0) / (shape(distribution, alpha, 0) / all);
}
