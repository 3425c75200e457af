/* pair.cpp: compares the uses of wrapped.v with their netlists, clock by clock.
 *
 * Usage: pair COUNT NAME...
 *
 * A quarter of the words are any bits; in the others the two vectors are near each other, and the
 * lower half of the first is small. Exits with 1 and a line at the first difference, and where a use's
 * output was hardly ever above 0.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "Vpair.h"
#include "verilated.h"

namespace {

uint64_t random_state = 1;

uint32_t next_random() {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)(random_state >> 32);
}

/* Vectors in words 0 to 2, {z, y, x} of 16 bits each. */
void next_word(Vpair *top) {
    for (int i = 0; i < 8; ++i) {
        top->word[i] = next_random();
    }
    const uint32_t how = next_random() & 3u;
    if (how == 0) {
        return;
    }
    const uint32_t x = next_random() & 0x9FFFu, y = next_random() & 0x9FFFu, z = 0x7000u | (how << 8);
    top->word[0] = y << 16 | x;
    top->word[1] = (x ^ (next_random() & 255u)) << 16 | z;
    top->word[2] = z << 16 | (y ^ (next_random() & 255u));
    top->word[3] = (top->word[3] & ~1023u) | (1u + next_random() % 64u);
}

} // namespace

int main(int argc, char **argv) {
    const unsigned count = argc > 1 ? (unsigned)atoi(argv[1]) : 0, settled = 400;
    unsigned lit[64] = {0};
    Vpair top;
    for (unsigned i = 0; i < count + settled; ++i) {
        next_word(&top);
        top.enable = i < settled || (next_random() & 7u) != 0;
        top.clk = 0;
        top.eval();
        top.clk = 1;
        top.eval();
        for (int k = 2; k < argc && i >= settled; ++k) {
            lit[k] += top.lit >> (k - 2) & 1u;
            if (top.differ >> (k - 2) & 1u) {
                printf("pair: %s: clock %u: the netlist is not the Verilog\n", argv[k], i);
                return 1;
            }
        }
    }
    for (int k = 2; k < argc; ++k) {
        if (lit[k] < count / 20) {
            printf("pair: %s: above 0 at %u of %u clocks only\n", argv[k], lit[k], count);
            return 1;
        }
    }
    printf("pair: %d uses, %u clocks each, netlists as the Verilog\n", argc - 2, count);
    return 0;
}
