/* Compares the arrays of dsp.h with the C core, one value at a time: first sums over many inputs,
 * which must equal each other and the host's; then both between marks, for the simulator's cycle
 * counter. */
#include "burnish/shade_q15.h"
#include "target.h"
#ifdef __ARM_FEATURE_SIMD32
#include "dsp.h"
#endif

#ifndef ROUNDS
#define ROUNDS 200
#endif

enum { COUNT = 64 };

typedef struct input {
    uint16_t cosines[COUNT];
    int16_t normals[3][COUNT]; /* Q15, 2 % too short, as after interpolation */
    burnish_lobe_q15 lobe;
    burnish_q15_shader wide, narrow; /* from the cosine, from the chord */
    burnish_q15_light light;
} input;

static uint16_t values[COUNT];
static uint32_t sum;

static void put_text(const char *text) {
    while (*text) {
        target_put((uint8_t)*text++);
    }
}

static void take(uint32_t result) {
    sum = (sum << 5 | sum >> 27) ^ result;
}

static void put_sum(void) {
    uint8_t i;
    for (i = 0; i < 8; ++i, sum <<= 4) {
        target_put((uint8_t) "0123456789abcdef"[sum >> 28]);
    }
}

#define LOOP(name) __attribute__((noinline)) static void name(const input *in)

LOOP(lobe_core) {
    uint8_t i;
    for (i = 0; i < COUNT; ++i) {
        values[i] = burnish_lobe_q15_fast(&in->lobe, in->cosines[i]);
    }
}

LOOP(lobe_array) {
#ifdef __ARM_FEATURE_SIMD32
    dsp_lobe_fast(&in->lobe, COUNT, in->cosines, values);
#else
    lobe_core(in);
#endif
}

static inline void pixels_core(const input *in, const burnish_q15_shader *shader) {
    uint8_t i, k;
    for (i = 0; i < COUNT; ++i) {
        int16_t normal[3];
        uint16_t color[3];
        for (k = 0; k < 3; ++k) {
            normal[k] = in->normals[k][i];
        }
        burnish_q15_normalize_near(normal, normal);
        burnish_q15_shade(shader, &in->light, 1, normal, color);
        values[i] = burnish_q15_rgb565(color);
    }
}

static inline void pixels_array(const input *in, const burnish_q15_shader *shader) {
#ifdef __ARM_FEATURE_SIMD32
    const int16_t *const normals[3] = {in->normals[0], in->normals[1], in->normals[2]};
    dsp_pixels_rgb565(shader, &in->light, 1, COUNT, normals, values);
#else
    pixels_core(in, shader);
#endif
}

LOOP(wide_core) {
    pixels_core(in, &in->wide);
}

LOOP(wide_array) {
    pixels_array(in, &in->wide);
}

LOOP(narrow_core) {
    pixels_core(in, &in->narrow);
}

LOOP(narrow_array) {
    pixels_array(in, &in->narrow);
}

/* Cosines and normals inside the lobe, or over the whole lit side. */
static void fill(input *in, uint8_t all, uint16_t salt) {
    static const burnish_q15_material surface = {
        {0x1000, 0x1000, 0x1000}, {0x5000, 0x4000, 0x3000}, {0x4000, 0x4000, 0x4000}};
    static const uint16_t white[3] = {0x8000, 0x8000, 0x8000}, dim[3] = {0x2000, 0x2000, 0x2000};
    static const int16_t to_light[3] = {-12000, 16000, 26000}, to_viewer[3] = {0, 0, 0x7FFF};
    const int16_t spread = all ? 30000 : 4500;
    uint8_t i, k;
    burnish_lobe_q15_create(&in->lobe, BURNISH_Q15_ENERGY, 2, 32);
    burnish_q15_shader_create(&in->wide, BURNISH_Q15_ENERGY, 2, 31, &surface, dim);
    burnish_q15_shader_create(&in->narrow, BURNISH_Q15_ENERGY, 2, 32, &surface, dim);
    burnish_q15_light_create(&in->light, to_light, to_viewer, white, &surface);
    for (i = 0; i < COUNT; ++i) {
        const uint16_t at = (uint16_t)((i * 37u + 11u + salt) % COUNT);
        int16_t unit[3];
        int32_t v[3];
        in->cosines[i] =
            (uint16_t)(BURNISH_Q15_ONE - 1 - (all ? 0x8000u : 0x7F8u) * (uint32_t)at / COUNT);
        for (k = 0; k < 3; ++k) {
            const int16_t place = (int16_t)((i * (37u + 30u * k) + 11u + salt) % COUNT - COUNT / 2);
            v[k] = in->light.half[k] + (int32_t)spread * place / (COUNT / 2);
        }
        burnish_q15_normalize(v, unit);
        for (k = 0; k < 3; ++k) {
            in->normals[k][i] = (int16_t)(unit[k] - unit[k] / 50 + (int16_t)(salt % 64));
        }
    }
}

typedef void loop(const input *in);

/* The values of a loop, added to the sum. */
static void add(loop *run, const input *in) {
    uint8_t i;
    run(in);
    for (i = 0; i < COUNT; ++i) {
        take(values[i]);
        values[i] = 0;
    }
}

/* A line: name, the sum, and whether the core's is the same. The marks of both follow each other.
 */
static void compare(const char *name, loop *core, loop *array) {
    static input sets[2];
    uint32_t expected;
    uint16_t salt;
    uint8_t set;
    for (salt = 0; salt < ROUNDS; ++salt) {
        fill(&sets[0], salt & 1, salt);
        add(core, &sets[0]);
    }
    expected = sum;
    sum = 0;
    for (salt = 0; salt < ROUNDS; ++salt) {
        fill(&sets[0], salt & 1, salt);
        add(array, &sets[0]);
    }
    put_text(name);
    put_text(sum == expected ? " same " : " DIFFERENT ");
    put_sum();
    target_put('\n');
    for (set = 0; set < 2; ++set) {
        fill(&sets[set], set, 0);
    }
    for (set = 0; set < 4; ++set) {
        target_mark();
        (set & 2 ? array : core)(&sets[set & 1]);
        target_mark();
    }
}

int main(void) {
    compare("lobe", lobe_core, lobe_array);
    compare("pixel_cosine", wide_core, wide_array);
    compare("pixel_chord", narrow_core, narrow_array);
    target_end();
    return 0;
}
