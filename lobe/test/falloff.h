/* Sweeps of burnish_exp_falloff3 ... against e^-x in double: test_lobe takes strides, sweep_lobe
 * every float. */
#ifndef BURNISH_TEST_FALLOFF_H
#define BURNISH_TEST_FALLOFF_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "burnish/lobe.h"
#include "support.h"

/* The bounds are those in lobe.h: of the absolute error, and of the relative error up to x = 1, 2
 * and 3. */
typedef struct {
    float (*of)(float);
    float end;
    double absolute, relative[3];
} falloff_case;

static const falloff_case falloff_cases[] = {
    {burnish_exp_falloff3, BURNISH_EXP_FALLOFF_END3, 0.029374, {0.0540, 0.158, 0.577}},
    {burnish_exp_falloff4, BURNISH_EXP_FALLOFF_END4, 0.005173, {0.0088, 0.0276, 0.104}},
    {burnish_exp_falloff5, BURNISH_EXP_FALLOFF_END5, 0.000136, {0.00023, 0.00067, 0.0017}},
};
enum { FALLOFF_CASE_COUNT = sizeof falloff_cases / sizeof falloff_cases[0] };

/* 1 if the values at every stride-th float from 2^-32, below which they are 1, to END are in (0,
 * 1], never increase and keep the bounds. Prints the errors. */
static inline int falloff_keeps(const falloff_case *at, uint64_t stride) {
    double absolute = 0, relative[3] = {0};
    float last = 0;
    uint32_t bits;
    int good = at->of(0x1p-32f) == 1;
    memcpy(&bits, &at->end, sizeof bits);
    for (uint64_t from = bits; from >= 0x2f800000u + stride;) { /* down to 2^-32 */
        from -= stride;
        const float x = test_float_of_bits((uint32_t)from), value = at->of(x);
        const double exact = exp(-(double)x), error = fabs((double)value - exact);
        good &= value > 0 && value >= last && value <= 1;
        last = value;
        absolute = fmax(absolute, error);
        for (int i = 0; i < 3; ++i) {
            relative[i] = x <= (float)(i + 1) ? fmax(relative[i], error / exact) : relative[i];
        }
    }
    printf("e^-x to %-10.9g error %.6f, relative %.5f, %.5f, %.5f\n", (double)at->end, absolute,
           relative[0], relative[1], relative[2]);
    for (int i = 0; i < 3; ++i) {
        good &= relative[i] <= at->relative[i];
    }
    return good && absolute <= at->absolute;
}

#endif
