/* Polynomial lobes on great circles, and the three evaluations of the part of an arc inside. */
#include "theory/lights/arc.h"

#include <math.h>

#include "theory/lights/vectors.h"

enum { DEGREE_MAX = BURNISH_THEORY_POWERS_MAX };

burnish_theory_powers burnish_theory_powers_of_order(int order, double zeta) {
    burnish_theory_powers lobe = {.zeta = zeta, .degree = order};
    if (order >= 0 && order <= DEGREE_MAX) {
        lobe.coefficients[order] = 1;
    }
    return lobe;
}

int burnish_polynomial_is_valid(const burnish_theory_powers *lobe) {
    double sum = 0;
    if (!(lobe->zeta > 0 && lobe->zeta <= 1e9) || lobe->degree < 0 || lobe->degree > DEGREE_MAX) {
        return 0;
    }
    for (int i = 0; i <= lobe->degree; ++i) {
        sum += fabs(lobe->coefficients[i]);
    }
    return sum < HUGE_VAL;
}

int burnish_lights_are_valid(const burnish_theory_powers *lobe, const double axis[3],
                             const double *normal, const double light[3]) {
    return burnish_polynomial_is_valid(lobe) && vector_is_direction(axis) &&
           (!normal || vector_is_direction(normal)) && vector_is_direction(light);
}

double burnish_polynomial_value(const burnish_theory_powers *lobe, double u) {
    double sum = 0;
    for (int i = lobe->degree; i >= 0; --i) {
        sum = sum * u + lobe->coefficients[i];
    }
    return sum;
}

double burnish_polynomial_integral(const burnish_theory_powers *lobe) {
    double last = fmax(0, 1 - 2 * lobe->zeta), sum = 0;
    for (int i = 0; i <= lobe->degree; ++i) {
        sum += lobe->coefficients[i] * (1 - pow(last, i + 1)) / (lobe->zeta * (i + 1));
    }
    return sum;
}

void burnish_arc_prepare(burnish_arc_rule *rule, const burnish_theory_powers *lobe,
                         burnish_theory_polygon_rule method) {
    double tail = 0;
    rule->degree = lobe->degree;
    rule->zeta = lobe->zeta;
    rule->cutoff = 1 - 1 / lobe->zeta;
    rule->method = method.method;
    rule->terms = method.terms;
    for (int i = lobe->degree; i >= 0; --i) {
        rule->tails[i] = tail += lobe->coefficients[i] * (lobe->degree + 1) / (i + 1);
    }
    if (method.method == BURNISH_THEORY_POLYGON_GAUSS) {
        burnish_theory_gauss(method.terms, &rule->gauss);
    }
}

double burnish_arc_tail(const burnish_arc_rule *rule, double u) {
    double sum = 0;
    for (int i = rule->degree; i >= 0; --i) {
        sum = sum * u + rule->tails[i];
    }
    return sum;
}

burnish_arc_circle burnish_arc_circle_around(double zeta, const double axis[3],
                                             const double normal[3], double along[3]) {
    burnish_arc_circle circle = {.d = vector_dot(axis, normal)};
    double cutoff = 1 - 1 / zeta;
    vector_cross(normal, axis, along);
    circle.k = sqrt(vector_dot(along, along));
    circle.base = 1 - zeta * circle.d * circle.d / (1 + circle.k);
    if (circle.base > 0) { /* k > cutoff; at the rim k cos t = cutoff */
        double rim = circle.base / zeta * (circle.k + cutoff);
        circle.limit = rim > 0 ? atan2(sqrt(rim), cutoff) : BURNISH_PI;
    }
    return circle;
}

static double gauss(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                    double t1) {
    double middle = 0.5 * (t0 + t1), half = 0.5 * (t1 - t0), sum = 0;
    for (int i = 0; i < rule->terms; ++i) {
        double t = middle + half * rule->gauss.nodes[i], s = sin(0.5 * t);
        double u = circle->base - 2 * rule->zeta * circle->k * s * s;
        sum +=
            rule->gauss.weights[i] * burnish_arc_tail(rule, u) / (1 + circle->k * (1 - 2 * s * s));
    }
    return circle->d * half * sum / (rule->degree + 1);
}

/* T is a polynomial in c; divided by 1 + c it leaves a polynomial and a remainder.
 * The polynomial integrates to powers of cosines, the remainder to an arctangent. */
static double closed(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                     double t1) {
    double p[DEGREE_MAX + 1] = {0}, constant = 1 - rule->zeta, carry = 0, sum = 0;
    int degree = rule->degree;
    for (int j = degree; j >= 0; --j) { /* p = p u + tails[j] */
        for (int i = degree; i > 0; --i) {
            p[i] = p[i] * constant + p[i - 1] * rule->zeta;
        }
        p[0] = p[0] * constant + rule->tails[j];
    }
    for (int i = degree; i > 0; --i) { /* p[i] becomes the coefficient of c^(i - 1) */
        carry = p[i] -= carry;
    }
    double remainder = p[0] - carry, k = circle->k, power = 1, integrals[2] = {0, 0};
    double c[2] = {cos(t0), cos(t1)}, raised[2] = {sin(t0), sin(t1)};
    for (int i = 0; i < degree; ++i) { /* integral of cos^i, from the one two before */
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
    return (circle->d * sum + 2 * remainder * swept) / (degree + 1);
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
    double x[TERMS], f[TERMS], powers[TERMS] = {0}, h[DEGREE_MAX + TERMS] = {0};
    double rim = sin(0.5 * circle->limit), base = 1, carry = 0, sums[2] = {0, 0};
    double eta[2] = {sin(0.5 * t0) / rim, sin(0.5 * t1) / rim};
    int n = rule->terms, degree = rule->degree;
    for (int i = 0; i < n; ++i) {
        x[i] = 0.5 - 0.5 * cos(BURNISH_PI * (i + 0.5) / n);
        double s = rim * rim * (1 - x[i]);
        f[i] = 1 / ((1 + circle->k * (1 - 2 * s)) * sqrt(1 - s));
    }
    interpolate(x, f, n, powers);
    for (int i = 0; i <= degree; ++i, base *= circle->base) {
        for (int j = 0; j < n; ++j) {
            h[i + j] += powers[j] * base * rule->tails[i];
        }
    }
    for (int i = degree + n - 1; i >= 0; --i) {
        carry = h[i] + carry * (2 * i + 2) / (2 * i + 3);
        for (int end = 0; end < 2; ++end) {
            sums[end] = sums[end] * (1 - eta[end] * eta[end]) + carry / (2 * i + 1);
        }
    }
    return 2 * circle->d * rim * (eta[1] * sums[1] - eta[0] * sums[0]) / (degree + 1);
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
