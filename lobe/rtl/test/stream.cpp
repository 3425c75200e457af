/* stream.cpp: the streaming wrapper under random stalls on both sides.
 *
 * Compiled per set of parameters: STREAM_UNIT is a reference.h unit, STREAM_ZETA 1 for
 * burnish_zeta.
 *
 * Every word carries its number as user data: words must come out in order, none lost, none
 * repeated, with the C core's value; an offered word must not change until it is taken; s_ready
 * must not depend on m_ready within a clock. Exits with 1 and a line on the first fault.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cstdio>
#include <cstdlib>

#include "Vburnish_stream.h"
#include "reference.h"
#include "verilated.h"

namespace {

uint32_t random_state = 7;

uint32_t next_random() {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

const unit lobe = STREAM_UNIT;

/* The input number so and so: most inside the lobe. */
vector word_of(uint32_t number) {
    const uint32_t mixed = number * 2654435761u;
    vector v;
    v.exponent = (uint16_t)(1 + mixed % 1023u);
    v.cosine = (uint16_t)(0x8000u - (mixed >> 16) % (0x28000u / v.exponent + 1u) % 0x8001u);
    v.lambda = mixed % (0x4000000u / v.exponent) & 0xFFFFFFu;
    v.slope = burnish_q15_energy_slope(v.exponent, 2, &v.shift);
    return v;
}

int fault(const char *what, uint32_t number) {
    printf("stream: word %u: %s\n", number, what);
    return 1;
}

/* One run. push, pop: of 16 clocks, how many each side is ready. */
int run(uint32_t count, uint32_t push, uint32_t pop) {
    Vburnish_stream top;
    uint32_t sent = 0, received = 0, quiet = 0;
    bool offered = false, held = false;
    uint32_t held_user = 0, held_value = 0;
    top.clk = 0;
    top.reset = 1;
    top.s_valid = 0;
    top.m_ready = 0;
    for (int i = 0; i < 3; ++i) {
        top.clk = 0;
        top.eval();
        top.clk = 1;
        top.eval();
    }
    top.reset = 0;
    while (received < count) {
        top.clk = 0;
        /* A source keeps what it has offered until it is taken. */
        offered = offered || (sent < count && (next_random() & 15u) < push);
        const vector w = word_of(sent);
        top.s_valid = offered;
        top.s_exponent = !offered      ? next_random() & 1023u
                         : STREAM_ZETA ? (uint32_t)w.shift << 16 | w.slope
                                       : w.exponent;
        top.s_angle = !offered ? next_random() & 0xFFFFu : lobe.lambda ? w.lambda : w.cosine;
        top.s_user = offered ? sent : next_random();
        top.m_ready = 0;
        top.eval();
        const bool ready = top.s_ready;
        top.m_ready = 1;
        top.eval();
        if (ready != (bool)top.s_ready) {
            return fault("s_ready follows m_ready", sent);
        }
        top.m_ready = (next_random() & 15u) < pop;
        top.eval();
        if (held && (!top.m_valid || top.m_user != held_user || top.m_value != held_value)) {
            return fault("an offered result changed while it waited", received);
        }
        held = top.m_valid && !top.m_ready;
        held_user = top.m_user;
        held_value = top.m_value;
        if (top.m_valid && top.m_ready) {
            if (top.m_user != received) {
                return fault("out of order, lost or repeated", received);
            }
            if (top.m_value != expected(lobe, word_of(received))) {
                return fault("not the value of the C core", received);
            }
            ++received;
            quiet = 0;
        } else if (++quiet > 4000) {
            return fault("no word comes out", received);
        }
        if (offered && top.s_ready) {
            ++sent;
            offered = false;
        }
        top.clk = 1;
        top.eval();
    }
    top.m_ready = 1;
    for (int i = 0; i < 200; ++i) {
        top.clk = 0;
        top.s_valid = 0;
        top.eval();
        if (top.m_valid) {
            return fault("more words came out than went in", received);
        }
        top.clk = 1;
        top.eval();
    }
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    const uint32_t count = argc > 1 ? (uint32_t)atoi(argv[1]) : 20000;
    const uint32_t rates[][2] = {{16, 16}, {16, 8}, {8, 16}, {8, 8}, {15, 1}, {1, 15}, {16, 15}};
    for (const auto &rate : rates) {
        if (run(count, rate[0], rate[1])) {
            return 1;
        }
    }
    printf("stream: %s: 7 rates of stalls, %u words each: in order, none lost, none repeated\n",
           lobe.name, count);
    return 0;
}
