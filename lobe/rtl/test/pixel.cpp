/* pixel.cpp: the units from vectors to a pixel against shade_q15.h, bit for bit.
 *
 * Usage: pixel COUNT SEED [alone] [steady]
 * alone: only burnish_pixel is there (pixel.v with ALL 0); steady: the clock is always enabled
 * (FREE 0)
 *
 * The clock is disabled at random. Exits with 1 and a line at the first difference.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "Vpixel.h"
#include "pixel.h"
#include "verilated.h"

namespace {

const unsigned ring_size = 1024; /* more than the longest latency */

template <typename Wide> void put48(Wide &port, unsigned index, uint64_t word) {
    for (unsigned i = 0; i < 3; ++i) { /* by halves of the port's words */
        const unsigned half = 3 * index + i, shift = half % 2 * 16;
        port[half / 2] = (port[half / 2] & ~(0xFFFFu << shift)) |
                         (uint32_t)(word >> (16 * i) & 0xFFFFu) << shift;
    }
}

template <typename Wide> uint64_t get48(const Wide &port, unsigned index) {
    uint64_t word = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned half = 3 * index + i;
        word |= (uint64_t)(port[half / 2] >> (half % 2 * 16) & 0xFFFFu) << (16 * i);
    }
    return word;
}

void drive(Vpixel *top, const input &in, bool user) {
    top->a = packed(in.a);
    top->b = packed(in.b);
    top->exponent = in.exponent;
    top->narrow = in.narrow;
    top->shift = in.shift;
    top->slope = in.slope;
    top->lit = in.lit;
    top->sum = packed(in.sum);
    for (unsigned k = 0; k < 2; ++k) {
        put48(top->light, k, packed(in.lights[k].direction));
        put48(top->half, k, packed(in.lights[k].half));
        put48(top->diffuse, k, packed(in.lights[k].diffuse));
        put48(top->specular, k, packed(in.lights[k].specular));
    }
    top->user = user;
}

void clock(Vpixel *top) {
    top->clk = 0;
    top->eval();
    top->clk = 1;
    top->eval();
}

input ring[ring_size];
unsigned latency[units];

bool measure_latencies(Vpixel *top, unsigned present) {
    make_input(&ring[0]);
    for (unsigned i = 0; i < 2 * ring_size; ++i) {
        drive(top, ring[0], i == ring_size);
        clock(top);
        for (unsigned k = 0; k < present && i >= ring_size; ++k) {
            if (latency[k] == 0 && (top->users >> k & 1u)) {
                latency[k] = i - ring_size + 1;
            }
        }
    }
    for (unsigned k = 0; k < present; ++k) {
        if (latency[k] == 0) {
            printf("pixel: %s: its user bit does not come out\n", names[k]);
            return false;
        }
    }
    return true;
}

int compare(Vpixel *top, unsigned present, bool steady, uint64_t count) {
    uint64_t lit = 0, compared = 0;
    for (uint64_t done = 0; done < count + ring_size; ++done) {
        input &now = ring[done % ring_size];
        make_input(&now);
        while (!steady && (next_random() & 15u) == 0) { /* nothing may happen */
            drive(top, ring[next_random() % ring_size], true);
            top->enable = 0;
            clock(top);
        }
        top->enable = 1;
        drive(top, now, true);
        clock(top);
        for (unsigned k = 0; k < present; ++k) {
            if (done + 1 < latency[k]) {
                continue;
            }
            const input &in = ring[(done + 1 - latency[k]) % ring_size];
            const uint64_t got = get48(top->values, k);
            uint64_t want;
            if (!expected(k, in, top->lights, &want)) {
                continue;
            }
            ++compared;
            lit += want != 0;
            if (want != got) {
                printf("pixel: %s: n %u, normal %d %d %d, half %d %d %d, slope %u >> %u, narrow "
                       "%u: %012llx, the C core has %012llx\n",
                       names[k], in.exponent, in.a[0], in.a[1], in.a[2], in.b[0], in.b[1], in.b[2],
                       in.slope, in.shift, in.narrow, (unsigned long long)got,
                       (unsigned long long)want);
                return 1;
            }
        }
    }
    printf("pixel: %u units, %llu vectors each, all bits as in C (%.0f %% above 0), latencies",
           present, (unsigned long long)count, 100.0 * (double)lit / (double)compared);
    for (unsigned k = 0; k < present; ++k) {
        printf(" %u", latency[k]);
    }
    printf("\n");
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    Vpixel top;
    if (argc < 3) {
        fprintf(stderr, "usage: pixel COUNT SEED [alone] [steady]\n");
        return 2;
    }
    random_state = strtoull(argv[2], nullptr, 10) * 0x9E3779B97F4A7C15ull + 1u;
    unsigned present = units;
    bool steady = false;
    for (int i = 3; i < argc; ++i) {
        present = strcmp(argv[i], "alone") == 0 ? 1 : present;
        steady = steady || strcmp(argv[i], "steady") == 0;
    }
    top.enable = 1;
    return measure_latencies(&top, present)
               ? compare(&top, present, steady, strtoull(argv[1], nullptr, 10))
               : 1;
}
