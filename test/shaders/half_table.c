/* The lobes in half precision: all 65,536 inputs for each exponent and order must give a number in
 * [0, 1]. Prints the errors for docs/shaders.md. */
#include "half.h"

#include "support.h"

/* The lobe's exact value at that cosine or lambda, with the slope before rounding. */
static double exact(double lambda, double zeta, int order) {
    const double u = 1.0 - zeta * lambda;
    return u <= 0.0 ? 0.0 : u >= 1.0 ? 1.0 : pow(u, order);
}

typedef struct errors {
    double error;                    /* largest, against the exact lobe of the same cosine */
    double cosine_step, lambda_step; /* largest between neighbouring inputs */
} errors;

static errors measure(double n, int squarings) {
    const int order = 2 << squarings;
    const double zeta = (n + 1.0) / (order + 1);
    const float rounded = half_round((float)zeta);
    errors largest = {0, 0, 0};
    for (uint32_t i = 0; i < 65536; ++i) {
        const float value = half_lobe(half_to_float((uint16_t)i), rounded, squarings);
        CHECK(value >= 0.0f && value <= 1.0f, "order %d, n = %g, input %04x: %g", order, n, i,
              (double)value);
    }
    for (uint16_t i = 0; i < 0x3c00; ++i) { /* the halves from 0 to 1 */
        const float c = half_to_float(i), next = half_to_float((uint16_t)(i + 1));
        const float here = half_lobe(c, rounded, squarings);
        const double error = fabs((double)here - exact(1.0 - (double)c, zeta, order));
        const double cosine_step = fabs((double)(half_lobe(next, rounded, squarings) - here));
        const double lambda_step = fabs((double)(half_lobe_of_lambda(next, rounded, squarings) -
                                                 half_lobe_of_lambda(c, rounded, squarings)));
        largest.error = fmax(largest.error, error);
        largest.cosine_step = fmax(largest.cosine_step, cosine_step);
        largest.lambda_step = fmax(largest.lambda_step, lambda_step);
    }
    return largest;
}

/* A row of the table. */
static void print_row(double n) {
    const errors widest = measure(n, 0);
    printf("| n = %.0f | %.5f |", n, widest.error);
    for (int squarings = 1; squarings < 5; ++squarings) {
        if (n >= 2 << squarings) {
            printf(" %.5f |", measure(n, squarings).error);
        } else {
            printf(" |");
        }
    }
    printf(" %.4f | %.4f |\n", widest.cosine_step, widest.lambda_step);
}

int main(void) {
    printf("| exponent | error, order 2 | 4 | 8 | 16 | 32 | step, of a cosine | of 1 - cosine |\n"
           "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (double n = 2; n <= 4096; n *= 2) {
        print_row(n);
    }
    for (double n = 8192; n <= 65536; n *= 2) { /* only the cosine 1 is bright */
        for (int squarings = 0; squarings < 5; ++squarings) {
            measure(n, squarings);
        }
    }
    if (test_failures) {
        return EXIT_FAILURE;
    }
    return test_checks > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
