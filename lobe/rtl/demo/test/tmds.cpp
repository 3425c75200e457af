/* tmds.cpp: every byte from every balance, and the four controls, through demo_tmds against the specification.
 *
 * Usage: tmds
 *
 * The expected symbol comes from the rule alone: a byte has two codings, of which the one that
 * changes less often is taken, as it is or inverted, and the balance is that of the bits sent.
 * Exits with 1 and a line on a difference.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cstdlib>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "Vdemo_tmds.h"
#include "tmds.h"
#include "verilated.h"

namespace {

/* Ones minus zeros among the lowest count bits. */
int surplus(unsigned bits, int count) {
    return 2 * __builtin_popcount(bits & ((1u << count) - 1)) - count;
}

int changes(unsigned symbol, int count) {
    return __builtin_popcount((symbol ^ symbol >> 1) & ((1u << (count - 1)) - 1));
}

/* The coding of a byte by exclusive ors (bit 8 is 1) or nors (0): each bit says whether the byte's
 * next bit differs from it. */
unsigned chained(unsigned byte, unsigned by_or) {
    unsigned coded = byte & 1u;
    for (int i = 1; i < 8; ++i) {
        const unsigned differ = (coded >> (i - 1) ^ byte >> i) & 1u;
        coded |= (by_or ? differ : !differ) << i;
    }
    return coded | by_or << 8;
}

/* The symbol of a byte after symbols whose ones minus zeros are balance. */
unsigned encode(unsigned byte, int balance) {
    const unsigned codings[2] = {chained(byte, 0), chained(byte, 1)};
    const int by_nor = changes(codings[0], 8), by_or = changes(codings[1], 8);
    /* As often: the byte has four ones, and its lowest bit decides. */
    const unsigned coded = codings[by_or != by_nor ? by_or < by_nor : byte & 1u];
    const unsigned plain = coded, inverted = coded ^ 0x2FFu;
    const int excess = surplus(coded, 8);
    if (balance == 0 || excess == 0) {
        return coded >> 8 ? plain : inverted; /* bits 8 and 9 differ */
    }
    return (balance > 0) == (excess > 0) ? inverted : plain;
}

struct sent {
    bool visible;
    unsigned value; /* a byte, or two control bits */
};

/* The shortest ways from 0 to all balances that can be, by every byte. */
std::map<int, std::vector<sent>> ways() {
    std::map<int, std::vector<sent>> found = {{0, {}}};
    std::vector<int> open = {0};
    for (size_t i = 0; i < open.size(); ++i) {
        for (unsigned byte = 0; byte < 256; ++byte) {
            const int next = open[i] + surplus(encode(byte, open[i]), 10);
            if (found.count(next) == 0) {
                found[next] = found[open[i]];
                found[next].push_back({true, byte});
                open.push_back(next);
            }
        }
    }
    return found;
}

struct bench {
    Vdemo_tmds top;
    std::vector<unsigned> expected; /* of what is inside */
    int balance = 0;
    size_t symbols = 0, wrong = 0;
    std::set<std::pair<int, unsigned>> seen;

    void send(sent s) {
        unsigned symbol = control_symbols[s.value & 3u];
        if (s.visible) {
            seen.insert({balance, s.value});
            symbol = encode(s.value, balance);
        }
        balance = s.visible ? balance + surplus(symbol, 10) : 0;
        expected.push_back(symbol);
        top.visible = s.visible;
        top.value = (uint8_t)(s.visible ? s.value : rand());
        top.control = (uint8_t)(s.visible ? rand() & 3 : s.value);
        top.clk = 0;
        top.eval();
        top.clk = 1;
        top.eval();
        if (expected.size() == 2) { /* the latency */
            check(expected[0]);
            expected.erase(expected.begin());
        }
    }

    void check(unsigned symbol) {
        ++symbols;
        if (top.symbol != symbol && wrong++ < 5) {
            fprintf(stderr, "tmds: %03x in place of %03x\n", top.symbol, symbol);
        }
    }
};

} // namespace

int main() {
    bench b;
    const std::map<int, std::vector<sent>> all = ways();
    int widest = 0, most_changes = 0;
    for (const auto &way : all) {
        widest = abs(way.first) > widest ? abs(way.first) : widest;
        for (unsigned byte = 0; byte < 256; ++byte) {
            const unsigned symbol = encode(byte, way.first);
            most_changes = changes(symbol, 10) > most_changes ? changes(symbol, 10) : most_changes;
            if (decode(symbol).control >= 0 || decode(symbol).value != byte) {
                fprintf(stderr, "tmds: the symbol of %02x is not read back\n", byte);
                return 1;
            }
            b.send({false, byte & 3u});
            for (const sent &s : way.second) {
                b.send(s);
            }
            b.send({true, byte});
        }
    }
    for (int i = 0; i < 1000000; ++i) {
        const bool visible = rand() % 100 != 0;
        b.send({visible, (unsigned)rand() % (visible ? 256u : 4u)});
    }
    const size_t pairs = all.size() * 256;
    printf("tmds: %zu symbols, %zu of %zu bytes and balances (ones minus zeros up to %d, at most %d changes in a symbol), %zu differ\n",
           b.symbols, b.seen.size(), pairs, widest, most_changes, b.wrong);
    return b.wrong || b.seen.size() != pairs;
}
