/* Adaptive Gauss-Kronrod quadrature, 7 and 15 points, and Gauss-Legendre rules. Source of the rule:
 * Kronrod 1965; of its constants: QUADPACK (Piessens et al. 1983). */
#include <math.h>

#include "theory/internal.h"

enum { MAX_DEPTH = 48 };
#define NOISE 1e-14

static const double NODES[8] = {
    0.991455371120812639, 0.949107912342758525, 0.864864423359769073, 0.741531185599394440,
    0.586087235467691130, 0.405845151377397167, 0.207784955007898468, 0};
static const double KRONROD[8] = {0.022935322010529225, 0.063092092629978553, 0.104790010322250184,
                                  0.140653259715525919, 0.169004726639267903, 0.190350578064785410,
                                  0.204432940075298892, 0.209482141084727828};
static const double GAUSS[4] = {0.129484966168869693, 0.279705391489276668, 0.381830050505118945,
                                0.417959183673469388};

static double panel(burnish_theory_integrand f, const void *context, double low, double high,
                    double tolerance, int depth) {
    double centre = 0.5 * (low + high), half = 0.5 * (high - low);
    double middle = f(centre, context);
    double kronrod = KRONROD[7] * middle, gauss = GAUSS[3] * middle;
    double size = KRONROD[7] * fabs(middle);
    for (int i = 0; i < 7; ++i) {
        double left = f(centre - half * NODES[i], context);
        double right = f(centre + half * NODES[i], context);
        kronrod += KRONROD[i] * (left + right);
        size += KRONROD[i] * (fabs(left) + fabs(right));
        gauss += i & 1 ? GAUSS[i / 2] * (left + right) : 0;
    }
    /* If the two rules agree to d, the longer one is far better than d. Below NOISE of the
     * integrand's size rounding errors keep them apart. */
    double d = half * fabs(kronrod - gauss);
    if (!(d > tolerance && d > NOISE * half * size) || depth == MAX_DEPTH) {
        return half * kronrod;
    }
    return panel(f, context, low, centre, tolerance, depth + 1) +
           panel(f, context, centre, high, tolerance, depth + 1);
}

/* The next s where a table has a node or a step. */
static double next_node(const burnish_theory_model *model, double s) {
    double last = model->lobe.entries - 1, offset = model->lobe.linear ? 0 : 0.5;
    double position = (1 - s * s) * last - offset;
    double node = ceil(position - 1e-9) - 1;
    return node + offset >= 0 ? sqrt((last - node - offset) / last) : HUGE_VAL;
}

/* The next s at which a panel ends: the lobe's own corners, and steps that double from
 * the width 1/sqrt(n) of the peak. */
static double next_break(const burnish_theory_model *model, double s) {
    double next = 1 / sqrt(model->exponent), beyond = s * (1 + 1e-12);
    double corners[2] = {HUGE_VAL, HUGE_VAL};
    while (next <= beyond) {
        next *= 2;
    }
    if (model->lobe.kind == BURNISH_LOBE_TABLE) {
        corners[0] = next_node(model, s);
    } else if (model->lobe.kind == BURNISH_LOBE_KUIJK_BLAKE) {
        corners[0] = sqrt(burnish_theory_lambda_of_angle(model->k[0]));
        corners[1] = sqrt(burnish_theory_lambda_of_angle(model->k[1]));
    } else if (model->zeta > 0) {
        corners[0] = 1 / sqrt(model->zeta);
    }
    for (int i = 0; i < 2; ++i) {
        next = corners[i] > beyond && corners[i] < next ? corners[i] : next;
    }
    return next;
}

double burnish_theory_quadrature(burnish_theory_integrand f, const void *context,
                                 const burnish_theory_model *model, double s0, double s1,
                                 double tolerance) {
    double sum = 0;
    while (s0 < s1) {
        double next = next_break(model, s0);
        next = next < s1 ? next : s1;
        sum += panel(f, context, s0, next, tolerance, 0);
        s0 = next;
    }
    return sum;
}

/* Legendre's polynomial of this degree and its derivative. */
static double legendre(int degree, double x, double *slope) {
    double before = 1, value = x;
    for (int j = 2; j <= degree; ++j) {
        double next = ((2 * j - 1) * x * value - (j - 1) * before) / j;
        before = value;
        value = next;
    }
    *slope = degree * (x * value - before) / (x * x - 1);
    return value;
}

void burnish_theory_gauss(int count, burnish_theory_nodes *rule) {
    rule->count = count;
    for (int i = 0; i < count; ++i) { /* Newton's method from Tricomi's guess */
        double x = count == 1 ? 1e-9 : cos(BURNISH_PI * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 6; ++step) {
            double value = count == 1 ? x : legendre(count, x, &slope);
            x -= value / slope;
        }
        rule->nodes[i] = x;
        rule->weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
}
