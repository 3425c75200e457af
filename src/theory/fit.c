/* From exponent to lobe: the slope of every fit. Pictures depend on this, so no libm here. */
#include "burnish/theory.h"

#include "core/elementary.h"

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

/* What a fit demands beyond burnish_lobe_check. */
static burnish_lobe_status check_fit(burnish_lobe_fit fit, int order, double exponent,
                                     double level) {
    switch (fit) {
    case BURNISH_FIT_TAYLOR:
    case BURNISH_FIT_ENERGY:
        return BURNISH_LOBE_OK;
    case BURNISH_FIT_LEVEL:
        return level > 0 && level < 1 ? BURNISH_LOBE_OK : BURNISH_LOBE_ERROR_LEVEL;
    case BURNISH_FIT_SHIFT7:
    case BURNISH_FIT_SHIFT3:
        return order == 2 ? BURNISH_LOBE_OK : BURNISH_LOBE_ERROR_ORDER;
    case BURNISH_FIT_PROJECTED:
        return exponent < order && burnish_lobe_check(order, exponent) == BURNISH_LOBE_OK
                   ? BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT
                   : BURNISH_LOBE_OK;
    case BURNISH_FIT_COUNT:
        break;
    }
    return BURNISH_LOBE_ERROR_FIT;
}

burnish_lobe_status burnish_theory_zeta(burnish_lobe_fit fit, int order, double exponent,
                                        double level, double *zeta) {
    *zeta = 0;
    burnish_lobe_status status = check_fit(fit, order, exponent, level);
    if (status == BURNISH_LOBE_OK) {
        status = burnish_lobe_check(order, exponent);
    }
    if (status != BURNISH_LOBE_OK) {
        return status;
    }
    switch (fit) {
    case BURNISH_FIT_TAYLOR:
        *zeta = exponent / order;
        break;
    case BURNISH_FIT_ENERGY:
        *zeta = (exponent + 1) / (order + 1);
        break;
    case BURNISH_FIT_LEVEL:
        *zeta = level_zeta(order, exponent, level);
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
    case BURNISH_FIT_COUNT:
        break;
    }
    return BURNISH_LOBE_OK;
}

burnish_lobe_status burnish_theory_lobe(burnish_lobe *lobe, burnish_lobe_fit fit, int order,
                                        double exponent, double level) {
    double zeta;
    burnish_lobe_status status = burnish_theory_zeta(fit, order, exponent, level, &zeta);
    burnish_lobe_status made = burnish_lobe_from_zeta(lobe, (float)zeta, order);
    return status != BURNISH_LOBE_OK ? status : made;
}
