/* The three evaluations of the part of an arc inside the lobe. */
#include "theory/arc.h"

#include <math.h>

#include "theory/internal.h"

enum { ORDER_MAX = BURNISH_THEORY_POLYGON_ORDER_MAX };

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

void burnish_arc_prepare(burnish_arc_rule *rule) {
    int n = rule->method == BURNISH_THEORY_POLYGON_GAUSS ? rule->terms : 0;
    for (int i = 0; i < n; ++i) { /* Newton's method from Tricomi's guess */
        double x = n == 1 ? 1e-9 : cos(BURNISH_PI * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 6; ++step) {
            double value = n == 1 ? x : legendre(n, x, &slope);
            x -= value / slope;
        }
        rule->nodes[i] = x;
        rule->weights[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

/* 1 + u + ... + u^m */
static double sum_of_powers(int order, double u) {
    double sum = 1;
    for (int i = 0; i < order; ++i) {
        sum = sum * u + 1;
    }
    return sum;
}

static double gauss(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                    double t1) {
    double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0), sum = 0;
    for (int i = 0; i < rule->terms; ++i) {
        double t = middle + half * rule->nodes[i], s = sin(0.5 * t);
        double u = circle->base - 2 * rule->zeta * circle->k * s * s;
        sum += rule->weights[i] * sum_of_powers(rule->order, u) / (1 + circle->k * (1 - 2 * s * s));
    }
    return circle->d * half * sum / (rule->order + 1);
}

/* The sum of powers is a polynomial in c; divided by 1 + c it leaves a polynomial and a remainder.
 * The polynomial integrates to powers of cosines, the remainder to an arctangent. */
static double closed(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                     double t1) {
    double p[ORDER_MAX + 1] = {0}, constant = 1 - rule->zeta, carry = 0, sum = 0;
    int order = rule->order;
    for (int j = 0; j <= order; ++j) { /* p = p u + 1 */
        for (int i = order; i > 0; --i) {
            p[i] = p[i] * constant + p[i - 1] * rule->zeta;
        }
        p[0] = p[0] * constant + 1;
    }
    for (int i = order; i > 0; --i) { /* p[i] becomes the coefficient of c^(i - 1) */
        carry = p[i] -= carry;
    }
    double remainder = p[0] - carry, k = circle->k, power = 1, integrals[2] = {0, 0};
    double c[2] = {cos(t0), cos(t1)}, raised[2] = {sin(t0), sin(t1)};
    for (int i = 0; i < order; ++i) { /* integral of cos^i, from the one two before */
        double now = i == 0 ? t1 - t0 : (raised[1] - raised[0] + (i - 1) * integrals[i & 1]) / i;
        integrals[i & 1] = now;
        sum += p[i + 1] * power * now;
        power *= k;
        for (int end = 0; end < 2 && i > 0; ++end) {
            raised[end] *= c[end];
        }
    }
    double tangent = circle->d / (1 + k);
    double swept = atan2(tangent * sin(0.5 * t1), cos(0.5 * t1)) -
                   atan2(tangent * sin(0.5 * t0), cos(0.5 * t0));
    return (circle->d * sum + 2 * remainder * swept) / (order + 1);
}

/* The polynomial through n points, by divided differences, as coefficients of powers. */
static void interpolate(const double *x, double *f, int n, double *powers) {
    for (int j = 1; j < n; ++j) {
        for (int i = n - 1; i >= j; --i) {
            f[i] = (f[i] - f[i - 1]) / (x[i] - x[i - j]);
        }
    }
    for (int i = n - 1; i >= 0; --i) {
        for (int j = n - 1; j > 0; --j) {
            powers[j] = powers[j - 1] - x[i] * powers[j];
        }
        powers[0] = f[i] - x[i] * powers[0];
    }
}

/* With eta = sin(t / 2) / sin(limit / 2) and w = 1 - eta^2, u is base times w. What is left,
 * f = 1 / ((1 + c) cos(t / 2)), varies slowly: a polynomial in w approximates it. The integrals of
 * w^i have a recurrence without cancellation: (2 i + 1) J_i = eta w^i + 2 i J_(i-1). */
static double narrow(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                     double t1) {
    enum { TERMS = BURNISH_THEORY_POLYGON_NARROW_MAX };
    double x[TERMS], f[TERMS], powers[TERMS] = {0}, h[ORDER_MAX + TERMS] = {0};
    double rim = sin(0.5 * circle->limit), base = 1, carry = 0, sums[2] = {0, 0};
    double eta[2] = {sin(0.5 * t0) / rim, sin(0.5 * t1) / rim};
    int n = rule->terms, order = rule->order;
    for (int i = 0; i < n; ++i) {
        x[i] = 0.5 - 0.5 * cos(BURNISH_PI * (i + 0.5) / n);
        double s = rim * rim * (1 - x[i]);
        f[i] = 1 / ((1 + circle->k * (1 - 2 * s)) * sqrt(1 - s));
    }
    interpolate(x, f, n, powers);
    for (int i = 0; i <= order; ++i, base *= circle->base) {
        for (int j = 0; j < n; ++j) {
            h[i + j] += powers[j] * base;
        }
    }
    for (int i = order + n - 1; i >= 0; --i) {
        carry = h[i] + carry * (2 * i + 2) / (2 * i + 3);
        for (int end = 0; end < 2; ++end) {
            sums[end] = sums[end] * (1 - eta[end] * eta[end]) + carry / (2 * i + 1);
        }
    }
    return 2 * circle->d * rim * (eta[1] * sums[1] - eta[0] * sums[0]) / (order + 1);
}

double burnish_arc_inside(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                          double t1) {
    switch (rule->method) {
    case BURNISH_THEORY_POLYGON_CLOSED:
        return closed(rule, circle, t0, t1);
    case BURNISH_THEORY_POLYGON_NARROW:
        return narrow(rule, circle, t0, t1);
    case BURNISH_THEORY_POLYGON_GAUSS:
        break;
    }
    return gauss(rule, circle, t0, t1);
}
