/* pixel.h: random inputs of the units from vectors to a pixel (pixel.v), and their results by
 * shade_q15.h.
 *
 * A third of the vectors are any 16 bits or corners, the others of about unit length; half vectors
 * are mostly inside the lobe.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RTL_PIXEL_H
#define BURNISH_RTL_PIXEL_H

#include <cstring>

#include "burnish/shade_q15.h"

namespace {

const unsigned units = 16;
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

} // namespace

#endif
