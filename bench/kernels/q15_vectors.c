/* The integer arrays with the vectors of BURNISH_BENCH_ISA, whose flags compile this file. */
#include "bench/kernels/q15.h"

#define PASTE(a, b) a##b
#define NAME(a, b) PASTE(a, b)

static void fast(const burnish_lobe_q15 *lobe, size_t count, const uint16_t *cosines,
                 void *values) {
    burnish_lobe_q15_fast_array(lobe, count, cosines, values);
}

static void near(const burnish_lobe_q15 *lobe, size_t count, const uint16_t *cosines,
                 void *values) {
    burnish_lobe_q15_near_array(lobe, count, cosines, values);
}

static void fast8(const burnish_lobe_q15 *lobe, size_t count, const uint16_t *cosines,
                  void *values) {
    burnish_lobe_q15_fast8_array(lobe, count, cosines, values);
}

static void to_floats(size_t count, const uint16_t *restrict words, float *restrict floats) {
    for (size_t i = 0; i < count; ++i) {
        floats[i] = (float)(int)words[i] * (1.0f / 32768.0f);
    }
}

static void to_words(size_t count, const float *restrict floats, uint16_t *restrict words) {
    for (size_t i = 0; i < count; ++i) {
        words[i] = (uint16_t)(int)(floats[i] * 65535.0f);
    }
}

static void rgba8(const burnish_q15_shader *shader, const burnish_q15_light *light, size_t count,
                  const int16_t *const normal[3], void *pixels) {
    burnish_q15_pixels_rgba8(shader, light, 1, count, normal, pixels);
}

static void rgb565(const burnish_q15_shader *shader, const burnish_q15_light *light, size_t count,
                   const int16_t *const normal[3], void *pixels) {
    burnish_q15_pixels_rgb565(shader, light, 1, count, normal, pixels);
}

const burnish_bench_q15 *NAME(burnish_bench_q15_, BURNISH_BENCH_ISA)(void) {
    static const burnish_bench_q15 functions = {BURNISH_Q15_LANES, fast,     near,  fast8,
                                                to_floats,         to_words, rgba8, rgb565};
    return &functions;
}
