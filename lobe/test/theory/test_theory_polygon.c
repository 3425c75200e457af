/* burnish/theory.h: the light of a polygon, against quadrature in long double along the edges
 * and shapes whose integrals are known. */
#include <math.h>

#include "burnish/theory.h"
#include "support.h"

#define PI 3.14159265358979323846L
enum { CORNERS_MAX = 7 };
static const int orders[] = {1, 2, 4, 8, 16, 32};
static const double zetas[] = {0.5, 0.6, 0.8, 1, 1.02, 1.5, 3, 10, 100, 1e4, 65536};
enum { ORDERS = sizeof orders / sizeof *orders, ZETAS = sizeof zetas / sizeof *zetas };
static uint64_t random_state;

/* The integral of the whole lobe, zeta >= 1/2. */
static double whole(int order, double zeta) {
    return (double)(2 * PI) / (zeta * (order + 1));
}

static double light(int order, double zeta, const double axis[3], double (*corners)[3], int count) {
    return burnish_theory_polygon(order, zeta, axis, NULL, (const double(*)[3])corners, count);
}

static long double dot(const double a[3], const double b[3]) {
    return (long double)a[0] * b[0] + (long double)a[1] * b[1] + (long double)a[2] * b[2];
}

static void random_direction(double direction[3]) {
    double z = test_uniform(&random_state, -1, 1), phi = test_uniform(&random_state, 0, 7);
    direction[0] = sqrt(1 - z * z) * cos(phi);
    direction[1] = sqrt(1 - z * z) * sin(phi);
    direction[2] = z;
}

/* Two vectors that complete a unit vector to a right-handed frame. */
static void frame(const double z[3], double x[3], double y[3]) {
    double help[3] = {fabs(z[0]) < 0.5, fabs(z[0]) >= 0.5, 0}, along = (double)dot(help, z);
    double length = sqrt(1 - along * along);
    for (int i = 0; i < 3; ++i) {
        x[i] = (help[i] - along * z[i]) / length;
    }
    for (int i = 0; i < 3; ++i) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        y[i] = z[j] * x[k] - z[k] * x[j];
    }
}

/* A polygon around a direction, counter-clockwise as seen from the origin: not always convex. */
static int random_polygon(double (*corners)[3]) {
    double middle[3], x[3], y[3], size = exp(test_uniform(&random_state, -5, 1.5)), angle = 0;
    int count = 3 + (int)test_uniform(&random_state, 0, CORNERS_MAX - 2.001);
    random_direction(middle);
    frame(middle, x, y);
    for (int i = 0; i < count; ++i) {
        double radius = size * test_uniform(&random_state, 0.4, 1);
        double distance = exp(test_uniform(&random_state, -1, 1)), s, c;
        angle -= test_uniform(&random_state, 0.6, 1.4) * (double)(2 * PI) / count / 1.4;
        s = radius * sin(angle);
        c = radius * cos(angle);
        for (int j = 0; j < 3; ++j) {
            corners[i][j] = distance * (middle[j] + c * x[j] + s * y[j]);
        }
    }
    return count;
}

/* An axis close to an edge, close to a corner, on a corner, opposite to one, anywhere. */
static void random_axis(double (*corners)[3], int count, double zeta, double axis[3]) {
    int kind = (int)test_uniform(&random_state, 0, 8), i = (int)test_uniform(&random_state, 0, 3);
    double along = kind == 0   ? 0
                   : kind == 1 ? exp(test_uniform(&random_state, -30, 0))
                               : test_uniform(&random_state, 0, 1);
    double width = kind == 0 ? 0 : kind < 6 ? fmin(1, sqrt(2 / zeta)) : 0, off[3];
    width *= kind == 2 ? exp(test_uniform(&random_state, -30, 0)) : 1;
    random_direction(off);
    for (int j = 0; j < 3; ++j) {
        axis[j] = corners[i][j] + along * (corners[(i + 1) % count][j] - corners[i][j]);
    }
    double length = sqrt((double)dot(axis, axis));
    for (int j = 0; j < 3; ++j) {
        axis[j] = kind == 7   ? off[j]
                  : kind == 6 ? -axis[j] / length + 1e-3 * off[j]
                              : axis[j] / length + width * off[j];
    }
}

/* ---- Quadrature ---- */

typedef struct {
    int order;
    long double zeta, a[3], b[3], r[3], angle, d;
} edge;

/* G(c) d(azimuth) / dt, G(c) = (1 - u^(m + 1)) / (zeta (m + 1)). */
static long double form(const edge *e, long double t) {
    long double chord = 0, sine = sinl(e->angle);
    for (int i = 0; i < 3; ++i) {
        long double w = (sinl(e->angle - t) * e->a[i] + sinl(t) * e->b[i]) / sine;
        chord += (w - e->r[i]) * (w - e->r[i]);
    }
    long double lambda = chord / 2, u = 1 - e->zeta * lambda;
    long double grown = u > 0 ? powl(u, e->order + 1) : 0;
    if (e->zeta * lambda < 1e-3L) {
        grown = expm1l((e->order + 1) * log1pl(-e->zeta * lambda)) + 1;
        return -expm1l((e->order + 1) * log1pl(-e->zeta * lambda)) / (e->zeta * (e->order + 1)) *
               e->d / (lambda * (2 - lambda));
    }
    return (1 - grown) / (e->zeta * (e->order + 1)) * e->d / (lambda * (2 - lambda));
}

/* Gauss-Legendre with five points. */
static long double five(const edge *e, long double low, long double high) {
    static const long double nodes[2] = {0.538469310105683091036L, 0.906179845938663992798L};
    static const long double weights[2] = {0.478628670499366468041L, 0.236926885056189087514L};
    long double middle = (low + high) / 2, half = (high - low) / 2;
    long double sum = 0.568888888888888888889L * form(e, middle);
    for (int i = 0; i < 2; ++i) {
        sum += weights[i] * (form(e, middle - half * nodes[i]) + form(e, middle + half * nodes[i]));
    }
    return half * sum;
}

static long double adapt(const edge *e, long double low, long double high, long double value,
                         long double tolerance, int depth) {
    long double middle = (low + high) / 2;
    long double left = five(e, low, middle), right = five(e, middle, high);
    if (depth == 0 || fabsl(left + right - value) < tolerance) {
        return left + right;
    }
    return adapt(e, low, middle, left, tolerance, depth - 1) +
           adapt(e, middle, high, right, tolerance, depth - 1);
}

static void unit(const double *v, long double *result) {
    long double length = sqrtl(dot(v, v));
    for (int i = 0; i < 3; ++i) {
        result[i] = v[i] / length;
    }
}

/* In pieces that end at the point nearest to the axis and where the lobe ends. */
static long double along_edge(const edge *e, long double ca, long double cb) {
    long double nearest = atan2l(cb - ca * cosl(e->angle), ca * sinl(e->angle));
    long double k = sqrtl(1 - e->d * e->d), cutoff = (1 - 1 / e->zeta) / k;
    long double limit = fabsl(cutoff) < 1 ? acosl(cutoff) : 0, at = 0, sum = 0;
    for (int i = 0; at < e->angle; ++i) {
        long double next = i < 3 ? nearest + (i - 1) * limit : e->angle;
        next = fminl(fmaxl(next, at), e->angle);
        sum += adapt(e, at, next, five(e, at, next), 1e-16L / e->zeta, 50);
        at = next;
    }
    return sum;
}

/* The integral along the edges; the opposite of the axis must be outside. */
static double by_quadrature(int order, double zeta, const double axis[3], double (*corners)[3],
                            int count) {
    long double sum = 0;
    for (int i = 0; i < count; ++i) {
        edge e = {.order = order, .zeta = zeta};
        long double normal[3], sine = 0, cosine = 0, ca = 0, cb = 0;
        unit(corners[i], e.a);
        unit(corners[(i + 1) % count], e.b);
        unit(axis, e.r);
        for (int j = 0; j < 3; ++j) {
            int k = (j + 1) % 3, l = (j + 2) % 3;
            normal[j] = e.a[k] * (e.b[l] - e.a[l]) - e.a[l] * (e.b[k] - e.a[k]);
            sine += normal[j] * normal[j];
            cosine += e.a[j] * e.b[j];
            ca += e.r[j] * e.a[j];
            cb += e.r[j] * e.b[j];
        }
        e.angle = atan2l(sqrtl(sine), cosine);
        for (int j = 0; j < 3; ++j) {
            e.d += normal[j] / sqrtl(sine) * e.r[j];
        }
        sum += e.d != 0 ? along_edge(&e, ca, cb) : 0;
    }
    return (double)-sum;
}

/* The opposite of the axis is not in a polygon that is not behind it. */
static int is_ahead(const double axis[3], double (*corners)[3], int count) {
    int ahead = 1;
    for (int i = 0; i < count; ++i) {
        ahead = ahead && dot(axis, corners[i]) >= 0;
    }
    return ahead;
}

static void check_quadrature(void) {
    double corners[CORNERS_MAX][3], axis[3], worst = 0;
    random_state = test_seed(1);
    for (int i = 0, tried = 0; tried < 3000; ++i) {
        int order = orders[i % ORDERS], count = random_polygon(corners);
        double zeta = zetas[(i / ORDERS) % ZETAS];
        random_axis(corners, count, zeta, axis);
        if (is_ahead(axis, corners, count)) {
            double value = light(order, zeta, axis, corners, count);
            double expected = by_quadrature(order, zeta, axis, corners, count);
            double error = fabs(value - expected) / whole(order, zeta);
            worst = fmax(worst, error);
            CHECK(error < 1e-12, "case %d, order %d, zeta %g: %.15g, not %.15g: %.2g", i, order,
                  zeta, value, expected, error);
            ++tried;
        }
    }
    printf("largest error %.2g of the whole lobe\n", worst);
}

/* ---- Shapes that are known ---- */

#define NEAR(value, expected, whole)                                                               \
    CHECK(fabs((value) - (expected)) < 1e-12 * (whole), "order %d, zeta %g: %.15g, not %.15g",     \
          order, zeta, (double)(value), (double)(expected))

static void check_shapes_of(int order, double zeta) {
    double all = whole(order, zeta), cut = 1 - pow(fmax(0, 1 - zeta), order + 1), sum = 0, axis[3];
    double z[3] = {0, 0, 1};
    random_direction(axis);
    for (int i = 0; i < 8; ++i) { /* the eight octants are the sphere */
        double sx = i & 1 ? -1 : 1, sy = i & 2 ? -2 : 2, sz = i & 4 ? -3 : 3;
        double octant[3][3] = {{sx, 0, 0}, {0, 0, sz}, {0, sy, 0}};
        double turned[3][3] = {{sx, 0, 0}, {0, sy, 0}, {0, 0, sz}};
        int odd = (i & 1) ^ (i >> 1 & 1) ^ (i >> 2 & 1);
        sum += light(order, zeta, axis, odd ? turned : octant, 3);
        NEAR(light(order, zeta, z, odd ? turned : octant, 3), all / 4 * (i & 4 ? 1 - cut : cut),
             all);
    }
    NEAR(sum, all, all);
    for (int i = 1; i < 6; ++i) { /* a slice of the hemisphere around the axis */
        double slice[3][3] = {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}};
        slice[1][0] = cos(0.5 * i);
        slice[1][1] = sin(0.5 * i);
        NEAR(light(order, zeta, z, slice, 3), all * cut * 0.5 * i / (double)(2 * PI), all);
    }
}

static void check_shapes(void) {
    random_state = test_seed(3);
    for (int i = 0; i < ORDERS * ZETAS; ++i) {
        check_shapes_of(orders[i % ORDERS], zetas[i / ORDERS]);
    }
}

/* ---- Identities, at every axis ---- */

static void rotate(double (*vectors)[3], int count, double angle) {
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < 3; ++j) {
            double *p = &vectors[i][j], *q = &vectors[i][(j + 1) % 3], x = *p, y = *q;
            *p = x * cos(angle) - y * sin(angle);
            *q = x * sin(angle) + y * cos(angle);
        }
    }
}

static double clipped(int order, double zeta, const double axis[3], const double normal[3],
                      double (*corners)[3], int count) {
    return burnish_theory_polygon(order, zeta, axis, normal, (const double(*)[3])corners, count);
}

static void check_identities(void) {
    double corners[CORNERS_MAX + 1][3], axis[3], normal[3], other[3];
    random_state = test_seed(5);
    for (int i = 0; i < 3000; ++i) {
        int order = orders[i % ORDERS], count = random_polygon(corners);
        double zeta = zetas[(i / ORDERS) % ZETAS], all = whole(order, zeta);
        random_axis(corners, count, zeta, axis);
        double value = light(order, zeta, axis, corners, count);
        CHECK(value > -all && value < all * (1 + 1e-12), "case %d: %g of %g", i, value, all);

        double sum = 0; /* a fan of triangles */
        for (int k = 1; k + 1 < count; ++k) {
            double triangle[3][3];
            memcpy(triangle[0], corners[0], sizeof *corners);
            memcpy(triangle[1], corners[k], 2 * sizeof *corners);
            sum += light(order, zeta, axis, triangle, 3);
        }
        NEAR(sum, value, all);

        random_direction(normal); /* above and below a horizon */
        for (int j = 0; j < 3; ++j) {
            other[j] = -7 * normal[j];
        }
        NEAR(clipped(order, zeta, axis, normal, corners, count) +
                 clipped(order, zeta, axis, other, corners, count),
             value, all);

        double backwards[CORNERS_MAX][3];
        for (int k = 0; k < count; ++k) {
            memcpy(backwards[k], corners[count - 1 - k], sizeof *corners);
        }
        NEAR(light(order, zeta, axis, backwards, count), -value, all);

        memcpy(corners[count], corners[count - 1], sizeof *corners); /* a corner twice */
        NEAR(light(order, zeta, axis, corners, count + 1), value, all);
        rotate(corners, count, 0.7); /* rounded: the axis moves by 1e-16 of a narrow lobe */
        rotate(&axis, 1, 0.7);
        CHECK(fabs(light(order, zeta, axis, corners, count) - value) <
                  1e-12 * all * (1 + sqrt(zeta) / 10),
              "case %d: turned", i);
    }
}

/* Twice one power and three times another are a polynomial. */
static void check_polynomials(void) {
    double corners[CORNERS_MAX][3], axis[3];
    random_state = test_seed(7);
    for (int i = 0; i < 500; ++i) {
        int count = random_polygon(corners), order = 1 + i % 23;
        double zeta = zetas[i % ZETAS];
        const double(*c)[3] = (const double(*)[3])corners;
        burnish_theory_powers lobe = burnish_theory_powers_of_order(order + 9, zeta);
        random_axis(corners, count, zeta, axis);
        lobe.coefficients[order] = 2;
        lobe.coefficients[order + 9] = 3;
        double sum = 2 * burnish_theory_polygon(order, zeta, axis, NULL, c, count) +
                     3 * burnish_theory_polygon(order + 9, zeta, axis, NULL, c, count);
        double value = burnish_theory_polygon_polynomial(&lobe, axis, NULL, c, count);
        NEAR(value, sum, whole(order, zeta));
    }
}

static void check_bad_input(void) {
    double good[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, axis[3] = {1, 1, 1};
    double bad[][3] = {{0, 0, 0}, {NAN, 0, 1}, {INFINITY, 0, 0}};
    CHECK1(light(2, 1, axis, good, 0) == 0 && light(2, 1, axis, good, 2) == 0);
    CHECK1(isnan(light(0, 1, axis, good, 3)) && isnan(light(33, 1, axis, good, 3)));
    CHECK1(isnan(light(2, 0, axis, good, 3)) && isnan(light(2, NAN, axis, good, 3)));
    for (int i = 0; i < 3; ++i) {
        double corners[3][3];
        memcpy(corners, good, sizeof corners);
        memcpy(corners[1], bad[i], sizeof *corners);
        CHECK1(isnan(light(2, 1, bad[i], good, 3)) && isnan(light(2, 1, axis, corners, 3)));
        CHECK1(isnan(clipped(2, 1, axis, bad[i], good, 3)));
    }
    double line[3][3] = {{1, 0, 0}, {1, 1, 0}, {1, 2, 0}}, huge[3][3];
    CHECK1(fabs(light(2, 1, axis, line, 3)) < 1e-15);
    for (int i = 0; i < 9; ++i) {
        huge[i / 3][i % 3] = good[i / 3][i % 3] * (i < 3 ? 1e300 : 1e-300);
    }
    CHECK1(fabs(light(2, 1, axis, huge, 3) - light(2, 1, axis, good, 3)) < 1e-15);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_quadrature());
    RUN(check_shapes());
    RUN(check_identities());
    RUN(check_polynomials());
    RUN(check_bad_input());
    return test_end("theory_polygon");
}
