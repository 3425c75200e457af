/* pixel_vectors.cpp: vectors for pixel_tb.v. A line is one, the last field lowest: the inputs of pixel.v, then which of the 16
 * units have a result, and the C core's results of 48 bits.
 * Usage: pixel_vectors COUNT
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "pixel.h"

static void print48(const void *three) {
    printf("%012" PRIx64, packed(three));
}

int main(int argc, char **argv) {
    if (argc != 2) {
        return 2;
    }
    random_state = 1;
    for (int i = 0; i < atoi(argv[1]); ++i) {
        input in;
        make_input(&in);
        print48(in.a);
        print48(in.b);
        printf("%04x%04x%x%x%x%x", in.exponent, in.slope, 0u, in.lit, in.narrow, in.shift);
        for (int k = 1; k >= 0; --k) {
            print48(in.lights[k].direction);
            print48(in.lights[k].half);
            print48(in.lights[k].diffuse);
            print48(in.lights[k].specular);
        }
        print48(in.sum);
        uint64_t results[units];
        unsigned valid = 0;
        for (unsigned k = 0; k < units; ++k) {
            valid |= (unsigned)expected(k, in, 2, &results[k]) << k;
        }
        printf("%04x", valid);
        for (unsigned k = units; k-- > 0;) {
            printf("%012" PRIx64, valid >> k & 1u ? results[k] : 0);
        }
        printf("\n");
    }
    return 0;
}
