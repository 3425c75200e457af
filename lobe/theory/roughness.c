/* Exponents, roughness and averaged normals. */
#include <math.h>

#include "theory/internal.h"

double burnish_theory_exponent_from_alpha(double alpha) {
    return 2 / (alpha * alpha) - 2;
}

double burnish_theory_alpha_from_exponent(double exponent) {
    return sqrt(2 / (exponent + 2));
}

double burnish_theory_exponent_from_roughness(double roughness) {
    return burnish_theory_exponent_from_alpha(roughness * roughness);
}

double burnish_theory_roughness_from_exponent(double exponent) {
    return sqrt(burnish_theory_alpha_from_exponent(exponent));
}

double burnish_theory_phong_from_blinn(double exponent) {
    return 0.25 * exponent;
}

double burnish_theory_blinn_from_phong(double exponent) {
    return 4 * exponent;
}

double burnish_theory_toksvig_exponent(double exponent, double length) {
    double l = length > 0 ? length : 0;
    l = l < 1 ? l : 1;
    return l > 0 ? exponent * l / (l + exponent * (1 - l)) : 0;
}
