/* Every specular lobe over an array of cosines. */
#include "kernels/kernels.h"
#include "kernels/power.h"

static void family(burnish_lobe lobe, size_t count, const float *cosines, float *values) {
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_lobe_at_cosine(lobe, cosines[i]);
    }
}

static void power(float exponent, size_t count, const float *cosines, float *values) {
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_kernel_power(cosines[i], exponent);
    }
}

static void schlick(float exponent, size_t count, const float *cosines, float *values) {
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_schlick_at_cosine(cosines[i], exponent);
    }
}

static void gaussian(float exponent, size_t count, const float *cosines, float *values) {
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_kernel_gaussian(cosines[i], exponent);
    }
}

static void gx(float exponent, size_t count, const float *cosines, float *values) {
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_gx_at_cosine(cosines[i], exponent);
    }
}

void burnish_kernel_lobe(const burnish_lobe_kernel *lobe, size_t count, const float *cosines,
                         float *values) {
    switch (lobe->kind) {
    case BURNISH_LOBE_KERNEL_FAMILY:
        family(lobe->family, count, cosines, values);
        break;
    case BURNISH_LOBE_KERNEL_POWER:
        power(lobe->exponent, count, cosines, values);
        break;
    case BURNISH_LOBE_KERNEL_SCHLICK:
        schlick(lobe->exponent, count, cosines, values);
        break;
    case BURNISH_LOBE_KERNEL_GAUSSIAN:
        gaussian(lobe->exponent, count, cosines, values);
        break;
    case BURNISH_LOBE_KERNEL_GX:
        gx(lobe->exponent, count, cosines, values);
        break;
    }
}

void burnish_kernel_lobe_lambda(burnish_lobe lobe, size_t count, const float *lambdas,
                                float *values) {
    for (size_t i = 0; i < count; ++i) {
        values[i] = burnish_lobe_at_lambda(lobe, lambdas[i]);
    }
}
