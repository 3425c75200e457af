/* replay.cpp: streams inputs through all units at once and compares every result with the C core.
 *
 * Usage: replay STRIDE [FIRST]          every STRIDE-th of the 2^26 pairs of cosine and exponent
 *        replay --errors                name, largest error in steps, bits, latency of every unit
 *        replay --vectors FOLDER COUNT  writes random vectors and results for the Verilog bench
 *
 * Every vector also carries a lambda and, for units with a slope port, the energy slope
 * of the exponent: seven of eight lambdas are within twice the lobe's reach, the others any of 24
 * bits.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "Vreplay.h"
#include "reference.h"
#include "units.h"
#include "verilated.h"

namespace {

const unsigned ring_size = 1024; /* more than the longest latency */
vector ring[ring_size];
unsigned latency[UNITS];
burnish_composite_q15 held; /* of units whose constants hold still */

uint32_t random_state = 1;

uint32_t next_random() {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

vector vector_at(uint32_t index) {
    vector v;
    v.cosine = (uint16_t)index;
    v.exponent = (uint16_t)(index >> 16);
    if (v.exponent == 0) {
        v.exponent = (uint16_t)(1 + next_random() % 1023);
    }
    /* All cosines above 1 give the same result: half of them are moved near 1. */
    const uint32_t reach = 0x4000000u / v.exponent;
    v.lambda = next_random();
    v.lambda = (index & 7u) == 0 ? v.lambda >> 8 : v.lambda % (reach + 2u);
    if (v.lambda > 0xFFFFFFu) {
        v.lambda = 0xFFFFFFu;
    }
    v.slope = burnish_q15_energy_slope(v.exponent, 2, &v.shift);
    if (index & 16u) { /* and any zeta */
        v.slope = (uint16_t)next_random();
        v.shift = (uint8_t)(next_random() & 15u);
    }
    burnish_composite_q15_create(&v.composite, v.exponent < 15 ? 1023 - v.exponent : v.exponent);
    return v;
}

/* The constants of a composite as a bus. */
void set_bus(VlWide<3> &bus, const burnish_composite_q15 &lobe) {
    bus[0] = (uint32_t)lobe.top << 16 | lobe.slope;
    bus[1] = (uint32_t)lobe.offset[1] << 16 | lobe.offset[0];
    bus[2] = lobe.offset[2];
}

/* clk_on is the clock of units without an enable: it stands still where enable is 0. */
void clock(Vreplay *top, const vector &v, bool user) {
    top->cosine = v.cosine;
    top->lambda = v.lambda;
    top->exponent = v.exponent;
    top->slope = v.slope;
    top->shift = v.shift;
    set_bus(top->constants, v.composite);
    top->user = user;
    top->clk = 0;
    top->clk_on = 0;
    top->eval();
    top->clk = 1;
    top->clk_on = top->enable;
    top->eval();
}

/* One clock in 16 finds enable at 0 and other inputs, which must change nothing. */
void stall(Vreplay *top) {
    if ((next_random() & 15u) == 0) {
        top->enable = 0;
        clock(top, vector_at(next_random() & 0x3FFFFFFu), next_random() & 1u);
        top->enable = 1;
    }
}

/* Ports up to 64 bits are integers, wider ones arrays of words. */
bool bit_of(uint64_t word, unsigned i) {
    return word >> i & 1u;
}

template <std::size_t N> bool bit_of(const VlWide<N> &wide, unsigned i) {
    return wide[i / 32] >> (i % 32) & 1u;
}

uint16_t word_of(uint64_t word, unsigned i) {
    return (uint16_t)(word >> (16 * i));
}

template <std::size_t N> uint16_t word_of(const VlWide<N> &wide, unsigned i) {
    return (uint16_t)(wide[i / 2] >> (i % 2 * 16));
}

/* The latency of each unit, measured by one user bit. */
bool measure_latencies(Vreplay *top) {
    const vector dark = {0, 1, 0, 0, 0, {}};
    unsigned found = 0;
    for (unsigned i = 0; i < ring_size; ++i) {
        clock(top, dark, false);
    }
    for (unsigned i = 0; i < ring_size && found < UNITS; ++i) {
        clock(top, dark, i == 0);
        for (unsigned k = 0; k < UNITS; ++k) {
            if (latency[k] == 0 && bit_of(top->users, k)) {
                latency[k] = i + 1;
                ++found;
            }
        }
    }
    return found == UNITS;
}

int replay(Vreplay *top, uint32_t stride, uint32_t first) {
    uint64_t count = 0, lit = 0;
    for (uint64_t index = first; index < (1ull << 26) + (uint64_t)stride * ring_size;
         index += stride, ++count) {
        ring[count % ring_size] = vector_at((uint32_t)(index & 0x3FFFFFFu));
        stall(top);
        clock(top, ring[count % ring_size], true);
        for (unsigned k = 0; k < UNITS; ++k) {
            if (count + 1 < latency[k]) {
                continue;
            }
            const vector &v = ring[(count + 1 - latency[k]) % ring_size];
            const uint16_t want = expected(units[k], v), got = word_of(top->values, k);
            lit += want != 0;
            if (want != got) {
                printf("replay: %s: cosine %04x exponent %u lambda %06x slope %u >> %u: %u, the C "
                       "core has %u\n",
                       units[k].name, v.cosine, v.exponent, v.lambda, v.slope, v.shift, got, want);
                return 1;
            }
        }
    }
    printf("replay: %u units, %llu vectors each, all bits as in C (%.0f %% above 0)\n", UNITS,
           (unsigned long long)count, 100.0 * (double)lit / ((double)count * UNITS));
    return 0;
}

/* The real lobe of a unit at 1 - c, in units of the result's last place. */
double real_lobe(const unit &u, const vector &v, double lambda) {
    double value, n = v.exponent;
    switch (u.which) {
    case FIT_COMPOSITE:
    case FIT_POWER:
        value = pow(1 - lambda, u.which == FIT_COMPOSITE && u.order > 1 ? u.order : n);
        break;
    case FIT_DIVIDER:
        value = (1 - lambda) / (n - n * (1 - lambda) + 1 - lambda);
        break;
    default: {
        uint16_t slope = 0;
        uint8_t shift = 0;
        slope_of(u, v, &slope, &shift);
        double zeta = slope / (double)(2u << shift);
        if (u.which == FIT_ENERGY) {
            zeta = (n + 1) / (u.order + 1);
        }
        const double t = 1 - zeta * lambda;
        value = t <= 0 ? 0 : t * t;
        for (unsigned m = 2; m < u.order; m *= 2) {
            value *= value;
        }
    }
    }
    return value * (double)(1u << u.result);
}

/* The largest error over every cosine (or 2^15 lambdas over twice the lobe's reach) and exponents
 * from the order up: all below 32, every 48th, all from 1000; and the measured latency. */
void print_errors() {
    for (unsigned k = 0; k < UNITS; ++k) {
        const unit &u = units[k];
        double largest = 0;
        for (uint16_t n = u.order; n <= 1023; n = (uint16_t)(n < 32     ? n + 1
                                                             : n < 1000 ? n + 48
                                                                        : n + 1)) {
            vector v = {0, n, 0, 0, 0, {}};
            v.slope = burnish_q15_energy_slope(n, 2, &v.shift);
            if ((u.which == FIT_COMPOSITE && n < 15) || (u.which == FIT_POWER && n > 15)) {
                continue;
            }
            burnish_composite_q15_create(&v.composite, n);
            const uint32_t step = 0x4000000u / n / 0x8000u + 1;
            for (uint32_t i = 0; i <= 0x8000u; ++i) {
                v.cosine = (uint16_t)i;
                v.lambda = i * step > 0xFFFFFFu ? 0xFFFFFFu : i * step;
                const double lambda = u.lambda ? v.lambda / 16777216.0 : 1 - i / 32768.0;
                const double error = fabs(expected(u, v) - real_lobe(u, v, lambda));
                largest = error > largest ? error : largest;
            }
        }
        printf("%s %.2f %u %u\n", u.name, largest, u.result, latency[k]);
    }
}

FILE *create(const char *folder, const char *name) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    if (!file) {
        fprintf(stderr, "replay: cannot write %s\n", path);
        exit(2);
    }
    return file;
}

int write_vectors(const char *folder, unsigned count) {
    FILE *in = create(folder, "input.mem"), *out = create(folder, "expected.mem");
    FILE *lat = create(folder, "latency.mem");
    for (unsigned k = 0; k < UNITS; ++k) {
        fprintf(lat, "%x\n", latency[k]);
    }
    for (unsigned i = 0; i < count; ++i) {
        vector v = vector_at(next_random() & 0x3FFFFFFu);
        /* Half of them inside the lobe. */
        if (i & 1u) {
            v.cosine = (uint16_t)(0x8000u - v.lambda / 512u);
        }
        const burnish_composite_q15 lobes[] = {held, v.composite};
        for (const burnish_composite_q15 &lobe : lobes) {
            fprintf(in, "%04x%04x%04x%04x%04x", lobe.offset[2], lobe.offset[1], lobe.offset[0],
                    lobe.top, lobe.slope);
        }
        fprintf(in, "%x%04x%03x%06x%04x\n", v.shift, v.slope, v.exponent, v.lambda, v.cosine);
        for (unsigned k = UNITS; k-- > 0;) {
            fprintf(out, "%04x", expected(units[k], v));
        }
        fprintf(out, "\n");
    }
    fclose(in);
    fclose(out);
    fclose(lat);
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    Vreplay top;
    top.enable = 1;
    burnish_composite_q15_create(&held, HELD_EXPONENT);
    set_bus(top.held, held);
    if (argc < 2) {
        fprintf(stderr, "usage: replay STRIDE [FIRST] | --vectors FOLDER COUNT\n");
        return 2;
    }
    if (!measure_latencies(&top)) {
        printf("replay: a unit's valid bit does not come out\n");
        return 1;
    }
    if (strcmp(argv[1], "--errors") == 0) {
        print_errors();
        return 0;
    }
    if (strcmp(argv[1], "--vectors") == 0 && argc == 4) {
        return write_vectors(argv[2], (unsigned)atoi(argv[3]));
    }
    return replay(&top, (uint32_t)atoi(argv[1]), argc > 2 ? (uint32_t)atoi(argv[2]) : 0);
}
