/* activity.cpp: what burnish_boundary saves on the teapot of picture.cpp.
 *
 * Usage: activity WIDTH HEIGHT EXPONENT LABEL   in the folder of the memories of activity.v
 *
 * Every pixel of the teapot in the order of rows, for both lights, then pixels of any exponent:
 * every value is compared with the C core. Prints a row of a table: the share of pixels beyond the
 * boundary, of clocks in which the lobe's registers stand still, and of toggles of its signals
 * saved, for memories with --bits=0 and --bits=8. Toggles, of every signal but the clock, are
 * Verilator's toggle coverage.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cstring>
#include <string>

#include "Vactivity.h"
#include "teapot.h"
#include "verilated.h"
#include "verilated_cov.h"

namespace {

struct sample {
    uint16_t exponent, cosine;
    uint32_t lambda;
};

uint16_t cosine_words[1024];
uint32_t lambda_words[2][1024];

template <typename Word> void read_memory(const char *name, Word *words) {
    FILE *file = fopen(name, "r");
    char line[256];
    unsigned count = 0;
    while (file && count < 1023 && fgets(line, sizeof line, file)) {
        if (line[0] != '/' && line[0] != '@') {
            words[++count] = (Word)strtoul(line, nullptr, 16);
        }
    }
    if (count != 1023) {
        fprintf(stderr, "activity: %s has %u words, not 1023\n", name, count);
        exit(2);
    }
    fclose(file);
}

/* What the four units must give. */
uint64_t expected(const sample &s) {
    burnish_lobe_q15 lobe;
    burnish_lobe_q15_create(&lobe, BURNISH_Q15_SHIFT7, 2, s.exponent);
    const uint16_t plain = burnish_lobe_q15_fast_lambda(&lobe, s.lambda);
    const uint16_t level = s.lambda > lambda_words[1][s.exponent] ? (uint16_t)0 : plain;
    burnish_lobe_q15_set_boundary(&lobe, cosine_words[s.exponent]);
    return (uint64_t)burnish_lobe_q15_fast(&lobe, s.cosine) << 48 | (uint64_t)level << 32 |
           (uint64_t)plain << 16 | plain;
}

/* Streams the samples; returns how many results differ. still: clocks in which zero and level
 * stood. */
size_t stream(Vactivity *top, const std::vector<sample> &samples, size_t still[2]) {
    size_t wrong = 0, done[4] = {0, 0, 0, 0};
    for (size_t tick = 0; tick < samples.size() + 200; ++tick) {
        const bool more = tick < samples.size();
        const sample &s = samples[more ? tick : samples.size() - 1];
        top->exponent = s.exponent;
        top->cosine = s.cosine;
        top->lambda = s.lambda;
        top->user = more;
        top->clk = 0;
        top->eval();
        top->clk = 1;
        top->eval();
        for (int k = 0; k < 2 && more; ++k) {
            still[k] += !(top->busy >> k & 1u);
        }
        for (int k = 0; k < 4; ++k) {
            if (top->users >> k & 1u) {
                const uint64_t want = expected(samples[done[k]++]);
                wrong += (uint16_t)(want >> (16 * k)) != (uint16_t)(top->values >> (16 * k));
            }
        }
    }
    for (const size_t count : done) {
        wrong += samples.size() - count;
    }
    return wrong;
}

/* The toggles of the signals below an instance, of the coverage file. */
double toggles_of(const std::string &instance) {
    FILE *file = fopen("coverage.dat", "r");
    char line[4096];
    double sum = 0;
    while (file && fgets(line, sizeof line, file)) {
        const std::string text = line;
        const size_t name = text.find("\001o\002"),
                     where = text.find("\001h\002TOP.activity." + instance);
        const size_t count = text.rfind("' ");
        if (where != std::string::npos && count != std::string::npos &&
            text.compare(name, 6, std::string("\001o\002clk", 6)) != 0) {
            sum += atof(text.c_str() + count + 2);
        }
    }
    if (file) {
        fclose(file);
    }
    return sum;
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 5) {
        fprintf(stderr, "usage: activity WIDTH HEIGHT EXPONENT LABEL\n");
        return 2;
    }
    const uint16_t exponent = (uint16_t)atoi(argv[3]);
    read_memory("zero.mem", lambda_words[0]);
    read_memory("level.mem", lambda_words[1]);
    read_memory("cosine.mem", cosine_words);
    burnish_q15_material material;
    burnish_q15_light prepared[2];
    prepare(&material, prepared);
    const std::vector<pixel> pixels = normals_of_teapot(atoi(argv[1]), atoi(argv[2]));
    std::vector<sample> samples;
    size_t dark[2] = {0, 0};
    for (const burnish_q15_light &light : prepared) {
        for (const pixel &p : pixels) {
            if (p.depth > -1e29f) {
                const int16_t normal[3] = {q15(p.normal[0]), q15(p.normal[1]), q15(p.normal[2])};
                int16_t unit[3];
                burnish_q15_normalize_near(normal, unit);
                const sample s = {exponent, burnish_q15_cosine(burnish_q15_dot(unit, light.half)),
                                  burnish_q15_chord(unit, light.half)};
                samples.push_back(s);
                for (int k = 0; k < 2; ++k) {
                    dark[k] += s.lambda > lambda_words[k][exponent];
                }
            }
        }
    }
    Verilated::threadContextp()->coveragep()->forcePerInstance(true);
    Vactivity top;
    size_t still[2] = {0, 0};
    size_t wrong = stream(&top, samples, still);
    Verilated::threadContextp()->coveragep()->write("coverage.dat");
    const double all = (double)samples.size(), plain = toggles_of("plain");
    const double saved[2] = {1 - toggles_of("zero") / plain, 1 - toggles_of("level") / plain};
    printf("| %s | %u |", argv[4], exponent);
    for (int k = 0; k < 2; ++k) {
        printf(" %.0f %% | %.0f %% | %.0f %% |", 100 * (double)dark[k] / all,
               100 * (double)still[k] / all, 100 * saved[k]);
    }
    printf("\n");
    /* Then any exponent at once. */
    uint32_t random = 1;
    for (sample &s : samples) {
        random = random * 1664525u + 1013904223u;
        s.exponent = (uint16_t)(1u + (random >> 8) % 1023u);
    }
    wrong += stream(&top, samples, still);
    if (wrong) {
        printf("activity: %zu of %zu results differ from the C core\n", wrong, 8 * samples.size());
    }
    return wrong != 0 || !(plain > 0 && saved[0] > 0 && saved[1] >= saved[0]);
}
