/* Facts of theory.h. */
#include <math.h>
#include <stddef.h>

#include "base/wasm/module.h"
#include "burnish/theory.h"

WASM_EXPORT(theory_values)
int theory_values(const char *words, double exponent, size_t count, const double *angles,
                  double *values);
WASM_EXPORT(theory_number) double theory_number(const char *words, double exponent, int which);
WASM_EXPORT(theory_convert) double theory_convert(int which, double value);
WASM_EXPORT(lobe_example) const char *lobe_example(size_t index);

/* values[i] = lobe(angles[i]) in double precision. Returns 1, or 0 after an error. */
int theory_values(const char *words, double exponent, size_t count, const double *angles,
                  double *values) {
    burnish_theory_model model;
    if (burnish_theory_model_parse(words, exponent, &model, module_error()) != BURNISH_STATUS_OK) {
        return 0;
    }
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_theory_value_at_angle(&model, angles[i]);
    }
    return 1;
}

/* One fact of a lobe, in the order of lobe.js; NaN after an error or if it is undefined. */
double theory_number(const char *words, double exponent, int which) {
    burnish_theory_model m;
    if (burnish_theory_model_parse(words, exponent, &m, module_error()) != BURNISH_STATUS_OK) {
        return NAN;
    }
    const burnish_theory_cost cost = burnish_theory_model_cost(&m);
    switch (which) {
    case 0:
        return m.zeta;
    case 1:
        return m.scale;
    case 2:
        return burnish_theory_cutoff_cosine(&m);
    case 3:
        return burnish_theory_zero_angle(&m);
    case 4:
        return burnish_theory_angle_at(&m, 0.5);
    case 5:
        return burnish_theory_maximum_error(&m, acos(0.0));
    case 6:
        return burnish_theory_integral(&m, BURNISH_THEORY_SOLID_ANGLE);
    case 7:
        return burnish_theory_integral(&m, BURNISH_THEORY_COSINE_WEIGHTED);
    case 8:
        return cost.multiplications;
    case 9:
        return cost.additions;
    case 10:
        return cost.comparisons;
    case 11:
        return cost.divisions;
    case 12:
        return cost.transcendentals;
    case 13:
        return cost.lookups;
    default:
        return NAN;
    }
}

/* Exponents and roughness, in the order of lobe.js. */
double theory_convert(int which, double value) {
    static double (*const conversions[])(double) = {
        burnish_theory_exponent_from_roughness, burnish_theory_roughness_from_exponent,
        burnish_theory_exponent_from_alpha,     burnish_theory_alpha_from_exponent,
        burnish_theory_phong_from_blinn,        burnish_theory_blinn_from_phong};
    return which >= 0 && (size_t)which < sizeof conversions / sizeof *conversions
               ? conversions[which](value)
               : NAN;
}

/* An example of each kind of lobe, NULL past the last. */
const char *lobe_example(size_t index) {
    return burnish_lobe_spec_example(index);
}
