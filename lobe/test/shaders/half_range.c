/* The lobes in half precision: all 65,536 inputs for each exponent and order give a number in
 * [0, 1]. */
#include "half.h"

#include "support.h"

static void check_range(double n, int squarings) {
    const float zeta = half_round((float)((n + 1.0) / ((2 << squarings) + 1)));
    for (uint32_t i = 0; i < 65536; ++i) {
        const float value = half_lobe(half_to_float((uint16_t)i), zeta, squarings);
        CHECK(value >= 0.0f && value <= 1.0f, "order %d, n = %g, input %04x: %g", 2 << squarings, n,
              i, (double)value);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    for (double n = 2; n <= 65536; n *= 2) {
        for (int squarings = 0; squarings < 5; ++squarings) {
            if (squarings == 0 || n >= 2 << squarings) {
                check_range(n, squarings);
            }
        }
    }
    return test_end("half_range");
}
