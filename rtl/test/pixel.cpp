/* pixel.cpp: the units from vectors to a pixel against shade_q15.h, bit for bit.
 *
 * Usage: pixel COUNT SEED [alone] [steady]
 * alone: only burnish_pixel is there (pixel.v with ALL 0); steady: the clock is always enabled
 * (FREE 0)
 *
 * A third of the vectors are any 16 bits or corners, the others of about unit length; half vectors
 * are mostly inside the lobe. The clock is disabled at random. Exits with 1 and a line at the
 * first difference.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "Vpixel.h"
#include "burnish/shade_q15.h"
#include "verilated.h"

namespace {

const unsigned units = 16, ring_size = 1024; /* more than the longest latency */
const char *const names[units] = {"pixel",
                                  "dot",
                                  "chord",
                                  "normalize",
                                  "accumulate",
                                  "highlight, taylor",
                                  "highlight, shift7",
                                  "highlight, shift3",
                                  "highlight, energy",
                                  "highlight, taylor 4",
                                  "highlight, energy 16",
                                  "highlight, cosine only",
                                  "highlight, chord only",
                                  "highlight, zeta",
                                  "channel",
                                  "light"};

struct input {
    int16_t a[3], b[3];
    uint16_t exponent, slope;
    uint8_t narrow, shift, lit;
    burnish_q15_light lights[2];
    uint16_t sum[3];
};

uint64_t random_state;

uint32_t next_random() {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)(random_state >> 32);
}

void any_vector(int16_t v[3]) {
    const int16_t corners[] = {0, 1, -1, 0x7FFF, -0x7FFF, -0x8000, 0x4000, -0x4000};
    const bool corner = next_random() & 1u;
    for (int i = 0; i < 3; ++i) {
        v[i] = corner ? corners[next_random() % 8u] : (int16_t)next_random();
    }
}

void unit_vector(int16_t v[3]) {
    const int32_t wide[3] = {(int16_t)next_random(), (int16_t)next_random(),
                             (int16_t)next_random()};
    burnish_q15_normalize(wide, v);
}

/* Near another vector: within 2^-0 .. 2^-9. */
void near_vector(const int16_t from[3], int16_t v[3]) {
    const unsigned shift = next_random() % 10u;
    int32_t wide[3];
    for (int i = 0; i < 3; ++i) {
        wide[i] = from[i] + ((int32_t)(int16_t)next_random() >> shift);
    }
    burnish_q15_normalize(wide, v);
}

/* As interpolation shortens it. */
void scale_vector(int16_t v[3]) {
    const int32_t scale = 29000 + (int32_t)(next_random() % 6000u);
    for (int i = 0; i < 3; ++i) {
        const int32_t x = v[i] * scale >> 15;
        v[i] = (int16_t)(x > 0x7FFF ? 0x7FFF : x);
    }
}

uint16_t intensity() {
    return (uint16_t)((next_random() & 3u) ? next_random() % 0x8001u : next_random());
}

void make_input(input *in) {
    const bool any = next_random() % 3u == 0;
    if (any) {
        any_vector(in->a);
        any_vector(in->b);
    } else {
        unit_vector(in->a);
        near_vector(in->a, in->b);
        if (next_random() & 1u) {
            scale_vector(in->a);
        }
    }
    in->exponent = (uint16_t)(next_random() % 1023u + 1u);
    if (next_random() & 1u) {
        in->exponent = (uint16_t)(next_random() % 64u + 1u);
    }
    in->slope = (uint16_t)(next_random() | 1u);
    in->shift = (uint8_t)(next_random() & 15u);
    if (next_random() & 1u) { /* wide lobes: slopes of any length */
        in->slope = (uint16_t)((in->slope >> (next_random() & 15u)) | 1u);
    }
    in->narrow = next_random() & 1u;
    in->lit = (next_random() & 3u) != 0;
    for (burnish_q15_light &light : in->lights) {
        if (any) {
            any_vector(light.direction);
            any_vector(light.half);
        } else {
            near_vector(in->a, light.direction);
            near_vector(in->a, light.half);
            if ((next_random() & 7u) == 0) {
                unit_vector(light.direction);
            }
        }
        for (int i = 0; i < 3; ++i) {
            light.diffuse[i] = intensity();
            light.specular[i] = intensity();
        }
    }
    for (uint16_t &sum : in->sum) {
        sum = (uint16_t)(intensity() >> 1);
    }
}

void shader_of(burnish_q15_shader *shader, const input &in, burnish_q15_fit fit, uint16_t order) {
    const burnish_q15_material none = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    burnish_q15_shader_create(shader, fit, order, in.exponent, &none, none.ambient);
    memcpy(shader->ambient, in.sum, sizeof in.sum);
}

void shader_of_slope(burnish_q15_shader *shader, const input &in, uint16_t order) {
    burnish_lobe_q15_from_slope(&shader->lobe, in.slope, in.shift, order);
    shader->narrow = in.narrow;
    memcpy(shader->ambient, in.sum, sizeof in.sum);
}

uint64_t packed(const void *three) {
    uint16_t word[3];
    memcpy(word, three, sizeof word);
    return (uint64_t)word[2] << 32 | (uint64_t)word[1] << 16 | word[0];
}

uint64_t whole(const burnish_q15_shader &shader, const burnish_q15_light *lights, uint8_t count,
               const int16_t normal[3]) {
    uint16_t color[3];
    burnish_q15_shade(&shader, lights, count, normal, color);
    return packed(color);
}

/* A unit's result; lights: of burnish_pixel. Returns false where the C core has no such lobe. */
bool expected(unsigned k, const input &in, uint8_t lights, uint64_t *result) {
    const struct {
        burnish_q15_fit fit;
        uint16_t order;
    } lobes[8] = {{BURNISH_Q15_TAYLOR, 2}, {BURNISH_Q15_SHIFT7, 2}, {BURNISH_Q15_SHIFT3, 2},
                  {BURNISH_Q15_ENERGY, 2}, {BURNISH_Q15_TAYLOR, 4}, {BURNISH_Q15_ENERGY, 16},
                  {BURNISH_Q15_TAYLOR, 2}, {BURNISH_Q15_TAYLOR, 2}};
    burnish_q15_shader shader;
    int16_t normal[3];
    uint16_t sum[3];
    switch (k) {
    case 0:
        shader_of(&shader, in, BURNISH_Q15_SHIFT7, 2);
        burnish_q15_normalize_near(in.a, normal);
        *result = whole(shader, in.lights, lights, normal);
        return true;
    case 1:
        *result = burnish_q15_cosine(burnish_q15_dot(in.a, in.b));
        return true;
    case 2:
        *result = burnish_q15_chord(in.a, in.b);
        return true;
    case 3:
        burnish_q15_normalize_near(in.a, normal);
        *result = packed(normal);
        return true;
    case 4:
        *result = burnish_q15_accumulate(in.sum[0], in.lights[0].diffuse[0], in.slope);
        return true;
    case 13:
        shader_of_slope(&shader, in, 2);
        *result = burnish_q15_highlight(&shader, in.a, in.b);
        return true;
    case 14:
        shader_of(&shader, in, BURNISH_Q15_SHIFT7, 2);
        for (int i = 0; i < 3; ++i) {
            sum[i] = burnish_q15_accumulate(in.sum[i], in.lights[0].specular[i],
                                            in.lit ? burnish_q15_highlight(&shader, in.a, in.b)
                                                   : (uint16_t)0);
        }
        *result = packed(sum);
        return true;
    case 15: {
        burnish_q15_light light = in.lights[0];
        memcpy(light.half, in.b, sizeof in.b);
        shader_of_slope(&shader, in, 4);
        *result = whole(shader, &light, 1, in.a);
        return true;
    }
    default:
        shader_of(&shader, in, lobes[k - 5].fit, lobes[k - 5].order);
        if (k >= 11) {
            shader.narrow = k == 12;
        }
        *result = burnish_q15_highlight(&shader, in.a, in.b);
        return shader.lobe.squarings != 0;
    }
}

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
