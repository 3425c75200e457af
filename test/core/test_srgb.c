/* The sRGB tables and look-ups against the formula in long double. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "burnish/kernels.h"
#include "core/srgb.h"
#include "render/render_ops.h"
#include "support.h"

static uint32_t float_bits(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The linear light of an sRGB value in [0, 1]. */
static long double srgb_decode(long double value) {
    return value <= 0.04045L ? value / 12.92L : powl((value + 0.055L) / 1.055L, 2.4L);
}

/* The nearest code by the encoding formula; the tables come from the decoding one. */
static int exact_code(float linear) {
    if (!(linear > 0)) {
        return 0;
    }
    if (linear >= 1) {
        return 255;
    }
    long double x = linear;
    long double value = x <= 0.0031308L ? 12.92L * x : 1.055L * powl(x, 1 / 2.4L) - 0.055L;
    return (int)floorl(value * 255 + 0.5L);
}

static void check_code(float linear) {
    CHECK(burnish_linear_to_srgb(linear) == exact_code(linear), "%a: got %d, expected %d",
          (double)linear, burnish_linear_to_srgb(linear), exact_code(linear));
}

static void test_around_thresholds(void) {
    for (int k = 1; k < 256; ++k) {
        uint32_t bits = float_bits((float)srgb_decode((k - 0.5L) / 255));
        for (uint32_t i = bits - 64; i <= bits + 64; ++i) {
            check_code(test_float_of_bits(i));
        }
    }
}

static void test_bucket_edges(void) {
    for (uint32_t i = 0; i <= BURNISH_SRGB_BUCKETS; ++i) {
        uint32_t edge = BURNISH_SRGB_FIRST_BITS + (i << 16);
        check_code(test_float_of_bits(edge - 1));
        check_code(test_float_of_bits(edge));
    }
}

static void test_all_patterns(void) {
    for (uint64_t bits = 0; bits <= UINT32_MAX; bits += 4099) {
        check_code(test_float_of_bits((uint32_t)bits));
    }
    const float special[] = {
        0.0F,       -0.0F,       -1.0F,      1.0F, 2.0F, (float)INFINITY, -(float)INFINITY,
        (float)NAN, -(float)NAN, FLT_MIN / 2};
    for (size_t i = 0; i < sizeof special / sizeof *special; ++i) {
        check_code(special[i]);
    }
}

static void test_monotone(void) {
    int last = 0;
    int rising = 1;
    for (uint32_t bits = 0; bits <= float_bits(1); bits += 61) {
        int code = burnish_linear_to_srgb(test_float_of_bits(bits));
        rising &= code == last || code == last + 1;
        last = code;
    }
    CHECK(rising && last == 255, "codes must rise one by one; the last is %d", last);
}

static void test_codes(void) {
    for (int k = 0; k < 256; ++k) {
        float linear = burnish_srgb_to_linear[k];
        long double exact = srgb_decode(k / 255.0L);
        CHECK(linear == (float)exact, "linear light of code %d", k);
        CHECK(burnish_linear_to_srgb(linear) == k, "code %d does not come back", k);
        CHECK(fabsl(burnish_srgb_value_to_linear((float)k / 255.0F) - exact) <= 2e-7L * exact,
              "value of code %d", k);
    }
}

static void test_values_between(void) {
    float last = 0;
    for (int i = 0; i <= 100000; ++i) {
        float value = (float)i / 100000.0F;
        float linear = burnish_srgb_value_to_linear(value);
        /* A chord of the curve between two codes lies at most h^2/8 f'' = 5.9e-6 above it. */
        CHECK(fabsl(linear - srgb_decode(value)) <= 6e-6L, "value %g", (double)value);
        CHECK(linear >= last && linear <= 1, "value %g is not monotone", (double)value);
        last = linear;
    }
    CHECK(burnish_srgb_value_to_linear((float)NAN) == 0, "NaN");
    CHECK(burnish_srgb_value_to_linear(-1) == 0, "below 0");
    CHECK(burnish_srgb_value_to_linear(test_float_of_bits(float_bits(1) - 1)) <= 1, "just below 1");
    CHECK(burnish_srgb_value_to_linear(1) == 1, "1");
    CHECK(burnish_srgb_value_to_linear((float)INFINITY) == 1, "infinity");
}

/* Every encoder gives the codes of burnish_linear_to_srgb: a stride over all floats, and
 * both sides of every decision level. */
static void test_encoders(void) {
    enum { COUNT = 1024 };
    static float values[3][COUNT];
    static uint32_t pixels[COUNT];
    const float *const rgb[3] = {values[0], values[1], values[2]};
    burnish_srgb_encoder encoder;
    burnish_srgb_encoder_make(&encoder);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_render_ops *batch =
            burnish_kernels_for((burnish_isa)isa) ? burnish_render_ops_for((burnish_isa)isa) : NULL;
        int wrong = 0;
        for (uint64_t bits = 0; batch && bits <= UINT32_MAX;) {
            for (int i = 0; i < COUNT; ++i) {
                for (int k = 0; k < 3; ++k, bits += 4099) {
                    /* from the first of a vector: up to 27 buckets below, to 33 above */
                    uint32_t pattern = (uint32_t)bits + (uint32_t)(i % 16 * 2 * (k - 1)) * 65536;
                    memcpy(&values[k][i], &pattern, sizeof pattern);
                }
                if (i < 255) {
                    uint32_t level = float_bits((float)srgb_decode((i + 0.5L) / 255));
                    for (uint32_t k = 0; k < 3; ++k) {
                        values[k][i] = test_float_of_bits(level - 1 + k);
                    }
                }
            }
            batch->encode_pixels(&encoder, COUNT, rgb, NULL, 0, 0, pixels);
            for (int i = 0; i < COUNT; ++i) {
                for (int k = 0; k < 3; ++k) {
                    wrong += (pixels[i] >> 8 * k & 255) != burnish_linear_to_srgb(values[k][i]);
                }
                wrong += pixels[i] >> 24 != 0;
            }
        }
        CHECK(wrong == 0, "%s: %d codes differ", burnish_isa_name((burnish_isa)isa), wrong);
    }
}

/* Hidden pixels, alpha, and the three bytes of each pixel in their order. */
static void test_packing(void) {
    enum { COUNT = 64 };
    static float values[3][COUNT];
    static int32_t shown[COUNT];
    static uint32_t pixels[COUNT];
    const float *const rgb[3] = {values[0], values[1], values[2]};
    burnish_srgb_encoder encoder;
    burnish_srgb_encoder_make(&encoder);
    for (int i = 0; i < COUNT; ++i) {
        values[0][i] = burnish_srgb_to_linear[i];
        values[1][i] = burnish_srgb_to_linear[255 - i];
        values[2][i] = burnish_srgb_to_linear[2 * i];
        shown[i] = i % 3 == 0 ? -1 : i;
    }
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_render_ops *batch =
            burnish_kernels_for((burnish_isa)isa) ? burnish_render_ops_for((burnish_isa)isa) : NULL;
        uint8_t bytes[3 * COUNT + 4];
        int wrong = 0;
        if (!batch) {
            continue;
        }
        batch->encode_pixels(&encoder, COUNT, rgb, shown, 0xff000000u, 0x00123456u, pixels);
        for (uint32_t i = 0; i < COUNT; ++i) {
            uint32_t code = i | (255 - i) << 8 | 2 * i << 16 | 0xff000000u;
            wrong += pixels[i] != (i % 3 == 0 ? 0x00123456u : code);
            pixels[i] &= 0xffffffu;
        }
        memset(bytes, 0xa5, sizeof bytes);
        batch->pack_groups(4, pixels + 4, 16, bytes); /* every fourth group */
        for (int i = 0; i < 48; ++i) {
            uint32_t pixel = pixels[4 + i / 12 * 16 + i / 3 % 4];
            wrong += bytes[i] != (pixel >> 8 * (i % 3) & 255);
        }
        for (int i = 48; i < 3 * COUNT + 4; ++i) {
            wrong += bytes[i] != 0xa5;
        }
        CHECK(wrong == 0, "%s: %d pixels or bytes differ", burnish_isa_name((burnish_isa)isa),
              wrong);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_around_thresholds());
    RUN(test_bucket_edges());
    RUN(test_all_patterns());
    RUN(test_monotone());
    RUN(test_codes());
    RUN(test_values_between());
    RUN(test_encoders());
    RUN(test_packing());
    return test_end("srgb");
}
