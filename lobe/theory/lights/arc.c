/* Polynomial lobes on great circles, and two evaluations of the part of an arc inside. */
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

void burnish_arc_prepare(burnish_arc_rule *rule, const burnish_theory_powers *lobe, int nodes) {
    double tail = 0;
    rule->degree = lobe->degree;
    rule->zeta = lobe->zeta;
    rule->cutoff = 1 - 1 / lobe->zeta;
    rule->gauss.count = 0;
    for (int i = lobe->degree; i >= 0; --i) {
        rule->tails[i] = tail += lobe->coefficients[i] * (lobe->degree + 1) / (i + 1);
    }
    if (nodes > 0) {
        burnish_theory_gauss(nodes, &rule->gauss);
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
    for (int i = 0; i < rule->gauss.count; ++i) {
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

double burnish_arc_inside(const burnish_arc_rule *rule, const burnish_arc_circle *circle, double t0,
                          double t1) {
    return rule->gauss.count == 0 ? closed(rule, circle, t0, t1) : gauss(rule, circle, t0, t1);
}
