/* One lit value of each lobe of operations.csv, each in a function of
 * its own, for lobe/firmware/operations, which counts the instructions that run. */
#include "burnish/lobe_q15.h"

#include "target.h"

/* An exponent that is not even, and a cosine at which all of them are above 0. */
static volatile uint16_t exponent = 33, cosine = 0x7F80, value;

uint16_t count_w(uint16_t n, uint16_t c);
uint16_t count_w_half(uint16_t n, uint16_t c);
uint16_t count_schlick(uint16_t n, uint16_t c);

__attribute__((noinline)) uint16_t count_w(uint16_t n, uint16_t c) {
    return burnish_taylor_q15(n, c);
}

__attribute__((noinline)) uint16_t count_w_half(uint16_t n, uint16_t c) {
    return burnish_shift7_q15(n, c);
}

/* c / (c + n (1 - c)) by one 32-bit division; c below 1. */
__attribute__((noinline)) uint16_t count_schlick(uint16_t n, uint16_t c) {
    const uint32_t below = c + burnish_q15_multiply(n, (uint16_t)(BURNISH_Q15_ONE - c));
    return (uint16_t)(((uint32_t)c << 16) / below);
}

int main(void) {
    value = count_w(exponent, cosine);
    value = count_w_half(exponent, cosine);
    value = count_schlick(exponent, cosine);
    target_end();
    return 0;
}
