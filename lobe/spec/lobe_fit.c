/* From exponent to lobe: slope and peak of every fit. Pictures depend on this, so no libm here.
 *
 * Notation: lambda = 1 - c, u = 1 - zeta lambda, lobe = scale u^m, power = (1 - lambda)^n. */
#include "burnish/lobe_spec.h"

#include "base/elementary.h"

enum { STEPS = 200 }; /* bounds every search; ten or so are taken */

typedef double root_function(double x, const void *context);

/* A zero of f in [low, high], where its signs differ: inverse quadratic interpolation where that
 * is safe, halving elsewhere (Chandrupatla 1997). Stops at a bracket of high * tolerance. */
static double find_root(root_function *f, const void *context, double low, double high,
                        double tolerance) {
    double x1 = high, x2 = low, x3 = low, t = 0.5;
    double f1 = f(x1, context), f2 = f(x2, context), f3 = f2;
    for (int i = 0; i < STEPS; ++i) {
        double x = x1 + t * (x2 - x1), value = f(x, context);
        if ((value > 0) == (f1 > 0)) {
            x3 = x1, f3 = f1;
        } else {
            x3 = x2, f3 = f2;
            x2 = x1, f2 = f1;
        }
        x1 = x, f1 = value;
        double width = x2 > x1 ? x2 - x1 : x1 - x2, least = high * tolerance;
        if (f1 == 0 || width <= 2 * least) {
            break;
        }
        double xi = (x1 - x2) / (x3 - x2), phi = (f1 - f2) / (f3 - f2);
        t = 0.5;
        if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi) {
            t = f1 / (f2 - f1) * (f3 / (f2 - f3)) +
                (x3 - x1) / (x2 - x1) * (f1 / (f3 - f1)) * (f2 / (f3 - f2));
        }
        double margin = least / width;
        t = t > margin ? t : margin;
        t = t < 1 - margin ? t : 1 - margin;
    }
    return x1;
}

/* log(1 + x) with the digits of a small x. Source: Kahan, HP-15C Advanced Functions, 1982. */
static double log_1_plus(double x) {
    double sum = 1 + x;
    return sum == 1 ? x : burnish_log(sum) * (x / (sum - 1));
}

/* (1 - lambda)^n, lambda in [0, 1]. */
static double power_at(double lambda, double n) {
    return lambda < 1 ? 1 + burnish_expm1(n * log_1_plus(-lambda)) : 0;
}

/* u^m at lambda. */
static double family_at(double lambda, double zeta, int order) {
    double u = 1 - zeta * lambda;
    u = u > 0 ? u : 0;
    for (int power = 1; power < order; power *= 2) {
        u *= u;
    }
    return u;
}

/* ---- Least maximum error ---- */

typedef struct family {
    double zeta, scale, exponent;
    int order;
    double log_ratio; /* of the slopes at the peak: log(scale m zeta / n) */
} family;

/* The logarithm of (slope of the lobe / slope of cos^n). Its derivative has at most one zero, so
 * lobe - cos^n has at most two stationary points. */
static double slope_ratio(double lambda, const void *context) {
    const family *f = context;
    return f->log_ratio + (f->order - 1) * log_1_plus(-f->zeta * lambda) -
           (f->exponent - 1) * log_1_plus(-lambda);
}

/* The largest errors of the lobe: above cos^n, and below it except at the peak. */
static void largest_errors(family *f, double *above, double *below) {
    const double end = f->zeta > 1 ? 1 / f->zeta : 1;
    const double limit = end * (1 - 1e-15); /* both slopes may vanish at the very end */
    double turn =
        ((f->exponent - 1) - (f->order - 1) * f->zeta) / (f->zeta * (f->exponent - f->order));
    turn = turn > 0 && turn < limit ? turn : limit;
    const double bounds[3] = {0, turn, limit};
    f->log_ratio = burnish_log(f->scale * f->order * f->zeta / f->exponent);
    double points[4] = {end, 1};
    int count = 2;
    for (int i = 0; i < 2; ++i) {
        double low = bounds[i], high = bounds[i + 1];
        if (low < high && (slope_ratio(low, f) > 0) != (slope_ratio(high, f) > 0)) {
            /* the error is stationary there: 1e-9 off changes it by 1e-18 */
            points[count++] = find_root(slope_ratio, f, low, high, 1e-10);
        }
    }
    *above = *below = 0;
    for (int i = 0; i < count; ++i) {
        double difference =
            f->scale * family_at(points[i], f->zeta, f->order) - power_at(points[i], f->exponent);
        *above = difference > *above ? difference : *above;
        *below = -difference > *below ? -difference : *below;
    }
}

static double imbalance(double zeta, const void *context) {
    family f = *(const family *)context;
    double above, below;
    f.zeta = zeta;
    largest_errors(&f, &above, &below);
    return above - below;
}

/* The zeta at which both errors are equal, for a given peak; zeta m/n is in (0.6, 1.42). */
static double balanced_zeta(int order, double n, double scale, double tolerance) {
    const family f = {0, scale, n, order, 0};
    return find_root(imbalance, &f, 0.5 * n / order, 1.5 * n / order, tolerance);
}

/* How much further the peak lies below 1 than the largest error elsewhere, at its best zeta. */
static double excess_at_peak(double drop, const void *context) {
    family f = *(const family *)context;
    double above, below;
    f.scale = 1 - drop;
    f.zeta = balanced_zeta(f.order, f.exponent, f.scale, 1e-13);
    largest_errors(&f, &above, &below);
    return drop - (above > below ? above : below);
}

/* ---- Least squares ---- */

/* The integral over lambda of (1 - lambda)^n F, F = lambda u^(m-1), by parts: the sum over k of the
 * k-th derivative of F at lambda = 0, by (n+1) ... (n+k+1). At the other end, where u = 0, only the
 * derivatives m - 1 and m differ from 0. */
static double cross_integral(double zeta, int order, double n) {
    const double m = order, cut = 1 - 1 / zeta;
    double product = 1 / ((n + 1) * (n + 2)); /* (-zeta)^(k-1) (m-1)!/(m-k)! / (n+1)...(n+k+1) */
    double sum = product;
    for (int k = 2; k <= order; ++k) {
        product *= -zeta * (m - k + 1) / (n + k + 1);
        sum += k * product;
    }
    if (cut > 0) {
        sum -= product * power_at(1 / zeta, n + m) * ((n + m + 1) / zeta + m * cut);
    }
    return sum;
}

/* Half the derivative of the squared error in -zeta, by m. */
static double squares_slope(double zeta, const void *context) {
    const family *f = context;
    const double m = f->order, w = zeta < 1 ? 1 - zeta : 0;
    double power = 1;
    for (int i = 0; i < 2 * f->order; ++i) {
        power *= w;
    }
    double own = ((1 - power) / (2 * m) - (1 - power * w) / (2 * m + 1)) / (zeta * zeta);
    return own - cross_integral(zeta, f->order, f->exponent);
}

/* ---- All fits ---- */

/* (1 - Q^(1/m)) / (1 - Q^(1/n)); expm1 keeps the digits where the powers are close to 1. */
static double level_zeta(double m, double n, double level) {
    double logarithm = burnish_log(level);
    return burnish_expm1(logarithm / m) / burnish_expm1(logarithm / n);
}

/* The larger root of the quadratic in the header. With a = (m+2)(n+2) its discriminant is
 * a (a - 4 (m+1)), at least m^2 (m+2)^2 for n >= m: nothing cancels. */
static double projected_zeta(double m, double n) {
    double a = (m + 2) * (n + 2);
    return (a + burnish_sqrt(a * (a - 4 * (m + 1)))) / (2 * (m + 1) * (m + 2));
}

static burnish_lobe_status check_fit(const burnish_lobe_spec *lobe, burnish_lobe_fit fit,
                                     double exponent) {
    const int order = lobe->order;
    burnish_lobe_status status = burnish_lobe_check(order, exponent);
    if ((lobe->kind != BURNISH_LOBE_FAMILY && lobe->kind != BURNISH_LOBE_LYON) ||
        (unsigned)fit >= BURNISH_FIT_COUNT) {
        return BURNISH_LOBE_ERROR_FIT;
    }
    if (fit == BURNISH_FIT_LEVEL && !(lobe->parameter > 0 && lobe->parameter < 1)) {
        return BURNISH_LOBE_ERROR_LEVEL;
    }
    if (order != 2 && (fit == BURNISH_FIT_SHIFT7 || fit == BURNISH_FIT_SHIFT3)) {
        return BURNISH_LOBE_ERROR_ORDER;
    }
    if (fit == BURNISH_FIT_GIVEN) {
        if (status != BURNISH_LOBE_OK && status != BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT) {
            return status;
        }
        return lobe->parameter > 0 && lobe->parameter <= (double)BURNISH_LOBE_ZETA_MAX
                   ? BURNISH_LOBE_OK
                   : BURNISH_LOBE_ERROR_ZETA;
    }
    if (status == BURNISH_LOBE_OK && exponent < order &&
        (fit == BURNISH_FIT_PROJECTED || fit == BURNISH_FIT_AFFINE)) {
        return BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT;
    }
    return status;
}

burnish_lobe_status burnish_lobe_solve(const burnish_lobe_spec *lobe, double exponent, double *zeta,
                                       double *scale) {
    const burnish_lobe_fit fit = lobe->kind == BURNISH_LOBE_LYON ? BURNISH_FIT_TAYLOR : lobe->fit;
    const int order = lobe->order;
    const burnish_lobe_status status = check_fit(lobe, fit, exponent);
    *zeta = *scale = 0;
    if (status != BURNISH_LOBE_OK) {
        return status;
    }
    const family unsolved = {0, 1, exponent, order, 0};
    const int searches =
        fit == BURNISH_FIT_MINIMAX || fit == BURNISH_FIT_LEAST_SQUARES || fit == BURNISH_FIT_AFFINE;
    *scale = 1;
    if (searches && exponent == order) { /* cos^n is itself a lobe */
        *zeta = 1;
        return BURNISH_LOBE_OK;
    }
    switch (fit) {
    case BURNISH_FIT_TAYLOR:
        *zeta = exponent / order;
        break;
    case BURNISH_FIT_ENERGY:
        *zeta = (exponent + 1) / (order + 1);
        break;
    case BURNISH_FIT_LEVEL:
        *zeta = level_zeta(order, exponent, lobe->parameter);
        break;
    case BURNISH_FIT_SHIFT7:
        *zeta = exponent * 0.4375;
        break;
    case BURNISH_FIT_SHIFT3:
        *zeta = exponent * 0.375;
        break;
    case BURNISH_FIT_PROJECTED:
        *zeta = projected_zeta(order, exponent);
        break;
    case BURNISH_FIT_MINIMAX:
        *zeta = balanced_zeta(order, exponent, 1, 1e-15);
        break;
    case BURNISH_FIT_LEAST_SQUARES:
        *zeta = find_root(squares_slope, &unsolved, 0.5 * exponent / order, 1.5 * exponent / order,
                          1e-15);
        break;
    case BURNISH_FIT_AFFINE:
        *scale = 1 - find_root(excess_at_peak, &unsolved, 0, 0.1, 1e-13);
        *zeta = balanced_zeta(order, exponent, *scale, 1e-15);
        break;
    case BURNISH_FIT_GIVEN:
        *zeta = lobe->parameter;
        break;
    case BURNISH_FIT_COUNT:
        break;
    }
    return BURNISH_LOBE_OK;
}
