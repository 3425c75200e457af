/* Sums over the inputs of the steps that differ between processors, which must equal the host's:
 * AVR has products in assembly, and int is 16 bits there. */
#include "burnish/shade_q15.h"
#include "target.h"

static uint32_t sum;

/* Adds a result to the sum; the order matters. */
static void take(uint32_t result) {
    sum = (sum << 5 | sum >> 27) ^ result;
}

static void put_sum(char name) {
    uint8_t i;
    target_put((uint8_t)name);
    target_put(' ');
    for (i = 0; i < 8; ++i, sum <<= 4) {
        target_put((uint8_t) "0123456789abcdef"[sum >> 28]);
    }
    target_put('\n');
}

/* All values of 16 bits. */
static void take_steps(void) {
    uint16_t x = 0;
    do {
        take(burnish_q15_square(x));
        take(burnish_q15_square8(x));
        take(burnish_q15_lambda(x));
        take(burnish_q15_square_middle(x));
    } while (++x != 0);
    put_sum('s');
}

/* Products of 16-bit numbers, extremes first. */
static void take_products(void) {
    uint16_t i, a = 1, b = 1;
    for (i = 0; i < 40000u; ++i) {
        a = (uint16_t)(i < 256 ? (i & 15u) * 0x1111u : a * 25173u + 13849u);
        b = (uint16_t)(i < 256 ? (i >> 4) * 0x1111u : b * 26125u + a);
        take(burnish_q15_multiply(a, b));
        take((uint32_t)burnish_q15_multiply_signed((int16_t)a, (int16_t)b));
        take(burnish_q15_square_wide((uint32_t)a << 16 | b));
        take(burnish_q15_multiply_high(a, b));
    }
    put_sum('p');
}

/* All cosines, for lobes with specialised code. */
static void take_lobes(void) {
    static const uint8_t exponents[] = {0, 1, 2, 100, 255};
    uint8_t i;
    for (i = 0; i < sizeof exponents; ++i) {
        const uint16_t n = (uint16_t)(exponents[i] == 255 ? 1023 : exponents[i]);
        burnish_lobe_q15 lobe;
        burnish_composite_q15 composite;
        uint16_t c = 0;
        burnish_lobe_q15_create(&lobe, BURNISH_Q15_ENERGY, 2, n);
        burnish_composite_q15_create(&composite, n);
        do {
            take(burnish_taylor8_q15(exponents[i], c));
            take(burnish_taylor_q15(n, c));
            take(burnish_shift7_q15(n, c));
            take(burnish_lobe_q15_fast(&lobe, c));
            take(burnish_lobe_q15_fast8(&lobe, c));
            take(burnish_lobe_q15_fast_lambda(&lobe, ((uint32_t)c << 3) + n));
            take(burnish_composite_q15_at_cosine(&composite, c));
            take(burnish_composite_q15_at_lambda(&composite, ((uint32_t)c << 3) + n));
            c = (uint16_t)(c + (c < 0x7C00 || c > 0x8010 ? 61 : 1)); /* all of those near 1 */
        } while (c >= 61);
    }
    put_sum('l');
}

int main(void) {
    take_steps();
    take_products();
    take_lobes();
    target_end();
    return 0;
}
