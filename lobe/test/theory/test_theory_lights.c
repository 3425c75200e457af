/* burnish/theory.h: caps, segments and products of lobes, against quadrature in long double over
 * rings around the axis, and along the segment. */
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

#define PI 3.14159265358979323846264338327950288L
#define VECTOR(v) ((const double(*)[3])(v))
static const double zetas[] = {0.3, 0.5, 0.51, 0.6, 0.8, 1, 1.02, 1.5, 3, 10, 100, 1e4, 65536};
enum { ZETAS = sizeof zetas / sizeof *zetas, KINDS = 7, CAPS = 2, CORNERS = 2, BREAKS = 24 };
static uint64_t random_state;

static double uniform(double low, double high) {
    return test_uniform(&random_state, low, high);
}

static double spread(double low, double high) {
    return exp(uniform(log(low), log(high)));
}

static void random_direction(double direction[3]) {
    double z = uniform(-1, 1), phi = uniform(0, 7);
    direction[0] = sqrt(1 - z * z) * cos(phi);
    direction[1] = sqrt(1 - z * z) * sin(phi);
    direction[2] = z;
}

/* A direction at this angle from another one. */
static void random_beside(const double from[3], double angle, double direction[3]) {
    double side[3], along = 0, length = 0;
    random_direction(side);
    for (int i = 0; i < 3; ++i) {
        along += side[i] * from[i];
    }
    for (int i = 0; i < 3; ++i) {
        side[i] -= along * from[i];
        length += side[i] * side[i];
    }
    for (int i = 0; i < 3; ++i) {
        direction[i] = cos(angle) * from[i] + sin(angle) * side[i] / sqrt(length);
    }
}

/* Orders 1 to 32, composite lobes, and any non-negative coefficients. */
static burnish_theory_polynomial random_lobe(double zeta) {
    burnish_theory_polynomial lobe = {.zeta = zeta, .degree = 2, .coefficients = {0, 0, 1}};
    int kind = (int)uniform(0, 3);
    if (kind == 0) {
        return burnish_theory_polynomial_of_order((int)spread(1, 33), zeta);
    }
    if (kind == 1) { /* w (w + b) / (1 + b), four times at most */
        for (int step = (int)uniform(1, 5); step > 0; --step) {
            double b = uniform(0, 3), square[65] = {0};
            for (int i = 0; i <= lobe.degree; ++i) {
                square[i] += lobe.coefficients[i] * b;
                for (int j = 0; j <= lobe.degree; ++j) {
                    square[i + j] += lobe.coefficients[i] * lobe.coefficients[j];
                }
            }
            for (int i = 0; i <= 2 * lobe.degree; ++i) {
                lobe.coefficients[i] = square[i] / (1 + b);
            }
            lobe.degree *= 2;
        }
        return lobe;
    }
    lobe.degree = (int)uniform(0, 20);
    for (int i = 0; i <= lobe.degree; ++i) {
        lobe.coefficients[i] = uniform(0, 1);
    }
    return lobe;
}

/* ---- Quadrature ---- */

typedef long double real;
typedef real (*integrand)(real x, const void *context);

static real dot(const real a[3], const real b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const real a[3], const real b[3], real c[3]) {
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static void unit(const double *v, real u[3]) {
    real square = 0;
    for (int i = 0; i < 3; ++i) {
        square += (real)v[i] * v[i];
    }
    for (int i = 0; i < 3; ++i) {
        u[i] = v[i] / sqrtl(square);
    }
}

static int compare(const void *a, const void *b) {
    real difference = *(const real *)a - *(const real *)b;
    return (difference > 0) - (difference < 0);
}

/* The integral between the outermost breaks, by tanh-sinh between neighbours. */
static real integrate(integrand f, const void *context, real *breaks, int count) {
    real sum = 0;
    qsort(breaks, (size_t)count, sizeof *breaks, compare);
    for (int i = 1; i < count; ++i) {
        real length = breaks[i] - breaks[i - 1];
        for (int k = -110; k <= 110 && length > 0; ++k) {
            real t = k / 32.0L, e = expl(-PI * sinhl(t)), share = 1 / (1 + e);
            sum += length * PI / 32 * coshl(t) * share * e * share *
                   f(breaks[i - 1] + length * share, context);
        }
    }
    return sum;
}

static real value(const burnish_theory_polynomial *lobe, real lambda) {
    real u = 1 - lobe->zeta * lambda, sum = 0;
    for (int i = lobe->degree; i >= 0; --i) {
        sum = sum * u + lobe->coefficients[i];
    }
    return u > 0 ? sum : 0;
}

/* 1 - c where the lobe ends. */
static real support(double zeta) {
    return zeta > 0.5 ? 2 * asinl(sqrtl(0.5L / zeta)) : PI;
}

/* Caps around the axis of a lobe: at an angle and an azimuth. */
typedef struct {
    const burnish_theory_polynomial *lobe, *other; /* other: around the first cap, or NULL */
    real away[CAPS], radius[CAPS], azimuth[CAPS];
    real ring; /* the angle of the ring that is being integrated */
    int count;
} rings;

static real around_ring(real phi, const void *context) {
    const rings *r = context;
    real near = sinl((r->away[0] - r->ring) / 2), turn = sinl((phi - r->azimuth[0]) / 2);
    return value(r->other, 2 * (near * near + sinl(r->away[0]) * sinl(r->ring) * turn * turn));
}

/* The ring from low to high azimuth, or its length. */
static real piece(rings *r, real low, real high) {
    real breaks[2] = {low, high};
    return low >= high ? 0 : r->other ? integrate(around_ring, r, breaks, 2) : high - low;
}

static real ring(real x, const void *context) {
    rings r = *(const rings *)context;
    real half[CAPS] = {PI, PI}, sum = 0, lambda = 2 * sinl(x / 2) * sinl(x / 2);
    r.ring = x;
    for (int i = 0; i < r.count; ++i) { /* the angle opposite to the radius */
        real a = r.radius[i], b = r.away[i];
        real above = sinl((a + b - x) / 2) * sinl((a - b + x) / 2);
        real below = sinl((a + b + x) / 2) * sinl((b + x - a) / 2);
        half[i] = 2 * atan2l(sqrtl(fmaxl(above, 0)), sqrtl(fmaxl(below, 0)));
    }
    for (int turn = -2; turn <= 2; ++turn) {
        real at = r.azimuth[1] + turn * 2 * PI;
        sum += r.count < 2
                   ? turn == 0 ? piece(&r, r.azimuth[0] - half[0], r.azimuth[0] + half[0]) : 0
                   : piece(&r, fmaxl(r.azimuth[0] - half[0], at - half[1]),
                           fminl(r.azimuth[0] + half[0], at + half[1]));
    }
    return sinl(x) * value(r.lobe, lambda) * sum;
}

/* The angles from the axis to the points that two circles share. */
static int corners(const real axis[3], real (*centres)[3], const real *radius, real *angles) {
    real normal[3], p = dot(centres[0], centres[1]), point[3], aside[3];
    cross(centres[0], centres[1], normal);
    real square = dot(normal, normal);
    real a = (cosl(radius[0]) - p * cosl(radius[1])) / square;
    real b = (cosl(radius[1]) - p * cosl(radius[0])) / square;
    real rest = (1 - a * cosl(radius[0]) - b * cosl(radius[1])) / square;
    for (int side = 0; side < 2 && rest > 0; ++side) {
        for (int i = 0; i < 3; ++i) {
            point[i] =
                a * centres[0][i] + b * centres[1][i] + (side ? 1 : -1) * sqrtl(rest) * normal[i];
        }
        cross(axis, point, aside);
        angles[side] = atan2l(sqrtl(dot(aside, aside)), dot(axis, point));
    }
    return rest > 0 ? 2 : 0;
}

/* The lobe, times `other` around the first cap, over the common part of caps. */
static double by_rings(const burnish_theory_polynomial *lobe,
                       const burnish_theory_polynomial *other, const double axis[3],
                       const double *const *centres, const double *radius) {
    rings r = {.lobe = lobe, .other = other};
    real z[3], x[3], y[3], c[CAPS][3], breaks[BREAKS] = {0, support(lobe->zeta)};
    int count = 2;
    unit(axis, z);
    for (; r.count < CAPS && centres[r.count]; ++r.count) {
        int i = r.count;
        unit(centres[i], c[i]);
        if (i == 0) {
            real help[3] = {fabsl(z[0]) < 0.5L, fabsl(z[0]) >= 0.5L, 0};
            cross(z, help, y);
            real length = sqrtl(dot(y, y));
            for (int j = 0; j < 3; ++j) {
                y[j] /= length;
            }
            cross(y, z, x);
        }
        real across = sqrtl(dot(x, c[i]) * dot(x, c[i]) + dot(y, c[i]) * dot(y, c[i]));
        r.away[i] = atan2l(across, dot(z, c[i]));
        r.azimuth[i] = atan2l(dot(y, c[i]), dot(x, c[i]));
        r.radius[i] = radius[i];
        breaks[count++] = fabsl(r.away[i] - r.radius[i]);
        breaks[count++] = PI - fabsl(PI - (r.away[i] + r.radius[i]));
    }
    count += r.count == 2 ? corners(z, c, r.radius, breaks + count) : 0;
    for (int i = 2; i < count; ++i) {
        breaks[i] = fminl(breaks[i], breaks[1]);
    }
    return (double)integrate(ring, &r, breaks, count);
}

static double whole(const burnish_theory_polynomial *lobe) {
    rings r = {.lobe = lobe};
    real breaks[2] = {0, support(lobe->zeta)};
    return (double)integrate(ring, &r, breaks, 2);
}

/* ---- Caps ---- */

/* Caps that hold the lobe, that it holds, that overlap or touch it, disjoint ones, wide ones, any. */
static void random_cap(const double axis[3], double zeta, double centre[3], double *angle) {
    double rim = (double)support(zeta), away = 0;
    switch ((int)uniform(0, KINDS)) {
    case 0:
        *angle = fmin((double)PI, rim * uniform(1, 3));
        away = uniform(0, *angle - rim);
        break;
    case 1:
        *angle = rim * spread(1e-6, 1);
        away = uniform(0, rim - *angle);
        break;
    case 2:
        *angle = rim * spread(1e-3, 1);
        away = uniform(rim - *angle, rim + *angle);
        break;
    case 3: /* an edge near the axis */
        *angle = uniform(0, (double)PI / 2);
        away = *angle + rim * uniform(-1, 1) * spread(1e-9, 1);
        break;
    case 4:
        *angle = uniform((double)PI / 2, (double)PI);
        away = uniform(fmax(0, *angle - rim), (double)PI);
        break;
    case 5:
        *angle = spread(1e-8, 3);
        away = spread(1e-9, 3);
        break;
    default:
        *angle = uniform(0, (double)PI);
        away = uniform(0, (double)PI);
    }
    random_beside(axis, fabs(away), centre);
}

static void check_caps(void) {
    double worst[2] = {0, 0};
    random_state = test_seed(1);
    for (int i = 0; i < 6000; ++i) {
        double axis[3], centre[3], normal[3], angle[CAPS] = {0, (double)PI / 2};
        burnish_theory_polynomial lobe = random_lobe(zetas[i % ZETAS]);
        random_direction(axis);
        random_cap(axis, lobe.zeta, centre, angle);
        random_beside(centre, (double)PI / 2 + angle[0] * uniform(-1.2, 1.2), normal);
        const double *caps[CAPS] = {centre, i % 3 == 0 ? normal : NULL};
        double got = burnish_theory_cap(&lobe, axis, caps[1], centre, angle[0]);
        double expected = by_rings(&lobe, NULL, axis, caps, angle);
        double error = fabs(got - expected) / whole(&lobe);
        worst[i % 3 == 0] = fmax(worst[i % 3 == 0], error);
        CHECK(error < 1e-12, "case %d, degree %d, zeta %g: %.15g, not %.15g: %.2g", i, lobe.degree,
              lobe.zeta, got, expected, error);
    }
    printf("caps: largest error %.2g of the whole lobe, %.2g cut off\n", worst[0], worst[1]);
}

/* ---- Segments ---- */

typedef struct {
    const burnish_theory_polynomial *lobe;
    real axis[3], foot[3], along[3], distance;
} line;

/* By the angle from the point of the line nearest to the origin. */
static real seen(real angle, const void *context) {
    const line *l = context;
    real chord = 0;
    for (int i = 0; i < 3; ++i) {
        real w = cosl(angle) * l->foot[i] + sinl(angle) * l->along[i] - l->axis[i];
        chord += w * w;
    }
    return value(l->lobe, chord / 2) * cosl(angle) / l->distance;
}

static line line_of(const burnish_theory_polynomial *lobe, const double axis[3],
                    const double ends[2][3], real at[2]) {
    line l = {.lobe = lobe};
    real length = 0;
    unit(axis, l.axis);
    for (int i = 0; i < 3; ++i) {
        l.along[i] = (real)ends[1][i] - ends[0][i];
        length += l.along[i] * l.along[i];
    }
    at[0] = at[1] = 0;
    for (int i = 0; i < 3; ++i) {
        l.along[i] /= sqrtl(length);
        at[0] += l.along[i] * ends[0][i];
        at[1] += l.along[i] * ends[1][i];
    }
    for (int i = 0; i < 3; ++i) {
        l.foot[i] = ends[0][i] - at[0] * l.along[i];
    }
    l.distance = sqrtl(dot(l.foot, l.foot));
    for (int i = 0; i < 3; ++i) {
        l.foot[i] /= l.distance;
    }
    return l;
}

static double by_angles(const burnish_theory_polynomial *lobe, const double axis[3],
                        const double *normal, const double ends[2][3]) {
    real at[2], breaks[8];
    int count = 2;
    line l = line_of(lobe, axis, ends, at);
    if (normal) { /* the height above the horizon is linear along the line */
        real n[3];
        unit(normal, n);
        real rise = dot(n, l.along), meets = -l.distance * dot(n, l.foot) / rise;
        at[rise < 0] = rise < 0 ? fminl(at[1], meets) : fmaxl(at[0], meets);
    }
    real low = breaks[0] = atan2l(at[0], l.distance), high = breaks[1] = atan2l(at[1], l.distance);
    real p = dot(l.axis, l.foot), q = dot(l.axis, l.along), k = sqrtl(p * p + q * q);
    real rim = (1 - 1 / (real)lobe->zeta) / k;
    for (int side = -1; side <= 1 && fabsl(rim) < 1; ++side) {
        real t = atan2l(q, p) + side * acosl(rim);
        for (int turn = -1; turn <= 1; ++turn) {
            if (t + turn * 2 * PI > low && t + turn * 2 * PI < high) {
                breaks[count++] = t + turn * 2 * PI;
            }
        }
    }
    return at[0] < at[1] ? (double)integrate(seen, &l, breaks, count) : 0;
}

/* A segment that starts at a point near the lobe, or runs through it. If both ends are far away, the
 * line's place at the point rests on few of their digits. */
static void random_ends(const double axis[3], double zeta, double ends[2][3]) {
    double point[3], along[3], size = spread(1e-3, 1e3);
    double before = uniform(0, 1) < 0.5 ? uniform(0, 1) : 0;
    double length = spread(1e-6, before > 0 ? 10 : 1e3);
    random_beside(axis, uniform(0, 1.2) * (double)support(zeta), point);
    random_direction(along);
    for (int i = 0; i < 3; ++i) {
        ends[0][i] = size * (point[i] - before * length * along[i]);
        ends[1][i] = ends[0][i] + size * length * along[i];
    }
}

static real across(real angle, const void *lobe) {
    return 2 * value(lobe, 2 * sinl(angle / 2) * sinl(angle / 2));
}

static void check_segments(void) {
    double worst = 0;
    random_state = test_seed(2);
    for (int i = 0; i < 6000; ++i) {
        double axis[3], normal[3], ends[2][3];
        burnish_theory_polynomial lobe = random_lobe(zetas[i % ZETAS]);
        random_direction(axis);
        random_ends(axis, lobe.zeta, ends);
        random_beside(axis, uniform(0, (double)PI / 2 + 0.5), normal);
        double got = burnish_theory_segment(&lobe, axis, i % 3 ? NULL : normal, VECTOR(ends));
        double expected = by_angles(&lobe, axis, i % 3 ? NULL : normal, VECTOR(ends));
        real at[2], breaks[2] = {0, support(lobe.zeta)};
        line l = line_of(&lobe, axis, VECTOR(ends), at);
        double all = (double)(integrate(across, &lobe, breaks, 2) / l.distance);
        double error = fabs(got - expected) / all;
        worst = fmax(worst, error);
        CHECK(error < 1e-12, "case %d, degree %d, zeta %g: %.15g, not %.15g: %.2g", i, lobe.degree,
              lobe.zeta, got, expected, error);
    }
    printf("segments: largest error %.2g of the lobe across its axis\n", worst);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_caps());
    RUN(check_segments());
    return test_end("theory_lights");
}
