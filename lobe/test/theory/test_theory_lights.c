/* burnish/theory.h: the light of caps, against quadrature in long double over rings around the axis. */
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

#define PI 3.14159265358979323846264338327950288L
static const double zetas[] = {0.3, 0.5, 0.51, 0.6, 0.8, 1, 1.02, 1.5, 3, 10, 100, 1e4, 65536};
enum { ZETAS = sizeof zetas / sizeof *zetas, CAPS = 2, BREAKS = 24 };
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

/* An order, or any non-negative coefficients. */
static burnish_theory_powers random_lobe(double zeta) {
    burnish_theory_powers lobe = burnish_theory_powers_of_order((int)spread(1, 40), zeta);
    for (int i = 0, any = uniform(0, 1) < 0.5; i <= lobe.degree && any; ++i) {
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
        for (int k = -70; k <= 70 && length > 0; ++k) {
            real t = k / 20.0L, e = expl(-PI * sinhl(t)), share = 1 / (1 + e);
            sum += length * PI / 20 * coshl(t) * share * e * share *
                   f(breaks[i - 1] + length * share, context);
        }
    }
    return sum;
}

static real value(const burnish_theory_powers *lobe, real lambda) {
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

/* Caps at angles from the axis of a lobe; the second one is at an azimuth from the first. */
typedef struct {
    const burnish_theory_powers *lobe;
    real away[CAPS], radius[CAPS], azimuth;
    int count;
} rings;

static real ring(real x, const void *context) {
    const rings *r = context;
    real half[CAPS] = {PI, PI}, sum = 0;
    for (int i = 0; i < r->count; ++i) { /* the angle opposite to the radius */
        real a = r->radius[i], b = r->away[i];
        real above = sinl((a + b - x) / 2) * sinl((a - b + x) / 2);
        real below = sinl((a + b + x) / 2) * sinl((b + x - a) / 2);
        half[i] = 2 * atan2l(sqrtl(fmaxl(above, 0)), sqrtl(fmaxl(below, 0)));
    }
    for (int turn = -1; turn <= 1; ++turn) {
        real at = r->azimuth + turn * 2 * PI;
        sum += fmaxl(0, fminl(half[0], at + half[1]) - fmaxl(-half[0], at - half[1]));
    }
    return sinl(x) * value(r->lobe, 2 * sinl(x / 2) * sinl(x / 2)) * sum;
}

/* The angles from the axis to the points that two circles share. */
static int corners(const real axis[3], real (*centres)[3], const real *radius, real *angles) {
    real normal[3], p = dot(centres[0], centres[1]), point[3], aside[3];
    cross(centres[0], centres[1], normal);
    real square = dot(normal, normal), c[2] = {cosl(radius[0]), cosl(radius[1])};
    real a = (c[0] - p * c[1]) / square, b = (c[1] - p * c[0]) / square;
    real rest = (1 - a * c[0] - b * c[1]) / square;
    for (int side = -1; side <= 1 && rest > 0; side += 2) {
        for (int i = 0; i < 3; ++i) {
            point[i] = a * centres[0][i] + b * centres[1][i] + side * sqrtl(rest) * normal[i];
        }
        cross(axis, point, aside);
        *angles++ = atan2l(sqrtl(dot(aside, aside)), dot(axis, point));
    }
    return rest > 0 ? 2 : 0;
}

/* The lobe over the common part of caps. */
static double by_rings(const burnish_theory_powers *lobe, const double axis[3],
                       const double *const *centres, const double *radius) {
    rings r = {.lobe = lobe};
    real z[3], c[CAPS][3], aside[3], breaks[BREAKS] = {0, support(lobe->zeta)};
    int count = 2;
    unit(axis, z);
    for (int i = 0; i < CAPS && centres[i]; ++i, ++r.count) {
        unit(centres[i], c[i]);
        cross(z, c[i], aside);
        r.away[i] = atan2l(sqrtl(dot(aside, aside)), dot(z, c[i]));
        r.azimuth =
            i == 0 ? 0 : atan2l(-dot(aside, c[0]), dot(c[0], c[1]) - dot(z, c[0]) * dot(z, c[1]));
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

static double whole(const burnish_theory_powers *lobe) {
    rings r = {.lobe = lobe};
    real breaks[2] = {0, support(lobe->zeta)};
    return (double)integrate(ring, &r, breaks, 2);
}

/* ---- Caps ---- */

/* Caps of any size, and of the lobe's; around it, inside, across its rim, and disjoint. Returns 1
 * for caps well within the lobe. */
static int random_cap(const double axis[3], double zeta, double centre[3], double *angle) {
    double rim = (double)support(zeta), kind = uniform(0, 4), away;
    *angle = kind < 1 ? uniform(0, (double)PI) : fmin(spread(1e-7, 3) * rim, (double)PI);
    away = kind < 2   ? uniform(0, 1.05) * (*angle + rim)
           : kind < 3 ? fabs(*angle + rim * uniform(-1, 1) * spread(1e-9, 1))
                      : uniform(0, 0.5) * rim;
    random_beside(axis, fmin(away, (double)PI), centre);
    return kind >= 3 && *angle < 0.5 * rim;
}

static void check_caps(void) {
    double worst[2] = {0, 0};
    random_state = test_seed(1);
    for (int i = 0; i < 2000; ++i) {
        double axis[3], centre[3], normal[3], angle[CAPS] = {0, (double)PI / 2};
        burnish_theory_powers lobe = random_lobe(zetas[i % ZETAS]);
        random_direction(axis);
        int within = random_cap(axis, lobe.zeta, centre, angle) && i % 3;
        random_beside(centre, (double)PI / 2 + angle[0] * uniform(-1.2, 1.2), normal);
        const double *caps[CAPS] = {centre, i % 3 ? NULL : normal};
        double got = burnish_theory_cap(&lobe, axis, caps[1], centre, angle[0]);
        double expected = by_rings(&lobe, axis, caps, angle);
        double error = fabs(got - expected) / (within ? expected : whole(&lobe));
        worst[within] = fmax(worst[within], error);
        CHECK(error < 1e-12, "case %d, degree %d, zeta %g: %.15g, not %.15g: %.2g", i, lobe.degree,
              lobe.zeta, got, expected, error);
    }
    printf("caps: largest error %.2g of the whole lobe, %.2g of the cap in the lobe\n", worst[0],
           worst[1]);
}

static void check_bad_input(void) {
    const burnish_theory_powers good = burnish_theory_powers_of_order(2, 1);
    const double z[3] = {0, 0, 1};
    const double vectors[3][3] = {{0, 0, 0}, {NAN, 0, 1}, {INFINITY, 0, 0}};
    burnish_theory_powers lobes[5] = {{.zeta = 0}, {.zeta = NAN}, {1, -1, {0}}};
    lobes[3] = burnish_theory_powers_of_order(BURNISH_THEORY_POWERS_MAX + 1, 1);
    lobes[4] = good;
    lobes[4].coefficients[1] = INFINITY;
    for (int i = 0; i < 5; ++i) {
        CHECK1(isnan(burnish_theory_cap(&lobes[i], z, NULL, z, 1)));
    }
    for (int i = 0; i < 3; ++i) {
        CHECK1(isnan(burnish_theory_cap(&good, vectors[i], NULL, z, 1)));
        CHECK1(isnan(burnish_theory_cap(&good, z, vectors[i], z, 1)));
        CHECK1(isnan(burnish_theory_cap(&good, z, NULL, z, vectors[i][0] - 1)));
    }
    CHECK1(burnish_theory_cap(&good, z, NULL, z, 0) == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_caps());
    RUN(check_bad_input());
    return test_end("theory_lights");
}
