/* The light of a thin cylinder reflected by a lobe, as an integral along an arc. */
#include <string.h>

#include "theory/lights/arc.h"
#include "theory/lights/vectors.h"

/* Cuts a segment off at the horizon; returns 0 if nothing is left. */
static int clip(double ends[2][3], const double normal[3]) {
    double height[2] = {vector_dot(ends[0], normal), vector_dot(ends[1], normal)};
    int below = height[1] < height[0];
    if (height[below] < 0) {
        double share = height[below] / (height[below] - height[!below]);
        for (int i = 0; i < 3; ++i) {
            ends[below][i] += share * (ends[!below][i] - ends[below][i]);
        }
    }
    return height[!below] > 0;
}

/* The integral of S cos(t - foot) over an arc within the lobe: by Gauss's rule, nothing cancels. */
static double along_arc(const burnish_theory_powers *lobe, const burnish_arc_circle *circle,
                        double foot, double start, double length) {
    burnish_theory_nodes rule;
    double half = 0.5 * length, sum = 0;
    burnish_theory_gauss(24 + lobe->degree, &rule);
    for (int i = 0; i < rule.count; ++i) {
        double t = start + half * (1 + rule.nodes[i]), s = sin(0.5 * t);
        double u = circle->base - 2 * lobe->zeta * circle->k * s * s;
        sum += rule.weights[i] * burnish_polynomial_value(lobe, u) * cos(t - foot);
    }
    return half * sum;
}

static double integrate(const burnish_theory_powers *lobe, const double axis[3],
                        double ends[2][3]) {
    double chord[3], normal[3], along[3], unit[3], sum = 0;
    for (int i = 0; i < 3; ++i) {
        chord[i] = ends[1][i] - ends[0][i];
    }
    int nearer = vector_dot(ends[1], ends[1]) < vector_dot(ends[0], ends[0]); /* more digits */
    vector_cross(ends[nearer], chord, normal);
    double area = sqrt(vector_dot(normal, normal)), length = sqrt(vector_dot(chord, chord));
    if (!(area > 0)) {
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        unit[i] = normal[i] / area;
    }
    burnish_arc_circle circle = burnish_arc_circle_around(lobe->zeta, axis, unit, along);
    double distance = area / length, angle = atan2(area, vector_dot(ends[0], ends[1]));
    double start = atan2(vector_dot(along, ends[0]), vector_dot(axis, ends[0]));
    double foot = atan2(vector_dot(ends[0], chord) / length, distance); /* from it to the start */
    for (int turn = 0; turn < 2; ++turn) { /* the lobe ahead, and one turn later */
        double first = start - turn * 2 * BURNISH_PI, cut = fmax(0, -circle.limit - first);
        double part = fmin(angle, circle.limit - first) - cut;
        sum += part > 0 ? along_arc(lobe, &circle, first - foot, first + cut, part) : 0;
    }
    return sum / distance;
}

double burnish_theory_segment(const burnish_theory_powers *lobe, const double axis[3],
                              const double *normal, const double ends[2][3]) {
    double unit[3], scaled[2][3];
    if (!burnish_lights_are_valid(lobe, axis, normal, ends[0]) || !vector_is_direction(ends[1])) {
        return NAN;
    }
    double size = fmax(vector_largest(ends[0]), vector_largest(ends[1]));
    for (int i = 0; i < 6; ++i) {
        scaled[i / 3][i % 3] = ends[i / 3][i % 3] / size;
    }
    if (normal) {
        vector_normalize(normal, unit);
        if (!clip(scaled, unit)) {
            return 0;
        }
    }
    vector_normalize(axis, unit);
    return integrate(lobe, unit, scaled) / size;
}
