/* Times lobes and whole pixels on a target: each variant over two sets of cosines or normals,
 * between marks for the simulator's cycle counter. Prints the sums of the integer variants,
 * which must equal the host's.
 *
 * A variant's cycles are its loop's minus the cycles of the loop `empty`, which only adds the
 * cosines, per cosine. Set-up (the lobe's slope, the tables) is not timed. */
#include "burnish/shade_q15.h"

#include "rivals.h"
#include "target.h"

#ifdef WITH_FLOAT
#include <math.h>
#endif

enum { COSINES = 64, EXPONENT = 32 };

/* The input of a loop. Read through a pointer: no variant may know its exponent at compile
 * time. */
typedef struct input {
    uint16_t cosines[COSINES];
    uint16_t exponent;
    burnish_lobe_q15 taylor, energy, aligned, order4, order8, order16;
    uint16_t ends[257];          /* the table of rivals.h */
    int16_t normals[COSINES][3]; /* Q15, 2 % too short, as after interpolation */
    int32_t lengths[COSINES][3]; /* the same of any length */
    burnish_q15_shader shader;
    burnish_q15_light light;
    burnish_composite_q15 composite, power;
} input;

/* ---- The same in floating point ---- */

#ifdef WITH_FLOAT
static inline uint16_t float_power(float exponent, uint16_t cosine) {
    return (uint16_t)(powf((float)cosine * (1.0f / 32768.0f), exponent) * 65535.0f);
}
#endif

/* ---- A pixel -------------------------------------------------------------------------------- */

/* One light on an interpolated normal, to RGB565, with any lobe. All branch as
 * burnish_q15_shade does, also with Schlick's. */
#define PIXEL(in, at, lobe)                                                                        \
    int16_t normal[3];                                                                             \
    uint16_t color[3], n_dot_l, weight, c;                                                         \
    uint8_t k;                                                                                     \
    burnish_q15_normalize_near((in)->normals[at], normal);                                         \
    n_dot_l = burnish_q15_cosine(burnish_q15_dot(normal, (in)->light.direction));                  \
    weight = burnish_q15_weight(n_dot_l);                                                          \
    for (k = 0; k < 3; ++k) {                                                                      \
        color[k] =                                                                                 \
            burnish_q15_accumulate((in)->shader.ambient[k], (in)->light.diffuse[k], weight);       \
    }                                                                                              \
    c = burnish_q15_cosine(burnish_q15_dot(normal, (in)->light.half));                             \
    weight = n_dot_l ? (lobe) : 0;                                                                 \
    if (weight) {                                                                                  \
        for (k = 0; k < 3; ++k) {                                                                  \
            color[k] = burnish_q15_accumulate(color[k], (in)->light.specular[k], weight);          \
        }                                                                                          \
    }                                                                                              \
    (void)c;                                                                                       \
    result = burnish_q15_rgb565(color);

/* ---- The loops ------------------------------------------------------------------------------ */

/* A lobe with a stored boundary; shift and order are known at compile time. */
static inline uint16_t stored(uint16_t slope, uint16_t reach, uint8_t shift, uint16_t cosine) {
    const burnish_lobe_q15 lobe = {slope, reach, shift, 1};
    return burnish_lobe_q15_fast(&lobe, cosine);
}

/* X(NAME, TYPE of the exponent, EXPRESSION of the cosine c, exponent n, input in) */
#define INTEGER_VARIANTS(X)                                                                        \
    X(empty, uint16_t, c)                                                                          \
    X(taylor, uint16_t, burnish_taylor_q15(n, c))                                                  \
    X(taylor_stored, uint16_t, stored(in->taylor.slope, in->taylor.reach, 0, c))                   \
    X(shift7, uint16_t, burnish_shift7_q15(n, c))                                                  \
    X(shift3, uint16_t, burnish_shift3_q15(n, c))                                                  \
    X(taylor8, uint8_t, burnish_taylor8_q15(n, c))                                                 \
    X(zeta_aligned, uint16_t, burnish_slope_q15(in->aligned.slope, 8, c))                          \
    X(zeta_aligned_stored, uint16_t, stored(in->aligned.slope, in->aligned.reach, 8, c))           \
    X(energy_fast, uint16_t, burnish_lobe_q15_fast(&in->energy, c))                                \
    X(energy_near, uint16_t, burnish_lobe_q15_near(&in->energy, c))                                \
    X(energy_exact, uint16_t, burnish_lobe_q15_exact(&in->energy, c))                              \
    X(energy_lambda, uint16_t,                                                                     \
      burnish_lobe_q15_fast_lambda(&in->energy, (uint32_t)burnish_q15_lambda(c) << 9))             \
    X(order4, uint16_t, burnish_lobe_q15_fast(&in->order4, c))                                     \
    X(order8, uint16_t, burnish_lobe_q15_fast(&in->order8, c))                                     \
    X(order16, uint16_t, burnish_lobe_q15_fast(&in->order16, c))                                   \
    X(composite, uint16_t, burnish_composite_q15_at_cosine(&in->composite, c))                     \
    X(composite_lambda, uint16_t,                                                                  \
      burnish_composite_q15_at_lambda(&in->composite, (uint32_t)burnish_q15_lambda(c) << 9))       \
    X(power, uint16_t, burnish_composite_q15_at_cosine(&in->power, c))                             \
    X(schlick16, uint16_t, schlick16(n, c))                                                        \
    X(table_between, uint16_t, table_between(in->ends, c))
#ifdef WITH_FLOAT
#define FLOAT_VARIANTS(X) X(float_power, float, float_power(n, c))
#else
#define FLOAT_VARIANTS(X)
#endif

#define LOOP(name, type, expression)                                                               \
    uint16_t time_##name(const input *in);                                                         \
    __attribute__((noinline)) uint16_t time_##name(const input *in) {                              \
        const type n = (type)in->exponent;                                                         \
        const uint16_t *at = in->cosines;                                                          \
        uint8_t count = COSINES;                                                                   \
        uint16_t sum = 0;                                                                          \
        (void)n;                                                                                   \
        do {                                                                                       \
            const uint16_t c = *at++;                                                              \
            sum = (uint16_t)(sum + (expression));                                                  \
        } while (--count);                                                                         \
        return sum;                                                                                \
    }
INTEGER_VARIANTS(LOOP)
FLOAT_VARIANTS(LOOP)

/* X(NAME, TYPE of the exponent, STATEMENTS that set result from the i-th normal) */
#define INTEGER_PIXELS(X)                                                                          \
    X(normalize_near, uint16_t, int16_t normal[3];                                                 \
      burnish_q15_normalize_near(in->normals[i], normal);                                          \
      result = (uint16_t)(normal[0] ^ normal[1] ^ normal[2]);)                                     \
    X(normalize, uint16_t, int16_t normal[3]; burnish_q15_normalize(in->lengths[i], normal);       \
      result = (uint16_t)(normal[0] ^ normal[1] ^ normal[2]);)                                     \
    X(pixel_none, uint16_t, PIXEL(in, i, 0))                                                       \
    X(pixel_taylor, uint16_t, PIXEL(in, i, burnish_taylor_q15(n, c)))                              \
    X(pixel_shift7, uint16_t, PIXEL(in, i, burnish_shift7_q15(n, c)))                              \
    X(pixel_aligned_stored, uint16_t,                                                              \
      PIXEL(in, i, stored(in->aligned.slope, in->aligned.reach, 8, c)))                            \
    X(pixel_schlick16, uint16_t, PIXEL(in, i, schlick16(n, c)))
#ifdef WITH_FLOAT
#define FLOAT_PIXELS(X) X(pixel_float_power, float, PIXEL(in, i, float_power(n, c)))
#else
#define FLOAT_PIXELS(X)
#endif

#define PIXEL_LOOP(name, type, statements)                                                         \
    uint16_t time_##name(const input *in);                                                         \
    __attribute__((noinline)) uint16_t time_##name(const input *in) {                              \
        const type n = (type)in->exponent;                                                         \
        uint16_t sum = 0;                                                                          \
        uint8_t i;                                                                                 \
        (void)n;                                                                                   \
        for (i = 0; i < COSINES; ++i) {                                                            \
            uint16_t result;                                                                       \
            statements sum = (uint16_t)(sum + result);                                             \
        }                                                                                          \
        return sum;                                                                                \
    }
INTEGER_PIXELS(PIXEL_LOOP)
FLOAT_PIXELS(PIXEL_LOOP)

/* ---- The program ---------------------------------------------------------------------------- */

static void put_text(const char *text) {
    while (*text) {
        target_put((uint8_t)*text++);
    }
}

static void put_number(uint16_t number) {
    uint8_t i;
    for (i = 0; i < 4; ++i, number = (uint16_t)(number << 4)) {
        target_put((uint8_t) "0123456789abcdef"[number >> 12]);
    }
}

typedef uint16_t loop(const input *in);

/* Runs a loop over both sets and prints its sums. */
static void run(const char *name, loop *time, const input sets[2], uint8_t is_exact) {
    uint8_t set;
    put_text(name);
    for (set = 0; set < 2; ++set) {
        uint16_t sum;
        target_mark();
        sum = time(&sets[set]);
        target_mark();
        target_put(' ');
        if (is_exact) {
            put_number(sum);
        } else {
            target_put('-');
        }
    }
    target_put('\n');
}

/* x^32 of x in UQ0.32 by five squarings, rounded to UQ0.16. */
static uint16_t power32(uint32_t x) {
    uint8_t k;
    for (k = 0; k < 5; ++k) {
        x = burnish_q15_square_wide(x);
    }
    return burnish_q15_round(x);
}

static void fill_table(input *in) {
    uint16_t i;
    for (i = 0; i < 256; ++i) {
        in->ends[i] = power32((uint32_t)i << 24);
    }
    in->ends[256] = power32(0xFFFFFFFFul);
}

/* Normals around the half vector: all within the lobe, or over the whole lit side. */
static void fill_normals(input *in, uint16_t reach) {
    static const burnish_q15_material surface = {
        {0x1000, 0x1000, 0x1000}, {0x5000, 0x4000, 0x3000}, {0x4000, 0x4000, 0x4000}};
    static const uint16_t white[3] = {0x8000, 0x8000, 0x8000}, dim[3] = {0x2000, 0x2000, 0x2000};
    static const int16_t to_light[3] = {-12000, 16000, 26000}, to_viewer[3] = {0, 0, 0x7FFF};
    const int16_t spread = reach == 0x8000u ? 30000 : 4500;
    uint8_t i, k;
    burnish_q15_shader_create(&in->shader, BURNISH_Q15_TAYLOR, 2, EXPONENT, &surface, dim);
    burnish_q15_light_create(&in->light, to_light, to_viewer, white, &surface);
    for (i = 0; i < COSINES; ++i) {
        int16_t unit[3];
        int32_t v[3];
        for (k = 0; k < 3; ++k) {
            const int8_t place =
                (int8_t)((uint8_t)(i * (37u + 30u * k) + 11u) % COSINES - COSINES / 2);
            v[k] = in->light.half[k] + (int32_t)spread * place / (COSINES / 2);
        }
        burnish_q15_normalize(v, unit);
        for (k = 0; k < 3; ++k) {
            in->normals[i][k] = (int16_t)(unit[k] - unit[k] / 50);
            in->lengths[i][k] = v[k];
        }
    }
}

/* Cosines spread evenly over [1 - reach, 1), in an unpredictable order. */
static void fill(input *in, uint16_t reach) {
    uint8_t i;
    for (i = 0; i < COSINES; ++i) {
        const uint8_t place = (uint8_t)((i * 37u + 11u) % COSINES);
        in->cosines[i] =
            (uint16_t)(BURNISH_Q15_ONE - 1 - (uint16_t)(((uint32_t)reach * place) / COSINES));
    }
    in->exponent = EXPONENT;
    burnish_lobe_q15_create(&in->taylor, BURNISH_Q15_TAYLOR, 2, EXPONENT);
    burnish_lobe_q15_create(&in->energy, BURNISH_Q15_ENERGY, 2, EXPONENT);
    burnish_lobe_q15_create(&in->aligned, BURNISH_Q15_ENERGY, 2, EXPONENT);
    burnish_lobe_q15_align(&in->aligned);
    burnish_lobe_q15_create(&in->order4, BURNISH_Q15_TAYLOR, 4, EXPONENT);
    burnish_lobe_q15_create(&in->order8, BURNISH_Q15_TAYLOR, 8, EXPONENT);
    burnish_lobe_q15_create(&in->order16, BURNISH_Q15_TAYLOR, 16, EXPONENT);
    burnish_composite_q15_create(&in->composite, EXPONENT);
    burnish_composite_q15_create(&in->power, 14);
    fill_table(in);
    fill_normals(in, reach);
}

int main(void) {
    static input sets[2];
    fill(&sets[0], 0x8000u / 16 - 8); /* inside every lobe: zeta is at most 16 */
    fill(&sets[1], 0x8000u);
#define RUN_EXACT(name, type, expression) run(#name, time_##name, sets, 1);
#define RUN_FLOAT(name, type, expression) run(#name, time_##name, sets, 0);
    INTEGER_VARIANTS(RUN_EXACT)
    FLOAT_VARIANTS(RUN_FLOAT)
    INTEGER_PIXELS(RUN_EXACT)
    FLOAT_PIXELS(RUN_FLOAT)
    target_end();
    return 0;
}
