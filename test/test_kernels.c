/* The shading kernels: lobes by polynomials against libm, bounds for every float, vectors. */
#include <math.h>
#include <stdint.h>

#include "harness.h"
#include "kernels/kernels.h"
#include "kernels/power.h"

enum { BLOCK = 4096 };

/* What kernels/power.h states. */
#define POWER_ERROR 1e-7
#define GAUSSIAN_ERROR 1e-7

static const float EXPONENTS[] = {1, 2, 3.5f, 8, 18, 32, 100, 256, 1000, 4096, 65536};
enum { EXPONENT_COUNT = sizeof EXPONENTS / sizeof EXPONENTS[0] };

static void check_accuracy(void) {
    double worst_power = 0, worst_gaussian = 0;
    for (int e = 0; e < EXPONENT_COUNT; ++e) {
        double n = EXPONENTS[e];
        for (uint32_t i = 0; i <= 1u << 20; ++i) {
            /* dense near 1, where the lobe lives: lambda from 0 to 40 / n, at most 1 */
            double reach = 40 / n < 1 ? 40 / n : 1;
            float c = (float)(1 - reach * i / (1u << 20));
            double power = c > 0 ? pow((double)c, n) : 0;
            double gaussian = exp(-(n + 0.775) * (1 - (double)c));
            double error = fabs((double)burnish_kernel_power(c, EXPONENTS[e]) - power);
            worst_power = error > worst_power ? error : worst_power;
            error = fabs((double)burnish_kernel_gaussian(c, EXPONENTS[e]) - gaussian);
            worst_gaussian = error > worst_gaussian ? error : worst_gaussian;
        }
    }
    printf("largest absolute error: power %.3g, gaussian %.3g\n", worst_power, worst_gaussian);
    CHECK(worst_power <= POWER_ERROR, "power: %.3g", worst_power);
    CHECK(worst_gaussian <= GAUSSIAN_ERROR, "gaussian: %.3g", worst_gaussian);
    CHECK(burnish_kernel_power(1, 32) == 1, "power is 1 at the peak");
    CHECK(burnish_kernel_gaussian(1, 32) == 1, "gaussian is 1 at the peak");
    CHECK(burnish_kernel_power(0, 1) == 0, "power is 0 at cosine 0");
}

static burnish_lobe_kernel make(burnish_lobe_kernel_kind kind, float exponent) {
    burnish_lobe_kernel kernel = {kind, {0, 2}, exponent};
    burnish_lobe_create(&kernel.family, BURNISH_FIT_ENERGY, 2, exponent);
    return kernel;
}

/* Every lobe kernel gives a finite value in [0, 1] for a stride over all floats, and the same as
 * one element at a time. */
static void check_all_floats(void) {
    float cosines[BLOCK], values[BLOCK], one;
    for (int kind = BURNISH_LOBE_KERNEL_FAMILY; kind <= BURNISH_LOBE_KERNEL_GX; ++kind) {
        for (int e = 0; e < EXPONENT_COUNT; ++e) {
            burnish_lobe_kernel kernel = make((burnish_lobe_kernel_kind)kind, EXPONENTS[e]);
            uint64_t bits = 0;
            int bad = 0, different = 0;
            while (bits <= UINT32_MAX) {
                size_t count = 0;
                for (; count < BLOCK && bits <= UINT32_MAX; ++count, bits += 16411) {
                    cosines[count] = burnish_kernel_from_bits((uint32_t)bits);
                }
                burnish_kernel_lobe(&kernel, count, cosines, values);
                for (size_t i = 0; i < count; ++i) {
                    bad += !(values[i] >= 0 && values[i] <= 1);
                    burnish_kernel_lobe(&kernel, 1, cosines + i, &one);
                    different += memcmp(&one, &values[i], sizeof one) != 0;
                }
            }
            CHECK(bad == 0, "kind %d, exponent %g: %d values outside [0, 1]", kind,
                  (double)EXPONENTS[e], bad);
            CHECK(different == 0, "kind %d, exponent %g: %d values differ alone and in an array",
                  kind, (double)EXPONENTS[e], different);
        }
    }
}

static void check_vectors(void) {
    float x[4] = {3, 0, 1e-10f, -2}, y[4] = {4, 0, 0, 1}, z[4] = {0, 0, 0, 2}, length[4];
    burnish_kernel_normalize(4, x, y, z, length);
    CHECK(x[0] == 0.6f && y[0] == 0.8f && length[0] == 5, "3-4-5: %g %g %g", (double)x[0],
          (double)y[0], (double)length[0]);
    CHECK(x[1] == 0 && y[1] == 0 && z[1] == 0 && length[1] == 0, "no direction stays zero");
    CHECK(fabsf(x[2] - 1) < 1e-6f, "short vectors: %g", (double)x[2]);
    CHECK(length[3] == 3, "length %g", (double)length[3]);
    float one[1] = {0.5f}, v[1] = {0.25f}, l[1] = {0.125f}, out[1];
    burnish_kernel_reflect(1, one, v, l, out);
    CHECK(out[0] == 2 * 0.5f * 0.25f - 0.125f, "R.V %g", (double)out[0]);
}

static void check_accumulate(void) {
    float diffuse[3] = {0.5f, 0.5f, 0.5f}, n_dot_l[3] = {0.5f, 0, -0.5f}, lobe[3] = {0.5f, 1, 1};
    float sum[3] = {0.25f, 0.25f, 0.25f};
    burnish_kernel_accumulate(3, 2, diffuse, 0.5f, n_dot_l, lobe, sum);
    CHECK(sum[0] == 0.25f + 2 * (0.25f + 0.25f), "lit: %g", (double)sum[0]);
    CHECK(sum[1] == 0.25f && sum[2] == 0.25f, "no specular where N.L <= 0");
}

int main(void) {
    check_accuracy();
    check_all_floats();
    check_vectors();
    check_accumulate();
    return test_end("kernels");
}
