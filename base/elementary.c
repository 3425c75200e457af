/* Elementary functions by argument reduction and Taylor series. The constants are the leading bits
 * of pi/2, ln 2 and atan(k/8); the forms that keep the rounding errors small (two-part arguments,
 * f - (f*f/2 - ...)) are from the classic libm literature (Cody and Waite 1980; Ng 1992). */
#include "base/elementary.h"

#include <stdint.h>
#include <string.h>

static const double infinity = __builtin_inf();
static const double not_a_number = __builtin_nan("");

/* Valid with -fno-math-errno only: the compiler then emits the instruction, never a call. */
double burnish_sqrt(double x) {
    return __builtin_sqrt(x);
}
float burnish_sqrtf(float x) {
    return __builtin_sqrtf(x);
}

/* Sum of the polynomial c[0] + c[1] x + ... by Horner's rule. */
static inline double polynomial(const double *c, int count, double x) {
    double sum = c[count - 1];
    for (int i = count - 2; i >= 0; --i) {
        sum = sum * x + c[i];
    }
    return sum;
}

/* 2^exponent for exponent in [-1022, 1023]. */
static double power_of_two(int exponent) {
    uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* x - y = *high + *low exactly (Knuth's two-sum). */
static void subtract_exactly(double x, double y, double *high, double *low) {
    double difference = x - y;
    double x_part = difference + y;
    double y_part = x_part - difference;
    *high = difference;
    *low = (x - x_part) + (y_part - y);
}

/* x = quadrant * pi/2 + *high + *low, abs(*high) <= pi/4 and a little. pi/2 in parts of 33 bits
 * makes every product with a quadrant below 2^20 exact; the four parts together hold 152 bits. */
static int reduce_by_half_pi(double x, double *high, double *low) {
    double quadrant = (double)(int)(x * 0x1.45f306dc9c883p-1 + (x < 0 ? -0.5 : 0.5));
    double low2, low3, sum;
    double rest = x - quadrant * 0x1.921fb544p+0;
    subtract_exactly(rest, quadrant * 0x1.0b4611a6p-34, &rest, &low2);
    subtract_exactly(rest, quadrant * 0x1.3198a2ep-69, &rest, &low3);
    low2 = low2 + (low3 - quadrant * 0x1.b839a252049c1p-104);
    sum = rest + low2;
    *high = sum;
    *low = (rest - sum) + low2;
    return (int)quadrant;
}

/* sin(x + y) for abs(x) <= pi/4 and a y below the last bit of x; series to x^17. */
static double sine_kernel(double x, double y) {
    static const double c[] = {
        -1 / 6.0,        1 / 120.0,        -1 / 5040.0,          1 / 362880.0,
        -1 / 39916800.0, 1 / 6227020800.0, -1 / 1307674368000.0, 1 / 355687428096000.0};
    double z = x * x;
    return x + (z * x * polynomial(c, 8, z) + y * (1 - 0.5 * z));
}

/* cos(x + y) likewise; series to x^18. */
static double cosine_kernel(double x, double y) {
    static const double c[] = {
        1 / 24.0,        -1 / 720.0,         1 / 40320.0,          -1 / 3628800.0,
        1 / 479001600.0, -1 / 87178291200.0, 1 / 20922789888000.0, -1 / 6402373705728000.0};
    double z = x * x;
    double half = 0.5 * z;
    double head = 1 - half;
    return head + (((1 - head) - half) + (z * z * polynomial(c, 8, z) - x * y));
}

void burnish_sincos(double x, double *sine, double *cosine) {
    if (!(x >= -1e6 && x <= 1e6)) {
        *sine = *cosine = not_a_number;
        return;
    }
    double high, low;
    int quadrant = reduce_by_half_pi(x, &high, &low);
    double s = high == 0 ? x : sine_kernel(high, low); /* keeps the sign of zero */
    double c = cosine_kernel(high, low);
    switch (quadrant & 3) {
    case 0:
        *sine = s, *cosine = c;
        break;
    case 1:
        *sine = c, *cosine = -s;
        break;
    case 2:
        *sine = -s, *cosine = -c;
        break;
    default:
        *sine = -c, *cosine = s;
        break;
    }
}

/* k/8 and atan(k/8) in two parts; near 0 the series alone serves. */
static const double arctangents[9][3] = {{0, 0, 0},
                                         {0, 0, 0},
                                         {0.25, 0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                         {0.375, 0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                         {0.5, 0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                         {0.625, 0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                         {0.75, 0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                         {0.875, 0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                         {1, 0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
/* atan(t) = t + t^3 (c[0] + c[1] t^2 + ...) */
static const double arctangent_series[11] = {-1 / 3.0,  1 / 5.0,  -1 / 7.0,  1 / 9.0,
                                             -1 / 11.0, 1 / 13.0, -1 / 15.0, 1 / 17.0,
                                             -1 / 19.0, 1 / 21.0, -1 / 23.0};
static const double half_pi[2] = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/* atan(q) = *high + *low for q in [0, 1]: the difference to the nearest atan(k/8), by its series.
 */
static void arctangent_kernel(double q, double *high, double *low) {
    const double *row = arctangents[(int)(q * 8 + 0.5)];
    double t = (q - row[0]) / (1 + q * row[0]);
    double tail = t * (t * t * polynomial(arctangent_series, 11, t * t));
    if (row[0] == 0) {
        *high = t, *low = tail;
    } else {
        *high = row[1], *low = t + (tail + row[2]);
    }
}

double burnish_atan2(double y, double x) {
    if (x != x || y != y) {
        return not_a_number;
    }
    double width = x < 0 ? -x : x;
    double height = y < 0 ? -y : y;
    if (width == 0 && height == 0) {
        return 0;
    }
    if (width == infinity && height == infinity) {
        width = height = 1;
    }
    double high, low, angle;
    int steep = height > width;
    arctangent_kernel(steep ? width / height : height / width, &high, &low);
    if (steep && x < 0) { /* pi/2 + a */
        angle = half_pi[0] + (high + (low + half_pi[1]));
    } else if (steep) { /* pi/2 - a */
        angle = half_pi[0] - (high + (low - half_pi[1]));
    } else if (x < 0) { /* pi - a */
        angle = 2 * half_pi[0] - (high + (low - 2 * half_pi[1]));
    } else {
        angle = high + low;
    }
    return y < 0 ? -angle : angle;
}

double burnish_acos(double x) {
    x = x > 1 ? 1 : (x < -1 ? -1 : x);
    return burnish_atan2(burnish_sqrt((1 - x) * (1 + x)), x);
}

double burnish_log(double x) {
    /* 2/3, 2/5, ...: log((1 + s)/(1 - s)) = 2s + (2/3) s^3 + (2/5) s^5 + ..., abs(s) <= 0.1716. */
    static const double c[] = {2 / 3.0,  2 / 5.0,  2 / 7.0,  2 / 9.0,  2 / 11.0,
                               2 / 13.0, 2 / 15.0, 2 / 17.0, 2 / 19.0, 2 / 21.0};
    int exponent = 0;
    if (!(x > 0) || x == infinity) {
        return x == 0 ? -infinity : (x > 0 ? x : not_a_number);
    }
    if (x < 0x1p-1022) {
        x *= 0x1p+54;
        exponent = -54;
    }
    /* x = 2^exponent (1 + f) with 1 + f in [sqrt(1/2), sqrt(2)). */
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    exponent += (int)(bits >> 52) - 1023;
    bits = (bits & 0xfffffffffffffu) | 0x3ff0000000000000u;
    memcpy(&x, &bits, sizeof x);
    if (x > 0x1.6a09e667f3bcdp+0) {
        x *= 0.5;
        ++exponent;
    }
    double f = x - 1;
    double s = f / (2 + f);
    double rest = s * s * polynomial(c, 10, s * s);
    double half = 0.5 * f * f;
    return exponent * 0x1.62e42feep-1 -
           ((half - (s * (half + rest) + exponent * 0x1.a39ef35793c76p-33)) - f);
}

double burnish_expm1(double x) {
    static const double c[] = {1 / 2.0,          1 / 6.0,        1 / 24.0,        1 / 120.0,
                               1 / 720.0,        1 / 5040.0,     1 / 40320.0,     1 / 362880.0,
                               1 / 3628800.0,    1 / 39916800.0, 1 / 479001600.0, 1 / 6227020800.0,
                               1 / 87178291200.0};
    if (x != x || x == 0) {
        return x;
    }
    if (x > 710 || x < -40) { /* beyond the largest double; closer to -1 than half its last bit */
        return x > 0 ? infinity : -1;
    }
    /* x = k ln 2 + r + low, abs(r) <= ln 2 / 2; k times the 32-bit head of ln 2 is exact. */
    int k = (int)(x * 0x1.71547652b82fep+0 + (x < 0 ? -0.5 : 0.5));
    double head = x - k * 0x1.62e42feep-1;
    double part = k * 0x1.a39ef35793c76p-33;
    double r = head - part;
    double low = (head - r) - part;
    double tail = r * r * polynomial(c, 13, r) + (low + low * r);
    if (k == 0) {
        return r + tail;
    }
    if (k > 60) { /* the 1 that is subtracted is below the last bit; two steps reach 2^1024 */
        return (1 + (r + tail)) * power_of_two(k - 1) * 2;
    }
    double inverse = power_of_two(-k);
    return (((1 - inverse) + r) + tail) * power_of_two(k);
}
