/* The common part of caps. */
#include "theory/lights/region.h"

#include <string.h>

#include "theory/internal.h"
#include "theory/lights/vectors.h"

/* The angle between two unit vectors, and the unit vector perpendicular to both, any if they are
 * parallel. */
static double angle_between(const double a[3], const double b[3], double normal[3]) {
    double apart[3], side = vector_dot(a, b) < 0 ? -1 : 1; /* digits: the shorter difference */
    for (int i = 0; i < 3; ++i) {
        apart[i] = b[i] - side * a[i];
    }
    vector_cross(a, apart, normal);
    double sine = sqrt(vector_dot(normal, normal));
    if (sine == 0) {
        double help[3] = {fabs(a[0]) < 0.5, fabs(a[0]) >= 0.5, 0};
        vector_cross(a, help, normal);
    }
    vector_normalize(normal, normal);
    return atan2(sine, vector_dot(a, b));
}

/* The t of the point of a circle nearest to a unit vector; returns the angle from the centre to the
 * vector. */
static double azimuth(const burnish_region_circle *circle, const double vector[3], double *t) {
    double normal[3], angle = angle_between(circle->cap.centre, vector, normal);
    *t = atan2(-vector_dot(normal, circle->x), vector_dot(normal, circle->y));
    return angle;
}

/* Half of the arc of a circle that is inside a cap: the angle opposite to `other` in the triangle
 * with the sides own, away, other, by the tangent of its half. */
static double half_inside(double own, double other, double away) {
    double above = sin(0.5 * (other + away - own)) * sin(0.5 * (own + other - away));
    double below = sin(0.5 * (own + other + away)) * sin(0.5 * (own + away - other));
    return 2 * atan2(sqrt(fmax(0, above)), sqrt(fmax(0, below)));
}

static void add_arc(burnish_region *region, int circle, double start, double end) {
    if (start < end) {
        region->arc[region->arcs].circle = circle;
        region->arc[region->arcs].start = start;
        region->arc[region->arcs++].length = end - start;
    }
}

/* Adds the arcs of a circle that are inside the other caps. */
static void add_circle(burnish_region *region, int index) {
    const burnish_region_circle *circle = &region->circle[index];
    double middle[2] = {0, 0}, half[2] = {BURNISH_PI, BURNISH_PI};
    int others = 0;
    for (int i = 0; i < region->circles; ++i) {
        if (i != index) {
            const burnish_region_cap *cap = &region->circle[i].cap;
            double away = azimuth(circle, cap->centre, &middle[others]);
            half[others++] = half_inside(circle->cap.angle, cap->angle, away);
        }
    }
    double apart = middle[1] - middle[0];
    apart -= 2 * BURNISH_PI * rint(apart / (2 * BURNISH_PI));
    if (others < 2) {
        add_arc(region, index, middle[0] - half[0], middle[0] + half[0]);
        return;
    }
    for (int turn = -1; turn <= 1; ++turn) {
        double second = apart + turn * 2 * BURNISH_PI;
        add_arc(region, index, middle[0] + fmax(-half[0], second - half[1]),
                middle[0] + fmin(half[0], second + half[1]));
    }
}

static void create(burnish_region *region, const burnish_region_cap *caps, int count,
                   const double axis[3]) {
    double normal[3];
    region->circles = region->arcs = 0;
    for (int i = 0; i < count; ++i) {
        int needed = 1;
        for (int j = 0; j < count; ++j) {
            if (j != i) {
                double away = angle_between(caps[i].centre, caps[j].centre, normal);
                double slack = caps[i].angle - caps[j].angle - away;
                needed = needed && (slack < 0 || (slack == 0 && away == 0 && i < j));
                if (away >= caps[i].angle + caps[j].angle) {
                    region->circles = 0;
                    return;
                }
            }
        }
        if (needed) {
            burnish_region_circle *circle = &region->circle[region->circles++];
            circle->cap = caps[i];
            circle->index = i;
            circle->away = angle_between(caps[i].centre, axis, circle->y);
            vector_cross(circle->y, caps[i].centre, circle->x);
        }
    }
    for (int i = 0; i < region->circles; ++i) {
        add_circle(region, i);
    }
}

double burnish_region_sum(const burnish_region_cap *caps, int count, const double axis[3],
                          burnish_region_integral integral, const void *context) {
    burnish_region region;
    burnish_region_cap other[BURNISH_REGION_CAPS + 1];
    for (int i = 0; i < count; ++i) {
        if (caps[i].angle == 0) {
            return 0;
        }
        if (caps[i].angle > 0.5 * BURNISH_PI + 1e-9) {
            memcpy(other, caps, (size_t)count * sizeof *caps);
            other[i].angle = BURNISH_PI - caps[i].angle;
            for (int j = 0; j < 3; ++j) {
                other[i].centre[j] = -caps[i].centre[j];
            }
            double outside = burnish_region_sum(other, count, axis, integral, context);
            memmove(other + i, other + i + 1, (size_t)(count - i - 1) * sizeof *caps);
            return burnish_region_sum(other, count - 1, axis, integral, context) - outside;
        }
    }
    if (count == 0) { /* two hemispheres */
        double sum = 0;
        for (int side = -1; side <= 1; side += 2) {
            other[0] = (burnish_region_cap){{side * axis[0], side * axis[1], side * axis[2]},
                                            0.5 * BURNISH_PI};
            sum += burnish_region_sum(other, 1, axis, integral, context);
        }
        return sum;
    }
    create(&region, caps, count, axis);
    return region.arcs ? integral(&region, context) : 0;
}

int burnish_region_support(double zeta, const double axis[3], burnish_region_cap *cap) {
    if (zeta <= 0.5) {
        return 0;
    }
    memcpy(cap->centre, axis, sizeof cap->centre);
    cap->angle = 2 * asin(sqrt(0.5 / zeta));
    return 1;
}

void burnish_region_point(const burnish_region_circle *circle, double t, double offset[3],
                          double slope[3]) {
    double angle = circle->cap.angle, half = sin(0.5 * angle);
    double x = sin(angle) * cos(t), y = sin(angle) * sin(t);
    for (int i = 0; i < 3; ++i) {
        offset[i] = x * circle->x[i] + y * circle->y[i] - 2 * half * half * circle->cap.centre[i];
        slope[i] = x * circle->y[i] - y * circle->x[i];
    }
}
