/* Exact values of the lobes in double precision. Uses libm, so no image may depend on it. */
#include <math.h>

#include "base/arithmetic.h"
#include "theory/internal.h"

double burnish_theory_family(double zeta, int order, double cosine) {
    if (!burnish_lobe_order_is_valid(order)) {
        return 0;
    }
    double value = saturate(1 - zeta * (1 - cosine));
    for (int power = 1; power < order; power *= 2) {
        value *= value;
    }
    return value;
}

double burnish_theory_power(double cosine, double exponent) {
    double c = saturate(cosine);
    return c > 0 && exponent >= 0 ? saturate(pow(c, exponent)) : 0; /* pow(1, NaN) is 1 */
}

double burnish_theory_schlick(double cosine, double exponent) {
    double c = saturate(cosine);
    return saturate(c / (c + exponent * (1 - c)));
}
